"""What becomes of each theorem and headline statement of a paper, computed from the decisions on its claims."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from workbench.proof.besides import besides
from workbench.proof.places import places_of, subject_of
from workbench.proof.premises import holds_in_other_reading, proved_under, slips_on_the_way, with_taint
from workbench.proof.verdict import Decision, Fate
from workbench.proof.wording import listed

NAMED = 5  # lines that fail up to which all are named


def is_headline(decision: Decision) -> bool:
    """Whether a claim is a theorem or headline statement that the paper prints."""
    return decision.claim.origin == "printed" and decision.claim.severity == "result"


def judged(decisions: Sequence[Decision]) -> list[Decision]:
    """The decisions, each with what it has from the others: the failed claims in the paper's chain to it, what its
    proof uses that is not shown, its fate, and its other reading. All that they rest on, in the paper and in our proof,
    is among them."""
    taken = besides(decisions)
    tainted = with_taint([replace(d, besides=taken.get(d.claim.id, ())) for d in decisions])
    fate, under = fates(tainted), proved_under(decisions)
    printed = {d.claim.id: d.claim.printed for d in decisions}
    return [replace(d, proved_under=under.get(d.claim.id, ()), fate=fate.get(d.claim.id),
                    other_reading=printed.get(d.claim.glyph or "")) for d in tainted]


def fates(decisions: Sequence[Decision]) -> dict[str, Fate]:
    """The fate of every headline claim by id; what they rest on and their mended forms are among the decisions."""
    under, slips = proved_under(decisions), slips_on_the_way(decisions)
    by_id = {d.claim.id: d for d in decisions}
    mended = {d.claim.mends: d for d in decisions if d.claim.mends is not None and under.get(d.claim.id) == ()}
    return {d.claim.id: _fate(d, by_id, mended.get(d.claim.id), under.get(d.claim.id, ()), slips[d.claim.id])
            for d in decisions if is_headline(d)}


def _fate(decision: Decision, by_id: dict[str, Decision], mended: Decision | None, unshown: tuple[str, ...],
          slips: tuple[str, ...]) -> Fate:
    form = f"holds in a mended form, “{subject_of(mended.claim.title)}”" if mended else ""
    by = (mended.claim.id,) if mended else ()
    if decision.verdict == "refuted":
        if holds_in_other_reading(decision, by_id):
            other = str(decision.claim.glyph)
            return Fate("open", f"depends on the reading: {_named((other,), by_id)} holds", (other,))
        return Fate("falls", f"refuted by {_how(decision)}{f'; it {form}' if form else ''}", by)
    if decision.verdict == "proved" and not unshown:
        failing = tuple(line for line in decision.tainted_by if not holds_in_other_reading(by_id[line], by_id))
        where = f"holds where {listed(decision.besides)}, which it does not state," if decision.besides else "holds,"
        if not failing:
            readings = tuple(decision.tainted_by)
            return Fate("stands", f"{where} and {_all_but(slips, by_id)}{_but_for(len(readings))}", readings)
        return Fate("stands with corrections", f"{where} but {_in_spite_of(failing, by_id)}", failing)
    if mended is not None:
        return Fate("stands with corrections", f"{_shortfall(decision, unshown, by_id)}; it {form}", by)
    return Fate("open", _shortfall(decision, unshown, by_id), unshown)


def _all_but(slips: Sequence[str], by_id: Mapping[str, Decision]) -> str:
    """That no line on the text's way fails, or which do without changing anything."""
    if not slips:
        return "no line that the text uses to get there fails"
    fails = "fails, a slip that changes" if len(slips) == 1 else "fail, slips that change"
    return f"of the lines that the text uses to get there only {_named(slips, by_id)} {fails} no result"


def _but_for(readings: int) -> str:
    """How many lines on the way to a statement fail as extracted from the page alone."""
    which = "one that holds" if readings == 1 else f"{readings} that hold"
    return f", but for {which} in another reading of the extracted text" if readings else ""


def _in_spite_of(failing: Sequence[str], by_id: Mapping[str, Decision]) -> str:
    """What is not as printed of a statement that is proved: the numbers, where these alone break what it asks for, or
    the way of the text."""
    if all(by_id[line].verdict == "violated" for line in failing):
        return f"not at the printed numbers, which break {_named(failing, by_id)}"
    titles = {by_id[name].claim.equation: by_id[name].claim.title for name in failing}
    return f"not by the way of the text, {which_uses(titles)}"


def _shortfall(decision: Decision, unshown: tuple[str, ...], by_id: Mapping[str, Decision]) -> str:
    if decision.verdict == "proved":
        one = len(unshown) == 1
        return (f"is proved only where {_named(unshown, by_id)} {'holds' if one else 'hold'}, which "
                f"{'is' if one else 'are'} not shown")
    if decision.verdict == "gap" and holds_in_other_reading(decision, by_id):
        return "follows in another reading of the extracted text alone"
    return {"gap": "does not follow as printed", "violated": "does not hold at the printed numbers",
            "assumed": "is taken as given, its proof was not checked", "undecided": "is not decided"}[decision.verdict]


def _how(decision: Decision) -> str:
    return "an exact motion" if (decision.certificate or {}).get("functions") else "a counterexample"


def which_uses(titles: Mapping[str, str]) -> str:
    """Which lines that fail a text uses, named where they are few; titles: what they say, by equation."""
    if len(titles) > NAMED:
        return f"which uses {len(titles)} lines that fail"
    return f"which uses {listed(places_of(list(titles), titles))}, which {'fails' if len(titles) == 1 else 'fail'}"


def _named(claim_ids: Sequence[str], by_id: Mapping[str, Decision]) -> str:
    """Lines as a reader calls them, `equation (4) and Theorem 1`, with what their parts say: one may fail and another
    hold."""
    titles = {by_id[name].claim.equation: by_id[name].claim.title for name in claim_ids}
    return listed(places_of(list(titles), titles))

"""The lines that a document names and tells nothing of: each with its statement, its verdict and what shows it."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.proof.verdict import Decision
from workbench.report.counterexample_cache import cached_counterexample
from workbench.report.errata.blocks import Block, Formula, Heading, Paragraph
from workbench.report.errata.conditions import ALONG, STATEMENT_CHECKED, UNDER, listed_conditions
from workbench.report.errata.letters import in_blocks, legend
from workbench.report.errata.mended import proof_blocks
from workbench.report.errata.names import lines_named, name_of_line
from workbench.report.errata.proof_steps import HOW_TO_READ, proof_steps
from workbench.report.finding import Finding
from workbench.report.finding_sentences import IMPLIED, PRINTED, breaks_at
from workbench.report.hypotheses import conditions_of, motion_of
from workbench.report.letters import letters_of

SHORT, MOST_TEXT = 12, 3000  # steps, and characters of them, up to which a proof is told here
LABELS = {"printed": PRINTED, "implied": IMPLIED, "ours": "Statement"}


def referred_to(decisions: Sequence[Decision], found: Sequence[Finding], proofs: Sequence[Decision]) -> list[Decision]:
    """The lines that notes and proofs name, and the mended forms of lines, that stand nowhere else, in the order of the
    paper's claims."""
    titles = {d.claim.equation: d.claim.title for d in decisions}
    texts = [text for f in found for text in (f.reading, f.note)] + [d.claim.note for d in proofs]
    named = {name for text in texts for name in lines_named(text, titles)}
    named |= {name.partition(":")[2] for d in proofs for name in d.claim.premises}
    named |= {name for f in found for name in (*f.mended_under, f.mended_by) if name}
    told = {f.equation for f in found} | {d.claim.equation for d in proofs}
    return [d for d in decisions if d.claim.equation in named - told]


def lines_referred_to(referred: Sequence[Decision], explained: bool) -> list[Block]:
    """Each of these lines with its verdict and what shows it; explained: whether the document has said how its proofs
    are read."""
    if not referred:
        return []
    how = [] if explained or not any(map(_is_short, referred)) else [Paragraph(HOW_TO_READ)]
    return [Heading(2, "Lines referred to"), *how, *(block for d in referred for block in _line(d))]


def _line(d: Decision) -> list[Block]:
    verdict = {"proved": "Proved, where lines hold that are not shown." if d.proved_under else "Proved.",
               "assumed": "Taken as given, its proof was not checked.", "undecided": "Not decided.",
               "refuted": "It does not hold.", "violated": "It does not hold at the printed numbers.",
               "gap": "It does not follow."}[d.verdict]
    return [Heading(3, name_of_line(d)), Formula(d.claim.printed, LABELS[d.claim.origin]),
            Paragraph(verdict, "Verdict"), *(proof_blocks(d) if _is_short(d) else _shown(d))]


def _is_short(d: Decision) -> bool:
    """Whether a line has a proof that is told here."""
    if "proofs" not in (d.certificate or {}):
        return False
    lines = proof_steps(d.certificate or {}).lines
    return len(lines) <= SHORT and sum(len(line.text) for line in lines) <= MOST_TEXT


def _shown(d: Decision) -> list[Block]:
    """What a line is proved for, or where it fails, and what letters are."""
    own, certificate = letters_of(d), d.certificate or {}
    goal = certificate.get("goal") or {}
    given = listed_conditions({UNDER: conditions_of(goal), ALONG: motion_of(goal)}) if goal else []
    shown: list[Block] = []
    if d.verdict == "proved":
        shown = given
    elif point := cached_counterexample(certificate) if goal else None:
        at = breaks_at(point)
        shown = [Formula(point.relation, STATEMENT_CHECKED), *given, Paragraph(f"{at[:1].upper()}{at[1:]}.", "Finding")]
    told = legend(shown, own)
    return [*([Paragraph(told, "Letters")] if told else []), *in_blocks(shown, own)]

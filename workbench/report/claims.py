"""The claims of a proof document as a page shows them; tolerant of whatever a document leaves out."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from markupsafe import Markup, escape

from workbench.files.folders import CERTIFICATES
from workbench.proof.checker import CertificateError
from workbench.proof.places import STATEMENT, place_of, subject_of, whole_of
from workbench.proof.verdict import FAILED
from workbench.report.certificate_latex import assignments_latex
from workbench.report.formulas import formula, in_html
from workbench.report.letters import letters_from
from workbench.report.note_links import anchors_beside, linked
from workbench.report.number_style import alike, upright
from workbench.report.typography import set_words
from workbench.report.worded import worded

# The order in which a reader wants to see them, with a sign for who cannot tell the colours.
VERDICTS = {"refuted": "✗", "violated": "!", "gap": "⋯", "undecided": "?", "assumed": "≔", "proved": "✓"}
NOT_AS_PRINTED = ("refuted", "violated", "gap")
TRUST = {"exact": "certificate re-checked exactly", "oracle": "a solver's word",
         "kernel": "certificate re-checked exactly, and accepted by Coq's kernel"}
CORRECTIONS = {"refuted": "True instead", "violated": "Repaired", "gap": "What does follow"}
FACTS = (("Stated", "stated"), ("Computed", "computed"), ("Read as", "reading"), ("Other reading", "glyph_claim"),
         ("Mends", "mends"), ("Scope", "scope"))
ORIGINS = {"printed": "a line of the paper", "implied": "a step the paper takes without words",
           "ours": "a question of ours"}

_SECTION = re.compile(r"\d+(?:\.\d+)*")


@dataclass(frozen=True)
class ClaimRef:
    """A claim named by another: its id, and its anchor where it stands in this document."""

    id: str
    anchor: str | None


@dataclass(frozen=True)
class ClaimView:
    """One claim, ready to show; formulas are MathML, `facts` are labelled texts that fold away; place: its line in the
    paper, empty where that has no number; told: its line and, for a part of one, what it says, formulas between dollar
    signs.

    decided: the goal itself, made from what was decided, where no machine found it in the printed line; otherwise:
    whether it fails and its other reading holds.
    """

    id: str
    anchor: str
    title: Markup
    subject: Markup
    equation: str
    section: str
    origin: str
    severity: str
    kind: str
    statement: Markup
    decided: Markup
    correction: Markup
    correction_label: str
    verdict: str
    sign: str
    recorded: str
    method: str
    trust: str
    note: Markup
    tainted_by: tuple[ClaimRef, ...]
    proved_under: tuple[ClaimRef, ...]
    premises: tuple[ClaimRef, ...]
    rests_on: tuple[ClaimRef, ...]
    counterexample: tuple[Markup, ...]
    facts: tuple[tuple[str, Markup], ...]
    open: bool
    ours: bool
    fate: str
    fate_why: Markup
    place: str
    told: str
    otherwise: bool


def claim_views(document: Mapping[str, Any]) -> list[ClaimView]:
    """The claims of a `prove --json` document, in its order."""
    entries = [entry for entry in _list(document.get("claims")) if isinstance(entry, Mapping)]
    verdicts = {_text(entry.get("id")): _text(entry.get("verdict")) for entry in entries}
    anchors = {name: anchor(name) for name in verdicts}
    return [replace(view, note=linked(view.note, anchors_beside(view.id, anchors)))
            for view in (_view(entry, verdicts) for entry in entries)]


def fated(claims: Sequence[ClaimView]) -> list[ClaimView]:
    """The headline statements, those that fall first."""
    order = ("falls", "stands with corrections", "open", "stands")
    return sorted((claim for claim in claims if claim.fate),
                  key=lambda claim: order.index(claim.fate) if claim.fate in order else 0)


def by_section(claims: Sequence[ClaimView]) -> list[tuple[str, list[ClaimView]]]:
    """The claims of each section, by the sections' numbers, as they come where these are none; what has no section
    after them; one group where no section is known."""
    groups: dict[str, list[ClaimView]] = {}
    for claim in claims:
        groups.setdefault(claim.section, []).append(claim)
    numbered = all(_SECTION.fullmatch(section) for section in groups if section)
    return sorted(groups.items(), key=lambda group: (not group[0], [
        int(part) for part in group[0].split(".")] if numbered and group[0] else []))


def charged(claims: Sequence[ClaimView]) -> list[ClaimView]:
    """The claims without those that fail only as extracted: no paper is charged with these."""
    return [claim for claim in claims if not claim.otherwise]


def counts(claims: Sequence[ClaimView]) -> dict[str, int]:
    """How many claims have each verdict, the known verdicts first and all of them named."""
    found = dict.fromkeys(VERDICTS, 0)
    for claim in claims:
        found[claim.verdict] = found.get(claim.verdict, 0) + 1
    return found


def _view(entry: Mapping[str, Any], verdicts: Mapping[str, str]) -> ClaimView:
    verdict = _text(entry.get("verdict")) or "undecided"
    recorded = _text(entry.get("recorded"))
    seconds = entry.get("seconds")
    shown = [(label, in_words(_text(entry.get(key)))) for label, key in FACTS]
    correction, beside = _text(entry.get("correction")), certificate_beside(entry)
    if beside:
        shown.append(("Certificate", Markup('<a href="{}"><code>{}</code></a>').format(quote(beside), beside)))
    own = letters_from(entry.get("letters"))
    goal = own.in_formula(upright(_text(entry.get("goal")))) if entry.get("match") != "parsed" else ""
    point = list(map(own.in_formula, _assigned(entry.get("counterexample"))))
    if (told := own.legend([goal, *point])):
        shown.append(("Letters", in_html(told)))
    origin, severity = _text(entry.get("origin")), _text(entry.get("severity"))
    if origin:
        shown.insert(0, ("Stands as", escape(", ".join(filter(None, (ORIGINS.get(origin, origin), severity))))))
    if isinstance(seconds, int | float):
        shown.append(("Decided in", escape(f"{seconds:.2g} s")))
    refs = {key: tuple(ClaimRef(name, anchor(name) if name in verdicts else None)
                       for name in map(_text, _list(entry.get(key))))
            for key in ("tainted_by", "proved_under", "premises", "rests_on")}
    trust, place = _text(entry.get("trust")), whole_of(_text(entry.get("equation")), _text(entry.get("title")))
    subject = subject_of(_text(entry.get("title")))
    return ClaimView(
        id=_text(entry.get("id")), anchor=anchor(_text(entry.get("id"))), title=in_words(_text(entry.get("title"))),
        subject=in_words("" if subject == place else subject),  # Lemma 2 is not told to be Lemma 2
        equation=_text(entry.get("equation")), section=_text(entry.get("section")), origin=origin, severity=severity,
        kind=_text(entry.get("kind")),
        statement=formula(_text(entry.get("statement"))),
        decided=formula(goal),
        correction=formula(alike(upright(correction)) if verdict == "violated" else correction),
        correction_label=CORRECTIONS.get(verdict, "Correction"),
        verdict=verdict, sign=VERDICTS.get(verdict, "?"), recorded=recorded if recorded != verdict else "",
        method=_text(entry.get("method")), trust=TRUST.get(trust, trust), note=in_words(_text(entry.get("note"))),
        tainted_by=refs["tainted_by"], proved_under=refs["proved_under"], premises=refs["premises"],
        rests_on=refs["rests_on"],
        counterexample=tuple(map(formula, point)) or _as_typed(entry.get("counterexample")),
        facts=tuple((label, text) for label, text in shown if text), open=verdict in NOT_AS_PRINTED,
        ours=origin == "ours", fate=_text(entry.get("fate")),
        fate_why=in_words(_text(entry.get("fate_why"))), place=place.replace(STATEMENT, ""),
        told=worded(place_of(_text(entry.get("equation")), _text(entry.get("title")))),
        otherwise=verdict in FAILED and verdicts.get(_text(entry.get("glyph_claim"))) == "proved",
    )


def certificate_beside(entry: Mapping[str, Any]) -> str:
    """Where a claim's certificate lies as seen from the page, `certificates/PAPER/44.json`; empty where it has none."""
    parts = PurePath(_text(entry.get("certificate"))).parts
    start = max((at for at, part in enumerate(parts) if part == CERTIFICATES), default=len(parts) - 1)
    return "/".join(parts[max(start, 0):])


def anchor(claim_id: str) -> str:
    """The fragment under which a claim stands in the page."""
    return "claim-" + quote(claim_id, safe=":.")


def _text(value: object) -> str:
    return "" if value is None else value if isinstance(value, str) else str(value)


def _list(value: object) -> list[Any]:
    return list(value) if isinstance(value, list | tuple) else [] if value is None else [value]


def in_words(text: str, letters: bool = True) -> Markup:
    """A text with its letters, such as z_1 or rho_hat, as formulas."""
    return in_html(worded(text)) if letters else set_words(text)


def _assigned(value: object) -> list[str]:
    """A counterexample as LaTeX, `name = value` each; empty where its values are none of a certificate's."""
    try:
        return assignments_latex({_text(name): _text(entry) for name, entry in value.items()}) if isinstance(
            value, Mapping) else []
    except CertificateError:
        return []


def _as_typed(value: object) -> tuple[Markup, ...]:
    """A counterexample of another shape, line by line."""
    lines = [f"{_text(name)} = {_text(entry)}" for name, entry in value.items()] if isinstance(
        value, Mapping) else map(_text, _list(value))
    return tuple(map(Markup("<code>{}</code>").format, lines))

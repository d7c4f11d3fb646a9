"""The findings of a document as a page shows them; tolerant of whatever a document leaves out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from markupsafe import Markup

from workbench.files.folders import CERTIFICATES
from workbench.report.claims import VERDICTS, anchor, certificate_beside, in_words
from workbench.report.finding_sentences import IMPLIED, PRINTED
from workbench.report.formulas import formula, in_html
from workbench.report.note_links import anchors_beside, linked

# Sentences whose formulas stand on lines of their own.
TOLD_APART = (f"{PRINTED}:", f"{IMPLIED}:", "It should read", "Mended, it is proved:", "Beside it is proved:")
FOLDED = ("cosmetic", "reading")  # gravities that are told of when asked for
FATED = ("falls", "corrected", "open")  # gravities of headline statements, told with what becomes of these


@dataclass(frozen=True)
class FindingView:
    """One finding: its first sentence, the others, why it is so, its line and its correction as formulas, the command
    that re-checks it; label: whether the line is printed."""

    place: str
    anchor: str
    verdict: str
    sign: str
    sentence: Markup
    others: tuple[Markup, ...]
    note: Markup
    label: str
    printed: Markup
    should_read: Markup
    command: str


@dataclass(frozen=True)
class FindingGroup:
    """The findings of one gravity."""

    heading: str
    folded: bool
    findings: tuple[FindingView, ...]


def finding_groups(document: Mapping[str, Any]) -> list[FindingGroup]:
    """The findings of a document by gravity, in its order; without those on claims whose fate it tells."""
    groups: dict[str, list[Mapping[str, Any]]] = {}
    claims = _claims(document)
    for entry in _entries(document):
        if not _is_fated(entry, claims):
            groups.setdefault(str(entry.get("gravity")), []).append(entry)
    return [FindingGroup(str(entries[0].get("heading", gravity)), gravity in FOLDED,
                         tuple(_view(entry, claims) for entry in entries)) for gravity, entries in groups.items()]


def fated_findings(document: Mapping[str, Any]) -> dict[str, FindingView]:
    """The findings on claims whose fate a document tells, by the anchor of the claim; one that only says again why the
    fate is so has no sentence."""
    claims, found = _claims(document), {}
    for entry in _entries(document):
        if _is_fated(entry, claims):
            view = _view(entry, claims)
            found[view.anchor] = replace(view, sentence=Markup("")) if view.verdict == "proved" else view
    return found


def _entries(document: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    return [entry for entry in document.get("findings") or () if isinstance(entry, Mapping)]


def _claims(document: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    return {str(claim.get("id")): claim for claim in document.get("claims") or () if isinstance(claim, Mapping)}


def _is_fated(entry: Mapping[str, Any], claims: Mapping[str, Mapping[str, Any]]) -> bool:
    return entry.get("gravity") in FATED and bool(claims.get(f"{entry.get('paper')}:{entry.get('equation')}", {}).get(
        "fate"))


def _view(entry: Mapping[str, Any], claims: Mapping[str, Mapping[str, Any]]) -> FindingView:
    verdict, equation = str(entry.get("verdict")), str(entry.get("equation"))
    sentences = [str(s) for s in entry.get("sentences") or ("",)]
    shown = [s for s in sentences[1:] if not s.startswith(TOLD_APART)]
    digest, name = entry.get("digest"), f"{entry.get('paper')}:{equation}"
    claim = claims.get(name, {})
    certificate = certificate_beside(claim) or f"{CERTIFICATES}/{entry.get('paper')}/{equation}.json"
    anchors = anchors_beside(name, {other: anchor(other) for other in claims})
    return FindingView(
        str(entry.get("place", equation)), anchor(name), verdict,
        VERDICTS.get(verdict, "?"), in_html(sentences[0]), tuple(map(in_html, shown)),
        linked(in_words(str(claim.get("note") or "")), anchors),
        IMPLIED if entry.get("origin") == "implied" else PRINTED,
        formula(str(entry.get("printed") or "")), formula(str(entry.get("should_read") or "")),
        f"python checker.py {certificate} --claim-digest {digest}" if digest else "")

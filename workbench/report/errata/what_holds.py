"""What was proved as the paper has it, section by section."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.proof.fate import is_headline
from workbench.proof.places import place_of, places_of, section_of_place, subject_of, whole_of
from workbench.proof.verdict import FAILED, Decision
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Heading, Item, Items, Paragraph
from workbench.report.errata.chain import corrections
from workbench.report.worded import worded


def what_holds(decisions: Sequence[Decision], numbers: Mapping[str, int]) -> list[Block]:
    """The lines of the paper that are proved and rest on nothing that is not shown, by section: numbers, and of
    headline statements that stand and of lines without a number what they say; then the corrections that are of other
    parts of equations named here. numbers: of the corrections, by equation."""
    by_section: dict[str, list[Decision]] = {}
    for d in decisions:
        stands = d.fate is None or d.fate.word == "stands"
        if d.claim.origin != "ours" and d.verdict == "proved" and not d.proved_under and stands:
            by_section.setdefault(section_of_place(d.claim.equation, d.claim.section), []).append(d)
    items = [Item(f"{section[:1].upper() or 'Elsewhere'}{section[1:]}: {_named(own)}.")
             for section, own in by_section.items()]
    if not items:
        return []
    proved = {place_of(d.claim.equation) for own in by_section.values() for d in own}
    partly = [d.claim.equation for d in decisions if d.claim.equation in numbers and d.verdict in FAILED and
              (whole := whole_of(d.claim.equation, d.claim.title)) in proved and whole.startswith("Equation")]
    wholes = places_of(list(dict.fromkeys(equation.partition(".")[0] for equation in partly)))
    but = [Paragraph(f"Of {listed(wholes)} other parts fail: {corrections(partly, numbers)}.")] if partly else []
    return [Heading(2, "What holds as it stands"), Items(tuple(items)), *but]


def _named(own: Sequence[Decision]) -> str:
    numbered = [d for d in own if d.claim.equation[0].isdigit() and not is_headline(d)]
    plain = places_of([d.claim.equation for d in numbered], {d.claim.equation: _short(d) for d in numbered})
    parts: dict[str, list[str]] = {}
    for d in own:
        if d not in numbered:
            whole, subject = whole_of(d.claim.equation, d.claim.title), subject_of(d.claim.title)
            parts.setdefault(whole, []).extend([subject] if subject != whole else [])
    told = [f"{whole} ({'; '.join(subjects)})" if subjects else whole for whole, subjects in parts.items()]
    return worded("; ".join(filter(None, [listed(plain), *told])))


def _short(d: Decision) -> str:
    """The title of a part of a line; a whole one is told by its number."""
    return d.claim.title if "." in d.claim.equation else ""

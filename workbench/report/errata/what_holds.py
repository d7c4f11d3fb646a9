"""What was proved as the paper has it, section by section."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.proof.fate import is_headline
from workbench.proof.places import places_of, section_of_place, subject_of, whole_of
from workbench.proof.verdict import Decision
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Heading, Item, Items
from workbench.report.worded import worded


def what_holds(decisions: Sequence[Decision]) -> list[Block]:
    """The lines of the paper that are proved and rest on nothing that is not shown, by section: numbers, and of
    headline statements, lines without a number and steps that the text only implies what they say."""
    by_section: dict[str, list[Decision]] = {}
    for d in decisions:
        if d.claim.origin != "ours" and d.verdict == "proved" and not d.proved_under:
            by_section.setdefault(section_of_place(d.claim.equation, d.claim.section), []).append(d)
    items = [Item(f"{section[:1].upper() or 'Elsewhere'}{section[1:]}: {_named(own)}.")
             for section, own in by_section.items()]
    return [Heading(2, "What holds as it stands"), Items(tuple(items))] if items else []


def _named(own: Sequence[Decision]) -> str:
    numbered = [d for d in own if d.claim.equation[0].isdigit() and not is_headline(d)]
    implied = [d for d in numbered if d.claim.origin == "implied" and "." not in d.claim.equation]
    printed = [d for d in numbered if d not in implied]
    plain = listed(places_of([d.claim.equation for d in printed], {d.claim.equation: _short(d) for d in printed}))
    steps = listed([f"({d.claim.equation}) “{d.claim.title}”" for d in implied])
    parts: dict[str, list[str]] = {}
    for d in own:
        if d not in numbered:
            whole, subject = whole_of(d.claim.equation, d.claim.title), subject_of(d.claim.title)
            parts.setdefault(whole, []).extend([subject] if subject != whole else [])
    told = [f"{whole} ({'; '.join(subjects)})" if subjects else whole for whole, subjects in parts.items()]
    return worded("; ".join(filter(None, [plain, *told, steps and f"what the text implies at {steps}"])))


def _short(d: Decision) -> str:
    """The title of a part of a line; a whole one is told by its number."""
    return d.claim.title if "." in d.claim.equation else ""

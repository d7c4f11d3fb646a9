"""What was proved as the paper has it, section by section; apart what the text does not show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.proof.fate import is_headline
from workbench.proof.places import place_of, places_of, section_of_place, subject_of, whole_of
from workbench.proof.premises import holds_in_other_reading
from workbench.proof.verdict import FAILED, Decision
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Heading, Item, Items, Paragraph
from workbench.report.errata.chain import corrections
from workbench.report.worded import worded


def what_holds(decisions: Sequence[Decision], numbers: Mapping[str, int]) -> list[Block]:
    """The lines of the paper that are proved and rest on nothing that is not shown, by section: numbers, and of
    headline statements, lines without a number and steps that the text only implies what they say. Those to which the
    text comes through a line that fails stand apart; headline statements that stand only with corrections are told
    before. Then the corrections that are of other parts of equations named here. numbers: of the corrections, by
    equation."""
    by_id = {d.claim.id: d for d in decisions}
    proved = [d for d in decisions if d.claim.origin != "ours" and d.verdict == "proved" and not d.proved_under]
    through = [d for d in proved if not all(holds_in_other_reading(by_id[name], by_id) for name in d.tainted_by)]
    stands = [d for d in proved if d not in through and (d.fate is None or d.fate.word == "stands")]
    behind = [d for d in through if not is_headline(d)]
    groups = {"What holds as it stands": stands,
              "What holds, though the text comes to it through lines that fail": behind}
    found: list[list[Block]] = [[Heading(2, heading), Items(_by_section(own))]
                                for heading, own in groups.items() if own]
    if stands and found:
        found[0] += _other_parts(decisions, stands, numbers)
    return [block for blocks in found for block in blocks]


def _other_parts(decisions: Sequence[Decision], proved: Sequence[Decision], numbers: Mapping[str, int]) -> list[Block]:
    """Of which equations that hold other parts fail, with these corrections."""
    places = {place_of(d.claim.equation) for d in proved}
    partly = [d.claim.equation for d in decisions if d.claim.equation in numbers and d.verdict in FAILED and
              (whole := whole_of(d.claim.equation, d.claim.title)) in places and whole.startswith("Equation")]
    wholes = places_of(list(dict.fromkeys(equation.partition(".")[0] for equation in partly)))
    return [Paragraph(f"Of {listed(wholes)} other parts fail: {corrections(partly, numbers)}.")] if partly else []


def _by_section(proved: Sequence[Decision]) -> tuple[Item, ...]:
    found: dict[str, list[Decision]] = {}
    for d in proved:
        found.setdefault(section_of_place(d.claim.equation, d.claim.section), []).append(d)
    return tuple(Item(f"{section[:1].upper() or 'Elsewhere'}{section[1:]}: {_named(own)}.")
                 for section, own in found.items())


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

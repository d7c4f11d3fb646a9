"""Which of the lines that fail are causes: they fail by themselves, and others rest on them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from workbench.proof.verdict import FAILED, Decision
from workbench.report.finding import GRAVITIES, Finding

_NAME = re.compile(r"[A-Za-z_]\w*")

Cause = tuple[Finding, ...]


def causes_of(found: Sequence[Finding], decisions: Sequence[Decision]) -> list[Cause]:
    """The causes of a paper, the gravest first: by the headline statements that rest on it, what is false before what
    does not follow, then by other lines. A line and those that say the same in other letters are one cause.

    A line that holds in another reading of the text is none, nor is one of which nothing depends. Empty where no line
    falls with another one.
    """
    goals = {d.claim.equation: _form(d.certificate) for d in decisions}
    if not any({*f.because} - {*f.otherwise} for f in found if f.gravity != "reading"):
        return []
    groups: dict[object, list[Finding]] = {}
    for f in _numbered(found):
        if f.verdict in FAILED and f.alone and f.gravity != "cosmetic" and (f.headlines or f.lines):
            groups.setdefault(goals[f.equation] or f.equation, []).append(f)
    by_weight = sorted(groups.values(), key=lambda group: (
        -len(group[0].headlines), group[0].verdict == "gap", -group[0].lines))
    return [tuple(group) for group in by_weight]


def correction_numbers(found: Sequence[Finding], causes: Sequence[Cause]) -> dict[str, int]:
    """The number of each correction, by the equation of its line: causes first; readings have none."""
    first = [f.equation for cause in causes for f in cause]
    told = [*first, *(f.equation for f in _numbered(found) if f.equation not in first)]
    return {equation: number for number, equation in enumerate(told, 1)}


def _numbered(found: Sequence[Finding]) -> list[Finding]:
    """What has a number, the gravest first."""
    return [f for gravity in GRAVITIES if gravity != "reading" for f in found if f.gravity == gravity]


def _form(certificate: Mapping[str, Any] | None) -> str:
    """What a goal says whatever its letters are called: they are counted as they come; empty without a goal."""
    goal = (certificate or {}).get("goal")
    if goal is None:
        return ""
    stated = [*goal["show"], *(f"{name} moves by {rate}" for name, rate in goal.get("flow", {}).items()),
              *goal.get("assume", []), *goal.get("always", [])]
    letters: dict[str, int] = {}
    return _NAME.sub(lambda name: f"<{letters.setdefault(name[0], len(letters))}>", "; ".join(stated))

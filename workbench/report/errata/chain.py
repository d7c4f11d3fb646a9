"""What rests on a line that fails, and what it rests on, in sentences that name corrections by their numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby

from workbench.proof.fate import is_headline
from workbench.proof.places import places_of
from workbench.proof.verdict import Decision
from workbench.proof.wording import listed
from workbench.report.finding import Finding
from workbench.report.worded import worded

NAMED = 5  # lines up to which each is named
_PLURAL = re.compile(r"(?:\d+ |the )?[A-Za-z]+s\b")  # Theorems 2 and 3, 12 lines, the figures


def resting_lines(decisions: Sequence[Decision], found: Sequence[Finding]) -> dict[str, list[str]]:
    """The equations of the lines that rest on each failing one and are no headline statements, by its equation; without
    those that fail whether it holds or not."""
    kept = {f.equation: f.kept for f in found}
    resting: dict[str, list[str]] = {}
    for d in decisions:
        if d.claim.origin != "ours" and not is_headline(d):
            for name in d.tainted_by:
                equation = name.partition(":")[2]
                if equation not in kept.get(d.claim.equation, ()):
                    resting.setdefault(equation, []).append(d.claim.equation)
    return resting


def consequence(found: Finding, numbers: Mapping[str, int], lines: Sequence[str], titles: Mapping[str, str]) -> str:
    """What rests on a line, and on what that fails it rests; empty where neither is. numbers: of the corrections, by
    equation; lines: those that rest on it and are no headline statements."""
    resting = [worded(place) for place in places_of(found.headlines, titles)]
    about = corrections(found.headlines, numbers)
    if resting and about:
        resting[-1] += f" ({about})"
    if len(lines) <= NAMED:
        resting += [worded(place) for place in places_of(lines, titles)]
    else:
        resting.append(f"{len(lines)} {'other ' if resting else ''}lines")
    one = len(resting) == 1 and not _PLURAL.match(resting[0])  # Theorem 1 is one, whatever lines it has
    text = f"{listed(resting)} rest{'s' if one else ''} on it." if resting else ""
    if found.gravity != "corrected":
        text = f"{text} {_way(found, numbers)}".strip()
    return text[:1].upper() + text[1:]


def _way(found: Finding, numbers: Mapping[str, int]) -> str:
    """On which lines that fail it rests in the text, or that it fails by itself."""
    failing = [line for line in found.because if line not in {*found.otherwise, *found.kept}]
    if not failing:
        kept = corrections(found.kept, numbers)
        one = len(found.kept) == 1
        return (f"It fails by itself: at its counterexample what {kept} find{'' if not one else 's'} fault with holds."
                if found.alone and kept else "")
    if len(failing) > NAMED:
        return f"In the text it rests on lines that fail ({corrections(failing, numbers)})."
    about = corrections(failing, numbers)
    named = worded(listed(places_of(failing, found.titles)))
    return (f"In the text it rests on {named}{f' ({about})' if about else ''}, which "
            f"{'fails' if len(failing) == 1 else 'fail'}.")


def corrections(equations: Iterable[str], numbers: Mapping[str, int]) -> str:
    """`correction 3`, `corrections 1, 4 to 7 and 9`; empty where none of the lines has one."""
    told = sorted({numbers[equation] for equation in equations if equation in numbers})
    runs = [[number for _, number in run] for _, run in groupby(enumerate(told), lambda pair: pair[1] - pair[0])]
    words = [word for run in runs for word in ([f"{run[0]} to {run[-1]}"] if len(run) > 2 else map(str, run))]
    return f"correction{'s' if len(told) > 1 else ''} {listed(words)}" if told else ""

"""How a reader of the paper calls its lines."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from workbench.proof.places import place_of
from workbench.proof.verdict import Decision
from workbench.proof.wording import listed
from workbench.report.worded import worded

_RATE = re.compile(r"\bD\((\w+)\)")


def noted(note: str, titles: Mapping[str, str]) -> str:
    """A note with the lines that it names as a reader of the paper calls them, and rates in words: 51.whole and D(V)
    are names of ours alone."""
    note = _RATE.sub(lambda found: f"{'The' if found.start() == 0 else 'the'} rate of {found[1]}", note)
    told = _line_names(titles)
    if told is None:
        return worded(note)
    return worded(told.sub(lambda found: _in_sentence(place_of(found[0], titles[found[0]])), note))


def lines_named(note: str, titles: Mapping[str, str]) -> list[str]:
    """The equations of the lines that a note names in ways of ours alone."""
    told = _line_names(titles)
    return [] if told is None else told.findall(note)


def _line_names(titles: Mapping[str, str]) -> re.Pattern[str] | None:
    names = [name for name in titles if not name.isdigit() and ("." in name or name[-1].isdigit())]
    if not names:
        return None
    return re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, sorted(names, key=len, reverse=True)))})(?!\.?\w)")


def _in_sentence(place: str) -> str:
    """The name of a line where no sentence begins with it."""
    small = ("Equation", "The ")
    return place[0].lower() + place[1:] if place.startswith(small) else place


def listed_lines(names: Sequence[str]) -> str:
    """The names of lines at the beginning of a sentence."""
    return listed([*names[:1], *map(_in_sentence, names[1:])])


def name_of_line(d: Decision) -> str:
    """The name of a line, its part told by what it says."""
    return worded(place_of(d.claim.equation, d.claim.title))

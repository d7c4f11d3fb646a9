"""What is known of a displayed formula: what it says, and what the text around it lets be decided of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Standing:
    """What is known of a display.

    form: as `Reading.shown` says. unread: why nothing is claimed of it or taken from it, a line each; named: why it is
    not claimed, as sentences elsewhere that name it may take it back. doubts: why it is not refuted: what may restrict
    its letters. contested: of its letters those of which something is said there that is not understood, each with that
    sentence, empty where the text gives it twice; signed: those
    of which a sign is said. tied: whether it is said of some values alone. letters: those that it is made of.
    otherwise: what is said elsewhere by which it may mean something else, so that it is not proved. given: of its
    letters those that get a value somewhere; natural: those that may have a sign by what they are called, each with
    the sentence that does so.
    """

    form: str
    unread: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    contested: Mapping[str, str] = field(default_factory=dict)
    signed: frozenset[str] = frozenset()
    tied: bool = False
    letters: frozenset[str] = frozenset()
    otherwise: tuple[str, ...] = ()
    given: frozenset[str] = frozenset()
    natural: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Shown:
    """What a display says: its letters, the letters that it gives values or rates, with those, and nothing else; and
    how it is printed."""

    letters: frozenset[str]
    gives: Mapping[str, str]
    printed: str = ""

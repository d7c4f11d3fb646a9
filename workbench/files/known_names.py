"""What a name that is none of the known ones may have been meant to be."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def one_of(asked: str, known: Iterable[str]) -> str:
    """As a remedy: the known name that is nearly the one asked for, and all of them."""
    names = list(known)
    close = get_close_matches(asked, names, n=1)
    return (f"did you mean '{close[0]}'? Else " if close else "") + f"choose one of {', '.join(names)}"

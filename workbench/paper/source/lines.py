"""Which lines of a displayed formula are one."""

from __future__ import annotations

import re

_SIGN = r"(?:[=<>+\-/]|\\(?:leq?|geq?|leqslant|geqslant|cdot|times|in|pm|quad|qquad|Rightarrow|implies)(?![A-Za-z]))"
_AT_START, _AT_END = re.compile(_SIGN), re.compile(rf"{_SIGN}$")


def goes_on(first: str, second: str) -> bool:
    """Whether a line goes on in the next one: by a sign at its end or at the start of that, or by an open bracket."""
    return bool(_AT_START.match(second) or _AT_END.search(first)) or any(
        first.count(one) > first.count(other) for one, other in ("()", "[]", "{}"))

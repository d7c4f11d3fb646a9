"""What is wrong with the value of an option, in plain words."""

from __future__ import annotations

import re

_VALUE = re.compile(r"Invalid value for '([^']+)': Input should be (.+)", re.DOTALL)
_SAID = ((re.compile(r"a valid number.*", re.DOTALL), "is no number: give one such as 2600 or 0.5"),
         (re.compile(r"a valid integer.*", re.DOTALL), "is no whole number: give one such as 10"),
         (re.compile(r"greater than or equal to (\S+)"), r"is too small: give \1 or more"),
         (re.compile(r"less than or equal to (\S+)"), r"is too large: give \1 or less"))


def in_plain_words(message: str) -> str:
    """The option and what to give, where the message is of the library that reads numbers; else the message."""
    found = _VALUE.fullmatch(message)
    for pattern, words in _SAID if found else ():
        if found and (said := pattern.fullmatch(found[2])):
            return f"{found[1]} {said.expand(words)}"
    return message

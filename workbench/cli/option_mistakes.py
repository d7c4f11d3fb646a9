"""What is wrong with the value of an option, in plain words."""

from __future__ import annotations

import re

from workbench.files.known_names import one_of

_VALUE = re.compile(r"Invalid value for '([^']+)': Input should be (.+)", re.DOTALL)
_SAID = ((re.compile(r"a valid number.*", re.DOTALL), "is no number: give one such as 2600 or 0.5"),
         (re.compile(r"a valid integer.*", re.DOTALL), "is no whole number: give one such as 10"),
         (re.compile(r"greater than or equal to (\S+)"), r"is too small: give \1 or more"),
         (re.compile(r"less than or equal to (\S+)"), r"is too large: give \1 or less"))


_CHOICE = re.compile(r"Invalid value for '([^']+)': Value error, '(.*)' is not one of (.+)", re.DOTALL)
_QUOTED = re.compile("'([^']+)'")
_NO_OPTION = re.compile(r"No such option: (\S+) \(Possible options: ([^)]*)\)")


def in_plain_words(message: str) -> str:
    """The option and what to give, where the message is of the libraries that read options; else the message."""
    if none := _CHOICE.fullmatch(message):
        return f"{none[1]} has no value '{none[2]}': {one_of(none[2], re.findall(_QUOTED, none[3]))}"
    if unknown := _NO_OPTION.fullmatch(message):
        return f"no such option {unknown[1]}: {one_of(unknown[1], unknown[2].split(', '))}"
    found = _VALUE.fullmatch(message)
    for pattern, words in _SAID if found else ():
        if found and (said := pattern.fullmatch(found[2])):
            return f"{found[1]} {said.expand(words)}"
    return message

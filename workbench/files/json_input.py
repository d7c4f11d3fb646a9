"""A JSON file as a table; whatever is wrong with it becomes one line naming the file."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.text import read_text

# TTOBench nests five deep. What is much deeper was not written by hand, and would exhaust whoever prints it.
DEEPEST = 40
_STRING_OR_CONSTANT = re.compile(r'"(?:[^"\\]|\\.)*"|(NaN|-?Infinity)')


def read_json(path: Path) -> dict[str, Any]:
    """The object in a JSON file; raises InputError when it is missing, unreadable or not one JSON object."""
    text = read_text(path, "JSON")
    try:
        data = json.loads(text, object_pairs_hook=_unique, parse_float=_finite, parse_constant=_no_number)
    except InputError as trouble:
        raise trouble.within(path) from None
    except _ConstantError as trouble:
        where = next(found.start(1) for found in _STRING_OR_CONSTANT.finditer(text) if found[1])
        raise InputError(path, f"line {text.count(chr(10), 0, where) + 1}",
                         f"{trouble} is no number of JSON: give a number") from None
    except ValueError as trouble:  # JSONDecodeError, and Python's own limit on the digits of an integer
        raise InputError(path, "", f"is not valid JSON: {trouble}: correct it there") from None
    except RecursionError:
        raise InputError(path, "", "is nested too deeply: write flatter lists") from None
    if not isinstance(data, dict):
        raise InputError(path, "", "is no JSON object: it must be one table in braces")
    level: list[Any] = [data]
    for _ in range(DEEPEST):
        level = [child for item in level if isinstance(item, dict | list)
                 for child in (item.values() if isinstance(item, dict) else item)]
    if level:
        raise InputError(path, "", "is nested too deeply: write flatter lists")
    return data


def _finite(text: str) -> float:
    found = float(text)
    if math.isinf(found):
        raise ValueError(f"{text[:60]} is too large a number")
    return found


class _ConstantError(Exception):
    """NaN or an infinity, which Python's parser reads and JSON has not."""


def _no_number(text: str) -> float:
    raise _ConstantError(text)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise InputError("", key[:60], "stands twice in one table: remove one")
        found[key] = value
    return found

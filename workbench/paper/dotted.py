"""Values of a study by dotted keys: of fields, names in tables, and places in rows counted from 0."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel


def value_at(record: Any, key: str) -> Any:
    """What stands at a key, `gains.k_1.9` for instance."""
    for part in key.split("."):
        record = _part(record, part)
    return record


def with_value_at(record: Any, key: str, value: Any) -> Any:
    """The record with another value at a key; as given, since a search checks none of the values that it tries."""
    first, _, rest = key.partition(".")
    value = with_value_at(_part(record, first), rest, value) if rest else value
    if isinstance(record, BaseModel):
        return record.model_copy(update={first: value})
    if isinstance(record, tuple):
        place = int(first)
        return (*record[:place], value, *record[place + 1 :])
    return {**record, first: value}


def _part(record: Any, part: str) -> Any:
    if isinstance(record, tuple):
        return record[int(part)]
    return record[part] if isinstance(record, Mapping) else getattr(record, part)

"""Where every value of a scenario or a study comes from: the paper, a convention, or an assumption."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from pydantic import BaseModel

from workbench.files.numbers import NOTHING, counted, exact
from workbench.files.toml import FileRecord, SourcedRecord

_UNIT = re.compile(r"(?<=m/s)\^([23])(?!\d)")
_RAISED = {"2": "²", "3": "³"}


@dataclass(frozen=True)
class SourcedValue:
    """One stated value: dotted key, the value as text, kind ('paper', 'assumed', 'convention'), the words."""

    key: str
    value: str
    kind: str
    words: str


def sourced_values(record: BaseModel) -> list[SourcedValue]:
    """All values that state a source, in the record's order; nested records count by their own entries."""
    return list(_walk(record, ""))


def _walk(record: BaseModel, prefix: str) -> Iterator[SourcedValue]:
    for name in _in_order(record):
        value, key = getattr(record, name), f"{prefix}{name}"
        source = record.source.get(name) if isinstance(record, SourcedRecord) else None
        if source is not None and not isinstance(value, SourcedRecord):
            kind, _, words = source.partition(":")
            if kind not in ("assumed", "convention"):
                kind, words = "paper", source.removeprefix("paper").lstrip(" ,:")
            yield SourcedValue(key, stated(value), kind, _UNIT.sub(lambda found: _RAISED[found[1]], words.strip()))
        if isinstance(value, BaseModel):
            yield from _walk(value, f"{key}.")
        elif isinstance(value, Mapping):
            for inner, entry in value.items():
                if isinstance(entry, BaseModel):
                    yield from _walk(entry, f"{key}.{inner}.")
        elif isinstance(value, tuple):
            for place, entry in enumerate(value):
                if isinstance(entry, BaseModel):
                    yield from _walk(entry, f"{key}[{place}].")


def _in_order(record: BaseModel) -> list[str]:
    """The names of a record's values; in a file its own come before those that every file of its kind may state."""
    own = type(record).__annotations__ if isinstance(record, FileRecord) else type(record).model_fields
    return sorted(type(record).model_fields, key=lambda name: name not in own)


def stated(value: object) -> str:
    """A stated value as a short text: numbers as they were written, sections of a line by their count."""
    text = NOTHING if value is None else str(value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        text = exact(value)
    elif isinstance(value, Mapping):
        entries = [f"{name} = {stated(entry)}" if not isinstance(entry, Mapping) else f"{name} = ({stated(entry)})"
                   for name, entry in value.items()]
        text = ", ".join(entries)
    elif isinstance(value, tuple | list) and value and isinstance(value[0], BaseModel):
        text = counted(len(value), "section")
    elif isinstance(value, tuple | list):
        text = ", ".join(stated(entry) for entry in value) or NOTHING
    return text

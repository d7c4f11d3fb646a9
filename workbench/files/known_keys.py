"""Which keys a record's tables have, so that a key that is none of them is told what it may have been meant to be."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel

CLOSE = 0.75  # how alike two keys are of which one may be the other, mistyped


def meant(model: type[BaseModel], location: Sequence[str | int]) -> str:
    """What an unknown key at a place of a record may have been meant to be, as a remedy; empty where nothing is near.

    A key of a table within the same one, such as `sensing.noise` for `noise`, comes first, then a key like it.
    """
    schema = model.model_json_schema()
    *parents, name = [part for part in location if part != "[key]"]
    tables = [schema]
    for part in parents:
        tables = [child for table in tables for child in _children(schema, table, part)]
    within = {f"{key}.{name}" for table in tables for key, child in table.get("properties", {}).items()
              for inner in _tables(schema, child) if name in inner.get("properties", {})}
    if within:
        return f"state it as {' or '.join(sorted(within))}"
    known = sorted({key for table in tables for key in table.get("properties", {})})
    close = difflib.get_close_matches(str(name), known, n=1, cutoff=CLOSE)
    return f"did you mean '{close[0]}'?" if close else ""


def _children(schema: dict[str, Any], table: dict[str, Any], part: str | int) -> Iterator[dict[str, Any]]:
    """The tables that may stand in a table under a key, or in its list; a union's kind, which no file has, is none."""
    if isinstance(part, int):
        yield from _tables(schema, table.get("items", {}))
        return
    named = table.get("properties", {}).get(part)
    others = (*table.get("patternProperties", {}).values(), table.get("additionalProperties"))
    found = [one for one in ([named] if named else others) if isinstance(one, dict)]
    for one in found:
        yield from _tables(schema, one)
    if not found:
        yield table


def _tables(schema: dict[str, Any], stated: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """What a part of a schema may be, references and unions resolved."""
    if "$ref" in stated:
        yield from _tables(schema, schema["$defs"][stated["$ref"].rsplit("/", 1)[1]])
        return
    unions = [option for word in ("anyOf", "oneOf", "allOf") for option in stated.get(word, ())]
    for option in unions:
        yield from _tables(schema, option)
    if not unions:
        yield stated

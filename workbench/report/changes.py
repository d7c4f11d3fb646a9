"""What changed between two documents of `workbench prove --json`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError, in_one_line
from workbench.files.json_input import read_json

# What is told of a claim, in this order; the rest (seconds, method, certificate's path) may differ from run to run.
FIELDS = ("statement", "verdict", "fate", "goal_digest", "correction", "counterexample", "tainted_by",
          "proved_under", "origin", "severity", "trust", "recorded")
Claims = dict[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Change:
    """A claim that differs: what is `new`, `gone` or `changed` of it, and the fields that do, before and after."""

    id: str
    what: str
    fields: tuple[tuple[str, Any, Any], ...] = ()

    def sentence(self) -> str:
        """The change in one line; long texts are only named."""
        if self.what != "changed":
            return f"{in_one_line(self.id)}: {self.what}"
        return f"{in_one_line(self.id)}: " + ", ".join(in_one_line(_told(*field)) for field in self.fields)


def _told(name: str, before: Any, after: Any) -> str:
    if name in ("verdict", "fate", "origin", "severity", "trust", "recorded"):
        return f"{name} {before or 'none'} -> {after or 'none'}"
    if name == "tainted_by":
        gone, new = sorted(set(before or ()) - set(after or ())), sorted(set(after or ()) - set(before or ()))
        return "; ".join([*(f"no longer rests on failed {i}" for i in gone), *(f"rests on failed {i}" for i in new)])
    return {"statement": "another printed line", "goal_digest": "another goal"}.get(name, f"another {name}")


def read_claims(path: Path) -> Claims:
    """The claims of a document by id. Raises InputError for what is no document of `workbench prove --json`."""
    document = read_json(path)
    rows = document.get("claims") if isinstance(document, Mapping) else None
    if not isinstance(rows, list) or not all(isinstance(row, Mapping) and isinstance(row.get("id"), str)
                                             for row in rows):
        raise InputError(path, "claims", "is no document of 'workbench prove --json': name one")
    for number, row in enumerate(rows):
        tainted_by = row.get("tainted_by") or []
        if not isinstance(tainted_by, list) or not all(isinstance(one, str) for one in tainted_by):
            raise InputError(path, f"claims[{number}].tainted_by", "is no list of claims: name a document of "
                             "'workbench prove --json'")
    return {row["id"]: row for row in rows}


def changes(before: Claims, after: Claims) -> list[Change]:
    """Every claim that is new, gone or changed, in the order of the later document. A field that one of the documents
    does not have is not compared."""
    found = []
    for name in [*after, *(name for name in before if name not in after)]:
        if name not in before or name not in after:
            found.append(Change(name, "new" if name in after else "gone"))
            continue
        old, new = before[name], after[name]
        fields = tuple((field, old[field], new[field]) for field in FIELDS
                       if field in old and field in new and old[field] != new[field])
        if fields:
            found.append(Change(name, "changed", fields))
    return found


def changes_document(found: list[Change]) -> dict[str, Any]:
    """The document of `workbench diff --json`."""
    return {"version": 1, "changes": [asdict(change) for change in found]}

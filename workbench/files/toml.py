"""Read a TOML file into a validated record; whatever is wrong becomes one line naming file and key."""

from __future__ import annotations

import copy
import difflib
import re
import tomllib
from collections.abc import Iterator
from datetime import date, time
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    PrivateAttr,
    Strict,
    ValidationError,
    ValidationInfo,
    model_validator,
)

from workbench.errors import InputError
from workbench.files.known_keys import meant
from workbench.files.text import CHECK_PATH, named_by, read_text

# A number between bounds is declared `mass_kg: Number = Field(ge=1e3, le=1e8)`, a whole one `Whole` likewise.
Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]
Positive = Annotated[float, Strict(), Field(gt=0, allow_inf_nan=False)]
NonNegative = Annotated[float, Strict(), Field(ge=0, allow_inf_nan=False)]
# What is late is remembered sample by sample; beyond a minute nobody closes a loop.
Lateness = Annotated[float, Strict(), Field(ge=0, le=60, allow_inf_nan=False)]
Whole = Annotated[int, Strict()]
Count = Annotated[int, Strict(), Field(ge=1)]
Text = Annotated[str, Strict(), Field(min_length=1)]


def _no_number(name: str) -> str:
    if name in ("nan", "inf"):
        raise ValueError(f"'{name}' stands for a number that is none, in tables too: choose another name")
    return name


# Names become file names and columns of tables.
Name = Annotated[str, Strict(), Field(pattern=r"^[A-Za-z][A-Za-z0-9_.-]*$", max_length=100), AfterValidator(_no_number)]


LARGEST_INTEGER = 2**63 - 1  # that TOML asks its readers to know
# Of a file, and of a dotted key.
MOST_TABLES, MOST_PARTS = 50_000, 200
_PART = re.compile(r"""[\w\s"'-]*""")

# The key of a file by which it reproduces a paper, so that every value must have its source.
REPRODUCTION = "reproduction"
# So many further mistakes are named beside the first.
MOST_NAMED = 3


class Record(BaseModel):
    """A frozen record; unknown keys, NaN and infinities are refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class FileRecord(Record):
    """A record that a whole file makes, which knows where the file lies; a copy of it does too."""

    _folder: Path = PrivateAttr(default=Path())

    @property
    def folder(self) -> Path:
        """Where the file lies: what it names is looked up from there."""
        return self._folder

    def in_folder(self, folder: Path) -> Self:
        """The same record as if its file lay in a folder."""
        found = self.model_copy()
        found._folder = folder
        return found


def _or_one_for_all(schema: dict[str, Any]) -> None:
    """Into the schema of `source`, that one text may stand for all."""
    schema |= {"type": ["object", "string"], "minLength": 1}


class SourcedRecord(Record):
    """A record whose stated values may say where they come from, in its own `source` table.

    `source = "paper, Table 1"` says it of all values of the record at once.
    In a file that says `reproduction = true` every one must, and starts with `paper`, `assumed:` or `convention:`; the
    report lists the assumed ones. NO_VALUES: the fields that say nothing of the subject and so come from nowhere.
    """

    NO_VALUES: ClassVar[frozenset[str]] = frozenset({"source"})
    source: dict[str, Text] = Field(default_factory=dict, json_schema_extra=_or_one_for_all)

    @model_validator(mode="before")
    @classmethod
    def _one_source_for_all(cls, data: Any) -> Any:
        if isinstance(data, dict) and isinstance(data.get("source"), str):
            return data | {"source": {key: data["source"] for key in data if key not in cls.NO_VALUES}}
        return data

    @model_validator(mode="after")
    def _every_value_has_a_source(self, info: ValidationInfo) -> Self:
        stated = self.model_fields_set - self.NO_VALUES
        strict = bool((info.context or {}).get(REPRODUCTION))
        for key in sorted(stated - self.source.keys()) if strict else ():
            raise ValueError(f"source.{key} is missing: say where the value of '{key}' comes from")
        for key in sorted(self.source.keys() - stated):
            raise ValueError(f"source.{key} explains a value that is not stated: remove it or state '{key}'")
        for key, text in self.source.items() if strict else ():
            if not text.startswith(("paper", "assumed:", "convention:")):
                raise ValueError(
                    f"source.{key} = '{text}' must start with 'paper', 'assumed:' or 'convention:'"
                )
        return self


R = TypeVar("R", bound=BaseModel)


# A paper's claims take their numbers from the file that the command line has read already: it is opened once.
_tables: dict[tuple[str, int, int, int], dict[str, Any]] = {}


def read_toml(path: Path, where: str = CHECK_PATH) -> dict[str, Any]:
    """The table in a TOML file, read once as long as it does not change; InputError when it is missing, unreadable or
    not TOML. where: what to do when there is no such file."""
    try:
        status = path.stat()
        key = str(path.resolve()), status.st_ino, status.st_mtime_ns, status.st_size
    except (OSError, ValueError):  # what is wrong is for the reader to say
        return _table(path, where)
    if key not in _tables:
        _tables[key] = _table(path, where)
    return copy.deepcopy(_tables[key])


def _table(path: Path, where: str) -> dict[str, Any]:
    text = read_text(path, "TOML", where)
    if not text.strip():
        raise InputError(path, "", f"is empty: a TOML table is expected{named_by(where)}")
    _require_quick(path, text)
    try:
        table = tomllib.loads(text)
        integers = list(_integers(table, ""))
    except ValueError as trouble:  # TOMLDecodeError, and Python's own limit on the digits of an integer
        other = "" if path.suffix == ".toml" else ": a file whose name ends with .toml is expected"
        raise InputError(path, "", f"is not valid TOML: {trouble}{other}{named_by(where)}") from None
    except RecursionError:
        raise InputError(path, "", f"is nested too deeply: write flatter tables{named_by(where)}") from None
    for key, number in integers:
        if abs(number) > LARGEST_INTEGER:
            raise InputError(path, key, "is a whole number beyond 64 bits: give a finite number that fits, or a float")
    return table


def _require_quick(path: Path, text: str) -> None:
    """InputError for what takes the parser minutes: keys of thousands of parts, and tables by the hundred thousand."""
    lines = text.splitlines()
    if sum(line.lstrip().startswith("[") for line in lines) > MOST_TABLES:
        raise InputError(path, "", f"has more than {MOST_TABLES} tables: put data into a CSV file")
    for number, line in enumerate(lines):
        run = 0
        for piece in line.split(".") if line.count(".") > MOST_PARTS else ():
            run = run + 1 if _PART.fullmatch(piece) else 0
            if run > MOST_PARTS:
                raise InputError(path, f"line {number + 1}", "is nested too deeply: write flatter tables")


def _integers(value: Any, key: str) -> Iterator[tuple[str, int]]:
    """All whole numbers in a table, at any depth, each with its dotted key."""
    if isinstance(value, int):
        yield key, value
    elif isinstance(value, dict):
        for name, child in value.items():
            yield from _integers(child, f"{key}.{name}" if key else name)
    elif isinstance(value, list):
        for number, child in enumerate(value):
            yield from _integers(child, f"{key}[{number}]")


def load_record(path: Path, model: type[R], reproduction: bool = False, where: str = CHECK_PATH) -> R:
    """Read `path` as a `model`; raises InputError naming the file, the first wrong key and the remedy. where: as for
    `read_toml`."""
    return validate_record(read_toml(path, where), model, path, reproduction)


def validate_record(data: dict[str, Any], model: type[R], where: Path | str, reproduction: bool = False) -> R:
    """Validate a table as a `model`; `where` is the file named in the InputError; reproduction: every value of it must
    have its source, as also where the table itself says so."""
    strict = reproduction or data.get(REPRODUCTION) is True
    try:
        return model.model_validate(data, context={REPRODUCTION: strict})
    except ValidationError as trouble:
        raise InputError(where, *mistake(trouble, data, model)) from None


def mistake(trouble: ValidationError, data: dict[str, Any], model: type[BaseModel] | None = None) -> tuple[str, str]:
    """The first wrong key of what made a record, and in one line what is wrong with it and how many more there are."""
    errors = _of_one_member([dict(error) for error in trouble.errors()], data)
    # A mistyped key shows up twice, as unknown and as missing: the unknown one is what to mend.
    first = next((e for e in errors if e["type"] == "extra_forbidden"), errors[0])
    others = list(dict.fromkeys(_key(error, data) for error in errors if error is not first))
    more = f" (and {len(errors) - 1} more: {', '.join(others[:MOST_NAMED])}" + (
        ", ...)" if len(others) > MOST_NAMED else ")") if others else ""
    return _key(first, data), _explain(first, errors, model) + more


def _of_one_member(errors: list[dict[str, Any]], data: Any) -> list[dict[str, Any]]:
    """The errors without those of whole numbers where the same place may hold other numbers, and is told of these."""
    for error in errors:
        if error["type"] in ("int_type", "int_from_float") and any(
                other["loc"] != error["loc"] and _key(other, data) == _key(error, data) for other in errors):
            return [other for other in errors if other["loc"][:-1] != error["loc"][:-1]]
    return errors


def _key(error: dict[str, Any], data: Any) -> str:
    """The dotted key as the file writes it: pydantic adds the kind of a union's member, which no file has."""
    parts: list[str] = []
    location = [part for part in error["loc"] if part != "[key]"]
    table = data
    for number, part in enumerate(location):
        if isinstance(part, int):
            parts[-1:] = [f"{parts[-1] if parts else ''}[{part}]"]
            table = table[part] if isinstance(table, list | tuple) and part < len(table) else None
            continue
        absent = table is not None and not (isinstance(table, dict) and part in table) and not (
            isinstance(table, str) and parts[-1:] == ["source"])
        if absent and not (error["type"] == "missing" and number == len(location) - 1):
            continue
        if _is_kind(location[number:], table, error["type"] == "missing"):
            continue
        parts.append(str(part))
        table = table.get(part) if isinstance(table, dict) else None
    return ".".join(parts)


def _is_kind(location: list[Any], table: Any, is_missing: bool) -> bool:
    """Whether a part of a location is the kind of a union's member, though the table has a key of that name: what comes
    after it is a key of the same table, or the one that is missing there."""
    if not isinstance(table, dict) or len(location) < 2 or isinstance(table.get(location[0]), dict | list | tuple):
        return False
    if location[0] == "source":  # one text that stands for those of all values
        return False
    return location[1] in table or (is_missing and len(location) == 2)


def _short(value: Any, limit: int = 60) -> str:
    try:
        text = repr(value)
    except ValueError:  # an integer of more digits than Python prints
        return "so large an integer"
    return text if len(text) <= limit else f"{text[:limit]}..."


def _unknown_key(error: dict[str, Any], errors: list[Any], model: type[BaseModel] | None) -> str:
    parent = error["loc"][:-1]
    missing = [str(e["loc"][-1]) for e in errors if e["type"] == "missing" and e["loc"][:-1] == parent]
    name = str(error["loc"][-1])
    stem = name.split("_", 1)[0]
    close = difflib.get_close_matches(name, missing, n=1, cutoff=0.5)
    close = close or difflib.get_close_matches(name, ["source"], cutoff=0.8)  # which may stand with every value
    close = close or [other for other in missing if other.split("_", 1)[0] == stem]
    if close:
        return f"unknown key; did you mean '{close[0]}' (the unit is part of the name)?"
    if model is not None and (remedy := meant(model, error["loc"])):
        return f"unknown key: {remedy}"
    lacking = f"; {', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing" if missing else ""
    return f"unknown key: remove it or correct its spelling{lacking}"


def _explain(error: dict[str, Any], errors: list[Any], model: type[BaseModel] | None) -> str:
    value, message = error.get("input"), str(error["msg"])
    match error["type"]:
        case "extra_forbidden":
            return _unknown_key(error, errors, model)
        case "missing":
            explained = "is missing: add it"
        case "value_error":
            explained = message.removeprefix("Value error, ")
        case "union_tag_invalid":
            of = error["ctx"]
            explained = f"{of['discriminator']} = {_short(of['tag'])} is not known: choose one of {of['expected_tags']}"
        case "string_pattern_mismatch":
            explained = f"{_short(value)} is no name: use letters, digits, '_', '-', '.', a letter first"
        case "finite_number":
            explained = f"{value} is not a finite number: give a number"
        case _ if isinstance(value, (date, time)):  # as TOML reads 00:01:20; a moment is a date
            explained = f"{value.isoformat()} is a time of day or a date: give a number in the unit that the key names"
        case _:
            explained = f"{message[0].lower()}{message[1:]}, not {_short(value)}: correct it"
    return explained

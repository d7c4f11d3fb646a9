"""Read a TOML file into a validated record; whatever is wrong becomes one line naming file and key."""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path
from typing import Annotated, Any, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, Strict, ValidationError, model_validator

from workbench.errors import InputError

Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]
Positive = Annotated[float, Strict(), Field(gt=0, allow_inf_nan=False)]
NonNegative = Annotated[float, Strict(), Field(ge=0, allow_inf_nan=False)]
Count = Annotated[int, Strict(), Field(ge=1)]
Text = Annotated[str, Strict(), Field(min_length=1)]


class Record(BaseModel):
    """A frozen record; unknown keys, NaN and infinities are refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class SourcedRecord(Record):
    """A record whose every stated value says where it comes from, in its own `source` table.

    A source starts with `paper`, `assumed:` or `convention:`; the report lists the assumed ones.
    """

    source: dict[str, Text]

    @model_validator(mode="after")
    def _every_value_has_a_source(self) -> Self:
        stated = self.model_fields_set - {"source"}
        for key in sorted(stated - self.source.keys()):
            raise ValueError(f"source.{key} is missing: say where the value of '{key}' comes from")
        for key in sorted(self.source.keys() - stated):
            raise ValueError(f"source.{key} explains a value that is not stated: remove it or state '{key}'")
        for key, text in self.source.items():
            if not text.startswith(("paper", "assumed:", "convention:")):
                raise ValueError(
                    f"source.{key} = '{text}' must start with 'paper', 'assumed:' or 'convention:'"
                )
        return self


R = TypeVar("R", bound=BaseModel)


def read_toml(path: Path) -> dict[str, Any]:
    """The table in a TOML file; raises InputError when it is missing, unreadable or not TOML."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(path, "", "no such file: check the path") from None
    except IsADirectoryError:
        raise InputError(path, "", "is a folder: name a .toml file in it") from None
    except UnicodeDecodeError:
        raise InputError(path, "", "is not UTF-8 text: save it as UTF-8 TOML") from None
    except OSError as trouble:
        raise InputError(path, "", f"cannot be read ({trouble.strerror}): check its permissions") from None
    if not text.strip():
        raise InputError(path, "", "is empty: a TOML table is expected")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as trouble:
        raise InputError(path, "", f"is not valid TOML: {trouble}") from None


def load_record(path: Path, model: type[R]) -> R:
    """Read `path` as a `model`; raises InputError naming the file, the first wrong key and the remedy."""
    return validate_record(read_toml(path), model, path)


def validate_record(data: dict[str, Any], model: type[R], where: Path | str) -> R:
    """Validate a table as a `model`; `where` is the file named in the InputError."""
    try:
        return model.model_validate(data)
    except ValidationError as trouble:
        errors = trouble.errors()
        # A mistyped key shows up twice, as unknown and as missing: the unknown one is what to mend.
        first = next((e for e in errors if e["type"] == "extra_forbidden"), errors[0])
        key = ".".join(f"[{part}]" if isinstance(part, int) else str(part) for part in first["loc"])
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise InputError(where, key.replace(".[", "["), _explain(dict(first), errors) + more) from None


def _explain(error: dict[str, Any], errors: list[Any]) -> str:
    kind, value = error["type"], error.get("input")
    if kind == "extra_forbidden":
        parent = error["loc"][:-1]
        missing = [str(e["loc"][-1]) for e in errors if e["type"] == "missing" and e["loc"][:-1] == parent]
        name = str(error["loc"][-1])
        stem = name.split("_")[0]
        close = difflib.get_close_matches(name, missing, n=1, cutoff=0.5)
        close = close or [other for other in missing if other.split("_")[0] == stem]
        if close:
            return f"unknown key; did you mean '{close[0]}' (the unit is part of the name)?"
        return "unknown key: remove it or correct its spelling"
    if kind == "missing":
        return "is missing: add it"
    if kind == "value_error":
        return str(error["msg"]).removeprefix("Value error, ")
    if kind == "finite_number":
        return f"{value} is not a finite number: give a number"
    return f"{error['msg'][0].lower()}{error['msg'][1:]}, not {value!r}"

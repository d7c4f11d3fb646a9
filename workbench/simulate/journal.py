"""A journal: JSON lines appended as work gets done, so that a killed job continues where it stopped."""

from __future__ import annotations

import hashlib
import json
import os
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from workbench.errors import InputError
from workbench.files.folders import is_paper, paper_named
from workbench.files.modules import python_files
from workbench.trains.scenario import Scenario

FORMAT = "workbench journal 1"
REMEDY = "start anew without resume, or name another output folder"


@cache
def code_digest(*patterns: str) -> bytes:
    """A digest of modules of this package, read once: this process goes on with those it has imported."""
    digest = hashlib.sha256()
    package = Path(__file__).parents[1]
    for pattern in patterns:
        for file in sorted(package.glob(pattern)):
            digest.update(file.read_bytes())
    return digest.digest()


def laws_digest(scenario: Scenario) -> bytes:
    """A digest of the sources of all laws that a scenario names outside this package: of a paper's folder all files."""
    digest = hashlib.sha256()
    names = {spec.law for spec in scenario.controllers.values()}
    for path in sorted({file for name in names for file in _sources(scenario.folder, name)}):
        digest.update(path.read_bytes())
    return digest.digest()


def _sources(near: Path, law: str) -> list[Path]:
    file, separator, _ = law.partition("::")
    if separator:
        return [near / file]
    paper, dot, _ = law.partition(".")
    folder = near if is_paper(near) else paper_named(paper, near) if dot else None
    return python_files(folder) if folder else []


class Journal:
    """The records of one job; the first line says which job, by `settings` (plain data, compared as a whole).

    With `resume` the records already there are in `records`, and a half-written last line is dropped;
    without it the journal starts empty and what stood there is kept beside it with `.before` appended.
    Raises InputError when the file is no journal, belongs to other settings, or cannot be read or written.
    """

    def __init__(self, path: Path, settings: dict[str, Any], resume: bool) -> None:
        self.path = path
        self.records: list[dict[str, Any]] = []
        header = {"format": FORMAT} | settings
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            kept = self._read(header) if resume and path.exists() else 0
            if not resume and path.exists():
                path.replace(path.with_name(path.name + ".before"))
            # Unbuffered: a record is one write, which an interruption cannot split.
            self._stream = path.open("r+b" if kept else "wb", buffering=0)
            self._stream.seek(kept)
            self._stream.truncate()
            if not kept:
                self._write(header)
        except OSError as trouble:
            raise InputError(path, "", f"cannot be used as a journal ({trouble.strerror}): "
                                       f"name another output folder") from None

    def append(self, record: dict[str, Any]) -> None:
        """Add a record; it is on its way to the disk when this returns."""
        self._write(record)

    def _write(self, record: dict[str, Any]) -> None:
        self._stream.write(json.dumps(record, allow_nan=False).encode() + b"\n")
        os.fsync(self._stream.fileno())

    def _read(self, header: dict[str, Any]) -> int:
        """Fill `records`; returns the length in bytes of the part that can be kept."""
        text = self.path.read_bytes()
        # A kill may cut the last line anywhere; only what a newline ends was written whole.
        kept = text.rfind(b"\n") + 1
        lines = text[:kept].splitlines()
        if not lines:
            return 0
        found = self._line(lines[0], 1)
        if found.get("format") != FORMAT:
            raise InputError(self.path, "", f"is not a journal of this program: {REMEDY}")
        for key, value in header.items():
            if found.get(key) != value:
                raise InputError(self.path, "", f"belongs to another job ({key} {found.get(key)}, "
                                                f"not {value}): {REMEDY}")
        self.records = [self._line(line, number) for number, line in enumerate(lines[1:], start=2)]
        return kept

    def _line(self, line: bytes, number: int) -> dict[str, Any]:
        try:
            record = json.loads(line)
        except ValueError:
            record = None
        if not isinstance(record, dict):
            raise InputError(self.path, f"line {number}", f"is not a journal record: {REMEDY}")
        return record

    def close(self) -> None:
        """Close the file; further records are refused by the operating system."""
        self._stream.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

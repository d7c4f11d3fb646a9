"""A journal: JSON lines appended as work gets done, so that a killed job continues where it stopped."""

from __future__ import annotations

import errno
import hashlib
import json
import os
from contextlib import suppress
from functools import cache
from itertools import chain, count
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from workbench.errors import InputError
from workbench.files.cache_folder import note
from workbench.files.folder_lock import FolderLock
from workbench.files.folders import is_paper, paper_named
from workbench.files.modules import python_files
from workbench.files.regular import LARGEST_JOURNAL, contents
from workbench.files.text import digest_read, read_source
from workbench.trains.scenario import Scenario

FORMAT = "workbench journal 1"
REMEDY = "start anew without resume, or name another output folder"
_CHECK = b', "check": "'
# How a journal begins.
_START = json.dumps({"format": FORMAT})[:-1].encode()


@cache
def code_digest(*patterns: str) -> bytes:
    """A digest of modules of this package, read once: this process goes on with those it has imported."""
    digest = hashlib.sha256()
    package = Path(__file__).parents[1]
    for pattern in patterns:
        for file in sorted(package.glob(pattern)):
            digest.update(contents(file))
    return digest.digest()


def laws_digest(scenario: Scenario) -> bytes:
    """A digest of the sources of all laws that a scenario names outside this package: of a paper's folder all files."""
    digest = hashlib.sha256()
    names = {spec.law for spec in scenario.controllers.values()}
    for path in sorted({file for name in names for file in _sources(scenario.folder, name)}):
        if digest_read(path) is None:  # what was imported is not read again
            read_source(str(path))
        digest.update(str(digest_read(path)).encode())
    return digest.digest()


def _sources(near: Path, law: str) -> list[Path]:
    file, separator, _ = law.partition("::")
    if separator:
        return [near / file]
    paper, dot, _ = law.partition(".")
    folder = near if is_paper(near) else paper_named(paper, near) if dot else None
    return python_files(folder) if folder else []


def _is_ours(path: Path) -> bool:
    """Whether a file begins as a journal does, or as one that was cut off at once."""
    return _START.startswith(contents(path, LARGEST_JOURNAL)[:len(_START)])


def _object(line: bytes) -> dict[str, Any] | None:
    """A line's JSON object, None where it holds none."""
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def _checked(record: dict[str, Any]) -> bytes:
    """A record as a line, at its end the digest of what stands before it."""
    text = json.dumps(record, allow_nan=False).encode()[:-1]
    return text + _CHECK + hashlib.sha256(text).hexdigest()[:16].encode() + b'"}'


def _record(line: bytes) -> dict[str, Any] | None:
    """The record of a line, None where it is not what was written."""
    text = line.rpartition(_CHECK)[0]
    found = _object(text + b"}") if text else None
    try:
        return found if found is not None and _checked(found) == line else None
    except ValueError:  # a NaN, which is read and never written
        return None


class Journal:
    """The records of one job; the first line says which job, by `settings` (plain data, compared as a whole).

    With `resume` the records already there are in `records`, and a half-written last line is dropped; a record that
    is not what was written is left out with a note. Without it the journal starts empty and what stood there is kept
    beside it with `.before` appended, numbered where that is taken, and a note says so. lines: how many records there
    are, those left out too. Its folder is locked.
    Raises InputError when the file is no journal, belongs to other settings, or cannot be read or written, and where
    another process writes in its folder.
    """

    def __init__(self, path: Path, settings: dict[str, Any], resume: bool) -> None:
        self.path = path
        self.records: list[dict[str, Any]] = []
        self.lines = 0
        header = {"format": FORMAT} | settings
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._lock = FolderLock(path.parent)
        except OSError as trouble:
            raise self._unusable(trouble) from None
        except ValueError as trouble:  # a null character in the path
            raise InputError(path, "", f"is no path ({trouble}): name another output folder") from None
        try:
            self._open(header, resume)
        except BaseException:
            self._lock.release()
            raise

    def _open(self, header: dict[str, Any], resume: bool) -> None:
        path = self.path
        try:
            if resume:
                self._require_ours(path)
            kept = self._read(header) if resume and path.exists() else 0
            if not resume:
                self._set_aside()
            # Unbuffered: a record is one write, which an interruption cannot split.
            self._stream = path.open("r+b" if kept else "wb", buffering=0)
            self._stream.seek(kept)
            self._stream.truncate()
            if not kept:
                self._write(json.dumps(header, allow_nan=False).encode())
        except OSError as trouble:
            raise self._unusable(trouble) from None

    def append(self, record: dict[str, Any]) -> None:
        """Add a record; it is on its way to the disk when this returns. InputError where the disk takes no more."""
        try:
            self._write(_checked(record))
        except OSError as trouble:
            raise self._unusable(trouble) from None
        self.lines += 1

    def _write(self, text: bytes) -> None:
        line, start = text + b"\n", self._stream.tell()
        try:
            if self._stream.write(line) != len(line):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(self._stream.fileno())
        except OSError:
            with suppress(OSError):  # half a record
                self._stream.seek(start)
                self._stream.truncate()
            raise

    def _unusable(self, trouble: OSError) -> InputError:
        return InputError(self.path, "", f"cannot be used as a journal ({trouble.strerror}): name another output "
                          "folder")

    def _set_aside(self) -> None:
        """Keep what stands there under a name that is free: hours of work may lie in it."""
        if self.path.exists() or self.path.is_symlink():
            names = (f"{self.path.name}.before{number}" for number in chain([""], count(2)))
            before = next(path for name in names if not os.path.lexists(path := self.path.with_name(name)))
            self.path.replace(before)
            note(f"{self.path}: begins anew; what stood there is {before.name}; --resume would have gone on "
                 "with it")

    @staticmethod
    def _require_ours(path: Path) -> None:
        """InputError where a link, or a file that is no journal, would be written to."""
        if path.is_symlink() or (path.exists() and not _is_ours(path)):
            raise InputError(path, "", f"is not a journal of this program: {REMEDY}")

    def _read(self, header: dict[str, Any]) -> int:
        """Fill `records`; returns the length in bytes of the part that can be kept."""
        text = contents(self.path, LARGEST_JOURNAL)
        # A kill may cut the last line anywhere; only what a newline ends was written whole.
        kept = text.rfind(b"\n") + 1
        lines = text[:kept].splitlines()
        if not lines:
            return 0
        found = _object(lines[0])
        if found is None or found.get("format") != FORMAT:
            raise InputError(self.path, "", f"is not a journal of this program: {REMEDY}")
        for key, value in header.items():
            if found.get(key) != value:
                raise InputError(self.path, "", f"belongs to another job ({key} {found.get(key)}, "
                                                f"not {value}): {REMEDY}")
        self.lines = len(lines) - 1
        self.records = [record for line in lines[1:] if (record := _record(line)) is not None]
        damaged = self.lines - len(self.records)
        if damaged:
            note(f"{self.path}: {damaged} of {self.lines} records are not what was written: they are made again")
        return kept

    def close(self) -> None:
        """Close the file; further records are refused by the operating system."""
        self._stream.close()
        self._lock.release()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

"""Decisions kept between runs, as JSON in the user's cache: by claim, and all those of a proof file together.

An entry is two lines: the sha256 of the second, and the content. One that is cut off, changed or of another shape is
no entry, and so is a decision without a certificate of its claim and verdict. Certificates are not checked here.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

from workbench.errors import ClaimError
from workbench.files.cache_folder import cache_folder, drop, keep
from workbench.files.regular import contents
from workbench.files.text import digest_read, written_since_read
from workbench.files.writing import as_bytes
from workbench.proof.checker import UNDECIDED
from workbench.proof.dependencies import changed_since, digest
from workbench.proof.engine_digest import engine_digest
from workbench.proof.verdict import Decision, Stated

ENGINES_KEPT, FILES_KEPT = 4, 200
FROM_THE_OTHERS = {"tainted_by", "proved_under", "fate", "other_reading"}  # said anew each time

T = TypeVar("T")


@dataclass(frozen=True)
class FileEntry:
    """What is kept of a proof file: how many papers it states, and its claims decided, in their order."""

    papers: int
    decisions: tuple[Decision, ...]


@dataclass(frozen=True)
class DecisionCache:
    """The cache as one version of the deciders sees it."""

    folder: Path
    engine: str

    @property
    def _claims(self) -> Path:
        return self.folder / "claims" / self.engine[:20]

    def claim(self, key: str) -> Decision | None:
        """The decision of the claim with that fingerprint."""
        return _read(self._claims / f"{key}.json", f"{self.engine} {key}", _decision)

    def keep_claim(self, key: str, decision: Decision) -> None:
        """Keep the decision of the claim with that fingerprint."""
        _write(self._claims / f"{key}.json", f"{self.engine} {key}", _record(decision))

    def file(self, path: Path, digests: Callable[[str], str | None] = digest) -> FileEntry | None:
        """The decisions of a proof file, when nothing that it reads has changed since."""
        entry = _read(self._file(path), f"{self.engine} {path.resolve()}", _file_content)
        if entry is None or any(digests(name) != before for name, before in entry["reads"].items()):
            return None
        return FileEntry(entry["papers"], entry["decisions"])

    def keep_file(self, path: Path, entry: FileEntry, paths_read: Iterable[str], since_ns: int) -> None:
        """Keep the decisions of a proof file; not when a file that it reads has changed since that instant."""
        # What was read is what counts, and need not be read again, unless it has changed since it was read.
        reads = {name: digest_read(name, since_ns if written_since_read(name) else 0) or digest(name)
                 for name in sorted(paths_read)}
        if any(found and changed_since(name, since_ns) for name, found in reads.items()):
            return
        _write(self._file(path), f"{self.engine} {path.resolve()}",
               {"papers": entry.papers, "reads": reads, "decisions": [_record(d) for d in entry.decisions]})

    def _file(self, path: Path) -> Path:
        return self.folder / "files" / f"{hashlib.sha256(os.fsencode(path.resolve())).hexdigest()[:40]}.json"

    def tidy(self) -> None:
        """Drop what has not been written to for longest: claims of former deciders, and proof files."""
        for folder, count in ((self._claims.parent, ENGINES_KEPT), (self.folder / "files", FILES_KEPT)):
            with suppress(OSError):  # another process may tidy up too
                for old in sorted(folder.glob("*"), key=lambda p: p.stat().st_mtime_ns)[:-count]:
                    drop(old)


def decision_cache() -> DecisionCache | None:
    """The cache; None where none can be written or the deciders changed under this process."""
    folder, engine = cache_folder("decided-claims"), engine_digest()
    return DecisionCache(folder, engine) if folder and engine else None


def _record(decision: Decision) -> dict[str, Any]:
    claim = {f.name: getattr(decision.claim, f.name) for f in fields(Stated)}
    return {f.name: getattr(decision, f.name) for f in fields(decision) if f.name not in FROM_THE_OTHERS} | {
        "claim": claim}


def _decision(record: dict[str, Any]) -> Decision:
    claim = record["claim"]
    stated = Stated(**claim | {"premises": tuple(claim["premises"]), "rests_on": tuple(claim["rests_on"])})
    found, certificate = Decision(**record | {"claim": stated}), record["certificate"]
    carries = (found.verdict in UNDECIDED if certificate is None
               else (certificate["claim"], certificate["verdict"]) == (stated.id, found.verdict))
    if not carries:
        raise ValueError("a decision without what its verdict must carry")
    return found


def _file_content(record: dict[str, Any]) -> dict[str, Any]:
    return {"papers": int(record["papers"]), "reads": dict(record["reads"]),
            "decisions": tuple(map(_decision, record["decisions"]))}


def _write(path: Path, key: str, content: dict[str, Any]) -> None:
    text = json.dumps({"key": key, "content": content}, ensure_ascii=False)
    keep(path, f"{_sha256(text)}\n{text}\n")


def _read(path: Path, key: str, make: Callable[[dict[str, Any]], T]) -> T | None:
    try:
        seal, text, rest = contents(path, own=True).decode().split("\n")
        if seal != _sha256(text) or rest:
            return None
        entry = json.loads(text)
        return make(entry["content"]) if entry["key"] == key else None
    except (OSError, ValueError, KeyError, TypeError, ClaimError):
        return None


def _sha256(text: str) -> str:
    return hashlib.sha256(as_bytes(text)).hexdigest()

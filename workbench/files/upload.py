"""The code and the inputs of a job as an archive for workers that share no disk with this process.

    workbench_upload_<digest>/__init__.py    unpacks the rest on a worker, once (`upload_start.py`)
    code/workbench/...                       this package
    tree/home/me/proofs/mine2026/...         the folders and files that this process knows, by their whole paths
"""

from __future__ import annotations

import hashlib
import io
import pickle
import sys
import threading
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from workbench.files.modules import known_folders
from workbench.files.regular import LARGEST_TEXT, contents
from workbench.files.text import inputs_read, sources_read

PACKAGE = Path(__file__).parents[1]
LEFT_OUT = ("__pycache__", "certificates")
_alone = threading.Lock()


@dataclass(frozen=True)
class Archive:
    """The bytes of an archive; name: of the package in it; root: what its paths begin with, of all that is in it."""

    name: str
    data: bytes
    root: frozenset[Path]


def archive() -> Archive:
    """Of this package and of all that this process has imported from folders, or read, so far."""
    folders = known_folders()
    files = {path.absolute() for path in (*inputs_read(), *sources_read())}
    files |= {path for folder in folders.values() for path in _files(folder)}
    entries = {f"code/{PACKAGE.name}/{path.relative_to(PACKAGE).as_posix()}": path for path in _files(PACKAGE)}
    entries |= {f"tree{path.as_posix()}": path for path in files if path.is_file()}
    held = {name: contents(path) for name, path in sorted(entries.items())}
    digest = hashlib.sha256()
    for name, data in held.items():
        digest.update(f"{name} {len(data)} ".encode() + data)
    package = f"workbench_upload_{digest.hexdigest()[:16]}"
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr(f"{package}/__init__.py", contents(Path(__file__).with_name("upload_start.py")))
        for name, data in held.items():
            made.writestr(name, data)
    return Archive(package, stream.getvalue(), frozenset({*folders.values(), *files}))


def _files(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*"):
        parts = path.relative_to(folder).parts
        if (path.is_file() and not any(part.startswith(".") or part in LEFT_OUT for part in parts)
                and path.stat().st_size <= LARGEST_TEXT):
            yield path.absolute()


@contextmanager
def temporary_archive(made: Archive) -> Iterator[Path]:
    """The archive as a file, while the block lasts."""
    with TemporaryDirectory(prefix="workbench-upload-") as folder:
        path = Path(folder) / f"{made.name}.zip"
        path.write_bytes(made.data)
        yield path


class _Packer(pickle.Pickler):
    """Standard pickle, which takes functions by their names; paths of what was uploaded stand for their copies."""

    def __init__(self, stream: io.BytesIO, root: frozenset[Path]) -> None:
        super().__init__(stream, pickle.HIGHEST_PROTOCOL)
        self._root = root

    def persistent_id(self, value: Any) -> str | None:
        """The whole path of what was uploaded, as pickle asks for it."""
        if isinstance(value, Path) and ((path := value.absolute()) in self._root or not self._root.isdisjoint(
                path.parents)):
            return path.as_posix()
        return None


class _Unpacker(pickle.Unpickler):
    def __init__(self, data: bytes, tree: Path) -> None:
        super().__init__(io.BytesIO(data))
        self._tree = tree

    def persistent_load(self, path: Any) -> Path:
        """The copy of what was uploaded, as pickle asks for it."""
        return Path(f"{self._tree}{path}")


def packed(value: Any, root: frozenset[Path]) -> bytes:
    """A value for a worker; raises as pickle does for what has no name, as a function within a function."""
    stream = io.BytesIO()
    _Packer(stream, root).dump(value)
    return stream.getvalue()


def unpacked(data: bytes, upload: str) -> Any:
    """In a worker: a value that the process packed which has uploaded this archive."""
    return _Unpacker(data, sys.modules[upload].TREE).load()


@contextmanager
def alone() -> Iterator[None]:
    """One task at a time in a process: what is computed once a process is not made for threads."""
    with _alone:
        yield

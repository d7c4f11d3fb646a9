"""Sealed files: compiled code kept on disk, each file with its digest, in a folder of this user's alone.

numba keeps what it compiled in files that it believes: a damaged one would be run, or end the run. Here each file says
its own digest first; what does not fit it, or belongs to another user, is compiled anew. Of several processes that lack
the same code one compiles it, and the others wait for it.
"""

from __future__ import annotations

import hashlib
import pickle
from pathlib import Path
from typing import Any

from numba.core.caching import IndexDataCacheFile

from workbench.compile.typed_once import typed_once
from workbench.compile.without_collection import without_collection
from workbench.errors import CompileError
from workbench.files.cache_folder import CACHE_VARIABLE, cache_folder, note, temporary_folder
from workbench.files.regular import contents
from workbench.files.turn import Turn
from workbench.files.writing import write_whole

KIND = "compiled-kernels"
FORMAT = b"workbench code 1\n"
_START = len(FORMAT) + hashlib.sha256().digest_size


def sealed_folder() -> Path:
    """The cache, else a temporary folder; CompileError where none can be written."""
    folder = cache_folder(KIND) or temporary_folder(KIND)
    if folder is None:
        raise CompileError(f"no writable folder for compiled kernels: set {CACHE_VARIABLE} to one")
    return folder


def seal(function: Any, folder: Path, name: str, stamp: Any) -> None:
    """Have what numba keeps of a function kept in sealed files, and what it lacks compiled by one process at a time.

    name: of the files; stamp: of the source that they are of.
    """
    file = function._cache._cache_file = _SealedFile(folder, name, stamp)

    def compile_in_turn(*signature: Any) -> Any:
        by_numba = type(function).compile
        try:
            with typed_once(), without_collection():
                return by_numba(function, *signature)
        finally:
            file.done()

    function.compile = compile_in_turn


def kept(path: Path) -> Any:
    """What a file holds; None where there is none, or none of this user's that is whole."""
    try:
        sealed = contents(path, own=True)
    except FileNotFoundError:
        return None
    except OSError as trouble:
        note(f"{path} cannot be used ({trouble.strerror}): it is compiled anew")
        return None
    data = sealed[_START:]
    if sealed[:_START] != FORMAT + hashlib.sha256(data).digest():
        note(f"{path} is damaged: it is compiled anew")
        return None
    return pickle.loads(data)  # noqa: S301 - this user's own, and what its digest says


def keep(path: Path, value: Any) -> None:
    """Keep a value in a file."""
    _write(path, pickle.dumps(value))


class _SealedFile(IndexDataCacheFile):
    """numba's index of a function's versions and their code, each in a sealed file.

    Who looks for code that is not there has the turn to compile it, until `done`; who comes meanwhile waits, and finds
    it.
    """

    def __init__(self, folder: Path, name: str, source_stamp: Any) -> None:
        super().__init__(str(folder), name, source_stamp)
        self._index_path = str(folder / f"{name}.sealed-index")
        self._data_name_pattern = f"{name}.{{number:d}}.sealed-code"
        self._turn = Turn(folder / f"{name}.turn")

    def load(self, key: Any) -> Any:
        """The code of a version, as numba looks for it; None where it is to be compiled, by this process."""
        found = super().load(key)
        if found is None:
            self._turn.take()
            found = super().load(key)
        return found

    def done(self) -> None:
        """Let others look for what they lack."""
        self._turn.end()

    def _load_index(self) -> dict[Any, str]:
        version, stamp, names = kept(Path(self._index_path)) or (None, None, {})
        return names if (version, stamp) == (self._version, self._source_stamp) else {}

    def _save_index(self, overloads: dict[Any, str]) -> None:
        _write(Path(self._index_path), self._dump((self._version, self._source_stamp, overloads)))

    def _load_data(self, name: str) -> Any:
        return kept(Path(self._data_path(name)))

    def _save_data(self, name: str, data: Any) -> None:
        _write(Path(self._data_path(name)), self._dump(data))


def _write(path: Path, data: bytes) -> None:
    try:
        write_whole(path, FORMAT + hashlib.sha256(data).digest() + data)
    except OSError as trouble:  # costs time, not the result
        note(f"compiled code cannot be kept in {path.parent} ({trouble.strerror})")

"""Compiled code kept on disk between runs: each file with its digest, in a folder of this user's alone.

numba keeps what it compiled in files that it believes: a damaged one would be run, or end the run. Here each file says
its own digest first; what does not fit it, or belongs to another user, is compiled anew. Of several processes that lack
the same code one compiles it, and the others wait for it.
"""

from __future__ import annotations

import hashlib
import pickle
import sys
from collections.abc import Callable, Sequence
from importlib.abc import SourceLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

import numba
import sympy
from numba.core.caching import IndexDataCacheFile
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher

from workbench.compile.linked import linked_functions
from workbench.errors import CompileError
from workbench.files.cache_folder import CACHE_VARIABLE, cache_folder, note, temporary_folder
from workbench.files.regular import contents
from workbench.files.turn import Turn
from workbench.files.writing import write_whole

KIND = "compiled-kernels"
FORMAT = b"workbench code 1\n"
_START = len(FORMAT) + hashlib.sha256().digest_size


def imported_kernel(name: str, text: str) -> ModuleType:
    """The module of that name and text, whose compiled functions are kept; CompileError without a folder for them."""
    folder = _folder()
    path = folder / f"{name}.py"
    _write_source(path, text)
    spec = spec_from_loader(name, _TextLoader(path, text))
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    to_link = linked_functions(vars(module), name)
    for function in (*vars(module).values(), *(linked.dispatcher for linked in to_link)):
        if isinstance(function, Dispatcher):
            _seal(function, folder)
    for linked in to_link:
        linked.load()
    return module


def c_function(module: ModuleType, name: str, prototype: Any) -> Any:
    """A function of an imported kernel as one of C, to be called by its address; compiled where it was not kept.

    prototype: its type, as `ctypes.CFUNCTYPE` makes it.
    """
    function = getattr(module, name).py_func
    signature = numba.typeof(prototype(0)).sig
    found = CFunc(function, (signature.args, signature.return_type), {}, {"error_model": "numpy",
                                                                        "no_cpython_wrapper": True})
    found.enable_caching()
    _seal(found, Path(str(module.__file__)).parent)
    found.compile()
    pointer = prototype(found.address)
    pointer.code = found  # lives as long as it may be called
    return pointer


def kept_texts(made_of: Sequence[str], sources: Sequence[Path], make: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
    """What make() gives, kept between runs like compiled code.

    made_of: all that the texts depend on, in words; sources: the files of the code that makes them.
    """
    whole = [sympy.__version__, *made_of, *(hashlib.sha256(contents(path)).hexdigest() for path in sources)]
    key = hashlib.sha256("\n".join(f"{len(one)} {one}" for one in whole).encode()).hexdigest()
    path = _folder() / f"{key[:20]}.sealed-texts"
    found = _unsealed(path)
    if found is None or found[0] != key:
        found = key, make()
        _write(path, pickle.dumps(found))
    return found[1]


def _seal(function: Any, folder: Path) -> None:
    """Have what numba keeps of a function kept in sealed files, and what it lacks compiled by one process at a time."""
    before = function._cache._cache_file
    file = function._cache._cache_file = _SealedFile(folder, before._index_name, before._source_stamp)

    def compile_in_turn(*signature: Any) -> Any:
        by_numba = type(function).compile
        try:
            return by_numba(function, *signature)
        finally:
            file.done()

    function.compile = compile_in_turn


class _TextLoader(SourceLoader):
    """Imports a text; the file of the same text is there to be read, and for numba, which asks when it was written."""

    def __init__(self, path: Path, text: str) -> None:
        self._path, self._text = path, text

    def get_filename(self, fullname: str) -> str:
        """Where the text stands too, as the import system asks for it."""
        return str(self._path)

    def get_data(self, path: str | bytes) -> bytes:
        """The text, as the import system asks for it."""
        return self._text.encode()


def _folder() -> Path:
    """The cache, else a temporary folder."""
    folder = cache_folder(KIND) or temporary_folder(KIND)
    if folder is None:
        raise CompileError(f"no writable folder for compiled kernels: set {CACHE_VARIABLE} to one")
    return folder


def _write_source(path: Path, text: str) -> None:
    """Keep the source of a kernel; one that is damaged is written anew. Raises CompileError where it cannot be."""
    try:
        if path.exists() or path.is_symlink():
            if contents(path, own=True) == text.encode():
                return
            note(f"{path} is damaged: it is made anew")
    except OSError as trouble:
        note(f"{path} cannot be used ({trouble.strerror}): it is made anew")
    try:
        write_whole(path, text)
    except OSError as trouble:
        raise CompileError(f"{path}: the generated kernel cannot be written ({trouble.strerror}): remove what stands "
                           f"there, or set {CACHE_VARIABLE} to another folder") from None


class _SealedFile(IndexDataCacheFile):
    """numba's index of a function's versions and their code, each in a sealed file.

    Who looks for code that is not there has the turn to compile it, until `done`; who comes meanwhile waits, and finds
    it.
    """

    def __init__(self, folder: Path, index_name: str, source_stamp: Any) -> None:
        name = index_name.removesuffix(".nbi")
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
        version, stamp, names = _unsealed(Path(self._index_path)) or (None, None, {})
        return names if (version, stamp) == (self._version, self._source_stamp) else {}

    def _save_index(self, overloads: dict[Any, str]) -> None:
        _write(Path(self._index_path), self._dump((self._version, self._source_stamp, overloads)))

    def _load_data(self, name: str) -> Any:
        return _unsealed(Path(self._data_path(name)))

    def _save_data(self, name: str, data: Any) -> None:
        _write(Path(self._data_path(name)), self._dump(data))


def _write(path: Path, data: bytes) -> None:
    try:
        write_whole(path, FORMAT + hashlib.sha256(data).digest() + data)
    except OSError as trouble:  # costs time, not the result
        note(f"compiled code cannot be kept in {path.parent} ({trouble.strerror})")


def _unsealed(path: Path) -> Any:
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

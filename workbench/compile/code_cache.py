"""Generated code kept on disk between runs: modules of kernels with what numba made of them, and texts."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable, Sequence
from importlib.abc import SourceLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

import numba
import sympy
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher

from workbench.compile.linked import linked_functions
from workbench.compile.sealed import keep, kept, seal, sealed_folder
from workbench.errors import CompileError
from workbench.files.cache_folder import CACHE_VARIABLE, note
from workbench.files.regular import contents
from workbench.files.writing import write_whole


def imported_kernel(name: str, text: str) -> ModuleType:
    """The module of that name and text, whose compiled functions are kept; CompileError without a folder for them."""
    folder = sealed_folder()
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
    path = sealed_folder() / f"{key[:20]}.sealed-texts"
    found = kept(path)
    if found is None or found[0] != key:
        found = key, make()
        keep(path, found)
    return found[1]


def _seal(function: Any, folder: Path) -> None:
    """The same under the names that numba gives."""
    file = function._cache._cache_file
    seal(function, folder, file._index_name.removesuffix(".nbi"), file._source_stamp)


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

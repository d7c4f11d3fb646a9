"""Python modules in a folder that a user names: imported as a package of its own, under a name made from its path.

Modules of such a folder import each other relatively (`from .laws import adaptive`), so that files of one name in two
folders are not taken for each other, and a copy of a folder is a package of its own.
"""

from __future__ import annotations

import hashlib
import importlib
import os
import re
import sys
import time
from collections.abc import Mapping, Sequence
from importlib.machinery import FileFinder, ModuleSpec, SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

from workbench.errors import InputError, OutOfTime
from workbench.files.depth_limit import limited_depth
from workbench.files.guarded_calls import guard_calls
from workbench.files.memory_limit import limited_memory
from workbench.files.mistakes import OF_A_FOLDER, mistake
from workbench.files.process_state import state_kept
from workbench.files.text import inputs_read_by, read_source, written_since_read
from workbench.files.time_limit import at_most_seconds

PREFIX = OF_A_FOLDER
OF_A_KERNEL = "workbench_kernel_"  # begins the names of modules that are generated from what papers state

# Files are stamped by a clock that is behind by up to a few milliseconds.
TICK_NS = 50_000_000
# Processor time that the import of a module, with all that it imports, may take.
IMPORT_S = 4.0
OUT_OF_TIME = (f"cannot be imported: computes for more than {IMPORT_S:g} s, or waits: state what takes so long in a "
               "function, which is called when it is needed")
OUT_OF_MEMORY = ("cannot be imported: takes more memory than a module may: read less, and state large values in a "
                 "function")

_folders: dict[str, Path] = {}
_imported_ns: dict[str, int] = {}


class SourceLoader(SourceFileLoader):
    """Reads the source, never bytecode: that knows its source by size and second only, and a changed formula must
    not be taken for the old one."""

    def path_stats(self, path: Any) -> Mapping[str, Any]:
        """None that bytecode could be held against, as the import system asks for it."""
        raise OSError(f"{path}: no bytecode wanted")

    def get_data(self, path: Any) -> bytes:
        """The source, as the import system asks for it; InputError for what is no regular file or too large."""
        return read_source(str(path))

    def exec_module(self, module: ModuleType) -> None:
        """Run the module, as the import system asks for it; InputError where it does what no module may."""
        guard_calls()
        with state_kept(self.path):
            super().exec_module(module)


class _Finder:
    """Finds known folders as packages, and the modules in them."""

    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> ModuleSpec | None:
        """The module of that name, as the import system asks for it."""
        package, dot, _ = name.partition(".")
        if package not in _folders:
            return None
        if not dot:
            spec = ModuleSpec(name, None, is_package=True)
            spec.submodule_search_locations = [str(_folders[package])]
            return spec
        return FileFinder(next(iter(path or ())), (SourceLoader, [".py"])).find_spec(name)


sys.meta_path.insert(0, _Finder)


def package_of(folder: Path) -> str:
    """The name under which a folder is imported in every process that knows it."""
    resolved = folder.resolve()
    for name, known in _folders.items():  # a copy on another machine has the name that it has on ours
        if known == resolved:
            return name
    digest = hashlib.sha256(os.fsencode(resolved)).hexdigest()[:10]
    name = f"{PREFIX}{re.sub(r'[^0-9A-Za-z_]', '_', resolved.name)}_{digest}"
    _folders[name] = resolved
    return name


def has_module(folder: Path, name: str) -> bool:
    """Whether a folder has a module or a package of that name."""
    return (folder / f"{name}.py").is_file() or (folder / name / "__init__.py").is_file()


def module_in(folder: Path, name: str) -> ModuleType:
    """A module of a folder, `study.record` for `study/record.py`; InputError, naming file and line, where it cannot be
    imported, and where that takes more than IMPORT_S."""
    package = package_of(folder)
    dotted = f"{package}.{name}"
    if dotted in sys.modules:
        return sys.modules[dotted]
    _imported_ns.setdefault(package, time.time_ns())
    path = folder.joinpath(*name.split("."))
    where = path / "__init__.py" if (path / "__init__.py").is_file() else path.with_name(f"{path.name}.py")
    try:
        with at_most_seconds(IMPORT_S), limited_memory(), limited_depth():
            return importlib.import_module(dotted)
    except InputError:
        raise
    except OutOfTime:
        raise InputError(where, "", OUT_OF_TIME) from None
    except MemoryError:
        raise InputError(where, "", OUT_OF_MEMORY) from None
    except KeyboardInterrupt:
        raise
    except BaseException as trouble:  # a file that exits would end the run
        raise InputError(where, "", f"cannot be imported: {mistake(trouble, where)}") from trouble


def forget_changed(folder: Path) -> None:
    """Forget a folder's modules where a file of it, or an input that they have read, was written since: what is asked
    for next is imported anew. Modules that read nothing of it stay what they are, since others hold their functions."""
    package = package_of(folder)
    since = _imported_ns.get(package)
    own = (path for path in (folder, *folder.rglob("*")) if "certificates" not in path.relative_to(folder).parts)
    if since is None or not (any(_written_ns(path) > since - TICK_NS for path in own)
                             or any(path.exists() and written_since_read(path) for path in inputs_read_by(package))):
        return
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        del sys.modules[name]
    del _imported_ns[package]


def _written_ns(path: Path) -> int:
    try:
        found = path.stat()
    except OSError:
        return 0
    return max(found.st_mtime_ns, found.st_ctime_ns)


def sources_of(folder: Path) -> frozenset[str]:
    """The files of a folder that have been imported, as absolute paths."""
    name = package_of(folder)
    return frozenset(str(Path(file).absolute()) for key, module in list(sys.modules.items())
                     if key.startswith(f"{name}.") and (file := getattr(module, "__file__", None)))


def python_files(folder: Path) -> list[Path]:
    """All Python files of a folder and its subfolders, hidden ones and those of caches left out, in a fixed order."""
    return sorted(path for path in folder.rglob("*.py")
                  if not any(part.startswith((".", "__pycache__")) for part in path.relative_to(folder).parts)
                  and not path.is_dir())


class KnownFolders:
    """What this process knows of folders; a process that unpickles it knows the same, and so can import from them."""

    def __reduce__(self) -> tuple[Any, tuple[dict[str, Path]]]:
        return _know, (known_folders(),)


def _know(folders: Mapping[str, Path]) -> KnownFolders:
    _folders.update({name: folder.resolve() for name, folder in folders.items()})
    return KnownFolders()


def known_folders() -> dict[str, Path]:
    """The folders that modules have been, or may be, imported from, by the names of their packages."""
    return dict(_folders)

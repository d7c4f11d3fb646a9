"""Which files a proof file depends on: the modules and the data that this process has read for it."""

from __future__ import annotations

import hashlib
import os
import site
import stat
import sys
import sysconfig
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from workbench.files.modules import python_files
from workbench.files.regular import sha256_of
from workbench.files.text import inputs_read

# What was read before this instant may have changed since without this process knowing.
STARTED_NS = time.time_ns()
PACKAGE = Path(__file__).parents[1]
BYTECODE, NO_FILES = ".pyc", ("/proc/", "/sys/", "/dev/")

SETTLED_NS = 2_000_000_000  # no file system's clock is coarser

_data: set[str] = set()
_known: dict[str, tuple[tuple[int, ...], str]] = {}
_sources: list[set[str]] = []


@cache
def watch() -> None:
    """From now on remember which files this process opens to read; Python offers no way back, so it is done once."""
    sys.addaudithook(_remember)


def _remember(event: str, arguments: tuple[Any, ...]) -> None:
    if event != "open" or not _sources or not isinstance(arguments[0], (str, bytes)):
        return
    path, mode, flags = arguments
    if ("r" in mode or "+" in mode) if isinstance(mode, str) else not (flags or 0) & os.O_WRONLY:
        absolute = str(Path(os.fsdecode(path)).absolute())
        (_sources[-1] if absolute.endswith((".py", BYTECODE)) else _data).add(absolute)


@contextmanager
def reading(sources: set[str]) -> Iterator[None]:
    """While entered, files that are opened are remembered, the Python files among them in `sources`."""
    _sources.append(sources)
    try:
        yield
    finally:
        _sources.pop()


def reads(sources: Iterable[str], others: tuple[str, ...], cache_folder: Path | None = None) -> frozenset[str]:
    """The files a proof file may depend on: sources read for it, every module here that is not an installed one, and
    all data this process has read, because a module may keep what it read. Too many are harmless, too few are not.

    Modules whose name starts with one of `others` belong to other proof files, or are generated from them.
    """
    modules = {file for name, module in list(sys.modules.items())
               if (file := getattr(module, "__file__", None)) and not name.startswith(("__", *others))}
    paths = {*sources, *_data, *map(str, inputs_read()), *map(_absolute, modules)}
    kept = f"{cache_folder}{os.sep}"
    return frozenset(path for path in paths if _is_own(path) and not path.startswith(kept))


@cache
def _absolute(file: str) -> str:
    return str(Path(file).absolute())


@cache
def _is_own(path: str) -> bool:
    """Whether a file may change without the version of a package changing."""
    return not path.endswith(BYTECODE) and (path.startswith(f"{PACKAGE}{os.sep}") or
                                            not path.startswith(_installed()))


@cache
def _installed() -> tuple[str, ...]:
    folders = {sysconfig.get_path(kind) for kind in ("stdlib", "platstdlib", "purelib", "platlib")}
    folders |= {*site.getsitepackages(), site.getusersitepackages()}
    return (*NO_FILES, *(f"{folder}{os.sep}" for folder in folders if folder))


def digest(path: str | Path) -> str | None:
    """sha256 of a file's bytes, of a folder that of the names of its Python files; None where there is nothing that can
    be read, which is something to know too."""
    try:
        mode = os.stat(path).st_mode  # noqa: PTH116 - as below
        if stat.S_ISDIR(mode):
            folder = Path(path)
            names = [found.relative_to(folder).as_posix() for found in python_files(folder)]
            return hashlib.sha256(os.fsencode("\n".join(names))).hexdigest()
        return known_sha256(path) if stat.S_ISREG(mode) else None
    except (OSError, ValueError):  # gone, or a name that no file can bear
        return None


def known_sha256(path: str | Path) -> str:
    """The sha256 of a regular file's bytes, not read again while all that the system says of it is the same.

    What was written only just is read each time: clocks of file systems are coarse. Raises as `contents`.
    """
    found = os.stat(path)  # noqa: PTH116 - a Path for each of hundreds takes longer
    of = found.st_mtime_ns, found.st_ctime_ns, found.st_size, found.st_ino, found.st_dev
    before, digest = _known.get(str(path), ((), ""))
    if before != of:
        digest = sha256_of(path)
        if max(of[:2]) < time.time_ns() - SETTLED_NS:
            _known[str(path)] = of, digest
    return digest


def changed_since(path: str | Path, instant_ns: int) -> bool:
    """Whether a file was written to after an instant, or has gone; a date in the future says nothing of that."""
    try:
        return instant_ns < os.stat(path).st_mtime_ns <= time.time_ns()  # noqa: PTH116 - as above
    except (OSError, ValueError):
        return True

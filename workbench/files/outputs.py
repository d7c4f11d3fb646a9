"""Whether outputs may be written: asked before anything runs, so that nothing is ever written over what was read."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from workbench.errors import InputError
from workbench.files.text import inputs_read, sources_read

# No verb writes such files; whoever names one means another argument.
INPUTS_ALONE = (".py", ".toml")
# What these begin names the output of a shell or another process, even where that is a file.
STREAMS = ("/dev/std", "/dev/fd/", "/proc/")

STANDARD_OUTPUT = Path("-")

# The folder that an option names, and the files that will be written in it.
Folder = tuple[Path, Sequence[str]]


def check_outputs(files: Mapping[str, Path | None], inputs: Iterable[Path] = (),
                  folders: Mapping[str, Folder | None] | None = None) -> None:
    """InputError, naming the option, for an output that is an input, by whatever name, or another output, for one that
    cannot be written, for a folder where a file is named and the other way round.

    files, folders: by the options that name them, None where they are not given; inputs: beside all files that have
    been read so far.
    """
    taken = _Taken([*inputs_read(), *sources_read(), *inputs])
    for option, path in files.items():
        if path is not None and path != STANDARD_OUTPUT:
            _check_file(option, path)
            taken.take(option, path)
    for option, folder in (folders or {}).items():
        if folder is not None:
            _check_folder(option, folder[0])
            for name in folder[1]:
                if is_stream(folder[0] / name):  # writing into a pipe would wait for a reader
                    raise InputError(folder[0] / name, option, "is a pipe, a device or a socket: remove it, or name "
                                     "another folder")
                taken.take(option, folder[0] / name)


def check_rewritten(path: Path) -> None:
    """InputError unless a file that was read may be written anew."""
    if not os.access(path, os.W_OK):
        raise InputError(path, "", "may not be written: change its permissions, or copy it")
    _require_writable("", path, path.resolve().parent)


def is_stream(path: Path) -> bool:
    """Whether a path names a stream of the shell or the system, which is written as it is and never replaced."""
    return path.exists() and not path.is_dir() and (str(path.absolute()).startswith(STREAMS) or not path.is_file())


class _Taken:
    """Which files must not be written, by path and by what the disk knows them by: links are the same file."""

    def __init__(self, inputs: Iterable[Path]) -> None:
        self._why: dict[object, str] = {}
        for path in inputs:
            self._add(path, f"is an input ({path})")

    def take(self, option: str, path: Path) -> None:
        """Keep a file for an output; InputError where it is taken."""
        if is_stream(path):
            return
        for key in _keys(path):
            if key in self._why:
                raise InputError(path, option, f"{self._why[key]}: it would be overwritten, name another place")
        self._add(path, f"is what {option} writes too")

    def _add(self, path: Path, why: str) -> None:
        for key in _keys(path):
            self._why.setdefault(key, why)


def _keys(path: Path) -> list[object]:
    """The path without links, and the file's number on its device where it is there."""
    found: list[object] = [str(path)]  # of a name that is no path, such as one with a null character
    try:
        found = [os.path.realpath(path)]
        status = path.stat()
        found.append((status.st_dev, status.st_ino))
    except (OSError, ValueError):
        pass
    return found


def _check_file(option: str, path: Path) -> None:
    _require_path(option, path)
    if path.is_dir():
        raise InputError(path, option, "is a folder: name a file")
    if is_stream(path):
        return
    if path.suffix.lower() in INPUTS_ALONE and path.exists():
        raise InputError(path, option, f"is a {path.suffix} file, which no output is: it would be overwritten, name "
                         "another place")
    if path.exists() and not os.access(path, os.W_OK):
        raise InputError(path, option, "may not be written: name another file")
    _require_writable(option, path, path.absolute().parent)


def _check_folder(option: str, path: Path) -> None:
    _require_path(option, path)
    if (path.exists() or path.is_symlink()) and not path.is_dir():
        raise InputError(path, option, "is a file: name a folder")
    _require_writable(option, path, path.absolute())


def _require_path(option: str, path: Path) -> None:
    """InputError for what cannot be a path: a null character, too long a name, links that lead to each other."""
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        pass
    except OSError as trouble:
        raise InputError(path, option, f"cannot be written ({trouble.strerror}): name another place") from None
    except ValueError as trouble:
        raise InputError(path, option, f"is no path ({trouble}): correct the name") from None


def _require_writable(option: str, path: Path, folder: Path) -> None:
    """InputError unless the folder, or the nearest one above it that is there, can be written."""
    there = next((place for place in (folder, *folder.parents) if place.exists() or place.is_symlink()), folder)
    if not there.is_dir():
        raise InputError(path, option, f"cannot be written ({there} is a file): name another place")
    if not os.access(there, os.W_OK | os.X_OK) or not _keeps_files(there):
        raise InputError(path, option, f"cannot be written ({there} may not be written): name another place")


def _keeps_files(folder: Path) -> bool:
    """Whether a file can be made in a folder. One of a file system without blocks, as /proc is, says that it may be
    written and may mean nothing by it: there only trying tells."""
    if not hasattr(os, "statvfs") or os.statvfs(folder).f_blocks:
        return True
    try:
        handle, name = tempfile.mkstemp(prefix=".workbench-", dir=folder)
    except OSError:
        return False
    os.close(handle)
    Path(name).unlink()
    return True

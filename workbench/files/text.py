"""The text of a file that a user names; whatever is wrong with it becomes one line naming the file."""

from __future__ import annotations

import errno
import hashlib
import os
import sys
import time
from difflib import get_close_matches
from functools import cache
from itertools import islice
from pathlib import Path

from workbench.errors import InputError
from workbench.files.regular import LARGEST_DATA, LARGEST_TEXT, NotRegularError, TooLargeError, contents, size_words

# What to do about a file that is not there, unless who names it is known.
CHECK_PATH = "check the path"
# What a name is that no file can bear, and one that links lead around with.
NO_NAME = (errno.ENAMETOOLONG, errno.ELOOP, errno.ENOTDIR)
# What is not named here is data.
_LIMITS = {"TOML": LARGEST_TEXT}

_read: dict[Path, set[str]] = {}
_sources: set[str] = set()
_digests: dict[str, tuple[str, int]] = {}


def inputs_read() -> frozenset[Path]:
    """The files that this process has read as its inputs."""
    return frozenset(_read)


def inputs_read_by(package: str) -> list[Path]:
    """The inputs that this process has read while a module of a package, or what a module of it called, was running:
    no other input can be in what its modules keep."""
    return [path for path, packages in _read.items() if package in packages]


def sources_read() -> frozenset[Path]:
    """The Python files of papers that this process has read."""
    return frozenset(map(Path, _sources))


def is_source(path: str) -> bool:
    """Whether a path, as code knows its own file, is that of a Python file of a paper that this process has read."""
    return path in _sources


def digest_read(path: str | Path, since_ns: int = 0) -> str | None:
    """The sha256 of a file's bytes as this process has read them last; None where it has not since that instant."""
    digest, read_ns = _digests.get(_absolute(path), (None, 0))
    return digest if read_ns >= since_ns else None


def written_since_read(path: str | Path) -> bool:
    """Whether a file that this process has read has been written to since, or has gone."""
    _, read_ns = _digests.get(_absolute(path), ("", 0))
    try:
        found = os.stat(path)  # noqa: PTH116 - a Path for each of hundreds takes longer
    except (OSError, ValueError):  # gone, or a name that no file can bear
        return bool(read_ns)
    return bool(read_ns) and max(found.st_mtime_ns, found.st_ctime_ns) > read_ns


def _absolute(path: str | Path) -> str:
    text = os.fspath(path)
    return _spelled(text) if os.path.isabs(text) else str(Path(text).absolute())  # noqa: PTH117 - as above


@cache
def _spelled(absolute: str) -> str:
    return str(Path(absolute))


def named_by(where: str) -> str:
    """For the end of a message: what names a file, where that is known."""
    return "" if where == CHECK_PATH else f" ({where})"


def read_text(path: Path, kind: str, where: str = CHECK_PATH) -> str:
    """A file's text, UTF-8 with or without a mark, its lines ended by a line feed.

    kind: what it should hold, as 'TOML', which also says how large it may be; where: what to do when there is none.
    Raises InputError.
    """
    _read.setdefault(path.absolute(), set()).update(_running_packages())
    try:
        text = _remembered(path, _contents(path, kind, where)).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(path, "", f"is not UTF-8 text: save it as UTF-8 {kind}{named_by(where)}") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def read_source(path: str) -> bytes:
    """The bytes of a Python file of a paper, whose encoding it states itself.

    Raises InputError for one that is too large or no regular file, and OSError where there is none, which those who
    show source lines expect.
    """
    _sources.add(str(Path(path).absolute()))
    try:
        return _remembered(path, contents(path, LARGEST_TEXT))
    except (NotRegularError, TooLargeError) as trouble:
        raise InputError(path, "", f"cannot be imported ({trouble.strerror}): name a regular file, or divide "
                         "it") from None


def _running_packages() -> set[str]:
    """The packages, by the first part of their names, whose functions have been entered and not been left."""
    found, frame = set(), sys._getframe()
    while frame.f_back is not None:
        frame = frame.f_back
        found.add(str(frame.f_globals.get("__name__")).partition(".")[0])
    return found


def _remembered(path: str | Path, data: bytes) -> bytes:
    _digests[str(Path(path).absolute())] = hashlib.sha256(data).hexdigest(), time.time_ns()
    return data


def _contents(path: Path, kind: str, where: str) -> bytes:
    limit = _LIMITS.get(kind, LARGEST_DATA)
    named = named_by(where)
    try:
        return contents(path, limit)
    except FileNotFoundError:
        raise InputError(path, "", f"no such file: {where}{nearly_called(path)}") from None
    except IsADirectoryError:
        raise InputError(path, "", f"is a folder: name a .{kind.lower()} file in it{named}") from None
    except NotRegularError:
        raise InputError(path, "", f"is a pipe, a device or a socket: name a regular {kind} file{named}") from None
    except TooLargeError:
        raise InputError(path, "", f"is larger than {size_words(limit)}, the most that is read of {kind}: name "
                         f"another file, or make it smaller{named}") from None
    except OSError as trouble:
        remedy = where if trouble.errno in NO_NAME else "check its permissions"
        raise InputError(path, "", f"cannot be read ({trouble.strerror}): {remedy}") from None
    except ValueError as trouble:  # a null character in the path
        raise InputError(path, "", f"is no path ({trouble}): {where}") from None


MOST_LISTED = 5_000  # names in a folder beyond which none is looked for


def nearly_called(path: str | Path) -> str:
    """What is called nearly so in the same folder, as a question; empty where nothing is."""
    asked = Path(path)
    try:
        with os.scandir(asked.parent) as entries:
            names = [entry.name for entry in islice(entries, MOST_LISTED)]
    except (OSError, ValueError):
        return ""
    close = get_close_matches(asked.name, sorted(names), n=1, cutoff=0.75)
    return f"; did you mean '{asked.with_name(close[0])}'?" if close else ""

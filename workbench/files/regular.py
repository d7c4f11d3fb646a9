"""The bytes of a file: regular files alone, and no more of them than a limit.

A pipe would keep its reader waiting, and a device may never end. A limit is in bytes.
"""

from __future__ import annotations

import errno
import hashlib
import os
import stat
from pathlib import Path

MEBIBYTE = 2**20
# What people write, and what programs write for programs.
LARGEST_TEXT = 4 * MEBIBYTE
LARGEST_DATA = 64 * MEBIBYTE
# Records of all runs of a job, and whatever a module of a paper may read.
LARGEST_JOURNAL = 1024 * MEBIBYTE

_WITHOUT_WAITING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_PIECE, _SMALL = MEBIBYTE, 4096


class NotRegularError(OSError):
    """What a path names is a pipe, a device or a socket."""

    def __init__(self, path: str | Path) -> None:
        super().__init__(errno.EINVAL, "it is a pipe, a device or a socket, no regular file", str(path))


class TooLargeError(OSError):
    """A file is larger than what is read of its kind."""

    def __init__(self, path: str | Path, limit: int) -> None:
        super().__init__(errno.EFBIG, f"it is larger than {size_words(limit)}", str(path))


def size_words(count: int) -> str:
    """A number of bytes as people read it, 64 MiB."""
    return f"{count / MEBIBYTE:.0f} MiB" if count >= MEBIBYTE else f"{count} bytes"


def contents(path: str | Path, limit: int = LARGEST_DATA, own: bool = False) -> bytes:
    """All bytes of a regular file, through links to it.

    own: only of a file that belongs to this user, which others cannot have put there. Raises OSError where there is
    none that can be read, NotRegularError and TooLargeError among them, and ValueError for what is no path.
    """
    # Asked before it is opened, because opening a device may do something, and again of what was opened.
    _require_regular(path, Path(path).stat(), limit)
    # As a string, because that is what an audit hook sees who remembers which files are read.
    handle = os.open(os.fspath(path), os.O_RDONLY | _WITHOUT_WAITING)
    with os.fdopen(handle, "rb", closefd=True, buffering=0) as stream:
        found = os.fstat(handle)
        _require_regular(path, found, limit)
        if own and not belongs_to_us(found):
            raise PermissionError(errno.EPERM, "it belongs to another user", str(path))
        pieces, length = [], 0
        while piece := stream.read(min(_PIECE, found.st_size + _SMALL)):
            pieces.append(piece)
            length += len(piece)
            if length > limit:  # it grew, or does not know its size
                raise TooLargeError(path, limit)
    return b"".join(pieces)


def sha256_of(path: str | Path) -> str:
    """The sha256 of a regular file's bytes; raises as `contents`."""
    return hashlib.sha256(contents(path, LARGEST_JOURNAL)).hexdigest()


def belongs_to_us(status: os.stat_result) -> bool:
    """Whether a file or folder is this user's; true where a system knows no owners."""
    return not hasattr(os, "geteuid") or status.st_uid == os.geteuid()


def _require_regular(path: str | Path, status: os.stat_result, limit: int) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if not stat.S_ISREG(status.st_mode):
        raise NotRegularError(path)
    if status.st_size > limit:
        raise TooLargeError(path, limit)

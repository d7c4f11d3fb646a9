"""A lock on a folder: of two commands that would write the same results the second is turned away.

It is the operating system's own lock of the folder, so that nothing lies in it, and none is left by a process that is
killed.
"""

from __future__ import annotations

import errno
import os
from pathlib import Path

from workbench.errors import InputError

_held: dict[Path, tuple[int, int]] = {}


class FolderLock:
    """Held from when it is made until `release`; one process may hold a folder several times.

    Raises InputError where another process holds it, and OSError where the folder is not there.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        handle, count = _held.get(self._folder) or (_locked(self._folder), 0)
        _held[self._folder] = handle, count + 1

    def release(self) -> None:
        """Let others in, where this process holds the folder no more than this once."""
        handle, count = _held.pop(self._folder)
        if count > 1:
            _held[self._folder] = handle, count - 1
        elif handle >= 0:
            os.close(handle)


def _locked(folder: Path) -> int:
    """The open folder; -1 where the system, or the disk that it lies on, knows no such lock."""
    try:
        import fcntl  # noqa: PLC0415 - there is none on Windows
    except ImportError:
        return -1
    handle = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as trouble:
        os.close(handle)
        if trouble.errno in (errno.EWOULDBLOCK, errno.EACCES):
            raise InputError(folder, "", "another command writes its results here: wait for it to end, or name "
                             "another output folder") from None
        return -1
    return handle

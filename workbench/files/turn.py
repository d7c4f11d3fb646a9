"""Turns: of several processes that lack the same thing one makes it, and the others wait until it is there.

It is the operating system's own lock of an empty file, which stays where it is: a process that is killed leaves its
turn to the next. Where there is no such lock each makes the thing, which costs time and nothing else.
"""

from __future__ import annotations

import os
import time
from pathlib import Path

# Nobody takes as long to make something: who does may have been stopped.
PATIENCE_S = 300.0
LONGEST_PAUSE_S = 0.1


class Turn:
    """The right of one process at a time to make something; path: the file that is locked, of no other use."""

    def __init__(self, path: Path) -> None:
        self._path, self._handle = path, -1

    def take(self) -> None:
        """Wait until no other process has the turn; of no effect where this one has it, or no file can be locked."""
        try:
            import fcntl  # noqa: PLC0415 - there is none on Windows
        except ImportError:
            return
        if self._handle >= 0:
            return
        try:
            handle = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o600)
        except OSError:
            return
        until, pause_s = time.monotonic() + PATIENCE_S, 0.001
        try:
            while time.monotonic() < until:
                try:
                    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    time.sleep(pause_s)
                    pause_s = min(2 * pause_s, LONGEST_PAUSE_S)
                else:
                    self._handle, handle = handle, -1
                    return
        except OSError:  # a disk without locks
            return
        finally:
            if handle >= 0:
                os.close(handle)

    def end(self) -> None:
        """Give the turn to the next one, where this process has it."""
        if self._handle >= 0:
            os.close(self._handle)
            self._handle = -1

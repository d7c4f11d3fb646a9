"""What a command costs with all that it starts: its workers too, which are children of a fork server, not its own."""

from __future__ import annotations

import ctypes
import os
import resource

PR_SET_CHILD_SUBREAPER = 36  # of prctl, Linux alone


def adopt() -> None:
    """From now on what is left of a child's processes is this process's to wait for."""
    if ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "prctl")


def seconds_of_all() -> float:
    """Processor time of all children that have ended and of theirs, after the last one has ended."""
    try:
        while True:
            os.wait()
    except ChildProcessError:
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

"""A limit of the computing time that one claim may take."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

AGAIN = 0.5  # seconds after which the interruption comes again, should a library have swallowed it


class OutOfTime(BaseException):  # noqa: N818 - no error; deciders and libraries that catch every Exception let it pass
    """The time that was given is used up."""


@contextmanager
def at_most_seconds(limit: float | None) -> Iterator[None]:
    """Raise OutOfTime in this block once it has used so many seconds of processor time, whatever else the machine does.

    Nothing is limited without a limit, outside of a process's main thread and on systems without such timers.
    """
    if limit is None or not hasattr(signal, "ITIMER_PROF") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise OutOfTime

    before = signal.signal(signal.SIGPROF, interrupt)
    try:
        signal.setitimer(signal.ITIMER_PROF, limit, AGAIN)
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)

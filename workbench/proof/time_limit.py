"""A limit of the computing time that one claim may take."""

from __future__ import annotations

import gc
import signal
import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

AGAIN = 0.5  # seconds after which the interruption comes again, should a library have swallowed it
SOON = 0.001  # the same where an exception would be dropped
WEAK_REFERENCES = (weakref.__file__, weakref.WeakSet.__init__.__code__.co_filename)


class OutOfTime(BaseException):  # no Exception: deciders and libraries that catch every one let it pass
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
        if _drops_exceptions(frame):
            signal.setitimer(signal.ITIMER_PROF, SOON, AGAIN)
        else:
            raise OutOfTime

    before = signal.signal(signal.SIGPROF, interrupt)
    try:
        signal.setitimer(signal.ITIMER_PROF, limit, AGAIN)
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _drops_exceptions(frame: FrameType | None) -> bool:
    """Whether the frame is in a callback of the collector, a finalizer or a weak reference's callback.

    Python reports what these raise and goes on, so that an exception raised there ends nothing.
    """
    collecting = {getattr(callback, "__code__", None) for callback in gc.callbacks}
    while frame is not None:
        code = frame.f_code
        if code in collecting or code.co_name == "__del__" or code.co_filename in WEAK_REFERENCES:
            return True
        frame = frame.f_back
    return False

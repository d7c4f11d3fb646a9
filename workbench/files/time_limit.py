"""A limit of the computing time that one claim, or the import of a module of a paper, may take."""

from __future__ import annotations

import gc
import signal
import threading
import time
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from workbench.errors import OutOfTime

AGAIN = 0.5  # seconds after which the interruption comes again, should a library have swallowed it
# So many calls are looked at: of a function that calls itself without end there may be millions.
LOOKED_AT = 2000
SOON = 0.001  # the same where an exception would be dropped
# Who has computed for less than IDLE_S in so many seconds, and was not kept from it by others for most of them, waits
# for what may never come, such as somebody to write into a pipe.
WAITING_S, IDLE_S = 20.0, 0.01
WEAK_REFERENCES = (weakref.__file__, weakref.WeakSet.__init__.__code__.co_filename)

_limited: list[float] = []


def out_of_time(limit: float | None) -> str:
    """Why a claim is undecided that took longer than the limit."""
    return f"not decided within {limit:g} seconds: allow more with --limit, or state it in smaller steps"


@contextmanager
def at_most_seconds(limit: float | None) -> Iterator[None]:
    """Raise OutOfTime in this block once it has used so many seconds of processor time, whatever else the machine does,
    or has waited for WAITING_S without using any.

    Nothing is limited without a limit, outside of a process's main thread and on systems without such timers; within
    another such block that one's limit holds.
    """
    here = threading.current_thread() is threading.main_thread()
    if limit is None or not hasattr(signal, "ITIMER_PROF") or not here or _limited:
        yield
        return

    def interrupt(number: int, frame: FrameType | None) -> None:
        if _drops_exceptions(frame):
            signal.setitimer(signal.ITIMER_PROF, SOON, AGAIN)
        else:
            raise OutOfTime

    def look(number: int, frame: FrameType | None) -> None:
        earlier, queued_earlier, idle = _limited
        now, queued = time.process_time(), _queued_s()
        waits = now - earlier < IDLE_S and queued - queued_earlier < WAITING_S / 4
        idle = idle + 1 if waits else 0  # a process that was stopped and goes on is idle once
        _limited[:] = [now, queued, idle]
        if idle >= 2:
            interrupt(number, frame)

    before = signal.signal(signal.SIGPROF, interrupt), signal.signal(signal.SIGALRM, look)
    _limited[:] = [time.process_time(), _queued_s(), 0]
    try:
        signal.setitimer(signal.ITIMER_PROF, limit, AGAIN)
        signal.setitimer(signal.ITIMER_REAL, WAITING_S / 2, WAITING_S / 2)
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGPROF, before[0])
        signal.signal(signal.SIGALRM, before[1])
        _limited.clear()


def _queued_s() -> float:
    """For how long this thread was ready to compute while others did; zero where the system does not tell."""
    try:
        return int(Path("/proc/thread-self/schedstat").read_text(encoding="ascii").split()[1]) * 1e-9
    except (OSError, ValueError, IndexError):
        return 0.0


def _drops_exceptions(frame: FrameType | None) -> bool:
    """Whether the frame is in a callback of the collector, a finalizer or a weak reference's callback.

    Python reports what these raise and goes on, so that an exception raised there ends nothing.
    """
    collecting = {getattr(callback, "__code__", None) for callback in gc.callbacks}
    for _ in range(LOOKED_AT):
        if frame is None:
            return False
        code = frame.f_code
        if code in collecting or code.co_name == "__del__" or code.co_filename in WEAK_REFERENCES:
            return True
        frame = frame.f_back
    return False

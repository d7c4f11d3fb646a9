"""What a module of a paper changes for everybody else as it is imported: put back, and said with its file.

What it prints goes to standard error, so that standard output has the command's own answer alone; it finds nothing on
standard input, and its warnings are notes in a line each. All of this in a process's main thread only: beside others
nobody can tell whose change it was.
"""

from __future__ import annotations

import builtins
import gc
import io
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TextIO

from workbench.errors import InputError
from workbench.files.cache_folder import note

CHILDREN = Path("/proc/thread-self/children")  # of Linux, and not of every one
SOON_S = 0.2  # for which a thread is waited that may be about to end
REMEDY = "leave that out"


def _of(module: str, read: Callable[[Any], Any], write: Callable[[Any, Any], object]) -> tuple[
        Callable[[], Any], Callable[[Any], object]]:
    """How the state of a module is read and written, where it has been imported; unknown where it has not."""
    def get() -> Any:
        found = sys.modules.get(module)
        return None if found is None else read(found)

    return get, lambda value: None if value is None else write(sys.modules[module], value)


def _folder() -> str:
    try:
        return str(Path.cwd())
    except OSError:  # it was removed
        return ""


# What it is, how it is read, how it is put back.
STATE: tuple[tuple[str, tuple[Callable[[], Any], Callable[[Any], object]]], ...] = (
    ("sys.path", (lambda: list(sys.path), lambda before: sys.path.__setitem__(slice(None), before))),
    ("sys.meta_path", (lambda: list(sys.meta_path), lambda before: sys.meta_path.__setitem__(slice(None), before))),
    ("the working folder", (_folder, lambda before: os.chdir(before) if before else None)),
    ("the locale", _of("locale", lambda m: m.setlocale(m.LC_ALL, None), lambda m, v: m.setlocale(m.LC_ALL, v))),
    ("decimal's context", _of("decimal", lambda m: _decimal(m.getcontext()),
                              lambda m, v: m.setcontext(m.Context(*v[:-1], traps=list(v[-1]))))),
    ("mpmath's precision", _of("mpmath", lambda m: (m.mp.prec, m.iv.prec),
                               lambda m, v: _set_precision(m, *v))),
    ("what numpy does at an error", _of("numpy", lambda m: m.geterr(), lambda m, v: m.seterr(**v))),
)


def _set_precision(mpmath: Any, of_points: int, of_intervals: int) -> None:
    mpmath.mp.prec, mpmath.iv.prec = of_points, of_intervals


def _decimal(context: Any) -> tuple[Any, ...]:
    """All of a context but its flags, which computing alone raises."""
    traps = tuple(signal for signal, on in context.traps.items() if on)
    return context.prec, context.rounding, context.Emin, context.Emax, context.capitals, context.clamp, traps


class Unclosable(io.TextIOBase):
    """Standard error, for what a paper's code prints: closing it closes nothing."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str, /) -> int:
        """Say it on standard error."""
        return self._stream.write(text)

    def flush(self) -> None:
        """Have it said now."""
        self._stream.flush()

    def fileno(self) -> int:
        """The number of standard error."""
        return self._stream.fileno()

    def isatty(self) -> bool:
        """Whether standard error is a terminal."""
        return self._stream.isatty()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """That of standard error."""
        return self._stream.encoding

    def close(self) -> None:
        """Nothing: the stream is not the paper's."""


@contextmanager
def state_kept(path: str) -> Iterator[None]:
    """Run the code of a module. STATE that it has changed is put back with a note, since many a module means its own
    numbers alone; InputError, naming its file, where it has taken builtins or modules away or left something running.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = [(what, get, put, get()) for what, (get, put) in STATE]
    own, modules, collecting = vars(builtins), dict(sys.modules), gc.isenabled()
    names = dict(own)
    threads, children = set(threading.enumerate()), _children()
    streams = sys.stdin, sys.stdout, sys.stderr
    said = Unclosable(sys.stderr)
    sys.stdin, sys.stdout, sys.stderr = io.StringIO(), said, said
    changed: list[str] = []
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _told
            yield
    finally:
        if own != names:  # before anything else is called
            own.clear()
            own.update(names)
            changed.append("builtins")
        sys.stdin, sys.stdout, sys.stderr = streams
        if collecting != gc.isenabled():
            (gc.enable if collecting else gc.disable)()
        if len(sys.modules) < len(modules):
            sys.modules.update(modules)
            changed.append("sys.modules")
        for what, get, put, value in before:
            if value is not None and get() != value:
                put(value)
                note(f"{path}: changes {what} for all other code as it is imported: put back to what it was")
        left = _ended(_children() - children)
    if changed:
        raise InputError(path, "", f"changes {changed[0]} for all other code as it is imported: {REMEDY}")
    if left or _running(threads):
        what = "another process" if left else "a thread"
        raise InputError(path, "", f"starts {what} as it is imported, and does not end it: {REMEDY}")


def _told(message: Warning | str, category: type[Warning], filename: str, lineno: int, file: TextIO | None = None,
          line: str | None = None) -> None:
    del file, line
    note(f"{filename}: line {lineno}: {category.__name__}: {message}")


def _running(before: set[threading.Thread]) -> bool:
    """Whether a thread was started that keeps the process from ending."""
    new = [thread for thread in threading.enumerate() if thread not in before and not thread.daemon]
    for thread in new:
        thread.join(SOON_S)
    return any(thread.is_alive() for thread in new)


def _children() -> set[int]:
    """The processes that this thread has started and that are there; none where the system does not say."""
    try:
        return set(map(int, CHILDREN.read_bytes().split()))
    except OSError:
        return set()


def _ended(children: set[int]) -> list[int]:
    """Kill those that still run; which they were."""
    left = []
    for number in children:
        with suppress(OSError):
            if os.waitpid(number, os.WNOHANG) == (0, 0):
                left.append(number)
                os.kill(number, signal.SIGKILL)
                os.waitpid(number, 0)
    return left

"""Calls by which a paper's own code would end, double or disable the command that runs it: refused, with their line.

The functions of the standard library are replaced once, when the first module of a paper is about to be imported; for
whoever else calls them they do what they did. This keeps accidents from passing for an answer, as `os._exit(0)` would
for "as recorded". It is no prison: code that means harm finds other ways, so run no paper that you do not trust.
"""

from __future__ import annotations

import atexit
import functools
import os
import signal
import sys
from collections.abc import Callable
from functools import cache
from types import FrameType, ModuleType
from typing import Any

from workbench.errors import InputError
from workbench.files.streams import STREAMS
from workbench.files.text import is_source

try:
    import resource
except ImportError:  # a system without such limits
    resource = None  # type: ignore[assignment]

ENDS, DOUBLES = "ends this command", "makes another process of this command"
STANDS_STILL = "changes the folder that this command works in"
SIGNALS, CLOSES = "takes over signals that this command needs", "closes its standard streams"
FORBIDDEN: tuple[tuple[ModuleType | None, tuple[str, ...], str], ...] = (
    (os, ("_exit", "abort", "kill", "killpg", "execv", "execve"), ENDS),
    (os, ("fork", "forkpty"), DOUBLES),
    (os, ("chdir", "fchdir", "chroot"), STANDS_STILL),
    (os, ("close", "closerange", "dup2"), CLOSES),
    (signal, ("signal", "setitimer", "alarm", "set_wakeup_fd", "pthread_sigmask", "pthread_kill", "raise_signal"),
     SIGNALS),
    (sys, ("settrace", "setprofile"), "watches this command's own code"),
    (atexit, ("register", "unregister"), "changes what is done as this command ends"),
    (resource, ("setrlimit",), "changes the limits of this process"),
)


@cache
def guard_calls() -> None:
    """Refuse what is FORBIDDEN to a paper's code in this process from now on, by an InputError with file and line."""
    for module, names, why in FORBIDDEN:
        for name in names:
            original = getattr(module, name, None)
            if module is not None and original is not None:
                setattr(module, name, _guarded(original, f"{module.__name__}.{name}", why))


def _guarded(original: Callable[..., Any], name: str, why: str) -> Callable[..., Any]:
    @functools.wraps(original)
    def guarded(*arguments: Any, **named: Any) -> Any:
        frame = sys._getframe(1)
        while frame.f_globals is os.__dict__ and frame.f_back is not None:  # os.execl calls os.execv
            frame = frame.f_back
        if is_source(frame.f_code.co_filename) and (why is not CLOSES or _of_streams(arguments)):
            raise refused_call(frame, name, why)
        return original(*arguments, **named)

    return guarded


def refused_call(frame: FrameType, name: str, why: str) -> InputError:
    """What is said of a call that a paper's code makes and may not."""
    return InputError(frame.f_code.co_filename, "", f"line {frame.f_lineno}: calls {name}, which {why}: leave it out")


def _of_streams(arguments: tuple[Any, ...]) -> bool:
    return any(isinstance(number, int) and number < STREAMS for number in arguments)

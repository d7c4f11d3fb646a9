"""Standard streams that take whatever is said: closed ones, those of terminals with few letters, and those that nobody
reads any more. Standard output is the command's own; what others print goes to standard error."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

STREAMS = 3  # the numbers below it are those of the standard streams
_own: ContextVar[TextIO | None] = ContextVar("own_output", default=None)


def ready_streams() -> None:
    """Put a stream that keeps nothing in place of a closed one; what has no letters in a stream's encoding, or is no
    letter, as of a file's name that is no text, is written by its number."""
    # The number of a closed one would be given to the next file that is opened, and what is said written into that.
    while (number := os.open(os.devnull, os.O_RDWR)) < STREAMS:
        pass
    os.close(number)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115 - as long as the process
        stream = getattr(sys, name)
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def own_output() -> TextIO:
    """Standard output, for the answer of a command alone."""
    return _own.get() or sys.stdout


@contextmanager
def output_kept() -> Iterator[None]:
    """Keep standard output for what is written to `own_output` in this block: what a paper's code prints would stand
    in the middle of a document, and goes to standard error."""
    own = sys.stdout
    token = _own.set(own)
    sys.stdout = sys.stderr
    try:
        yield
    finally:
        sys.stdout = own
        _own.reset(token)


def drop_output() -> None:
    """Have what is still to be said kept by nobody: whoever read it is gone, and Python would fail on it as it ends."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
            continue
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)

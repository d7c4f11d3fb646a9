"""Standard streams that take whatever is said: closed ones, and those of terminals with few letters."""

from __future__ import annotations

import os
import sys
from io import TextIOWrapper
from pathlib import Path


def ready_streams() -> None:
    """Put a stream that keeps nothing in place of a closed one; what has no letters in a stream's encoding, or is no
    letter, as of a file's name that is no text, is written by its number."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115 - as long as the process
        stream = getattr(sys, name)
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")

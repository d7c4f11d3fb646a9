"""When Python looks for objects that only refer to each other: not before there can be many.

What a command imports stays until it ends. To look through all of it again and again while it is being imported costs
a seventh of a short command, and frees nothing. To look through all of it once more as it ends costs up to a fifth:
what is left goes with the process.
"""

from __future__ import annotations

import atexit
import gc

# More objects than short commands make with all that they import (compare: 340,000, some 100 MB in all).
MANY = 500_000


def collect_later() -> None:
    """Begin to collect once this process has made MANY objects more than it dropped, and go on as it would have."""
    ordinary = gc.get_threshold()
    if not 0 < ordinary[0] < MANY:  # not at all, or later still: someone else's choice, or ours from before
        return

    def begin(phase: str, info: dict[str, int]) -> None:
        del phase, info
        gc.set_threshold(*ordinary)
        gc.callbacks.remove(begin)

    gc.callbacks.append(begin)
    gc.set_threshold(MANY, *ordinary[1:])


def end_without_search() -> None:
    """Have this process end without looking for objects that only refer to each other.

    Asked for twice, it is done once. What is to be closed or removed at the end still is, since Python does that first.
    """
    atexit.unregister(gc.freeze)
    atexit.register(gc.freeze)

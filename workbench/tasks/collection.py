"""When Python looks for objects that only refer to each other: seldom, and never among what is imported.

What a command imports stays until it ends. To look through all of it again and again while it is being imported costs
a seventh of a short command, and frees nothing. Sympy makes and drops many small objects, hardly any in circles: to
look after every 700 new ones, as Python does, costs a sixth of a long command. To look through all of it once more as
it ends costs up to a fifth: what is left goes with the process.
"""

from __future__ import annotations

import atexit
import gc
from collections.abc import Iterator
from contextlib import contextmanager

# More objects than short commands make with all that they import (compare: 340,000, some 100 MB in all).
MANY = 500_000
SELDOM = 20_000  # objects after which the youngest are looked through; fewer searches save no more


def collect_later() -> None:
    """Begin to collect once this process has made MANY objects more than it dropped, and seldom from then on."""
    ordinary = gc.get_threshold()
    if not 0 < ordinary[0] < SELDOM:  # not at all, or later still: someone else's choice, or ours from before
        return

    def begin(phase: str, info: dict[str, int]) -> None:
        del phase, info
        gc.set_threshold(SELDOM, *ordinary[1:])
        gc.callbacks.remove(begin)

    gc.callbacks.append(begin)
    gc.set_threshold(MANY, *ordinary[1:])


@contextmanager
def imports_left_out() -> Iterator[None]:
    """Nothing is looked through while the block imports, and what it has made never is, here and in all processes
    that are forked from this one, which look seldom. Memory that nobody looks through stays shared with them."""
    first, *others = gc.get_threshold()
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        if 0 < first < SELDOM:
            gc.set_threshold(SELDOM, *others)
        gc.enable()


def end_without_search() -> None:
    """Have this process end without looking for objects that only refer to each other.

    Asked for twice, it is done once. What is to be closed or removed at the end still is, since Python does that first.
    """
    atexit.unregister(gc.freeze)
    atexit.register(gc.freeze)

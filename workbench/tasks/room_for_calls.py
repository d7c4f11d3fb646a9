"""Room for deep calls, so that none of them is made at the edge of a piece of memory.

CPython keeps the frames of running functions in pieces of 16 kB: a call that does not fit in the last one has another
mapped, which is given back as the call returns. A function that is called again and again just at such an edge waits
for the system each time: to compile a kernel took nearly twice as long where its stack happened to end there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")

# Half a megabyte for one frame: its piece is the next power of two, and what is left of that holds thousands of others.
_VALUES = 1 << 16


def with_room_for_calls(work: Callable[P, R], *arguments: P.args, **named: P.kwargs) -> R:
    """work(*arguments, **named), whose calls of one another all fit in one piece of memory."""
    return work(*arguments, **named)


# No more than said: values beyond those that a function uses are never written, so that this memory is never touched.
with_room_for_calls.__code__ = with_room_for_calls.__code__.replace(co_stacksize=_VALUES)

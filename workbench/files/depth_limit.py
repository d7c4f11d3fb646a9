"""A limit of the depth of calls that a module of a paper may ask Python for."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

# Ten times what Python allows by itself. Of a function that calls itself without end millions of calls would be undone
# one by one when its time is used up, which takes longer than the time itself, and a gigabyte.
MOST_CALLS = 10_000


@contextmanager
def limited_depth() -> Iterator[None]:
    """Let this block set Python's limit of the depth of calls to MOST_CALLS at most, whatever it asks for."""
    set_limit = sys.setrecursionlimit
    sys.setrecursionlimit = lambda limit, /: set_limit(min(limit, MOST_CALLS))
    try:
        yield
    finally:
        sys.setrecursionlimit = set_limit

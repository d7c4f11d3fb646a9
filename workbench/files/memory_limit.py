"""A limit of the memory that the import of a module of a paper may take."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    import resource
except ImportError:  # a system without such limits
    resource = None  # type: ignore[assignment]

STATM = Path("/proc/self/statm")
DATA = 5  # the field of that file with the pages of data
# Libraries of linear algebra reserve a buffer and a stack for each of their threads.
FOR_ANY, FOR_A_CORE = 800 * 2**20, 2**26


@contextmanager
def limited_memory() -> Iterator[None]:
    """Let this block take so much memory beyond what is in use: beyond that Python raises MemoryError.

    Nothing is limited where a system does not say what is in use, or where less is allowed already.
    """
    if resource is None or not STATM.exists():
        yield
        return
    before = resource.getrlimit(resource.RLIMIT_DATA)
    used = int(STATM.read_text(encoding="ascii").split()[DATA]) * resource.getpagesize()
    limit = used + FOR_ANY + FOR_A_CORE * (os.cpu_count() or 1)
    if any(bound != resource.RLIM_INFINITY and bound <= limit for bound in before):
        yield
        return
    resource.setrlimit(resource.RLIMIT_DATA, (limit, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, before)

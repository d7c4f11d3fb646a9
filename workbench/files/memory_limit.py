"""What the import of a module of a paper may take of memory, and what of the system a command must be allowed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workbench.errors import WorkbenchError

try:
    import resource
except ImportError:  # a system without such limits
    resource = None  # type: ignore[assignment]

STATM = Path("/proc/self/statm")
DATA = 5  # the field of that file with the pages of data
# Libraries of linear algebra reserve a buffer and a stack for each of their threads.
FOR_ANY, FOR_A_CORE = 800 * 2**20, 2**26
# With less, OpenBLAS asks again and again for its buffers while it is imported, and never comes back.
LEAST_ALLOWED = 512 * 2**20
LEAST_FILES = 64  # a server of processes, and pipes to some of them
MORE = "allow more, as by 'ulimit -v unlimited'"
MORE_FILES = "allow more, as by 'ulimit -n 1024'"


def require_memory() -> None:
    """WorkbenchError where the shell allows this process too little memory to import what it computes with."""
    for limit, option in ((resource.RLIMIT_AS, "-v"), (resource.RLIMIT_DATA, "-d")) if resource else ():
        allowed = resource.getrlimit(limit)[0]
        if allowed != resource.RLIM_INFINITY and allowed < LEAST_ALLOWED:
            raise WorkbenchError(f"this shell allows a command {allowed >> 20} MiB of memory (ulimit {option}), and it "
                                 f"needs {LEAST_ALLOWED >> 20} at least: {MORE.replace('-v', option)}")


def require_files() -> None:
    """WorkbenchError where the shell allows too few open files to start processes."""
    allowed = resource.getrlimit(resource.RLIMIT_NOFILE)[0] if resource else LEAST_FILES
    if 0 <= allowed < LEAST_FILES:
        raise WorkbenchError(f"this shell allows a command {allowed} open files (ulimit -n), and processes need "
                             f"{LEAST_FILES} at least: {MORE_FILES}, or take --workers 1")


def is_of_memory(trouble: BaseException) -> bool:
    """Whether an exception says that no memory is left: as Python tells it, or the system that loads a library."""
    return isinstance(trouble, MemoryError) or (
        isinstance(trouble, ImportError) and any(words in str(trouble) for words in (
            "failed to map segment", "cannot allocate memory", "Cannot allocate memory")))


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

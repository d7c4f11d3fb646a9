"""How many threads numerical libraries use: the order of their sums, and so the last bits, depends on it."""

from __future__ import annotations

import os

THREAD_LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS",
                 "VECLIB_MAXIMUM_THREADS")


def use_one_thread() -> None:
    """Let this process compute as its workers do, unless the caller's environment says otherwise; before numpy."""
    for name in THREAD_LIMITS:
        os.environ.setdefault(name, "1")

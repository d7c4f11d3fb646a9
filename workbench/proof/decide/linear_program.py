"""A linear program by HiGHS, with an end to its iterations and nothing on standard output."""

from __future__ import annotations

import ctypes
import os
import platform
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache

import numpy as np
from scipy.optimize import OptimizeResult, linprog
from scipy.sparse import csc_array

# One that turns in circles ends without an answer, and only after minutes; one that has an answer takes less than two
# iterations a row.
ITERATIONS, ITERATIONS_A_ROW = 1000, 3
_lock = threading.Lock()


def least(cost: np.ndarray, matrix: csc_array, right: np.ndarray,
          limits: Sequence[tuple[float | None, float | None]]) -> OptimizeResult:
    """The least cost of matrix x = right with x between limits, as scipy says it: `status` is 0 for a solution."""
    options = {"maxiter": ITERATIONS + ITERATIONS_A_ROW * matrix.shape[0]}
    with _printf_dropped():
        return linprog(cost, A_eq=matrix, b_eq=right, bounds=limits, method="highs-ds", options=options)


@contextmanager
def _printf_dropped() -> Iterator[None]:
    """Drop what C code prints within this block: of a program that it gives up HiGHS says so by printf, whatever its
    options are. The file descriptors stay as they are, so that nothing but printf is kept from anyone."""
    found = _c_streams()
    if found is None:
        yield
        return
    stdout, nowhere = found
    with _lock:
        before, stdout.value = stdout.value, nowhere
        try:
            yield
        finally:
            stdout.value = before


@cache
def _c_streams() -> tuple[ctypes.c_void_p, int] | None:
    """The variable that holds the standard output of C, and a stream to nowhere; None where it is no variable."""
    if platform.libc_ver()[0] != "glibc":
        return None
    c = ctypes.CDLL(None)
    c.fopen.restype = ctypes.c_void_p
    nowhere = c.fopen(os.devnull.encode(), b"w")
    return (ctypes.c_void_p.in_dll(c, "stdout"), nowhere) if nowhere else None

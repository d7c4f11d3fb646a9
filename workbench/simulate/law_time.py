"""How long a compiled law takes for a step, without the plant that it drives: kernel beside kernel of MPC."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import loop_module
from workbench.simulate import repeated_law

BLOCKS, ROWS = 5, 250

Array = NDArray[np.float64]


def law_step_us(answer: Any, log: Array, period_s: float, values: tuple[Array, Array, Array, Array]) -> Array:
    """Microseconds of a step of a law, the mean of each of some blocks over states that a run has met.

    answer: the law as the compiled loop calls it; log: of the run, shape (rows, columns of `kernel_loop`); values: as
    of `run_law`, which stay as they are. None are told, shape (0,), where the law leaves its domain at once.
    """
    rows = np.ascontiguousarray(log[::max(1, -(-len(log) // ROWS)), :6])
    ask = _asked_again()
    parameters, *others = values
    own, state = [parameters, *(array.copy() for array in others)], np.zeros(3)
    answered = ask(answer, rows, len(rows), period_s, state, *own)  # warms the caches as the loop before it has
    if not answered:
        return np.zeros(0)

    def seconds(count: int) -> float:
        before = time.perf_counter()
        ask(answer, rows, count, period_s, state, *own)
        return time.perf_counter() - before

    calling = min(seconds(0) for _ in range(BLOCKS))
    return np.array([max(0.0, seconds(answered) - calling) * 1e6 / answered for _ in range(BLOCKS)])


@cache
def _asked_again() -> Callable[..., int]:
    return loop_module("a law asked again", [], repeated_law).repeated_law

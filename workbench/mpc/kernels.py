"""The compiled solvers of the tracking problem, and the memory they work in."""

from __future__ import annotations

import functools
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import loop_module
from workbench.compile.text import loop_text
from workbench.mpc import quadratic_kernel, solver_kernel
from workbench.mpc.model import SOFT, Actuator, kernel_functions
from workbench.mpc.problem import Array

Memory = tuple[NDArray[np.int64], NDArray[np.int64], Array]


@functools.cache
def kernels(actuator: Actuator) -> ModuleType:
    """The module of `solve_linear`, `solve_nonlinear` and what they are made of, for one actuator."""
    stages = loop_text(quadratic_kernel)
    return loop_module(f"train.py with its actuator ({actuator})", [*kernel_functions(actuator), stages], solver_kernel)


def memory(horizon: int) -> Memory:
    """An active set: commands at a limit, the state of the soft rows, their multipliers."""
    return (np.zeros(horizon, dtype=np.int64), np.zeros((horizon + 1, len(SOFT)), dtype=np.int64),
            np.zeros((horizon + 1, len(SOFT))))


def workspace(horizon: int) -> tuple[Array, ...]:
    """Q0, q0, R, r, low, high, bound, slope, Q, q, kept, dx, du of the kernels."""
    N = horizon
    shapes: list[tuple[int, ...]] = [(N + 1, 6), (N + 1, 3), (N,), (N,), (N,), (N,), (N,), (N,), (N + 1, 6),
                                     (N + 1, 3), (N, 5), (N + 1, 3), (N,)]
    return tuple(np.zeros(shape) for shape in shapes)


def base(horizon: int) -> tuple[Array, ...]:
    """x, tried x, tried u, Jacobians, gaps, soft rows and their gradients of the kernels."""
    N = horizon
    shapes: list[tuple[int, ...]] = [(N + 1, 3), (N + 1, 3), (N,), (N, 12), (N, 3), (N + 1, len(SOFT)),
                                     (N + 1, len(SOFT), 3)]
    return tuple(np.zeros(shape) for shape in shapes)

"""The linear-quadratic regulator of a sampled system, by python-control."""

from __future__ import annotations

from typing import Any

from workbench.mpc.problem import Array


def dlqr(*matrices: Array) -> tuple[Any, Any]:
    """Gain and cost matrix of the discrete LQR of A, B and the weights Q, R and, where states and inputs are weighted
    together, N; errors as python-control raises them, ValueError and LinAlgError."""
    import control  # noqa: PLC0415 - importing it takes seconds, and most commands need none of it

    gain, cost, _ = control.dlqr(*matrices)
    return gain, cost

"""The linear-quadratic regulator of a sampled system, by scipy's Riccati equation.

The steps are those of python-control's `dlqr`, whose bits they give without the seconds that importing it takes.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve, solve_discrete_are

from workbench.mpc.problem import Array


def dlqr(A: Array, B: Array, Q: Array, R: Array, N: Array | None = None) -> tuple[Array, Array]:
    """Gain and cost matrix of the discrete LQR of x(k+1) = A x + B u, which minimises the sum of x'Qx + u'Ru + 2 x'Nu.

    A, Q: shape (n, n); B, N: (n, m); R: (m, m), the weights symmetric. Raises ValueError and LinAlgError where there is
    none.
    """
    A, B, Q, R = (np.array(matrix, ndmin=2, dtype=float) for matrix in (A, B, Q, R))
    together = np.zeros(B.shape) if N is None else np.array(N, ndmin=2, dtype=float)
    cost = solve_discrete_are(A, B, Q, R, s=together)
    gain = solve(B.T @ cost @ B + R, B.T @ cost @ A + together.T)
    return np.asarray_chkfinite(gain), cost

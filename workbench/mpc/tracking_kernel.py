"""The program of `tracking.py` where none of its limits binds, by Riccati's recursion; compiled.

Errors e, v follow e' = e + alpha v + beta z, v' = phi v + psi z with z = w + d, what is added to the feedforward and
the disturbance. In z the program without limits is linear-quadratic, without a linear term.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

# --- kernel ---


def free_plan(first, e, v, d, moves, weights, terminal, low, high, band, gains, plan):
    """Whether the best plan without limits, which `plan` (N) then is, keeps all of them.

    first: the sample that the plan begins at; moves: (4, samples), alpha, beta, phi and psi; weights: of the squares of
    e, v and z; terminal: (2, 2); low, high: of w, a number a sample; gains: (N, 2), room for the feedback.
    """
    N = plan.shape[0]
    P00, P01, P11 = terminal[0, 0], terminal[0, 1], terminal[1, 1]
    for k in range(N - 1, -1, -1):
        alpha, beta, phi, psi = moves[0, first + k], moves[1, first + k], moves[2, first + k], moves[3, first + k]
        b0, b1 = P00 * beta + P01 * psi, P01 * beta + P11 * psi
        curvature = weights[2] + beta * b0 + psi * b1
        g0, g1 = b0, b0 * alpha + b1 * phi
        gains[k, 0], gains[k, 1] = g0 / curvature, g1 / curvature
        a01 = P00 * alpha + P01 * phi
        a11 = alpha * a01 + phi * (P01 * alpha + P11 * phi)
        P00 = weights[0] + P00 - g0 * gains[k, 0]
        P01 = a01 - g0 * gains[k, 1]
        P11 = weights[1] + a11 - g1 * gains[k, 1]
    for k in range(N):
        z = -(gains[k, 0] * e + gains[k, 1] * v)
        w = z - d
        e = e + moves[0, first + k] * v + moves[1, first + k] * z
        v = moves[2, first + k] * v + moves[3, first + k] * z
        # A number that is none passes no comparison.
        if not (low[first + k] <= w <= high[first + k] and abs(e) <= band):
            return False
        plan[k] = w
    return True

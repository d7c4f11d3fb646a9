"""State feedback for a polytope of linear plants: K = Y P^-1 with an exact certificate of decay or of an L2 gain.

x' = A x + B u + E w, z = C x + D u. With V = x^T P^-1 x and Y = K P the conditions are linear in P and Y (Bernussou,
Peres and Geromel, Systems and Control Letters 13, 1989), and hold for a polytope where they hold at its extremes; each
is a quadratic form for all values of its symbols, which the search of gains proves. The certificate is of the matrices;
that they enclose a plant's linearisation is `linearised`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import log2, sqrt

import numpy as np
import sympy as sp
from scipy.linalg import solve_continuous_are

from workbench.errors import InputError, SolverError
from workbench.gains.exact import fraction, rational, solve_exactly
from workbench.gains.linearised import LinearPlants
from workbench.gains.problem import Problem
from workbench.gains.search import Found, Infeasible, search
from workbench.proof.claim import Relation, at_least, at_most

WIDEST = 30  # times the radii
ROOM = 5e-3  # of the least gain: at that itself gains are without bound


@dataclass(frozen=True)
class Feedback:
    """u = u_0 + K (x - x_0): K exactly, what the search proved of it, and the search itself."""

    K: sp.Matrix
    found: Found
    bound: float


class _Unknown:
    """P and Y as symbols, and the quadratic forms in which they enter."""

    def __init__(self, plants: LinearPlants) -> None:
        n, m = len(plants.states), len(plants.inputs)
        self.P = sp.Matrix(n, n, lambda i, j: sp.Symbol(f"P_{min(i, j) + 1}_{max(i, j) + 1}", real=True))
        self.Y = sp.Matrix(m, n, lambda i, j: sp.Symbol(f"Y_{i + 1}_{j + 1}", real=True))
        self.x = sp.Matrix(sp.symbols(f"xi_1:{n + 1}", real=True))

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """The distinct unknowns."""
        return tuple(dict.fromkeys((*self.P, *self.Y)))

    def scales(self, radii: Sequence[Fraction], inputs: Sequence[Fraction]) -> dict[sp.Symbol, Fraction]:
        """Typical sizes for states and inputs of these sizes."""
        n = range(len(radii))
        return {**{self.x[i]: 1 / radii[i] for i in n}, **{self.P[i, j]: radii[i] * radii[j] for i in n for j in n},
                **{self.Y[k, j]: one * radii[j] for k, one in enumerate(inputs) for j in n}}

    def moving(self, A: sp.Matrix, B: sp.Matrix) -> sp.Expr:
        """x^T (A P + P A^T + B Y + Y^T B^T) x."""
        return sp.expand(2 * (self.x.T * (A * self.P + B * self.Y) * self.x)[0])

    def reach(self, radii: Sequence[Fraction]) -> Relation:
        """x^T P^-1 x <= 1 wherever x is in the ellipsoid of these semi-axes."""
        return at_least(self.size(), sum((rational(r) ** 2 * x**2 for r, x in zip(radii, self.x, strict=True)),
                                         sp.Integer(0)))

    def within(self, radii: Sequence[Fraction]) -> Relation:
        """x^T P^-1 x >= 1 wherever x is out of the ellipsoid of WIDEST times these semi-axes.

        Where a direction costs no command P could grow in it without end, and the solver with it.
        """
        return at_most(self.size(), WIDEST**2 * sum((rational(r) ** 2 * x**2 for r, x in zip(
            radii, self.x, strict=True)), sp.Integer(0)))

    def size(self) -> sp.Expr:
        """x^T P x."""
        return (self.x.T * self.P * self.x)[0]

    def K(self, found: Found) -> sp.Matrix:
        """Y P^-1 with the values found, exactly."""
        P, Y = (part.xreplace(found.values) for part in (self.P, self.Y))
        rows = [solve_exactly([[fraction(x) for x in P.row(i)] for i in range(P.rows)], [fraction(x) for x in Y.row(k)])
                for k in range(Y.rows)]
        assert all(row is not None for row in rows)  # P is proved to be positive definite
        return sp.Matrix([[rational(x) for x in row or ()] for row in rows])


def decaying(name: str, plants: LinearPlants, rate: Fraction, radius: Mapping[str, Fraction],
             largest: Mapping[str, Fraction] | None = None) -> Feedback:
    """The feedback with the least command among those proved to decay.

    For every plant of the polytope V' <= -2 rate V, and from every state of the ellipsoid with the semi-axes `radius`
    on, each input stays within `bound` times its size in `largest` (one unless given) for all times, and each state
    within WIDEST times its radius. Raises Infeasible where there is none, SolverError, InputError.
    """
    unknown, square = _Unknown(plants), sp.Symbol("U", positive=True)
    inputs = sp.Matrix(sp.symbols(f"omega_1:{len(plants.inputs) + 1}", real=True))
    most = [(largest or {}).get(name, Fraction(1)) for name in plants.inputs]
    conditions = dict(_decay(unknown, plants, rate))
    radii = [radius[state] for state in plants.states]
    conditions["reach"] = unknown.reach(radii)
    conditions["within"] = unknown.within(radii)
    for k, w in enumerate(inputs):
        both = unknown.size() + 2 * w * (unknown.Y[k, :] * unknown.x)[0] + square * rational(most[k]) ** 2 * w**2
        conditions[f"command {plants.inputs[k]}"] = at_least(both, 0)
    typical = _typical(plants, rate, radii)
    usual = max(size / one for size, one in zip(typical, most, strict=True)) ** 2
    scales = unknown.scales(radii, typical) | {w: 1 / size for w, size in zip(inputs, typical, strict=True)} | {
        square: usual}
    try:
        found = search(Problem(name, (*unknown.symbols, square), conditions, minimise=square, scales=scales))
    except SolverError:
        # At the border of no command at all no rounding can be proved.
        if _decays_alone(name, plants, rate, radius):
            raise InputError(name, "rate", f"{float(rate):g} 1/s is proved without feedback: ask for more") from None
        raise
    return Feedback(unknown.K(found), found, sqrt(found.values[square]))


def _decays_alone(name: str, plants: LinearPlants, rate: Fraction, radius: Mapping[str, Fraction]) -> bool:
    try:
        proved_decay(name, plants, [[Fraction(0)] * len(plants.states)] * len(plants.inputs), rate, radius)
    except (Infeasible, SolverError):
        return False
    return True


def _typical(plants: LinearPlants, rate: Fraction, radii: Sequence[Fraction]) -> list[Fraction]:
    """How large an input is that moves a state of the size of its radius by the rate.

    By the regulator of least energy that decays so fast, where the first plant has one: an unstable plant takes more.
    """
    A, B = plants.extremes[0]
    sizes = np.array([float(r) for r in radii])
    a, b = (np.array(part.tolist(), dtype=float).reshape(part.shape) / sizes[:, None] for part in (A, B))
    a = a * sizes + float(rate) * np.eye(len(sizes))
    units = 1 / np.maximum(np.abs(b).max(axis=0), 1e-300)
    try:
        X = solve_continuous_are(a, b * units, 1e-6 * np.eye(len(sizes)), np.eye(len(units)))
        moving = units * np.linalg.norm((b * units).T @ X, axis=1)
    except np.linalg.LinAlgError:
        moving = np.zeros(len(units))
    found = []
    for k in range(B.cols):
        ways = [rate * r / abs(fraction(B[i, k])) for i, r in enumerate(radii) if B[i, k]]
        least = min(ways) if ways else Fraction(1)
        found.append(max(least, Fraction(2) ** round(log2(moving[k]))) if 0 < moving[k] < float("inf") else least)
    return found


def _decay(unknown: _Unknown, plants: LinearPlants, rate: Fraction) -> Iterator[tuple[str, Relation]]:
    for number, (A, B) in enumerate(plants.extremes):
        yield f"decay {number + 1}", at_most(unknown.moving(A, B), -2 * rational(rate) * unknown.size())


def attenuating(name: str, plants: LinearPlants, E: sp.Matrix, C: sp.Matrix, D: sp.Matrix) -> Feedback:
    """The feedback with the least proved L2 gain from w to z = C x + D u, `bound`; D u must weigh every input.

    By the bounded real lemma, one V for every plant of the polytope. Raises as `decaying`.
    """
    unknown, gamma = _Unknown(plants), sp.Symbol("gamma", positive=True)
    radii, inputs, usual, speed = _optimal_sizes(plants, E, C, D)
    w, z = (sp.Matrix(sp.symbols(f"{letter}_1:{count + 1}", real=True))
            for letter, count in (("w", E.cols), ("z", C.rows)))
    passed = (z.T * (C * unknown.P + D * unknown.Y) * unknown.x)[0]
    least = sum((rational(r) ** 2 * x**2 for r, x in zip(radii, unknown.x, strict=True)), sp.Integer(0)) / 10**6
    conditions: dict[str, Relation] = {"positive": at_least(unknown.size(), least)}
    for number, (A, B) in enumerate(plants.extremes):
        form = (unknown.moving(A, B) + 2 * (unknown.x.T * E * w)[0] + 2 * passed
                - gamma * (w.dot(w) + z.dot(z)))
        conditions[f"gain {number + 1}"] = at_most(sp.expand(form), 0)
    scales = unknown.scales(radii, inputs) | {gamma: usual**2} | dict.fromkeys((*w, *z), 1 / usual) | {
        x: 1 / (r * speed) for x, r in zip(unknown.x, radii, strict=True)}
    found = search(Problem(name, (*unknown.symbols, gamma), conditions, minimise=gamma, scales=scales), ROOM)
    return Feedback(unknown.K(found), found, float(found.values[gamma]))


def _optimal_sizes(plants: LinearPlants, E: sp.Matrix, C: sp.Matrix,
                   D: sp.Matrix) -> tuple[list[Fraction], list[Fraction], Fraction, Fraction]:
    """Typical sizes of states, inputs, the root of the gain, and the root of the fastest rate, of the first plant.

    They are those of the regulator with the least integral of z^T z (the states of its V = x^T P^-1 x <= 1); ones
    where it has none. They help the solver, which minds a gap in metres beside a voltage.
    """
    A, B, e, c, d = (np.array(part.tolist(), dtype=float).reshape(part.shape)
                     for part in (*plants.extremes[0], E, C, D))
    n, m = B.shape
    ones = [Fraction(1)] * n, [Fraction(1)] * m, Fraction(1), Fraction(1)
    try:
        X = solve_continuous_are(A, B, c.T @ c, d.T @ d, s=c.T @ d)
        K = -np.linalg.solve(d.T @ d, B.T @ X + d.T @ c)
        gain = float(np.linalg.norm((c + d @ K) @ np.linalg.solve(A + B @ K, e), 2))
        P = gain * np.linalg.inv(X)
        fastest = np.abs(np.linalg.eigvals(A + B @ K)).max()
        sizes = np.sqrt([*np.diag(P), *np.diag(K @ P @ K.T), gain, fastest])
    except np.linalg.LinAlgError:
        return ones
    if not (np.isfinite(sizes).all() and (sizes > 0).all()):
        return ones
    near = [Fraction(2) ** round(log2(size)) for size in sizes.tolist()]
    return near[:n], near[n:n + m], near[-2], near[-1]


def proved_decay(name: str, plants: LinearPlants, K: Sequence[Sequence[Fraction]], rate: Fraction,
                 radius: Mapping[str, Fraction] | None = None) -> Found:
    """A function V that proves the decay rate of a stated feedback; raises Infeasible where there is none.

    radius: typical sizes of the states, which only helps the solver.
    """
    unknown, radii = _Unknown(plants), [(radius or {}).get(state, Fraction(1)) for state in plants.states]
    held = dict(zip(unknown.Y, sp.Matrix([[rational(k) for k in row] for row in K]) * unknown.P, strict=True))
    conditions = {key: Relation(sp.expand(one.left.xreplace(held)), one.operator, one.right)
                  for key, one in _decay(unknown, plants, rate)}
    conditions["reach"] = unknown.reach(radii)
    return search(Problem(name, tuple(dict.fromkeys(unknown.P)), conditions, scales=unknown.scales(radii, ())))

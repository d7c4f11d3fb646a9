"""What a common quadratic function proves of a polytope: a decay rate, or how much of a disturbance reaches the output.

V = x'P x with V(x+) + y^2 <= rho^2 V(x) + sum g_i w_i^2 along every map of the polytope, whichever comes when. Without
disturbances and output that is a decay by rho a sample; with rho = 1 the output's root mean square over a long time is
at most the root of the sum of g_i, as that of every disturbance is at most 1 in its unit. Where the maps are known to a
remainder only, of which D bounds V's part, V(x+) <= (1 + e) V(Ax + Bw) + (1 + 1/e) D. All conditions are quadratic
forms, shown as squares in exact arithmetic.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import cvxpy as cp
import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.linalg import solve_discrete_lyapunov

from workbench.errors import SolverError
from workbench.gains.certificate import Proof, checked, proved_certificate
from workbench.gains.exact import Matrix, rational
from workbench.gains.held_loop import Polytope
from workbench.gains.problem import Problem
from workbench.proof.claim import Goal, at_least
from workbench.proof.text import goal_text

Array = NDArray[np.float64]
SPENT = Fraction(1, 10**6)  # e above
BACKOFF = 0.01  # by how much the sum of g_i is given up for an interior answer
P_DIGITS, ROOT_DIGITS, SCALE_DIGITS = 8, 7, 2


def _floats(of: Polytope) -> Array:
    return np.array([[[float(x) for x in row] for row in vertex] for vertex in of.vertices])


def frozen_gain(of: Polytope, frequencies: int = 400) -> float:
    """The largest output of any vertex held for good under disturbances of one frequency, on a grid of these: no proved
    bound can be below it.

    Infinite where a vertex is not stable.
    """
    whole, n = _floats(of), of.states
    A, B = whole[:, :, :n], whole[:, :, n:]
    if np.abs(np.linalg.eigvals(A)).max() >= 1:
        return math.inf
    turns = np.exp(1j * np.geomspace(1e-7, np.pi, frequencies))
    c = np.array([float(x) for x in of.output])
    found = np.linalg.solve(turns[:, None, None, None] * np.eye(n) - A, B[None].astype(complex))
    return float(np.abs(np.swapaxes(found, -1, -2) @ c).sum(axis=-1).max())


def least_gain(of: Polytope, interior: bool = False) -> tuple[float, Array, Array]:
    """The bound, the g_i and P by the solver, with room to round where `interior`; SolverError where there is none."""
    n, k, whole, near = of.states, of.disturbances, _floats(of), frozen_gain(of)
    if not math.isfinite(near):
        raise SolverError("the loop: a vertex of it is not stable, so that nothing can be proved of it")
    sizes = _sizes(whole, n)
    c = np.array([float(x) for x in of.output]) * sizes
    top = max(float(np.abs(c).max()), 1e-300)
    unscaled = np.concatenate([sizes, np.full(k, top / near)])  # so that the gains are of size 1
    maps = whole * unscaled / sizes[:, None]
    P, g, t = cp.Variable((n, n), symmetric=True), cp.Variable(k), cp.Variable()

    def conditions(room: Any) -> list[Any]:
        price = cp.bmat([[P - np.outer(c, c) / top**2, np.zeros((n, k))], [np.zeros((k, n)), cp.diag(g)]])
        return [price - m.T @ P @ m >> room * np.eye(n + k) for m in maps] + [P >> room * np.eye(n)]

    _solved(cp.Problem(cp.Minimize(cp.sum(g)), conditions(0.0)))
    least = float(cp.sum(g).value)
    if interior:
        _solved(cp.Problem(cp.Maximize(t), [*conditions(t), cp.sum(g) <= least * (1 + BACKOFF)]))
        if float(t.value) <= 0:
            raise SolverError("clarabel: no answer inside the cones: the loop is too near to the border")
    gains = np.asarray(g.value) * near**2
    return math.sqrt(max(float(gains.sum()), 0.0)), gains, np.asarray(P.value) * top**2 / np.outer(sizes, sizes)


def least_decay(of: Polytope, relative: float = 1e-4) -> tuple[float, Array]:
    """rho and P by bisection, with room to round; SolverError where no rho below 1 is found."""
    n = of.states
    whole = _floats(of)
    if not math.isfinite(frozen_gain(of)):
        raise SolverError("the loop: a vertex of it is not stable, so that nothing can be proved of it")
    sizes = _sizes(whole, n)
    maps = whole[:, :, :n] * sizes / sizes[:, None]
    P, t = cp.Variable((n, n), symmetric=True), cp.Variable()
    kept: tuple[float, Array] | None = None
    low, high = float(np.abs(np.linalg.eigvals(maps)).max()), 1.0
    while high - low > relative * high:
        rho = (low + high) / 2 if kept else high - relative * high / 2
        problem = cp.Problem(cp.Maximize(t), [cp.trace(P) == n, P >> t * np.eye(n), *(
            rho**2 * P - m.T @ P @ m >> t * np.eye(n) for m in maps)])
        _solved(problem)
        if float(t.value) > 1e-9:
            kept, high = (rho, np.asarray(P.value) / np.outer(sizes, sizes)), rho
        elif kept is None:
            break
        else:
            low = rho
    if kept is None:
        raise SolverError("clarabel: no common quadratic function decays: shrink the box or shorten the period")
    return kept


def _sizes(whole: Array, n: int) -> Array:
    """Typical sizes of the states under the disturbance, in two digits each."""
    A, B = whole[-1, :, :n], whole[-1, :, n:]
    spread = solve_discrete_lyapunov(A, B @ B.T + 1e-9 * np.abs(B).max(initial=0.0) ** 2 * np.eye(n))
    return np.array([float(f"{x:.{SCALE_DIGITS}g}") for x in np.sqrt(np.diag(spread))])


def _solved(problem: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            problem.solve(solver=cp.CLARABEL)
        except cp.SolverError as trouble:
            raise SolverError(f"clarabel: failed ({' '.join(str(trouble).split())[:80]})") from None
    if problem.status != "optimal":
        raise SolverError(f"clarabel: status '{problem.status}': no common quadratic function is found for this box")


def rounded(P: Array) -> Matrix:
    """A symmetric matrix of decimals near one of floats."""
    return [[Fraction(f"{float(P[min(i, j), max(i, j)]):.{P_DIGITS}g}") for j in range(len(P))] for i in range(len(P))]


def gain_certificate(claim: str, of: Polytope, P: Matrix, gains: Sequence[Fraction]) -> dict[str, Any]:
    """The checked certificate that the output's root mean square is at most the root of the gains' sum."""
    return _certificate(claim, of, P, {f"g_{i + 1}": g for i, g in enumerate(gains)})


def upper_gains(gains: Array, digits: int = 4) -> list[Fraction]:
    """Decimals above floats, in so many digits."""
    return [Fraction(f"{float(g) * (1 + 10.0 ** (1 - digits)):.{digits}g}") for g in gains]


def decay_certificate(claim: str, of: Polytope, P: Matrix, rho: Fraction) -> dict[str, Any]:
    """The checked certificate that V shrinks by rho^2 at least with every sample."""
    return _certificate(claim, of, P, {"rho": rho})


def proved_bound(certificate: Mapping[str, Any], claim: str, of: Polytope) -> float:
    """What a certificate proves of this very polytope, the output's bound or rho; SolverError for any other one.

    The conditions are made anew of the polytope and the certificate's own P and compared; the checker does the rest.
    """
    try:
        values = {str(k): Fraction(str(v)) for k, v in certificate["values"].items()}
        n = of.states
        P = [[values[f"P_{min(i, j) + 1}_{max(i, j) + 1}"] for j in range(n)] for i in range(n)]
        shown = certificate["goal"]
    except (KeyError, TypeError, ValueError, AttributeError):
        raise SolverError(f"{claim}: the certificate has no values of P: find it anew") from None
    numbers = {name: value for name, value in values.items() if not name.startswith("P_")}
    gains = {f"g_{i + 1}" for i in range(of.disturbances)}
    if certificate.get("claim") != claim or set(numbers) not in ({"rho"}, gains):
        raise SolverError(f"{claim}: the certificate is one of something else: find it anew")
    problem, _ = _problem(claim, of, P, numbers)
    if goal_text(Goal(tuple(problem.conditions.values()))) != shown:
        raise SolverError(f"{claim}: the certificate is not one of this loop with these gains: find it anew")
    checked(dict(certificate))
    return float(numbers["rho"]) if "rho" in numbers else math.sqrt(float(sum(numbers.values())))


def _certificate(claim: str, of: Polytope, P: Matrix, numbers: Mapping[str, Fraction]) -> dict[str, Any]:
    problem, forms = _problem(claim, of, P, numbers)
    states = sp.symbols(f"x_1:{len(forms['positive']) + 1}", real=True)
    proofs = [_squares(claim, name, form) for name, form in forms.items()]
    values = {sp.Symbol(f"P_{i + 1}_{j + 1}"): rational(P[i][j]) for i in range(of.states) for j in range(i, of.states)}
    values |= {sp.Symbol(name): rational(x) for name, x in numbers.items()}
    return proved_certificate(problem, values, states, proofs)


def _problem(claim: str, of: Polytope, P: Matrix, numbers: Mapping[str, Fraction]) -> tuple[Problem, dict[str, Matrix]]:
    """The conditions and their matrices, of x and the disturbance."""
    n = of.states
    rho = numbers.get("rho", Fraction(1))
    gains = [numbers[f"g_{i + 1}"] for i in range(of.disturbances)] if "rho" not in numbers else []
    size = n + len(gains)
    forms = {"positive": [[P[i][j] if max(i, j) < n else Fraction(0) for j in range(size)] for i in range(size)]}
    off, spent = _left_out(of, P, size)
    for number, vertex in enumerate(of.vertices):
        image = [[sum((p * m[j] for p, m in zip(row, vertex, strict=True)), Fraction(0)) for j in range(size)]
                 for row in P]
        form = [[-(1 + spent) * sum((vertex[k][i] * image[k][j] for k in range(n)), Fraction(0)) for j in range(size)]
                for i in range(size)]
        for i in range(n):
            for j in range(n):
                form[i][j] += rho**2 * P[i][j] - (of.output[i] * of.output[j] if gains else 0)
        for i, gain in enumerate(gains):
            form[n + i][n + i] += gain
        for i in range(size):
            form[i][i] -= off[i]
        forms[f"vertex {number + 1}"] = form
    x = sp.symbols(f"x_1:{size + 1}", real=True)
    conditions = {name: at_least(_expression(form, x), 0) for name, form in forms.items()}
    return Problem(claim, (), conditions), forms


def _expression(form: Matrix, x: tuple[sp.Symbol, ...]) -> sp.Expr:
    return sp.Add(*(rational(form[i][j] * (1 if i == j else 2)) * x[i] * x[j]
                    for i in range(len(form)) for j in range(i, len(form)) if form[i][j]))


def _left_out(of: Polytope, P: Matrix, size: int) -> tuple[list[Fraction], Fraction]:
    """The diagonal of (1 + 1/e) D and e: |Rx| in P's norm is at most sum_j c_j |x_j|, c_j = sum_i sqrt(P_ii) R_ij."""
    roots = [Fraction(math.isqrt(math.ceil(max(P[i][i], Fraction(0)) * 10**24)) + 1, 10**12) for i in range(of.states)]
    columns = [sum((r * row[j] for r, row in zip(roots, of.remainder, strict=True)), Fraction(0)) for j in range(size)]
    if not any(columns):
        return [Fraction(0)] * size, Fraction(0)
    return [(1 + 1 / SPENT) * size * _upwards(c) ** 2 for c in columns], SPENT


def _upwards(value: Fraction) -> Fraction:
    """A decimal of few digits that is not below."""
    return Fraction(f"{float(value) * 1.01:.2e}") if value else value


def _squares(claim: str, name: str, form: Matrix) -> Proof:
    """A positive form as few digits' squares: rounded Cholesky's, then what is left, which its diagonal dominates."""
    used = [i for i, row in enumerate(form) if any(row)]
    sizes = [Fraction(f"{math.sqrt(max(float(form[i][i]), 1e-300)):.1e}") for i in used]
    unit = [[form[i][j] / a / b for j, b in zip(used, sizes, strict=True)] for i, a in zip(used, sizes, strict=True)]
    numbers = np.array([[float(x) for x in row] for row in unit])
    least = float(np.linalg.eigvalsh(numbers)[0])
    if least <= 0:
        raise SolverError(f"{claim}: {name}: the form is not positive: {least:.1e}")
    lower = np.linalg.cholesky(numbers - least / 2 * np.eye(len(used)))
    roots = [[Fraction(f"{x:.{ROOT_DIGITS}f}") for x in column] for column in lower.T]
    proof: Proof = []

    def squared(coefficient: Fraction, entries: dict[int, Fraction]) -> None:
        variables = len(form)
        proof.append((-1, coefficient, {tuple(int(used[k] == v) for v in range(variables)): c * sizes[k]
                                        for k, c in entries.items() if c}))

    rest = [row[:] for row in unit]
    for root in roots:
        squared(Fraction(1), dict(enumerate(root)))
        for i, a in enumerate(root):
            if a:
                for j, b in enumerate(root):
                    rest[i][j] -= a * b
    for i in range(len(used)):
        for j in range(i + 1, len(used)):
            if rest[i][j]:
                size = abs(rest[i][j])
                squared(size, {i: Fraction(1), j: Fraction(1 if rest[i][j] > 0 else -1)})
                rest[i][i] -= size
                rest[j][j] -= size
    for i in range(len(used)):
        if rest[i][i] < 0:
            raise SolverError(f"{claim}: {name}: no rounding of it is positive: the loop is too near to the border")
        if rest[i][i]:
            squared(rest[i][i], {i: Fraction(1)})
    return proof

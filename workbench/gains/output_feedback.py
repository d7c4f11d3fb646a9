"""Static output feedback u = F y for a polytope of linear plants, by iteration, with an exact certificate of its decay.

What is asked for is bilinear in V = x^T Q x and F, which no program solves for certain. The simplex method of Nelder
and Mead moves the poles of all extreme plants from a few starts; from there it goes on in turns: for the F at hand the
Q that proves the fastest decay, then for that Q the F that decays fastest, which never makes it slower. All of that is
numbers; what counts is the exact proof of the rounded F at the end, by a V of its own (`proved_decay`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.optimize import minimize

from workbench.errors import InputError, SolverError
from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.feedback import proved_decay
from workbench.gains.linearised import LinearPlants
from workbench.gains.search import Found, Infeasible

Array = NDArray[np.float64]
MOST_TURNS, HALVINGS = 40, 7  # of the iteration; of the range in which a turn looks for the fastest decay
ROOM = 0.05  # by which the iteration decays faster than asked, so that a rounded F still decays as fast
ROUNDED = 1e-3  # of a gain
SEED, SPREADS = 1, (0.0, 1.0, 1.0, 10.0, 10.0, 100.0)
LEAST_STEP = 1e-6  # 1/s a turn, below which it has come to rest
CONDITION = 1e5  # of Q at most


@dataclass(frozen=True)
class OutputFeedback:
    """u = u_0 + F (y - y_0): F exactly, a row an input, and the search of the V that proves its decay."""

    F: sp.Matrix
    found: Found
    turns: int


def output_decaying(name: str, plants: LinearPlants, C: sp.Matrix, rate: Fraction,
                    radius: Mapping[str, Fraction]) -> OutputFeedback:
    """An output feedback that is proved to decay by `rate` (1/s) for every plant of the polytope; y = C x, exact.

    radius: a typical size of each state, which helps the solvers. Raises InputError where the iteration comes to rest
    at a slower decay, which says nothing of whether there is a feedback, and SolverError.
    """
    sizes = np.array([float(radius[state]) for state in plants.states])
    scaled = [(_floats(A) * sizes / sizes[:, None], _floats(B) / sizes[:, None]) for A, B in plants.extremes]
    F, turns = _iterated(name, scaled, _floats(C) * sizes, float(rate) * (1 + ROOM))
    exact = sp.Matrix(F.shape[0], F.shape[1], [rational(simplest(value, ROUNDED)) if value else sp.Integer(0)
                                               for value in F.ravel().tolist()])
    K = [[fraction(value) for value in (exact * C).row(k)] for k in range(exact.rows)]
    try:
        return OutputFeedback(exact, proved_decay(name, plants, K, rate, radius), turns)
    except Infeasible:
        raise InputError(name, "rate", f"{float(rate):g} 1/s is not proved of the gains found: ask for less") from None


def _floats(matrix: sp.Matrix) -> Array:
    return np.array(matrix.tolist(), dtype=float).reshape(matrix.shape)


def _iterated(name: str, plants: Sequence[tuple[Array, Array]], C: Array, wanted: float) -> tuple[Array, int]:
    """The gains at which the iteration has reached the wanted decay, and after how many turns."""
    F = _start(plants, C, wanted)
    reached = -max(float(np.linalg.eigvals(A + B @ F @ C).real.max()) for A, B in plants) - 1.0
    for turn in range(1, MOST_TURNS + 1):
        Q, proved = _best_function([A + B @ F @ C for A, B in plants], reached, wanted)
        F, faster = _best_gains(plants, C, Q, wanted)
        if faster >= wanted * (1 - 1e-6):
            return F, turn
        if max(faster, proved) < reached + LEAST_STEP * (1 + abs(reached)):
            break
        reached = max(reached, faster)
    if reached > wanted / (1 + ROOM):
        return F, turn
    raise InputError(name, "rate", f"{wanted / (1 + ROOM):g} 1/s is out of reach of the iteration over output "
                     f"feedbacks, which rests at {reached:.3g}: ask for less, or measure more")


def _start(plants: Sequence[tuple[Array, Array]], C: Array, wanted: float) -> Array:
    """The gains of the slowest pole farthest to the left, no farther than wanted, of a few runs from fixed starts."""
    m, p = plants[0][1].shape[1], len(C)
    generator = np.random.default_rng(SEED)
    # As large as moves a state of its size in the time that is asked for.
    sizes = np.array([wanted / max(np.abs(plants[0][1][:, k]).max(), 1e-12) for k in range(m)])[:, None]

    def slowest(entries: Array) -> float:
        F = sizes * entries.reshape(m, p)
        return max(*(float(np.linalg.eigvals(A + B @ F @ C).real.max()) for A, B in plants), -wanted * (1 + ROOM))

    best = np.zeros(m * p)
    for spread in SPREADS:
        found = minimize(slowest, spread * generator.normal(size=m * p), method="Nelder-Mead",
                         options={"maxfev": 400 * m * p, "xatol": 1e-6, "fatol": 1e-9})
        if found.fun < slowest(best) - 1e-9:
            best = found.x
        if slowest(best) <= -wanted:
            break
    start: Array = sizes * best.reshape(m, p)
    return start


def _best_function(loops: Sequence[Array], low: float, wanted: float) -> tuple[Array, float]:
    """The Q of V = x^T Q x that decays fastest, by halving the range from `low`, which has one; and that decay."""
    import cvxpy as cp  # noqa: PLC0415 - importing it takes a second

    n = len(loops[0])
    Q, room, rate = cp.Variable((n, n), symmetric=True), cp.Variable(), cp.Parameter()
    limits = [Q >> np.eye(n), Q << CONDITION * np.eye(n), room <= 1.0]
    limits += [A.T @ Q + Q @ A + 2 * rate * Q << -room * np.eye(n) for A in loops]
    problem, found = cp.Problem(cp.Maximize(room), limits), None
    high = min(wanted, -max(float(np.linalg.eigvals(A).real.max()) for A in loops))
    for at in range(HALVINGS):
        rate.value = low if at == 0 else high if at == 1 else 0.5 * (low + high)
        try:
            _solved(problem)
        except SolverError:
            if at == 0:
                raise
            high = rate.value  # at the border of what there is
            continue
        if at == 0 or room.value >= 0:
            low, found = rate.value, np.array(Q.value)
            if low >= high:
                break
        else:
            high = rate.value
    assert found is not None
    return found, float(low)


def _best_gains(plants: Sequence[tuple[Array, Array]], C: Array, Q: Array, wanted: float) -> tuple[Array, float]:
    """The smallest F that decays as wanted with this Q, else the one that decays fastest, and how fast."""
    import cvxpy as cp  # noqa: PLC0415 - as above

    F, rate = cp.Variable((plants[0][1].shape[1], len(C))), cp.Variable()
    limits = [rate <= wanted]
    for A, B in plants:
        moving = Q @ (A + B @ F @ C)
        limits.append(moving + moving.T + 2 * rate * Q << 0)
    _solved(cp.Problem(cp.Maximize(rate), limits))
    return np.array(F.value), float(rate.value)


def _solved(problem: object) -> None:
    """Solve; SolverError where there is no answer."""
    import warnings  # noqa: PLC0415 - as above

    import cvxpy as cp  # noqa: PLC0415 - as above

    assert isinstance(problem, cp.Problem)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an inaccurate answer is judged by the exact proof
            problem.solve(solver="CLARABEL")
    except cp.SolverError as trouble:
        raise SolverError(f"clarabel: failed ({' '.join(str(trouble).split())[:80]})") from None
    if problem.status not in ("optimal", "optimal_inaccurate"):
        raise SolverError(f"clarabel: status '{problem.status}' in a turn of the iteration: ask for a slower decay")

"""A tube around a nominal run: how far a bounded disturbance can push a train that is held to it by a feedback.

x - xbar = (e1, e2), u - ubar = -K (x - xbar), held for a period: e1' = e2, e2' = slope e2 + u - ubar + w, |w| <= W.
This is exact: the square term of the resistance differs by -(b + c (v + vbar)) e2, a slope between known ends, so its
distance from the middle counts as disturbance too. The set that e cannot leave is the minimal robust positively
invariant set, the sum of (A - B K)^i D over i; what is needed of it are its extents, which are sums of absolute values.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from workbench.errors import InputError
from workbench.mpc.kernels import kernels
from workbench.mpc.linear import LinearMpc
from workbench.mpc.lqr import dlqr
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution

GRID = 40
# A sum is cut where its last term, as often as a geometric sum repeats it, is below this share of it.
REST = 1e-9
SERIES_BELOW = 1e-3
MOST_TERMS = 100_000
# A push beyond this is none that a train meets.
LARGEST_MPS2 = 5.0
# The answer bends by at most slope (below 0.1/s) times itself, so that trapezoids of a 40th of a period miss less.
ROUNDED_UP = 1 + 1e-5


@dataclass(frozen=True)
class Premise:
    """One thing that the guarantee rests on, and whether it holds; name: in a few words."""

    name: str
    statement: str
    value: float
    limit: float

    @property
    def holds(self) -> bool:
        """Whether the value is below its limit."""
        return self.value < self.limit


@dataclass(frozen=True)
class Tube:
    """The invariant set's extents, at and between samples, and the premises of the guarantee.

    gain: shape (2,), K; position_m, speed_mps, command_mps2: largest |e1|, |e2|, |u - ubar|; disturbance_mps2: W, and
    total_mps2: W with what the changing slope adds. A_K: the closed loop of one period.
    """

    gain: Array
    position_m: float
    speed_mps: float
    command_mps2: float
    disturbance_mps2: float
    total_mps2: float
    A_K: Array
    premises: tuple[Premise, ...]

    @property
    def holds(self) -> bool:
        """Whether every premise does."""
        return all(premise.holds for premise in self.premises)

    def report(self) -> list[str]:
        """A line a premise, with its numbers."""
        return [f"{'holds' if p.holds else 'FAILS'}: {p.statement}: {p.value:.4g} < {p.limit:.4g}"
                for p in self.premises]


def held(slope_per_s: float, time_s: float) -> tuple[Array, Array]:
    """exp(A t), shape (2, 2), and what a unit of command held for t adds, shape (2,); A = [[0, 1], [0, slope]].

    Written out: the tube needs a thousand of them.
    """
    x = slope_per_s * time_s
    moved = math.expm1(x) / x if x else 1.0
    # (moved - 1) / x, where a difference of nearly equal numbers would lose digits by its series.
    pushed = (moved - 1) / x if abs(x) > SERIES_BELOW else 1 / 2 + x / 6 + x**2 / 24 + x**3 / 120
    return (np.array([[1.0, moved * time_s], [0.0, math.exp(x)]]),
            np.array([pushed * time_s**2, moved * time_s]))


def feedback(problem: Problem, slope_per_s: float) -> Array:
    """K, shape (2,): the LQR of the errors for the problem's weights of position, speed and command."""
    A, B = held(slope_per_s, problem.period_s)
    w = problem.weights
    gain, _ = dlqr(A, B.reshape(2, 1), np.diag([w.position, w.speed]), np.array([[w.command]]))
    return np.asarray(gain).ravel()


def extents(slope_per_s: float, period_s: float, gain: Array) -> tuple[Array, Array]:
    """Largest |e1|, |e2|, |K e| per m/s^2 of disturbance, whatever its course, and A_K; inf where A_K is not stable.

    The disturbance may change at any instant, so each extent is an integral of the absolute answer to an impulse, by
    trapezoids. ROUNDED_UP is more than these and the cut sums can miss.
    """
    found, A_K = _extents(slope_per_s, period_s, tuple(gain.tolist()))
    return found.copy(), A_K.copy()


# The same for every run of a controller.
@lru_cache(maxsize=64)
def _extents(slope_per_s: float, period_s: float, feedback_gain: tuple[float, ...]) -> tuple[Array, Array]:
    gain = np.array(feedback_gain)
    A, B = held(slope_per_s, period_s)
    A_K = A - np.outer(B, gain)
    radius = float(np.abs(np.linalg.eigvals(A_K)).max())
    if radius >= 1 - 1e-4:  # a feedback that slow is none
        return np.full(3, math.inf), A_K
    times = np.linspace(0.0, period_s, GRID + 1)
    impulses = np.array([held(slope_per_s, period_s - t)[0][:, 1] for t in times])  # what acts at t, at the end
    trapezoid = np.full(GRID + 1, period_s / GRID)
    trapezoid[[0, -1]] /= 2
    # Rows: the directions e1, e2 at every time of the grid within a period, and K e at the sample.
    within = [held(slope_per_s, t) for t in times[:-1]]
    rows = np.concatenate([*(phi - np.outer(gamma, gain) for phi, gamma in within), gain[np.newaxis]])
    total, power = np.zeros(len(rows)), np.eye(2)
    for _ in range(MOST_TERMS):
        term = np.abs(rows @ power @ impulses.T) @ trapezoid
        total += term
        power = A_K @ power
        if (term <= REST * (1 - radius) * np.maximum(total, 1e-300)).all():
            break
    # What acts since the last sample, at a time within the period.
    for n in range(1, GRID):
        early = np.array([held(slope_per_s, times[n] - t)[0][:, 1] for t in times[: n + 1]])
        width = np.full(n + 1, period_s / GRID)
        width[[0, -1]] /= 2
        total[2 * n : 2 * n + 2] += width @ np.abs(early)
    # Between two times of the grid e1 moves by at most the largest speed.
    speed = float(total[1:-1:2].max())
    position = float(total[0:-1:2].max()) + speed * period_s / GRID / 2
    return ROUNDED_UP * np.array([position, speed, float(total[-1])]), A_K


def tube(problem: Problem, ahead: Array, disturbance_mps2: float, band_m: float = 0.2, start: float = 0.0,
         gain: Array | None = None) -> Tube:
    """The tube of a problem along a desired run, for |w| <= disturbance_mps2 and |e1| < band_m.

    The disturbance holds everything the nominal model lacks: grades, curves, wrong mass and resistance, wind.
    start: distance of the train from the desired run at the start, m, which the nominal run may start with.
    Raises InputError for a bound that is not positive, or that no train meets.
    """
    if not 0 < disturbance_mps2 <= LARGEST_MPS2:
        raise InputError("", "disturbance_mps2", f"{disturbance_mps2:g} is not above 0 and up to {LARGEST_MPS2:g}: "
                         "give the bound of the disturbance")
    _, b, c = problem.davis
    fastest = float(ahead[:, 1].max())
    least, most = -(b + 2 * c * (fastest + 1.0)), -b
    middle, spread = (least + most) / 2, (most - least) / 2
    K = feedback(problem, middle) if gain is None else gain
    each, A_K = extents(middle, problem.period_s, K)
    # The slope's distance from the middle pushes by spread |e2|, and what pushes moves e2: a loop of this gain.
    loop = spread * each[1]
    total = disturbance_mps2 / (1 - loop) if loop < 1 else math.inf
    position, speed, command = (float(x) for x in each * total) if math.isfinite(total) else (math.inf,) * 3
    commands = ahead[:, 3]
    drawn = (commands + command) * (ahead[:, 1] + speed)
    radius = float(np.abs(np.linalg.eigvals(A_K)).max())
    premises = (
        Premise("a stable feedback", "the feedback is stable: spectral radius of A - B K", radius, 1.0),
        Premise("a resistance of little curvature", "the changing slope of the resistance is small: its loop gain",
                loop, 1.0),
        Premise("speeds near the curve's", "speeds stay where the slopes were taken, 1 m/s above the fastest: "
                "largest |e2|, m/s", speed, 1.0),
        Premise("a tube within the band", "the tube fits into the band: largest |e1|, m", position, band_m),
        Premise("room in traction", "driving leaves room for the feedback: highest command with it, m/s^2",
                float((commands + command).max()), problem.highest_command_mps2),
        Premise("room in braking", "braking leaves room for the feedback: lowest command with it, m/s^2, negated",
                -float((commands - command).min()), -problem.lowest_command_mps2),
        Premise("room in power", "the power limit leaves room for the feedback: highest power with it, W/kg",
                float(drawn.max()), problem.power_w_per_kg),
        Premise("a start near the curve", "the run starts within what the tube leaves of the band, m",
                abs(start), band_m - position),
    )
    return Tube(K, position, speed, command, disturbance_mps2, total, A_K, premises)


def checked_tube(problem: Problem, ahead: Array, disturbance_mps2: float, start: float = 0.0) -> Tube:
    """`tube` in the problem's band, with the nominal run itself, which is known beforehand, as a further premise.

    Computed once a process.
    """
    return _checked(problem, ahead.tobytes(), ahead.shape, disturbance_mps2, start)


@lru_cache(maxsize=16)
def _checked(problem: Problem, rows: bytes, shape: tuple[int, int], disturbance_mps2: float, start: float) -> Tube:
    ahead = np.frombuffer(rows).reshape(shape).copy()
    around = tube(problem, ahead, disturbance_mps2, problem.band_m, start)
    if not math.isfinite(around.position_m):
        return around
    mpc = TubeMpc(problem, ahead, around)
    run = mpc.nominal_run(ahead[0, :3] + [start, 0.0, 0.0], len(ahead) - problem.horizon - 1)
    nominal = Premise("a nominal run near the curve", "the nominal run stays within what the tube leaves of the "
                      "band, m", float(np.abs(run[:, 0]).max()), problem.band_m - around.position_m)
    return replace(around, premises=(*around.premises, nominal))


class TubeMpc:
    """MPC of the nominal train within limits that are tightened by the tube, and the feedback that holds to it.

    The nominal run knows nothing of disturbances, so it can be known before the real one: `nominal_run` is it. Where a
    premise fails nothing is guaranteed; then the limits are tightened no further than the desired run's own commands,
    since a nominal run that is pushed off the curve would only be worse.
    """

    def __init__(self, problem: Problem, ahead: Array, around: Tube) -> None:
        room = max(problem.band_m - around.position_m, 1e-6)
        low = problem.lowest_command_mps2 + around.command_mps2
        high = problem.highest_command_mps2 - around.command_mps2
        if not around.holds:
            wanted = ahead[:, 3]
            high = max(high, min(float(wanted.max()), problem.highest_command_mps2))
            low = min(low, max(float(wanted.min()), problem.lowest_command_mps2))
        self.around, self.horizon = around, problem.horizon
        tightened = replace(problem, band_m=room, lowest_command_mps2=low, highest_command_mps2=high)
        self.nominal = LinearMpc(tightened, ahead)
        self.lqr = self.nominal.lqr
        self._follow, self._parameters = kernels(problem.actuator).follow, problem.parameters
        self._limits = problem.lowest_command_mps2, problem.highest_command_mps2
        self._state: Array | None = None
        self._sample = -1

    def forget(self) -> None:
        """Start the nominal run anew, from what is measured next."""
        self._state = None
        self.nominal.forget()

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The nominal plan, with the feedback from the measured state in its first command.

        The tube is there for disturbances, so that an estimate of one is not used. A nominal run that is lost begins
        anew from the next measurement.
        """
        del disturbance
        if self._state is None or sample != self._sample + 1:
            self.nominal.forget()
            self._state = np.array(state, dtype=float)
        answer, x, gain = self.nominal.solve(sample, self._state), self._state, self.around.gain
        first = float(answer.plan[0] - (gain[0] * (state[0] - x[0]) + gain[1] * (state[1] - x[1])))
        self._state, self._sample = self.follow(x, float(answer.plan[0])), sample
        if not math.isfinite(float(self._state[0] + self._state[1] + self._state[2]) + first):
            self.forget()
            return replace(answer, solved=False, why=answer.why or "the program was not solved")
        low, high = self._limits
        answer.plan[0] = min(max(first, low), high)
        return answer

    def follow(self, x: Array, command: float) -> Array:
        """The nominal state one period later."""
        return np.array(self._follow(x[0], x[1], x[2], command, 0.0, self._parameters))

    def nominal_run(self, state: Array, samples: int) -> Array:
        """Errors of the nominal run from the desired one, and its commands: shape (samples, 3)."""
        self.forget()
        rows, x = [], np.array(state, dtype=float)
        for k in range(samples):
            u = float(self.nominal.solve(k, x).plan[0])
            rows.append([*(x[:2] - self.nominal.ahead[k, :2]), u])
            x = self.follow(x, u)
        self.forget()
        return np.array(rows)

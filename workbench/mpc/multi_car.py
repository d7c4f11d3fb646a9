"""MPC of a train of several cars with the limits of each car's force, for 2 to 64 cars.

Linear, around one speed, in the errors from a desired run that all cars share; the forces of the horizon are the
unknowns of one program with bounds, whose Hessian is the same at every sample.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from workbench.errors import InputError, SolverError
from workbench.mpc.box_program import BoxProgram
from workbench.mpc.car_model import CarTrain, period, resistance
from workbench.mpc.lqr import dlqr
from workbench.mpc.problem import LARGEST_WEIGHT, LONGEST_HORIZON, SMALLEST_WEIGHT, Array

MOST_UNKNOWNS = 4000
COUNTERS = ("qp", "qp_failed", "shifted_plan", "lqr", "feedforward", "bad_measurement")
FARTHEST_M, FASTEST_MPS = 1e9, 1e4


@dataclass(frozen=True)
class CarWeights:
    """Of every car's squares: position error (1/m^2), speed error, and force per unit of mass less its share."""

    position: float
    speed: float
    command: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not SMALLEST_WEIGHT <= value <= LARGEST_WEIGHT:
                raise InputError("", f"{name}_weight", f"{value:g} is outside {SMALLEST_WEIGHT:g} to "
                                 f"{LARGEST_WEIGHT:g}: choose a weight within")


class MultiCarMpc:
    """Called once a sample with all positions and speeds; answers with all forces, in N and within the limits.

    desired: rows of position (m), speed (m/s), acceleration (m/s^2) at every sample of the run and beyond by a horizon.
    steps: systems of equations that the last program took.
    Never raises once made and never answers NaN: a failed program is answered by the last plan, shifted, then by the
    LQR; a measurement that is none by the plan, then by the desired run's forces. Raises InputError for a horizon that
    does not fit and weights without an LQR.
    """

    title = "multi-car MPC"
    information = "full state of all cars, nominal model"

    def __init__(self, train: CarTrain, desired: Array, horizon: int, period_s: float, weights: CarWeights,
                 speed_mps: float) -> None:
        n, N = train.cars, horizon
        if not 2 <= N <= LONGEST_HORIZON or n * N > MOST_UNKNOWNS:
            raise InputError("", "horizon", f"{N:g} samples of {n} cars: give 2 to {MOST_UNKNOWNS // n}")
        if len(desired) <= N:
            raise InputError("", "horizon", f"{N} samples are longer than the run of {len(desired)}: shorten it")
        self.train, self.horizon, self._desired = train, N, desired
        self._of = period(train, period_s, speed_mps)
        self._q = np.concatenate([np.full(n, weights.position), np.full(n, weights.speed)])
        self._r = weights.command
        try:
            gain, cost = dlqr(self._of.A, self._of.B, np.diag(self._q), self._r * np.eye(n))
        except (ValueError, np.linalg.LinAlgError):
            raise InputError("", "weights", "no LQR follows from these: choose weights nearer to each other") from None
        self.gain, self.terminal = np.asarray(gain), (np.asarray(cost) + np.asarray(cost).T) / 2
        self._program = BoxProgram(self._hessian())
        low, high = train.lowest_n / train.mass_kg, train.highest_n / train.mass_kg
        self._low, self._high = np.tile(low, N), np.tile(high, N)
        self._push, self._shares = self._along_the_run()
        (self._pushes, of_push), (self._splits, of_shares) = patterns(self._push), patterns(self._shares)
        self._by_error, self._by_pattern = self._without_limits(of_push, of_shares)
        self.counters, self.trouble = dict.fromkeys(COUNTERS, 0), Counter[str]()
        self.steps = 0
        self._plan: Array | None = None
        self._planned_at = 0

    def _hessian(self) -> Array:
        """Of the cost in all forces of the horizon, shape (N n, N n), block by block of pairs of samples."""
        N, n, A, B = self.horizon, self.train.cars, self._of.A, self._of.B
        H = np.zeros((N * n, N * n))
        later = [self.terminal]  # cost of what follows a sample without further forces
        for _ in range(N - 1):
            later.append(np.diag(self._q) + A.T @ later[-1] @ A)
        for i in range(N):  # force at i, first of the two
            answer = B.T @ later[N - 1 - i] @ B
            H[i * n : (i + 1) * n, i * n : (i + 1) * n] = answer + self._r * np.eye(n)
            carried = later[N - 1 - i] @ B
            for j in range(i - 1, -1, -1):
                carried = A.T @ carried
                block = carried.T @ B  # force at i with the earlier one at j
                H[i * n : (i + 1) * n, j * n : (j + 1) * n] = block
                H[j * n : (j + 1) * n, i * n : (i + 1) * n] = block.T
        return 2 * H

    def _along_the_run(self) -> tuple[Array, Array]:
        """What pushes on every car along the desired run, and every car's share of what is needed; (samples, n)."""
        push = np.asarray(resistance(self.train).map(len(self._desired))(self._desired[:, 1].reshape(1, -1))).T
        push = push - self._desired[:, 2:3]
        needed = -(push * self.train.mass_kg).sum(axis=1, keepdims=True)
        of = np.where(needed > 0, self.train.highest_n / self.train.highest_n.sum(),
                      self.train.lowest_n / self.train.lowest_n.sum())
        return push, needed * of / self.train.mass_kg

    def command(self, sample: int, position_m: Array, speed_mps: Array) -> Array:
        """Forces in N, shape (n,), for all cars' positions and speeds, shape (n,), at a sample."""
        k = min(max(sample, 0), len(self._desired) - 1 - self.horizon)
        good = bool((np.abs(position_m) < FARTHEST_M).all() and (np.abs(speed_mps) < FASTEST_MPS).all())
        error = np.concatenate([position_m - self._desired[k, 0], speed_mps - self._desired[k, 1]])
        answer = self._answer(k, error) if good else self._without(k)
        limited = np.clip(answer, self._low[: self.train.cars], self._high[: self.train.cars])
        return np.asarray(limited * self.train.mass_kg)

    def _answer(self, k: int, error: Array) -> Array:
        n = self.train.cars
        self.counters["qp"] += 1
        try:
            plan, self.steps = self._program.solve(self._best(k, error), self._low, self._high, self._start(k))
        except SolverError as trouble:
            self.counters["qp_failed"] += 1
            self.trouble[str(trouble)] += 1
            shifted = self._shifted(k)
            if shifted is not None:
                return shifted
            self.counters["lqr"] += 1
            return np.asarray(self._shares[k] - self.gain @ error)
        self._plan, self._planned_at = plan, k
        return plan[:n]

    def _without(self, k: int) -> Array:
        """Without a measurement."""
        self.counters["bad_measurement"] += 1
        shifted = self._shifted(k)
        if shifted is not None:
            return shifted
        self.counters["feedforward"] += 1
        return np.asarray(self._shares[k])

    def _shifted(self, k: int) -> Array | None:
        n, age = self.train.cars, k - self._planned_at
        if self._plan is None or not 0 <= age < self.horizon:
            return None
        self.counters["shifted_plan"] += 1
        return self._plan[age * n : (age + 1) * n]

    def _start(self, k: int) -> Array:
        """The last plan as old as it is, its last forces held; without one the shares."""
        n, age = self.train.cars, k - self._planned_at
        if self._plan is None or not 0 <= age < self.horizon:
            return np.asarray(self._shares[k : k + self.horizon].ravel())
        return np.concatenate([self._plan[age * n :], np.tile(self._plan[-n:], age)])

    def _best(self, k: int, error: Array) -> Array:
        """The plan that would be best without limits, from an error, shape (2n,), at a sample."""
        ahead = slice(k, k + self.horizon)
        along = np.concatenate([self._pushes[ahead].ravel(), self._splits[ahead].ravel()])
        return np.asarray(self._by_error @ error + self._by_pattern @ along)

    def _without_limits(self, of_push: Array, of_shares: Array) -> tuple[Array, Array]:
        """What `_best` is linear in: by the error, shape (N n, 2n), and by every pattern's size at every sample."""
        N, n = self.horizon, self.train.cars
        from_error = self._linear(np.eye(2 * n), np.zeros((N, n, 2 * n)), np.zeros((N, n, 2 * n)))
        many = N * (len(of_push) + len(of_shares))
        push, shares, column = np.zeros((N, n, many)), np.zeros((N, n, many)), iter(range(many))
        for sizes, rows in ((push, of_push), (shares, of_shares)):
            for i in range(N):
                for row in rows:
                    sizes[i, :, next(column)] = row
        from_patterns = self._linear(np.zeros((2 * n, many)), push, shares)
        return self._program.unbounded(from_error), self._program.unbounded(from_patterns)

    def _linear(self, error: Array, push: Array, shares: Array) -> Array:
        """The program's linear part, shape (N n, c), of c errors, pushes and shares at once, in the last axis.

        The errors without forces, forwards; what they cost, backwards.
        """
        N, of, q = self.horizon, self._of, self._q[:, None]
        errors = [error]
        for i in range(N):
            errors.append(of.A @ errors[-1] + of.C @ push[i])
        f = np.empty((N, self.train.cars, error.shape[1]))
        costate = self.terminal @ errors[N]
        for i in range(N - 1, -1, -1):
            f[i] = of.B.T @ costate - self._r * shares[i]
            costate = q * errors[i] + of.A.T @ costate
        return 2 * f.reshape(N * self.train.cars, -1)


def patterns(rows: Array) -> tuple[Array, Array]:
    """Rows, shape (samples, n), as sizes, shape (samples, p), of as few patterns as they are made of, shape (p, n)."""
    u, sizes, v = np.linalg.svd(rows, full_matrices=False)
    kept = sizes > 1e-15 * sizes.max(initial=0.0) * max(rows.shape)
    return u[:, kept] * sizes[kept], v[kept]

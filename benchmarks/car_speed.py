"""How long a step of MPC takes for a train of many cars, and how that grows, beside other ways to solve its program.

    pip install 'workbench[benchmark]'      # QP solvers, needed by this benchmark alone
    python benchmarks/car_speed.py [--cars 6 64] [--horizon 20] [--json FILE]

chen2019's cars, every other one with a motor, start a metre behind and follow a run of 140 s. The loop is closed by the
package's own MPC; some of its programs are then put to the others: projected Newton steps with the dense Hessian
alone, by which the package solved them before, and the QP solvers that are installed, each with the Hessian set up
once. Times are of the CPU. An answer that lies farther apart than EQUAL_N from the package's is said.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import casadi as ca
import numpy as np
from scipy import sparse

from workbench.model.desired_curve import start_cruise_stop
from workbench.mpc.box_program import BoxProgram
from workbench.mpc.car_model import CarTrain, train_rates
from workbench.mpc.multi_car import CarWeights, MultiCarMpc
from workbench.mpc.problem import Array

PERIOD_S, SAMPLES, MASS_KG = 0.5, 280, 5e4
# Every so many programs of the loop are put to the others, which take long for them.
EVERY = 20
EQUAL_N = 1.0
TOLERANCE = 1e-9
# (best, low, high, start) -> plan.
Solve = Callable[[Array, Array, Array, Array], Array]


@dataclass(frozen=True)
class Loop:
    """Microseconds of every step; the MPC; the programs that it solved, and its plans."""

    taken_us: Array
    mpc: MultiCarMpc
    programs: list[tuple[Array, Array, Array, Array]]
    plans: list[Array]


class _Heard(BoxProgram):
    """Remembers programs and plans."""

    def __init__(self, H: Array) -> None:
        super().__init__(H)
        self.programs: list[tuple[Array, Array, Array, Array]] = []
        self.plans: list[Array] = []

    def solve(self, best: Array, low: Array, high: Array, start: Array) -> tuple[Array, int]:
        """As its parent does."""
        found = super().solve(best, low, high, start)
        self.programs.append((best, low, high, start))
        self.plans.append(found[0])
        return found


def loop(cars: int, horizon: int, samples: int = SAMPLES) -> Loop:
    """The closed loop of so many cars, as they start and go on."""
    train = CarTrain(np.full(cars, MASS_KG), np.full(cars, -4e4), np.where(np.arange(cars) % 2 == 0, 4e4, 0.0),
                     (0.00775, 0.000228, 0.0000166, 2e6, 1e5))
    of_rates, n = train_rates(train), cars
    x, u, h = ca.SX.sym("x", 2 * n), ca.SX.sym("u", n), 0.01
    k1 = of_rates(x, u)
    k2 = of_rates(x + h / 2 * k1, u)
    k3 = of_rates(x + h / 2 * k2, u)
    step = ca.Function("step", [x, u], [x + h / 6 * (k1 + 2 * k2 + 2 * k3 + of_rates(x + h * k3, u))]).fold(50)
    curve = start_cruise_stop(2500.0, 25.0, 0.3, 0.4, 4.0)
    desired = np.stack(curve.at(np.arange(SAMPLES + horizon + 2) * PERIOD_S), axis=1)
    mpc = MultiCarMpc(train, desired, horizon, PERIOD_S, CarWeights(1.0, 1.0, 0.1), 25.0)
    heard = _Heard(mpc._program._H)  # the programs themselves are what is compared
    mpc._program = heard
    state, taken = np.concatenate([np.full(n, -1.0), np.zeros(n)]), np.zeros(samples)
    for k in range(samples):
        before = time.thread_time()
        forces = mpc.command(k, state[:n], state[n:])
        taken[k] = (time.thread_time() - before) * 1e6
        state = np.asarray(step(state, np.tile(forces.reshape(-1, 1), (1, 50)))).ravel()
    return Loop(taken, mpc, heard.programs, heard.plans)


def _newton(H: Array) -> Solve:
    program = BoxProgram(H)
    return lambda best, low, high, start: program._stepped(best, low, high, start)[0]


def _piqp(H: Array) -> Solve:
    import piqp  # noqa: PLC0415

    solver, n = piqp.DenseSolver(), len(H)
    solver.settings.eps_abs = solver.settings.eps_rel = TOLERANCE
    solver.settings.eps_duality_gap_abs = solver.settings.eps_duality_gap_rel = TOLERANCE
    solver.setup(H, np.zeros(n), None, None, None, None, None, -np.ones(n), np.ones(n))

    def solve(best: Array, low: Array, high: Array, start: Array) -> Array:
        del start
        solver.update(c=-(H @ best), x_l=low, x_u=high)
        solver.solve()
        return np.asarray(solver.result.x)

    return solve


def _daqp(H: Array) -> Solve:
    import daqp  # noqa: PLC0415

    none, n = np.zeros((0, len(H))), len(H)

    def solve(best: Array, low: Array, high: Array, start: Array) -> Array:
        del start
        found, *_ = daqp.solve(H, -(H @ best), none, high, low, np.zeros(n, dtype=np.int32))
        return np.asarray(found)

    return solve


def _osqp(H: Array) -> Solve:
    import osqp  # noqa: PLC0415

    solver, n = osqp.OSQP(), len(H)
    solver.setup(sparse.csc_matrix(np.triu(H)), np.zeros(n), sparse.identity(n, format="csc"), -np.ones(n), np.ones(n),
                 eps_abs=TOLERANCE, eps_rel=TOLERANCE, max_iter=100_000, verbose=False)

    def solve(best: Array, low: Array, high: Array, start: Array) -> Array:
        solver.update(q=-(H @ best), l=low, u=high)
        solver.warm_start(x=start)
        return np.asarray(solver.solve().x)

    return solve


PEERS: dict[str, tuple[str | None, Callable[[Array], Solve]]] = {
    "projected Newton steps": (None, _newton), "piqp, dense": ("piqp", _piqp), "daqp": ("daqp", _daqp),
    "osqp": ("osqp", _osqp)}


def rows(cars: int, horizon: int) -> list[dict[str, Any]]:
    """One row a way: median and p99 of a step (us), and how far its forces lie apart (N); of one left out, why."""
    of = loop(cars, horizon)
    found: list[dict[str, Any]] = [{"solver": "this package", "cars": cars, "median_us": float(np.median(of.taken_us)),
                                    "p99_us": float(np.percentile(of.taken_us, 99)), "off_n": 0.0}]
    programs, plans = of.programs[::EVERY], of.plans[::EVERY]
    for name, (module, make) in PEERS.items():
        if module and importlib.util.find_spec(module) is None:
            found.append({"solver": name, "cars": cars, "why": f"the package {module} is not installed"})
            continue
        solve, taken, off = make(of.mpc._program._H), [], 0.0
        for program, plan in zip(programs, plans, strict=True):
            before = time.thread_time()
            x = solve(*program)
            taken.append((time.thread_time() - before) * 1e6)
            off = max(off, float(np.abs(x - plan).max()) * MASS_KG)
        found.append({"solver": name, "cars": cars, "median_us": float(np.median(taken)),
                      "p99_us": float(np.percentile(taken, 99)), "off_n": off})
    return found


def line(row: dict[str, Any], ours_us: float) -> str:
    """As it is printed."""
    if "why" in row:
        return f"{row['cars']:5d}  {row['solver']:24s} left out: {row['why']}"
    words = "" if row["off_n"] < EQUAL_N else f"  not of equal accuracy: off by up to {row['off_n']:.1e} N"
    return (f"{row['cars']:5d}  {row['solver']:24s} {row['median_us']:10.1f} {row['p99_us']:10.1f} "
            f"{row['median_us'] / ours_us:8.1f}{words}")


def exponents(table: list[dict[str, Any]]) -> dict[str, float]:
    """Of each way p, where the median grows like cars^p over all numbers of cars."""
    found = {}
    for name in dict.fromkeys(row["solver"] for row in table if "median_us" in row):
        of = [(row["cars"], row["median_us"]) for row in table if row["solver"] == name and "median_us" in row]
        if len(of) > 1:
            cars, medians = np.log(np.array(of)).T
            found[name] = float(np.polyfit(cars, medians, 1)[0])
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--cars", type=int, nargs="+", default=[6, 12, 24, 48, 64])
    parser.add_argument("--horizon", type=int, default=20)
    parser.add_argument("--json", type=Path, help="write the numbers to this file")
    asked = parser.parse_args()
    print(f"horizon {asked.horizon}: microseconds a step\n{'cars':>5s}  {'solver':24s} {'median':>10s} {'p99':>10s} "
          f"{'/ ours':>8s}")
    table: list[dict[str, Any]] = []
    for cars in asked.cars:
        of = rows(cars, asked.horizon)
        table += of
        print(*(line(row, of[0]["median_us"]) for row in of), sep="\n", flush=True)
    grown = exponents(table)
    for name, exponent in grown.items():
        print(f"{name}: grows like cars^{exponent:.2f}")
    if asked.json:
        asked.json.write_text(json.dumps({"version": 1, "rows": table, "exponents": grown}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()

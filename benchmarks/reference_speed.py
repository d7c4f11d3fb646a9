"""How fast and how good energy-optimal references are on a public instance that others solved too.

    python benchmarks/reference_speed.py [--shared FOLDER] [--json FILE]

The instance: train NL_Intercity_VIRM6 with 3,129,277 W both ways, braking force equal to traction force, no pneumatic
brake, both efficiencies 0.73, no limit of the acceleration; track 00_var_speed_limit_100, 48,531 m in 1,541 s, 1 m/s at
both ends. GPOPS-II found 440.14 kWh; its trajectory is evaluated by our own model. Peers that run here: the same
program by fatrop and ipopt, and plain multiple shooting (RK4 over position in kinetic energy, ipopt).
"""

from __future__ import annotations

import argparse
import json
import os
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import casadi as ca
import numpy as np

from workbench.errors import WorkbenchError
from workbench.files.units import KWH_J
from workbench.optimal.course import Array, Course
from workbench.optimal.grid import graded_grid
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.nlp import solve_nlp
from workbench.optimal.profile import WEIGHT, Profile, energy_j, forces
from workbench.optimal.reference import Reference, find_reference, least_time
from workbench.optimal.socp import solve_socp
from workbench.optimal.vehicle import ForceLimit, Vehicle

SHARED = Path(__file__).parent.parent.parent / "shared" / "ttobench"
TIME_S, ENDS = 1541.0, (1.0, 1.0)
GPOPS_KWH = 440.1414723
INTERVALS = (100, 300, 500, 1000, 3000, 10_000)
REPEATS = 3


def instance(shared: Path) -> tuple[Vehicle, Course]:
    """The train and the run."""
    line, _ = load_line(shared / "tracks" / "00_var_speed_limit_100.json")
    vehicle, _ = load_vehicle(shared / "trains" / "NL_Intercity_VIRM6.json")
    both = ForceLimit(213.9e3, 3_129_277.0)
    vehicle = replace(vehicle, traction=both, regenerative=both, friction_brake_n=0.0, traction_efficiency=0.73,
                      regenerative_efficiency=0.73, max_acceleration_mps2=np.inf, max_deceleration_mps2=np.inf)
    return vehicle, course(line, vehicle)


def gpops(shared: Path, vehicle: Vehicle, run: Course, ours: Reference) -> dict[str, Any]:
    """The stored trajectory: energy as stored, by its forces and by our model along its speeds, and the distance."""
    rows = np.loadtxt(shared / "gpops_00_var_speed_limit_100.csv", delimiter=",", skiprows=1)
    position, speed, pull, brake = rows[:, 1], rows[:, 2], rows[:, 3], rows[:, 4]
    supplied = pull / vehicle.traction_efficiency - vehicle.regenerative_efficiency * np.abs(brake)
    by_forces = float(np.trapezoid(supplied, position))
    inner = (position > run.position_m[0] + 1e-6) & (position < run.position_m[-1] - 1e-6)
    cells = run.split(position[inner])
    driven = Profile(cells, np.interp(cells.position_m, position, speed**2 / 2))
    excess = forces(vehicle, driven).excess_n @ WEIGHT
    own = np.interp(position, ours.profile.position_m, ours.profile.speed_mps)
    return {"stored_kWh": float(rows[0, 6]), "by_its_forces_kWh": by_forces / KWH_J,
            "by_our_model_kWh": energy_j(vehicle, driven) / KWH_J, "trip_time_s": driven.trip_time_s,
            "mean_excess_n": float(excess.mean()), "speed_difference_max_mps": float(np.abs(own - speed).max()),
            "speed_difference_rms_mps": float(np.sqrt(np.mean((own - speed) ** 2)))}


def ours(vehicle: Vehicle, run: Course, intervals: int) -> tuple[dict[str, Any], Reference]:
    """The best of REPEATS: plan, driven run, bound; solve and total time."""
    best: dict[str, Any] = {}
    for _ in range(REPEATS if intervals <= 1000 else 2):
        started = time.perf_counter()
        found = find_reference(vehicle, run, TIME_S, *ENDS, intervals)
        total = time.perf_counter() - started
        if not best or found.solve_s < best["solve_ms"] / 1e3:
            best = {"intervals": intervals, "energy_kWh": found.energy_j / KWH_J,
                    "bound_kWh": found.lower_bound_j / KWH_J, "gap_percent": 100 * found.gap,
                    "off_gpops_percent": 100 * (found.energy_j / KWH_J / GPOPS_KWH - 1),
                    "solve_ms": 1e3 * found.solve_s, "total_ms": 1e3 * total}
        best["total_ms"] = min(best["total_ms"], 1e3 * total)
    grid = graded_grid(run, intervals)
    best["plan_ms"] = 1e3 * min(solve_socp(vehicle, grid, TIME_S, *ENDS).solve_s for _ in range(2))
    best["plan_kWh"] = solve_socp(vehicle, grid, TIME_S, *ENDS).energy_j / KWH_J
    return best, found


def nonlinear(vehicle: Vehicle, run: Course, intervals: int, solver: Any) -> dict[str, Any]:
    """The nonlinear program from the fastest run."""
    grid, quick = graded_grid(run, intervals), least_time(vehicle, run, *ENDS)
    guess = np.interp(grid.position_m, quick.position_m, quick.half_square)
    started = time.perf_counter()
    plan = solve_nlp(vehicle, grid, TIME_S, guess, *ENDS, solver)
    return {"peer": f"our NLP by {solver}", "intervals": intervals, "energy_kWh": plan.energy_j / KWH_J,
            "solve_ms": 1e3 * plan.solve_s, "total_ms": 1e3 * (time.perf_counter() - started)}


def shooting(vehicle: Vehicle, run: Course, intervals: int) -> dict[str, Any]:
    """What one would write first: multiple shooting, RK4 over position, state (b, t), uniform mesh, ipopt."""
    started = time.perf_counter()
    borders = np.unique(np.concatenate((np.linspace(0, run.length_m, intervals + 1), run.position_m)))
    n, h = len(borders) - 1, np.diff(borders)
    cells = run.split(borders[1:-1])
    opti = ca.Opti()
    b, t, pull, brake = opti.variable(n + 1), opti.variable(n + 1), opti.variable(n), opti.variable(n)
    a, b_1, c = vehicle.davis_n
    top = float(cells.limit_mps.max()) ** 2 / 2
    force = vehicle.traction.force_n
    state, net, line, step = ca.SX.sym("state", 2), ca.SX.sym("net"), ca.SX.sym("line"), ca.SX.sym("step")

    def rates(x: Any) -> Any:
        v = ca.sqrt(2 * ca.fmax(x[0], 1e-6))
        return ca.vertcat((net - a - b_1 * v - c * v**2 - line) / vehicle.inertia_kg, 1 / v)

    k_1 = rates(state)
    k_2 = rates(state + step / 2 * k_1)
    k_3 = rates(state + step / 2 * k_2)
    k_4 = rates(state + step * k_3)
    one = ca.Function("one", [state, net, line, step], [state + step / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4)]).map(n)
    reached = one(ca.horzcat(b[:-1] * top, t[:-1] * TIME_S).T, (pull - brake).T * force,
                  ca.DM(cells.force_n.mean(axis=1)[None, :]), ca.DM(h[None, :]))
    opti.subject_to(reached[0, :].T / top == b[1:])
    opti.subject_to(t[1:] == reached[1, :].T / TIME_S)
    limit = np.minimum(np.append(cells.limit_mps, np.inf), np.insert(cells.limit_mps, 0, np.inf)) ** 2 / 2 / top
    opti.subject_to(opti.bounded(0.1 / top, b, limit))
    opti.subject_to([b[0] == ENDS[0] ** 2 / 2 / top, b[n] == ENDS[1] ** 2 / 2 / top, t[0] == 0, t[n] <= 1])
    for u, side in ((pull, vehicle.traction), (brake, vehicle.regenerative)):
        opti.subject_to(opti.bounded(0, u, 1))
        for node in (b[:-1], b[1:]):
            opti.subject_to(u * ca.sqrt(2 * top * node) <= side.power_w / force)
    opti.minimize((ca.dot(ca.DM(h), pull) / vehicle.traction_efficiency
                   - vehicle.regenerative_efficiency * ca.dot(ca.DM(h), brake)) / run.length_m)
    quick = least_time(vehicle, run, *ENDS)
    first = np.interp(borders, quick.position_m, quick.half_square)
    opti.set_initial(b, np.maximum(first / top, 0.2 / top))
    opti.set_initial(t, np.interp(borders, quick.position_m, quick.time_s) / TIME_S)
    opti.set_initial(pull, 0.2)
    opti.solver("ipopt", {"print_time": False}, {"print_level": 0, "sb": "yes", "max_iter": 1000})
    solving = time.perf_counter()
    solved = opti.solve()
    done = time.perf_counter()
    return {"peer": "multiple shooting, RK4, ipopt", "intervals": n,
            "energy_kWh": float(solved.value(opti.f)) * force * run.length_m / KWH_J,
            "solve_ms": 1e3 * (done - solving), "total_ms": 1e3 * (done - started)}


def exponent(sizes: Array, seconds: Array) -> float:
    """Slope of the least-squares line through the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path, default=SHARED)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    vehicle, run = instance(asked.shared)
    ours(vehicle, run, 100)  # compiles what numba has not cached
    rows, kept = [], {}
    print("| intervals | energy kWh | bound kWh | gap % | off GPOPS-II % | solve ms | of one plan ms | total ms |")
    print("|---|---|---|---|---|---|---|---|")
    for intervals in INTERVALS:
        row, kept[intervals] = ours(vehicle, run, intervals)
        rows.append(row)
        print(f"| {intervals} | {row['energy_kWh']:.4f} | {row['bound_kWh']:.4f} | {row['gap_percent']:.4f} | "
              f"{row['off_gpops_percent']:+.4f} | {row['solve_ms']:.0f} | {row['plan_ms']:.0f} | "
              f"{row['total_ms']:.0f} |", flush=True)
    sizes = np.array([row["intervals"] for row in rows], dtype=float)
    grown = {key: exponent(sizes, np.array([row[key] for row in rows])) for key in ("plan_ms", "total_ms")}
    print(f"\ncost grows as intervals^{grown['plan_ms']:.3f} (solve), ^{grown['total_ms']:.3f} (in all), "
          f"fitted from {INTERVALS[0]} to {INTERVALS[-1]}")
    stored = gpops(asked.shared, vehicle, run, kept[1000])
    print("GPOPS-II, stored: " + ", ".join(f"{key} {value:.6g}" for key, value in stored.items()))
    peers = []
    print("\n| peer | intervals | energy kWh | solve ms | total ms |\n|---|---|---|---|---|")
    attempts = [(nonlinear, (300, "fatrop")), (nonlinear, (300, "ipopt")), (nonlinear, (1000, "fatrop")),
                (nonlinear, (1000, "ipopt")), (shooting, (300,)), (shooting, (1000,))]
    for peer, arguments in attempts:
        try:
            row = peer(vehicle, run, *arguments)
        except (RuntimeError, WorkbenchError) as trouble:
            print(f"| {peer.__name__} | {arguments[0]} | failed: {str(trouble).splitlines()[0][:60]} | | |")
            continue
        peers.append(row)
        print(f"| {row['peer']} | {row['intervals']} | {row['energy_kWh']:.3f} | {row['solve_ms']:.0f} | "
              f"{row['total_ms']:.0f} |", flush=True)
    if asked.json:
        asked.json.write_text(json.dumps({"rows": rows, "growth": grown, "gpops": stored, "peers": peers}, indent=1))


if __name__ == "__main__":
    main()

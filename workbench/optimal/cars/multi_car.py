"""An energy-optimal run of a train of several cars: planned as one body, shared by the cars, proven by simulation.

Forces between cars cancel in their sum. So a run that is planned for the train as one body, with the line's forces
averaged over it and the sums of the cars' limits, is a run of the cars too as long as they keep together, and
`share_forces` says what each of them does. Couplers are springs, and the cars do not quite keep together: how far they
part, what the couplers carry and what energy that takes is simulated with the cars' own equations.
They are driven by the shared forces over time and by a weak correction that keeps their mean to the plan: beyond a
summit a force over time alone holds no train, because whoever is late is pulled back and whoever is early runs ahead.

What the bound of the run says of the cars: it is proven for the train as one body. Of the cars it is known that

    work at the wheels = gain of kinetic and coupler energy + work of resistance and line + loss in the dampers,

where the dampers only take. The line's work depends on where each car starts and ends alone, and rolling resistance,
linear in the speed, takes no less of cars that move differently than of their mean. That the air takes no less, which
the first car meets at its own speed, and that limits met by each car on its own do not allow a cheaper run, is not
proven. `resistance_j` beside `one_body_j` says how far the run at hand is off; the residual of the balance says how
exact the simulation is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from types import ModuleType

import numpy as np
import sympy as sp

from workbench.compile.kernel import cars_source, loop_module
from workbench.errors import SolverError
from workbench.optimal.cars import cars_loop
from workbench.optimal.cars.car_train import VALUES, CarTrain, car_limits
from workbench.optimal.cars.cars_loop import WORKS
from workbench.optimal.cars.cars_steady import carried_ahead
from workbench.optimal.cars.share_forces import Rule, Shares, share_forces
from workbench.optimal.course import Array, Course
from workbench.optimal.force_reserve import needed_force
from workbench.optimal.inputs.line import Line, course
from workbench.optimal.smooth_run import SmoothRun
from workbench.trains import multi_particle as of_cars

# Between two rows of the forces, and steps of the simulation in each: 5 ms, where couplers swing with up to 2 Hz.
ROW_S, SUBSTEPS = 0.05, 10
# Within so long the correction takes the mean of the cars back to the plan, critically damped.
RETURN_S = 10.0
_electric = of_cars.each_car("u_electric")[0]
_prices = sp.symbols("eta_traction eta_regenerative", positive=True)


@dataclass(frozen=True)
class CarsRun:
    """What the simulated cars did.

    time_s: shape (rows,); force_n, position_m, speed_mps: shape (rows, cars), of each car, the correction included, and
    its place counted as that of the first; coupler_n, planned_coupler_n: shape (rows, cars - 1), positive where pulled,
    simulated and for cars that keep together. peak_coupler_n: shape (cars - 1,), of every step. energy_j: at the
    supply, with auxiliaries; works: by WORKS; stored_j: gain of kinetic and coupler energy; residual_j: what the
    balance leaves open; one_body_j: work of resistance and line on the train as one body. position_drift_m,
    speed_drift_mps: of the mean of the cars from the plan, at most. correction_n: largest correction of all cars
    together. force_excess: largest force of a car beyond its limit there, as a share of the largest that a car has;
    stretch_m: longest way that two neighbours part or close up; apart_m: of first and last together.
    """

    train: CarTrain
    rule: Rule
    time_s: Array
    force_n: Array
    position_m: Array
    speed_mps: Array
    coupler_n: Array
    planned_coupler_n: Array
    peak_coupler_n: Array
    energy_j: float
    works: dict[str, float]
    stored_j: float
    residual_j: float
    one_body_j: float
    position_drift_m: float
    speed_drift_mps: float
    correction_n: float
    force_excess: float
    stretch_m: float
    apart_m: float


@cache
def _kernel() -> ModuleType:
    state, data, pushed, held = (of_cars.s, of_cars.v), (of_cars.m, of_cars.first), (of_cars.f_a,), (of_cars.u,)
    pull = of_cars.coupler_pull(tuple(of_cars.ahead(x) for x in state), state)
    resisting = of_cars.basic_resistance(of_cars.m, of_cars.v, of_cars.first * of_cars.m_total) + of_cars.f_a
    eta, regain = _prices
    supply = sp.Max(of_cars.u, 0) / eta + regain * _electric
    powers = (supply * of_cars.v, of_cars.u * of_cars.v, -resisting * of_cars.v,
              of_cars.c_d * (of_cars.ahead(of_cars.v) - of_cars.v) ** 2)
    return loop_module("multi_particle, driven by given forces", [
        cars_source("rates", (), VALUES, (state, data, pushed, held), (tuple(of_cars.rates[x] for x in state),)),
        cars_source("pulls", (), VALUES, (state,), ((pull,),)),
        cars_source("powers", (), (*VALUES, *_prices), (state, data, pushed, held, (_electric,)), (powers,)),
    ], cars_loop)


def car_course(line: Line, train: CarTrain) -> Course:
    """What each car meets along the whole line, by the position of its own front; behind its start as there."""
    return course(line, train.one_car)


def run_cars(train: CarTrain, of_train: Course, of_car: Course, run: SmoothRun,
             rule: Rule = "least_coupler_forces") -> CarsRun:
    """Share the forces of a smooth run of the train over its cars and simulate them.

    of_train: what the train as one body meets; of_car: what a car meets, from `car_course`. Raises SolverError where
    the simulated cars run away.
    """
    rows = max(2, int(np.ceil(run.trip_time_s / ROW_S)) + 1)
    time = np.linspace(0.0, run.trip_time_s, rows)
    s, v, a = run.at(time)
    total = needed_force(train.vehicle, of_train, s, v, a)
    behind = train.behind_first_m
    q = carried_ahead(train, v, a, line_force(of_car, s[:, None] - behind))
    shares = share_forces(rule, total, car_limits(train, v), q)
    planned = (np.cumsum(shares.force_n, axis=1) + q)[:, :-1]
    stretch = np.append(0.0, np.cumsum(planned[0] / train.coupler_n_per_m))
    start = np.stack((s[0] - stretch + stretch.mean(), np.full(train.cars, v[0])))
    log, used, pulled, works, peaks = _simulated(train, of_car, shares, start, np.stack((s, v), axis=1), time)
    places, speeds = log[:, 0], log[:, 1]
    kept = dict(zip(WORKS, works.tolist(), strict=True))
    stored = _stored(train, places[-1], speeds[-1]) - _stored(train, places[0], speeds[0])
    most = car_limits(train, np.abs(speeds))
    over = np.where(used > 0, used - most.traction_n, -used - most.electric_n - most.friction_n)
    still = car_limits(train, np.zeros(1))
    size = float(max(still.traction_n.max(), (still.electric_n + still.friction_n).max()))
    alone = (total - train.vehicle.inertia_kg * a) * v
    return CarsRun(
        train, rule, time, used, places, speeds, pulled[:, 0, 1:], planned, peaks[1:-1],
        kept["supply_j"] + train.vehicle.auxiliary_w * run.trip_time_s, kept, stored,
        kept["wheel_j"] - stored - kept["resistance_j"] - kept["damper_j"], float(np.trapezoid(alone, time)),
        float(np.abs(places.mean(axis=1) - s).max()), float(np.abs(speeds.mean(axis=1) - v).max()), float(peaks[-1]),
        max(0.0, float(over.max()) / size),
        float(np.abs(np.diff(places, axis=1)).max(initial=0.0)), float(np.abs(places[:, -1] - places[:, 0]).max()))


def line_force(of_car: Course, front_m: Array) -> Array:
    """The line's force on a car, N, for positions of its front in m; beyond the ends as at the ends."""
    x, force = of_car.position_m, of_car.force_n
    k = np.clip(np.searchsorted(x, front_m, side="right") - 1, 0, len(force) - 1)
    share = np.clip((front_m - x[k]) / (x[k + 1] - x[k]), 0.0, 1.0)
    return np.asarray(force[k, 0] + share * (force[k, 1] - force[k, 0]))


def _simulated(train: CarTrain, of_car: Course, shares: Shares, start: Array, plan: Array,
               time: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Positions and speeds, forces, pulls, works and peaks, as `cars_loop.drive` fills them."""
    rows, cars = shares.force_n.shape
    log, used, pulled = np.zeros((rows, 2, cars)), np.zeros((rows, 1, cars)), np.zeros((rows, 1, cars))
    works, peaks = np.zeros(len(WORKS)), np.zeros(cars + 1)
    gains = train.vehicle.inertia_kg * np.array([1 / RETURN_S**2, 2 / RETURN_S])
    numbers = np.array([train.values()[str(x)] for x in VALUES])
    prices = np.array([*numbers, train.vehicle.traction_efficiency, train.vehicle.regenerative_efficiency])
    reached = _kernel().drive(
        plan, shares.force_n[:, None], shares.electric_n[:, None], SUBSTEPS, (time[1] - time[0]) / SUBSTEPS, gains,
        np.array(train.motors, dtype=float), start, numbers, prices, train.data(), train.behind_first_m,
        of_car.position_m, of_car.force_n, log, used, pulled, np.zeros((len(WORKS), cars)), works, peaks)
    if reached < rows:
        raise SolverError(f"cars: the simulated train runs away at {time[reached]:.1f} s: its couplers are too stiff "
                          f"for steps of {1e3 * ROW_S / SUBSTEPS:g} ms: soften them")
    return log, used[:, 0], pulled, works, peaks


def _stored(train: CarTrain, places: Array, speeds: Array) -> float:
    """Kinetic energy of the cars and energy of the couplers, J."""
    return float(train.car_inertia_kg / 2 * np.sum(speeds**2)
                 + train.coupler_n_per_m / 2 * np.sum(np.diff(places) ** 2))

"""Random trains, courses and runs for the tests of the optimiser, by hypothesis."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError, drivable, fastest
from workbench.optimal.profile import Profile
from workbench.optimal.vehicle import ForceLimit, Vehicle

MASS = 3e5


def numbers(low, high):
    return st.floats(low, high, allow_nan=False).map(lambda value: round(value, 6))


@st.composite
def limits(draw, most_n):
    """A force limit: constant, with a power, with a table that need not be concave nor fall."""
    force = draw(numbers(0.3, 1.0)) * most_n
    power = draw(st.sampled_from([np.inf, 4.0 * most_n, 12.0 * most_n]))
    if not draw(st.booleans()):
        return ForceLimit(force, power)
    speeds = sorted(draw(st.lists(numbers(0.0, 45.0), min_size=2, max_size=5, unique_by=lambda v: round(v, 1))))
    return ForceLimit(force, power, tuple((v, draw(numbers(0.25, 1.2)) * most_n) for v in speeds))


@st.composite
def vehicles(draw):
    return Vehicle(
        "drawn", MASS, (draw(numbers(500, 6e3)), draw(st.sampled_from([0.0, 60.0, 200.0])), draw(numbers(1.0, 20.0))),
        draw(limits(3e5)), draw(st.one_of(st.just(ForceLimit(0.0)), limits(2e5))), draw(numbers(1.2e5, 3e5)),
        rotating_fraction=draw(st.sampled_from([0.0, 0.08])),
        max_acceleration_mps2=draw(st.sampled_from([np.inf, 0.15, 0.5, 0.9])),
        max_deceleration_mps2=draw(st.sampled_from([np.inf, 0.2, 0.6])),
        traction_efficiency=draw(numbers(0.6, 1.0)),
        regenerative_efficiency=draw(st.sampled_from([0.0, 0.5, 0.8, 1.0])),
        auxiliary_w=draw(st.sampled_from([0.0, 5e4])))


@st.composite
def courses(draw, most_sections=6):
    """Limits, ramps and jumps of the line's force, ramps and jumps of tunnel drag, stops."""
    count = draw(st.integers(1, most_sections))
    length = np.array(draw(st.lists(numbers(60.0, 2500.0), min_size=count, max_size=count)))
    position = np.insert(np.cumsum(length), 0, 0.0)
    limit = np.array(draw(st.lists(numbers(6.0, 45.0), min_size=count, max_size=count)))
    force = np.array([[draw(numbers(-5e4, 5e4)) for _ in range(2)] for _ in range(count)])
    drag = np.array([[draw(st.sampled_from([0.0, 0.0, 10.0, 40.0])) for _ in range(2)] for _ in range(count)])
    stops = tuple(float(x) for x in position[1:-1] if draw(st.integers(0, 4)) == 0)
    return Course(position, limit, force, drag, stops)


@st.composite
def certificate_values(draw, count):
    """p at both ends of cells, and a time price, of the size that matters."""
    p = np.array([[draw(numbers(-0.7, 2.5)) for _ in range(2)] for _ in range(count)])
    return p[:, 0], p[:, 1], draw(st.sampled_from([0.0, 2e4, 3e5, 2e6]))


def random_runs(vehicle: Vehicle, course: Course, seed: int, count: int, start_mps: float = 0.0,
                end_mps: float = 0.0) -> list[Profile]:
    """Drivable runs: the fastest one, and those below random targets, smooth and jagged."""
    rng = np.random.default_rng(seed)
    cells = course.split(np.linspace(course.position_m[0], course.position_m[-1], 402)[1:-1])
    try:
        quick = fastest(vehicle, cells, start_mps, end_mps)
    except InfeasibleRunError:
        return []
    runs = [quick]
    top = max(float(quick.half_square.max()), 1e-6)
    for _ in range(count):
        knots = rng.uniform(course.position_m[0], course.position_m[-1], rng.integers(2, 12))
        knots = np.unique(np.concatenate((knots, course.position_m[[0, -1]])))
        share = rng.uniform(0.02, 1.0, len(knots)) ** rng.choice([0.5, 1.0, 2.0])
        target = np.interp(cells.position_m, knots, share * top)
        if rng.uniform() < 0.4:
            target = np.minimum(target, rng.uniform(0.1, 1.0) * top)
        try:
            runs.append(drivable(vehicle, cells, np.maximum(target, 1e-3), start_mps, end_mps))
        except InfeasibleRunError:
            continue  # too slow for a hill
    return [run for run in runs if np.isfinite(run.trip_time_s)]

"""Trains of several cars: forces shared by the rule, steady states, and the simulated cars under a planned run."""

import json
from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import LINES_FOR_ALL, SHARED, YANG, line_name
from scipy.integrate import solve_ivp
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.errors import InputError
from workbench.optimal.cars.car_train import CarLimits, CarTrain, car_limits
from workbench.optimal.cars.cars_steady import carried_ahead, resting_forces, steady_state
from workbench.optimal.cars.multi_car import car_course, line_force, run_cars
from workbench.optimal.cars.share_forces import RULES, share_forces
from workbench.optimal.course import Course
from workbench.optimal.inputs.files import load_cars, load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import least_time
from workbench.optimal.smooth import smooth_reference
from workbench.optimal.smooth_run import SmoothRun
from workbench.optimal.vehicle import ForceLimit

TRAIN = SHARED / "trains" / "chen2019_cars.toml"
LINE = load_line(YANG.parent / "line.toml")[0]


def of_cars(count: int, **changes: object) -> CarTrain:
    """The bundled train with another number of the same cars."""
    six = load_cars(TRAIN)
    more, v = count / 6, six.vehicle
    motors = tuple(car % 2 == 0 for car in range(count))
    longer = replace(v, mass_kg=v.mass_kg * more, length_m=v.length_m * more, traction=ForceLimit(4e4 * sum(motors)),
                     davis_n=tuple(x * more for x in v.davis_n), friction_brake_n=v.friction_brake_n * more)
    return replace(six, vehicle=replace(longer, **changes), motors=motors)


def same(n: int, rows: int, value: float) -> np.ndarray:
    return np.full((rows, n), value)


# --- the rule ---------------------------------------------------------------------------------------------------------


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 9), st.integers(0, 2**32 - 1), st.floats(-1, 1))
def test_the_split_is_the_least_of_the_convex_program(n, seed, part):
    draw = np.random.default_rng(seed)
    limits = CarLimits(*(draw.uniform(0, 4e4, (1, n)) * (draw.random((1, n)) < 0.7) + 1.0 for _ in range(3)))
    q = np.cumsum(draw.normal(0, 2e4, (1, n)), axis=1)
    total = part * limits.traction_n.sum() if part > 0 else part * (limits.electric_n + limits.friction_n).sum()
    got = share_forces("least_coupler_forces", np.array([total]), limits, q)
    electric = limits.electric_n[0]
    if total >= 0:
        low, high = 0 * electric, limits.traction_n[0]
    elif -total <= electric.sum():
        low, high = -electric, 0 * electric
    else:
        low, high = -electric - limits.friction_n[0], -electric
    u = cp.Variable(n)
    carried = cp.cumsum(u) + q[0] / 1e4
    problem = cp.Problem(cp.Minimize(cp.sum_squares(carried[:-1])),
                         [cp.sum(u) == total / 1e4, u >= low / 1e4, u <= high / 1e4])
    problem.solve(solver=cp.CLARABEL)
    cost = float(np.sum((np.cumsum(got.force_n[0]) + q[0])[:-1] ** 2)) / 1e8
    assert cost <= problem.value + 1e-5 * max(1.0, problem.value)
    assert np.allclose(got.force_n.sum(), total, rtol=1e-9, atol=1e-6)
    assert np.all(got.force_n[0] >= low - 1e-6) and np.all(got.force_n[0] <= high + 1e-6)


@pytest.mark.parametrize("rule", RULES)
@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_every_rule_keeps_limits_and_the_energy_of_the_whole(rule, seed):
    draw = np.random.default_rng(seed)
    train = of_cars(8, regenerative=ForceLimit(1.5e5, 2e6), regenerative_efficiency=0.8)
    speed = draw.uniform(0, 60, 50)
    limits = car_limits(train, speed)
    braking = limits.electric_n.sum(axis=1) + limits.friction_n.sum(axis=1)
    total = np.where(draw.random(50) < 0.5, limits.traction_n.sum(axis=1), -braking) * draw.random(50)
    got = share_forces(rule, total, limits, np.cumsum(draw.normal(0, 1e4, (50, 8)), axis=1))
    assert np.allclose(got.force_n.sum(axis=1), total, atol=1e-6)
    # No car works against the others, trailers do not pull, and electric brakes come before friction.
    assert np.all(got.force_n * np.sign(total)[:, None] >= -1e-6)
    assert np.all(got.force_n <= limits.traction_n + 1e-6)
    assert np.all(got.force_n >= -limits.electric_n - limits.friction_n - 1e-6)
    assert np.allclose(-got.electric_n.sum(axis=1), np.clip(-total, 0, limits.electric_n.sum(axis=1)), atol=1e-6)


@pytest.mark.parametrize("rule", RULES)
def test_the_split_is_continuous_in_the_total(rule):
    train = of_cars(6, regenerative=ForceLimit(9e4), regenerative_efficiency=0.8)
    total = np.linspace(-3.2e5, 1.19e5, 20_001)
    limits = car_limits(train, np.full(len(total), 20.0))
    q = np.tile(np.cumsum([-1e4, 3e3, -5e3, -4e3, 8e3, -6e3]), (len(total), 1))
    force = share_forces(rule, total, limits, q).force_n
    # Forces of all cars go the same way with the total, or back by as much as coupler forces ask for: Lipschitz.
    assert np.abs(np.diff(force, axis=0)).max() <= 8 * (total[1] - total[0])


def test_more_than_the_cars_have_is_given_and_said():
    train = of_cars(6)
    limits = car_limits(train, np.zeros(2))
    got = share_forces("least_coupler_forces", np.array([1.32e5, -2.64e5]), limits, same(6, 2, 0))
    assert got.excess == pytest.approx([0.1, 0.1])
    assert got.force_n.sum(axis=1) == pytest.approx([1.32e5, -2.64e5])
    with pytest.raises(InputError, match="no rule"):
        share_forces("best", np.zeros(1), car_limits(train, np.zeros(1)), same(6, 1, 0))


# --- steady states ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [6, 8, 16, 32])
@pytest.mark.parametrize("grade", [0.0, 3.0, -10.0])
def test_a_long_simulation_of_constant_forces_settles_in_the_steady_state(count, grade):
    train, speed = of_cars(count), 30.0
    state = steady_state(train, speed, grade)
    # Written again with vectors: chen2019 (1)-(3) with the slope as f_a, from unstretched couplers.
    m, c0, cv, ca, ck, cd = 5e4, 0.00775, 0.000228, 0.0000166, 2e6, 1e5
    A = 2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    A[0, 0] = A[-1, -1] = 1
    first = np.arange(count) == 0

    def rates(_, y):
        x, v = y[:count], y[count:]
        air = first * ca * m * count * v**2
        return np.concatenate((v, (state.force_n - m * (c0 + cv * v) - air - m * 9.80665e-3 * grade
                                   - ck * A @ x - cd * A @ v) / m))

    slowest = ck / m * (2 * np.sin(np.pi / (2 * count))) ** 2
    settled = 12 / (slowest * cd / ck / 2)
    found = solve_ivp(rates, (0, settled), np.concatenate((np.zeros(count), np.full(count, speed))), method="LSODA",
                      rtol=1e-9, atol=1e-9).y[:, -1]
    assert found[count:] == pytest.approx(np.full(count, speed), abs=1e-5)
    assert found[:count - 1] - found[1:count] == pytest.approx(state.stretch_m, abs=1e-5)
    assert state.coupler_n == pytest.approx(2e6 * state.stretch_m)


def test_the_steady_state_solves_the_linear_system():
    train = of_cars(16)
    state = steady_state(train, 40.0, 2.0)
    rest = resting_forces(train, np.array([40.0]))[0] - 5e4 * 9.80665 * 2e-3
    # Of every car: own force, resistance, and what both couplers pull.
    incidence = np.eye(16, 15) - np.eye(16, 15, k=-1)
    stretch = np.linalg.lstsq(2e6 * incidence, state.force_n + rest, rcond=None)[0]
    assert state.stretch_m == pytest.approx(stretch, abs=1e-12)
    assert np.sum(state.force_n + rest) == pytest.approx(0, abs=1e-6)


def test_a_speed_that_cannot_be_held_is_refused():
    with pytest.raises(InputError, match="cannot be held"):
        steady_state(of_cars(6), 30.0, 60.0)


# --- the run ----------------------------------------------------------------------------------------------------------


def planned(train: CarTrain, time_s: float, to_m: float, **more: float) -> tuple[Course, SmoothRun]:
    run = course(LINE, train.vehicle, 0.0, to_m)
    return run, smooth_reference(train.vehicle, run, time_s, intervals=200, **more).run


@pytest.mark.parametrize("count", [6, 8, 16, 32])
def test_what_the_cars_meet_sums_to_what_the_train_meets(count):
    train = of_cars(count)
    whole, car = course(LINE, train.vehicle), car_course(LINE, train)
    front = np.linspace(0.0, LINE.length_m, 3001)
    k = np.clip(np.searchsorted(whole.position_m, front, side="right") - 1, 0, len(whole.force_n) - 1)
    share = (front - whole.position_m[k]) / np.diff(whole.position_m)[k]
    train_force = whole.force_n[k, 0] + share * (whole.force_n[k, 1] - whole.force_n[k, 0])
    total = line_force(car, front[:, None] - train.behind_first_m).sum(axis=1)
    assert total == pytest.approx(train_force, abs=1e-6 * np.abs(train_force).max())


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("count", [6, 8, 16, 32])
def test_the_simulated_cars_follow_the_plan(count, rule):
    train = of_cars(count)
    run, smooth = planned(train, 420.0, 9500.0)
    found = run_cars(train, run, car_course(LINE, train), smooth, rule)
    assert found.position_drift_m < 0.02 and found.speed_drift_mps < 0.002
    # The correction is a thousandth of what the cars have: the shared forces do the work.
    assert found.correction_n < 1e-3 * 4e4 * count and found.force_excess < 1e-3
    # The balance of energy closes, and the dampers only take.
    assert abs(found.residual_j) < 1e-6 * found.works["wheel_j"] and found.works["damper_j"] > 0
    assert found.works["resistance_j"] == pytest.approx(found.one_body_j, rel=1e-4)
    # Without returned energy and at full efficiency the supply gives what the wheels drive with.
    assert found.energy_j >= found.works["wheel_j"]
    assert found.stretch_m >= 0.99 * np.abs(found.planned_coupler_n).max() / train.coupler_n_per_m / 2


@pytest.mark.parametrize("path", LINES_FOR_ALL, ids=line_name)
def test_the_cars_keep_to_the_plan_on_every_bundled_line_and_stop_where_it_stops(path):
    train, (line, _) = of_cars(6), load_line(path)
    stops = line.stops_between(0.0, line.length_m)
    run = course(line, train.vehicle, 0.0, line.length_m, stops)
    least = least_time(train.vehicle, run).trip_time_s + 30.0 * len(stops)
    smooth = smooth_reference(train.vehicle, run, 1.2 * least, dwell_s=30.0, intervals=400)
    found = run_cars(train, run, car_course(line, train), smooth.run)
    assert found.position_drift_m < 0.02 and found.correction_n < 300.0 and found.force_excess < 2e-2
    assert abs(found.residual_j) < 1e-6 * found.works["wheel_j"]
    assert found.energy_j == pytest.approx(smooth.energy_j, rel=1e-3)
    standing = np.abs(found.speed_mps).max(axis=1) < 1e-2
    for stop in stops:
        there = np.abs(found.position_m.mean(axis=1) - stop) < 0.05
        assert np.sum(standing & there) * (found.time_s[1] - found.time_s[0]) > 15.0


def test_an_independent_integration_finds_the_same_couplers_and_the_same_speed():
    train = of_cars(6)
    run, smooth = planned(train, 95.0, 700.0)
    car = car_course(LINE, train)
    found = run_cars(train, run, car, smooth)

    def rates(t, y):
        x, v = y[:6], y[6:]
        u = np.array([np.interp(t, found.time_s, found.force_n[:, j]) for j in range(6)])
        pull = 2e6 * (x[:-1] - x[1:]) + 1e5 * (v[:-1] - v[1:])
        air = np.array([0.0000166 * 3e5 * v[0] ** 2, 0, 0, 0, 0, 0])
        couplers = np.append(0, pull) - np.append(pull, 0)
        return np.concatenate((v, (u - 5e4 * (0.00775 + 0.000228 * v) - air - line_force(car, x - train.behind_first_m)
                                   + couplers) / 5e4))

    start = np.concatenate((found.position_m[0], found.speed_mps[0]))
    end = solve_ivp(rates, (0, 95.0), start, method="RK45", rtol=1e-8, atol=1e-9, max_step=0.02).y[:, -1]
    assert found.position_m[-1] == pytest.approx(end[:6], abs=1e-4)
    assert found.speed_mps[-1] == pytest.approx(end[6:], abs=1e-4)


def test_the_least_rule_carries_less_than_equal_shares_between_cars_that_keep_together():
    train = of_cars(16)
    run, smooth = planned(train, 420.0, 9500.0)
    least, equal = (run_cars(train, run, car_course(LINE, train), smooth, rule).planned_coupler_n for rule in RULES)
    assert np.all(np.sum(least**2, axis=1) <= np.sum(equal**2, axis=1) * (1 + 1e-9) + 1e-3)


def test_rigid_cars_carry_what_was_planned():
    """Ten times stiffer and well damped couplers bring the simulated forces to the planned ones."""
    soft = of_cars(6)
    stiff = replace(soft, coupler_n_per_m=2e7, coupler_n_s_per_m=1e6)
    run, smooth = planned(soft, 420.0, 9500.0, window_s=4.0)
    off = [float(np.sqrt(np.mean((r.coupler_n - r.planned_coupler_n) ** 2)))
           for r in (run_cars(t, run, car_course(LINE, t), smooth) for t in (soft, stiff))]
    assert off[1] < 0.35 * off[0]


def test_what_stands_ahead_is_carried():
    train = of_cars(6)
    q = carried_ahead(train, np.array([10.0]), np.array([0.1]), same(6, 1, 100.0))
    resistance = 5e4 * (0.00775 + 0.00228) + 100.0 + 5e3
    air = 0.0000166 * 3e5 * 100
    assert q[0] == pytest.approx([-(air + k * resistance) for k in range(1, 7)])


# --- files and the command --------------------------------------------------------------------------------------------


def test_a_train_without_cars_has_none():
    assert load_cars(SHARED / "trains" / "chen2019.toml") is None
    train = load_cars(TRAIN)
    assert train.motors == (True, False) * 3 and train.vehicle == load_vehicle(TRAIN)[0]
    limits = car_limits(train, np.zeros(1))
    assert limits.traction_n[0] == pytest.approx([4e4, 0] * 3) and limits.friction_n[0] == pytest.approx([4e4] * 6)


@pytest.mark.parametrize(("old", "new", "key"), [
    ("count = 6\n", "count = 1\n", "cars.count"), ("count = 6\n", "count = 256\n", "cars.count"),
    ('motor_pattern = "10"', 'motor_pattern = "0"', "no motor"),
    ('motor_pattern = "10"', 'motor_pattern = "x"', "cars.motor_pattern"),
    ("coupler_n_per_m = 2000000.0", "coupler_n_per_m = 1e9", "softer"),
    ("coupler_n_s_per_m = 100000.0\n", "", "cars.coupler_n_s_per_m"),
    ("coupler_n_per_m = 2000000.0", "coupler_n_per_m = nan", "coupler_n_per_m"),
    ("[cars.source]", "slack_m = 0.1\n[cars.source]", "slack_m"),
])
def test_what_is_wrong_with_cars_is_said_in_one_line(tmp_path, old, new, key):
    path = tmp_path / "train.toml"
    text = TRAIN.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(InputError) as trouble:
        load_cars(path)
    assert str(path) in str(trouble.value) and key in str(trouble.value) and "\n" not in str(trouble.value)


def test_the_command_gives_the_cars_too(tmp_path):
    out, figure = tmp_path / "run.json", tmp_path / "run.svg"
    done = CliRunner().invoke(app, [
        "reference", str(YANG.parent / "line.toml"), str(TRAIN), "--time", "420", "--to-m", "9500",
        "--intervals", "150", "--json", str(out), "--figure", str(figure)])
    assert done.exit_code == 0, done.output
    document = json.loads(out.read_text(encoding="utf-8"))
    cars = document["cars"]
    assert cars["count"] == 6 and len(cars["peak_coupler_N"]) == 5
    assert cars["energy_J"] == pytest.approx(document["smooth"]["energy_J"], rel=1e-4)
    rows = np.genfromtxt(cars["csv"], delimiter=",", names=True)
    assert len(rows.dtype.names) == 12 and rows["t_s"][-1] == pytest.approx(420.0)
    smooth = np.genfromtxt(document["csv"], delimiter=",", names=True)
    total = sum(rows[f"u{j}_N"] for j in range(1, 7))
    at = np.interp(rows["t_s"], smooth["t_s"], smooth["u_N"])
    assert np.median(np.abs(total - at)) < 500.0
    assert (tmp_path / "run_couplers.svg").exists() and figure.exists()

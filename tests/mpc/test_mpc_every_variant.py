"""Every variant that is registered, new ones by themselves: at ipopt's closed-loop cost, and whatever goes wrong."""

import functools
import math

import numpy as np
import pytest
from ipopt_twin import tracking_by_ipopt, twin_of
from scenarios import short_scenario

from workbench.errors import InputError
from workbench.mpc import tracking
from workbench.mpc.controller import COMMON, KINDS, OPTIONAL
from workbench.mpc.tracking import TrackingMpc
from workbench.simulate.controllers import SAMPLED
from workbench.simulate.law_values import check_controllers

T = 0.1
NUMBERS = {"horizon": 25.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 4.34,
           "change_weight": 0.1, "band_price": 1000.0, "band_weight": 1000.0, "observer_gain": 0.3,
           "energy_price": 0.05, "time_price": 1.0, "regenerated": 0.0, "disturbance_mps2": 0.05,
           "forgetting": 0.995}
VARIANTS = [law for law in SAMPLED if law.startswith("mpc.")]
# The program of tracking.py, by casadi and compiled.
TRACKING = ("mpc.tracking", "mpc.tracking_compiled")
# Adaptive MPC is solved by mpc.nonlinear's own, of a train that changes from second to second.
SOLVED_BY = [("mpc.tracking", solver) for solver in tracking.SOLVERS] + [
    (law, "") for law in ("mpc.tracking_compiled", *KINDS) if law != "mpc.adaptive"]
# Less traction than the curve needs, and a power limit above 11 m/s; a band that is left, so that its price is paid.
TIGHT = {"train__max_traction_n": 146e3, "train__max_power_w": 1.8e6, "simulation__position_band_m": 0.02}


def wanted_by(law):
    return tracking.PARAMETERS if law in TRACKING else (*COMMON, *KINDS[law].parameters)


def scenario_of(law, changes=None, **world):
    parameters = {key: NUMBERS[key] for key in wanted_by(law)} | (changes or {})
    return short_scenario(controllers__mpc__law=law, controllers__mpc__parameters=parameters, **world)


def made(law, changes=None, **world):
    scenario = scenario_of(law, changes, **world)
    return SAMPLED[law](scenario, scenario.controllers["mpc"], "mpc"), scenario


def driven(ours, scenario, samples=330, bad=(), missed=()):
    """Commands, position errors and cost of a run on a heavier train, typed here; bad: nothing is measured; missed:
    the controller is not asked, the command before stays."""
    train, curve, band = scenario.train, scenario.desired_curve(), scenario.simulation.position_band_m
    a, b, c = train.davis_a_mps2, train.davis_b_per_s, train.davis_c_per_m
    weights, x, v, u = scenario.controllers["mpc"].parameters, 0.0, 0.0, 0.0
    commands, errors, cost = [], [], 0.0
    for k in range(samples):
        if k not in missed:
            u = ours.command(k * T, *((math.nan, math.nan) if k in bad else (x, v)))
        desired = [float(value) for value in curve.at(k * T)]
        error = x - desired[0]
        cost += (weights["position_weight"] * error**2 + weights["speed_weight"] * (v - desired[1]) ** 2
                 + weights["command_weight"] * u**2 + 1e3 * max(0.0, abs(error) - band))
        for _ in range(5):
            force = min(u, (train.max_power_w or math.inf) / train.mass_kg / max(v, 1e-3))
            rate = force / 1.02 - a - b * v - c * v * v
            x, v = x + T / 5 * v + (T / 5) ** 2 / 2 * rate, v + T / 5 * rate
        commands.append(u)
        errors.append(error)
    return np.array(commands), np.array(errors), cost


@functools.cache
def by_ipopt(law):
    scenario = scenario_of(law, **TIGHT)
    with pytest.MonkeyPatch.context() as patch:
        spec = scenario.controllers["mpc"]
        ours = (tracking_by_ipopt(patch, scenario, spec, "mpc") if law in TRACKING
                else twin_of(SAMPLED[law](scenario, spec, "mpc")))
        found = driven(ours, scenario)
    assert ours.counters["qp_failed"] == 0
    return found


def test_there_is_a_solver_for_every_registered_variant():
    assert {law for law, _ in SOLVED_BY} == set(VARIANTS) - {"mpc.adaptive"}


@pytest.mark.parametrize(("law", "solver"), SOLVED_BY)
def test_every_solver_of_every_variant_closes_the_loop_at_ipopts_cost(law, solver, capfd):
    scenario = scenario_of(law, **TIGHT)
    ours = (TrackingMpc(scenario, scenario.controllers["mpc"], "mpc", solver) if solver
            else SAMPLED[law](scenario, scenario.controllers["mpc"], "mpc"))
    commands, errors, cost = driven(ours, scenario)
    assert capfd.readouterr() == ("", "")
    expected, at, reference = by_ipopt(law)
    assert ours.counters["qp_failed"] == 0
    # Something binds: traction for a second or more, or the band's price is paid.
    limit = scenario.train.max_traction_n / scenario.train.mass_kg
    assert (commands > limit - 1e-6).sum() > 10 or (np.abs(errors) > 0.02).sum() > 10
    assert cost == pytest.approx(reference, rel=1e-5)
    assert commands == pytest.approx(expected, abs=2e-3)
    assert errors == pytest.approx(at, abs=1e-4)


@pytest.mark.parametrize("law", VARIANTS)
def test_missed_samples_and_measurements_are_borne(law):
    """A lost measurement is counted, a sample at which nobody asks is not; the train stays near its curve."""
    ours, scenario = made(law)
    plain, _ = made(law)
    _, free, _ = driven(plain, scenario)
    bad, missed = {40, 41, 200}, {90, 150, 151, 152}
    commands, errors, _ = driven(ours, scenario, bad=bad, missed=missed)
    assert np.isfinite(commands).all()
    assert np.abs(errors).max() < np.abs(free).max() + 0.2
    assert ours.counters["bad_measurement"] == len(bad)
    assert ours.counters["qp"] == 330 - len(bad) - len(missed)
    assert ours.counters["qp_failed"] == 0


@pytest.mark.parametrize("law", [law for law in VARIANTS if law in KINDS])
def test_a_deadline_that_no_solver_meets_is_counted_and_explained(law):
    assert "deadline_s" in OPTIONAL
    ours, scenario = made(law, {"deadline_s": 1e-9})
    _, errors, _ = driven(ours, scenario, 200)
    assert ours.counters["late"] == ours.counters["qp"] == 200
    assert ours.counters["lqr"] == 200
    assert np.abs(errors).max() < 1.0
    assert any(line.startswith("late: 200") for line in ours.explain())


@pytest.mark.parametrize("law", VARIANTS)
@pytest.mark.parametrize("world", [
    {"train__max_traction_n": 70e3}, {"train__max_braking_n": 3e3, "simulation__position_band_m": 1e-3},
    {"simulation__initial_position_m": 300.0}, {"simulation__initial_position_m": -9000.0},
    {"disturbance__amplitude_mps2": 3.0}])
def test_what_cannot_be_kept_is_answered_within_the_limits(law, world):
    """Too weak to start, no brakes, far from the curve: no program of any variant is without an answer for it."""
    ours, scenario = made(law, {"band_price": 1e6} if "band_price" in wanted_by(law) else None, **world)
    train, curve = scenario.train, scenario.desired_curve()
    for k in range(0, 1000, 50):
        position, speed, _ = (float(value) for value in curve.at(k * T))
        offset = scenario.simulation.initial_position_m
        u = ours.command(k * T, position + offset - 0.1 * k, max(0.0, speed - 0.01 * k))
        assert -train.max_braking_n - 1e-6 <= u * train.mass_kg <= train.max_traction_n + 1e-6


@pytest.mark.parametrize("law", VARIANTS)
def test_a_wrong_horizon_is_one_line(law):
    base = scenario_of(law)
    for horizon in (0.0, 1.0, -3.0, 1e6, 2.5, math.inf, math.nan):
        refused(base, "horizon", horizon)


@pytest.mark.parametrize("law", VARIANTS)
def test_numbers_that_are_none_are_one_line(law):
    base = scenario_of(law)
    for key in (*wanted_by(law), *(OPTIONAL if law in KINDS else ())):
        if key != "horizon" and (law, key) != ("mpc.economic", "regenerated"):
            for value in (-1.0, math.nan, *(() if key == "deadline_s" else (math.inf,))):  # no end is no deadline
                refused(base, key, value)


def refused(base, key, value):
    # Files cannot hold inf and nan here (the reader refuses them); what constructs a controller must not rely on it.
    spec = base.controllers["mpc"]
    bad = spec.model_copy(update={"parameters": spec.parameters | {key: value}})
    try:
        check_controllers(base.model_copy(update={"controllers": {"mpc": bad}}), "my.toml")
    except InputError as trouble:
        words = str(trouble)
    else:
        pytest.fail(f"{spec.law}: {key} = {value} is taken")
    assert words.startswith("my.toml: controllers.mpc.parameters")
    assert "\n" not in words
    assert key.removesuffix("_weight").removesuffix("_price").split("_")[0] in words or "price" in words

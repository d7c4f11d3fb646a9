"""The cascaded PID: what it feeds forward, how it lets go at limits, and that it follows better than a plain PID."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from contests import common

from workbench.contest.entrants import play
from workbench.model.cascaded_pid import cascaded_pid, speed_integral
from workbench.model.law import (
    desired_acceleration,
    desired_position,
    desired_speed,
    period,
    position,
    speed,
)
from workbench.model.laws import law_named
from workbench.simulate.closed_loop import setting_of
from workbench.simulate.metrics import measure
from workbench.trains.scenario import Scenario
from workbench.trains.track import resistance_table

GAINS = {"K_x": 0.5, "K_slow": 1.5, "K_fast": 2.0, "v_fast": 15.0, "K_i": 0.3, "T_t": 3.0, "davis_a": 0.03,
         "davis_b": 4e-4, "davis_c": 4e-5, "u_traction": 1.1, "u_brake": 1.2, "power_w_per_kg": 13.0}
ON_THE_CURVE = {position: 100.0, speed: 10.0, desired_position: 100.0, desired_speed: 10.0, desired_acceleration: 0.2,
                speed_integral: 0.0, period: 0.005}


def at(expression: sp.Expr, **changes: float) -> float:
    law = cascaded_pid()
    values = {symbol: GAINS[str(symbol)] for symbol in law.parameters} | ON_THE_CURVE
    values |= {symbol: changes[str(symbol)] for symbol in list(values) if str(symbol) in changes}
    return float(expression.subs(values))


def test_on_the_curve_it_asks_for_what_the_curve_needs_and_nothing_more() -> None:
    law = cascaded_pid()
    needed = 0.2 + 0.03 + 4e-4 * 10 + 4e-5 * 100
    assert at(law.command) == pytest.approx(needed)
    told = cascaded_pid(((0.0, 0.05), (80.0, -0.02), (120.0, 0.3)))
    assert at(told.command) == pytest.approx(needed + 0.05 - 0.02)
    assert at(law.states[0].rate) == pytest.approx(0.0, abs=1e-12)


def test_the_gain_grows_with_the_speed_and_the_cascade_is_the_product_of_both_loops() -> None:
    law, plain = cascaded_pid(), at(cascaded_pid().command)
    gain = 1.5 + 0.5 * 10 / 15
    assert at(law.command, x_1=99.9) - plain == pytest.approx(gain * 0.5 * 0.1)
    assert at(law.command, x_2=9.9) - plain == pytest.approx(gain * 0.1)
    assert at(law.command, K_fast=3.0, x_2=9.9) > at(law.command, x_2=9.9)


def test_limits_hold_and_the_integral_lets_go_at_them() -> None:
    law = cascaded_pid()
    assert at(law.command, x_1=0.0) == pytest.approx(1.1)
    assert at(law.command, x_1=0.0, x_2=20.0, xdot_d=20.0) == pytest.approx(13.0 / 20)
    assert at(law.command, x_1=500.0) == pytest.approx(-1.2)
    stuck = at(law.states[0].rate, x_1=0.0, eta_v=50.0)
    assert stuck < 0 < at(law.states[0].rate, x_1=0.0, eta_v=50.0, T_t=1e9)


@pytest.fixture(scope="module")
def world() -> Scenario:
    of = common().world
    spec = of.controllers["pid"].model_copy(update={
        "law": "cascaded_pid", "parameters": GAINS, "initial": {"eta_v": 0.0}})
    told = spec.model_copy(update={"law": "cascaded_pid.told"})
    return of.model_copy(update={"controllers": {"pid": of.controllers["pid"], "cascaded": spec, "told": told}})


def test_it_follows_better_than_a_plain_pid_and_better_still_when_told_the_line(world: Scenario) -> None:
    assert law_named("cascaded_pid", world.folder) is cascaded_pid()
    setting = setting_of(world)
    errors = {name: measure(play(world, name, setting).run, world).position_rms for name in world.controllers}
    assert errors["told"] < errors["cascaded"] / 3 < errors["pid"] / 6


def test_what_it_is_told_is_the_lines_own_resistance(world: Scenario) -> None:
    line = resistance_table(world.track)
    law = cascaded_pid(tuple(zip(line.position_m.tolist(), np.diff(line.specific_force, prepend=0.0).tolist(),
                                 strict=True)))
    values = {symbol: GAINS[str(symbol)] for symbol in law.parameters}
    force = sp.lambdify(position, (law.command - cascaded_pid().command).subs(
        values | {key: value for key, value in ON_THE_CURVE.items() if key is not position}
        | {desired_position: position}))
    places = np.array([10.0, 400.0, 1000.5, 1900.0, 3600.0, 5300.0])
    assert [force(place) for place in places] == pytest.approx(line.at(places).tolist(), abs=1e-12)
    assert replace(law, title="x").id == "cascaded_pid.told"

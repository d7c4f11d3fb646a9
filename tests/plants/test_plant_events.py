"""Switching plants against theory: bounces, a relay's limit cycle, dry friction, and what ends a run."""

import math

import numpy as np
import pytest
import sympy as sp

import workbench as wb
from workbench.simulate.plants.run import Entrant, run

h, v, u, x, m, y, w, k, z, n = sp.symbols("h v u x m y w k z n", real=True)
g, e, a, width, limit, pace = sp.symbols("g e a d F c", positive=True)
NOTHING = 1e-300
r = wb.Reference("r")
PUSH = wb.Law("push", {u: r.value}, references=(r,))
# Four switching plants in one, so that they are compiled once: a ball h, v; a relay x with its mode m; a block y, w
# with dry friction, whose mode k is the sign of its sliding; a saw z with its mode n.
STICKS = wb.Event("sticks", w, {w: 0, k: sp.Piecewise((0, sp.Abs(u) <= limit), (sp.sign(u), True))})
SLIPS = wb.Event("slips", sp.Piecewise((sp.Abs(u) - limit, sp.Eq(k, 0)), (-1, True)), {k: sp.sign(u)}, "rising")
PLANT = wb.Plant(
    "switching", (h, v, x, m, y, w, k, z, n), (v, -g, -a * x + m, 0, w, (u - limit * k) * sp.Abs(k), 0, pace, 0), (u,),
    parameters=tuple(wb.Parameter(symbol, value) for symbol, value in (
        (g, NOTHING), (e, 0.8), (a, 2.0), (width, 0.2), (limit, 1.0), (pace, NOTHING))),
    events=(wb.Event("bounce", h, {v: -e * v}, "falling"), wb.Event("down", x - width, {m: -1}, "rising"),
            wb.Event("up", x + width, {m: 1}, "falling"), STICKS, SLIPS, wb.Event("top", z - 1, {n: 1}, "rising"),
            wb.Event("back", n - sp.Rational(1, 2), {z: 0, n: 0}, "rising")))
METRICS = (wb.Metric("energy", "terminal", v**2 / 2 + g * h), wb.Metric("deepest", "smallest", h),
           wb.Metric("fastest", "largest", -v))


def moved(duration_s, initial, step_s=1e-2, period_s=1e-2, push=None, **more):
    """A run; the ball hangs in the air unless it is started."""
    setting = wb.Setting(PLANT, duration_s, step_s, initial={"h": 1.0} | initial, metrics=METRICS,
                         references={"r": push or wb.Constant(value=0.0)}, **more)
    return run(setting, Entrant("push", period_s, PUSH))


def thrown(duration_s, step_s=1e-2, period_s=1e-2):
    return moved(duration_s, {}, step_s, period_s, parameters={"g": 9.81})


def test_a_ball_bounces_when_and_as_high_as_the_closed_form_says():
    found = thrown(3.0)
    first, speed = math.sqrt(2 / 9.81), math.sqrt(2 * 9.81)
    times = first + np.concatenate([[0.0], np.cumsum(2 * speed / 9.81 * 0.8 ** np.arange(1, 40))])
    times = times[times < 3.0]
    assert len(found.events) == len(times) == 6
    assert [one.t_s for one in found.events] == pytest.approx(times, abs=1e-9)
    speeds = speed * 0.8 ** np.arange(1, len(times) + 1)
    assert [one.states[1] for one in found.events] == pytest.approx(speeds, abs=1e-8)
    assert found.metrics["energy"] == pytest.approx(9.81 * 0.64 ** len(times), rel=1e-8)
    assert wb.Run(wb.Setting(PLANT, 3.0), found).events == found.events
    assert found.metrics["fastest"] == pytest.approx(speed, rel=1e-10) and abs(found.metrics["deepest"]) < 1e-9


def test_where_bounces_pile_up_the_run_ends_in_one_line_at_their_limit():
    first, speed = math.sqrt(2 / 9.81), math.sqrt(2 * 9.81)
    for step in (1e-2, 1e-3):
        found = thrown(6.0, step)
        assert found.failed is not None and "'bounce'" in found.failed and "rests" in found.failed
        assert "\n" not in found.failed and set(found.metrics.values()) == {None}
        assert found.reached_s == pytest.approx(first + 2 * speed / 9.81 * 0.8 / 0.2, abs=2 * step)


def test_the_same_run_gives_the_same_bits_and_sampling_does_not_matter():
    one, same, other = thrown(2.0), thrown(2.0), thrown(2.0, period_s=0.5)
    assert (one.log == same.log).all() and one.events == same.events
    assert [event.t_s for event in other.events] == [event.t_s for event in one.events]


def test_a_relay_with_hysteresis_swings_in_its_exact_limit_cycle():
    """x' = -a x + m between -d and d: the relay switches every ln((1/a + d) / (1/a - d)) / a seconds."""
    found = moved(5.0, {"m": 1.0}, period_s=0.1)
    half = math.log((0.5 + 0.2) / (0.5 - 0.2)) / 2.0
    begin = -math.log(1 - 0.4) / 2.0
    times = [one.t_s for one in found.events]
    assert times == pytest.approx(begin + half * np.arange(len(times)), abs=1e-8) and len(times) > 8
    assert [one.id for one in found.events[:3]] == ["down", "up", "down"]
    assert np.max(np.abs(found.column("x"))) <= 0.2 + 1e-9


def test_dry_friction_brings_a_block_to_rest_exactly_and_holds_it():
    found = moved(4.0, {"w": 2.0, "k": 1.0}, period_s=0.1)
    assert [(one.id, one.t_s) for one in found.events] == [("sticks", pytest.approx(2.0, abs=1e-10))]
    assert found.column("y")[-1] == pytest.approx(2.0, abs=1e-10)
    assert found.column("w")[-1] == 0.0 == found.column("k")[-1]


def test_a_stuck_block_slips_at_the_instant_its_push_passes_the_friction():
    push = wb.Step(before=0.5, after=-3.0, at_s=1.0)
    found = moved(2.0, {}, push=push, lag_s={"u": 0.1})
    # From 0.5 (the lag is over) towards -3 the push passes -1 after 0.1 ln(3.5 / 2) s.
    assert [(one.id, one.t_s) for one in found.events] == [("slips", pytest.approx(1 + 0.1 * math.log(1.75), abs=1e-5))]
    jump = moved(2.0, {}, push=push)
    assert [(one.id, one.t_s) for one in jump.events] == [("slips", pytest.approx(1.0, abs=1e-12))]
    assert (jump.column("y")[-1], jump.column("w")[-1]) == pytest.approx((-1.0, -2.0), abs=1e-9)


def test_events_at_one_instant_act_in_their_order_and_a_reset_may_set_off_another():
    found = moved(3.5, {"z": 0.25}, 0.1, 0.1, parameters={"c": 1.0})
    assert [one.id for one in found.events] == ["top", "back"] * 3
    assert [one.t_s for one in found.events] == pytest.approx([0.75, 0.75, 1.75, 1.75, 2.75, 2.75], abs=1e-9)


@pytest.mark.parametrize(("event", "words"), [
    (lambda: wb.Event("none", h, {}), "sets no state"),
    (lambda: wb.Event("odd", h, {v: 0}, "down"), "direction 'down' is not known"),
    (lambda: wb.Plant("p", (h, v), (v, 0), events=(wb.Event("odd", h, {u: 0}),)), "'u', which is no state"),
    (lambda: wb.Plant("p", (h, v), (v, 0), events=(wb.Event("odd", u, {h: 0}),)), "'u', which is not declared"),
    (lambda: wb.Plant("p", (h, v), (v, 0), events=(wb.Event("one", h, {h: 0}),) * 2), "two events are called 'one'"),
    (lambda: wb.Setting(PLANT, 1.0, integrator="radau"), "take 'rk4'")])
def test_what_is_no_event_is_one_line(event, words):
    with pytest.raises(ValueError, match=words):
        event()

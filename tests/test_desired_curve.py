"""Desired curves: smoothness by finite differences, distance and shape by the laws of motion."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import polynomial as poly
from scenarios import BENCHMARKS, YANG, name_of
from scipy.integrate import quad

from workbench.errors import InputError, WorkbenchError
from workbench.files.toml import validate_record
from workbench.model.desired_curve import (
    DesiredCurve,
    SpeedLevels,
    TimedCruise,
    davis_cruise_speed,
    from_acceleration,
    speed_levels,
    start_cruise_stop,
)
from workbench.trains.scenario import load_scenario

CURVES = {
    **{name_of(path): load_scenario(path).desired_curve() for path in BENCHMARKS},
    "levels": speed_levels((0.0, 60.0, 130.0, 200.0), (12.0, 20.0, 8.0, 0.0), 0.4, 8.0, 260.0),
    "levels from a late start to the very end": speed_levels((5.0, 50.0), (10.0, 0.0), 0.5, 10.0, 80.0),
    "short": start_cruise_stop(900.0, 15.0, 0.4, 0.5, 6.0),
    "peak below both rates": start_cruise_stop(200.0, 4.0, 0.9, 0.8, 20.0),
    "cruise of a moment": start_cruise_stop(1200.0 + 1e-6, 20.0, 0.5, 0.5, 20.0),
}


def _smootherstep_speed_change(t, rate, ramp, change):
    """Acceleration of a speed change written independently: rate times 3 s^2 - 2 s^3 on both ramps."""
    duration = change / rate + ramp
    rising = np.clip(t / ramp, 0, 1)
    falling = np.clip((duration - t) / ramp, 0, 1)
    step = np.minimum(rising, falling)
    return rate * step**2 * (3 - 2 * step)


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES.keys())
def test_speed_and_acceleration_are_the_derivatives_of_position_across_every_break(curve):
    h = 1e-3
    breaks = curve.breaks_s[1:]
    around = [breaks - h / 3, breaks, breaks + h / 3]
    times = np.sort(np.concatenate([*around, np.linspace(1, breaks[-1] + 2, 500)]))
    position = [curve.at(times + k * h)[0] for k in (-1, 0, 1)]
    speed = [curve.at(times + k * h)[1] for k in (-1, 0, 1)]
    scale = np.abs(position[1]).max()
    # Central differences: h^2/6 times the jerk, plus the roundoff of a difference.
    assert (position[2] - position[0]) / (2 * h) == pytest.approx(speed[1], abs=1e-6 + 1e-15 * scale / h)
    assert (speed[2] - speed[0]) / (2 * h) == pytest.approx(curve.at(times)[2], abs=1e-3)


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES.keys())
def test_acceleration_is_lipschitz_so_that_it_cannot_jump(curve):
    rows = curve.coefficients
    steepest = max(np.abs(poly.polyval(np.linspace(0, d, 50), poly.polyder(row, 3))).max()
                   for d, row in zip(np.diff(curve.breaks_s), rows, strict=True))
    times = np.linspace(0.0, curve.trip_time_s + 1.0, 200_001)
    rise = np.abs(np.diff(curve.at(times)[2])) / (times[1] - times[0])
    assert rise.max() <= steepest * 1.01 + 1e-9


@pytest.mark.parametrize("path", BENCHMARKS, ids=name_of)
def test_a_shipped_curve_covers_its_line_from_standstill_to_standstill(path):
    scenario = load_scenario(path)
    curve = scenario.desired_curve()
    position, speed, acceleration = curve.at(np.array([0.0, curve.trip_time_s, curve.trip_time_s + 100.0]))
    assert position[0] == 0.0
    assert position[1:] == pytest.approx(scenario.track.length_m, abs=1e-8)
    assert np.all(speed == 0.0)
    assert np.all(acceleration == 0.0)


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES.keys())
def test_length_is_the_integral_of_speed_and_the_end_speed_is_zero(curve):
    walked = sum(quad(lambda t: float(curve.at(np.array([t]))[1][0]), a, b, epsabs=1e-10)[0]
                 for a, b in zip(curve.breaks_s, curve.breaks_s[1:], strict=False))
    assert curve.length_m == pytest.approx(walked, rel=1e-11)
    last = np.diff(curve.breaks_s)[-1]
    assert poly.polyval(last, poly.polyder(curve.coefficients[-1])) == pytest.approx(0.0, abs=1e-11)


def test_yang2021_runs_at_the_speed_where_its_resistance_is_the_printed_command():
    curve = load_scenario(YANG).desired_curve()
    times = np.linspace(0, curve.trip_time_s, 20_001)
    fastest = curve.at(times)[1].max()
    assert 0.3 + 4e-3 * fastest + 1.6e-4 * fastest**2 == pytest.approx(0.6, rel=1e-12)
    # Section 6.1: at most 0.48 m/s^2 at the start, of which the train keeps what a* = 0.3 leaves it.
    assert curve.at(times)[2].max() == pytest.approx(0.48 - 0.3, rel=1e-9)
    assert curve.at(times)[2].min() == pytest.approx(-0.5, rel=1e-9)


@given(st.floats(1e-3, 2.0), st.floats(0, 1.0), st.floats(0, 0.1), st.floats(1e-5, 0.1))
def test_cruise_speed_solves_the_davis_equation(excess, a, b, c):
    try:
        speed = davis_cruise_speed(a + excess, a, b, c)
    except WorkbenchError as refused:
        root = max(np.roots([c, b, -excess]).real)
        assert not 0.1 * 1.001 < root < 150 * 0.999
        assert "cruise speed" in str(refused)
    else:
        assert a + b * speed + c * speed**2 == pytest.approx(a + excess, rel=1e-9)


def test_cruise_speed_of_a_resistance_linear_in_speed():
    assert davis_cruise_speed(0.5, 0.1, 0.02, 0.0) == pytest.approx(20.0, rel=1e-14)


@pytest.mark.parametrize(("values", "words"), [
    ((0.3, 0.3, 4e-3, 1.6e-4), "does not exceed the resistance at standstill"),
    ((0.6, 0.3, 0.0, 0.0), "does not depend on speed"),
    ((0.6, 0.3, 0.0, 1e-12), "outside 0.1 to 150"),
    ((0.6, 0.3, 0.0, 1e-320), "outside 0.1 to 150"),
])
def test_a_cruise_speed_that_no_train_runs_is_refused_with_the_reason(values, words):
    with pytest.raises(WorkbenchError, match=words):
        davis_cruise_speed(*values)


def test_a_full_speed_change_holds_its_rate_between_smooth_ramps():
    curve = start_cruise_stop(900.0, 15.0, 0.4, 0.5, 6.0)
    times = np.linspace(0.0, 15.0 / 0.4 + 6.0, 4001)
    assert curve.at(times)[2] == pytest.approx(_smootherstep_speed_change(times, 0.4, 6.0, 15.0), abs=1e-12)


def test_a_small_speed_change_keeps_the_slope_and_lowers_the_peak():
    # 4 m/s at 0.9 m/s^2 with ramps of 20 s: the ramps alone would gain 18 m/s, so the rate is not reached.
    curve = start_cruise_stop(200.0, 4.0, 0.9, 0.8, 20.0)
    times = np.linspace(0.0, curve.trip_time_s, 40_001)
    _, speed, acceleration = curve.at(times)
    peak = np.sqrt(4.0 * 0.9 / 20.0)  # peak^2 = change x slope of the ramps, rate / ramp time
    assert acceleration.max() == pytest.approx(peak, rel=1e-6)
    assert acceleration.max() < 0.9
    assert speed.max() == pytest.approx(4.0, rel=1e-12)


@given(st.floats(0.5, 60.0), st.floats(0.05, 1.5), st.floats(0.05, 1.5), st.floats(0.1, 30.0),
       st.floats(1e-3, 3.0))
def test_shape_of_any_line_long_enough(cruise, up, down, ramp, spare):
    def needed(rate):  # mean speed times the duration of two ramps and, where the rate is reached, the hold
        reached = cruise / rate >= ramp
        return cruise / 2 * (cruise / rate + ramp if reached else 2 * np.sqrt(cruise * ramp / rate))

    shortest = needed(up) + needed(down)
    curve = start_cruise_stop(shortest * (1 + spare), cruise, up, down, ramp)
    assert curve.length_m == pytest.approx(shortest * (1 + spare), rel=1e-10)
    times = np.linspace(0.0, curve.trip_time_s, 2001)
    _, speed, acceleration = curve.at(times)
    assert speed.min() >= -1e-9
    assert speed.max() <= cruise * (1 + 1e-12)
    assert acceleration.max() <= up * (1 + 1e-9)
    assert acceleration.min() >= -down * (1 + 1e-9)
    # One sign of acceleration up to the top speed, the other one after it.
    top = int(speed.argmax())
    assert acceleration[:top].min(initial=0.0) >= -1e-9
    assert acceleration[top + 1 :].max(initial=0.0) <= 1e-9
    with pytest.raises(WorkbenchError, match="cannot be reached"):
        start_cruise_stop(shortest * 0.999, cruise, up, down, ramp)


@pytest.mark.parametrize(("pieces", "words"), [
    ([(1.0, [1.0]), (1.0, [-1.0])], "derivative 2 jumps by 2"),
    ([(1.0, [0.0, 1.0])], "derivative 1 jumps by 0.5"),
    ([(1.0, [0.0, 6.0, -6.0])], "derivative 1 jumps by 1"),
    ([(0.0, [0.0])], "do not increase"),
    ([(1.0, [float("nan")])], "not finite"),
])
def test_a_curve_that_is_not_smooth_to_its_end_is_refused(pieces, words):
    with pytest.raises(WorkbenchError, match=words):
        from_acceleration(pieces)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_jump_in_any_derivative_is_found(order):
    # A second of standstill, then a polynomial that begins with a jump in one derivative and ends at rest.
    jumping = np.zeros(6)
    jumping[order] = 1e-3
    rest = np.array([[1, 1, 1], [3, 4, 5], [6, 12, 20]])  # value, slope, curvature at 1 of t^3, t^4, t^5
    at_one = [poly.polyval(1.0, poly.polyder(jumping, k)) for k in range(3)]
    jumping[3:] = np.linalg.solve(rest, -np.array(at_one))
    with pytest.raises(WorkbenchError, match=f"derivative {order} jumps by 0.00{1 + (order == 2)}"):
        DesiredCurve(np.array([0.0, 1.0, 2.0]), np.array([np.zeros(6), jumping]))


LEVELS = {"starts_s": [0.0, 60.0, 130.0, 200.0], "speeds_mps": [12.0, 20.0, 8.0, 0.0], "rate_mps2": 0.4, "ramp_s": 8.0,
          "end_s": 260.0}


def _levels(**changes):
    values = LEVELS | changes
    return validate_record(values | {"source": dict.fromkeys(values, "assumed: a test")}, SpeedLevels, "levels")


def test_levels_are_held_between_changes_that_begin_at_their_times():
    curve = _levels().curve()
    # A change of v takes v / rate + ramp.
    for start, end, speed in ((38.0, 60.0, 12.0), (88.0, 130.0, 20.0), (168.0, 200.0, 8.0), (228.0, 270.0, 0.0)):
        _, speeds, accelerations = curve.at(np.linspace(start, end, 50))
        assert speeds == pytest.approx(speed, abs=1e-9) and accelerations == pytest.approx(0.0, abs=1e-9)
    assert np.all(curve.at(np.linspace(60.5, 87.5, 50))[2] > 0)
    assert np.all(curve.at(np.linspace(130.5, 167.5, 50))[2] < 0)
    assert np.abs(curve.at(np.linspace(0, 260, 5000))[2]).max() == pytest.approx(0.4, rel=1e-6)
    assert curve.trip_time_s == 260.0
    assert quad(lambda t: curve.at(np.array(t))[1], 0, 260, limit=400, points=curve.breaks_s[1:-1])[0] == pytest.approx(
        curve.length_m, rel=1e-9)


@pytest.mark.parametrize(("changes", "message"), [
    ({"starts_s": [0.0, 60.0, 130.0]}, "starts_s has 3 values and speeds_mps 4"),
    ({"starts_s": [0.0, 130.0, 60.0, 200.0]}, "starts_s does not increase"),
    ({"starts_s": [0.0, 60.0, 130.0, 300.0]}, "starts_s does not increase up to end_s"),
    ({"speeds_mps": [12.0, 12.0, 8.0, 0.0]}, "the same speed twice"),
    ({"speeds_mps": [12.0, 20.0, 8.0, 4.0]}, "it ends at 4 m/s"),
    ({"starts_s": [0.0, 30.0, 130.0, 200.0]}, "the change to 12 m/s that begins at 0 s takes until 38 s, beyond 30 s"),
    ({"end_s": 210.0}, "the change to 0 m/s that begins at 200 s takes until 228 s, beyond 210 s"),
    ({"speeds_mps": [12.0, 200.0, 8.0, 0.0]}, r"speeds_mps\[1\]"),
    ({"rate_mps2": 0.0}, "rate_mps2"),
])
def test_levels_that_give_no_curve_say_why(changes, message):
    with pytest.raises(InputError, match=message):
        _levels(**changes)


def test_a_trip_of_a_given_time_takes_it_and_one_too_short_says_so():
    values = {"cruise_mps": 30.0, "acceleration_mps2": 0.5, "braking_mps2": 1.0, "ramp_s": 2.0}
    curve = TimedCruise(**values, trip_time_s=200.0).curve()
    assert curve.trip_time_s == pytest.approx(200.0)
    # Changes of speed that are symmetric in time: 62 s up, 32 s down, each at half the cruise speed in the mean.
    assert curve.length_m == pytest.approx(30.0 * (200.0 - 47.0))
    with pytest.raises(ValueError, match="or allow more trip_time_s"):
        TimedCruise(**values, trip_time_s=90.0)

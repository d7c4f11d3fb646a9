"""Margins of a plant's loops under a law: against theory, and against the transfer function composed by hand."""

import math

import control
import numpy as np
import pytest
import sympy as sp

import workbench as wb

x, v, u, f = sp.symbols("x v u f", real=True)
k, d = sp.symbols("k d", positive=True)
MASS = wb.Plant("mass", (x, v), (v, u), (u,))
R = wb.Reference("r")
PD = wb.Law("pd", {u: R.second_rate - k * (x - R.value) - d * (v - R.rate)}, parameters=(k, d), references=(R,))
GAINS = {k: 4, d: 4}


def test_margins_are_those_of_theory():
    """L = (4 s + 4) / s^2 has gain one at w^2 = 8 + sqrt(80)."""
    found = wb.margins(MASS, PD, law_parameters=GAINS)
    (row,) = found.rows
    crossover = math.sqrt(8 + math.sqrt(80))
    assert (row["least_gain"], row["most_gain"]) == (0, math.inf)
    assert row["phase_deg"] == pytest.approx(math.degrees(math.atan(crossover)))
    assert row["delay_s"] == pytest.approx(math.atan(crossover) / crossover)
    assert row["largest_pole"] == pytest.approx(-2, abs=1e-6)
    assert "<td" in found._repr_html_() and "phase_deg" in str(found)


def test_an_observer_and_a_bent_plant_are_part_of_the_loop():
    """Only the position is measured: the loop is plant times observer and feedback, about a point at which it pulls."""
    bent = wb.Plant("bent", (x, v), (v, u - 2 * sp.sin(x)), (u,), outputs=(x,))
    xh, vh = sp.symbols("xh vh", real=True)
    command = 2 * sp.sin(x) - 4 * xh - 4 * vh
    law = wb.Law("seen", {u: command}, (wb.LawState(xh, rate=vh + 20 * (x - xh)),
                                        wb.LawState(vh, rate=-4 * xh - 4 * vh + 150 * (x - xh))))
    at = {"x": 0.6, "xh": 0.6}
    slope = 2 * math.cos(0.6)
    feedback = control.ss([[-20, 1], [-154, -4]], [[20], [150]], [[-4, -4]], [[slope]])
    expected = -feedback * control.ss([[0, 1], [-slope, 0]], [[0], [1]], [[1, 0]], [[0]])
    found = wb.margins(bent, law, at=at).loops["u"]
    omega = np.array([0.1, 1.0, 7.0, 40.0])
    assert found(1j * omega) == pytest.approx(expected(1j * omega), rel=1e-9)


def test_a_point_at_which_the_plant_does_not_rest_is_told():
    """The loop about such a point is that of an instant: margins of it were told as if a run could stay there."""
    bent = wb.Plant("bent", (x, v), (v, u - 2 * sp.sin(x)), (u,))
    law = wb.Law("pd", {u: -4 * (x - R.value) - 4 * v}, references=(R,))
    lost, held = (wb.margins(bent, law, at={"x": 0.6, "r": goal}) for goal in (0.0, 0.6 + math.sin(0.6) / 2))
    assert lost.moving == {"v": pytest.approx(-4 * 0.6 - 2 * math.sin(0.6))}
    assert "at this point the plant does not rest, it moves v by -3.529 per s: give a point of rest" in str(lost)
    assert held.moving == {} and "rest" not in str(held) and held.rows == lost.rows


def test_what_a_law_believes_is_not_what_is_true():
    m = sp.Symbol("m", positive=True)
    heavy = wb.Plant("heavy", (x, v), (v, u / m), (u,), parameters=(wb.Parameter(m, 2.0),))
    law = wb.Law("pd", {u: -m * (4 * x + 4 * v)}, parameters=(m,))
    known, halved = (wb.margins(heavy, law, law_parameters=given).rows[0]["phase_deg"] for given in ({}, {m: 1.0}))
    assert known == pytest.approx(wb.margins(MASS, PD, law_parameters=GAINS).rows[0]["phase_deg"])
    crossover = math.sqrt(2 + math.sqrt(8))  # of (2 s + 2) / s^2
    assert halved == pytest.approx(math.degrees(math.atan(crossover)))


def test_an_unstable_loop_has_no_margins_and_each_input_a_loop():
    two = wb.Plant("two", (x, v), (x + u, f), (u, f))
    rows = wb.margins(two, wb.Law("half", {u: -4 * x, f: v})).rows
    assert [row["input"] for row in rows] == ["u", "f"] and all(row["phase_deg"] is None for row in rows)
    held = wb.margins(two, wb.Law("both", {u: -4 * x, f: -v})).rows
    assert held[0]["least_gain"] == pytest.approx(0.25) and held[1]["phase_deg"] == pytest.approx(90)


def test_a_phase_that_only_tends_to_half_a_turn_limits_no_gain():
    """A motor under its speed and angle: rounding finds a crossing at a gain of 1e15."""
    i = sp.Symbol("i", real=True)
    motor = wb.Plant("motor", (x, v, i), (v, 30 * i - 5 * v, 200 * u - 200 * i - 60 * v), (u,))
    (row,) = wb.margins(motor, wb.Law("p", {u: -30 * x - 2 * v})).rows
    assert (row["least_gain"], row["most_gain"]) == (0, math.inf) and 0 < row["phase_deg"] < 180


def test_the_plot_has_gain_and_phase():
    gain, phase = wb.margins(MASS, PD, law_parameters=GAINS).plot().axes
    omega, size = gain.lines[0].get_data()
    assert size == pytest.approx(4 * np.sqrt(1 + omega**2) / omega**2)
    assert phase.lines[0].get_ydata() == pytest.approx(np.degrees(np.arctan(omega)) - 180)


@pytest.mark.parametrize(("plant", "law", "given", "words"), [
    (MASS, PD, {"at": {"y": 1.0}, "law_parameters": GAINS}, "at: 'y' is no state and no reference of plant 'mass'"),
    (MASS, PD, {}, "parameter 'k' of law 'pd' has no value"),
    (MASS, wb.Law("on-off", {u: -sp.sign(x)}), {}, "has a kink at that point"),
    (wb.Plant("steps", (x,), updates=(x + u,), step_s=1.0, inputs=(u,)), wb.Law("l", {u: -x}), {}, "moves in steps")])
def test_what_has_no_loop_is_one_line(plant, law, given, words):
    with pytest.raises(ValueError, match=words) as trouble:
        wb.margins(plant, law, **given)
    assert "\n" not in str(trouble.value)

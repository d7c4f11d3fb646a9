"""Controllers of other libraries drive a plant as the same law stated here does, and results become their tables."""

import functools
import sys

import casadi as ca
import control
import numpy as np
import pytest
import sympy as sp

import workbench as wb
from workbench.api.frames import dataset, html_table
from workbench.errors import WorkbenchError

x, v, u = sp.symbols("x v u", real=True)
r = wb.Reference("r")
MASS = wb.Plant("mass", (x, v), (v, u), inputs=(u,), units={x: "m"})
PD = wb.Law("pd", {u: -4 * (x - r.value) - 3 * v}, references=(r,))
SETTING = wb.Setting(MASS, 0.5, 0.01, references={"r": wb.Sine(amplitude=1, period_s=2)}, tracks={"x": "r"})


def casadi_pd():
    t, y, desired = ca.SX.sym("t"), ca.SX.sym("y", 2), ca.SX.sym("r")
    return ca.Function("casadi_pd", [t, y, desired], [-4 * (y[0] - desired) - 3 * y[1]])


def control_pd():
    return control.ss([], [], [], [[4, -4, -3]], True, inputs=["r", "x", "v"], outputs=["u"], name="control_pd")


def plain_pd(t, y, desired):
    return -4 * (y[0] - desired[0]) - 3 * y[1]


def test_guests_are_told_of_a_step_at_the_sample_at_which_a_law_is():
    """Three periods of 0.3 s are less than 0.9 s in floating point, by which the step came a whole period later."""
    assert 3 * 0.3 < 0.9
    setting = wb.Setting(MASS, 1.5, 0.01, references={"r": wb.Step(after=1.0, at_s=0.9)}, tracks={"x": "r"})
    told = wb.compare(setting, [wb.entrant(one, 0.3) for one in (PD, casadi_pd(), control_pd(), plain_pd)])
    law, *guests = (run["u_wanted"] for run in told)
    for guest in guests:
        np.testing.assert_allclose(guest, law, atol=1e-12)
    assert np.flatnonzero(law)[0] == 90


@pytest.fixture(scope="module")
def compared():
    return wb.compare(SETTING, [wb.entrant(one, 0.01) for one in (PD, casadi_pd(), control_pd(), plain_pd)])


def test_guests_run_as_the_law_does(compared):
    assert [run.name for run in compared] == ["pd", "casadi_pd", "control_pd", "plain_pd"]
    for guest in ("casadi_pd", "control_pd", "plain_pd"):
        assert compared[guest]["x"] == pytest.approx(compared["pd"]["x"], abs=1e-12)


@pytest.mark.parametrize(("command", "words"), [
    (lambda t, y, r: [1.0, 2.0], "gives 2 numbers at t = 0 s: give one for each input, u"),
    (lambda t, y, r: "a", "fails at t = 0 s .ValueError"),
    (lambda t, y, r: 1 / 0, r"controller 'lambda' fails at t = 0 s \(ZeroDivisionError: division by zero\)")])
def test_what_a_controller_does_wrong_is_one_line(command, words):
    """More numbers than inputs were once written beyond an array's end."""
    with pytest.raises(ValueError, match=words):
        wb.compare(SETTING, [wb.entrant(command, 0.01)])


def test_an_object_that_is_called_drives_a_plant_and_is_named_by_its_type(compared):
    class Own:
        def __call__(self, t, y, desired):
            return plain_pd(t, y, desired)

    for one, name in ((Own(), "Own"), (functools.partial(plain_pd), "partial")):
        (run,) = wb.compare(SETTING, [wb.entrant(one, 0.01)])
        assert run.name == name
        np.testing.assert_array_equal(run["x"], compared["plain_pd"]["x"])
    with pytest.raises(ValueError, match="a type is no law and builds no controller"):
        wb.entrant(Own, 0.01)


def test_a_state_of_a_guest_moves_once_a_sample():
    """An integrator in discrete time: after k samples of one its output is k times its step."""
    matrices = [[1]], [[0.5, 0]], [[1]], [[0, 0]]
    counter = control.ss(*matrices, 0.01, inputs=["r", "x"], outputs=["u"], name="counter")
    setting = SETTING.varied(references={"r": wb.Constant(value=1.0)})
    made = wb.entrant(counter, 0.01).build(setting, 0.01)
    assert [float(made.command(0.0, np.zeros(2))[0]) for _ in range(4)] == [0.0, 0.5, 1.0, 1.5]


@pytest.mark.parametrize(("guest", "words"), [
    (lambda: ca.Function("f", [ca.SX.sym("t")], [ca.SX(1)]), "must take time, 2 outputs and 1 references"),
    (lambda: control.ss([], [], [], [[1]], True, inputs=["z"], outputs=["u"], name="s"), "'z' is no output"),
    (lambda: control.ss([], [], [], [[1]], True, inputs=["x"], outputs=["w"], name="s"), "must be the plant's inputs"),
    (lambda: control.ss([], [], [], [[1]], 0.1, inputs=["x"], outputs=["u"], name="s"), "sample it anew")])
def test_a_guest_that_does_not_fit_is_refused_in_one_line(guest, words):
    with pytest.raises(ValueError, match=words):
        wb.compare(SETTING, [wb.entrant(guest(), 0.01)])


def test_results_show_themselves_in_a_notebook(compared):
    shown = compared._repr_html_()
    assert shown.count("<tr>") == 1 + 4 and "casadi_pd" in shown
    assert compared["pd"]._repr_html_().count("<tr>") == 2
    assert html_table([{"a": "<b>", "c": None}]).endswith("<tr><td>&lt;b&gt;</td><td></td></tr></tbody></table>")


def test_a_run_is_a_dataset_with_units(compared, monkeypatch):
    class Recorded:
        def __init__(self, variables, coordinates, about):
            self.variables, self.coordinates, self.about = variables, coordinates, about

    monkeypatch.setitem(sys.modules, "xarray", type(sys)("xarray"))
    sys.modules["xarray"].Dataset = Recorded
    found = compared["pd"].to_xarray()
    assert found.variables["x"][2] == {"units": "m"} and found.coordinates["t_s"][2] == {"units": "s"}
    assert found.about["controller"] == "pd" and "t_s" not in found.variables


def test_without_xarray_it_is_said_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(WorkbenchError, match="pip install xarray"):
        dataset({"t_s": np.zeros(1)}, {}, {})


@pytest.mark.parametrize(("ask", "words"), [
    (lambda: wb.simulate(MASS, PD, period_s=0.01, duration_s=0.1, durations=3), "did you mean 'duration_s'"),
    (lambda: wb.simulate(PD, MASS, period_s=0.01, duration_s=0.1), "the first argument is a StateLaw"),
    (lambda: wb.simulate(MASS, MASS, period_s=0.01, duration_s=0.1), "a Plant is no law"),
    (lambda: wb.compare(SETTING, []), "entrants is empty"),
    (lambda: wb.compare(SETTING, [PD]), r"is no Entrant: write wb.entrant\(law, period_s, parameters\)"),
    (lambda: wb.simulate(wb.Plant("p", (x,), (-x,)), wb.PlantMpc(5, {"x": 1}), period_s=0.01, duration_s=0.1),
     "nothing to command: plant 'p' has no input")])
def test_what_a_script_gets_wrong_is_one_line(ask, words):
    with pytest.raises(ValueError, match=words) as caught:
        ask()
    assert "\n" not in str(caught.value)


def test_a_plant_without_inputs_or_law_moves_by_itself_and_a_number_is_a_reference(compared):
    free = wb.simulate(wb.Plant("decay", (x,), (-2 * x,)), None, period_s=0.1, duration_s=1.0, initial={x: 1.0})
    assert free["x"][-1] == pytest.approx(np.exp(-2.0), abs=1e-9)
    one = wb.compare(SETTING.varied(references={r: 1}), [wb.entrant(PD, 0.01)])["pd"]
    assert one["r"].tolist() == [1.0] * len(one["r"]) and one["x"][-1] > 0.1
    assert str(one).startswith("pd on mass, to 0.5 s\n  x_error_rms = ") and repr(compared).count("\n") < 30


@pytest.mark.parametrize("function", [sp.sec, sp.csc, sp.cot, sp.sech, sp.csch, sp.coth, sp.asinh, sp.acosh, sp.atanh,
                                      sp.erf, sp.erfc, sp.frac, sp.Heaviside, lambda a: sp.Mod(a, sp.Rational(3, 4)),
                                      lambda a: sp.Mod(a, -sp.Rational(3, 4))])
def test_casadi_is_given_what_runs_are_compiled_of(function):
    """A plant of these could be run and not be given to casadi, nor to MPC."""
    at = 1.3 if function is sp.acosh else -0.4 if function is not sp.atanh else 0.6
    plant = wb.Plant("bent", (x,), (function(x),), (u,))
    want = float(sp.N(function(sp.Float(at, 30))))
    assert float(plant.to_casadi()(0, at, 0, [])) == pytest.approx(want, rel=1e-14)
    assert plant.rates_at([at])[0] == pytest.approx(want, rel=1e-14)

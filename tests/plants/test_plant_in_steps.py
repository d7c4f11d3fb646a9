"""A plant in discrete time: held against plain Python, its map against its runs, its models against each other."""

import numpy as np
import pytest
import sympy as sp

import workbench as wb
from workbench.errors import InputError
from workbench.gains.linearised import linearised
from workbench.paper.new_paper import write_new_paper

stock, first, second, order, demand = sp.symbols("x p_1 p_2 o demand", real=True)
level = sp.Symbol("S", positive=True)
STORE = wb.Plant("store", (stock, first, second), updates=(stock + second - demand, order, first), step_s=0.5,
                 inputs=(order,), disturbances=(demand,), input_limits={order: (0, 50)})
UP_TO = wb.Law("up to", {order: level - stock - first - second}, parameters=[level])
COST = wb.Metric("cost", "integral", sp.Max(stock, 0) + 5 * sp.Max(-stock, 0))
SETTING = wb.Setting(STORE, 20, disturbances={"demand": wb.Sine(offset=8, amplitude=4, period_s=6)}, metrics=(COST,),
                     references={"r": 0}, tracks={"x": "r"})


@pytest.fixture(scope="module")
def refilled():
    return wb.compare(SETTING, [wb.entrant(UP_TO, 0.5, {level: 30})])["up to"]


def test_a_run_is_the_same_in_plain_python(refilled):
    x, rows, cost = np.zeros(3), [np.zeros(3)], 0.0
    for k in range(40):
        cost += 0.5 * (max(x[0], 0) + 5 * max(-x[0], 0))
        sold = 8 + 4 * np.sin(2 * np.pi * 0.5 * k / 6)
        x = np.array([x[0] + x[2] - sold, min(50, max(0, 30 - x.sum())), x[1]])
        rows.append(x)
    run = refilled
    assert np.column_stack([run["x"], run["p_1"], run["p_2"]]) == pytest.approx(np.array(rows), abs=1e-11)
    assert run.metrics["cost"] == pytest.approx(cost)
    assert run.metrics["x_error_rms"] == pytest.approx(np.sqrt(np.mean(np.array(rows)[:-1, 0] ** 2)))


def test_mpc_plans_with_the_updates():
    """Once the push is known a stock with a constant demand stays where it shall be, and what is ordered is sold."""
    mpc = wb.PlantMpc(8, {"x": 1.0}, change_weights={"o": 0.01}, disturbance_gain=0.5)
    run = wb.compare(SETTING.varied(disturbances={"demand": 8}, duration_s=30), [wb.entrant(mpc, 0.5)])["mpc"]
    assert run.failed is None and run.found.fallbacks == 0
    assert run["x"][-1] == pytest.approx(0.0, abs=1e-2) and run["o"][-1] == pytest.approx(8.0, abs=1e-2)


def test_the_loop_as_a_map_is_what_the_run_does(refilled):
    loop = wb.next_values(STORE, UP_TO)
    assert loop == {stock: stock + second - demand, first: level - stock - first - second, second: first}
    change = wb.Lyapunov("V", (stock + first + second - level) ** 2, UP_TO).rate(STORE)
    run = refilled
    V = (run["x"] + run["p_1"] + run["p_2"] - 30) ** 2
    told = sp.lambdify((stock, first, second, demand, level), change)
    derived = told(run["x"], run["p_1"], run["p_2"], run["demand"], 30)
    asked = run["o"] == run["o_wanted"]
    assert asked[:-1].sum() > 30 and np.diff(V)[asked[:-1]] == pytest.approx(derived[:-1][asked[:-1]], abs=1e-9)
    r = wb.Reference("r")
    with pytest.raises(ValueError, match="uses reference 'r', whose next value is not known"):
        wb.Lyapunov("V", (stock - r.value) ** 2, wb.Law("l", {order: r.value}, references=(r,))).rate(STORE)


def test_linear_casadi_and_control_models_move_as_it_does():
    at, u, d = [1.0, 2.0, 3.0], [4.0], [5.0]
    assert STORE.rates_at(at, u, disturbances=d).tolist() == [-1.0, 4.0, 2.0]
    assert np.array(STORE.to_casadi()(0, at, u, d)).ravel().tolist() == [-1.0, 4.0, 2.0]
    assert STORE.to_control().dynamics(0.0, at, [*u, *d]).tolist() == [-1.0, 4.0, 2.0] and STORE.to_control().dt == 0.5
    linear = STORE.linearise()
    assert linear.dt == 0.5 and linear.A.tolist() == [[1, 0, 1], [0, 0, 0], [0, 1, 0]]


@pytest.mark.parametrize(("ask", "words"), [
    (lambda: wb.closed_loop(STORE, UP_TO), "moves in steps"), (lambda: SETTING.varied(step_s=0.1), "steps of 0.5 s"),
    (lambda: SETTING.varied(integrator="radau"), "moves in steps"),
    (lambda: wb.Plant("p", (stock,), updates=(stock,)), "step_s = None: give the seconds"),
    (lambda: wb.Plant("p", (stock,), (0,), updates=(stock,), step_s=1), "both rates and updates"),
    (lambda: wb.Plant("p", (stock,)), "no rates"), (lambda: wb.Plant("p", (stock,), (0,), step_s=1), "is for updates"),
    (lambda: wb.Plant("p", (stock,), updates=(0,), step_s=1, events=(wb.Event("e", stock, {stock: 0}),)), "events are"),
    (lambda: wb.next_values(wb.Plant("p", (stock,), (0,)), wb.Law("none", {})), "has rates, not updates"),
    (lambda: linearised(STORE), "plant in discrete time")])
def test_what_does_not_fit_steps_is_one_line(ask, words):
    with pytest.raises((ValueError, InputError), match=words) as caught:
        ask()
    assert "\n" not in str(caught.value)


PLANT = """import sympy as sp
from workbench.systems.plant import Plant
x, u = sp.symbols("x u", real=True)
plant = Plant("store2026.store", (x,), updates=(x + u,), step_s=1.0, inputs=(u,))
"""
LAWS = """import sympy as sp
from workbench.systems.law import StateLaw
from workbench.systems.lyapunov import Lyapunov
from .plant import plant, u, x
k = sp.Symbol("k", positive=True)
refill = StateLaw("store2026.refill", {u: -k * x}, parameters=(k,))
lyapunov = Lyapunov("V", x**2, SOME)
"""
STUDY = """version = 1
kind = "plant"
name = "store2026"
title = "A store"
paper = "store2026"
citation = "A. Author"
duration_s = 20.0
initial = { x = 3.0 }
[controllers.refill]
law = "refill"
period_s = 1.0
parameters = { k = 0.5 }
"""


@pytest.mark.parametrize(("law", "wrong"), [
    ("refill", []), ("StateLaw(refill.id, {u: -2 * k * x}, parameters=(k,))",
                    ["V changes along the run of refill as derived"])])
def test_a_folder_is_checked_step_by_step(law, wrong, tmp_path):
    folder = write_new_paper("store2026", tmp_path, "plant")
    (folder / "plant.py").write_text(PLANT)
    (folder / "study.toml").write_text(STUDY)
    (folder / "laws.py").write_text(LAWS.replace("SOME", law))
    assert [one.what for one in wb.check_paper(folder).checks if not one.holds] == wrong

"""What newcomers get wrong is one clear line; what has no number is told as none."""

import math
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

import workbench as wb
from workbench.errors import InputError
from workbench.paper.new_paper import write_new_paper

x, v, u = sp.symbols("x v u", real=True)
r = wb.Reference("r")
LAW = wb.Law("pd", {u: -(x - r.value) - v}, references=(r,))


def _plant(push: sp.Expr = u, **more: object) -> wb.Plant:
    return wb.Plant("m", (x, v), (v, push), (u,), **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(("made", "told"), [
    (lambda: _plant(events=(wb.Event("b", x, {"v": -v}),)), "event 'b': reset: 'v' is no symbol"),
    (lambda: wb.Event("b", x, [(v, -v)]), "no table"),  # type: ignore[arg-type]
    (lambda: _plant(sp.Piecewise((u, x > 0))), "end it with"),
    (lambda: wb.Plant("m", (x, v), {x: v}, (u,)), "rates: nothing is given for 'v'"),
    (lambda: wb.Plant("m", (x,), {x: u, v: u}, (u,)), "rates: 'v' is none of x"),
    (lambda: wb.Plant("m", {x, v}, (v, u), (u,)), "states is a set, .* their order"),  # type: ignore[arg-type]
    (lambda: _plant(parameters={u: 1.0}), "parameters is a table.* write .Parameter"),
    (lambda: wb.Law("l", {u: -u}, parameters={v: 1.0}), "parameters is a table"),  # type: ignore[arg-type]
    (lambda: _plant().rates_at([1, 2, 3]), "give a list of 2 numbers, x, v"),
    (lambda: _plant().rates_at({"x": 1, "v": 2}), "give a list of 2"),  # type: ignore[arg-type]
    (lambda: _plant().rates_at("xv"), "give a list of 2 numbers"),  # type: ignore[arg-type]
    (lambda: wb.closed_loop(LAW, _plant()), "give the Plant, then the law"),  # type: ignore[arg-type]
    (lambda: wb.margins(LAW, _plant()), "give the Plant, then the law"),  # type: ignore[arg-type]
    (lambda: wb.PlantMpc(10.0, {"x": 1.0}), "whole numbers"),  # type: ignore[arg-type]
    (lambda: wb.Setting(_plant(), "1"), "duration_s = '1'"),  # type: ignore[arg-type]
    (lambda: wb.Sine(amplitude=1, period_s=0), "^Sine: period_s: input should be greater than 0, not 0"),
    (lambda: wb.Step(before=1), "^Step: after: is missing"),
    (lambda: wb.Sine(1.0, 2.0), "^Sine takes its values by name: write Sine"),  # type: ignore[misc]
    (lambda: wb.Setting(_plant(), 1.0, initial={"x": x / 4}), "initial.x = x/4: give a finite number"),
    (lambda: wb.Setting(_plant(), 1.0, delay_s={"u": 1e300}), "delay_s.u = 1e[+]?300: nothing arrives within 1 s"),
    (lambda: wb.Setting(_plant(), 1.0, late_s={"x": 2.0}), "late_s.x = 2.0: nothing arrives within 1 s"),
    (lambda: wb.Setting(_plant(), 1.0, references={"r": wb.Spline(file="none.csv", column="r")}), "no such file")])
def test_a_mistake_is_one_line(made: object, told: str) -> None:
    with pytest.raises(Exception, match=told) as trouble:
        made()  # type: ignore[operator]
    assert "\n" not in str(trouble.value)


def test_rates_may_be_a_table() -> None:
    """What is easily written as commands of a law are must not become the names of its keys."""
    assert wb.Plant("m", (x, v), {v: u, "x": v}, (u,)) == _plant()


def test_what_has_no_number_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A logarithm beyond its domain, at the end or for a part of the run alone; cases that leave nothing open; a
    spline's file."""
    (tmp_path / "r.csv").write_text("t_s,r\n0,1\n1,1\n2,1\n")
    monkeypatch.chdir(tmp_path)
    cases = sp.Piecewise((u, x > 0), (u, x <= 0))
    found = wb.simulate(
        _plant(cases), LAW, period_s=0.01, duration_s=2.0, tracks={"x": "r"},
        references={"r": wb.Spline(file="r.csv", column="r")},
        metrics=(wb.Metric("end", "terminal", sp.log(x - 10)),
                 wb.Metric("part", "largest", sp.log(x - sp.Rational(1, 2))),
                 wb.Metric("whole", "largest", sp.log(x + 1))))
    assert found.metrics["end"] is None
    assert found.metrics["part"] is None
    assert found.metrics["whole"] == pytest.approx(math.log(1 + max(found["x"])), abs=1e-2)


@pytest.mark.parametrize(("start", "goal"), [(0.5, 0.0), (0.0, 0.5)])
def test_mpc_of_an_empty_tank_ends(start: float, goal: float) -> None:
    """Where the tank is empty the outflow's root has an endless slope: the solver searched for a step without end."""
    h, q = sp.symbols("h q", real=True)
    tank = wb.Plant("tank", (h,), (q - sp.sqrt(h) / 10,), (q,), input_limits={q: (0, 0.5)})
    setting = wb.Setting(tank, 2.0, 0.01, references={"r": wb.Constant(value=goal)}, tracks={"h": "r"},
                         initial={"h": start})
    run = wb.compare(setting, [wb.entrant(wb.PlantMpc(20, {"h": 1.0}, {"q": 1e-3}, substeps=4), 0.5)]).runs[0]
    assert run.failed is None
    assert run["h"][-1] > 0.4 if goal else run["h"][-1] < 0.45


def test_mpc_of_two_tanks_that_run_empty_ends():
    """fatrop never came back from the derivatives of two roots at zero, and could not be interrupted."""
    h, k, q = sp.symbols("h k q", real=True)
    tanks = wb.Plant("tanks", (h, k), (q - sp.sqrt(h) / 10, (sp.sqrt(h) - sp.sqrt(k)) / 10), (q,),
                     input_limits={q: (0, 0.5)})
    setting = wb.Setting(tanks, 1.5, 0.01, references={"r": wb.Constant(value=0.0)}, tracks={"k": "r"},
                         initial={"h": 0.5, "k": 0.5})
    run = wb.compare(setting, [wb.entrant(wb.PlantMpc(20, {"k": 1.0}, {"q": 1e-3}), 0.5)]).runs[0]
    assert run.failed is None and max(run["q"]) < 0.01


def test_numbers_may_be_exact():
    """pi/4 in a table is the float that it stands for, wherever a number is asked for."""
    k = sp.Symbol("k", positive=True)
    told = []
    for quarter, tenth in ((sp.pi / 4, sp.Rational(1, 10)), (math.pi / 4, 0.1)):
        plant = wb.Plant("m", (x, v), (v, u - k * x), (u,), parameters=(wb.Parameter(k, quarter),))
        law = wb.Law("p", {u: -k * (x - r.value)}, parameters=(k,), references=(r,))
        setting = wb.Setting(plant, 10 * tenth, tenth / 100, initial={"x": quarter}, references={"r": tenth},
                             tracks={"x": "r"}, noise={"x": tenth})
        assert plant.linearise({"x": quarter}).A[1, 0] == -math.pi / 4
        told.append([(run.metrics, run.failed) for run in wb.compare(setting, [
            wb.entrant(law, tenth, {k: quarter}), wb.entrant(wb.PlantMpc(5, {"x": tenth}, {"u": tenth}), tenth)])])
    assert told[0] == told[1]


@pytest.mark.parametrize(("rate", "start"), [(sp.exp(x**3), 2.0), (-sp.sqrt(x), 1.0), (x**2, 1.0)])
def test_a_solver_that_comes_to_no_end_is_one_line(rate: sp.Expr, start: float) -> None:
    """Numbers that overflow, a root beyond its domain, and a state that grows beyond every bound, of which LSODA takes
    steps without end; nothing of it is a warning."""
    plant = wb.Plant("q", (x,), (rate,))
    for integrator in ("radau", "bdf", "lsoda"):
        run = wb.simulate(plant, None, period_s=0.1, step_s=0.1, duration_s=2.5, initial={"x": start},
                          integrator=integrator)
        assert run.failed is not None and run.found.reached_s < 2.3 and "\n" not in run.failed
        assert "finite numbers" in run.failed or "domain" in run.failed
        assert all(value is None for value in run.metrics.values())


def test_an_input_begins_within_its_limits_or_is_refused() -> None:
    bounded = wb.Plant("bounded", (x,), (u,), inputs=(u,), input_limits={u: (1, 5)})
    law = wb.Law("hold", {u: 2 - x})
    run: dict[str, Any] = {"period_s": 0.1, "duration_s": 0.1, "lag_s": {"u": 0.3}}
    assert wb.simulate(bounded, law, initial={u: 5}, **run).to_pandas()["u"].iloc[0] == 5
    assert wb.simulate(bounded, law, **run).to_pandas()["u"].iloc[0] == 1
    with pytest.raises(ValueError, match=r"initial\.u = 99 is outside the input's limits, 1 to 5: give a value within"):
        wb.simulate(bounded, law, initial={u: 99}, **run)


@pytest.mark.parametrize(("how", "words"), [
    ({"terminal_weight": math.nan}, r"terminal_weight = nan: give a finite number that is not negative"),
    ({"terminal_weight": -1.0}, r"terminal_weight = -1\.0: give a finite number"),
    ({"terminal_weight": "1"}, r"terminal_weight = '1': give a finite number"),
    ({"excess_price": -1.0}, r"excess_price = -1\.0: give a finite number"),
    ({"input_targets": {"u": math.inf}}, r"input_targets\.u = inf: give a finite number"),
    ({"disturbance_gain": "1"}, r"disturbance_gain = '1': give a number from 0 to 1")])
def test_a_number_with_which_mpc_has_no_best_plan_is_refused(how: dict[str, Any], words: str) -> None:
    """With a weight that is no number, or negative, MPC ran on plans of its own making without a word."""
    with pytest.raises(ValueError, match=words):
        wb.PlantMpc(5, {"x": 1.0}, **how)


def test_what_is_known_of_a_parameter_agrees_with_its_symbol() -> None:
    """A sweep that drew a negative mass ended in the middle, and gains were proved for masses that no car has."""
    m, b = sp.Symbol("m", positive=True), sp.Symbol("b", real=True)
    with pytest.raises(ValueError, match=r"parameter 'm': known begins at -1, and the symbol is declared positive"):
        wb.Parameter(m, 2.0, known=(-1, 4))
    with pytest.raises(ValueError, match=r"parameter 'b': known = \(0, inf\) has no end"):
        wb.Parameter(b, 2.0, known=(0, None))  # type: ignore[arg-type]
    assert wb.Parameter(m, 2.0, known=(0, 4)).known == (0, 4) and wb.Parameter(b, 2.0, known=(-1, 4)).known == (-1, 4)


def test_compare_says_what_it_takes() -> None:
    """Entrants beside a folder, which names its own, were left out without a word."""
    plant = wb.Plant("m", (x, v), (v, u), (u,))
    with pytest.raises(ValueError, match=r"the first argument is a Plant: give a folder, or a Setting\(plant"):
        wb.compare(plant, [])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"entrants are for a Setting, and 'mine' names its own: leave them out"):
        wb.compare("mine", [wb.entrant(wb.Law("l", {u: -x}), 0.1)])


def test_what_only_a_law_has_is_refused_of_other_controllers() -> None:
    """Parameters given beside a function of Python were left out without a word."""
    for guest in (lambda t, y, r: -y[0], wb.PlantMpc(5, {"x": 1.0})):
        for values in ({"parameters": {"k": 1}}, {"initial": {"q": 1}}):
            with pytest.raises(ValueError, match=r"are a law's alone: leave them out, and put these values into"):
                wb.entrant(guest, 0.1, **values)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [math.nan, math.inf, "a"])
def test_a_laws_state_begins_with_a_number(value: Any) -> None:
    q = sp.Symbol("q", real=True)
    law = wb.Law("pi", {u: -x - q}, (wb.LawState(q, rate=x),))
    with pytest.raises(ValueError, match=r"controller 'pi': initial value of 'q' = .* give"):
        wb.simulate(wb.Plant("m", (x, v), (v, u), (u,)), law, period_s=0.1, duration_s=0.1, law_initial={"q": value})


def test_a_metric_may_name_an_output() -> None:
    """What it is of is there, without the measurement's noise."""
    y = sp.Symbol("y", real=True)
    plant = wb.Plant("m", (x, v), (v, u), (u,), outputs={y: x + 2 * v})
    metrics = (wb.Metric("seen", "root mean square", y), wb.Metric("meant", "root mean square", x + 2 * v))
    run = wb.simulate(plant, wb.Law("l", {u: -y}), period_s=0.1, duration_s=1.0, initial={"x": 1}, noise={"y": 0.1},
                      metrics=metrics)
    assert run.metrics["seen"] == run.metrics["meant"] != 0.0


def test_an_entrant_is_a_law_or_builds_one() -> None:
    with pytest.raises(ValueError, match="no law and builds no controller"):
        wb.entrant(Path(), 0.1)


def test_the_sampling_period_is_a_laws_alone() -> None:
    """A plant that named it was told at its first run to make T_s a state."""
    with pytest.raises(ValueError, match=r"rate of 'v' uses 'T_s', which is the sampling period, which a law alone"):
        _plant(u + wb.period)
    with pytest.raises(ValueError, match=r"metric 'm' uses 'T_s', which is the sampling period"):
        wb.Setting(_plant(), 1.0, metrics=(wb.Metric("m", "integral", wb.period),))
    run = wb.simulate(_plant(), wb.Law("l", {u: wb.period}), period_s=0.25, duration_s=1.0)
    assert run["u"][-1] == 0.25


@pytest.mark.parametrize(("old", "new", "told"), [
    ("reference.x_d", "reference.y_d", "tracks.x = 'x_d' is no reference: state reference.x_d$"),
    ("at_s = 5.0", "at_s = 5.0004", r"study.toml: disturbance.d: at_s = 5.0004 s is no whole number"),
    ("tracks = { x = \"x_d\" }", "tracks = { x = 0 }", "tracks.x: is a number, 0, and names no reference: state one"),
    ("tracks =", "actuators.delay_s = { u = 0.0005 }\ntracks =", "study.toml: actuators.delay_s.u = 0.0005 s is no"),
    ("tracks =", "sensing.noise = { z = 0.1 }\ntracks =", "study.toml: sensing.noise.z: plant 'mine2026.mass' has no")])
def test_a_mistake_in_a_file_is_told_by_the_keys_of_files(tmp_path: Path, old: str, new: str, told: str) -> None:
    """A setting of Python has references, a file reference: who stated what was asked for was refused once more."""
    folder = write_new_paper("mine2026", tmp_path, "plant")
    study = folder / "study.toml"
    assert old in study.read_text()
    study.write_text(study.read_text().replace(old, new))
    with pytest.raises(InputError, match=told):
        wb.load(folder)

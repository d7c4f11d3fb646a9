"""Expressions become code in one place: what is refused there, and what is kept between runs."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import law_alone
import numpy as np
import plant_alone
import pytest
import sympy as sp
from llvmlite import binding
from numba.core.errors import TypingError
from scenarios import LAWS, short_scenario

from workbench.compile.code_cache import imported_kernel
from workbench.compile.kernel import casadi_function, law_source, loop_module, numeric, plant_source
from workbench.errors import CompileError
from workbench.model.law import ControlLaw, LawState, neuron, over_neurons, position
from workbench.simulate.closed_loop import simulate
from workbench.simulate.law_loop import law_loop
from workbench.trains.train import Plant, single_particle, single_particle_per_mass

PLANTS = {"newton": single_particle(), "per mass": single_particle_per_mass()}

PROCESS = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from scenarios import LAWS, short_scenario
from workbench.simulate import closed_loop
from workbench.simulate.law_loop import law_loop
run = closed_loop.simulate(short_scenario(), "pid")
kernel = law_loop(LAWS["pid"]).closed_loop
hits, misses = (sum(found.values()) for found in (kernel.func.stats.cache_hits, kernel.func.stats.cache_misses))
print(hits, misses, kernel.args[0].code.cache_hits, repr(run.final_position_m))
"""


def test_a_second_process_uses_the_first_ones_compiled_kernel():
    """This process has compiled it, or found it; another one finds it, and writes nothing of it anew."""
    run, loop = simulate(short_scenario(), "pid"), law_loop(LAWS["pid"])
    kept = {path: path.stat().st_mtime_ns for module in (loop.plant, loop.law)
            for path in Path(module.__file__).parent.glob(f"{module.__name__}.*")}
    assert {path.suffix for path in kept} >= {".py", ".sealed-index", ".sealed-code"}
    command = [sys.executable, "-W", "error", "-c", PROCESS, str(Path(__file__).parent)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1", "0", "1", repr(run.final_position_m)]
    assert {path: path.stat().st_mtime_ns for path in kept} == kept


def test_a_changed_law_is_another_kernel_and_the_same_law_the_same_one(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    laws = [ControlLaw("test.same_id", "a law", "a test", "full state, model unknown", command)
            for command in (-position / 3, -position / 3, -position / 5)]
    one, same, other = (loop_module(law.source, [law_source(law)], law_alone) for law in laws)
    assert one is same
    assert one is not other
    for module, command in ((one, -2.0), (other, -6 / 5)):
        commands = np.zeros(1)
        module.answers(np.array([[0.0, 6.0, 0.0, 0.0, 0.0, 0.0, 0.1]]), *(np.zeros(0),) * 2, *(np.zeros((0, 0)),) * 2,
                       commands, np.zeros((1, 0)))
        assert commands == pytest.approx(command, rel=1e-15)


def test_a_cache_that_cannot_be_written_falls_back_to_another_folder(tmp_path, monkeypatch):
    blocked = tmp_path / "a file"
    blocked.write_text("not a folder")
    monkeypatch.setenv("WORKBENCH_CACHE", str(blocked))
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path))
    law = ControlLaw("test.fallback", "a law", "a test", "full state, model unknown", -position / 7)
    module = loop_module(law.source, [law_source(law)], law_alone)
    assert Path(module.__file__).is_relative_to(tmp_path / f"workbench-compiled-kernels-{os.geteuid()}")


def _law(command: sp.Expr, *parameters: sp.Symbol, states: tuple[LawState, ...] = ()) -> ControlLaw:
    return ControlLaw("test.law", "a law", "a test", "full state, model unknown", command, states, parameters)


@pytest.mark.parametrize("name", ["lambda", "a b", r"\hat{a}", "neurons", "math", "_in_0", "2x"])
def test_a_symbol_that_cannot_name_a_variable_is_refused_by_its_name(name):
    symbol = sp.Symbol(name)
    with pytest.raises(CompileError, match="rename it"):
        law_source(_law(symbol * position, symbol))


def test_a_symbol_without_a_value_is_named():
    with pytest.raises(CompileError, match=r"test\.law: symbol 'K' has no value there"):
        law_source(_law(sp.Symbol("K") * position))
    with pytest.raises(CompileError, match="symbol 'w' has no value"):
        rates = {position: position * sp.Symbol("w")}
        plant_source(Plant(rates, sp.Symbol("u"), sp.Symbol("f"), (), "a test"))


def test_symbols_that_would_be_one_variable_are_refused():
    a, b = sp.symbols("a a_next", real=True)
    moving = LawState(a, update=a + position)
    for law in (_law(a * b, b, states=(moving,)), _law(a * b, states=(moving, LawState(b, update=b))),
                _law(position * b, b, b), _law(position, position)):
        with pytest.raises(CompileError, match=r"test\.law: two symbols would be called '(a_next|x_1)'"):
            law_source(law)
    with pytest.raises(CompileError, match="'x_1' has other assumptions"):
        law_source(_law(sp.Symbol("x_1", positive=True) * b, b))


def test_cases_that_leave_something_open_and_what_is_not_carried_out_are_refused():
    """Of cases that all fail a run was told with Python's None for a number."""
    x = position
    for command, words in ((sp.Piecewise((x, x > 0)), r"says nothing of what is left: end it with \(value, True\)"),
                           (sp.Derivative(x**2, x), "Derivative.*carry them out")):
        with pytest.raises(CompileError, match=words):
            law_source(ControlLaw("mine.law", "a law", "none", "full state", command))
    with pytest.raises(CompileError, match=r"^law 'mine.law': Piecewise.*says nothing"):
        law_loop(ControlLaw("mine.law", "a law", "none", "full state", sp.Piecewise((x, x > 0))))
    both = law_source(ControlLaw("mine.law", "a law", "none", "full state", sp.Piecewise((x, x > 0), (-x, x <= 0))))
    assert "None" not in both


def test_a_sum_inside_a_sum_is_refused():
    weight = sp.IndexedBase("w")[sp.Symbol("j", integer=True, positive=True)]
    law = _law(over_neurons(weight * over_neurons(weight)), states=(LawState(weight, rate=-weight),))
    with pytest.raises(CompileError, match="a sum inside a sum"):
        law_source(law)


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS.keys())
def test_casadi_numpy_and_the_kernel_agree_with_exact_evaluation(plant):
    symbols = (*plant.rates, plant.command, plant.disturbance, *plant.parameters)
    exact = dict(zip(symbols, (sp.Rational(n, 7) for n in range(3, 3 + len(symbols))), strict=True))
    expected = [float(rate.subs(exact)) for rate in plant.rates.values()]
    numbers = [float(x) for x in exact.values()]
    from_casadi = casadi_function("rates", symbols, list(plant.rates.values()))(*numbers)
    assert [float(x) for x in from_casadi.elements()] == pytest.approx(expected, rel=1e-14)
    assert [numeric(symbols, r)(*numbers) for r in plant.rates.values()] == pytest.approx(expected, rel=1e-14)
    kernel = loop_module(plant.source, [plant_source(plant)], plant_alone)
    states = len(plant.rates) + 2
    rates = kernel.plant_rates(*numbers[:states], np.array(numbers[states:]))
    assert rates == pytest.approx(expected, rel=1e-14)


def test_neurons_far_away_answer_with_the_zero_that_exp_gives_too():
    """Two neurons in one place, so far from the train as makes the borders of what exp has."""
    center, width = sp.IndexedBase("c")[neuron], sp.Symbol("w", positive=True)
    answers = over_neurons(sp.exp(-(position - center) ** 2 / width))
    law = ControlLaw("test.far", "a law", "a test", "full state, model unknown", answers, parameters=(width,),
                     neuron_data=(center,))
    step = loop_module(law.source, [law_source(law)], law_alone).control_step.py_func
    for x in (-1e300, -746.0 - 1e-12, -746.0, -745.2, -745.1, -700.0, -1e-300, 0.0, math.nan):
        found = step(0.0, math.sqrt(-x), *(0.0,) * 5, np.ones(1), np.zeros(0), np.zeros((0, 2)), np.zeros((1, 2)))
        assert np.array_equal(found, 2 * math.exp(-math.sqrt(-x) ** 2), equal_nan=True)


def test_generated_source_names_the_papers_equations_it_comes_from():
    loop = law_loop(LAWS["yang2021.pocrac"])
    assert "yang2021 (27), (33)-(36)" in loop.law.__doc__
    assert "Newton's second law, Davis equation, in N" in loop.plant.__doc__


def _sources() -> list[str]:
    return [law_source(law, estimates) for law in LAWS.values() for estimates in ("corrected", "explicit")]


def test_generated_source_does_not_depend_on_the_order_of_hashes():
    """This process has one order, another has another one."""
    script = ("import json, sys\nsys.path.insert(0, sys.argv[1])\nfrom test_compile import _sources\n"
              "print(json.dumps(_sources()))")
    seed = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    done = subprocess.run([sys.executable, "-c", script, str(Path(__file__).parent)], capture_output=True, text=True,
                          check=True, env=os.environ | {"PYTHONHASHSEED": seed})
    sources = _sources()
    assert json.loads(done.stdout) == sources and len(sources) == 2 * len(LAWS)
    assert all("def control_step" in source for source in sources)


LINKED = """from numba import njit

from workbench.compile.linked import linked


@linked("UniTuple(float64, 2)(float64[::1], float64)")
@njit(cache=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)
def scaled(values, factor):
    total = 0.0
    for value in values:
        total += factor * value
    return total, factor / total


@njit(cache=True)
def mean(values):
    return scaled(values, 2.0)[0] / values.shape[0]


@njit(cache=True)
def of_a_column(table):
    return scaled(table[:, 0], 2.0)
"""


def test_a_linked_function_is_called_by_its_address_and_kept(tmp_path, monkeypatch):
    name, values = "workbench_kernel_of_a_linked_test", np.array([0.1, 0.2, 4.0])
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    found = []
    for _ in range(2):  # compiled, and loaded as another process would
        monkeypatch.delitem(sys.modules, name, raising=False)
        module = imported_kernel(name, LINKED)
        assert binding.address_of_symbol(f"{name}.scaled")
        found.append(module.mean(values))
    assert found == [(2.0 * 0.1 + 2.0 * 0.2 + 2.0 * 4.0) / 3] * 2
    assert sum(module.mean.stats.cache_hits.values()) == 1
    with pytest.raises(TypingError):  # a column does not lie number by number in memory
        module.of_a_column(np.ones((3, 2)))

"""MPC of plants whose states are called positive, and whose slopes have no end where an estimate begins."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from workbench.mpc.plant_motion import PlantMotion
from workbench.mpc.plant_tracking import PlantMpc
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant

h, k = sp.symbols("h k", positive=True)  # levels of two tanks, the upper one not measured
u, x = sp.symbols("u x", real=True)
TANKS = Plant("tanks", (h, k), (sp.sqrt(k) - sp.sqrt(h), u - sp.sqrt(k)), (u,), outputs={h: h},
              input_limits={u: (0.0, 2.0)})
EDGE = Plant("edge", (x,), (u - sp.asin(x),), (u,), input_limits={u: (-1.0, 1.0)})


def made(plant, track, **how):
    setting = Setting(plant, 1.0, references={"r": Constant(value=0.5)}, tracks={track: "r"}, initial={track: 0.3})
    return PlantMpc(8, {track: 10.0}, {"u": 1e-3}, **how).build(setting, 0.1)


@pytest.mark.parametrize("first", [{}, {"k": 0.4}])
def test_an_estimate_of_an_empty_tank_ends_in_a_plan(first):
    """A symbol that is called positive is so in the plant: not where an observer begins, nor where a solver tries."""
    controller = made(TANKS, "h", observer={"k": 1.0}, first_estimate=first)
    level = np.array([0.3, 0.3])
    for sample in range(60):
        command = float(np.ravel(controller.command(0.1 * sample, level[:1]))[0])
        for _ in range(100):
            inner = np.sqrt(level)
            level = level + 0.001 * np.array([inner[1] - inner[0], command - inner[1]])
    assert controller.fallbacks == 0
    assert level == pytest.approx([0.5, 0.5], abs=0.02)
    assert controller.state.now(level[:1], [])[1] == pytest.approx(level[1], abs=0.05)


def test_the_first_measurement_of_a_state_is_its_first_estimate():
    assert made(TANKS, "h", observer={"k": 1.0}).state.now(np.array([0.7]), []) == pytest.approx([0.7, 0.0])
    stated = made(TANKS, "h", observer={"k": 1.0}, first_estimate={"h": 0.2})
    assert stated.state.now(np.array([0.7]), [])[0] == pytest.approx(0.2)  # nothing moves it beyond the model


def test_an_output_of_a_state_by_another_name_is_its_first_estimate_too():
    meter = sp.Symbol("h_m", real=True)
    named = replace(TANKS, outputs={meter: h})
    setting = Setting(named, 1.0, references={"r": Constant(value=0.5)}, tracks={"h_m": "r"})
    controller = PlantMpc(8, {"h_m": 10.0}, {"u": 1e-3}, observer={"k": 1.0}).build(setting, 0.1)
    assert controller.state.now(np.array([0.7]), []) == pytest.approx([0.7, 0.0])


T = sp.Symbol("T", positive=True)  # a reaction that heats itself


@pytest.mark.parametrize(("rate", "steep"), [(u - 1 / T, True), (u + sp.exp(x), True), (u / (1 + x**2), False),
                                             (u + sp.exp(-x**2), False), (u + sp.exp(-1 / T), True)])
def test_a_plant_whose_slopes_may_grow_without_bound_is_not_for_fatrop(rate, steep):
    """Of the numbers that an exponential gives near a pole fatrop looked for a step without end."""
    plant = Plant("hot", (T, x), (u, rate), (u,), input_limits={u: (-1.0, 1.0)})
    assert PlantMotion(PlantMpc(2, {"x": 1.0}), Setting(plant, 1.0)).is_steep is steep


def test_a_positive_divisor_goes_on_at_the_edge_of_its_domain():
    plant = Plant("hot", (T,), (u + sp.exp(-1 / T),), (u,), input_limits={u: (-1.0, 1.0)})
    motion = PlantMotion(PlantMpc(2, {"T": 1.0}), Setting(plant, 1.0))
    assert motion(np.array([-0.5]), np.array([0.0]), np.zeros(0), 0.1) == pytest.approx([-0.5])
    assert motion(np.array([2.0]), np.array([0.0]), np.zeros(0), 1e-4) == pytest.approx([2 + 1e-4 * np.exp(-0.5)])


def test_where_the_constraints_have_no_slopes_no_solver_is_asked():
    controller = made(EDGE, "x")
    assert float(np.ravel(controller.command(0.0, np.array([1.0])))[0]) == 0.0
    assert controller.fallbacks == 1
    assert float(np.ravel(controller.command(0.1, np.array([0.2])))[0]) > 0.2
    assert controller.fallbacks == 1


def test_a_filter_whose_numbers_overflow_begins_anew():
    plant = Plant("blow up", (x,), (x**3 + u,), (u,), input_limits={u: (-1.0, 1.0)})
    setting = Setting(plant, 1.0, references={"r": Constant(value=0.0)}, tracks={"x": "r"})
    controller = PlantMpc(2, {"x": 1.0}, observer={"x": 1.0}, first_estimate={"x": 0.25}).build(setting, 0.1)
    for level in (1e200, 0.5):  # one that is measured beyond all reason, then what is there again
        estimate = controller.state.now(np.array([level]), [(np.zeros(1), 0.1)])
    assert estimate == pytest.approx([0.5])

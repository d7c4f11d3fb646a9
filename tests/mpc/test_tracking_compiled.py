"""The compiled tracking MPC against the one built in casadi: the same program, sample by sample and in closed loops."""

import numpy as np
import pytest
from scenarios import YANG, short_scenario

from workbench.cli.options import load
from workbench.mpc.tracking import TrackingMpc
from workbench.mpc.tracking_compiled import CompiledTrackingMpc
from workbench.simulate import compare as comparing
from workbench.simulate.closed_loop import Factors, simulate
from workbench.simulate.controllers import compiled
from workbench.simulate.draws import draw_factors
from workbench.simulate.metrics import measure
from workbench.simulate.sweep import sweep

LOOPS = {
    "nothing binds": ({}, Factors()),
    "traction binds": ({"train__max_traction_n": 152e3}, Factors(mass=1.04, davis_a=1.1)),
    "braking binds": ({"train__max_braking_n": 15e3}, Factors(mass=0.95)),
    "the band binds": ({"simulation__position_band_m": 0.003}, Factors(mass=1.05, line_resistance=2.0)),
    "power binds": ({"train__max_power_w": 1.2e6}, Factors(davis_c=1.1)),
}


@pytest.mark.parametrize("loop", LOOPS)
def test_the_closed_loop_is_that_of_the_plain_one_and_asks_casadi_only_where_a_limit_binds(loop, monkeypatch):
    changes, factors = LOOPS[loop]
    scenario = short_scenario(**changes)
    plain = simulate(scenario, "mpc", factors)
    asked = []
    solve = TrackingMpc._solve
    monkeypatch.setattr(TrackingMpc, "_solve", lambda self, *given: asked.append(given) or solve(self, *given))
    fast = simulate(compiled(scenario), "mpc", factors)
    assert bool(asked) == (loop != "nothing binds")
    assert plain.counters == fast.counters
    assert plain.counters["qp_failed"] == 0
    assert np.abs(plain.log - fast.log).max() < 1e-6


def test_a_measurement_that_is_no_number_is_answered_alike():
    scenario = short_scenario()
    spec = scenario.controllers["mpc"]
    both = [made(scenario, spec, "mpc") for made in (TrackingMpc, CompiledTrackingMpc)]
    for sample in range(30):
        position, speed, _ = scenario.desired_curve().at(np.array([sample * 0.1]))
        told = (float(position[0]) + 0.01, float("nan") if sample % 7 == 3 else float(speed[0]))
        answers = [controller.command(sample * 0.1, *told) for controller in both]
        assert answers[0] == pytest.approx(answers[1], abs=1e-6)
    assert both[0].counters == both[1].counters


def test_variants_and_sweeps_run_the_compiled_form_and_the_stated_run_does_not(monkeypatch):
    loaded = load(YANG)
    short = loaded.scenario.model_copy(update={
        "controllers": {"mpc": loaded.scenario.controllers["mpc"]}, "tuning": None,
        "variants": tuple(v for v in loaded.scenario.variants if not v.controllers)[:1]})
    ran = []
    monkeypatch.setattr(comparing, "simulate", lambda scenario, name: ran.append(scenario.controllers[name].law)
                        or simulate(short_scenario(), name))
    monkeypatch.setattr(comparing, "changed_scenario", lambda *given: short)
    comparing.compare(loaded.path, loaded.data, short, workers=1)
    assert ran == ["mpc.tracking", "mpc.tracking_compiled"]

    scenario = short_scenario()
    (row,) = sweep(scenario, YANG, 1, 3, controllers=["mpc"], workers=1)
    run = simulate(compiled(scenario), "mpc", draw_factors(scenario, 0, 3))
    assert row.position_rms == measure(run, scenario).position_rms

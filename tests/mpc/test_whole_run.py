"""MPC that the compiled loop drives by itself has the bits of the same MPC called once a sample, whatever happens."""

import functools
from dataclasses import replace

import numpy as np
import pytest
from scenarios import short_scenario

from proofs.liu2020.plant import model
from workbench.model.sensing import Sensing
from workbench.mpc.controller import MpcController
from workbench.mpc.learning import RecordingMpc
from workbench.mpc.whole_run import BLOCKS, COUNTED, whole_run
from workbench.simulate.closed_loop import setting_of, simulate_in

WEIGHTS = {"horizon": 12.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 4.34,
           "change_weight": 0.1, "band_price": 1e3}
OWN = {"mpc.offset_free": {"observer_gain": 0.3}, "mpc.told": {"observer_gain": 0.5},
       "mpc.tube": {"disturbance_mps2": 0.15}, "mpc.adaptive": {"forgetting": 0.99}}
ACTUATOR = {"delay_s": 0.25, "lag_s": 0.4, "source": {"delay_s": "assumed: a test", "lag_s": "assumed: a test"}}
# What goes right, what is late and noisy, and measurements that are none: plans shifted, LQR, feedforward.
SENSED = {"plain": Sensing(), "noisy and late": Sensing(0.05, 0.02, 0.1, 0.1, seed=3),
          "far off": Sensing(position_noise_m=7e8, seed=4), "fast beyond reason": Sensing(speed_noise_mps=6e3, seed=5)}


class Called:
    """A controller that is called once a sample, and is nothing else to who calls it."""

    def __init__(self, controller):
        self._command, self.counters = controller.command, controller.counters
        self.title, self.information = controller.title, controller.information

    def command(self, time_s, position_m, speed_mps):
        return self._command(time_s, position_m, speed_mps)


@functools.cache
def scenario_of(law, told=False, **changes):
    more = {"controllers__mpc__predictor": True, "actuator": ACTUATOR} if told else {}
    return short_scenario(controllers__mpc__law=law, **more,
                          controllers__mpc__parameters=WEIGHTS | OWN.get(law, {}) | changes)


def both(scenario, make, sensing, plant=None):
    """The run of a plant by the compiled loop and the one by calls, and their controllers."""
    setting = replace(setting_of(scenario), end_s=12.0, sensing=sensing, plant_values=(1.05,) if plant else ())
    driven, called = make(scenario), make(scenario)
    assert whole_run(driven) is not None
    return (simulate_in(scenario, "mpc", setting, plant, driven),
            simulate_in(scenario, "mpc", setting, plant, Called(called)), driven, called)


def plain(scenario):
    return MpcController(scenario, scenario.controllers["mpc"], "mpc")


@pytest.mark.parametrize("sensed", SENSED)
@pytest.mark.parametrize(("law", "told"), [("mpc.linear", False), ("mpc.nonlinear", False), ("mpc.offset_free", True),
                                           ("mpc.told", True), ("mpc.linear", True), ("mpc.tube", False),
                                           ("mpc.adaptive", False), ("mpc.adaptive", True)])
def test_a_run_has_the_bits_of_calls(law, told, sensed):
    run, other, driven, called = both(scenario_of(law, told), plain, SENSED[sensed])
    assert run.log.tobytes() == other.log.tobytes()
    assert run.totals == other.totals and run.failed == other.failed and run.end_s == other.end_s
    assert driven.counters == called.counters and driven.explain() == called.explain()
    assert len(run.step_us) == len(other.step_us) and np.all(run.step_us > 0)
    if sensed in ("far off", "fast beyond reason"):
        assert driven.counters["bad_measurement"] > 0


def test_a_run_of_another_plant_has_the_bits_of_calls_too():
    """A train that answers to a force with a factor that MPC does not know."""
    run, other, driven, called = both(scenario_of("mpc.offset_free"), plain, SENSED["noisy and late"], model())
    assert run.log.tobytes() == other.log.tobytes() and driven.counters == called.counters
    known, *_ = both(scenario_of("mpc.offset_free"), plain, SENSED["noisy and late"])
    assert run.failed is None and run.log.tobytes() != known.log.tobytes()


def test_what_is_learned_of_a_trip_is_the_same_too():
    scenario = scenario_of("mpc.offset_free", True)
    foreseen = 0.05 * np.sin(np.arange(100) / 7.0)

    def recording(of):
        return RecordingMpc(of, of.controllers["mpc"], "mpc", foreseen)

    run, other, driven, called = both(scenario, recording, SENSED["noisy and late"])
    assert run.log.tobytes() == other.log.tobytes()
    assert np.isfinite(driven.pushed).sum() > 50
    assert np.array_equal(driven.pushed, called.pushed, equal_nan=True)


def test_what_is_more_than_its_solver_is_called():
    """A deadline, a held command, one that has been called: they have a state of their own."""
    for law, changes in (("mpc.linear", {"deadline_s": 1.0}), ("mpc.linear", {"held_samples": 2.0})):
        assert whole_run(plain(scenario_of(law, **changes))) is None
    begun = plain(scenario_of("mpc.linear"))
    assert whole_run(begun) is not None
    begun.command(0.0, 0.0, 0.0)
    assert whole_run(begun) is None
    assert whole_run(Called(begun)) is None


def test_every_counter_of_a_run_is_one_of_the_fallback():
    assert {*COUNTED, "late"} == set(plain(scenario_of("mpc.linear")).counters)
    assert len({name for name, _, _ in BLOCKS}) == len(BLOCKS)

"""The compiled loop, which calls a law by its address, has the bits of the same sources interpreted by Python."""

from dataclasses import replace

import numpy as np
import pytest
from contests import common, without_actuator

from workbench.errors import WorkbenchError
from workbench.model.sensing import Sensing
from workbench.simulate import actuator_loop, kernel_loop, sensing_loop
from workbench.simulate.closed_loop import _arrays, run_law, setting_of
from workbench.simulate.controllers import compiled_law
from workbench.simulate.law_loop import law_loop, written_loop
from workbench.simulate.law_values import law_values

FAILURES = np.array([[0.1, np.inf, 5e3, 0.0, 0.0, 0.0, 0.1], [0.2, 0.6, 5e3, 1e2, 1.0, 0.2, 0.2]])
TERMS = np.array([[0.1, 0.8, 0.02, 0.01, 0.5, 0.1, 0.0], [0.2, 0.8, 1e-3, 0.0, 0.0, 0.0, 1.0]])
CHANGES = np.array([[0.1, 7e4, 8e2, 30.0, 0.01], [0.4, 6e4, 9e2, 31.0, 0.02], [0.8, 6e4, 9e2, 31.0, 0.0]])
SETTINGS = {
    "told at once": {},
    "noise": {"sensing": Sensing(position_noise_m=0.05, speed_noise_mps=0.02, seed=3)},
    "late": {"sensing": Sensing(measurement_delay_s=0.1, command_delay_s=0.1)},
    "an odometer": {"sensing": Sensing(position_quantum_m=0.02, odometer_scale=0.995, balise_spacing_m=0.1)},
    "failures": {"failures": FAILURES},
    "pushed and changed": {"terms": TERMS, "changes": CHANGES},
}


@pytest.fixture
def interpreted(monkeypatch):
    """The loop's own source in Python, of the plant and law that a compiled one is made of."""
    for module in (sensing_loop, actuator_loop):
        for name, function in vars(module).items():
            if callable(function):
                monkeypatch.setattr(kernel_loop, name, function, raising=False)

    def loop(compiled, values, state):
        monkeypatch.setattr(kernel_loop, "plant_rates", compiled.plant.plant_rates.py_func, raising=False)
        margin, step = compiled.law.domain_margin.py_func, compiled.law.control_step.py_func

        def law(*arguments):
            sample = arguments[:7]
            if not margin(*sample, values[0]) > 0.0:
                return 0
            state[2] = step(*sample, *values)
            return 1

        return law
    return loop


@pytest.mark.parametrize("name", ["pid", "rbfnn_pocrac", "mao2018_corrected"])
def test_a_compiled_run_has_the_bits_of_its_source(name, interpreted):
    for scenario in (common().world, without_actuator(common().world)):
        spec = scenario.controllers[name]
        law = compiled_law(scenario, spec)
        for what, changes in SETTINGS.items():
            setting = replace(setting_of(scenario), end_s=1.0, **changes)
            values = law_values(law, spec, name)
            run = run_law(law, values, setting, spec.period_s, spec.estimates)
            arrays, (steps, per_sample, dt, every) = _arrays(setting, spec.period_s, law), setting.plan(spec.period_s)
            asked = interpreted(law_loop(law, spec.estimates), values, arrays.state)
            status, _ = kernel_loop.closed_loop(
                asked, 0, steps, per_sample, dt, *arrays.before_law(), setting.position_band_m, setting.nominal_mass_kg,
                *values, *arrays.after_law(), every)
            assert (status == kernel_loop.RUNNING) == (run.failed is None), what
            assert run.log.tobytes() == arrays.log[:len(run.log)].tobytes(), what
            assert [run.totals[key] for key in kernel_loop.ACCUMULATORS] == arrays.acc.tolist(), what
            assert run.final_position_m == arrays.state[0], what


def test_all_laws_of_a_plant_have_one_loop():
    scenario = common().world
    loops = [law_loop(compiled_law(scenario, scenario.controllers[name])) for name in ("pid", "rbfnn_pocrac")]
    assert loops[0].closed_loop.func is loops[1].closed_loop.func
    assert loops[0].law is not loops[1].law


def test_values_that_do_not_lie_row_by_row_in_memory_are_refused():
    scenario = common().world
    spec = scenario.controllers["rbfnn_pocrac"]
    law = compiled_law(scenario, spec)
    *values, data = law_values(law, spec, "rbfnn_pocrac")
    with pytest.raises(WorkbenchError, match="rbfnn_pocrac: neuron data must be floats that lie row by row in memory"):
        run_law(law, (*values, data[:, ::2]), setting_of(scenario), spec.period_s)


def test_a_written_law_that_states_no_domain_is_defined_everywhere():
    step = ("def control_step(_t, _p, _v, _x_d, _v_d, _a_d, _period, parameters, scalars, neurons, neuron_data):\n"
            "    return 0.5\n")
    bounded = "def domain_margin(_t, _p, _v, _x_d, _v_d, _a_d, _period, parameters):\n    return 1.0 - _v\n"
    free, within = written_loop("a push", [step]), written_loop("a push up to 1 m/s", [step, bounded])
    at = (0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.1, np.zeros(0))
    assert free.law.domain_margin.py_func(*at) == np.inf and within.law.domain_margin.py_func(*at) == -1.0

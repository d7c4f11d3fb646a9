"""jiao2025 in a contest: a trial plays back learned inputs on the train of all others; speeds are learned from.

The train, its limits, the line and the noise are the scenario's; (1)-(3) and (17) of the paper are not used. All trials
are of whole length, of the same train, and disturbed alike: what repeats can be learned.
"""

from __future__ import annotations

import time
from dataclasses import replace
from functools import cache

import numpy as np

from workbench.contest.entrant import Entrant, Played, played_trials
from workbench.simulate.closed_loop import Run, Setting, run_law
from workbench.simulate.controllers import held_command
from workbench.simulate.law_loop import LawLoop, written_loop
from workbench.trains.scenario import ControllerSpec, Scenario

from .laws import TRIAL_LAWS
from .simulation.trials import trial_kernel

# No law but a table: row 0 of the data holds the commands of the samples, row 1 takes the speeds that were measured.
PLAYBACK = """
def control_step(_t, _p, _v, _x_d, _v_d, _a_d, _period, parameters, scalars, neurons, neuron_data):
    _k = min(int(round(_t / _period)), neuron_data.shape[1] - 1)
    neuron_data[1, _k] = _v
    return neuron_data[0, _k]
"""
OWN = ("unit_mps2", "first_input", "trials")


@cache
def _player() -> LawLoop:
    return written_loop("a table of commands", [PLAYBACK])


def _play(scenario: Scenario, spec: ControllerSpec, setting: Setting) -> Played:
    """Trial 0 with the first input, then `trials` that learn."""
    given, law = spec.parameters, TRIAL_LAWS[spec.law]
    steps, per_sample, _, _ = setting.plan(spec.period_s)
    samples = -(-steps // per_sample)
    length, learn = samples - 1, trial_kernel(spec.law, False).learn_trial
    unit, first = given["unit_mps2"], given.get("first_estimate", 1.0)
    desired = setting.curve.at(np.arange(samples, dtype=np.float64) * spec.period_s)[1]
    u, before, estimate = (np.full(length, value) for value in (given["first_input"], 0.0, first))
    speed, speed_before, error = np.zeros(samples), np.zeros(samples), np.zeros(samples)
    values = np.array([given[str(symbol)] for symbol in law.parameters])
    lengths = np.full(int(given["trials"]) + 1, length, dtype=np.int64)

    def drive(trial: int, noisy: Setting) -> Run:
        nonlocal speed, speed_before
        learn_s = 0.0
        if trial > 0:
            started = time.perf_counter()
            learn(lengths, trial, first, u, before, estimate, speed, speed_before, error, values)
            learn_s = time.perf_counter() - started
            speed, speed_before = speed_before, speed
        table = np.zeros((2, samples))
        table[0, :length], table[0, length] = unit * u, unit * u[-1]
        run = run_law(held_command, (np.zeros(1), np.zeros(0), np.zeros((0, 0)), table), noisy, spec.period_s,
                      title=law.title, loop=_player())
        speed[:] = table[1]
        error[:] = desired - speed
        return replace(run, step_us=run.step_us + 1e6 * learn_s / samples)

    return played_trials(range(len(lengths)), drive, setting, scenario.track.length_m)


def _entrant(name: str) -> Entrant:
    law = TRIAL_LAWS[name]
    own = tuple(map(str, law.parameters)) + (() if name.startswith("jiao2025.pd") else ("first_estimate",))
    return Entrant(law.title, "speed only, model unknown, earlier trials", (*own, *OWN), _play, counts=("trials",),
                   signed=("first_input",), learns=True)


ENTRANTS = {name: _entrant(name) for name in ("jiao2025.icfdl", "jiao2025.pd")}

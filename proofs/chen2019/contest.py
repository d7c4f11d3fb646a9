"""chen2019 in a contest: its law for one car on the train of all others, the estimates learned sample by sample.

The train counts as so many cars of the paper's mass that move alike, of which the law commands one; couplers then
neither pull nor stretch. The acceleration that (16) uses is that of measured speeds, through a low-pass: it is the only
one that can be had of a train whose resistance is unknown. An estimate is corrected one sample later, as in the study.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import sympy as sp

from workbench.compile.kernel import cars_source, function_source
from workbench.contest.entrant import Entrant, Played, played_trials
from workbench.model.law import LawState
from workbench.paper.results import Array
from workbench.simulate.closed_loop import Run, Setting, run_law
from workbench.simulate.controllers import held_command
from workbench.simulate.law_loop import LawLoop, written_loop
from workbench.trains import multi_particle as of_train
from workbench.trains.scenario import ControllerSpec, Scenario

from . import laws as law
from .simulation.cars_loop import COMPUTED

_v_now, _v_last = sp.symbols("v_now v_last", real=True)
# The acceleration of two measured speeds, through the low-pass of the study's rule.
_followed = law.v_dot_used + (1 - sp.exp(-law.T_s / law.tau)) * ((_v_now - _v_last) / law.T_s - law.v_dot_used)
_euler = [state + law.T_s * law.auxiliary[state] for state in (law.lambda_1, law.lambda_2)]

# Data: three rows a sample, column 0 the car's own estimates, column 1 those that all cars share; then room for a
# sample: state 4, the car 6, additional force 1, acceleration 1, computed 8, shared 4.
ROOM = 24
STEP = """
def control_step(_t, _p, _v, _s_r, _v_r, _a_r, _period, parameters, scalars, neurons, neuron_data):
    _end = neuron_data.shape[0] - 24
    _k = min(int(round(_t / _period)), _end // 3 - 1)
    _row = max(_k - 1, 0)
    _state = neuron_data[_end:_end + 4, 0:1]
    _car = neuron_data[_end + 4:_end + 10, 0:1]
    _pushed = neuron_data[_end + 10:_end + 11, 0:1]
    _used = neuron_data[_end + 11:_end + 12, 0:1]
    _held = neuron_data[_end + 12:_end + 20, 0:1]
    _all = neuron_data[_end + 20:_end + 24, 0]
    if _k > 0:
        scalars[2] = followed(scalars[2], _v, scalars[3], parameters)
    scalars[3] = _v
    _state[0, 0], _state[1, 0], _state[2, 0], _state[3, 0] = _p, _v, scalars[0], scalars[1]
    _used[0, 0] = scalars[2]
    _now, _learned = neuron_data[3 * _k:3 * _k + 3, 0:1], neuron_data[3 * _row:3 * _row + 3, 0:1]
    if _k == 0:
        _learned = neuron_data[_end + 20:_end + 23, 1:2]
        for _i in range(3):
            _learned[_i, 0] = _now[_i, 0]
    _old = neuron_data[3 * _row:3 * _row + 3, 1]
    control(_s_r, _v_r, _a_r, neuron_data[3 * _k, 1], neuron_data[3 * _k + 1, 1], neuron_data[3 * _k + 2, 1], _old[0],
            _old[1], _old[2], parameters, _state, _car, _pushed, _used, _now, _learned, _held, _learned, _all)
    if _k > 0:
        for _i in range(3):
            _old[_i] = _all[_i]
    scalars[0], scalars[1] = auxiliary(scalars[0], scalars[1], _held[1, 0], parameters)
    return _held[2, 0] / _car[0, 0]
"""
# What `scalars` holds from sample to sample, in the order of STEP.
_CARRIED = sp.symbols("lambda_1 lambda_2 v_dot_followed v_last", real=True)
ONE_CAR = replace(held_command, id="chen2019.one_car",
                  states=tuple(LawState(symbol, update=symbol) for symbol in _CARRIED))
CAR = ("car_mass_kg", "m_low_kg", "m_high_kg")
LAW = tuple(str(symbol) for symbol in (*law.gains, *law.learning_gains))
PARAMETERS = (*LAW, *CAR, "tau", "trials")


@cache
def _learner() -> LawLoop:
    sample = law.control_sample("filtered")
    return written_loop("chen2019 (8)-(22) for one car", [
        cars_source("control", law.CONTROL_SCALARS, law.VALUES,
                    (law.CAR_STATE, law.CAR_DATA, (of_train.f_a,), (law.v_dot_used,), law.memory_prev, law.memory_old),
                    (tuple(sample.computed[name] for name in COMPUTED), sample.kept), sample.shared),
        function_source("followed", (law.v_dot_used, _v_now, _v_last), law.VALUES, [_followed]),
        function_source("auxiliary", (law.lambda_1, law.lambda_2, law.Delta_u), law.VALUES, _euler),
        STEP])


def _values(scenario: Scenario, spec: ControllerSpec) -> Array:
    """In the order of VALUES; coefficients of a train are not the law's and enter nothing but what it records."""
    given, train = spec.parameters, scenario.train
    known = {"c_0": train.davis_a_mps2, "c_v": train.davis_b_per_s, "c_a": train.davis_c_per_m, "c_k": 0.0, "c_d": 0.0,
             "m_total": given["car_mass_kg"], "T_s": spec.period_s}
    return np.array([(given | known)[str(symbol)] for symbol in law.VALUES])


def _play(scenario: Scenario, spec: ControllerSpec, setting: Setting) -> Played:
    """As many trials as stated; each begins with no auxiliary state and what was learned before."""
    given, train = spec.parameters, scenario.train
    steps, per_sample, _, _ = setting.plan(spec.period_s)
    end, mass = 3 * -(-steps // per_sample), given["car_mass_kg"]
    memory = np.zeros((end + ROOM, 2))
    memory[2:end:3, 0] = given["m_low_kg"]
    share = mass / train.mass_kg
    of_car = {law.m: mass, law.first: 1.0, law.u_low: -train.max_braking_n * share,
              law.u_high: train.max_traction_n * share, law.m_low: given["m_low_kg"], law.m_high: given["m_high_kg"]}
    memory[end + 4 : end + 10, 0] = [of_car[symbol] for symbol in law.CAR_DATA]
    values = _values(scenario, spec)

    def drive(trial: int, noisy: Setting) -> Run:
        return run_law(ONE_CAR, (values, np.zeros(len(_CARRIED)), np.zeros((0, 0)), memory), noisy, spec.period_s,
                       title=ENTRANTS[spec.law].title, loop=_learner())

    return played_trials(range(1, int(given["trials"]) + 1), drive, setting, scenario.track.length_m)


ENTRANTS = {"chen2019.one_car": Entrant(
    "adaptive iterative learning, one car", "full state, model unknown, earlier trials", PARAMETERS, _play,
    counts=("trials",), learns=True)}

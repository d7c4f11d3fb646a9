"""One run: a scenario's train on its line under one controller, sampled as stated."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import Estimates
from workbench.errors import WorkbenchError
from workbench.model.law import ControlLaw
from workbench.model.sensing import PERFECT
from workbench.mpc.whole_run import WholeRun, whole_run
from workbench.simulate import sensing_loop
from workbench.simulate.controllers import SAMPLED, SampledController, compiled_law, held_command
from workbench.simulate.kernel_loop import ACCUMULATORS, DIVERGED, LEFT_DOMAIN, LOG_COLUMNS, RUNNING
from workbench.simulate.law_loop import LawLoop, law_loop, mpc_loop
from workbench.simulate.law_time import law_step_us
from workbench.simulate.law_values import check_controllers, controller_spec, law_values
from workbench.simulate.ride import Ride, ride
from workbench.simulate.setting import LEVEL, NOMINAL, UNLIMITED, Factors, Setting, setting_of
from workbench.trains.actuator import Known, drive, drive_totals
from workbench.trains.scenario import ControllerSpec, Scenario
from workbench.trains.train import Plant

BLOCK = 10_000  # samples

Array = NDArray[np.float64]
Told = tuple[Array, Array, Array, Array]


@dataclass(frozen=True)
class Run:
    """What a run left: its log (columns as in `columns`), totals, and why it ended early if it did."""

    controller: str
    title: str
    columns: tuple[str, ...]
    log: Array
    totals: dict[str, float]
    final_position_m: float
    end_s: float
    failed: str | None
    step_us: Array
    period_s: float
    counters: dict[str, int] = field(default_factory=dict)

    def column(self, name: str) -> Array:
        """A column of the log by its name; raises KeyError if there is none."""
        if name not in self.columns:
            raise KeyError(f"no column '{name}' in the log: choose one of {', '.join(self.columns)}")
        return self.log[:, self.columns.index(name)]

    @property
    def position_error(self) -> Array:
        """Position less desired position at the rows of the log, m."""
        return self.column("s_m") - self.column("s_desired_m")


@dataclass
class _Arrays:
    """The arrays a kernel reads and writes; built once a run."""

    state: Array
    hints: NDArray[np.int64]
    breaks: Array
    coefficients: Array
    edges: Array
    values: Array
    terms: Array
    failures: Array
    changes: Array
    plant: Array
    now: Array
    drive: Array
    sensing: Told
    acc: Array
    ride: Ride
    log: Array

    def before_law(self) -> tuple[Any, ...]:
        return (self.state, self.hints, self.breaks, self.coefficients, self.edges, self.values, self.terms,
                self.failures, self.changes, self.plant, self.now, self.drive, self.sensing)

    def after_law(self) -> tuple[Any, ...]:
        return self.acc, self.ride.arrays(), self.log


def simulate(scenario: Scenario, name: str, factors: Factors = NOMINAL) -> Run:
    """Run controller `name` of a scenario; a run that leaves a law's domain or diverges is reported failed.

    Raises InputError when the scenario has no such controller or its values cannot be used.
    """
    return simulate_in(scenario, name, setting_of(scenario, factors))


def prepared(scenario: Scenario, name: str) -> Callable[[Setting], Run]:
    """What runs a scenario's controller in one setting after another, as `simulate_in` does: its law is looked up,
    checked and compiled once. Raises InputError as `simulate`."""
    spec = controller_spec(scenario, name)
    law = compiled_law(scenario, spec)
    if law is None:
        return partial(simulate_in, scenario, name)
    return partial(run_law, law, law_values(law, spec, name), period_s=spec.period_s, name=name,
                   title=spec.title or law.title, loop=law_loop(law, spec.estimates), predictor=spec.predictor,
                   timed=False)


def simulate_in(scenario: Scenario, name: str, setting: Setting, plant: Plant | None = None,
                sampled: SampledController | None = None) -> Run:
    """`simulate` in a setting, and with a plant, that may differ from the scenario's, which are what controllers know.

    plant: as in `run_law`; the setting's plant_values belong to it. sampled: the controller itself, of one that is
    called once a sample and is more than its parameters.
    """
    spec = controller_spec(scenario, name)
    law = compiled_law(scenario, spec)
    if law is not None:
        return run_law(law, law_values(law, spec, name), setting, spec.period_s, spec.estimates, name,
                       spec.title or law.title, plant, predictor=spec.predictor)
    sampled, plan = sampled or SAMPLED[spec.law](scenario, spec, name), setting.plan(spec.period_s)
    title = spec.title or sampled.title
    if (whole := whole_run(sampled)) is not None:
        return _run_whole(whole, setting, spec, name, title, plant)
    # The kernel holds what it is told; noise and delays lie between it and the controller.
    arrays, sensing = _arrays(replace(setting, sensing=PERFECT), spec.period_s, held_command), setting.sensing
    between = sensing.arrays(-(-plan[0] // plan[1]), spec.period_s)
    status, reached, step_us = _run_sampled(law_loop(held_command, plant=plant).closed_loop, arrays, sampled,
                                            _fixed(setting), plan, between)
    return _run(name, title, held_command, arrays, plan, (status, reached, step_us),
                _why(status, reached * plan[2], arrays.state, held_command, spec.law), sampled.counters)


def _run_whole(whole: WholeRun, setting: Setting, spec: ControllerSpec, name: str, title: str, plant: Plant | None
               ) -> Run:
    """A run of MPC that the compiled loop calls itself; every sample is timed all the same."""
    arrays, plan = _arrays(setting, spec.period_s, held_command), setting.plan(spec.period_s)
    values = whole.parameters, np.zeros(0), np.zeros((0, 0)), whole.numbers
    kernel = mpc_loop(whole.controller.problem.actuator, plant).closed_loop
    status, reached = _run_compiled(kernel, arrays, values, _fixed(setting), plan)
    whole.take_over()
    return _run(name, title, held_command, arrays, plan, (status, reached, whole.taken_us(-(-reached // plan[1]))),
                _why(status, reached * plan[2], arrays.state, held_command, spec.law), whole.controller.counters)


def run_law(law: ControlLaw, values: tuple[Array, Array, Array, Array], setting: Setting, period_s: float,
            estimates: Estimates = "corrected", name: str = "", title: str = "", plant: Plant | None = None,
            loop: LawLoop | None = None, predictor: bool = False, timed: bool = True) -> Run:
    """Run a compiled law once; one that leaves its domain or diverges is reported failed.

    values: the law's parameters, initial scalar states, initial neuron states and neuron data, as `law_values` gives
    them; plant: of position, speed, force, opposing force, mass and Davis coefficients, in the order of
    `single_particle`, which it is unless given; the setting's plant_values come after these. loop: compiled already,
    of a law that is more than its expressions; it may write into the neuron data. predictor: the law is told the state
    at which its command takes effect, predicted over the delay of the setting's actuator. timed: afterwards the law is
    asked again at states that the run met, so that the time of its step is known; else the run says none.
    Raises WorkbenchError where the values are not those of the law's states.
    """
    if len(values[1]) != len(law.scalar_states):  # a kernel writes them into rows of the log, whose width the law says
        raise WorkbenchError(f"{law.id}: {len(values[1])} initial values for {len(law.scalar_states)} states of one "
                             "number each: give one value a state")
    arrays, plan = _arrays(setting, period_s, law, predictor), setting.plan(period_s)
    parameters, scalars, neurons, data = values
    if data.dtype != np.float64 or not data.flags.c_contiguous:  # the law gets them by their address
        raise WorkbenchError(f"{law.id}: neuron data must be floats that lie row by row in memory: "
                             "take numpy.ascontiguousarray of them")
    loop = loop or law_loop(law, estimates, plant)
    # The kernel advances states in place, and the caller's values are for other runs too.
    own = (np.ascontiguousarray(parameters), scalars.copy(), neurons.copy(), data)
    status, reached = _run_compiled(loop.closed_loop, arrays, own, _fixed(setting), plan)
    run = _run(name or law.id, title or law.title, law, arrays, plan, (status, reached, np.zeros(0)),
               _why(status, reached * plan[2], arrays.state, law, law.id), {})
    if not timed:
        return run
    again = own[0], scalars, neurons, data
    return replace(run, step_us=law_step_us(loop.answer, run.log, plan[1] * plan[2], again))


@cache
def _text(expression: Any) -> str:
    """As sympy says it, which takes longer than a short run takes."""
    return str(expression)


def _power(expression: Any) -> str:
    return _text(expression).replace("**", "^")


def _fixed(setting: Setting) -> tuple[float, float]:
    return setting.position_band_m, setting.nominal_mass_kg


def _run(name: str, title: str, law: ControlLaw, arrays: _Arrays, plan: tuple[int, int, float, int],
         ended: tuple[int, int, Array], failed: str | None, counters: dict[str, int]) -> Run:
    _, per_sample, dt, log_every = plan
    _, reached, step_us = ended
    return Run(
        controller=name, title=title, columns=(*LOG_COLUMNS, *(_text(s.symbol) for s in law.scalar_states)),
        log=arrays.log[: max(1, min(len(arrays.log), (reached - 1) // log_every + 1))],
        totals=dict(zip(ACCUMULATORS, arrays.acc.tolist(), strict=True)) | arrays.ride.totals() |
        drive_totals(arrays.drive),
        final_position_m=float(arrays.state[0]), end_s=reached * dt, failed=failed, step_us=step_us,
        period_s=per_sample * dt, counters=counters,
    )


def _arrays(setting: Setting, period_s: float, law: ControlLaw, predictor: bool = False) -> _Arrays:
    steps, _, _, log_every = setting.plan(period_s)
    acc = np.zeros(len(ACCUMULATORS))
    for name in ("position_error_max", "speed_error_max", "command_max_mps2"):
        acc[ACCUMULATORS.index(name)] = -np.inf
    for name in ("position_error_min", "speed_error_min", "command_min_mps2", "speed_min_mps"):
        acc[ACCUMULATORS.index(name)] = np.inf
    state = np.zeros(4)
    state[0] = setting.initial_position_m
    own = np.array([setting.mass_kg, *setting.davis_n, *setting.plant_values])
    return _Arrays(
        state=state, hints=np.zeros(2, dtype=np.int64), breaks=setting.curve.breaks_s,
        coefficients=setting.curve.coefficients, edges=setting.line.position_m, values=setting.line.pieces(),
        terms=setting.terms, failures=setting.failures, changes=setting.changes,
        plant=own, now=own.copy(),
        drive=drive(setting.limits, setting.actuator, setting.plant_step_s, setting.mass_kg,
                    (setting.known or Known(setting.nominal_mass_kg, setting.davis_n)) if predictor else None),
        sensing=setting.sensing.arrays(-(-steps // max(1, round(period_s / setting.plant_step_s))), period_s), acc=acc,
        ride=ride(setting.plant_step_s, setting.speed_limits),
        log=np.zeros((steps // log_every + 1, len(LOG_COLUMNS) + len(law.scalar_states))),
    )


def _run_compiled(kernel: Any, arrays: _Arrays, law: tuple[Array, Array, Array, Array],
                  fixed: tuple[float, float], plan: tuple[int, int, float, int]) -> tuple[int, int]:
    """Whole blocks of samples at a time, so that a run can be interrupted; how it ended, and the steps done."""
    steps, per_sample, dt, log_every = plan
    before_law, after_law = arrays.before_law(), arrays.after_law()
    first, status = 0, RUNNING
    while first < steps and status == RUNNING:
        count = min(per_sample * BLOCK, steps - first)
        status, first = kernel(first, count, per_sample, dt, *before_law, *fixed, *law, *after_law, log_every)
    return status, first


def _run_sampled(kernel: Any, arrays: _Arrays, controller: SampledController, fixed: tuple[float, float],
                 plan: tuple[int, int, float, int], sensing: Told) -> tuple[int, int, Array]:
    """One call of the controller a sample; the kernel integrates the plant between them."""
    steps, per_sample, dt, log_every = plan
    command = np.zeros(1)
    empty = np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0))
    before_law, after_law, step_us = arrays.before_law(), arrays.after_law(), np.zeros(-(-steps // per_sample))
    first, status = 0, RUNNING
    for sample in range(len(step_us)):
        before = time.perf_counter()
        told = sensing_loop.measured(sample, arrays.state[0], arrays.state[1], sensing)
        asked = controller.command(first * dt, *told)
        step_us[sample] = (time.perf_counter() - before) * 1e6
        command[0] = sensing_loop.delayed(sample, asked, sensing[2])
        status, first = kernel(first, min(per_sample, steps - first), per_sample, dt, *before_law, *fixed,
                               command, *empty, *after_law, log_every)
        if status != RUNNING:
            return status, first, step_us[: sample + 1]
    return status, first, step_us


def _why(status: int, at_s: float, state: Array, law: ControlLaw, law_id: str) -> str | None:
    # A run that diverged may be far away.
    s, v = (f"{value:.3f}" if abs(value) < 1e6 else f"{value:.3e}" for value in state[:2])
    where = f"at t = {at_s:.3f} s, s = {s} m, v = {v} m/s"
    if status == LEFT_DOMAIN:
        return f"{law_id} left its domain ({', '.join(f'{_power(d)} > 0' for d in law.domain)}) {where}"
    if status == DIVERGED:
        return f"{law_id} diverged {where}"
    return None


__all__ = ["LEVEL", "NOMINAL", "UNLIMITED", "Factors", "Run", "Setting", "check_controllers", "law_values", "run_law",
           "setting_of", "simulate"]

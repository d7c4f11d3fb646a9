"""One run: a scenario's train on its line under one controller, sampled as stated."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.compile import kernel_module
from workbench.controllers.base import ControlLaw
from workbench.controllers.registry import LAWS, SAMPLED, SampledController, held_command
from workbench.controllers.values import check_controllers, controller_spec, law_values
from workbench.scenario import Scenario
from workbench.simulate import kernel_loop
from workbench.simulate.kernel_loop import ACCUMULATORS, DIVERGED, LEFT_DOMAIN, LOG_COLUMNS, RUNNING
from workbench.track import resistance_table
from workbench.train import single_particle

TIMED_BLOCK = 1000

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Factors:
    """How the true train and line differ from the nominal ones that controllers may know; 1 is nominal."""

    mass: float = 1.0
    davis_a: float = 1.0
    davis_b: float = 1.0
    davis_c: float = 1.0
    line_resistance: float = 1.0


NOMINAL = Factors()


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


@dataclass
class _Arrays:
    """The arrays a kernel reads and writes; built once a run."""

    state: Array
    hints: NDArray[np.int64]
    breaks: Array
    coefficients: Array
    edges: Array
    values: Array
    sine: Array
    plant: Array
    limits: Array
    acc: Array
    log: Array

    def before_law(self) -> tuple[Any, ...]:
        return (self.state, self.hints, self.breaks, self.coefficients, self.edges, self.values, self.sine,
                self.plant, self.limits)


def simulate(scenario: Scenario, name: str, factors: Factors = NOMINAL) -> Run:
    """Run controller `name` of a scenario; a run that leaves a law's domain or diverges is reported failed.

    Raises InputError when the scenario has no such controller or its values cannot be used.
    """
    spec = controller_spec(scenario, name)
    curve = scenario.desired_curve()
    dt = scenario.simulation.plant_step_s
    steps = round((curve.trip_time_s + scenario.simulation.dwell_s) / dt)
    per_sample = round(spec.period_s / dt)
    log_every = max(1, round(scenario.simulation.log_every_s / dt))
    law = LAWS.get(spec.law, held_command)
    width = len(LOG_COLUMNS) + len(law.scalar_states)
    arrays = _arrays(scenario, factors, np.zeros((steps // log_every + 1, width)))
    kernel = kernel_module(single_particle(), law, kernel_loop, spec.estimates).closed_loop
    fixed = (scenario.simulation.position_band_m, scenario.train.mass_kg)
    counters: dict[str, int] = {}
    if spec.law in LAWS:
        status, reached, step_us = _run_compiled(kernel, arrays, law_values(law, spec, name), fixed,
                                                 (steps, per_sample, dt, log_every))
    else:
        sampled = SAMPLED[spec.law](scenario, spec, name)
        status, reached, step_us = _run_sampled(kernel, arrays, sampled, fixed,
                                                (steps, per_sample, dt, log_every))
        counters = sampled.counters
    return Run(
        controller=name, title=spec.title or (law.title if spec.law in LAWS else sampled.title),
        columns=(*LOG_COLUMNS, *(str(s.symbol) for s in law.scalar_states)),
        log=arrays.log[: max(1, min(len(arrays.log), (reached - 1) // log_every + 1))],
        totals=dict(zip(ACCUMULATORS, arrays.acc.tolist(), strict=True)),
        final_position_m=float(arrays.state[0]), end_s=reached * dt,
        failed=_why(status, reached * dt, arrays.state, law, spec.law), step_us=step_us,
        period_s=spec.period_s, counters=counters,
    )


def _arrays(scenario: Scenario, factors: Factors, log: Array) -> _Arrays:
    curve, train = scenario.desired_curve(), scenario.train
    table = resistance_table(scenario.track)
    a, b, c = train.davis_newton
    acc = np.zeros(len(ACCUMULATORS))
    for name in ("position_error_max", "speed_error_max", "command_max_mps2"):
        acc[ACCUMULATORS.index(name)] = -np.inf
    for name in ("position_error_min", "speed_error_min", "command_min_mps2", "speed_min_mps"):
        acc[ACCUMULATORS.index(name)] = np.inf
    disturbance = scenario.disturbance
    return _Arrays(
        state=np.zeros(4), hints=np.zeros(2, dtype=np.int64), breaks=curve.breaks_s,
        coefficients=curve.coefficients, edges=table.position_m,
        values=table.specific_force * factors.line_resistance,
        sine=np.array([disturbance.amplitude_mps2, 2 * np.pi / disturbance.period_s]),
        plant=np.array([train.mass_kg * factors.mass, a * factors.davis_a, b * factors.davis_b,
                        c * factors.davis_c]),
        limits=np.array([train.max_traction_n, train.max_braking_n, train.max_power_w or np.inf]),
        acc=acc, log=log,
    )


def _run_compiled(kernel: Any, arrays: _Arrays, law: tuple[Array, Array, Array, Array],
                  fixed: tuple[float, float], plan: tuple[int, int, float, int]) -> tuple[int, int, Array]:
    """Whole blocks of samples at a time, so that the time per control step can be told."""
    steps, per_sample, dt, log_every = plan
    block = per_sample * TIMED_BLOCK
    # No step at all, so that loading or compiling the kernel is not timed as part of the first block.
    kernel(0, 0, per_sample, dt, *arrays.before_law(), *fixed, *law, arrays.acc, arrays.log, log_every)
    taken, first, status = [], 0, RUNNING
    while first < steps and status == RUNNING:
        count = min(block, steps - first)
        before = time.perf_counter()
        status, reached = kernel(first, count, per_sample, dt, *arrays.before_law(), *fixed, *law, arrays.acc,
                                 arrays.log, log_every)
        taken.append((time.perf_counter() - before) * 1e6 / max(1, (reached - first) // per_sample))
        first = reached
    return status, first, np.array(taken)


def _run_sampled(kernel: Any, arrays: _Arrays, controller: SampledController, fixed: tuple[float, float],
                 plan: tuple[int, int, float, int]) -> tuple[int, int, Array]:
    """One call of the controller a sample; the kernel integrates the plant between them."""
    steps, per_sample, dt, log_every = plan
    command = np.zeros(1)
    empty = np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0))
    before_law, step_us = arrays.before_law(), np.zeros(-(-steps // per_sample))
    first, status = 0, RUNNING
    for sample in range(len(step_us)):
        before = time.perf_counter()
        command[0] = controller.command(first * dt, arrays.state[0], arrays.state[1])
        step_us[sample] = (time.perf_counter() - before) * 1e6
        status, first = kernel(first, min(per_sample, steps - first), per_sample, dt, *before_law, *fixed,
                               command, *empty, arrays.acc, arrays.log, log_every)
        if status != RUNNING:
            return status, first, step_us[: sample + 1]
    return status, first, step_us


def _why(status: int, at_s: float, state: Array, law: ControlLaw, law_id: str) -> str | None:
    where = f"at t = {at_s:.3f} s, s = {state[0]:.3f} m, v = {state[1]:.3f} m/s"
    if status == LEFT_DOMAIN:
        return f"{law_id} left its domain ({', '.join(f'{d} > 0' for d in law.domain)}) {where}"
    if status == DIVERGED:
        return f"{law_id} diverged {where}"
    return None


__all__ = ["NOMINAL", "Factors", "Run", "check_controllers", "law_values", "simulate"]

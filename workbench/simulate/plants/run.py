"""One run of a plant under a law or a sampled controller: what happened, what it is measured by, why it ended."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from workbench.simulate.plants.arrays import Arrays, Compiled, arrays_of, compiled
from workbench.simulate.plants.endings import why
from workbench.simulate.plants.measures import metrics_of
from workbench.simulate.plants.plant_loop import LAW_OUTSIDE, NO_COMMAND, RUNNING
from workbench.simulate.plants.solver import advance_by_solver
from workbench.systems.law import StateLaw
from workbench.systems.parameter import checked_value
from workbench.systems.setting import Setting, limits_of
from workbench.systems.symbols import is_finite, plain

Array = NDArray[np.float64]


class SampledController(Protocol):
    """What is called once a sample, as MPC is; made anew for each run."""

    def command(self, t: float, measured: Array) -> Any:
        """One number an input, in the plant's order, from the outputs as measured at t (s)."""


@dataclass(frozen=True)
class Entrant:
    """A controller with its values, as it enters a run: a law, or `build(setting)` that makes a sampled controller.

    parameters and initial: of a law, by name; what `build` is given holds the nominal parameters, whatever the truth.
    """

    name: str
    period_s: float
    law: StateLaw | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    initial: Mapping[str, float] = field(default_factory=dict)
    build: Callable[[Setting, float], SampledController] | None = None

    def __post_init__(self) -> None:
        if (self.law is None) == (self.build is None):
            raise ValueError(f"controller '{self.name}': give either a law or what builds a controller")
        object.__setattr__(self, "period_s", plain(self.period_s))
        if not (is_finite(self.period_s) and self.period_s > 0):
            raise ValueError(f"controller '{self.name}': period_s = {self.period_s}: give a positive number of seconds")

    def check(self, setting: Setting) -> None:
        """ValueError unless the controller fits the plant and samples at whole plant steps."""
        every = setting.steps_of(self.period_s, f"controller '{self.name}': period_s")
        count = setting.duration_s / self.period_s
        if every < 1 or round(count) < 1 or abs(count - round(count)) > 1e-6:
            raise ValueError(f"controller '{self.name}': duration_s = {setting.duration_s:g} s is no whole number of "
                             f"periods of {self.period_s:g} s: choose a multiple")
        for name, late in setting.late_s.items():
            if abs(late / self.period_s - round(late / self.period_s)) > 1e-6:
                raise ValueError(f"late_s.{name} = {late:g} s is no whole number of the {self.period_s:g} s at which "
                                 f"'{self.name}' samples: choose a multiple")
        if self.law is not None:
            self.law.check(setting.plant)
            for reference in self.law.references:
                if reference.name not in setting.references:
                    raise ValueError(f"law '{self.law.id}' follows reference '{reference.name}', which is not stated: "
                                     f"state references.{reference.name}")
            for symbol in self.law.state_symbols:
                if str(symbol) in setting.references:  # a column of the log each
                    raise ValueError(f"law '{self.law.id}': its state '{symbol}' has the name of a reference: rename "
                                     "one")
            self.law.values(setting.plant, setting.plant.values(), self.parameters)
            states = {str(symbol): symbol for symbol in self.law.state_symbols}
            for name, value in self.initial.items():
                if name not in states:
                    raise ValueError(f"initial value of '{name}', which is no state of law '{self.law.id}': name "
                                     f"one of {', '.join(states) or 'none'}")
                checked_value(states[name], value, f"controller '{self.name}': initial value of '{name}'")


@dataclass(frozen=True)
class Happened:
    """An event of a run: when, which, and the plant's states just after it."""

    t_s: float
    id: str
    states: tuple[float, ...]


@dataclass(frozen=True)
class PlantRun:
    """What a controller did: its log, a row an instant, and its metrics by name; failed says why it ended early.

    columns: t_s, states, inputs as they act, commands (`<input>_wanted`), signals by name, the law's states. step_us:
    microseconds of a control step; of a law with the plant's integration, of a sampled controller alone, the 99th
    percentile of which is step_us_p99. fallbacks: samples at which a sampled controller had to do without its solver.
    events: in the order in which they happened. period_s: how often it commands. ahead_s: how far ahead it is told what
    the references will be; a law is told what they are. at_zero: disturbances that a sampled controller takes for zero.
    """

    name: str
    period_s: float
    columns: tuple[str, ...]
    log: Array
    metrics: Mapping[str, float | None]
    failed: str | None
    reached_s: float
    step_us: float
    step_us_p99: float
    fallbacks: int = 0
    events: tuple[Happened, ...] = ()
    ahead_s: float = 0.0
    at_zero: tuple[str, ...] = ()

    @cached_property
    def data(self) -> dict[str, Array]:
        """The log's columns by name."""
        return dict(zip(self.columns, self.log.T, strict=True))

    def column(self, name: str) -> Array:
        """A column of the log; KeyError with the names there are."""
        if name not in self.data:
            raise KeyError(f"'{name}' is no column of the run: name one of {', '.join(self.columns)}")
        return self.data[name]


def run(setting: Setting, entrant: Entrant, nominal: Mapping[str, float] | None = None) -> PlantRun:
    """Run one controller; nominal: what it believes of the parameters, the plant's own values unless given.

    Raises ValueError where controller and setting do not fit, CompileError where an expression has no code.
    """
    entrant.check(setting)
    believed = dict(setting.plant.values() if nominal is None else nominal)
    law, found = entrant.law, compiled(setting, entrant.law)
    states, values = _law_values(setting, entrant, believed)
    arrays = arrays_of(setting, found, states)
    samples, every = round(setting.duration_s / entrant.period_s), round(entrant.period_s / setting.step_s)
    outputs = [*map(str, setting.plant.outputs)]
    late = np.array([round(setting.late_s.get(name, 0.0) / entrant.period_s) for name in outputs], np.int64)
    deviations = np.array([setting.noise.get(name, 0.0) for name in outputs])
    noise = np.zeros((samples, len(outputs)))
    if deviations.any():  # drawing zeros takes a tenth of a quick run
        noise = np.random.default_rng(setting.seed).normal(size=noise.shape) * deviations
    loop = _Loop(entrant.name, setting, found, arrays, every, noise, late)
    if law is not None and setting.integrator == "rk4":
        status, done, taken, fallbacks, ahead_s, at_zero = *loop.compiled_law(samples, states, values), 0, 0.0, ()
    else:
        # A controller is built with what it believes: the truth is not its to know.
        own = _Interpreted(found, entrant.period_s, states, values, arrays) if law is not None else (
            _built(entrant, setting.varied(parameters=believed)))
        status, done, taken = loop.sampled(samples, own)
        fallbacks, ahead_s = int(getattr(own, "fallbacks", 0)), float(getattr(own, "ahead_s", 0.0))
        at_zero = tuple(getattr(own, "at_zero", ()))
    arrays.told[:] = states  # in the log's last row, as in all others, what the next command would be taken from
    return replace(_told(setting, entrant, found, arrays, status, done, taken), fallbacks=fallbacks, ahead_s=ahead_s,
                   at_zero=at_zero)


def _built(entrant: Entrant, setting: Setting) -> SampledController:
    assert entrant.build is not None
    return entrant.build(setting, entrant.period_s)


def _law_values(setting: Setting, entrant: Entrant, believed: Mapping[str, float]) -> tuple[Array, Array]:
    law = entrant.law
    if law is None:
        return np.zeros(0), np.zeros(0)
    own = {str(symbol): value for symbol, value in law.initial.items()} | dict(entrant.initial)
    values = law.values(setting.plant, believed, entrant.parameters)
    return (np.array([own.get(str(symbol), 0.0) for symbol in law.state_symbols], dtype=float),
            np.array([*values.values()], dtype=float))


@dataclass
class _Loop:
    """The sampled loop of one run, by compiled code or sample by sample."""

    name: str
    setting: Setting
    found: Compiled
    arrays: Arrays
    every: int
    noise: Array
    late: NDArray[np.int64]

    def __post_init__(self) -> None:
        self.h, self.states = self.setting.step_s, len(self.setting.plant.states)
        self.limits = limits_of(self.setting)
        self.measured = np.zeros(len(self.setting.plant.outputs))
        self.seen = np.zeros((int(self.late.max(initial=0)) + 1, len(self.measured)))

    def compiled_law(self, samples: int, states: Array, values: Array) -> tuple[int, int, Array]:
        """The whole run in one call."""
        a, command = self.arrays, np.zeros(len(self.arrays.u))

        def go(count: int) -> tuple[int, int]:
            found: tuple[int, int] = self.found.loop.closed_loop(
                self.found.plant, self.found.law, count, self.every, self.h, self.states, a.x, a.wanted, a.u,
                a.u_middle, a.u_end, a.delays, a.ring, a.fade_half, a.fade_full, *self.limits, *a.for_signals(), a.log,
                a.log_every, a.told, self.measured, self.noise, self.late, self.seen, states, values, command,
                a.commanded)
            return found

        go(0)  # so that loading the code is not timed
        before = clock.perf_counter()
        status, done = go(samples)
        return status, done, np.array([(clock.perf_counter() - before) * 1e6 / max(1, done // self.every)])

    def sampled(self, samples: int, controller: SampledController) -> tuple[int, int, Array]:
        """Sample by sample: the controller is called, the plant is moved by compiled code or a solver."""
        loop, plant, a = self.found.loop, self.found.plant, self.arrays
        taken, kept = np.zeros(samples), len(self.seen)
        for sample in range(samples):
            t, first = sample * self.every * self.h, sample * self.every
            loop.asked(plant, loop.OUTPUTS, t, a.x, a.x, a.x, a.p, self.measured)
            self.seen[sample % kept] = self.measured + self.noise[sample]
            told = np.array([self.seen[max(sample - late, 0) % kept, i] for i, late in enumerate(self.late)])
            loop.signal_values(t, t, a.table, a.pieces, a.s)
            before = clock.perf_counter()
            wanted = self._asked(controller, t, told)
            taken[sample] = (clock.perf_counter() - before) * 1e6
            if isinstance(controller, _Interpreted) and controller.outside:
                return LAW_OUTSIDE, first, taken[:sample + 1]
            if not loop.limited(wanted, *self.limits, a.wanted, a.commanded):
                return NO_COMMAND, first, taken[:sample + 1]
            if self.setting.integrator == "rk4":
                status, done = loop.advance(plant, first, self.every, self.h, self.states, *a.for_advance())
            else:
                status, done = advance_by_solver(self.found, self.setting, first, self.every, a)
            if status != RUNNING:
                return status, first + done, taken[:sample + 1]
        return RUNNING, samples * self.every, taken

    def _asked(self, controller: SampledController, t: float, told: Array) -> Array:
        """The command, one number an input; ValueError for anything else, and where the controller raises."""
        try:
            wanted = np.asarray(controller.command(t, told), dtype=float).ravel()
        except Exception as trouble:  # whatever a user's controller does
            what = " ".join(f"'{self.name}' fails at t = {t:.4g} s ({type(trouble).__name__}: {trouble})".split())
            raise ValueError(f"controller {what}: correct it") from trouble
        if len(wanted) != len(self.arrays.u):
            raise ValueError(f"controller '{self.name}' gives {len(wanted)} numbers at t = {t:.4g} s: give one for "
                             f"each input, {', '.join(map(str, self.setting.plant.inputs)) or 'none'}")
        return wanted


class _Interpreted:
    """A compiled law, called sample by sample."""

    def __init__(self, found: Compiled, period_s: float, states: Array, values: Array, arrays: Arrays) -> None:
        self._found, self._period, self._states, self._values, self._arrays = found, period_s, states, values, arrays
        self.outside = False

    def command(self, t: float, measured: Array) -> Any:
        """The law's command; its states move by one period."""
        out = np.zeros(len(self._arrays.u))
        self._arrays.told[:] = self._states
        self.outside = not self._found.loop.law_answer(
            self._found.law, t, self._period, measured, self._arrays.s, self._states, self._values, out) > 0
        return out


def _told(setting: Setting, entrant: Entrant, found: Compiled, a: Arrays, status: int, done: int,
          taken: Array) -> PlantRun:
    t, n = done * setting.step_s, len(setting.plant.states)
    found.loop.signal_values(t, t, a.table, a.pieces, a.s)
    rows = -(-done // a.log_every)
    if status == RUNNING and done % a.log_every == 0:
        found.loop.record(t, n, a.x, a.u, a.wanted, a.s, a.told, a.log, rows)
        rows += 1
    plant, law = setting.plant, entrant.law
    columns = ("t_s", *map(str, plant.states), *map(str, plant.inputs), *(f"{u}_wanted" for u in plant.inputs),
               *setting.signals, *(map(str, law.state_symbols) if law else ()))
    return PlantRun(entrant.name, entrant.period_s, columns, a.log[:rows], metrics_of(setting, a, t, status == RUNNING),
                    why(setting, entrant.name, law, status, t, a), t, float(np.median(taken)),
                    float(np.percentile(taken, 99)), events=_events(setting, a))


def _events(setting: Setting, a: Arrays) -> tuple[Happened, ...]:
    names = [event.id for event in setting.plant.events]
    return tuple(Happened(t, names[int(which)], tuple(states))
                 for t, which, *states in a.event_log[:a.event_count[0]].tolist())

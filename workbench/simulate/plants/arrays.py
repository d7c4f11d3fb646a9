"""A setting as the arrays that the compiled loop moves, and a plant with its metrics and a law as C functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from inspect import signature
from types import ModuleType
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.compile.code_cache import c_function
from workbench.compile.kernel import loop_module
from workbench.compile.text import loop_text
from workbench.compile.vector_code import into_array, jump_step, rates_into, runge_kutta_step, smallest
from workbench.errors import CompileError
from workbench.model.law import period, time
from workbench.simulate.plants import event_loop, law_call, plant_call, plant_loop
from workbench.simulate.plants.event_code import event_functions
from workbench.simulate.plants.event_loop import MOST_IN_A_RUN
from workbench.simulate.plants.plant_call import QUESTIONS
from workbench.systems.declared import sign_margins
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting, first_inputs
from workbench.systems.signals import table_of

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]
SAMPLED = {"t": time, "T_s": period}  # what a law's functions are given before their arrays


@dataclass(frozen=True)
class Compiled:
    """A compiled plant and law, the loop that calls them, and how metrics are taken.

    loop: compiled once for all plants; plant and law: C functions, as it calls them; integrands and extremes: of the
    metrics that are integrated, and of which a largest value is kept.
    """

    loop: ModuleType
    plant: Any
    law: Any
    integrands: tuple[sp.Expr, ...]
    extremes: tuple[sp.Expr, ...]


class _Subject:
    """What a C function is made of: the same plant and law, as objects, with the same metrics and signals."""

    def __init__(self, setting: Setting, law: StateLaw | None = None) -> None:
        self.setting, self.law = setting, law
        self._key = (id(setting.plant), id(law), () if law else setting.every_metric, tuple(setting.signals))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Subject) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


def compiled(setting: Setting, law: StateLaw | None) -> Compiled:
    """The loop of a plant in a setting under a law; one without a law cannot run as a whole.

    Raises CompileError, which names both, for an expression that has no code.
    """
    metrics = setting.every_metric
    integrands = tuple(m.integrand for m in metrics if m.integrand is not None)
    extremes = tuple(m.watched for m in metrics if m.watched is not None)
    try:
        plant = _plant(_Subject(setting), integrands, extremes)
        called = None if law is None else _law(_Subject(setting, law))
        return Compiled(_loop(bool(setting.plant.events)), plant, called, integrands, extremes)
    except CompileError as trouble:
        raise CompileError(f"plant '{setting.plant.id}'{f' under law {law.id!r}' if law else ''}: {trouble}") from None


@cache
def _loop(with_events: bool) -> ModuleType:
    """With the step in which events happen, which takes long to compile too, or with one that is never called."""
    given = ", ".join(signature(event_loop.step_with_events).parameters)
    step = loop_text(event_loop) if with_events else f"def step_with_events({given}):\n    return 0\n"
    return loop_module(f"a plant with{'' if with_events else 'out'} events", [QUESTIONS, step], plant_loop)


@lru_cache(maxsize=64)  # writing the code takes longer than many a run; the subject kept holds the plant alive
def _plant(subject: _Subject, integrands: tuple[sp.Expr, ...], extremes: tuple[sp.Expr, ...]) -> Any:
    setting, plant = subject.setting, subject.setting.plant
    given = {"u": plant.inputs, "s": setting.signal_symbols, "p": plant.parameter_symbols}
    every = {"x": plant.states, **given}
    step = jump_step(tuple(plant.updates), integrands, plant.states, given) if plant.updates else (
        runge_kutta_step([*plant.rates, *integrands], plant.states, given))
    count = len(plant.states) + len(integrands)
    source = [
        QUESTIONS, step, rates_into(count, given),
        into_array("plant_outputs", list(plant.outputs.values()), {"x": plant.states, "p": plant.parameter_symbols}),
        smallest("plant_margin", (*plant.domain, *sign_margins(plant.states)), every),
        into_array("extreme_values", extremes, every), *event_functions(plant, every)]
    return c_function(loop_module(f"plant {plant.id}", source, plant_call), "answer", plant_call.ANSWER)


@lru_cache(maxsize=64)
def _law(subject: _Subject) -> Any:
    setting, law = subject.setting, subject.law
    assert law is not None
    source = law_functions(law, setting.plant, setting.signal_symbols)
    return c_function(loop_module(f"law {law.id}", source, law_call), "answer", law_call.ANSWER)


def law_functions(law: StateLaw, plant: Plant, signals: Sequence[sp.Symbol]) -> list[str]:
    """Source of law_step(t, T_s, y, s, q, c, out), which moves the states q and puts a command an input of the plant
    into out, and of law_margin(t, T_s, y, s, q, c), positive in the law's domain; signals: what s holds."""
    arrays = {"y": [*plant.outputs], "s": signals, "q": law.state_symbols, "c": law.parameters}
    commands = [law.commands[symbol] for symbol in plant.inputs]
    targets = [*(f"q[{i}]" for i in range(len(law.states))), *(f"out[{i}]" for i in range(len(commands)))]
    return [into_array("law_step", [*law.next_values, *commands], arrays, SAMPLED, targets),
            smallest("law_margin", (*law.domain, *sign_margins(law.state_symbols)), arrays, SAMPLED)]


@dataclass
class Arrays:
    """The state of a run as arrays, in the order in which `advance` takes them."""

    x: Array
    wanted: Array
    commanded: Array
    u: Array
    u_middle: Array
    u_end: Array
    delays: IntArray
    ring: Array
    fade_half: Array
    fade_full: Array
    table: Array
    pieces: Array
    s: Array
    s_middle: Array
    s_end: Array
    p: Array
    extremes: Array
    values: Array
    sides: Array
    crossing: Array
    slopes: Array
    event_log: Array
    event_count: IntArray
    moved: Array
    inputs: Array
    event_signals: Array
    log: Array
    log_every: int
    told: Array

    def for_advance(self) -> tuple[Any, ...]:
        """The arguments of `advance` after the number of states."""
        return (self.x, self.wanted, self.u, self.u_middle, self.u_end, self.delays, self.ring, self.fade_half,
                self.fade_full, *self.for_signals(), self.log, self.log_every, self.told)

    def for_signals(self) -> tuple[Any, ...]:
        """Signals, parameters, extremes and events."""
        return (self.table, self.pieces, self.s, self.s_middle, self.s_end, self.p, self.extremes, self.values,
                self.sides, self.crossing, self.slopes, self.event_log, self.event_count, self.moved, self.inputs,
                self.event_signals)


def arrays_of(setting: Setting, found: Compiled, law_states: Array) -> Arrays:
    """The arrays at time zero; inputs that lag or are delayed begin as the setting says."""
    plant, m, first = setting.plant, len(setting.plant.inputs), first_inputs(setting)
    x = np.zeros(len(plant.states) + len(found.integrands))
    x[:len(plant.states)] = [setting.initial.get(str(s), 0.0) for s in plant.states]
    delays = np.array([setting.steps_of(setting.delay_s.get(str(s), 0.0), "delay_s") for s in plant.inputs], np.int64)
    lags = [setting.lag_s.get(str(s), 0.0) for s in plant.inputs]
    half, full = (np.array([math.exp(-setting.step_s * share / lag) if lag else 0.0 for lag in lags])
                  for share in (0.5, 1.0))
    table, pieces = table_of(list(setting.signals.values()))
    every = max(1, setting.steps_of(setting.log_every_s, "log_every_s")) if setting.log_every_s else log_step(setting)
    rows = math.ceil(round(setting.duration_s / setting.step_s) / every) + 1
    columns = 1 + len(plant.states) + 2 * m + len(table) + len(law_states)
    size, count = 4 * len(table), len(plant.events)
    sides = np.array([(0.0, *event.sides, 0.0) for event in plant.events]).reshape(count, 4)
    return Arrays(
        x=x, wanted=np.zeros(m), commanded=np.zeros((3, m)), u=first.copy(), u_middle=np.zeros(m), u_end=np.zeros(m),
        delays=delays, ring=np.tile(first, (int(delays.max(initial=0)) + 1, 1)), fade_half=half, fade_full=full,
        table=table, pieces=pieces,
        s=np.zeros(size), s_middle=np.zeros(size), s_end=np.zeros(size),
        p=np.array([*setting.parameters.values()], dtype=float), extremes=np.full(len(found.extremes), -math.inf),
        values=np.zeros(len(found.extremes)), sides=sides, crossing=np.zeros(count), slopes=np.zeros(count),
        event_log=np.zeros((MOST_IN_A_RUN if count else 0, 2 + len(plant.states))), event_count=np.zeros(1, np.int64),
        moved=np.zeros(len(x)), inputs=np.zeros((3, m)), event_signals=np.zeros((3, size)),
        log=np.zeros((rows, columns)), log_every=every, told=law_states.copy())


def log_step(setting: Setting) -> int:
    """Plant steps between two rows of the log, where none is stated: some thousand rows a run."""
    return max(1, round(setting.duration_s / setting.step_s) // 1000)

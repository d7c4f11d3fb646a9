"""What a run of a plant is made with: values, initial state, signals, duration, steps, sensing, actuators, metrics."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, get_args

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.systems.declared import contradicted, sign_margins
from workbench.systems.law import Reference
from workbench.systems.metric import COMMANDED, Metric
from workbench.systems.parameter import checked_value
from workbench.systems.plant import Plant
from workbench.systems.signals import AnySignal, Constant, Step, signal_of, signals_at
from workbench.systems.symbols import (
    CLOCK,
    is_finite,
    named_values,
    plain,
    require_distinct,
    require_known,
    several,
    written,
)

Array = NDArray[np.float64]
Integrator = Literal["rk4", "radau", "bdf", "lsoda"]
MOST_STEPS = 100_000_000
INSTANTS = 2001  # at which a disturbance is held against its symbol's sign
UNSTATED, A_MILLISECOND = math.nan, 1e-3  # the step where none is given: a plant's own, else a millisecond


@dataclass(frozen=True)
class Setting:
    """Everything but the controller; names are those of the plant's symbols, times are in seconds.

    parameters: true values instead of the plant's own; initial: states that are not zero, and inputs before the first
    command, which lags and delays begin with and MPC changes from; references and disturbances: a signal each,
    disturbances zero where none is given; tracks: output to the reference that it shall follow; noise: standard
    deviation of each output's measurement, drawn anew at each sample from `seed`; late_s: how old a measurement is;
    lag_s: time constant of an input; delay_s: of an input; step_s: of the plant, a millisecond unless given, in
    discrete time its own; integrator: classical Runge-Kutta of fixed step, or a solver of scipy for stiff plants.
    Raises ValueError, one line naming what does not fit.
    """

    plant: Plant
    duration_s: float
    step_s: float = UNSTATED
    log_every_s: float | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    initial: Mapping[str, float] = field(default_factory=dict)
    references: Mapping[str, AnySignal] = field(default_factory=dict)
    disturbances: Mapping[str, AnySignal] = field(default_factory=dict)
    tracks: Mapping[str, str] = field(default_factory=dict)
    noise: Mapping[str, float] = field(default_factory=dict)
    late_s: Mapping[str, float] = field(default_factory=dict)
    lag_s: Mapping[str, float] = field(default_factory=dict)
    delay_s: Mapping[str, float] = field(default_factory=dict)
    metrics: tuple[Metric, ...] = ()
    seed: int = 0
    integrator: Integrator = "rk4"

    def __post_init__(self) -> None:
        plant = self.plant
        for name in ("duration_s", "step_s", "log_every_s"):
            object.__setattr__(self, name, plain(getattr(self, name)))
        object.__setattr__(self, "step_s", self._step())
        self._check_times()
        self._check_integrator()
        object.__setattr__(self, "parameters", plant.values(self.parameters))
        outputs, inputs = [*map(str, plant.outputs)], [*map(str, plant.inputs)]
        for key in ("references", "disturbances"):
            object.__setattr__(self, key, {_name(name): signal_of(value, f"{key}.{_name(name)}")
                                           for name, value in named_values(getattr(self, key), key).items()})
        object.__setattr__(self, "tracks", {name: _name(channel)
                                            for name, channel in named_values(self.tracks, "tracks").items()})
        object.__setattr__(self, "metrics", several(self.metrics, "metrics", Metric, "Metric(id, measure, expression)"))
        for key, kind, names in (("initial", "state or input", [*map(str, plant.states), *inputs]),
                                 ("disturbances", "disturbance", [*map(str, plant.disturbances)]),
                                 ("tracks", "output", outputs), ("noise", "output", outputs),
                                 ("late_s", "output", outputs), ("lag_s", "input", inputs),
                                 ("delay_s", "input", inputs)):
            object.__setattr__(self, key, {_name(name): plain(value)
                                           for name, value in named_values(getattr(self, key), key).items()})
            self._require_names(key, kind, names)
        self._check_numbers()
        require_distinct({**plant.names, "a reference": [symbol for one in self.channels for symbol in one.symbols]},
                         f"references of plant '{plant.id}'")
        for name, value in self.delay_s.items():
            self.steps_of(value, f"delay_s.{name}")
        self._check_jumps()
        self._check_disturbances()
        for name, channel in self.tracks.items():
            if channel not in self.references:
                raise ValueError(f"tracks.{name} = '{channel}' is no reference: state references.{channel}")
        names = [metric.id for metric in self.metrics]
        if len(set(names)) < len(names):
            raise ValueError(f"two metrics are called '{max(names, key=names.count)}': rename one")
        # A metric may name an output: it is of what is there, not of what was measured with noise or late.
        seen = {symbol: value for symbol, value in plant.outputs.items() if symbol != value}
        object.__setattr__(self, "metrics", tuple(
            replace(one, expression=one.expression.xreplace(seen)) for one in self.metrics))
        require_known({f"metric '{m.id}'": m.expression for m in self.metrics}, self.symbols, f"plant '{plant.id}'")
        for metric in self.metrics:
            if metric.measure in COMMANDED and metric.expression not in plant.inputs:
                raise ValueError(f"metric '{metric.id}': measure '{metric.measure}' is of an input as it is commanded: "
                                 f"name one of {', '.join(map(str, plant.inputs)) or 'none'}")

    def _check_times(self) -> None:
        for name in ("duration_s", "step_s"):
            if not (is_finite(getattr(self, name)) and getattr(self, name) > 0):
                raise ValueError(f"{name} = {written(getattr(self, name))}: give a positive number of seconds")
        if self.log_every_s is not None:
            if not (is_finite(self.log_every_s) and self.log_every_s > 0):
                raise ValueError(f"log_every_s = {written(self.log_every_s)}: give a positive number of seconds")
            self.steps_of(self.log_every_s, "log_every_s")
        if self.duration_s / self.step_s > MOST_STEPS:
            raise ValueError(f"duration_s / step_s is more than {MOST_STEPS}: take a longer step")
        if self.duration_s < self.step_s:
            raise ValueError(f"duration_s = {self.duration_s:g} is shorter than one step of {self.step_s:g} s: give "
                             "more")

    def _check_numbers(self) -> None:
        for key in ("noise", "late_s", "lag_s", "delay_s", "initial"):
            for name, value in getattr(self, key).items():
                if not is_finite(value) or (key != "initial" and value < 0):
                    raise ValueError(f"{key}.{name} = {written(value)}: give a finite number"
                                     f"{'' if key == 'initial' else ' that is not negative'}")
        for symbol in self.plant.states:
            if str(symbol) in self.initial:
                checked_value(symbol, self.initial[str(symbol)], f"initial.{symbol}")
        for symbol, (low, high) in self.plant.input_limits.items():
            # A stated number is never changed silently: within its limits alone can an input begin.
            first = self.initial.get(str(symbol), low)
            if not low <= first <= high:
                raise ValueError(f"initial.{symbol} = {written(first)} is outside the input's limits, {low:g} to "
                                 f"{high:g}: give a value within them")
        for key in ("late_s", "delay_s"):
            for name, value in getattr(self, key).items():
                if value > self.duration_s:
                    raise ValueError(f"{key}.{name} = {written(value)}: nothing arrives within {self.duration_s:g} s: "
                                     "give less, or a longer duration_s")
        if not isinstance(self.seed, int | np.integer) or isinstance(self.seed, bool) or self.seed < 0:
            raise ValueError(f"seed = {self.seed!r}: give a whole number that is not negative")

    def _check_jumps(self) -> None:
        """ValueError for a jump within a step of a continuous plant: it would come with the next step, unasked."""
        for key in ("references", "disturbances") if not self.plant.updates else ():
            for name, signal in getattr(self, key).items():
                if isinstance(signal, Step) and 0 < signal.at_s < self.duration_s:
                    self.steps_of(signal.at_s, f"{key}.{name}: at_s")

    def _check_disturbances(self) -> None:
        """ValueError for a disturbance that takes values which its symbol is declared not to take."""
        for symbol in self.plant.disturbances if sign_margins(self.plant.disturbances) else ():
            values = signals_at({"d": self.signals[str(symbol)]}, np.linspace(0.0, self.duration_s, INSTANTS))["d"][0]
            for value in (values.min(), values.max()):
                # Zero, which it has where nothing is stated, is what no sign forbids.
                if value and (kind := contradicted(symbol, value)):
                    raise ValueError(f"disturbances.{symbol} takes the value {value:g}, but the symbol is declared "
                                     f"{kind}: correct one of them")

    def _step(self) -> float:
        own = self.plant.step_s
        unstated = isinstance(self.step_s, float) and math.isnan(self.step_s)
        if own is not None and not unstated and self.step_s != own:
            raise ValueError(f"step_s = {written(self.step_s)}: plant '{self.plant.id}' moves in steps of {own:g} s: "
                             "leave it out")
        return (own or A_MILLISECOND) if unstated else self.step_s

    def _check_integrator(self) -> None:
        if self.integrator not in get_args(Integrator):
            raise ValueError(f"integrator '{self.integrator}' is not known: it is one of "
                             f"{', '.join(get_args(Integrator))}")
        if self.plant.updates and self.integrator != "rk4":
            raise ValueError(f"integrator '{self.integrator}': plant '{self.plant.id}' moves in steps: leave it out")
        if self.plant.events and self.integrator != "rk4":
            raise ValueError(f"integrator '{self.integrator}': plant '{self.plant.id}' has events, which are located "
                             "within Runge-Kutta steps alone: take 'rk4' and a short step_s")

    def _require_names(self, key: str, kind: str, names: list[str]) -> None:
        for name in getattr(self, key):
            if name not in names:
                raise ValueError(f"{key}.{name}: plant '{self.plant.id}' has no {kind} of that name: name one of "
                                 f"{', '.join(names) or 'none'}")

    def steps_of(self, seconds: float, where: str) -> int:
        """How many plant steps a time is; ValueError where it is no whole number of them."""
        count = round(seconds / self.step_s)
        if abs(seconds / self.step_s - count) > 1e-6:
            raise ValueError(f"{where} = {seconds:g} s is no whole number of plant steps of {self.step_s:g} s: choose "
                             "a multiple")
        return count

    @property
    def channels(self) -> tuple[Reference, ...]:
        """The references, in order."""
        return tuple(Reference(name) for name in self.references)

    @property
    def signals(self) -> dict[str, AnySignal]:
        """All signals by name: the plant's disturbances, then the references."""
        zero = Constant(value=0.0)
        return {**{str(d): self.disturbances.get(str(d), zero) for d in self.plant.disturbances}, **self.references}

    @property
    def signal_symbols(self) -> tuple[sp.Symbol, ...]:
        """Four symbols a signal; of a disturbance only the first one can be used."""
        hidden = [(d, *(sp.Dummy(f"{d}_rate", real=True) for _ in range(3))) for d in self.plant.disturbances]
        return tuple(symbol for four in (*hidden, *(channel.symbols for channel in self.channels)) for symbol in four)

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """What metrics may use."""
        plant = self.plant
        return (*CLOCK[:1], *plant.states, *plant.inputs, *plant.disturbances, *plant.parameter_symbols,
                *(symbol for channel in self.channels for symbol in channel.symbols))

    @property
    def every_metric(self) -> tuple[Metric, ...]:
        """The stated metrics, and those that every run has: tracking errors, effort, and excess over state limits."""
        plant, found = self.plant, list(self.metrics)
        channel = {one.name: one.value for one in self.channels}
        outputs = {str(symbol): (symbol, value) for symbol, value in plant.outputs.items()}
        for name, reference in self.tracks.items():
            symbol, value = outputs[name]
            error, unit = value - channel[reference], plant.units.get(symbol, "")
            found += [Metric(f"{name}_error_rms", "root mean square", error, unit, f"{name} error RMS"),
                      Metric(f"{name}_error_largest", "largest", sp.Abs(error), unit, f"{name} error largest"),
                      Metric(f"{name}_error_final", "terminal", error, unit, f"{name} error final")]
        found += [Metric(f"{symbol}_rms", "root mean square", symbol, plant.units.get(symbol, ""), f"{symbol} RMS")
                  for symbol in plant.inputs]
        for symbol in plant.inputs:
            unit = plant.units.get(symbol, "")
            found.append(Metric(f"{symbol}_variation", "variation", symbol, f"{unit}/s" if unit else "1/s",
                                f"{symbol} variation"))
            if any(map(math.isfinite, plant.input_limits.get(symbol, ()))):
                found.append(Metric(f"{symbol}_saturated", "saturated", symbol, "", f"{symbol} saturated"))
        for symbol, (low, high) in plant.state_limits.items():
            sides = [side for bound, side in ((low, low - symbol), (high, symbol - high)) if math.isfinite(bound)]
            found.append(Metric(f"{symbol}_limit_excess", "largest", sp.Max(0, *sides), plant.units.get(symbol, ""),
                                f"{symbol} limit excess"))
        stated = {metric.id for metric in self.metrics}
        return tuple(metric for number, metric in enumerate(found)
                     if number < len(self.metrics) or metric.id not in stated)

    def varied(self, **changes: Any) -> Setting:
        """The same setting with other fields."""
        return replace(self, **changes)


def _name(key: object) -> str:
    """The name of a symbol, of a reference, or what is a name already."""
    return key.name if isinstance(key, Reference) else str(key)


def limits_of(setting: Setting) -> tuple[Array, Array]:
    """The inputs' lower and upper limits, infinite where there is none."""
    plant = setting.plant
    pairs = [plant.input_limits.get(symbol, (-math.inf, math.inf)) for symbol in plant.inputs]
    return np.array([low for low, _ in pairs], dtype=float), np.array([high for _, high in pairs], dtype=float)


def first_inputs(setting: Setting) -> Array:
    """The inputs before the first command: as the setting says, else the number nearest to zero within their limits."""
    stated = [setting.initial.get(str(u), 0.0) for u in setting.plant.inputs]
    return np.clip(np.array(stated, dtype=float), *limits_of(setting))

"""A plant of n states and m inputs, stated once as expressions: prover, kernel and casadi model are made from it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.compile.vector_code import numeric_vector
from workbench.model.law import time
from workbench.systems.declared import require_no_whole, require_outputs_signed, require_signs_kept
from workbench.systems.derivatives import jacobian_at
from workbench.systems.event import Event
from workbench.systems.parameter import Parameter, checked_value
from workbench.systems.symbols import (
    Limits,
    expression,
    in_order_of,
    interval,
    is_finite,
    named_values,
    plain,
    require_distinct,
    require_known,
    several,
    symbols_of,
    written,
)


@dataclass(frozen=True)
class Plant:
    """x' = rates(t, x, u, d, p), y = outputs(x, p), with n states, m inputs and any number of disturbances.

    rates: one expression a state, in their order or as {state: expression}; of a plant in discrete time instead
    updates, the states one step later, and step_s, the seconds between two; outputs: what can be measured, symbol to
    expression, the states themselves where none is given; limits of inputs saturate them, limits of states are what MPC
    keeps and what a run is measured against; domain: expressions that must stay positive, a run ends where one is not;
    events: what resets states in a run, where an expression crosses zero; units: of states, inputs, outputs and
    disturbances. Raises ValueError, one line, for what fits not together.
    """

    id: str
    states: Sequence[sp.Symbol]
    rates: Sequence[Any] | Mapping[sp.Symbol, Any] = ()
    inputs: Sequence[sp.Symbol] = ()
    disturbances: Sequence[sp.Symbol] = ()
    parameters: Sequence[Parameter] = ()
    outputs: Mapping[sp.Symbol, Any] = field(default_factory=dict)
    input_limits: Mapping[sp.Symbol, Limits] = field(default_factory=dict)
    state_limits: Mapping[sp.Symbol, Limits] = field(default_factory=dict)
    domain: Sequence[Any] = ()
    events: Sequence[Event] = ()
    units: Mapping[sp.Symbol, str] = field(default_factory=dict)
    title: str = ""
    source: str = ""
    updates: Sequence[Any] | Mapping[sp.Symbol, Any] = ()
    step_s: float | None = None

    def __post_init__(self) -> None:
        where = f"plant '{self.id}'"
        put = object.__setattr__
        for name in ("states", "inputs", "disturbances"):
            put(self, name, symbols_of(getattr(self, name), f"{where}: {name}"))
        put(self, "parameters", several(self.parameters, f"{where}: parameters", Parameter, "Parameter(symbol, value)"))
        if not self.states:
            raise ValueError(f"{where} has no state: name at least one")
        for name in ("rates", "updates"):
            put(self, name, in_order_of(self.states, getattr(self, name), f"{where}: {name}"))
        kind = self._require_one_kind(where)
        for name in ("rates", "updates"):
            given = several(getattr(self, name), f"{where}: {name}")
            if given and len(given) != len(self.states):
                raise ValueError(f"{where} has {len(self.states)} states and {len(given)} {name}: give one {kind} a "
                                 "state, in their order")
            put(self, name, tuple(expression(value, f"{where}: {kind} of '{state}'")
                                  for state, value in zip(self.states, given, strict=bool(given))))
        put(self, "outputs", self._outputs(where))
        put(self, "domain", tuple(expression(value, f"{where}: domain")
                                  for value in several(self.domain, f"{where}: domain")))
        require_distinct(self.names, where)
        known = (*self.states, *self.inputs, *self.disturbances, *self.parameter_symbols)
        require_known({f"the {kind} of '{s}'": e for s, e in zip(self.states, self.moves, strict=True)}, known, where)
        require_known({f"output '{s}'": value for s, value in self.outputs.items()},
                      (*self.states, *self.parameter_symbols), where)
        require_known({f"domain expression {e}": e for e in self.domain}, known, where)
        self._check_events(where, known)
        put(self, "input_limits", self._limits(self.input_limits, self.inputs, "input"))
        require_signs_kept(self.input_limits, self.inputs, where)
        require_outputs_signed(self.outputs, where)
        moving = [s for s, e in zip(self.states, self.moves, strict=True) if e != (s if self.updates else 0)]
        require_no_whole((*moving, *self.inputs, *self.disturbances), where)
        put(self, "state_limits", self._limits(self.state_limits, self.states, "state"))
        put(self, "units", named_values(self.units, f"{where}: units", (*known, *self.outputs)))
        for symbol in self.units:
            if symbol not in (*known, *self.outputs):
                raise ValueError(f"{where}: units name '{symbol}', which the plant does not have: leave it out")
            if not isinstance(self.units[symbol], str):
                raise ValueError(f"{where}: the unit of '{symbol}' is {self.units[symbol]!r}, no text: write 'm' or "
                                 "such")

    def _require_one_kind(self, where: str) -> str:
        """"rate" or "update"; ValueError unless it is one of them, with a step for updates alone."""
        rated, updated = (len(several(values, f"{where}: {name}")) > 0 for values, name in (
            (self.rates, "rates"), (self.updates, "updates")))
        if rated == updated:
            raise ValueError(f"{where} has {'both rates and updates' if rated else 'no rates'}: give rates, or updates "
                             "with step_s for a plant in discrete time")
        step = self.step_s
        if updated and not (isinstance(step, int | float) and not isinstance(step, bool) and 0 < step < math.inf):
            raise ValueError(f"{where}: step_s = {step}: give the seconds between two updates, a positive number")
        if rated and step is not None:
            raise ValueError(f"{where}: step_s is for updates: leave it out, or give these instead of rates")
        if updated and self.events:
            raise ValueError(f"{where}: events are crossings in continuous time: state cases in the updates instead")
        return "rate" if rated else "update"

    def _outputs(self, where: str) -> dict[sp.Symbol, sp.Expr]:
        stated: Any = self.outputs
        if not isinstance(stated, Mapping):  # a list of the states that are measured
            stated = {symbol: symbol for symbol in several(stated, f"{where}: outputs")}
        symbols_of([*stated], f"{where}: outputs")
        given = {symbol: expression(value, f"{where}: output '{symbol}'") for symbol, value in stated.items()}
        for symbol, value in given.items():
            for other in sorted(value.free_symbols & {*self.inputs, *self.disturbances}, key=str):
                raise ValueError(f"{where}: output '{symbol}' uses '{other}', and an output is of states and "
                                 "parameters alone: make a state of what is measured")
        return given or {symbol: symbol for symbol in self.states}

    def _check_events(self, where: str, known: Sequence[sp.Symbol]) -> None:
        object.__setattr__(self, "events", several(self.events, f"{where}: events", Event,
                                                   "Event(id, expression, {state: value})"))
        names = [event.id for event in self.events]
        for event in self.events:
            if names.count(event.id) > 1:
                raise ValueError(f"{where}: two events are called '{event.id}': rename one")
            for symbol in event.reset:
                if symbol not in self.states:
                    raise ValueError(f"{where}: event '{event.id}' resets '{symbol}', which is no state: name one of "
                                     f"{', '.join(map(str, self.states))}")
            require_known({f"event '{event.id}'": event.expression,
                           **{f"event '{event.id}': reset of '{s}'": e for s, e in event.reset.items()}}, known, where)

    def _limits(self, limits: Mapping[sp.Symbol, Limits], symbols: Iterable[sp.Symbol],
                kind: str) -> dict[sp.Symbol, Limits]:
        found = named_values(limits, f"plant '{self.id}': limits of {kind}s", symbols)
        for symbol in found:
            if symbol not in symbols:
                raise ValueError(f"plant '{self.id}': limits of '{symbol}', which is no {kind}: name one of "
                                 f"{', '.join(map(str, symbols)) or 'none'}")
        return {symbol: interval(pair, f"plant '{self.id}': limits of {kind} '{symbol}'")
                for symbol, pair in found.items()}

    @property
    def parameter_symbols(self) -> tuple[sp.Symbol, ...]:
        """The parameters' symbols, in their order."""
        return tuple(parameter.symbol for parameter in self.parameters)

    @property
    def names(self) -> dict[str, Sequence[sp.Symbol]]:
        """All that the plant and a log of its runs call by a name, by what it is."""
        return {"a state": self.states, "an input": self.inputs, "a disturbance": self.disturbances,
                "a parameter": self.parameter_symbols,
                "an output": [symbol for symbol, value in self.outputs.items() if symbol != value],
                "a column of the log": [sp.Symbol(name) for name in ("t_s", *(f"{u}_wanted" for u in self.inputs))]}

    @property
    def moves(self) -> tuple[sp.Expr, ...]:
        """Rates, or in discrete time updates: one expression a state."""
        return tuple(self.rates) or tuple(self.updates)

    @property
    def flow(self) -> dict[sp.Expr, sp.Expr]:
        """State to rate, as a goal of the prover takes it; where rates name time, it is to be given the rate one too.

        Raises ValueError for a plant in discrete time.
        """
        if self.updates:
            raise ValueError(f"plant '{self.id}' moves in steps and has no rates: take next_values(plant, law)")
        return dict(zip(self.states, self.rates, strict=True))

    def values(self, given: Mapping[str, Any] | None = None) -> dict[str, float]:
        """Every parameter's value by its name, those in `given` instead of the plant's own.

        Raises ValueError for a name that is no parameter, and a value that does not fit its symbol.
        """
        found = {str(parameter.symbol): parameter.value for parameter in self.parameters}
        by_name = {str(symbol): symbol for symbol in self.parameter_symbols}
        for name, value in (given or {}).items():
            if str(name) not in by_name:
                raise ValueError(f"'{name}' is no parameter of plant '{self.id}': name one of {', '.join(by_name)}")
            found[str(name)] = checked_value(by_name[str(name)], value, f"parameter '{name}'")
        return found

    def rates_at(self, states: Sequence[float], inputs: Sequence[float] = (), *, disturbances: Sequence[float] = (),
                 parameters: Mapping[str, Any] | None = None, t: float = 0.0) -> NDArray[np.float64]:
        """x' at a point, of a plant in discrete time its next state: an array of n numbers.

        Raises ValueError unless there is a number for each state and, where any is given, each input and disturbance.
        """
        for kind, given, symbols in (("states", states, self.states), ("inputs", inputs, self.inputs),
                                     ("disturbances", disturbances, self.disturbances)):
            numbers = not isinstance(given, Mapping) and all(isinstance(one, Real) for one in given)
            if not numbers or (len(given) != len(symbols) and (len(given) or kind == "states")):
                raise ValueError(f"plant '{self.id}': {kind} = {given}: give a list of {len(symbols)} numbers, "
                                 f"{', '.join(map(str, symbols)) or 'none'}")
        return np.array(self._numeric(self.moves)(t, *states, *self._all(inputs, self.inputs),
                                                  *self._all(disturbances, self.disturbances),
                                                  *self.values(parameters).values()), dtype=float)

    @staticmethod
    def _all(values: Sequence[float], symbols: Sequence[sp.Symbol]) -> Sequence[float]:
        return values if len(values) else [0.0] * len(symbols)

    def _numeric(self, exprs: Sequence[sp.Expr]) -> Any:
        return numeric_vector((*self.states, *self.inputs, *self.disturbances, *self.parameter_symbols), exprs)

    def linearise(self, at: Mapping[str, float] | None = None, parameters: Mapping[str, Any] | None = None) -> Any:
        """The linear plant about a point, states and inputs by their names (zero where none is given), at time zero.

        A `control.StateSpace` with the exact derivatives; its inputs are the plant's. Raises ValueError for a name
        that is no state and no input, and a point where there is no derivative.
        """
        import control  # noqa: PLC0415 - takes half a second, which no other user of a plant pays

        if not self.inputs:
            raise ValueError(f"plant '{self.id}' has no input, which a StateSpace needs: give it one that does nothing")
        A, B, C, D = self.jacobians(at, parameters)
        return control.ss(A, B, C, D, states=[*map(str, self.states)], inputs=[*map(str, self.inputs)],
                          outputs=[*map(str, self.outputs)], dt=self.step_s or 0)

    def jacobians(self, at: Mapping[str, float] | None = None,
                  parameters: Mapping[str, Any] | None = None) -> tuple[NDArray[np.float64], ...]:
        """A, B, C and D of the linear plant about a point, as `linearise` takes and refuses it."""
        values = {**self._point(at), **dict.fromkeys(map(str, self.disturbances), 0.0), **self.values(parameters)}
        known = {str(s): s for s in (*self.states, *self.inputs, *self.disturbances, *self.parameter_symbols)}
        point = {known[name]: sp.Float(value, 17) for name, value in values.items()} | {time: sp.Integer(0)}
        try:
            return tuple(jacobian_at(rows, by, point) for rows in (self.moves, [*self.outputs.values()])
                         for by in (self.states, self.inputs))
        except ValueError as trouble:
            raise ValueError(f"plant '{self.id}': {trouble}") from None

    def _point(self, at: Mapping[str, float] | None) -> dict[str, float]:
        point = {str(symbol): 0.0 for symbol in (*self.states, *self.inputs)}
        for name, given in named_values(at or {}, "at").items():
            value = plain(given)
            if str(name) not in point:
                raise ValueError(f"'{name}' is no state and no input of plant '{self.id}': name one of "
                                 f"{', '.join(point)}")
            if not is_finite(value):
                raise ValueError(f"at: '{name}' = {written(value)} is no finite number: give one")
            point[str(name)] = float(value)
        return point

    def to_control(self, parameters: Mapping[str, Any] | None = None) -> Any:
        """A `control.NonlinearIOSystem` with the plant's states, inputs and outputs; disturbances are inputs too."""
        import control  # noqa: PLC0415 - as in `linearise`

        rates, outputs = self._numeric(self.moves), self._numeric(list(self.outputs.values()))
        values = [*self.values(parameters).values()]

        def update(t: float, x: Sequence[float], u: Sequence[float], params: Any) -> NDArray[np.float64]:
            return np.array(rates(t, *x, *u, *values), dtype=float)

        def output(t: float, x: Sequence[float], u: Sequence[float], params: Any) -> NDArray[np.float64]:
            return np.array(outputs(t, *x, *u, *values), dtype=float)

        return control.NonlinearIOSystem(
            update, output, name=self.id.replace(".", "_"), states=[*map(str, self.states)],
            inputs=[*map(str, (*self.inputs, *self.disturbances))], outputs=[*map(str, self.outputs)],
            dt=self.step_s or 0)

    def to_casadi(self, parameters: Mapping[str, Any] | None = None) -> Any:
        """A `casadi.Function` (t, x, u, d) -> x', in discrete time the next x, parameters put in."""
        import casadi as ca  # noqa: PLC0415 - as in `linearise`

        from workbench.compile.casadi_tree import casadi_of  # noqa: PLC0415 - it needs casadi

        t, x, u, d = (ca.SX.sym(name, size) for name, size in (
            ("t", 1), ("x", len(self.states)), ("u", len(self.inputs)), ("d", len(self.disturbances))))
        known = {**dict(zip(self.states, ca.vertsplit(x), strict=True)),
                 **(dict(zip(self.inputs, ca.vertsplit(u), strict=True)) if self.inputs else {}),
                 **(dict(zip(self.disturbances, ca.vertsplit(d), strict=True)) if self.disturbances else {}),
                 **dict(zip(self.parameter_symbols, self.values(parameters).values(), strict=True))}
        name = "updates" if self.updates else "rates"
        return ca.Function(name, [t, x, u, d], [ca.vertcat(*casadi_of(self.moves, known, t))], ["t", "x", "u", "d"],
                           [name])

"""A control law of any plant: outputs, references and its own states in, one command an input out, at every sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

from workbench.compile.parts import free_symbols
from workbench.model.law import LawState, period
from workbench.systems.plant import Plant, checked_value
from workbench.systems.symbols import (
    CLOCK,
    expression,
    named_values,
    require_distinct,
    require_known,
    several,
    symbols_of,
)

ORDERS = ("", "_dot", "_ddot", "_dddot")


@dataclass(frozen=True)
class Reference:
    """A channel of what shall be followed: its value and first three rates at the sample, as symbols."""

    name: str

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise ValueError(f"reference {self.name!r} is no name: write Reference('r')")

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """Value, rate, second rate and third rate."""
        return tuple(sp.Symbol(f"{self.name}{order}", real=True) for order in ORDERS)

    @property
    def value(self) -> sp.Symbol:
        """Where the plant shall be."""
        return self.symbols[0]

    @property
    def rate(self) -> sp.Symbol:
        """How fast that moves."""
        return self.symbols[1]

    @property
    def second_rate(self) -> sp.Symbol:
        """The rate of the rate."""
        return self.symbols[2]

    @property
    def third_rate(self) -> sp.Symbol:
        """The rate of the second rate; of splines it jumps at their knots."""
        return self.symbols[3]


@dataclass(frozen=True)
class StateLaw:
    """commands: input to expression, over a plant's outputs, references, time, parameters and the law's own states.

    states: with a `rate` (one Euler step a sampling period) or an `update` (the next value); the command is taken from
    the states before they move. initial: their values at time zero, zero where none is given. domain: expressions that
    must stay positive, a run ends where one is not. A parameter that bears the name of one of the plant's takes its
    nominal value unless another is given. Raises ValueError, one line, for what fits not together.
    """

    id: str
    commands: Mapping[sp.Symbol, Any]
    states: Sequence[LawState] = ()
    parameters: Sequence[sp.Symbol] = ()
    references: Sequence[Reference] = ()
    initial: Mapping[sp.Symbol, float] = field(default_factory=dict)
    domain: Sequence[Any] = ()
    title: str = ""
    source: str = ""
    information: str = ""

    def __post_init__(self) -> None:
        where, put = f"law '{self.id}'", object.__setattr__
        symbols_of([*named_values(self.commands, f"{where}: commands")], f"{where}: commands")
        put(self, "commands", {symbol: expression(value, f"{where}: command of '{symbol}'")
                               for symbol, value in self.commands.items()})
        put(self, "states", tuple(self._state(state) for state in several(
            self.states, f"{where}: states", LawState, "LawState(symbol, rate=...) or LawState(symbol, update=...)")))
        put(self, "parameters", symbols_of(self.parameters, f"{where}: parameters"))
        put(self, "references", several(self.references, f"{where}: references", Reference, "Reference('r')"))
        put(self, "domain", tuple(expression(value, f"{where}: domain")
                                  for value in several(self.domain, f"{where}: domain")))
        require_distinct({"a state": self.state_symbols, "a parameter": self.parameters, "an input": [*self.commands],
                          "a reference": self.reference_symbols}, where)
        put(self, "initial", named_values(self.initial, f"{where}: initial", self.state_symbols))
        for symbol, value in self.initial.items():
            if symbol not in self.state_symbols:
                raise ValueError(f"{where}: initial value of '{symbol}', which is no state of it: leave it out")
            checked_value(symbol, value, f"{where}: initial value of '{symbol}'")

    def _state(self, state: LawState) -> LawState:
        where = f"law '{self.id}': state '{state.symbol}'"
        symbols_of([state.symbol], where)
        what = {"rate": state.rate} if state.update is None else {"update": state.update}
        return replace(state, **{key: expression(value, f"{where}: {key}") for key, value in what.items()})

    @property
    def state_symbols(self) -> tuple[sp.Symbol, ...]:
        """The symbols of its states."""
        return tuple(state.symbol for state in self.states)

    @property
    def reference_symbols(self) -> tuple[sp.Symbol, ...]:
        """The symbols of all its references, four a channel."""
        return tuple(symbol for reference in self.references for symbol in reference.symbols)

    @property
    def next_values(self) -> tuple[sp.Expr, ...]:
        """What each state is one period later."""
        return tuple(state.update if state.update is not None else state.symbol + period * state.rate
                     for state in self.states)

    @property
    def flow(self) -> dict[sp.Expr, sp.Expr]:
        """State to rate of its differential states, as a goal of the prover takes it."""
        return {state.symbol: state.rate for state in self.states if state.rate is not None}

    def check(self, plant: Plant) -> None:
        """ValueError unless the law commands inputs of the plant, every one of them, from what can be measured."""
        where = f"law '{self.id}'"
        if not self.commands and plant.inputs:
            raise ValueError(f"{where} commands nothing: name an input of its plant")
        for symbol in self.commands:
            if symbol not in plant.inputs:
                raise ValueError(f"{where} commands '{symbol}', which is no input of plant '{plant.id}': name one of "
                                 f"{', '.join(map(str, plant.inputs)) or 'none'}")
        for symbol in plant.inputs:
            if symbol not in self.commands:
                raise ValueError(f"{where} has no command for input '{symbol}' of plant '{plant.id}': add it, 0 where "
                                 "it is not used")
        self._require_own_names(plant)
        known = (*plant.outputs, *self.parameters, *self.state_symbols, *self.reference_symbols)
        hidden = {str(state) for state in plant.states if state not in plant.outputs}
        stated = {**{f"the command of '{s}'": e for s, e in self.commands.items()},
                  **{f"state '{s}'": e for s, e in zip(self.state_symbols, self.next_values, strict=True)},
                  **{f"domain expression {e}": e for e in self.domain}}
        for what, expr in stated.items():
            for symbol in sorted(free_symbols(expr) - set(known), key=str):
                if symbol in plant.parameter_symbols:
                    raise ValueError(f"{where}: {what} uses '{symbol}', a parameter of plant '{plant.id}': name it "
                                     "among the law's parameters too, whose value is what the law believes")
                if symbol in plant.disturbances:
                    raise ValueError(f"{where}: {what} uses '{symbol}', a disturbance of plant '{plant.id}', which no "
                                     "law knows: make it a reference where it is foreseen")
                if str(symbol) in hidden:
                    raise ValueError(f"{where}: {what} uses '{symbol}', a state that plant '{plant.id}' does not "
                                     f"measure: use its outputs {', '.join(map(str, plant.outputs))}")
        require_known(stated, known, where, "make it a parameter, a state or a reference of the law", CLOCK)

    def _require_own_names(self, plant: Plant) -> None:
        """ValueError where the law calls what is its own by a name of the plant's: both would be taken for one, and a
        proof of the closed loop would move the plant's state as the law says. Parameters may share names.
        """
        taken = {str(symbol): kind for kind, symbols in plant.names.items() for symbol in symbols}
        shared = {*map(str, plant.parameter_symbols)}
        for what, symbols in (("state", self.state_symbols), ("reference's symbol", self.reference_symbols),
                              ("parameter", [one for one in self.parameters if str(one) not in shared])):
            for symbol in symbols:
                if str(symbol) in taken:
                    raise ValueError(f"law '{self.id}': its {what} '{symbol}' has the name of {taken[str(symbol)]} of "
                                     f"plant '{plant.id}', for which it would be taken: rename it")

    def values(self, plant: Plant, nominal: Mapping[str, float], given: Mapping[str, Any]) -> dict[str, float]:
        """Every parameter's value by its name: as given, else the plant's nominal one.

        Raises ValueError for a name that is no parameter and a parameter without value.
        """
        by_name = {str(symbol): symbol for symbol in self.parameters}
        for name in given:
            if str(name) not in by_name:
                raise ValueError(f"'{name}' is no parameter of law '{self.id}': name one of "
                                 f"{', '.join(by_name) or 'none'}")
        stated = {str(name): value for name, value in given.items()}
        found = {}
        for name, symbol in by_name.items():
            if name not in stated and name not in nominal:
                raise ValueError(f"parameter '{name}' of law '{self.id}' has no value: give one")
            found[name] = checked_value(symbol, stated.get(name, nominal.get(name)), f"parameter '{name}'")
        return found

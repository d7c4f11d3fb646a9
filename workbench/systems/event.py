"""What switches a plant: an expression that crosses zero, and what its states are set to there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

import sympy as sp

from workbench.systems.symbols import expression, named_values, symbols_of

Direction = Literal["falling", "rising", "both"]


@dataclass(frozen=True)
class Event:
    """expression: over a plant's states, inputs, disturbances, parameters and time; it acts where it crosses zero in
    the direction, by moving or by a jump of an input.

    reset: state to its value just after, from the values just before; other states stay. A mode is a state whose rate
    is zero and which resets alone change. Raises ValueError for what is none.
    """

    id: str
    expression: Any
    reset: Mapping[sp.Symbol, Any]
    direction: Direction = "both"

    def __post_init__(self) -> None:
        where = f"event '{self.id}'"
        if self.direction not in get_args(Direction):
            raise ValueError(f"{where}: direction {self.direction!r} is not known: it is one of "
                             f"{', '.join(get_args(Direction))}")
        object.__setattr__(self, "expression", expression(self.expression, where))
        given = named_values(self.reset, f"{where}: reset")
        if not given:
            raise ValueError(f"{where} sets no state: give reset, state to its value just after")
        symbols_of([*given], f"{where}: reset")
        object.__setattr__(self, "reset", {symbol: expression(value, f"{where}: reset of '{symbol}'")
                                           for symbol, value in given.items()})

    @property
    def sides(self) -> tuple[float, float]:
        """Whether it acts as it falls, and as it rises, as one and zero."""
        return float(self.direction != "rising"), float(self.direction != "falling")

    def rate(self, flow: Mapping[sp.Expr, sp.Expr], clock: sp.Symbol) -> sp.Expr:
        """Its rate of change along a flow with inputs and disturbances held: which way it leaves zero."""
        plain = self.expression.rewrite((sp.Min, sp.Max), sp.Piecewise)
        found = sp.Add(sp.diff(plain, clock), *(sp.diff(plain, state) * rate for state, rate in flow.items()))
        return found.replace(sp.DiracDelta, lambda *_: sp.Integer(0)).rewrite(sp.Heaviside, sp.Piecewise)

"""The contract of a control law: sympy expressions in, one command out, at every sampling instant."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import sympy as sp

# What a law may use at a sampling instant: time, measurements, the desired curve, its own period.
time = sp.Symbol("t", real=True)
position, speed = sp.symbols("x_1 x_2", real=True)
desired_position, desired_speed, desired_acceleration = sp.symbols("x_d xdot_d xddot_d", real=True)
period = sp.Symbol("T_s", positive=True)
neuron = sp.Symbol("j", integer=True, positive=True)
neuron_count = sp.Symbol("n_h", integer=True, positive=True)

MEASUREMENTS = (time, position, speed, desired_position, desired_speed, desired_acceleration, period)

Information = Literal["full state, model unknown", "full state, nominal model", "full state, nominal model, the line",
                      "position only, model unknown"]


def over_neurons(summand: sp.Expr) -> sp.Expr:
    """Sum over the hidden neurons j = 1..n_h."""
    return sp.Sum(summand, (neuron, 1, neuron_count))


@dataclass(frozen=True)
class LawState:
    """A state of a law. `rate` for a differential law, or `update` (next value) for a difference law.

    An Indexed symbol (W[j]) stands for one value per hidden neuron.
    """

    symbol: sp.Symbol | sp.Indexed
    rate: sp.Expr | None = None
    update: sp.Expr | None = None

    def __post_init__(self) -> None:
        if (self.rate is None) == (self.update is None):
            raise ValueError(f"law state {self.symbol}: give either its rate or its update")


@dataclass(frozen=True)
class ControlLaw:
    """A law as printed: states, their laws of change, the command u = F/m in m/s^2.

    id: `<paper>.<law>`; source: the equations; domain: expressions that must stay positive for the law to
    be defined (the closed loop reports the first instant at which one is not); initial: values of scalar
    states at t = 0, unless a scenario sets them; neuron_data: per-neuron constants a scenario must give.
    """

    id: str
    title: str
    source: str
    information: Information
    command: sp.Expr
    states: tuple[LawState, ...] = ()
    parameters: tuple[sp.Symbol, ...] = ()
    neuron_data: tuple[sp.Indexed, ...] = ()
    domain: tuple[sp.Expr, ...] = ()
    errors: dict[str, sp.Expr] = field(default_factory=dict)

    @property
    def scalar_states(self) -> tuple[LawState, ...]:
        """The states that are one number each."""
        return tuple(s for s in self.states if not isinstance(s.symbol, sp.Indexed))

    @property
    def neuron_states(self) -> tuple[LawState, ...]:
        """The states that are one number per neuron."""
        return tuple(s for s in self.states if isinstance(s.symbol, sp.Indexed))

    def next_value(self, state: LawState) -> sp.Expr:
        """The state's value one period later: its update, or one Euler step of its rate."""
        return state.update if state.update is not None else state.symbol + period * state.rate

"""The closed loop of a plant and a law as a flow, and functions of its state whose rates are derived along it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from workbench.model.law import period, time
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.symbols import expression


def closed_loop(plant: Plant, law: StateLaw) -> dict[sp.Expr, sp.Expr]:
    """Every moving symbol's rate where the law's command acts at once: states, the law's states, references, time.

    It is what `Goal(flow=...)` takes. Inputs are replaced by the commands, measured outputs by what they measure; input
    limits are left out, and so are events: it is the flow between two of them. Time has a rate where a rate depends on
    it; of a function of time in any other loop a goal is given `flow={**flow, time: 1}`. The third rate of a reference
    and disturbances are inputs of the goal, constants unless it names them so. Raises ValueError where the law does not
    fit the plant, or one of the two moves in steps, which is no flow.
    """
    _require_pair(plant, law)
    law.check(plant)
    for state in law.states:
        if state.rate is None:
            raise ValueError(f"law '{law.id}': state '{state.symbol}' jumps by its update: a closed loop in continuous "
                             "time needs rates")
    measured = {symbol: value for symbol, value in plant.outputs.items() if symbol != value}
    commands = {symbol: value.xreplace(measured) for symbol, value in law.commands.items()}
    flow: dict[sp.Expr, sp.Expr] = {state: rate.xreplace(commands) for state, rate in plant.flow.items()}
    flow |= {state: rate.xreplace(measured) for state, rate in law.flow.items()}
    for reference in law.references:
        value, rate, second, third = reference.symbols
        flow |= {value: rate, rate: second, second: third}
    if any(rate.has(time) for rate in flow.values()):
        flow[time] = sp.Integer(1)
    return flow


def next_values(plant: Plant, law: StateLaw) -> dict[sp.Expr, sp.Expr]:
    """Every state one step later, of a plant in discrete time under a law that samples at each of its steps.

    The law's states are moved as it says, by an Euler step where it has a rate; inputs are replaced by the commands
    and input limits left out. References are as they are now. Raises ValueError for a plant in continuous time, and
    where the law does not fit it.
    """
    _require_pair(plant, law)
    law.check(plant)
    if plant.step_s is None:
        raise ValueError(f"plant '{plant.id}' has rates, not updates: take closed_loop(plant, law)")
    step = {period: sp.nsimplify(plant.step_s, rational=True)}
    measured = {symbol: value for symbol, value in plant.outputs.items() if symbol != value}
    commands = {symbol: value.xreplace(measured | step) for symbol, value in law.commands.items()}
    found: dict[sp.Expr, sp.Expr] = {state: value.xreplace(commands | step)
                                     for state, value in zip(plant.states, plant.updates, strict=True)}
    return found | {state: value.xreplace(measured | step)
                    for state, value in zip(law.state_symbols, law.next_values, strict=True)}


def _require_pair(plant: Plant, law: StateLaw) -> None:
    if not isinstance(plant, Plant) or not isinstance(law, StateLaw):
        raise ValueError(f"given are a {type(plant).__name__} and a {type(law).__name__}: give the Plant, then the law")


@dataclass(frozen=True)
class Lyapunov:
    """A function of a closed loop's state, such as a proof's: `check_paper` holds it against runs of its law."""

    id: str
    value: Any
    law: StateLaw

    def __post_init__(self) -> None:
        object.__setattr__(self, "value", expression(self.value, f"Lyapunov function '{self.id}'"))

    def rate(self, plant: Plant) -> sp.Expr:
        """Its derivative along the closed loop; in discrete time its change in a step.

        Raises ValueError for a function of a reference in discrete time, where what comes next is not known.
        """
        if plant.step_s is not None:
            for symbol in self.law.reference_symbols:
                if symbol in self.value.free_symbols:
                    raise ValueError(f"Lyapunov function '{self.id}' uses reference '{symbol}', whose next value is "
                                     "not known: state it over states alone")
            ahead = {**next_values(plant, self.law), time: time + sp.nsimplify(plant.step_s, rational=True)}
            return self.value.xreplace(ahead) - self.value
        flow = closed_loop(plant, self.law)
        terms = (sp.diff(self.value, symbol) * rate for symbol, rate in flow.items())
        explicit = sp.Integer(0) if time in flow else sp.diff(self.value, time)
        return sp.Add(explicit, *terms)

"""The closed loop of a plant and a law as a flow, and functions of its state whose rates are derived along it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from workbench.model.law import time
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.symbols import expression


def closed_loop(plant: Plant, law: StateLaw) -> dict[sp.Expr, sp.Expr]:
    """Every moving symbol's rate where the law's command acts at once: states, the law's states, references, time.

    It is what `Goal(flow=...)` takes. Inputs are replaced by the commands, measured outputs by what they measure; input
    limits are left out. The third rate of a reference is an input of the goal. Raises ValueError where the law does not
    fit the plant, or has a state with an update, which is no flow.
    """
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


@dataclass(frozen=True)
class Lyapunov:
    """A function of a closed loop's state, such as a proof's: `check_paper` holds it against runs of its law."""

    id: str
    value: Any
    law: StateLaw

    def __post_init__(self) -> None:
        object.__setattr__(self, "value", expression(self.value, f"Lyapunov function '{self.id}'"))

    def rate(self, plant: Plant) -> sp.Expr:
        """Its derivative along the closed loop."""
        flow = closed_loop(plant, self.law)
        terms = (sp.diff(self.value, symbol) * rate for symbol, rate in flow.items())
        explicit = sp.Integer(0) if time in flow else sp.diff(self.value, time)
        return sp.Add(explicit, *terms)

"""Leakage for the laws of mao2018, which the paper mentions but does not print: every estimate forgets at one rate.

With it the step that (65) lacks can be made: V_2 is bounded (claim 65.bounded, gains.py).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sp

from workbench.model.law import ControlLaw, LawState

from . import laws
from .active_mode import rho_k_hat

leak = sp.Symbol("leak", positive=True)  # 1/s


def forgetting(rates: Mapping[sp.Expr, sp.Expr]) -> dict[sp.Expr, sp.Expr]:
    """The rates of estimates with the leakage in them."""
    return {estimate: rate - leak * estimate for estimate, rate in rates.items()}


def leaky(law: ControlLaw) -> ControlLaw:
    """A law whose estimates forget while their mode is active; those of failures, which have no mode, always do."""
    always = {str(symbol) for symbol in (rho_k_hat, *laws.xi_hats)}
    states = []
    for state in law.states:
        name = str(state.symbol)
        indicator = sp.Integer(1) if name in always else laws.indicators[int(name.rpartition("_")[2]) - 1]
        states.append(LawState(state.symbol, rate=state.rate - indicator * leak * state.symbol))
    return replace(law, id=f"{law.id}_leaky", title=f"{law.title}, with leakage", source=f"{law.source} with leakage",
                   states=tuple(states), parameters=(*law.parameters, leak))

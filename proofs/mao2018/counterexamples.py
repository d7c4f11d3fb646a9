"""mao2018: the instants at which printed lines fail."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from workbench.proof.claim import Goal, equal

from .active_mode import (
    Gamma_k,
    Gamma_m,
    Gamma_xi,
    basis,
    chi_d,
    chis,
    d,
    failure_hat,
    hats,
    lambda_0,
    m,
    over_basis,
    rho_0,
    rho_hat,
    trues,
    xi_hat,
)
from .error_dynamics import NAMES, Flow, d_0, failure, k_v, of_mode, over_modes, xi
from .lyapunov import V_idle, m_idle
from .plant import r_1, r_2, xddot_m, z_1

# An easy instant: no resistance, its estimates exact, a constant desired speed, sixteen motors of which one failed.
exact: Flow = dict.fromkeys((*trues, *hats, V_idle, xddot_m), sp.Integer(0))
one_failed: Flow = {k_v: sp.Integer(15), m_idle: m * 3}  # 15 healthy motors, four modes of one mass (section VIII)
# Two motors of which one failed, one mode, rho_i exact: of the faults of (40) none is there, and that of (44) is left alone.
one_left: Flow = {k_v: sp.Integer(1), rho_0: sp.Integer(1), rho_hat: sp.Integer(1), m_idle: sp.Integer(0)}
stopped: Flow = dict.fromkeys((failure, failure_hat, over_basis((xi - xi_hat) ** 2), xi_hat), sp.Integer(0))
unit_gains: Flow = {**dict.fromkeys((r_1, r_2, Gamma_k, Gamma_xi, Gamma_m, m, lambda_0, d_0, chi_d), sp.Integer(1)),
                    d: sp.Integer(0), z_1: sp.Integer(0), rho_0: sp.Integer(15), rho_hat: sp.Rational(1, 15)}


def already(goal: Goal, values: Flow) -> Goal:
    """The goal at an instant at which symbols have these values: false there is false at large.

    A moving one among them must be an exact estimate or z_1 = 0: it enters V_2 by a square that vanishes, so that its
    rate does not matter.
    """
    return Goal(tuple(r.subs(values) for r in goal.show), tuple(r.subs(values) for r in goal.assume),
                {state: rate.xreplace(values) for state, rate in goal.flow.items() if state not in values})


def at_instant(goal: Goal, values: Flow) -> Goal:
    """The goal, its relations as they are printed, at instants at which symbols have these values.

    A symbol of mode i has its value under the sum; the counterexample is one of one mode.
    """
    return replace(goal, assume=(*goal.assume, *(equal(_summed(symbol), value) for symbol, value in values.items())))


full: Flow = dict.fromkeys((*chis, chi_d), sp.Integer(1))  # no ramp of an indicator lasts


def _summed(symbol: sp.Expr) -> sp.Expr:
    if not isinstance(symbol, sp.Indexed):
        return symbol
    return over_basis(symbol) if symbol.indices == (basis,) else over_modes(symbol)


def ramp_time(goal: Goal) -> Goal:
    """The goal while the slope's and a disturbance's ramp last: their indicators are 1/2, the others 1."""
    one, half = sp.Integer(1), sp.Rational(1, 2)
    values: Flow = {of_mode(name): one for name in ("m", "chi_m", *(f"chi_{name}" for name in NAMES))}
    values |= {of_mode(name): half for name in ("chi_vartheta", "chi_d")}
    return at_instant(goal, {x: v for x, v in values.items() if any(r.left.has(x) or r.right.has(x) for r in goal.show)
                             or any(rate.has(x) for rate in goal.flow.values())})


def one_mode(goal: Goal) -> Goal:
    """The goal for one mode of mass 1 that is active, one motor of two, exact estimates of resistance and rho_i."""
    one, zero = sp.Integer(1), sp.Integer(0)
    values: Flow = dict.fromkeys([of_mode(n) for n in ("chi_m", "chi_d", *(f"chi_{name}" for name in NAMES))], one)
    values |= {of_mode(f"log_{name}"): zero for name in ("m", "Gamma_m", "rho_0", *(f"Gamma_{n}" for n in NAMES))}
    values |= {of_mode(name + mark): zero for name in NAMES for mark in ("", "_hat")}
    values |= {of_mode("rho_hat"): one, k_v: one, xddot_m: zero, of_mode("d"): zero,
               of_mode("lambda_0"): one}
    return already(goal, values)


def failing(goal: Goal) -> Goal:
    """The goal at an easy instant, its relations as they are printed."""
    return at_instant(goal, exact | unit_gains | one_left | full)


def error_in_a(goal: Goal) -> Goal:
    """The goal for one mode of mass 1 that is active, with an error in the estimate of a alone."""
    one, zero = sp.Integer(1), sp.Integer(0)
    values: Flow = dict.fromkeys([of_mode(n) for n in ("chi_m", "chi_d", *(f"chi_{name}" for name in NAMES))], one)
    values |= {of_mode(f"log_{name}"): zero for name in ("m", "Gamma_m", *(f"Gamma_{n}" for n in NAMES))}
    values |= {of_mode(name + mark): zero for name in NAMES[1:] for mark in ("", "_hat")}
    return already(goal, values | {of_mode("d"): zero, xddot_m: zero})

"""Exact motions of the closed loops as printed, one neuron each, in which signals grow beyond every bound.

Both rest on the plus sign before the leakage. The driving error stays at c = log(3)/2, where tanh(c) = 1/2, and estimate
and weight grow as exp(t): what they add to the rate of the error cancels. Networks are exact (delta = theta = 0), priors
right, hidden outputs at most 1, and (40) holds. A bounded signal is in the end below t, which the growing ones are not.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from .error_dynamics import (
    delta_tilde,
    observer_loop,
    one_neuron,
    t,
    theta_tilde,
    tracking_loop,
    w_f,
    w_v,
)
from .laws import alpha_2, beta_2, e_v, h_f, h_v, k_1, k_2, k_5, s_tilde, v_tilde

UPDATE_SIGNAL = D(s_tilde) + k_1 * s_tilde  # of (19)-(21), as it is printed

held = sp.log(3) / 2  # tanh(held) = 1/2
hidden_f, hidden_v, weight_f, weight_v = map(one_neuron, (h_f, h_v, w_f, w_v))

_observer = {s_tilde: held / 4, v_tilde: held, delta_tilde: 2 * sp.exp(t) - held / 2, weight_f: sp.exp(t) + held}
_observer_gains = {k_1: sp.Integer(4), k_2: sp.Integer(5)}
_tracking = {e_v: held, theta_tilde: 2 * sp.exp(t) - held, weight_v: held / 2 - 2 * sp.exp(t)}
_tracking_gains = {k_5: sp.Rational(1, 4), beta_2: sp.Rational(1, 2), alpha_2: sp.Integer(2),
                   hidden_v: sp.Rational(1, 2)}
ZERO = ("delta", "theta", "delta_off", "theta_off", "W_f_off", "W_v_off")


def observer_motion(shown: Relation) -> Goal:
    """Along (13), (18)-(21) as printed `shown` holds from some time on."""
    return _motion(observer_loop(), _observer, _observer_gains, (hidden_f,), shown)


def tracking_motion(shown: Relation) -> Goal:
    """Along (13), (18)-(21), (26), (28), (31)-(35) as printed `shown` holds from some time on."""
    return _motion(observer_loop() | tracking_loop(), _observer | _tracking, _observer_gains | _tracking_gains,
                   (hidden_f, hidden_v), shown)


def _motion(loop: dict[sp.Expr, sp.Expr], functions: dict[sp.Expr, sp.Expr], gains: dict[sp.Expr, sp.Expr],
            hidden: tuple[sp.Expr, ...], shown: Relation) -> Goal:
    single = {one_neuron(state): one_neuron(rate) for state, rate in loop.items()}
    rates = {state: sp.Symbol(f"{state}_dot", real=True) for state in single}
    always = tuple(equal(rates[state], rate) for state, rate in single.items())
    constants = {symbol for rate in single.values() for symbol in rate.free_symbols} - set(single)
    model: dict[sp.Expr, sp.Expr] = {symbol: sp.Integer(str(symbol) not in ZERO) for symbol in constants}
    gaussian = tuple(relation for h in hidden for relation in (at_least(h, 0), at_most(h, 1)))
    return Goal((shown,), gaussian, {t: sp.Integer(1)} | rates, (at_least(t, 0), *always), eventually=t,
                model=model | gains | functions, inputs=tuple(rates.values()))

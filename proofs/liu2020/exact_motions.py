"""Exact motions of the closed loops as printed, one neuron each, in which signals grow beyond every bound.

All rest on the plus sign before the leakage. In two of them the driving error stays at c = kappa log(3)/2, where
tanh(c/kappa) = 1/2, and estimate and weight grow as exp(t): what they add to the rate of the error cancels. In the other
two nothing drives the laws, and an estimate alone leaves its prior. Networks are exact (delta = theta = 0), priors right,
hidden outputs at most 1, and (40) holds. A bounded signal is in the end below t, which the growing ones are not.
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
from .laws import alpha_2, beta_2, e_v, h_f, h_v, k_1, k_2, k_5, kappa_1, kappa_2, s_tilde, v_tilde

UPDATE_SIGNAL = D(s_tilde) + k_1 * s_tilde  # of (19)-(21), as it is printed

WIDE = 60  # m/s; of tanh, with which the error stays at 33 m/s
hidden_f, hidden_v, weight_f, weight_v = map(one_neuron, (h_f, h_v, w_f, w_v))

_at_rest = {s_tilde: sp.Integer(0), v_tilde: sp.Integer(0), delta_tilde: sp.exp(t), weight_f: sp.Integer(0)}
_tracking_at_rest = {e_v: sp.Integer(0), theta_tilde: sp.exp(t), weight_v: sp.Integer(0)}
_rest_gains = {k_1: sp.Integer(1), k_2: sp.Integer(2)}
ZERO = ("delta", "theta", "delta_off", "theta_off", "W_f_off", "W_v_off")


def observer_motion(shown: Relation, width: int = WIDE) -> Goal:
    """Along (13), (18)-(21) as printed `shown` holds from some time on."""
    return _motion(observer_loop(), *_driven_observer(width), (hidden_f,), shown)


def tracking_motion(shown: Relation, width: int = WIDE) -> Goal:
    """Along (13), (18)-(21), (26), (28), (31)-(35) as printed `shown` holds from some time on."""
    functions, gains = _driven_observer(width)
    c = width * sp.log(3) / 2
    functions |= {e_v: c, theta_tilde: 2 * sp.exp(t) - c, weight_v: c / 2 - 2 * sp.exp(t)}
    gains |= {k_5: sp.Rational(1, 4), beta_2: sp.Rational(1, 2), alpha_2: sp.Integer(2), kappa_2: sp.Integer(width),
              hidden_v: sp.Rational(1, 2)}
    return _motion(observer_loop() | tracking_loop(), functions, gains, (hidden_f, hidden_v), shown)


def _driven_observer(width: int) -> tuple[dict[sp.Expr, sp.Expr], dict[sp.Expr, sp.Expr]]:
    """The motion of the observer that its error drives, and its gains; width: kappa, of tanh."""
    c = width * sp.log(3) / 2
    return ({s_tilde: c / 4, v_tilde: c, delta_tilde: 2 * sp.exp(t) - c / 2, weight_f: sp.exp(t) + c},
            {k_1: sp.Integer(4), k_2: sp.Integer(5), kappa_1: sp.Integer(width)})


def observer_leaves_prior(shown: Relation) -> Goal:
    """Along (13), (18)-(21) as printed, the errors of the observer and of its weights zero, `shown` holds from some time on."""
    return _motion(observer_loop(), _at_rest, _rest_gains, (hidden_f,), shown)


def tracking_leaves_prior(shown: Relation) -> Goal:
    """The same with (26), (28), (31)-(35), e_v and the error of its weights zero."""
    return _motion(observer_loop() | tracking_loop(), _at_rest | _tracking_at_rest, _rest_gains, (hidden_f, hidden_v),
                   shown)


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

"""mao2018: a motion of the closed loop as printed along which the position error stays at 1 m for ever."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal

from .active_mode import (
    Gamma_k,
    Gamma_m,
    Gamma_xi,
    chi_d,
    chis,
    d,
    estimate_laws,
    failure_hat,
    gains,
    hats,
    k_1,
    k_2,
    lambda_hat,
    m,
    nu_damp,
    rho_0,
    rho_hat,
    rho_k_hat,
    rho_k_law,
    rho_law,
    rho_law_61,
    rho_law_61_true,
    signal_of,
    speed_error,
    trues,
)
from .error_dynamics import Flow, d_0, failed_train, failure, k_v
from .plant import Delta_b, Delta_c, g, r_1, r_2, s, t, x_2, xddot_m, xdot_m, z_1, z_2

Xi, Xi_hat = sp.symbols("Xi Xi_hat", real=True)
n_b, epsilon = sp.symbols("n_b epsilon", positive=True)
sign_of_z_2 = (at_most(z_2, s * z_2), at_most(-z_2, s * z_2))  # with |s| <= 1: s z_2 = |z_2|


def steady_state_error(show: Relation, compensation: sp.Expr, constants: Flow, *assume: Relation,
                       extra_force: sp.Expr | None = None, lambda_law: sp.Expr | None = None,
                       damped: bool = False, turned: bool = False, begins: int = 0) -> Goal:
    """The closed loop as printed, with every failure constant, and a motion along it with z_1 = z_2 = 1 for ever.

    turned: with the sign of nu_Delta in (61) turned;
    begins: how long the motion has lasted at time zero.

    varpi is 1 for each of n_b = 16 motors, Xi = xi^T varpi and Xi_hat = xi_hat^T varpi. The estimates that integrate
    z_2 grow with t; what (44) makes of rho_knu_hat Xi_hat grows as fast as rho_hat (zeta - eta - r_2 z_2), against it.
    """
    signal = signal_of(compensation) + (rho_hat * nu_damp if damped else 0)
    rates: Flow = {**failed_train(signal), **estimate_laws, rho_k_hat: rho_k_law,
                   rho_hat: (rho_law_61_true if turned else rho_law_61) if damped else rho_law, Xi_hat: n_b * Gamma_xi * z_2}
    rates[z_2] += m * (extra_force or 0) - (Delta_b * x_2 + Delta_c * x_2**2 if damped else 0)
    if lambda_law is not None:
        rates[lambda_hat] = lambda_law
    rates = {state: rate.xreplace({failure: Xi, failure_hat: Xi_hat}) for state, rate in rates.items()}
    dots = {state: sp.Symbol(f"{state}_dot", real=True) for state in rates}
    one, zero = sp.Integer(1), sp.Integer(0)
    fixed: Flow = {**dict.fromkeys((*trues, d, xddot_m), zero), **dict.fromkeys(
        (*chis, *gains, r_1, r_2, m, x_2, xdot_m, Gamma_xi, Gamma_k, Gamma_m, s, chi_d, d_0), one),
        g: sp.Rational(981, 100), n_b: sp.Integer(16), k_v: sp.Integer(15), rho_0: sp.Integer(15),
        gains[0]: sp.Integer(12), gains[3]: sp.Rational(100, 981) ** 2, gains[4]: sp.Integer(250) ** 2, **constants}
    damping = (k_1 + k_2).xreplace(fixed) if damped else zero
    motion: Flow = {z_1: one, z_2: one, Xi_hat: 16 * t + 4 * damping / 3, rho_k_hat: -8 * t**2 - 4 * damping * t / 3,
                    rho_hat: 8 * t**2 + 2 * damping * t / 3}
    motion |= {hat: rate.xreplace({z_2: one}).xreplace(fixed) * t for hat, rate in estimate_laws.items()}
    motion[hats[0]] += 2 - 5 * damping / 3
    if turned:
        motion |= {Xi_hat: 16 * t, rho_k_hat: -8 * t**2, rho_hat: 8 * t**2, hats[0]: motion[hats[0]] + 8 * damping / 3}
    if lambda_law is not None:
        slope = lambda_law.xreplace(motion).xreplace(fixed)
        motion |= {lambda_hat: 1 + slope * t, rho_k_hat: -slope / (16 * fixed[rho_0]) - 8 * t**2}
    motion = {state: value.xreplace({t: t + begins}) for state, value in motion.items()}
    fixed[Xi] = sp.expand(-rates[z_2].xreplace(motion).xreplace(fixed).xreplace({Xi: zero}))
    always = (*(equal(dots[state], rate) for state, rate in rates.items()), equal(x_2, speed_error + xdot_m), *sign_of_z_2)
    used = {symbol for relation in (show, *assume, *always) for side in (relation.left, relation.right)
            for symbol in side.free_symbols}
    return Goal((show,), (at_most(s, 1), at_least(s, -1), at_least(m * k_v, rho_0), *assume), {t: one, **dots}, always,
                eventually=t, model={**{x: value for x, value in fixed.items() if x in used}, **motion}, inputs=tuple(dots.values()))


LAWS = "(27)-(31), (37), (41), (44)"
LAWS_VII = "(27)-(31), (41), (44), (61)"  # (61) stands for (37) there
STEADY_STATE_ERROR = (
    "a closed loop with %s as printed in which z_1 = z_2 = 1 for all t >= 0: one mode, 16 "
    "motors of which one has failed with a constant force, a constant desired speed, no disturbance. "
    "xi_hat grows like t, rho_knu_hat and rho_hat like t^2, and they hold the error up. ")

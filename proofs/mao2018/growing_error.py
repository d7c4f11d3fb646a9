"""mao2018: a motion of the closed loop as printed along which the speed error stays at 1 m/s, so that the position error grows.

The train runs at 1 m/s for ever, while the desired curve stands still: x_m = 0. What the failed motor may do is known up to
two constants, that of a constant force and that of a basis signal f, of which only the first one is not zero.
"""

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
    k_1,
    k_2,
    m,
    nu_damp,
    rho_0,
    rho_hat,
    rho_k_hat,
    rho_k_law,
    rho_law,
    rho_law_61,
    signal_of,
    speed_error,
    trues,
)
from .error_dynamics import Flow, d_0, failed_train, failure, k_v
from .plant import Delta_b, Delta_c, g, r_1, r_2, s, t, x_2, xddot_m, xdot_m, z_1, z_2
from .steady_state_error import Xi, sign_of_z_2

constant_hat, varying_hat, f = sp.symbols("Xi_0_hat Xi_1_hat f", real=True)
n_ones = sp.Symbol("n_ones", positive=True)
DAMPING = sp.Rational(7, 25)  # k_1 and k_2, for which a polynomial rho_knu_hat fits


def growing_error(show: Relation, compensation: sp.Expr, constants: Flow, *assume: Relation, extra_force: sp.Expr | None = None,
                  damped: bool = False, begins: int = 0) -> Goal:
    """The closed loop as printed, and a motion along it with z_1 = t and x_2 - x_m' = 1.

    begins: how long the motion has lasted at time zero.

    nu_0 does nothing but hold the failed motor's force, since rho_knu_hat xi_hat^T varpi = rho_hat (zeta - eta - r_2 z_2),
    with nu_Delta where there is damping. With u = z_2 the product of f = 2 + b/u and its estimate u^2 + b u gives
    xi_hat^T varpi the term 3 b u, which eta + r_2 z_2 needs.
    """
    one, zero, u = sp.Integer(1), sp.Integer(0), t + 1 + begins
    signal = signal_of(compensation) + (rho_hat * nu_damp if damped else 0)
    rates: Flow = {**failed_train(signal), **estimate_laws, rho_k_hat: rho_k_law, rho_hat: rho_law_61 if damped else rho_law,
                   constant_hat: n_ones * Gamma_xi * z_2, varying_hat: Gamma_xi * z_2 * f}
    rates[z_2] += m * (extra_force or 0) - (Delta_b * x_2 + Delta_c * x_2**2 if damped else 0)
    pushed = constant_hat + varying_hat * f
    rates = {state: rate.xreplace({failure: Xi, failure_hat: pushed}) for state, rate in rates.items()}
    fixed: Flow = {**dict.fromkeys((*trues, d, xddot_m, xdot_m), zero), **dict.fromkeys(
        (*chis, *gains, r_1, r_2, m, x_2, Gamma_xi, Gamma_k, Gamma_m, s, chi_d, d_0), one),
        g: sp.Rational(981, 100), n_ones: sp.Integer(16), k_v: sp.Integer(15), rho_0: sp.Integer(15),
        gains[0]: sp.Integer(16), gains[3]: sp.Rational(100, 981) ** 2, gains[4]: sp.Integer(250) ** 2, **constants}
    if damped:
        fixed |= dict.fromkeys((k_1, k_2), DAMPING)
    kappa = 2 * DAMPING if damped else zero
    b = (2 + kappa) / 4 if damped else sp.Rational(2, 3)
    motion: Flow = {z_1: u - 1, z_2: u, f: 2 + b / u, varying_hat: u**2 + b * u, constant_hat: 8 * u**2 - b**2,
                    rho_hat: (2 - kappa) * u**3 / 3 + sp.Rational(5, 2) * u**4, rho_k_hat: -b * u**3 - sp.Rational(5, 2) * u**4}
    motion |= {hat: rate.xreplace({z_2: u**2 / 2}).xreplace(fixed) for hat, rate in estimate_laws.items()}
    fixed[Xi] = sp.cancel(one - rates[z_2].xreplace(motion).xreplace(fixed).xreplace({Xi: zero}))
    dots = {state: sp.Symbol(f"{state}_dot", real=True) for state in (*rates, f)}
    always = (*(equal(dots[state], rate) for state, rate in rates.items()), equal(x_2, speed_error + xdot_m), *sign_of_z_2)
    used = {symbol for relation in (show, *assume, *always) for side in (relation.left, relation.right)
            for symbol in side.free_symbols}
    return Goal((show,), (at_most(s, 1), at_least(s, -1), at_least(m * k_v, rho_0), *assume), {t: one, **dots}, always,
                eventually=t, model={**{x: value for x, value in fixed.items() if x in used}, **motion}, inputs=tuple(dots.values()))


GROWING_ERROR = (
    "a closed loop with %s as printed in which the train runs at 1 m/s for ever, while the desired curve stands still, x_m = 0: one "
    "mode, 16 motors of which one has failed with a constant force, a known basis signal f that tends to 2 beside the constant ones, "
    "no disturbance. So the position error grows like t. ")

"""The force of the motors and the signal nu_0, read back from the train that runs, for the rows of its laws.

The laws of the active mode (active_mode.py), which the simulation takes, in the letters of every mode and summed over them
as laws.py sums them.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, differ, equal

from . import active_mode as active
from . import modes
from .error_dynamics import over_modes
from .plant import D_c, curvature, g, r_2, vartheta, x_2, z_2

m_t, a_t, b_t, c_t, d_bar = sp.symbols("m a b c d_bar", real=True)
resistance = a_t + b_t * x_2 + c_t * x_2**2 + g * vartheta + curvature * D_c - d_bar
felt_force = (D(x_2) + resistance) / m_t  # F(t) of (8)
k_nu = sp.Symbol("k_v", positive=True)
felt_signal = (felt_force - modes.p) / k_nu  # nu_0(t) of (13)

_IN_EVERY_MODE = {
    **dict(zip(active.hats, modes.hats_i, strict=True)), **dict(zip(active.chis, modes.chis_i, strict=True)),
    active.rho_hat: modes.rho_hat_i, active.chi_d: modes.chi_di, active.lambda_0: modes.lambda_i, active.m: modes.m_i,
    active.failure_hat: modes.p_hat, active.rho_0: modes.rho_0i, active.lambda_hat: modes.of_mode("lambda_hat")}


def of_every_mode(expr: sp.Expr) -> sp.Expr:
    """An expression of the active mode in the letters of mode i."""
    return expr.xreplace(_IN_EVERY_MODE)


def summed(expr: sp.Expr) -> sp.Expr:
    """A law of the active mode summed over the modes, each with its chi_mi."""
    return over_modes(modes.chi_mi * of_every_mode(expr))


def driven_by(force: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The train (8) with a force."""
    return {x_2: m_t * force - resistance}


def signalled_by(signal: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The train (8) with the force (13) that a signal makes."""
    return driven_by(k_nu * signal + modes.p)


# The printed laws of nu_0: (42) and (55); (48) and (60) have a term more.
_OWN = (r"\hat{\rho}_i(t)\zeta_i(t) - \hat{\rho}_i(t)\eta(t) - \hat{\rho}_i(t)r_2z_2(t)\bigg)")


def printed_signal(failure: str, before: str = "", within: str = "") -> str:
    """LaTeX of a law of nu_0; failure: how xi_hat^T varpi is printed; before, within: terms before and in the sum."""
    return (rf"\nu_{{0}}(t) = -\hat{{\rho}}_{{k\nu}}(t){failure} + {before}\sum_{{i=1}}^{{l}}\chi_{{mi}}(t)\bigg(\nu_{{di}}(t) + "
            rf"{within}{_OWN}")


def signal_law(signal: sp.Expr, compensation: sp.Expr, before: sp.Expr = sp.S.Zero, within: sp.Expr = sp.S.Zero) -> Goal:
    """nu_0 of the train that runs under a signal of the active mode, against the printed line; one mode is active."""
    inner = compensation + within + modes.rho_hat_i * (modes.zeta_i - active.eta - r_2 * z_2)
    stated = -active.rho_k_hat * modes.p_hat + before + over_modes(modes.chi_mi * inner)
    return Goal((equal(felt_signal, stated),), (differ(m_t, 0), equal(over_modes(modes.chi_mi), 1)), signalled_by(summed(signal)))

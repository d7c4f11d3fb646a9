"""mao2018: the closed loop in error coordinates, healthy, with failures and with uncertain resistance.

Exactly one mode is active at any instant. Where a step is linear in the modes, goals carry sums over all l of them;
elsewhere the active mode has symbols of its own. Failure terms are sums over every number of basis signals.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import at_least, at_most, equal

from .active_mode import (
    F_35,
    REGRESSORS,
    alpha_rate,
    basis,
    chi_d,
    chis,
    d,
    estimate_laws,
    lambda_0,
    m,
    over_basis,
    rho_hat,
    rho_k_hat,
    rho_k_law,
    rho_k_law_true,
    rho_law,
    signal_60,
    speed_error,
    trues,
    varpi,
    xi_law,
)
from .plant import Delta_b, Delta_c, drag, s, z_1, z_2

ALL_MODES = "every number of modes (term by term under the sum)"
ACTIVE_MODE = "every number of modes: one active, the others at rest"
ALL_SIGNALS = "every number of modes (one active, the others at rest) and of basis signals"

Flow = dict[sp.Expr, sp.Expr]

mode, motor = sp.symbols("i j", integer=True, positive=True)
mode_count, motor_count = sp.symbols("l n", integer=True, positive=True)


def over_modes(summand: sp.Expr) -> sp.Expr:
    """Sum over the modes i = 1..l."""
    return sp.Sum(summand, (mode, 1, mode_count))


def over_motors(summand: sp.Expr) -> sp.Expr:
    """Sum over the motors j = 1..n."""
    return sp.Sum(summand, (motor, 1, motor_count))


def of_mode(name: str) -> sp.Expr:
    """A quantity of mode i, under a sum over the modes."""
    return sp.IndexedBase(name, real=True)[mode]


NAMES = ("a", "b", "c", "vartheta", "D_o")

resistance = sum((x * chi * by for x, chi, by in zip(trues, chis, REGRESSORS, strict=True)), sp.Integer(0))


def error_rates(force: sp.Expr) -> Flow:
    """z_1 and z_2 along (7), (8) with (19), (21)."""
    return {z_1: speed_error, z_2: m * force - resistance + d * chi_d - alpha_rate}


filippov = (equal(s * z_2, sp.Abs(z_2)), at_most(s, 1), at_least(s, -1))
size = sp.Abs(z_2)

d_0 = sp.Symbol("d_0", positive=True)
healthy_loop: Flow = {**error_rates(F_35), **estimate_laws, rho_hat: rho_law}
disturbed = (at_most(d, d_0), at_least(d, -d_0), at_least(lambda_0, d_0))
within = (at_most(d * chi_d, lambda_0), at_least(d * chi_d, -lambda_0))

# With failures: k_v healthy motors, the others push with xi^T varpi.
k_v = sp.Symbol("k_v", positive=True)
xi = sp.IndexedBase("xi", real=True)[basis]
failure = over_basis(xi * varpi)
rho_i, rho_k = 1 / (m * k_v), 1 / k_v


def failed_train(signal: sp.Expr) -> Flow:
    """(39): z_1 and z_2 with the force (13) that nu_0 = signal makes."""
    return error_rates(k_v * signal + failure)


laws_printed: Flow = {**estimate_laws, **xi_law, rho_k_hat: rho_k_law, rho_hat: rho_law}
laws_true: Flow = {**laws_printed, rho_k_hat: rho_k_law_true}

# With resistance that is known up to its bounds.
b_0, c_0 = sp.symbols("b_0 c_0", nonnegative=True)
uncertain = (at_most(Delta_b, b_0), at_least(Delta_b, -b_0), at_most(Delta_c, c_0), at_least(Delta_c, -c_0))


def uncertain_train(law: sp.Expr) -> Flow:
    """(58)-(60) with (13), (27)-(31), (41), (43), (44) repaired, and the law of rho_hat given."""
    moving = failed_train(signal_60)
    return {**moving, z_2: moving[z_2] - drag, **laws_true, rho_hat: law}

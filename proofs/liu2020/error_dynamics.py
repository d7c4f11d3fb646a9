"""The closed loop in error coordinates.

The gain matrices are taken along their eigenvectors, Gamma = diag(g_j^2), which loses nothing: weights and hidden
functions are turned alike, by which norms and products stay; w = Gamma^(-1/2) W_tilde, so that W_tilde^T Gamma^(-1) W_tilde
is the sum of w_j^2.
Both networks share one index: the smaller one is filled up with neurons whose hidden function is zero.
"""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.derive import lie_derivative

from .laws import (
    D_1,
    D_2,
    W_f_0,
    W_f_hat,
    W_v_0,
    W_v_hat,
    command,
    delta_0,
    delta_hat,
    e_v,
    g_f,
    g_v,
    h_f,
    h_v,
    indexed,
    observer_laws,
    robust_1,
    robust_2,
    s_error,
    s_hat,
    s_hat_rate,
    s_tilde,
    theta_0,
    theta_hat,
    tracking_laws,
    v_error,
    v_hat,
    v_hat_rate,
    v_tilde,
)
from .plant import M, chi, d, s, v

W_f_star, h_z, W_v_star = map(indexed, ("W_f_star", "h_z", "W_v_star"))
eps_f, eps_v, eps_tilde = sp.symbols("epsilon_f epsilon_v epsilon_f_tilde", real=True)
r_v = sp.Symbol("r_v", real=True)  # eps_v - (M/chi) d

t = sp.Symbol("t", real=True)
delta_tilde, theta_tilde, delta, theta = sp.symbols("delta_tilde theta_tilde delta theta", real=True)
w_f, w_v = indexed("w_f"), indexed("w_v")
W_f_off, W_v_off = indexed("W_f_off"), indexed("W_v_off")  # W_f_star - W_f_0 and the like
delta_off, theta_off = sp.symbols("delta_off theta_off", real=True)
W_f_tilde, W_v_tilde = g_f * w_f, g_v * w_v
to_errors = {s_hat: s + s_tilde, v_hat: v + v_tilde, delta_hat: delta + delta_tilde, theta_hat: theta + theta_tilde,
             W_f_hat: W_f_star + W_f_tilde, W_v_hat: W_v_star + W_v_tilde, W_f_0: W_f_star - W_f_off,
             W_v_0: W_v_star - W_v_off, delta_0: delta - delta_off, theta_0: theta - theta_off}
f_by_network = over_neurons(W_f_star * h_f) - eps_tilde  # (15), with eps_tilde of (18)
f_v_by_network = over_neurons(W_v_star * h_v) + eps_v  # (28)


def in_errors(expr: sp.Expr) -> sp.Expr:
    """An expression of the closed loop in the errors."""
    return sp.expand(expr.xreplace(to_errors))


def observer_loop(leak: int = 1, residual: sp.Expr = delta) -> dict[sp.Expr, sp.Expr]:
    """(13), (18)-(21) with eps_tilde = residual; the paper has residual = delta, a constant."""
    rates = {s: v, v: f_by_network, s_hat: s_hat_rate, v_hat: v_hat_rate.xreplace({D_1: robust_1})}
    laws = observer_laws(leak)
    flow = {s_tilde: lie_derivative(s_error, rates), v_tilde: lie_derivative(v_error, rates),
            w_f: laws[W_f_hat] / g_f, delta_tilde: laws[delta_hat]}
    return {error: in_errors(rate).xreplace({eps_tilde: residual}) for error, rate in flow.items()}


def tracking_loop(leak: int = 1, learn: int = -1, residual: sp.Expr = theta) -> dict[sp.Expr, sp.Expr]:
    """(26), (28), (31), (32), (34), (35) with eps_v - (M/chi) d = residual; the paper has theta, a constant."""
    laws = tracking_laws(leak, learn)
    e_v_rate = chi / M * (f_v_by_network - M / chi * d - command.xreplace({D_2: robust_2}))
    flow = {e_v: e_v_rate, w_v: laws[W_v_hat] / g_v, theta_tilde: laws[theta_hat]}
    return {error: in_errors(rate.xreplace({eps_v: residual + M / chi * d})) for error, rate in flow.items()}


def one_neuron(expr: sp.Expr) -> sp.Expr:
    """The expression for a network of one neuron; Gamma is then a positive number."""
    single = expr.replace(sp.Sum, lambda term, *_: term)
    return single.xreplace({i: sp.Symbol(str(i.base.label), real=True, positive=i in (g_f, g_v) or None)
                            for i in single.atoms(sp.Indexed)})

"""What the letters of the printed lines stand for, from the objects that the goals are made of."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D

from . import laws
from .error_dynamics import (
    W_f_off,
    W_f_star,
    W_f_tilde,
    W_v_off,
    W_v_star,
    W_v_tilde,
    delta,
    delta_off,
    delta_tilde,
    eps_v,
    theta,
    theta_off,
    theta_tilde,
)
from .laws import s_tilde, v_tilde
from .lyapunov import V_1, V_2
from .plant import M, acceleration, chi, d, f_d, s, u, v

# Greek and indexed letters that are symbols of the same name.
_SAME = {rf"\{name}": getattr(laws, name) for name in (
    "kappa_1", "kappa_2", "alpha_1", "alpha_2", "beta_1", "beta_2", "sigma_f", "sigma_v", "delta_0", "theta_0")}

NOTATION: dict[str, sp.Expr] = _SAME | {
    "s": s, "v": v, "u": u, "d": d, "f_d": f_d, "M": M, r"\chi": chi, "f": acceleration,
    "k_1": laws.k_1, "k_2": laws.k_2, "k_3": laws.k_3, "k_4": laws.k_4, "k_5": laws.k_5,
    r"\hat s": laws.s_hat, r"\hat v": laws.v_hat, r"\hat f": laws.f_hat, r"\tilde s": s_tilde, r"\tilde v": v_tilde,
    "s_d": laws.s_d, r"\dot s_d": laws.sdot_d, r"\ddot s_d": laws.sddot_d, "e_v": laws.e_v, "D_1": laws.D_1,
    "D_2": laws.D_2, r"\hat\delta": laws.delta_hat, r"\hat\theta": laws.theta_hat, r"\delta": delta, r"\theta": theta,
    r"\tilde\delta": delta_tilde, r"\tilde\theta": theta_tilde, r"\varepsilon_v": eps_v,
    r"\hat W_f": laws.W_f_hat, "W_f^*": W_f_star, r"\tilde W_f": W_f_tilde, "W_{f0}": W_f_star - W_f_off,
    r"\hat W_v": laws.W_v_hat, "W_v^*": W_v_star, r"\tilde W_v": W_v_tilde, "W_{v0}": W_v_star - W_v_off,
    r"h_f(\hat z_1)": laws.h_f, "h_v(z_2)": laws.h_v, "V_1": V_1, "V_2": V_2,
    r"\gamma(\dot{\tilde s} + k_1\tilde s)": laws.gamma_1(v_tilde), r"\gamma(\tilde v)": laws.gamma_1(v_tilde),
    r"\gamma(e_v)": laws.gamma_2(laws.e_v), "u(t)": u, "d(t)": d, r"\dot v(t)": D(v), "f_d(v, t)": f_d, "f_d(v)": f_d,
    r"\hat f(z_1)": laws.f_hat, "f(z_1)": acceleration, r"\varepsilon_v(z_2)": eps_v,
}

# The observer's errors where they are made of estimate and truth.
OBSERVED: dict[str, sp.Expr] = {r"\tilde s": laws.s_error, r"\tilde v": laws.v_error,
                                r"\tilde W_f": laws.W_f_hat - W_f_star}

# Estimates, truths and priors where the errors are the variables, from section 5 on.
ERRORS: dict[str, sp.Expr] = {
    r"\hat W_f": W_f_star + W_f_tilde, r"\hat W_v": W_v_star + W_v_tilde, "W_f": W_f_star, "W_v": W_v_star,
    r"\hat\delta": delta + delta_tilde, r"\hat\theta": theta + theta_tilde, r"\delta_0": delta - delta_off,
    r"\theta_0": theta - theta_off, r"\Gamma_f": laws.g_f**2, r"\Gamma_v": laws.g_v**2,
    r"\Gamma_f^{-1}": 1 / laws.g_f**2, r"\Gamma_v^{-1}": 1 / laws.g_v**2,
}

"""jiao2025: the letters of its printed lines, and what they stand for in the goals.

k counts samples, i trials; `_i`, `_prev`, `_prev2` stand for trials i, i-1, i-2. In section 2 Delta stands for the
difference of trials i and i-1, in the estimation laws (9)-(15) for that of trials i-1 and i-2.
"""

from __future__ import annotations

import sympy as sp

from .laws import (
    Delta_u,
    Delta_v,
    K_d,
    K_p,
    e_next,
    e_now,
    e_prev,
    epsilon,
    eta,
    gamma,
    lamda,
    mu,
    phi,
    phi_first,
    phi_i,
    phi_prev,
    rho,
)
from .plant import M, T_s, b_0k, b_1k, b_2k, f_a, k, u_i, u_prev, v_i, v_prev

v_next, v_next_prev, v_d = sp.symbols("v_next_i v_next_prev v_d", real=True)  # v(k+1,i), v(k+1,i-1), v_d(k+1)
f_b = sp.Symbol("f_b", real=True)
Delta_v_next, Delta_v_k, Delta_u_i = sp.symbols("Delta_v_next Delta_v_k Delta_u_i", real=True)
e_i, xi, xi_star, cost, phi_free = sp.symbols("e_i xi xi_star J phi_free", real=True)
T_d, T_min, p_k, gamma_mean = sp.symbols("T_d T_min p_k gamma_mean", real=True)
p, epsilon_bar = sp.symbols("p epsilon_bar", positive=True)

NOTATION: dict[str, sp.Expr] = {
    "T_s": T_s, "M": M, r"\rho": rho, r"\lambda": lamda, r"\mu": mu, r"\eta": eta, r"\varepsilon": epsilon,
    r"\bar{\varepsilon}": epsilon_bar, "p": p, "K_p": K_p, "K_d": K_d, "T_d": T_d, r"T_{\min}": T_min, "k": k,
    "v(k+1)": v_next, "v(k)": v_i, "v(k+1, i)": v_next, "v(k+1, i-1)": v_next_prev, "v(k, i)": v_i, "v(k, i-1)": v_prev,
    "u_f(k)": u_i, "u_f(k, i)": u_i, "u_f(k, i-1)": u_prev, "f_a(s)": f_a, "f_b(v)": f_b,
    "b_0(k)": b_0k, "b_1(k)": b_1k, "b_2(k)": b_2k,
    r"\Delta v(k+1, i)": Delta_v_next, r"\Delta u_f(k, i)": Delta_u_i,
    r"\Delta v(k+1, i-1)": Delta_v, r"\Delta u_f(k, i-1)": Delta_u,
    "e(k+1, i)": e_i, "e(k+1, i-1)": e_prev, r"e^*(k+1, i-1)": e_next, r"e^*(k, i-1)": e_now,
    r"\xi(k+1, i-1)": xi, r"\xi^*(k+1, i-1)": xi_star, r"\gamma(k, i)": gamma, "p(k)": p_k,
    r"\phi_c(k, i)": phi, r"\hat{\phi}_c(k, i)": phi_i, r"\hat{\phi}_c(k, i-1)": phi_prev,
    r"\hat{\phi}_c(k, 1)": phi_first, "J(u_f(k, i))": cost, r"J(\phi_c(k, i))": cost,
    r"E\{\gamma(k, i)\}": gamma_mean,
}

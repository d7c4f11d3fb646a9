"""yang2021: what the letters of its printed lines stand for, in the error coordinates of the closed loop.

The paper writes the same letter bold and plain, h, h(x) and h_j, f(x) and f: each spelling stands here. A line that is
decided in other coordinates names its own letters.
"""

from __future__ import annotations

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.model.law import over_neurons
from workbench.trains.train import f, m, u

from .error_dynamics import (
    W_star,
    W_tilde,
    e_1,
    e_2,
    eps_star,
    epsilon,
    h,
    lambdas,
    sigmas,
    stars,
    tildes,
    x_2_errors,
)
from .laws import alpha, beta, chi, k, x_1
from .lyapunov import V_0, V_1, V_2, V, V_t, l_, mu, t, zeta

W_hat = W_tilde + W_star

NOTATION: dict[str, sp.Expr] = {
    "e_1": e_1, "e_2": e_2, "k": k, "t": t, "m": m, "u": u, "x_1": x_1, "x_2": x_2_errors,
    "x_d": x_d, r"\dot{x}_d": xdot_d, r"\ddot{x}_d": xddot_d,
    r"\alpha": alpha, r"\beta": beta, r"\chi": chi, r"\mu": mu, "l": l_, r"\zeta": zeta,
    r"\varepsilon(x)": epsilon, r"\varepsilon^*": eps_star, "f(x)": f,
    "V_1": V_1, "V_2": V_2, "V": V, "V(t)": V_t, "V(0)": V_0,
}
for _letter, _tilde, _star in zip("abc", tildes, stars, strict=True):
    NOTATION |= {rf"\tilde{{{_letter}}}": _tilde, f"{_letter}^*": _star, rf"\hat{{{_letter}}}": _tilde + _star,
                 f"{_letter}_0": m * _star}
for _i in range(3):
    NOTATION |= {rf"\lambda_{_i + 1}": lambdas[_i], rf"\sigma_{_i + 1}": sigmas[_i]}
for _W in ("W", r"\mathbf{W}"):
    _wt, _ws, _wh = rf"\tilde{{{_W}}}", f"{_W}^*", rf"\hat{{{_W}}}"
    NOTATION |= {
        rf"{_wt}^T {_wt}": over_neurons(W_tilde**2), rf"{_wt}^T {_ws}": over_neurons(W_tilde * W_star),
        rf"{_wt}^T {_wh}": over_neurons(W_tilde * W_hat), rf"{_wt}^T ({_wt} + {_ws})": over_neurons(W_tilde * W_hat),
        rf"{_W}^{{*2}}": over_neurons(W_star**2),
    }
    for _h in ("h(x)", r"\mathbf{h}(\mathbf{x})"):
        NOTATION |= {rf"{_wt}^T {_h}": over_neurons(W_tilde * h), rf"{_wh}^T {_h}": over_neurons(W_hat * h),
                     rf"{_W}^{{*T}} {_h}": over_neurons(W_star * h)}

"""mao2018: what the letters of its printed lines stand for."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from workbench.proof.claim import D

from . import modes
from .active_mode import Gamma_d, Gamma_k, Gamma_xi, alpha_1, eta, k_1, k_2, nu_damp, rho_k_hat
from .error_dynamics import NAMES, b_0, c_0, k_v
from .plant import Delta_b, Delta_c, F, g, r_1, r_2, s, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2

LETTERS = ("a", "b", "c", r"\vartheta", "D")


def in_time(letters: Mapping[str, sp.Expr]) -> dict[str, sp.Expr]:
    """The letters with and without their argument t, and their powers with it."""
    found = dict(letters)
    for letter, meaning in letters.items():
        found[f"{letter}(t)"] = meaning
        if "_" in letter or letter.isalpha():
            found |= {f"{letter}^{n}(t)": meaning**n for n in (2, 4)}
    return found


_parameters = {
    key: value for letter, name, true, hat, gain, chi in zip(
        LETTERS, NAMES, modes.trues_i, modes.hats_i, modes.gains_i, modes.chis_i, strict=True)
    for key, value in {f"{letter}_i": true, rf"\hat{{{letter}}}_i": hat, rf"\tilde{{{letter}}}_i": true - hat,
                       rf"\Gamma_{{{letter}i}}": gain, rf"\chi_{{{letter}i}}": chi}.items()}

NOTATION: dict[str, sp.Expr] = in_time({
    "x_1": x_1, "x_2": x_2, "x_m": x_m, r"\dot{x}_m": xdot_m, r"\ddot{x}_m": xddot_m, "z_1": z_1, "z_2": z_2, "F": F,
    r"\alpha_1": alpha_1, r"\eta": eta, **_parameters,
    "m_i": modes.m_i, r"\Gamma_{mi}": modes.Gamma_mi, r"\chi_{mi}": modes.chi_mi, r"\chi_{\bar{d}i}": modes.chi_di,
    r"\bar{d}_i": modes.d_i, r"\zeta_i": modes.zeta_i, r"\rho_i": modes.rho_i, r"\hat{\rho}_i": modes.rho_hat_i,
    r"\tilde{\rho}_i": modes.rho_i - modes.rho_hat_i, r"\lambda_i^0": modes.lambda_i,
    r"\rho_{k\nu}": modes.rho_k, r"\hat{\rho}_{k\nu}": rho_k_hat, r"\tilde{\rho}_{k\nu}": modes.rho_k - rho_k_hat,
    r"\nu_{\Delta}": nu_damp, r"\Delta b": Delta_b, r"\Delta c": Delta_c,
}) | {
    "r_1": r_1, "r_2": r_2, "g": g, r"k_{\nu}": k_v, "k_1": k_1, "k_2": k_2, "b_0": b_0, "c_0": c_0,
    r"\Gamma_{k\nu}": Gamma_k, r"\Gamma_{\xi}": Gamma_xi, r"\Gamma_{d_i^0}": Gamma_d, r"\rho_i^0": modes.rho_0i,
    r"|z_2(t)|": modes.size, r"\operatorname{sgn}[z_2(t)]": s, r"\xi^T\varpi(t)": modes.p,
    r"\hat{\xi}^T(t)\varpi(t)": modes.p_hat,
    # The extracted text has \bar for the tilde here.
    r"\dot{\bar{\rho}}_i(t)": D(modes.rho_i - modes.rho_hat_i),
}

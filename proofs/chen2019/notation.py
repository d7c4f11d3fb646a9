"""What the letters of the printed lines stand for: vectors and diagonal matrices by their entry of car j.

The extracted text prints one letter in several fonts, and a v sometimes as nu; all of them are given.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from workbench.trains.multi_particle import s, v

from .energy_function import V, V_of
from .laws import (
    As,
    Av,
    Delta_u,
    M,
    M_hat,
    M_tilde,
    Theta,
    Theta_hat,
    Theta_tilde,
    alpha,
    c_1,
    c_2,
    c_3,
    eta,
    eta_hat,
    eta_tilde,
    lambda_1,
    lambda_2,
    learning_gains,
    mu,
    phi,
    s_r,
    theta,
    theta_hat,
    theta_tilde,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)
from .one_car import one_car

ITERATIONS = ("i", "1")


def in_fonts(letter: str) -> tuple[str, ...]:
    """A letter as it is printed: plain and bold."""
    return letter, rf"\boldsymbol{{{letter}}}", rf"\mathbf{{{letter}}}"


def _of_iterations() -> dict[str, sp.Expr]:
    """What differs from one iteration to the next."""
    found: dict[str, sp.Expr] = {}
    for i in ITERATIONS:
        for letter, meaning in (("s", s), ("v", v), (r"\nu", v), (r"\mu", mu), (r"\alpha", alpha)):
            found |= {f"{font}_{i}": meaning for font in in_fonts(letter)}
        for letter, index, meaning in (("z", "1", z_1), ("z", "2", z_2), (r"\lambda", "1", lambda_1),
                                       (r"\lambda", "2", lambda_2)):
            found |= {f"{font}_{{{index},{i}}}": meaning for font in in_fonts(letter)}
        for letter in (*in_fonts("v"), *in_fonts(r"\nu")):
            found |= {rf"\dot{{{letter}}}_{i}": v_dot, rf"\mathcal{{D}}(\dot{{{letter}}}_{i})": v_dot,
                      rf"\mathcal{{D}}({letter}_{i})": v, rf"A {letter}_{i}": Av}
            found |= {rf"{f}({letter}_{i})": phi for f in in_fonts(r"\phi")}
        for letter in in_fonts("s"):
            found |= {rf"A {letter}_{i}": As, rf"\mathcal{{A}}{letter}_{i}": As}
        for letter in in_fonts("z"):
            found[rf"\mathcal{{D}}({letter}_{{2,{i}}})"] = z_2
        found |= {rf"\Delta {letter}_{i}": Delta_u for letter in in_fonts("u")}
        for x in ("v", r"\nu"):
            found |= {rf"\hat\Theta_{{{x},{i}}}": Theta_hat, rf"\tilde\Theta_{{{x},{i}}}": Theta_tilde}
        for index, hat, tilde in zip("akd", theta_hat, theta_tilde, strict=True):
            found |= {rf"\hat\theta_{{{index},{i}}}": hat, rf"\tilde\theta_{{{index},{i}}}": tilde}
        for letter in in_fonts(r"\eta"):
            found |= {rf"\hat{{{letter}}}_{i}": eta_hat, rf"\tilde{{{letter}}}_{i}": eta_tilde}
        found |= {rf"\hat M_{i}": M_hat, rf"\tilde M_{i}": M_tilde}
    return found


def _of_the_train() -> dict[str, sp.Expr]:
    """Parameters, gains and references, the same in every iteration."""
    found: dict[str, sp.Expr] = {"M": M, "c_1": c_1, "c_2": c_2, "c_3": c_3}
    found |= {rf"\Theta_{x}": Theta for x in ("v", r"\nu")}
    found |= {rf"\theta_{index}": x for index, x in zip("akd", theta, strict=True)}
    found |= dict.fromkeys(in_fonts(r"\eta"), eta)
    found |= {rf"\gamma_{{{index}}}": gain for index, gain in zip(("v", "a", "k", "d", r"\eta", "M"), learning_gains,
                                                                  strict=True)}
    found[r"\gamma_{\nu}"] = learning_gains[0]
    found |= {rf"\gamma_{{{letter}}}": learning_gains[4] for letter in in_fonts(r"\eta")[1:]}
    for letter in in_fonts("s"):
        found[f"{letter}_r"] = s_r
    for letter in in_fonts("v"):
        found |= {f"{letter}_r": v_r, rf"\dot{{{letter}}}_r": v_r_dot}
    return found


LYAPUNOV: dict[str, sp.Expr] = {"V_{1,i}": V_of(z_1), "V_{2,i}": V_of(z_2), "V_i": V}
NOTATION: dict[str, sp.Expr] = {**_of_iterations(), **_of_the_train(), **LYAPUNOV}


def for_one_car(letters: Mapping[str, sp.Expr] = NOTATION) -> dict[str, sp.Expr]:
    """The letters in lines that hold entry by entry: each vector stands for its entry of one car."""
    return {letter: one_car(meaning) for letter, meaning in letters.items()}


ONE_CAR = for_one_car()


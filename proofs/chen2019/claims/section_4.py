"""Section IV: what is concluded, and the laws with numbers."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, equal
from workbench.trains.multi_particle import s, v

from ..laws import (
    As,
    Av,
    M_hat,
    c_3,
    errors,
    estimates,
    lambda_1,
    learning_gains,
    mu_law,
    phi,
    s_r,
    v_dot,
    v_r,
    v_r_dot,
)
from ..one_car import one_car
from ..paper import EACH_CAR, paper
from ..plant import compact_force
from ..stated_values import at_stated, printed_factors, stated_gains, stated_learning


@paper.claim("section4.converge", "z = 0 means no tracking error", "implication",
             r"z_{1,i} = z_{2,i} = 0 \Rightarrow e_{s,i} = e_{v,i} = 0", "gap",
             premises=("theorem1.2", "A2"), scope=EACH_CAR,
             note="Section IV expects the tracking errors to converge further with more iterations. What converges is "
                  "z; e_s = z_1 + lambda_1, and lambda vanishes only if the saturation does, which A2 excludes at the "
                  "stated numbers.")
def z_is_not_the_error() -> Goal:
    """From (10) and (12)."""
    given = tuple(equal(one_car(expr), 0) for expr in errors.values())
    return Goal((equal(one_car(s) - s_r, 0), equal(one_car(v) - v_r, 0)), given)


factors = sp.symbols("k_v k_a k_k k_d k_eta k_M", real=True)


@paper.claim("section4.learning", "The printed learning factors are gamma times c_3", "condition",
             r"0.4 = \gamma_v c_3,\ 0.0008 = \gamma_a c_3,\ 320 = \gamma_k c_3 = \gamma_d c_3 = \gamma_\eta c_3 = "
             r"\gamma_M c_3", "proved",
             at={**stated_learning, c_3: stated_gains[c_3], **dict(zip(factors, printed_factors, strict=True))})
def learning_factors() -> Goal:
    """(17)-(22) with the stated gains."""
    return Goal(tuple(equal(k, gain * c_3) for k, gain in zip(factors, learning_gains, strict=True)))


@paper.claim("section4.law", "The printed control law is (16) at the stated gains", "identity",
             r"\mu_i = -25[100(v_i - v_r + 0.01s_i - 0.01s_r) + \dot v_i - \dot v_r + 0.01v_i - 0.01v_r + s_i - s_r - "
             r"\lambda_{1,i}] - (\hat\Theta_{v,i}v_i + \dots - \hat M_i\dot v_i)", "proved", premises=("16.loop",),
             scope=EACH_CAR)
def printed_law() -> Goal:
    """(16) with (12) and c_1 = 0.01, c_2 = 100, c_3 = 0.04."""
    hundredth = sp.Rational(1, 100)
    inner = (100 * (v - v_r + hundredth * s - hundredth * s_r) + v_dot - v_r_dot + hundredth * v - hundredth * v_r
             + s - s_r - lambda_1)
    printed = -25 * inner - (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot)
    return Goal((equal(one_car(mu_law.xreplace(at_stated)), one_car(printed)),))

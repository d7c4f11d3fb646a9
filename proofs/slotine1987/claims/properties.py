"""slotine1987: what the proof uses of the arm."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, equal, greater
from workbench.systems.angles import OnCircle

from ..laws import regressor
from ..paper import EVERY_ARM, paper
from ..plant import A, C, H, a_1, a_2, a_3, a_4, determinant, q_2, w_1, w_2

elbow = OnCircle(q_2, *sp.symbols("sin_q2 cos_q2", real=True))
turning = elbow.flow({q_2: w_2})
inertia, coriolis = H.applyfunc(elbow.put), C.applyfunc(elbow.put)
on_circle = equal(elbow.square, 1)
rates, accelerations = sp.Matrix(sp.symbols("v_1 v_2", real=True)), sp.Matrix(sp.symbols("b_1 b_2", real=True))
load = greater(a_2 * (a_1 - a_2), a_3**2 + a_4**2)


@paper.claim("skew", "dH/dt - 2 C is skew-symmetric", "identity", r"x^T (\dot H - 2 C) x = 0", "proved", scope=EVERY_ARM,
             reading="Entry by entry: both on the diagonal are zero, and the two beside it cancel.")
def skew() -> Goal:
    """With this choice of C, which is not the only one with the same C q'."""
    beside = D(inertia[0, 1]) - 2 * coriolis[0, 1] + D(inertia[1, 0]) - 2 * coriolis[1, 0]
    return Goal((equal(D(inertia[0, 0]) - 2 * coriolis[0, 0], 0), equal(2 * coriolis[1, 1], 0), equal(beside, 0)),
                flow=turning, inputs=(w_1, w_2))


@paper.claim("linear", "The dynamics are linear in the parameters", "identity",
             r"H \ddot q_r + C \dot q_r = Y(q, \dot q, \dot q_r, \ddot q_r) a", "proved", scope=EVERY_ARM)
def linear() -> Goal:
    """Y is the derivative by the parameters, so the row says that nothing is left over."""
    left = inertia * accelerations + coriolis * rates
    right = regressor(rates, accelerations).applyfunc(elbow.put) * sp.Matrix(A)
    return Goal(tuple(equal(one, other) for one, other in zip(left, right, strict=True)))


@paper.claim("positive", "H is positive definite", "inequality", r"H(q) > 0", "proved", scope=EVERY_ARM,
             reading="By its minors, under a_2 (a_1 - a_2) > a_3^2 + a_4^2, which the next row holds against the arm.")
def positive() -> Goal:
    """By the Cauchy-Schwarz inequality on the circle."""
    return Goal((greater(inertia[1, 1], 0), greater(elbow.put(determinant), 0)), (load, on_circle))


m_e, l_1, l_ce = sp.symbols("m_e l_1 l_ce", positive=True)
delta_e = sp.Symbol("delta_e", real=True)


@paper.claim("positive.load", "The angle of the load drops out", "implication",
             r"a_3 = m_e l_1 l_{ce} \cos\delta_e,\ a_4 = m_e l_1 l_{ce} \sin\delta_e \Rightarrow "
             r"a_3^2 + a_4^2 = m_e^2 l_1^2 l_{ce}^2", "proved", origin="implied")
def load_angle() -> Goal:
    """The load's centre of mass lies at the angle delta_e from its link."""
    at_angle = m_e * l_1 * l_ce
    return Goal((equal(a_3**2 + a_4**2, at_angle**2),),
                (equal(a_3, at_angle * sp.cos(delta_e)), equal(a_4, at_angle * sp.sin(delta_e))))


@paper.claim("positive.arm", "The stated arm is such an arm", "condition",
             r"a_2 (a_1 - a_2) > m_e^2 l_1^2 l_{ce}^2", "proved", origin="implied",
             at={a_1: Fraction(334, 100), a_2: Fraction(97, 100), m_e: Fraction(2), l_1: Fraction(1),
                 l_ce: Fraction(6, 10)})
def stated_arm() -> Goal:
    """Whatever the angle of the load is, by the row before."""
    return Goal((greater(a_2 * (a_1 - a_2), m_e**2 * l_1**2 * l_ce**2),))


I_1, I_e, m_1, l_c1 = sp.symbols("I_1 I_e m_1 l_c1", positive=True)


@paper.claim("positive.every", "Every physical arm is such an arm", "implication",
             r"a_1 = I_1 + m_1 l_{c1}^2 + I_e + m_e l_{ce}^2 + m_e l_1^2,\ a_2 = I_e + m_e l_{ce}^2 \Rightarrow "
             r"a_2 (a_1 - a_2) > m_e^2 l_1^2 l_{ce}^2", "proved", origin="implied")
def every_arm() -> Goal:
    """Inertias and masses are positive."""
    second = I_e + m_e * l_ce**2
    first = I_1 + m_1 * l_c1**2 + second + m_e * l_1**2
    return Goal((greater(second * (first - second), m_e**2 * l_1**2 * l_ce**2),))

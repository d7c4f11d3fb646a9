"""moreno2012: the perturbed algorithm, and the gains that the quadratic forms ask for."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, greater

from ..laws import k_1, k_2
from ..paper import OFF_ZERO, paper
from .algorithm import V, flow, form, r, rho_1, rho_2, y

delta = sp.Symbol("delta", positive=True)
SIGNED = ("The form is often written so, with the product zeta_1 zeta_2 and its sign; whether the paper prints it so is "
          "open here. A perturbation may have either sign, so the bound holds where both components have one sign only. "
          "With |zeta_1| |zeta_2| it holds everywhere, and the same gains make it positive.")
ABSOLUTE = (r"\dot V \le -|x_1|^{-1/2} \bar\zeta^T \tilde Q \bar\zeta,\ \bar\zeta = (|\zeta_1|, |\zeta_2|)^T")


def half_form(first: sp.Expr, beside: sp.Expr) -> tuple[sp.Matrix, sp.Expr]:
    """The matrix k_1/2 [[first, -beside], [-beside, 1]], and its form in |zeta_1| and |x_2|."""
    matrix = k_1 / 2 * sp.Matrix([[first, -beside], [-beside, 1]])
    return matrix, k_1 / 2 * (first * r**2 - 2 * beside * r * sp.Abs(y) + y**2)


# |rho_1| <= delta |x_1|^(1/2) in the rate of x_1; |rho_2| <= delta in that of x_2.
first_1, off_diagonal_1 = 2 * k_2 + k_1**2 - (4 * k_2 / k_1 + k_1) * delta, k_1 + 2 * delta
first_2, off_diagonal_2 = 2 * k_2 + k_1**2 - 2 * delta, k_1 + 2 * delta / k_1
signed_1, absolute_1 = half_form(first_1, off_diagonal_1)
signed_2, absolute_2 = half_form(first_2, off_diagonal_2)
FLOW_1, FLOW_2 = flow(rho_1, sp.S.Zero), flow(sp.S.Zero, rho_2)
bounds_1 = (at_most(rho_1, delta * r), at_least(rho_1, -delta * r))
bounds_2 = (at_most(rho_2, delta), at_least(rho_2, -delta))
least_1 = k_1 * (5 * delta * k_1 + 4 * delta**2) / (2 * (k_1 - 2 * delta))
least_2 = 3 * delta + 2 * delta**2 / k_1**2
gains_1 = (greater(k_1, 2 * delta), greater(k_2, least_1))
gains_2 = (greater(k_2, least_2),)


def bounded(which: int, right: sp.Expr) -> Goal:
    """V' under one of the perturbations, at most -right / |x_1|^(1/2)."""
    moving, bounds, symbol = ((FLOW_1, bounds_1, rho_1), (FLOW_2, bounds_2, rho_2))[which - 1]
    return Goal((at_most(D(V), -right / r),), bounds, flow=moving, inputs=(symbol,))


def in_absolute_values(which: int) -> Callable[[], Goal]:
    """The bound with absolute values."""
    return lambda: bounded(which, (absolute_1, absolute_2)[which - 1])


@paper.claim("rho1", "V' with a perturbation that vanishes with x_1", "inequality",
             r"|\rho_1| \le \delta |x_1|^{1/2} \Rightarrow \dot V \le -|x_1|^{-1/2} \zeta^T \tilde Q \zeta,\ "
             r"\tilde Q = \frac{k_1}{2} \begin{pmatrix} 2 k_2 + k_1^2 - (\frac{4 k_2}{k_1} + k_1) \delta & -(k_1 + 2 \delta) \\ "
             r"-(k_1 + 2 \delta) & 1 \end{pmatrix}", "refuted", scope=OFF_ZERO, premises=("decrease",), origin="ours",
             correction=in_absolute_values(1), corrected_statement=ABSOLUTE, note=SIGNED)
def first_perturbation() -> Goal:
    """As a question: does the form in zeta itself bound it?"""
    return bounded(1, form(signed_1))


@paper.claim("rho1.absolute", "V' under the perturbation, by absolute values", "inequality", ABSOLUTE, "proved", scope=OFF_ZERO,
             origin="implied", premises=("decrease",))
def first_bound() -> Goal:
    """The form in |zeta_1| and |zeta_2|."""
    return bounded(1, absolute_1)


def definite(right: sp.Expr, gains: tuple[Relation, ...], minor: sp.Expr) -> Goal:
    """A form in absolute values is positive under gains, by its minor."""
    return Goal((greater(right, 0),), gains, lemmas=(greater(minor, 0),))


@paper.claim("gains.rho1", "Gains against such a perturbation", "inequality",
             r"k_1 > 2 \delta,\ k_2 > k_1 \frac{5 \delta k_1 + 4 \delta^2}{2 (k_1 - 2 \delta)} \Rightarrow \tilde Q > 0",
             "proved", scope=OFF_ZERO, reading="In absolute values, of which the signed form is a case.")
def first_gains() -> Goal:
    """By the determinant, which is positive under the second condition."""
    return definite(absolute_1, gains_1, first_1 - off_diagonal_1**2)


@paper.claim("theorem.rho1", "Stable under such a perturbation", "implication",
             r"k_1 > 2 \delta,\ k_2 > k_1 \frac{5 \delta k_1 + 4 \delta^2}{2 (k_1 - 2 \delta)} \Rightarrow \dot V < 0", "proved",
             scope=OFF_ZERO, severity="result", premises=("rho1.absolute", "gains.rho1"))
def first_theorem() -> Goal:
    """The form that is positive is the one by which V' is bounded."""
    known = (*paper.shown("rho1.absolute"), *paper.shown("gains.rho1"))
    return Goal((greater(-D(V), 0),), (*bounds_1, *gains_1, *known), flow=FLOW_1, inputs=(rho_1,))


@paper.claim("rho2", "V' with a bounded perturbation of x_2", "inequality",
             r"|\rho_2| \le \delta \Rightarrow \dot V \le -|x_1|^{-1/2} \zeta^T \tilde Q \zeta,\ "
             r"\tilde Q = \frac{k_1}{2} \begin{pmatrix} 2 k_2 + k_1^2 - 2 \delta & -(k_1 + \frac{2 \delta}{k_1}) \\ "
             r"-(k_1 + \frac{2 \delta}{k_1}) & 1 \end{pmatrix}", "refuted", scope=OFF_ZERO, premises=("decrease",), origin="ours",
             correction=in_absolute_values(2), corrected_statement=ABSOLUTE, note=SIGNED)
def second_perturbation() -> Goal:
    """As a question: does the form in zeta itself bound it?"""
    return bounded(2, form(signed_2))


@paper.claim("rho2.absolute", "V' under the perturbation, by absolute values", "inequality", ABSOLUTE, "proved", scope=OFF_ZERO,
             origin="implied", premises=("decrease",))
def second_bound() -> Goal:
    """The form in |zeta_1| and |zeta_2|."""
    return bounded(2, absolute_2)


@paper.claim("gains.rho2", "Gains against a bounded perturbation", "inequality",
             r"k_1 > 0,\ k_2 > 3 \delta + 2 \frac{\delta^2}{k_1^2} \Rightarrow \tilde Q > 0", "proved",
             scope=OFF_ZERO, reading="In absolute values, of which the signed form is a case.")
def second_gains() -> Goal:
    """By the determinant."""
    return definite(absolute_2, gains_2, first_2 - off_diagonal_2**2)


@paper.claim("theorem.rho2", "Stable under a bounded perturbation", "implication",
             r"k_1 > 0,\ k_2 > 3 \delta + 2 \frac{\delta^2}{k_1^2} \Rightarrow \dot V < 0", "proved", scope=OFF_ZERO,
             severity="result", premises=("rho2.absolute", "gains.rho2"))
def second_theorem() -> Goal:
    """The form that is positive is the one by which V' is bounded."""
    known = (*paper.shown("rho2.absolute"), *paper.shown("gains.rho2"))
    return Goal((greater(-D(V), 0),), (*bounds_2, *gains_2, *known), flow=FLOW_2, inputs=(rho_2,))


@paper.claim("wider", "Smaller gains will do against the first", "implication",
             r"k_1 > 2 \delta,\ (2 k_2 + k_1^2 - (\tfrac{4 k_2}{k_1} + k_1) \delta) > (k_1 + \tfrac{\delta}{2})^2 \Rightarrow \dot V < 0",
             "proved", scope=OFF_ZERO, origin="ours", premises=("decrease",),
             note="The perturbation's own factor of |zeta_1 x_2| is k_1 delta / 2, not 2 k_1 delta, so the printed gains "
                  "are larger than the same V needs.")
def wider() -> Goal:
    """The same steps with the factor that the perturbation really has."""
    return Goal((greater(-D(V), 0),), (*bounds_1, greater(k_1, 2 * delta),
                                       greater(first_1, (k_1 + delta / 2) ** 2)), flow=FLOW_1, inputs=(rho_1,))



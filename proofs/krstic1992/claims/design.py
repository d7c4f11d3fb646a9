"""krstic1992: the three steps of the design, their error dynamics and V."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..laws import (
    alpha_1,
    by_x_1,
    c_1,
    c_2,
    c_3,
    command,
    compensation,
    gamma,
    tau_1,
    tau_2,
    tau_3,
    theta_hat,
    w_2,
    w_3,
    z_1,
    z_2,
    z_3,
)
from ..paper import EVERY_PHI, paper
from ..plant import RATES, d, phi, phi_1, phi_2, phi_3, theta, u, x_1, x_2, x_3

theta_tilde = theta - theta_hat


def flow(input_: sp.Expr, adaptation: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The chain under a command and an adaptation; phi and its derivatives move with x_1."""
    rates = [rate.xreplace({u: input_, d: sp.S.Zero}) for rate in RATES]
    moving = {one: another * rates[0] for one, another in ((phi, phi_1), (phi_1, phi_2), (phi_2, phi_3))}
    return {x_1: rates[0], x_2: rates[1], x_3: rates[2], theta_hat: adaptation, **moving}


LOOP = flow(command, tau_3)
INPUTS = (phi_3,)


@paper.claim("step1", "The first error", "identity",
             r"\dot z_1 = -c_1 z_1 + z_2 + \tilde\theta \varphi", "proved", scope=EVERY_PHI)
def first_step() -> Goal:
    """With the first stabilising function."""
    return Goal((equal(D(z_1), -c_1 * z_1 + z_2 + theta_tilde * phi),), flow=LOOP, inputs=INPUTS)


@paper.claim("step2", "The second error", "identity",
             r"\dot z_2 = -z_1 - c_2 z_2 + z_3 + \tilde\theta w_2 + \frac{\partial \alpha_1}{\partial \hat\theta} "
             r"(\tau_2 - \dot{\hat\theta})", "proved", scope=EVERY_PHI,
             reading="With any adaptation in place of the law's.")
def second_step() -> Goal:
    """The second stabilising function counts on the adaptation tau_2."""
    any_rate = sp.Symbol("a", real=True)
    return Goal((equal(D(z_2), -z_1 - c_2 * z_2 + z_3 + theta_tilde * w_2
                       + sp.diff(alpha_1, theta_hat) * (tau_2 - any_rate)),), flow=flow(command, any_rate),
                inputs=(*INPUTS, any_rate))


@paper.claim("step3", "The third error", "identity",
             r"\dot z_3 = -z_2 - c_3 z_3 + \tilde\theta w_3 + z_2 \frac{\partial \alpha_1}{\partial \hat\theta} \Gamma w_3",
             "proved", scope=EVERY_PHI)
def third_step() -> Goal:
    """The law's last term stays; it is there for the second error."""
    return Goal((equal(D(z_3), -z_2 - c_3 * z_3 + theta_tilde * w_3 + compensation),), flow=LOOP, inputs=INPUTS)


@paper.claim("tuning", "The tuning functions", "identity",
             r"\tau_i = \tau_{i-1} + \Gamma w_i z_i,\ w_i = \varphi_i - \sum_k \frac{\partial \alpha_{i-1}}{\partial x_k} \varphi_k",
             "proved", scope=EVERY_PHI, reading="Here phi_2 = phi_3 = 0, so that w_1 = phi.")
def tuning() -> Goal:
    """The last one is the sum of all, by which the unknown parameter cancels in V."""
    return Goal((equal(tau_3, gamma * (z_1 * phi + z_2 * w_2 + z_3 * w_3)), equal(tau_2, tau_1 + gamma * z_2 * w_2),
                 equal(w_2, -by_x_1(alpha_1) * phi)))


# The loop in the errors, as the rows of the three steps have it; regressors and the slope a = d alpha_1 / d theta_hat
# enter as numbers that may vary as they like.
e_1, e_2, e_3, tilde = sp.symbols("e_1 e_2 e_3 theta_tilde", real=True)
w = sp.symbols("w_1 w_2 w_3", real=True)
a, b = sp.symbols("a b", real=True)
errors = (e_1, e_2, e_3)
square = sum((one**2 for one in errors), sp.Integer(0)) / 2 + tilde**2 / (2 * gamma)
falls = -(c_1 * e_1**2 + c_2 * e_2**2 + c_3 * e_3**2)
PRODUCT = e_2 * e_3 * a * gamma * w[2]


def error_flow(compensated: bool, disturbance: sp.Expr = sp.S.Zero) -> dict[sp.Expr, sp.Expr]:
    """Rates of the errors; tau_2 - tau_3 = -gamma w_3 z_3, by the row of the tuning functions."""
    made_up = a * gamma * w[2] * e_2 if compensated else sp.S.Zero
    return {e_1: -c_1 * e_1 + e_2 + tilde * w[0],
            e_2: -e_1 - c_2 * e_2 + e_3 + tilde * w[1] - a * gamma * w[2] * e_3 + disturbance,
            e_3: -e_2 - c_3 * e_3 + tilde * w[2] + made_up + b * disturbance,
            tilde: -gamma * sum((one * error for one, error in zip(w, errors, strict=True)), sp.Integer(0))}


@paper.claim("decrease", "V decreases by the damping alone", "identity",
             r"\dot V = -c_1 z_1^2 - c_2 z_2^2 - c_3 z_3^2 \le 0", "proved", scope=EVERY_PHI,
             premises=("step1", "step2", "step3", "tuning"), severity="result")
def decrease() -> Goal:
    """V = (z_1^2 + z_2^2 + z_3^2)/2 + (theta - theta_hat)^2 / (2 gamma); the two products of z_2 and z_3 cancel."""
    return Goal((equal(D(square), falls), at_most(falls, 0), at_least(square, 0)), flow=error_flow(True), inputs=(*w, a))


def left_over() -> Goal:
    """V's rate without the compensation."""
    return Goal((equal(D(square), falls - PRODUCT),), flow=error_flow(False), inputs=(*w, a))


@paper.claim("uncompensated", "Without the compensation V decreases too", "inequality", r"\dot V \le 0", "refuted",
             origin="ours", scope=EVERY_PHI, premises=("decrease",), correction=left_over,
             corrected_statement=r"\dot V = -c_1 z_1^2 - c_2 z_2^2 - c_3 z_3^2 - z_2 z_3 "
                                 r"\frac{\partial \alpha_1}{\partial \hat\theta} \Gamma w_3",
             note="The paper claims nothing for this case. The product that stays has no sign, so certainty equivalence "
                  "alone does not give the theorem.")
def uncompensated() -> Goal:
    """As a question: is the law's last term needed for V?"""
    return Goal((at_most(falls - PRODUCT, 0),))


@paper.claim("disturbed", "V under a disturbance of the second state", "identity",
             r"\dot V = -c_1 z_1^2 - c_2 z_2^2 - c_3 z_3^2 + (z_2 - \frac{\partial \alpha_2}{\partial x_2} z_3) d", "proved",
             origin="ours", scope=EVERY_PHI, premises=("decrease",), reading="b = -d alpha_2 / d x_2.",
             note="The paper claims nothing for this case. V's rate has no term in the error of the estimate, which a "
                  "disturbance may move as it likes.")
def disturbed() -> Goal:
    """The disturbance enters beside x_3, and through the second stabilising function."""
    return Goal((equal(D(square), falls + (e_2 + b * e_3) * d),), flow=error_flow(True, d), inputs=(*w, a, b, d))


paper.axiom("convergence", "The state vanishes where phi(0) = 0", r"\lim_{t \to \infty} x(t) = 0",
            "LaSalle and Yoshizawa's theorem: z vanishes, and x with it step by step as phi(0) = 0",
            hypotheses=("decrease", "step1"), severity="result")

"""yang2021, section 3: the network's gradient laws (10)-(15), what they need, and the approximation error (17)."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_most, equal, greater, less
from workbench.trains.train import u

from .. import laws as law
from .. import network
from ..error_dynamics import EVERY_NETWORK, W_star, epsilon, h
from ..laws import W_hat, chi, x_2
from ..paper import paper

error_f, weight, rest_f, eta, varpi = sp.symbols("f w_j f_rest eta varpi", real=True)
width = sp.Symbol("b_j", positive=True)
x_i, c_ji = sp.symbols("x_i c_ji", real=True)
q_rest, squared = sp.symbols("q_rest q", nonnegative=True)  # squared distances
EVERY_SIZE = "every number of neurons and inputs"
GATHERED = "The other neurons' output is gathered in one term of f-hat"


def loss(hidden: sp.Expr) -> sp.Expr:
    """(9) with the other neurons' output gathered in f_rest."""
    return residual(hidden) ** 2 / 2


def residual(hidden: sp.Expr) -> sp.Expr:
    """f - f_hat."""
    return error_f - (weight * hidden + rest_f)


def descent(hidden: sp.Expr) -> sp.Expr:
    """-eta dE/d(parameter), the parameter being what moves at rate 1."""
    return -eta * D(loss(hidden))


def letters(hidden: sp.Expr) -> dict[str, sp.Expr]:
    """What (10)-(15) are written in."""
    return {r"\eta": eta, r"\varpi": varpi, r"f(\mathbf{x})": error_f, r"\hat{f}(\mathbf{x})": weight * hidden + rest_f,
            "h_j": hidden, "w_j": weight, "b_j": width, "x_i": x_i, "c_{ji}": c_ji}


plain = sp.Symbol("h_j", real=True)
of_width = sp.exp(-squared / (2 * width**2))
of_center = sp.exp(-((x_i - c_ji) ** 2 + q_rest) / (2 * width**2))


paper.definition("5", "The hidden functions of the network",
                 r"h_j(\mathbf{x}) = \exp\left(-\frac{\|\mathbf{x} - c_j\|^2}{2b_j^2}\right)\quad j = 1, 2, \dots, m")
paper.definition("6", "The centers of the hidden functions",
                 r"\mathbf{c} = [c_{j1}, c_{j2}, \dots, c_{ji}, \dots, c_{jn}]^T\quad i = 1, 2, \dots, n")
paper.definition("9", "The performance index of the network",
                 r"E = 0.5[f(\mathbf{x}) - \hat{f}(\mathbf{x})]^2")


@paper.claim("10", "Gradient step of a weight", "identity",
             r"\Delta w_j(t) = \eta[f(\mathbf{x}) - \hat{f}(\mathbf{x})]h_j", "proved", scope=EVERY_SIZE,
             where=letters(plain) | {r"\Delta w_j(t)": descent(plain)},
             reading=f"The step is -eta times the derivative of (9) by w_j. {GATHERED}.")
def weight_gradient() -> Goal:
    """-eta times the derivative of (9) by w_j, the other neurons gathered in one term."""
    return Goal((equal(descent(plain), eta * residual(plain) * plain),), flow={weight: sp.Integer(1)})


@paper.claim("12", "Gradient step of a width", "identity",
             r"\Delta b_j = \eta[f(\mathbf{x}) - \hat{f}(\mathbf{x})]w_jh_j\frac{\|\mathbf{x} - \mathbf{c}_j\|^2}{b_j^3}",
             "proved", scope=EVERY_SIZE,
             where=letters(of_width) | {r"\Delta b_j": descent(of_width), r"\|\mathbf{x} - \mathbf{c}_j\|": sp.sqrt(squared)},
             reading=f"The step is -eta times the derivative of (9) by b_j, with (5), q being the squared distance. {GATHERED}.")
def width_gradient() -> Goal:
    """-eta times the derivative of (9) by b_j, with (5); q is the squared distance, of any dimension."""
    step = eta * residual(of_width) * weight * of_width * squared / width**3
    return Goal((equal(descent(of_width), step),), (greater(width, 0),), {width: sp.Integer(1)})


def _center_goal(distance: sp.Expr) -> Goal:
    step = eta * residual(of_center) * weight * of_center * distance / width**2
    return Goal((equal(descent(of_center), step),), flow={c_ji: sp.Integer(1)})


CENTER_WHERE = letters(of_center) | {r"\Delta c_{ji}": descent(of_center)}
CENTER_READING = f"The step is -eta times the derivative of (9) by c_ji, with (5), the other inputs' distance in one term. {GATHERED}."


@paper.claim("14", "Gradient step of a center", "identity",
             r"\Delta c_{ji} = \eta[f(\mathbf{x}) - \hat{f}(\mathbf{x})]w_jh_j\frac{x_i - c_{ji}^2}{b_j^2}", "refuted",
             scope=EVERY_SIZE, glyph="14.glyph", where=CENTER_WHERE, reading=CENTER_READING,
             correction=lambda: _center_goal(x_i - c_ji),
             corrected_statement=r"\Delta c_{ji} = \eta[f - \hat f]w_jh_j\frac{x_i - c_{ji}}{b_j^2}",
             note="The square on c_ji subtracts square metres from metres. It may be a misread index: 14.glyph decides "
                  "the line without it.")
def center_gradient() -> Goal:
    """-eta times the derivative of (9) by c_ji, against the printed line."""
    return _center_goal(x_i - c_ji**2)


@paper.claim("14.glyph", "Gradient step of a center, without the square", "identity",
             r"\Delta c_{ji} = \eta[f(\mathbf{x}) - \hat{f}(\mathbf{x})]w_jh_j\frac{x_i - c_{ji}}{b_j^2}", "proved",
             origin="ours", scope=EVERY_SIZE, glyph="14", where=CENTER_WHERE, reading=CENTER_READING)
def center_gradient_unsquared() -> Goal:
    """The same with c_ji."""
    return _center_goal(x_i - c_ji)


def _momentum(equation: str, step_of: str, printed: str, moved: sp.Expr, hidden: sp.Expr, gradient: sp.Expr,
              rests_on: tuple[str, ...]) -> None:
    before = sp.Symbol("before", real=True)
    letter = printed.split("(t)", maxsplit=1)[0]
    step = printed.split(f"{letter}(t-1) + ")[1].split(" + ", maxsplit=1)[0]
    stated = moved + descent(hidden) + varpi * (moved - before)

    @paper.claim(equation, f"Momentum update of {step_of}", "identity", printed, "proved", scope=EVERY_SIZE,
                 premises=rests_on, rests_on=rests_on,
                 where=letters(hidden) | {f"{letter}(t)": network.with_momentum(moved, gradient, varpi, before),
                                          f"{letter}(t-1)": moved, f"{letter}(t-2)": before, step: descent(hidden)},
                 reading="The left side is the update that the workbench's network makes; the step on the right is -eta "
                         "times the gradient of (9).")
    def update() -> Goal:
        return Goal((equal(network.with_momentum(moved, gradient, varpi, before), stated),),
                    (greater(width, 0),) if hidden.has(width) else (), {moved: sp.Integer(1)})


_momentum("11", "a weight", r"w_j(t) = w_j(t-1) + \Delta w_j(t) + \varpi[w_j(t-1) - w_j(t-2)]", weight, plain,
          network.weight_step(eta, residual(plain), plain), ("10",))
_momentum("13", "a width", r"b_j(t) = b_j(t-1) + \Delta b_j + \varpi[b_j(t-1) - b_j(t-2)]", width, of_width,
          network.width_step(eta, residual(of_width), weight, of_width, squared, width), ("12",))
_momentum("15", "a center", r"c_{ji}(t) = c_{ji}(t-1) + \Delta c_{ji} + \varpi[c_{ji}(t-1) - c_{ji}(t-2)]", c_ji, of_center,
          network.center_step(eta, residual(of_center), weight, of_center, x_i, c_ji, width), ("14.glyph",))


@paper.claim("15.rates", "The stated learning rate and momentum factor are in range", "condition",
             r"\eta \in (0, 1),\ \varpi \in (0, 1)", "proved", at={eta: Fraction(2, 10), varpi: Fraction(4, 100)},
             where={r"\eta": eta, r"\varpi": varpi},
             reading="Section 6.1 states eta = 0.2 and writes the momentum factor as omega = 0.04.")
def learning_rates() -> Goal:
    """At eta = 0.2 and 0.04."""
    return Goal((greater(eta, 0), less(eta, 1), greater(varpi, 0), less(varpi, 1)))


a_1, b_1, c_1, a_2, b_2, c_2 = sp.symbols("a_1 b_1 c_1 a_2 b_2 c_2", positive=True)
f_1, f_2 = sp.symbols("f_1 f_2", real=True)


def same_motion() -> Relation:
    """Two trains that answer the same input at the same speed with the same acceleration."""
    return equal(u - a_1 - b_1 * x_2 - c_1 * x_2**2 + f_1, u - a_2 - b_2 * x_2 - c_2 * x_2**2 + f_2)


@paper.claim("10.measured", "The gradient laws use only what is measured", "implication",
             r"u, x_2, \dot{x}_2\ \text{measured} \Rightarrow f(\mathbf{x}) - \hat{f}(\mathbf{x})\ \text{known}", "gap",
             origin="ours", rests_on=(),
             note="(10)-(15) are driven by f - f-hat, while f is the unknown that the network is there for and a*, b*, c* are "
                  "unknown too. Two trains with other coefficients and another f move alike, so f cannot be told from the "
                  "motion, not even with the acceleration measured.")
def f_is_known() -> Goal:
    """The same input, speed and acceleration mean the same f."""
    return Goal((equal(f_1, f_2),), (same_motion(),))


one_h = sp.Symbol("h", positive=True)


@paper.claim("37.weights", "One W-hat obeys both laws that are given for it, (10) with (11) and (37)", "implication",
             r"\text{(10) with (11), and (37), are both given for } \hat{\mathbf{W}};\ \text{section 6.1 sets } \eta, \text{ the momentum factor and } \chi", "gap", origin="implied", match="words",
             severity="data", section="6.1",
             reading="Section 6.1 states eta and the momentum factor of (10) to (15) beside chi of (37) and does not say which ran. Were both to hold of the same weights, these would be left "
                     "as they are at the same instants. Where f-hat = f and the weights rest, w_j(t-1) = w_j(t-2), the step of (10) and (11) is zero, whatever length of time it stands for.",
             note="They are two laws: where f-hat = f and the weights rest, (10) and (11) leave them and (37) does not. (10) to (15) also need f, which is unknown (10.measured), "
                  "and move centers and widths, with which W* would move (8.fixed). Theorem 1 is of (37) with fixed centers and widths: (37) should be named as the law of the weights, "
                  "and (10) to (15) be no part of the controller. If (12) to (15) alone ran beside (37), for centers and widths, the weights had one law, and W* moved all the same.")
def one_law() -> Goal:
    """The rate of (37) where the step of (10) is zero."""
    error_2 = sp.Symbol("e_2", real=True)
    return Goal((equal(chi * error_2 * one_h - chi * weight, 0),),
                (greater(eta, 0), less(eta, 1), at_most(one_h, 1), equal(eta * residual(one_h) * one_h, 0)))


f_network = over_neurons(W_star * h) + epsilon
f_hat = law.f_hat.xreplace({law.h: h})


paper.definition("16", "The output of the network",
                 r"\hat{f}(\mathbf{x}) = \hat{\mathbf{W}}^T\mathbf{h}(\mathbf{x})")


@paper.claim("17", "Approximation error", "identity",
             r"\tilde{f}(\mathbf{x}) = f(\mathbf{x}) - \hat{f}(\mathbf{x}) = \mathbf{W}^{*T}\mathbf{h}(\mathbf{x}) + "
             r"\varepsilon(\mathbf{x}) - \hat{\mathbf{W}}^T\mathbf{h}(\mathbf{x}) = -\tilde{\mathbf{W}}^T\mathbf{h}(\mathbf{x}) + "
             r"\varepsilon(\mathbf{x})", "proved", scope=EVERY_NETWORK, rests_on=("7.bounded",),
             where={r"\tilde{f}(\mathbf{x})": error_f - f_hat, r"f(\mathbf{x})": error_f, r"\hat{f}(\mathbf{x})": f_hat,
                    r"\varepsilon(\mathbf{x})": epsilon, r"\hat{\mathbf{W}}^T \mathbf{h}(\mathbf{x})": f_hat,
                    r"\tilde{\mathbf{W}}^T \mathbf{h}(\mathbf{x})": over_neurons((W_hat - W_star) * h)},
             note="With (7), (16) and the printed W-tilde = W-hat - W*.")
def approximation_error() -> Goal:
    """f - f_hat with (7), (16) and W_tilde = W_hat - W_star."""
    return Goal((equal(error_f - f_hat, error_f - f_hat), equal(error_f - f_hat, f_network - f_hat),
                 equal(f_network - f_hat, -over_neurons((W_hat - W_star) * h) + epsilon)), (equal(error_f, f_network),))

"""yang2021, section 3: the network, its gradient laws, and what approximates the resistance."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from .. import laws as law
from .. import network
from ..error_dynamics import EVERY_NETWORK, STATED_F_STAR, W_star, W_tilde, eps_star, epsilon, f_star, f_true, h
from ..paper import paper
from ..stated_values import after_jump, before_jump, section_resistances

error_f, weight, rest_f, eta, varpi = sp.symbols("f w f_rest eta varpi", real=True)
width = sp.Symbol("b_j", positive=True)
x_i, c_ji, q_rest, squared = sp.symbols("x_i c_ji q_rest q", real=True)


def loss(hidden: sp.Expr) -> sp.Expr:
    """(9) with the other neurons' output gathered in f_rest."""
    return (error_f - weight * hidden - rest_f) ** 2 / 2


def residual(hidden: sp.Expr) -> sp.Expr:
    """f - f_hat."""
    return error_f - weight * hidden - rest_f


@paper.claim("10", "Gradient step of a weight", "identity", r"\Delta w_j = \eta\,[f - \hat f]\,h_j", "proved",
             scope="every number of neurons and inputs")
def weight_gradient() -> Goal:
    """-eta dE/dw_j of (9), the other neurons gathered in one term."""
    hidden = sp.Symbol("h_j", real=True)
    step = network.weight_step(eta, residual(hidden), hidden)
    return Goal((equal(-eta * D(loss(hidden)), step),), flow={weight: sp.Integer(1)})


@paper.claim("12", "Gradient step of a width", "identity",
             r"\Delta b_j = \eta\,[f - \hat f]\,w_j h_j \frac{\|x - c_j\|^2}{b_j^3}", "proved",
             scope="every number of neurons and inputs")
def width_gradient() -> Goal:
    """-eta dE/db_j of (9) with (5); q is the squared distance, of any dimension."""
    hidden = sp.exp(-squared / (2 * width**2))
    step = network.width_step(eta, residual(hidden), weight, hidden, squared, width)
    return Goal((equal(-eta * D(loss(hidden)), step),), (greater(width, 0),), {width: sp.Integer(1)})


def _center_goal(printed: bool) -> Goal:
    hidden = sp.exp(-((x_i - c_ji) ** 2 + q_rest) / (2 * width**2))
    step = network.center_step_as_printed if printed else network.center_step
    stated = step(eta, residual(hidden), weight, hidden, x_i, c_ji, width)
    return Goal((equal(-eta * D(loss(hidden)), stated),), flow={c_ji: sp.Integer(1)})


@paper.claim("14", "Gradient step of a center", "identity",
             r"\Delta c_{ji} = \eta\,[f - \hat f]\,w_j h_j \frac{x_i - c_{ji}^2}{b_j^2}", "refuted",
             scope="every number of neurons and inputs",
             correction=lambda: _center_goal(printed=False),
             corrected_statement=r"\Delta c_{ji} = \eta\,[f - \hat f]\,w_j h_j \frac{x_i - c_{ji}}{b_j^2}",
             note="The square on c_ji is an error: it adds metres to square metres.")
def center_gradient() -> Goal:
    """-eta dE/dc_ji of (9) with (5), the other inputs' distance gathered in one term."""
    return _center_goal(printed=True)


def _momentum(equation: str, quantity: str, step_of: str) -> None:
    value, step = sp.symbols(f"{quantity} Delta", real=True)

    @paper.claim(equation, f"Momentum update of {step_of} (a definition)", "identity",
                 rf"{quantity}(t) = {quantity}(t-1) + \Delta {quantity} + \varpi[{quantity}(t-1) - {quantity}(t-2)]",
                 "proved", premises=({"11": "10", "13": "12", "15": "14"}[equation],),
                 note="Decided: a parameter at rest, (t-1) = (t-2), moves by exactly the gradient step, so it "
                      "rests just where the gradient vanishes, whatever the momentum factor.")
    def at_rest() -> Goal:
        moved = network.with_momentum(value, step, varpi, value)
        return Goal((equal(moved - value, step),))


_momentum("11", "w_j", "a weight")
_momentum("13", "b_j", "a width")
_momentum("15", "c_ji", "a center")


@paper.claim("17", "Approximation error", "identity",
             r"\tilde f = W^{*T}h + \varepsilon - \hat W^T h = -\tilde W^T h + \varepsilon", "proved",
             scope=EVERY_NETWORK)
def approximation_error() -> Goal:
    """f - f_hat with (7), (16) and W_tilde = W_hat - W_star."""
    f_hat = law.f_hat.xreplace({law.h: h}).xreplace({law.W_hat: W_tilde + W_star})
    return Goal((equal(f_true - f_hat, -over_neurons(W_tilde * h) + epsilon),))


@paper.claim("A2", "Assumption 2: f is bounded on the line of Table 1", "condition",
             r"|f(x)| \le f^*", "proved", at={f_star: STATED_F_STAR},
             note="With f* = 0.06 m/s^2, on every section of Table 1; the disturbance that the paper adds is not described.")
def resistance_bounded() -> Goal:
    """Grade and curve resistance of every section against f*."""
    values = [sp.Rational(x.numerator, x.denominator) for x in section_resistances()]
    return Goal((at_most(max(values), f_star), at_least(min(values), -f_star)))


f_before, f_after, y_f = sp.symbols("f_before f_after y_f", real=True)

paper.axiom("7", "Universal approximation by the network",
            r"f(x) = W^{*T}h(x) + \varepsilon(x),\ |\varepsilon(x)| \le \varepsilon^*\ \text{on the compact}\ \Theta_x",
            "Park and Sandberg 1991, for f continuous on a compact set", hypotheses=("7.continuous", "7.inside"))


@paper.claim("7.continuous", "f is continuous in x on the line of Table 1", "condition",
             r"\lim_{x_1 \uparrow s} f = \lim_{x_1 \downarrow s} f", "violated",
             at={f_before: before_jump, f_after: after_jump},
             note="At the border with the largest jump. Grade and curve change in steps in Table 1, so f is not "
                  "continuous and eps* cannot be made small.")
def resistance_is_continuous() -> Goal:
    """The additional resistance on both sides of a section border agrees."""
    return Goal((equal(f_before, f_after),))


@paper.claim("7.error", "What a step in f costs the approximation", "inequality",
             r"|f(s^\pm) - y| \le \varepsilon^* \Rightarrow \varepsilon^* \ge \tfrac12 |f(s^+) - f(s^-)|", "proved")
def step_costs_half() -> Goal:
    """A continuous output y misses one side of a step by half of it."""
    near = tuple(rel for side in (f_before, f_after)
                 for rel in (at_most(side - y_f, eps_star), at_most(y_f - side, eps_star)))
    return Goal((at_most(f_after - f_before, 2 * eps_star), at_most(f_before - f_after, 2 * eps_star)), near)


x_out, theta = sp.symbols("x theta", real=True)


@paper.claim("7.inside", "The state stays in the set on which (7) holds", "implication",
             r"|\varepsilon(x)| \le \varepsilon^*\ \text{for}\ x \in \Theta_x \Rightarrow "
             r"|\varepsilon(x(t))| \le \varepsilon^*\ \text{for all}\ t", "gap",
             note="The proof uses |eps(x(t))| <= eps* for all t, which holds only while x(t) stays in Theta_x; that "
                  "it does is not shown, and cannot be concluded afterwards from a bound that uses it. In the "
                  "model: Theta_x = [-theta, theta], eps(x) = eps* x^2/theta^2.")
def state_stays_inside() -> Goal:
    """An error that is bounded inside a set may be larger outside."""
    inside_theta = (greater(theta, 0), equal(epsilon, eps_star * x_out**2 / theta**2))
    return Goal((at_most(epsilon, eps_star),), inside_theta)

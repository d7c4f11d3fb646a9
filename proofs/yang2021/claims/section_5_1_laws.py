"""yang2021, section 5.1: the control law (33), the adaptation (34)-(37) and the assumptions on them."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less
from workbench.trains.train import a_star, b_star, c_star, f, u

from .. import laws as law
from ..error_dynamics import EVERY_NETWORK, e_1, h, lambdas, plant, sigmas
from ..laws import W_hat, a_hat, b_hat, beta, c_hat, chi, k, x_1, x_2
from ..lyapunov import V_1, barrier, inside, level
from ..paper import paper
from ..stated_values import cruise, scenario, stated_davis
from .section_5_1 import IN_SPEEDS, resistance

hats = (a_hat, b_hat, c_hat)
ESTIMATES = IN_SPEEDS | {rf"\hat{{{name}}}": hat for name, hat in zip("abc", hats, strict=True)}
f_hat = over_neurons(W_hat * h)
input_felt = D(x_2) + resistance - f  # what (4) says of the input of a moving train


def _estimates(speed: sp.Expr) -> sp.Expr:
    return a_hat + b_hat * speed + c_hat * speed**2


@paper.claim("33", "The control law", "identity",
             r"u = \hat{a} + \hat{b}x_2 + \hat{c}x_2^2 - \hat{f}(x) + \dot{r} - \beta e_2 - \frac{e_1}{k^2 - e_1^2}", "proved",
             scope=EVERY_NETWORK, premises=("4",), where=ESTIMATES | {"u": input_felt, r"\hat{f}(x)": f_hat},
             reading="u is the input that the train of the simulated loop feels, by (4).")
def control_law() -> Goal:
    """The input of the loop that is run, read back from the train's acceleration, is (33) with (16)."""
    command = law.rbfnn_pocrac.command.xreplace({law.h: h})
    rates = {x_1: x_2, x_2: plant.rates[x_2].xreplace({u: command}), x_d: xdot_d, xdot_d: xddot_d}
    stated = _estimates(x_2) - f_hat + D(law.r) - beta * law.e_2 - law.e_1 / (k**2 - law.e_1**2)
    return Goal((equal(input_felt, stated),), (greater(k**2 - law.e_1**2, 0),), rates)


def _adaptation(equation: str, i: int, printed: str, coefficient: str, regressor: sp.Expr) -> None:
    @paper.claim(equation, f"Adaptive law of {coefficient}", "identity", printed, "proved", where=ESTIMATES,
                 reading="The rate is that of the estimate in the simulated loop.")
    def rate_of_estimate() -> Goal:
        state = law.adaptation[i]
        assert state.rate is not None
        return Goal((equal(D(hats[i]), -lambdas[i] * (regressor * law.e_2 + sigmas[i] * hats[i])),),
                    flow={hats[i]: state.rate})


_adaptation("34", 0, r"\dot{\hat{a}} = -\lambda_1(e_2 + \sigma_1\hat{a})", "a*", sp.Integer(1))
_adaptation("35", 1, r"\dot{\hat{b}} = -\lambda_2(x_2e_2 + \sigma_2\hat{b})", "b*", x_2)
_adaptation("36", 2, r"\dot{\hat{c}} = -\lambda_3(x_2^2e_2 + \sigma_3\hat{c})", "c*", x_2**2)

one_weight, one_h = sp.Symbol("W_hat", real=True), sp.Symbol("h", positive=True)


@paper.claim("37", "Adaptive law of the weights", "identity", r"\dot{\hat{W}} = \chi e_2h(x) - \chi\hat{W}", "proved",
             scope=EVERY_NETWORK, where=IN_SPEEDS | {r"\hat{W}": one_weight, "h(x)": one_h},
             reading="Of one neuron, which stands for each; the rate is that of its weight in the simulated loop.")
def rate_of_weight() -> Goal:
    """The rate of one weight."""
    assert law.weight_adaptation.rate is not None
    rate = law.weight_adaptation.rate.xreplace({law.h: one_h, W_hat: one_weight})
    return Goal((equal(D(one_weight), chi * law.e_2 * one_h - chi * one_weight),), flow={one_weight: rate})


@paper.claim("37.steady", "Where (37) rests the network is a proportional gain", "identity", r"\dot{\hat{W}} = 0 \Rightarrow \hat{W}^Th(x) = h(x)^Th(x)\,e_2",
             "proved", origin="ours", premises=("37",), scope=EVERY_NETWORK, reading="Of one neuron, which stands for each.",
             note="(37) is a lag of e_2 h, with the time constant 1/chi: it draws the weights to e_2 h, not to W*, and the share W*^2/2 of l is the price, which no gain reduces.")
def network_at_rest() -> Goal:
    """The output of one neuron whose weight rests."""
    return Goal((equal(one_weight * one_h, one_h**2 * law.e_2),), (equal(chi * law.e_2 * one_h - chi * one_weight, 0),))


@paper.claim("A3", "Assumption 3: the desired curve and its two derivatives are bounded, on a curve that stands for Figure 3", "condition",
             r"\text{The desired position $x_d$ and its first-order derivatives $\dot{x}_d$ and second-order derivatives "
             r"$\ddot{x}_d$ are known and bounded.}", "proved", match="words",
             at={x_d: Fraction(53880), xdot_d: Fraction(round(cruise * 100), 100), xddot_d: Fraction(6, 10)},
             reading="At their largest on the curve that stands for Figure 3: the length of Table 1's line, the speed at which "
                     "level track needs 0.6 m/s^2, and that acceleration.",
             note=f"Figure 3 is not in the text; the curve takes {scenario.desired_curve().trip_time_s:.0f} s.")
def desired_curve_bounded() -> Goal:
    """Largest values against round bounds."""
    return Goal((at_most(sp.Abs(x_d), 54000), at_most(sp.Abs(xdot_d), 40), at_most(sp.Abs(xddot_d), 1)))


a_dagger, b_dagger, c_dagger = sp.symbols("a_dagger b_dagger c_dagger", positive=True)


@paper.claim("A5", "Assumption 5: the resistance coefficients are bounded", "condition",
             r"|a^*| \leq a^\dagger,\ |b^*| \leq b^\dagger,\ |c^*| \leq c^\dagger", "proved",
             at={**stated_davis, a_dagger: Fraction(1), b_dagger: Fraction(1, 100), c_dagger: Fraction(1, 1000)},
             reading="At the stated coefficients, with bounds of 1, 1/100 and 1/1000.",
             note="It bounds the coefficients, not how fast they move: see 41.rates.")
def coefficients_bounded() -> Goal:
    """At the stated coefficients."""
    return Goal((at_most(sp.Abs(a_star), a_dagger), at_most(sp.Abs(b_star), b_dagger), at_most(sp.Abs(c_star), c_dagger)))


@paper.claim("A4.barrier", "The barrier term of the input is bounded when V is", "implication",
             r"V_1 \le B \Rightarrow \frac{|e_1|}{k^2 - e_1^2} \le \frac{e^{2B}}{k}", "proved", origin="ours",
             note="At the stated gains B is above l/mu, so the bound is of no use for choosing an actuator.")
def barrier_term_bounded() -> Goal:
    """The last term of (33) against a bound of V_1."""
    inverse = 1 / (k**2 - e_1**2)
    most = sp.exp(2 * level) / k
    return Goal((at_most(e_1 * inverse, most), at_least(e_1 * inverse, -most)), (inside, at_most(V_1, level)),
                facts=(2 * level - sp.log(barrier),),
                lemmas=(at_most(inverse, most / k), at_most(e_1, k), at_least(e_1, -k)))


input_limit = sp.Symbol("u_star", positive=True)


@paper.claim("A4.limit", "No limit that is known beforehand bounds the input", "implication",
             r"\tfrac{k}{2} \le e_1 < k,\ 4u^*(k - e_1) \le 1 \Rightarrow \frac{e_1}{k^2 - e_1^2} \ge u^*", "proved", origin="ours",
             note="For every u* there are errors within the constraint at which the last term of (33) alone is above it. An actuator with a limit cannot follow (33) near "
                  "the constraint, and then (41) does not hold.")
def input_exceeds_every_limit() -> Goal:
    """The last term of (33) close to the constraint."""
    return Goal((at_least(e_1 / (k**2 - e_1**2), input_limit),),
                (at_least(2 * e_1, k), less(e_1, k), at_most(4 * input_limit * (k - e_1), 1)),
                lemmas=(greater(k + e_1, 0), greater((k - e_1) * (k + e_1), 0), greater(k**2 - e_1**2, 0),
                        at_most(4 * input_limit * (k - e_1) * (k + e_1), k + e_1), at_most(input_limit * (k**2 - e_1**2), e_1)))


e_2_signal, rdot = sp.symbols("e_2 rdot", real=True)
reach = dict(zip((*hats, x_2, rdot, e_2_signal), sp.symbols("A_2 B_2 C_2 X_2 R_2 E_2", nonnegative=True), strict=True))
weights_reach, hidden_square = sp.symbols("W_2 H", nonnegative=True)
input_bound = ((reach[a_hat] + 1) / 2 + (reach[b_hat] + reach[x_2]) / 2 + (reach[c_hat] + reach[x_2] ** 2) / 2
               + (weights_reach + hidden_square) / 2 + (reach[rdot] + 1) / 2 + beta * (reach[e_2_signal] + 1) / 2
               + sp.exp(2 * level) / k)


@paper.claim("33.bounded", "The control law is bounded where what it is made of is", "implication",
             r"\hat{a}^2 \le A_2, \dots, \hat{W}^T\hat{W} \le W_2,\ \mathbf{h}^T\mathbf{h} \le H,\ V_1 \le B \Rightarrow |u| \le u^*", "proved", origin="ours",
             premises=("A4.barrier",), scope=EVERY_NETWORK,
             reading="u is (33); u* is made of bounds of the squares of the estimates, speed, virtual acceleration, e_2, weights "
                     "and Gaussians, and of a bound B of V_1.")
def input_bounded() -> Goal:
    """The whole of (33), term by term."""
    last = e_1 / (k**2 - e_1**2)
    command = _estimates(x_2) - f_hat + rdot - beta * e_2_signal - last
    given = (inside, *(at_most(signal**2, most) for signal, most in reach.items()),
             at_most(over_neurons(W_hat**2), weights_reach), at_most(over_neurons(h**2), hidden_square), at_most(V_1, level))
    return Goal((at_most(command, input_bound), at_least(command, -input_bound),), (*given, *paper.shown("A4.barrier")),
                lemmas=(at_most(x_2**4, reach[x_2] ** 2),))


@paper.claim("A4", "Assumption 4: the input is bounded", "implication", r"|u| \leq u^*", "proved",
             premises=("33.bounded",), rests_on=(), scope=EVERY_NETWORK, where={"u^*": input_limit},
             reading="u is (33), which is not assumed to be bounded, and u* the bound of 33.bounded.",
             note="The paper supposes what is for its proof to show; it can be shown, objective.input has the bounds that 33.bounded takes. If u* is meant as the limit of an "
                  "actuator, (33) does not keep it: A4.limit.")
def input_is_bounded() -> Goal:
    """Both sides of 33.bounded."""
    above, below = paper.shown("33.bounded")
    named = {above.left: u, above.right: input_limit, below.right: -input_limit}
    return Goal((at_most(sp.Abs(u), input_limit),), (above.subs(named), below.subs(named)))

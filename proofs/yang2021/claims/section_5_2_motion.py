"""yang2021, section 5.2: the moment T after (52), when there is one, and a motion of the printed loop that has none."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal, greater

from ..error_dynamics import W_star, W_tilde, e_1, e_2, eps_star, epsilon, flow, h, lambdas, sigmas, stars, tildes
from ..laws import alpha, beta, chi, k
from ..lyapunov import V_0, V, V_t, V_t_rate, along_v, decaying, error_bound, from_zero, inside, l_, l_stated, mu, t
from ..paper import paper
from ..stated_values import stated_davis

weight, ideal, output = sp.symbols("W_tilde W_star h", real=True)
ONE_NEURON = {W_tilde: weight, W_star: ideal, h: output}
moving = (e_1, e_2, weight, *tildes)
rates = dict(zip(moving, sp.symbols("edot_1 edot_2 Wdot adot bdot cdot", real=True), strict=True))


def of_one_neuron(expr: sp.Expr) -> sp.Expr:
    """The expression for a network of a single neuron."""
    return expr.replace(sp.Sum, lambda summand, *_: summand).xreplace(ONE_NEURON)


loop = {of_one_neuron(symbol): of_one_neuron(rate) for symbol, rate in flow.items()}
smallest = sp.Min(2 * alpha, 2 * beta - 1, chi, *(lam * sigma for lam, sigma in zip(lambdas, sigmas, strict=True)))


@paper.claim("52.T", "The text after (52): From some time on V is at most l/mu", "limit",
             r"\text{The inequality in Equation (52) means that there is a moment } T, \text{ and, for } \forall t > T, 0 \leq V(t) \leq "
             r"\frac{l}{\mu} \text{ is always established}", "gap", premises=("52",), match="words",
             reading="For every V with (51) and (52).",
             note="(51) and (52) let V stay above l/mu for ever, and in a motion of the loop itself it does (52.T.loop): x_d' = 0, the train stands at x_d and on the center of the one neuron, so that h = 1, f = W* = a* holds it "
                  "there, and a-hat = W-hat = -exp(-t) cancel in (33). Where V(0) <= l/mu the line holds with T = 0 (52.T.start), so at "
                  "the numbers of section 6.1 with first weights of 0 and a desired curve that starts at 0 and at rest (52.T.stated). True in any case is the limit, and with it (53) to (57), where 'converge to' a set means that the "
                  "distance to it goes to zero.")
def moment_from_52() -> Goal:
    """(52) against a V that comes down to l/mu and never reaches it."""
    above = {V_t: 1 + sp.exp(-t), V_0: sp.Integer(2), l_: sp.Integer(1), mu: sp.Integer(1)}
    return Goal((at_most(V_t, l_ / mu),), (), along_v, (decaying[0], *paper.shown("52")), from_zero, eventually=t, model=above,
                inputs=(V_t_rate,))


@paper.claim("52.T.start", "V stays at most l/mu where it starts so", "implication",
             r"V(0) \leq \frac{l}{\mu} \Rightarrow V(t) \leq \frac{l}{\mu},\ \forall t \geq 0", "proved", origin="ours", premises=("52",))
def never_above() -> Goal:
    """From (52): what is added to l/mu is not positive."""
    return Goal((at_most(V_t, l_ / mu),), (at_most(V_0, l_ / mu), at_least(t, 0), paper.shown("52")[1]),
                lemmas=(at_most((V_0 - l_ / mu) * sp.exp(-mu * t), 0),))


@paper.claim("52.T.loop", "The moment T in the loop itself", "limit",
             r"\exists T\ \forall t > T: V(t) \leq \frac{l}{\mu}\ \text{along (4), (27), (33)-(37)}", "refuted", origin="ours",
             closed_loop=True, scope="every network with one neuron", reading="For mu of (49) and l of (50).",
             note="The train stands at its desired position, on the center of the one neuron, f = W* = a* holds it there exactly (epsilon = 0), and a-hat = W-hat = -exp(-t) "
                  "cancel in (33) while they fade: V comes down to l/mu, and is above it at all times. All assumptions are met but Assumption 1, which no train of (4) meets (A1).")
def reached_in_finite_time() -> Goal:
    """The loop at rest, with two estimates that fade and cancel."""
    one, zero, fading = sp.Integer(1), sp.Integer(0), sp.exp(-t)
    a, b, c = (sp.Rational(stated_davis[s].numerator, stated_davis[s].denominator) for s in stars)
    gains = dict.fromkeys((alpha, beta, chi, k, mu, *lambdas, *sigmas), one)
    motion = {e_1: zero, e_2: zero, tildes[0]: -a - fading, tildes[1]: -b, tildes[2]: -c, weight: -a - fading}
    constants = {**gains, **dict(zip(stars, (a, b, c), strict=True)), ideal: a, output: one, epsilon: zero, eps_star: zero,
                 sp.Symbol("xdot_d", real=True): zero}
    given = (equal(mu, smallest), *error_bound, greater(output, 0), at_most(output, 1))
    return Goal((at_most(of_one_neuron(V), of_one_neuron(l_stated) / mu),), given, {t: one, **rates},
                (inside, *(equal(rates[symbol], loop[symbol]) for symbol in moving)), eventually=t, model=motion | constants,
                inputs=tuple(rates.values()))

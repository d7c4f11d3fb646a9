"""Section 2 of $name, a file a section. A claim: number, title, kind, what is printed, the verdict expected.

Kinds: identity, inequality, condition (at stated numbers), implication, limit. Numbers are exact: sp.Rational(1, 10).
"""

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, less

from ..laws import V, adaptive_pd, d, d_hat, f, gamma, k, plant, s, u
from ..paper import paper

# The closed loop, from plant and law: no derivative is typed by hand.
disturbed = {state: rate.xreplace({u: adaptive_pd.command}) for state, rate in plant.items()}
disturbed |= {d_hat: adaptive_pd.states[0].rate}
flow = {state: rate.xreplace({f: sp.S.Zero}) for state, rate in disturbed.items()}


@paper.claim("3", "The error dynamics", "identity", r"\dot s = -k s + \hat d - d", "proved")
def error_dynamics() -> Goal:
    """D(...) is the derivative along `flow`. This text becomes the note of the claim."""
    return Goal((equal(D(s), -k * s + d_hat - d),), flow=flow)


@paper.claim("4", "V does not increase", "inequality", r"\dot V = -k s^2 \le 0", "proved", premises=("3",))
def not_increasing() -> Goal:
    """The adaptation law cancels what the controller does not know."""
    return Goal((equal(D(V), -k * s**2), at_most(D(V), 0)), flow=flow)


@paper.claim("5", "The error is bounded by V", "implication", r"V \le b \Rightarrow s^2 \le 2 b", "proved")
def bounded() -> Goal:
    """What is given stands in `assume`, besides what sympy knows of the symbols."""
    b = sp.Symbol("b", positive=True)
    return Goal((at_most(s**2, 2 * b), at_least(V, 0)), assume=(at_most(V, b),))


@paper.claim("6", "V under a disturbance", "inequality", r"\dot V \le -\tfrac{k}{2} s^2 + \tfrac{1}{4k} f^2", "refuted",
             premises=("4",), correction=lambda: decrease(sp.Integer(2)),
             corrected_statement=r"\dot V \le -\tfrac{k}{2} s^2 + \tfrac{1}{2k} f^2",
             note="Printed with half of the disturbance's term; the certificate holds a point where it fails.")
def disturbed_decrease() -> Goal:
    """As it is printed, so that the printed statement is what is decided."""
    return decrease(sp.Integer(4))


def decrease(divisor: sp.Expr) -> Goal:
    """The bound on the derivative of V with f^2/(divisor k)."""
    return Goal((at_most(D(V), -k / 2 * s**2 + f**2 / (divisor * k)),), flow=disturbed)


@paper.claim("7", "The stated gains adapt slowly against the feedback", "condition", r"4 \gamma < k^2", "violated",
             at={k: Fraction(1), gamma: Fraction(1, 2)}, repair={k: Fraction(3, 2), gamma: Fraction(1, 2)})
def slow_adaptation() -> Goal:
    """No oscillation of (3) with (2), at the numbers that the paper states and at those that repair it."""
    return Goal((less(4 * gamma, k**2),))


# A result cited from the literature is assumed by name; its hypotheses are claims of their own.
paper.axiom("8", "The error vanishes", r"\lim_{t \to \infty} e(t) = 0", "the LaSalle-Yoshizawa theorem",
            hypotheses=("4", "5"))

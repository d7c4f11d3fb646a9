"""Section 2 of $name. A claim: number, title, kind, what is printed, the verdict expected.

Kinds: identity, inequality, condition (at stated numbers), implication, limit. Numbers are exact: sp.Rational(1, 10).
"""

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.systems.lyapunov import closed_loop

from ..laws import V, a_hat, adaptive, k, s
from ..paper import paper
from ..plant import a, d, plant, v

# The closed loop from plant and law: no derivative is typed by hand. Without disturbance, unless a claim has one.
disturbed = closed_loop(plant, adaptive)
flow = {state: rate.xreplace({d: sp.S.Zero}) for state, rate in disturbed.items()}
b = sp.Symbol("b", positive=True)


@paper.claim("3", "The error dynamics", "identity", r"\dot s = -k s + (\hat a - a) v", "proved")
def error_dynamics() -> Goal:
    """D(...) is the derivative along `flow`. This text becomes the note of the claim."""
    return Goal((equal(D(s), -k * s + (a_hat - a) * v),), flow=flow)


@paper.claim("4", "V does not increase", "inequality", r"\dot V = -k s^2 \le 0", "proved", premises=("3",),
             severity="result")
def not_increasing() -> Goal:
    """The adaptation cancels what the law does not know."""
    return Goal((equal(D(V), -k * s**2), at_most(D(V), 0)), flow=flow)


@paper.claim("5", "The error is bounded by V", "implication", r"V \le b \Rightarrow s^2 \le 2 b", "proved")
def bounded() -> Goal:
    """What is given stands in `assume`, besides what sympy knows of the symbols."""
    return Goal((at_most(s**2, 2 * b), at_least(V, 0)), assume=(at_most(V, b),))


@paper.claim("6", "V grows beyond every bound", "limit", r"|s| \to \infty \Rightarrow V \to \infty", "proved",
             reading="With the distance named: V >= b as soon as s^2 >= 2 b, for every b.")
def unbounded() -> Goal:
    """A limit names its distance."""
    return Goal((at_least(V, b),), assume=(at_least(s**2, 2 * b),))


@paper.claim("7", "V under a disturbance", "inequality", r"\dot V \le -\tfrac{k}{2} s^2 + \tfrac{1}{4k} d^2", "refuted",
             premises=("4",), correction=lambda: decrease(sp.Integer(2)),
             corrected_statement=r"\dot V \le -\tfrac{k}{2} s^2 + \tfrac{1}{2k} d^2",
             note="Printed with half of the disturbance's term; the certificate holds a point where it fails.")
def disturbed_decrease() -> Goal:
    """As it is printed, so that the printed statement is what is decided."""
    return decrease(sp.Integer(4))


def decrease(divisor: sp.Expr) -> Goal:
    """The bound on the derivative of V with d^2/(divisor k)."""
    return Goal((at_most(D(V), -k / 2 * s**2 + d**2 / (divisor * k)),), flow=disturbed, inputs=(d,))

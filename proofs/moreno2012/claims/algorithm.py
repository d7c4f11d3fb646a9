"""moreno2012: the algorithm as a flow of zeta, and V along it without perturbation."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal, greater
from workbench.systems.lyapunov import closed_loop

from ..laws import k_1, k_2, root, super_twisting, w
from ..paper import BY_SIGN, OFF_ZERO, paper
from ..plant import phi, sliding, x_1

r = sp.Symbol("r", positive=True)
y, rho_1, rho_2 = sp.symbols("y rho_1 rho_2", real=True)
p_11, p_12, p_22 = sp.symbols("p_11 p_12 p_22", real=True)
zeta = sp.Matrix([r, y])
A = sp.Matrix([[-k_1 / 2, sp.Rational(1, 2)], [-k_2, 0]])
P = sp.Matrix([[4 * k_2 + k_1**2, -k_1], [-k_1, 2]]) / 2
Q = k_1 / 2 * sp.Matrix([[2 * k_2 + k_1**2, -k_1], [-k_1, 1]])


def form(matrix: sp.Matrix) -> sp.Expr:
    """zeta^T matrix zeta, which is the same with both signs turned."""
    return sp.expand((zeta.T * matrix * zeta)[0])


V = form(P)


def flow(first: sp.Expr, second: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """r = |x_1|^(1/2) and y = sign(x_1) x_2; what perturbs x_1 and x_2 likewise times the sign of x_1."""
    return {r: (-k_1 * r + y + first) / (2 * r), y: -k_2 + second}


UNPERTURBED = flow(sp.S.Zero, sp.S.Zero)


@paper.claim("loop", "The loop is the algorithm", "identity",
             r"\dot x_1 = -k_1 |x_1|^{1/2} \operatorname{sign}(x_1) + x_2,\ \dot x_2 = -k_2 \operatorname{sign}(x_1) + \rho_2",
             "proved", reading="x_2 = w + phi, the law's integral term and the perturbation, whose rate is rho_2.")
def loop() -> Goal:
    """From the plant and the law that are simulated."""
    moving = {**closed_loop(sliding, super_twisting), phi: rho_2}
    return Goal((equal(D(x_1), -k_1 * root + w + phi), equal(D(w + phi), -k_2 * sp.sign(x_1) + rho_2)), flow=moving,
                inputs=(rho_2,))


@paper.claim("zeta", "Linear but for a positive factor", "identity", r"\dot \zeta = |x_1|^{-1/2} A \zeta", "proved",
             scope=OFF_ZERO, reading=BY_SIGN)
def linear_but_for_a_factor() -> Goal:
    """The change of variables that makes a quadratic form of V; with r^2 = |x_1|, whose rate is as printed."""
    rows = [equal(D(one), right / r) for one, right in zip(zeta, A * zeta, strict=True)]
    return Goal((*rows, equal(D(r**2), -k_1 * r + y)), flow=UNPERTURBED)


@paper.claim("V", "V is positive definite", "inequality",
             r"V = 2 k_2 |x_1| + \tfrac12 x_2^2 + \tfrac12 (k_1 |x_1|^{1/2} \operatorname{sign}(x_1) - x_2)^2 = \zeta^T P \zeta > 0",
             "proved", scope=OFF_ZERO, reading=BY_SIGN)
def positive() -> Goal:
    """Its two forms agree, and it is positive."""
    stated = 2 * k_2 * r**2 + y**2 / 2 + (k_1 * r - y) ** 2 / 2
    return Goal((equal(stated, V), greater(V, 0)))


@paper.claim("V.across", "and where x_1 vanishes", "implication", r"x_1 = 0,\ x_2 \ne 0 \Rightarrow V = x_2^2 > 0", "proved",
             origin="implied", reading="The form of zeta at r = 0, with y for x_2.")
def positive_across() -> Goal:
    """All states but the origin together with the row before."""
    x_2 = sp.Symbol("x_2", real=True)
    return Goal((greater(V.subs({r: 0, y: x_2}), 0),), (differ(x_2, 0),))


@paper.claim("family", "Every P gives its Q", "identity",
             r"\dot V = -|x_1|^{-1/2} \zeta^T Q \zeta,\ A^T P + P A = -Q", "proved", premises=("zeta",), scope=OFF_ZERO,
             reading=BY_SIGN)
def every_P() -> Goal:
    """For every symmetric P."""
    of_any = sp.Matrix([[p_11, p_12], [p_12, p_22]])
    return Goal((equal(D(form(of_any)), form(A.T * of_any + of_any * A) / r),), flow=UNPERTURBED)


@paper.claim("hurwitz", "A is Hurwitz for all positive gains", "inequality", r"\operatorname{tr} A < 0,\ \det A > 0", "proved")
def hurwitz() -> Goal:
    """Of a matrix of two rows both eigenvalues then have negative real parts."""
    return Goal((greater(-A.trace(), 0), greater(A.det(), 0)))


@paper.claim("decrease", "V decreases", "identity",
             r"\dot V = -|x_1|^{-1/2} \zeta^T Q \zeta,\ "
             r"Q = \frac{k_1}{2} \begin{pmatrix} 2 k_2 + k_1^2 & -k_1 \\ -k_1 & 1 \end{pmatrix}",
             "proved", premises=("family",), scope=OFF_ZERO, reading=BY_SIGN)
def decrease() -> Goal:
    """With the P above."""
    return Goal((equal(D(V), -form(Q) / r),), flow=UNPERTURBED)


@paper.claim("Q", "V is a strict Lyapunov function for all positive gains", "inequality", r"\zeta^T Q \zeta > 0", "proved",
             scope=OFF_ZERO, severity="result", rests_on=("decrease", "V"), reading=BY_SIGN)
def strict() -> Goal:
    """A square and a positive rest."""
    return Goal((greater(form(Q), 0),))


length, v, q, m = sp.symbols("l v q m", positive=True)  # |zeta|, V^(1/2), lambda_min(Q), lambda_min(P)^(1/2)
most = sp.Symbol("p_max", positive=True)  # lambda_max(P)


def sizes() -> tuple[Relation, ...]:
    """What the eigenvalues say, and that the first component is no longer than the vector."""
    return (at_most(m * length, v), at_most(v**2, most * length**2), at_most(r, length))


@paper.claim("rate", "V falls at least as its root", "inequality",
             r"\dot V \le -\gamma V^{1/2},\ \gamma = \frac{\lambda_{\min}^{1/2}(P) \lambda_{\min}(Q)}{\lambda_{\max}(P)}", "proved",
             premises=("decrease",), scope=OFF_ZERO,
             reading="With the eigenvalues as numbers that bound the forms: |zeta|^2 Q's least over |x_1|^(1/2).")
def finite_time_rate() -> Goal:
    """|x_1|^(1/2) is at most |zeta|, and that at most V^(1/2) over the root of P's least eigenvalue."""
    return Goal((at_least(q * length**2 / r, q * m / most * v),), sizes(),
                lemmas=(at_least(most * length, m * v), at_least(length**2 / r, length)))


paper.axiom("time", "The origin is reached in finite time", r"T = \frac{2}{\gamma} V^{1/2}(x_0)",
            "comparison lemma for V' <= -gamma V^(1/2), with V absolutely continuous along solutions in Filippov's sense",
            hypotheses=("V", "V.across", "rate", "Q"), severity="result")

"""mao2018, section VII: the damping against the uncertain resistance, (64)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal

from ..active_mode import k_1, k_2, nu_damp
from ..error_dynamics import b_0, c_0, uncertain
from ..lyapunov import constant
from ..paper import paper
from ..plant import drag, x_2, z_2

X, Z = sp.symbols("x_2_size z_2_size", nonnegative=True)
two_terms = -k_1 * Z**2 * X**2 + b_0 * Z * X - k_2 * Z**2 * X**4 + c_0 * Z * X**2  # (64)


@paper.claim("63.drag", "The uncertain resistance against the damping", "inequality",
             r"z_2(\nu_\Delta - \Delta b\,x_2 - \Delta c\,x_2^2) \le -k_1z_2^2x_2^2 + b_0|z_2||x_2| - k_2z_2^2x_2^4 + "
             r"c_0|z_2|x_2^2", "proved", origin="implied",
             reading="The step from (63), its powers of z_2 put right, to the display after it.")
def drag_bound() -> Goal:
    """|Delta_b| <= b_0 and |Delta_c| <= c_0."""
    sizes = tuple(r for x, most in ((x_2, X), (z_2, Z)) for r in (
        at_most(x, most), at_most(-x, most), equal(most**2, x**2)))  # most = |x|
    return Goal((at_most(z_2 * (nu_damp - drag), two_terms),), (*uncertain, *sizes),
                lemmas=(at_most(z_2 * x_2, Z * X), at_least(z_2 * x_2, -Z * X), equal(Z**2 * X**2, z_2**2 * x_2**2),
                        equal(Z**2 * X**4, z_2**2 * x_2**4)))


@paper.claim("64", "The maximum of (64) and where it is attained", "inequality",
             r"-k_1z_2^2(t)x_2^2(t) + b_0|z_2(t)||x_2(t)| - k_2z_2^2(t)x_2^4(t) + c_0|z_2(t)|x_2^2(t) \text{ attains a maximum "
             r"value } (\frac{b_0^2}{4k_1} + \frac{c_0^2}{4k_2}) \text{ at } |x_2(t)| = \frac{k_1c_0}{k_2b_0} \text{ and } "
             r"|z_2(t)| = \frac{k_2b_0^2}{2k_1^2c_0}", "proved",
             rests_on=(), match="words", reading="Two relations: the bound, and equality at the stated point.",
             note="For b_0, c_0 > 0; the stated point divides by both. The bound holds for b_0 = 0 or c_0 = 0 too "
                  "(64.bound).")
def largest_value() -> Goal:
    """Two completed squares, and the value at the stated point."""
    b, c = sp.symbols("b_0 c_0", positive=True)
    value, top = two_terms.xreplace({b_0: b, c_0: c}), constant.xreplace({b_0: b, c_0: c})
    at_point = value.xreplace({X: k_1 * c / (k_2 * b), Z: k_2 * b**2 / (2 * k_1**2 * c)})
    return Goal((at_most(value, top), equal(at_point, top)))


@paper.claim("64.bound", "The bound of (64), for b_0 or c_0 equal to zero too", "inequality",
             r"b_0, c_0 \ge 0:\ \dots \le \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}", "proved", origin="ours")
def largest_value_degenerate() -> Goal:
    """Two completed squares."""
    return Goal((at_most(two_terms, constant),))

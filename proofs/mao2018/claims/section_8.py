"""mao2018, section VIII: the stated data."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, at_least, equal, greater, less

from ..paper import paper
from ..plant import M, t
from .section_2 import ramp

c_before, c_after, a_stated, a_force = sp.symbols("c_before c_after a_stated a_r", real=True)


def decimal(text: str) -> Fraction:
    """A printed decimal as an exact number."""
    return Fraction(text)


@paper.claim("VIII.ramp", "The indicator of the slope is continuous at 800 s and 804 s", "identity",
             r"0.25(t - 800)|_{800} = 0,\ 0.25(t - 800)|_{804} = 1", "proved", premises=("6",),
             note="Up to 800 s the slope's indicator is zero, and after 804 s it must be 1, which the paper leaves "
                  "unsaid. At 1400 s it falls to zero in a step.")
def ramp_continuous() -> Goal:
    """The ramp's values at its ends."""
    return Goal((equal(ramp.xreplace({t: sp.Integer(800)}), 0),
                 equal(ramp.xreplace({t: sp.Integer(804)}), 1)))


@paper.claim("VIII.continuous", "The parameters of the simulation do not change abruptly", "condition",
             r"c(400^-) = c(400^+)", "violated",
             at={c_before: decimal("1.12e-6"), c_after: decimal("9.12e-6")},
             note="The introduction motivates the indicators by parameters that do not change abruptly. In section "
                  "VIII all but the slope's are 0-1 functions, and c jumps by a factor of eight at the tunnel. No "
                  "proof needs continuity.")
def resistance_continuous() -> Goal:
    """c before and after the tunnel's portal."""
    return Goal((equal(c_before, c_after),))


@paper.claim("VIII.units", "a_1 fits both its unit kN and its definition a = a_r/M", "condition",
             r"a_1 = \frac{a_r}{M},\ a_r = 8.63\cdot10^{-3}\ \mathrm{kN},\ M = 400\ \mathrm{t}", "violated",
             at={a_stated: decimal("8.63e-3"), a_force: decimal("8.63e-3"), M: Fraction(400)},
             repair={a_stated: decimal("8.63e-3"), a_force: decimal("3.452"), M: Fraction(400)},
             note="(9), (10) take a_i per unit of mass (kN/t = m/s^2); section VIII gives the a_i, b_i, c_i that it "
                  "refers to (9), (10) in kN, a rolling resistance of 8.6 N for the whole train. Read as kN/t the "
                  "value is an ordinary one of 3.45 kN.")
def resistance_units() -> Goal:
    """The same number as a force and as a force per mass."""
    return Goal((equal(a_stated, a_force / M),))


@paper.claim("66.transient", "The disturbance of the tunnel is a step", "inequality",
             r"200 - \tfrac1{20} < 200(1 - e^{-10t}) < 200\ \text{for}\ t \ge 400", "proved",
             note="(66) counts t from the start, so that the exponential is over when the tunnel begins; t - 400 may "
                  "have been meant. Within the known bound of 200 either way.")
def transient_is_over() -> Goal:
    """exp(-10 t) is tiny at 400 s."""
    value = 200 * (1 - sp.exp(-10 * t))
    return Goal((greater(value, 200 - sp.Rational(1, 20)), less(value, 200)), (at_least(t, 400),))


b_stated, c_stated, Delta_b_most, Delta_c_most = sp.symbols("b_1 c_1 Delta_b_max Delta_c_max", real=True)


@paper.claim("VIII.case5", "The uncertain parameters of case 5 leave a resistance", "condition",
             r"b_1 \ge \max|\Delta b|,\ c_1 \ge \max|\Delta c|", "violated",
             at={b_stated: decimal("7.295e-6"), c_stated: decimal("1.12e-6"), Delta_b_most: decimal("0.001"),
                 Delta_c_most: decimal("0.001")},
             note="The paper prints no such condition; it is what makes b + Delta_b and c + Delta_c resistances at all "
                  "times. Delta_c is about 900 times c, so that for nearly half of each period the air drives the "
                  "train; at 60 m/s it makes 3.6 in the unit of c v^2, against 0.004 of c v^2 itself.")
def uncertainty_below_resistance() -> Goal:
    """b_1 and c_1 against the amplitudes of Delta_b and Delta_c."""
    return Goal((at_least(b_stated, Delta_b_most), at_least(c_stated, Delta_c_most)))

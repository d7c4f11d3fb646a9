"""mao2018, section VIII: the stated data."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal, greater, less
from workbench.proof.printed_values import exact_decimal

from ..paper import paper
from ..plant import M, t
from ..stated_values import modes, stated
from .section_2 import ramp

c_before, c_after, a_stated, a_force = sp.symbols("c_before c_after a_stated a_r", real=True)


a_1, mass = exact_decimal(modes[0]["a_kn"]), exact_decimal(stated["train"]["mass_t"])
v_end = sp.Symbol("v_end", real=True)


@paper.claim("VIII.stop", "The train does not stop", "condition",
             r"\text{the train does not stop}\ldots\text{to slow down until fully stop. For } 1400 \le t < 2000",
             "violated", origin="ours", severity="cosmetic", match="words", at={v_end: exact_decimal(stated["reference"]["speeds_mps"][-1])},
             reading="The speed at the end is held against the sentence before the modes, that the train does not stop.",
             note="The two sentences of section VIII contradict each other. The first is given as the reason for a constant "
                  "mass, which a stop at the very end would not spoil.")
def never_stops() -> Goal:
    """A positive speed at the end of mode (iv)."""
    return Goal((greater(v_end, 0),))


@paper.claim("VIII.ramp", "The indicator of the slope is continuous at 800 s and 804 s", "identity",
             r"0.25(t - 800)|_{800} = 0,\ 0.25(t - 800)|_{804} = 1", "proved", origin="ours",
             note="Up to 800 s the slope's indicator is zero, and after 804 s it must be 1, which the paper leaves "
                  "unsaid. At 1400 s it falls to zero in a step.")
def ramp_continuous() -> Goal:
    """The ramp's values at its ends."""
    return Goal((equal(ramp.xreplace({t: sp.Integer(800)}), 0),
                 equal(ramp.xreplace({t: sp.Integer(804)}), 1)))


@paper.claim("VIII.continuous", "The parameters of the simulation do not change abruptly", "condition",
             r"\text{the change of the parameters of the train dynamic motion model are not abrupt [section I]; } c_1 = 1.12 "
             r"\times 10^{-6},\ c_2 = 9.12 \times 10^{-6} \text{ [section VIII]}", "violated", origin="ours", severity="cosmetic", match="words",
             reading="c on both sides of the tunnel's portal must agree.",
             at={c_before: exact_decimal(modes[0]["c_kn_s2_per_m2"]), c_after: exact_decimal(modes[1]["c_kn_s2_per_m2"])},
             note="The introduction motivates the indicators by parameters that do not change abruptly. In section "
                  "VIII all but the slope's are 0-1 functions, and c jumps by a factor of eight at the tunnel; Remark 3 "
                  "says that 0-1 functions represent most situations. No proof needs continuity.")
def resistance_continuous() -> Goal:
    """c before and after the tunnel's portal."""
    return Goal((equal(c_before, c_after),))


@paper.claim("VIII.units", "a_1 fits both its unit kN and its definition a = a_r/M", "condition",
             r"\text{the parameters } a_i \text{ (kN)}\ldots\text{ are defined in equations (9)-(10)}\ldots a_1 = 8.63 "
             r"\times 10^{-3}", "violated", match="words",
             reading="a_1 as a force of 8.63e-3 kN, divided by the 400 t of the train, must be the a_1 of (9).",
             at={a_stated: a_1, a_force: a_1, M: mass},
             repair={a_stated: a_1, a_force: a_1 * mass, M: mass},
             note="(9), (10) take a_i per unit of mass (kN/t = m/s^2); section VIII gives the a_i, b_i, c_i that it "
                  "refers to (9), (10) in kN, a rolling resistance of 8.6 N for the whole train. Read as kN/t the "
                  "value is an ordinary one of 3.45 kN. theta_i is given in degrees likewise, where (9) has its sine.")
def resistance_units() -> Goal:
    """The same number as a force and as a force per mass."""
    return Goal((equal(a_stated, a_force / M),))


@paper.claim("66.transient", "The disturbance of the tunnel is a step", "inequality",
             r"200 - \tfrac1{20} < 200(1 - e^{-10t}) < 200\ \text{for}\ t \ge 400", "proved", origin="ours",
             note="(66) counts t from the start, so that the exponential is over when the tunnel begins; t - 400 may "
                  "have been meant. Within the known bound of 200 either way.")
def transient_is_over() -> Goal:
    """exp(-10 t) is tiny at 400 s."""
    value = 200 * (1 - sp.exp(-10 * t))
    return Goal((greater(value, 200 - sp.Rational(1, 20)), less(value, 200)), (at_least(t, 400),))


sine = sp.Symbol("sine", real=True)


@paper.claim("VIII.case3", "The bound of the unparameterizable failure", "inequality",
             r"\bar{\delta}_j(t) = 3 \times 10^4\sin(0.07t)\ldots\text{the bound of the unparameterizable part of the "
             r"failure, i.e., } 3 \times 10^4", "proved", severity="data", match="words",
             reading="A sine is one number between -1 and 1.")
def failure_bound() -> Goal:
    """The amplitude times a sine."""
    return Goal((at_most(sp.Abs(30000 * sine), 30000),), (at_most(sine, 1), at_least(sine, -1)))


b_stated, c_stated, Delta_b_most, Delta_c_most = sp.symbols("b_1 c_1 Delta_b_max Delta_c_max", real=True)


@paper.claim("VIII.case5", "The uncertain parameters of case 5 exceed the resistance itself", "condition",
             r"\max|\Delta b| > 100\,b_1,\ \max|\Delta c| > 800\,c_1", "proved", origin="ours",
             at={b_stated: exact_decimal(modes[0]["b_kn_s_per_m"]), c_stated: exact_decimal(modes[0]["c_kn_s2_per_m2"]),
                 Delta_b_most: exact_decimal(stated["drag"][0]["amplitude"]),
                 Delta_c_most: exact_decimal(stated["drag"][1]["amplitude"])},
             note="The paper sets no limit to them, but b + Delta_b and c + Delta_c are no resistances any more: "
                  "Delta_c is about 900 times c, so that for nearly half of each period the air drives the "
                  "train; at 60 m/s it makes 3.6 in the unit of c v^2, against 0.004 of c v^2 itself.")
def uncertainty_above_resistance() -> Goal:
    """The amplitudes of Delta_b and Delta_c against b_1 and c_1."""
    return Goal((greater(Delta_b_most, 100 * b_stated), greater(Delta_c_most, 800 * c_stated)))


paper.axiom("figure2", "Figures 1 and 2: the loop is stable and the tracking asymptotic in all five cases",
            r"\text{The simulation results show that the proposed adaptive controller can achieve the close-loop stability and "
            r"asymptotic tracking properties of the train even in the presence of parameters changes and actuator failures.}",
            "read off the figures by the authors", hypotheses=(), match="words", severity="data",
            note="A statement on simulations, which the study runs anew. For case 5 nothing asymptotic is claimed by Theorem 5.")

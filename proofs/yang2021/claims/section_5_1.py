"""yang2021, section 5.1: the objectives' errors and the design of the laws by V_1 and V_2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.proof.claim import D, Goal, equal
from workbench.proof.derive import lie_derivative
from workbench.trains.train import a_star, b_star, c_star, f, u

from .. import laws as law
from ..error_dynamics import e_1, e_2, e_2_rate, flow, in_errors, open_rates, x_2_errors
from ..laws import alpha, k, x_1, x_2
from ..lyapunov import V_1, V_2, V_1_rate, inside
from ..paper import paper

# Lines that are decided in positions and speeds, (22), (23) and (27) put in.
IN_SPEEDS = {"e_1": law.e_1, "e_2": law.e_2, "r": law.r, "x_1": x_1, "x_2": x_2}


paper.definition("22", "The position error", r"e_1 = x_1 - x_d")
paper.definition("23", "The speed error of the design", r"e_2 = x_2 - r",
                 note="The sentence before it calls this the derivative of the position error, see 23.derivative.")


@paper.claim("23.derivative", "The text before (22): e_2 is the derivative of the position error", "identity",
             r"\text{The position tracking error and its derivative signal are defined as follows}", "refuted",
             severity="cosmetic", match="words", reading="The derivative signal of e_1 of (22) is e_2 of (23): e_2 is the rate of e_1.",
             correction=lambda: Goal((equal(law.e_2, D(law.e_1) + alpha * law.e_1),), flow={x_1: x_2, x_d: xdot_d}),
             corrected_statement=r"e_2 = x_2 - r = \dot{e}_1 + \alpha e_1",
             note="A filtered error: by (23) and (27) e_2 is e_1' + alpha e_1. Lemma 1 calls it the speed error, which it is no more: that is "
                  "e_2 - alpha e_1. The proof uses (23) alone. The sentence before (25) means the differential of e_2 where it writes that of e_2'.")
def second_error_is_derivative() -> Goal:
    """e_2 of (23) against D(e_1)."""
    return Goal((equal(law.e_2, D(law.e_1)),), flow={x_1: x_2, x_d: xdot_d})


@paper.claim("24", "Rate of the position error", "identity", r"\dot{e}_1 = \dot{x}_1 - \dot{x}_d = x_2 - \dot{x}_d", "proved",
             where=IN_SPEEDS)
def position_error_rate() -> Goal:
    """D(e_1) of (22) along (4)."""
    return Goal((equal(D(law.e_1), D(x_1) - xdot_d), equal(D(x_1) - xdot_d, x_2 - xdot_d)),
                flow={x_1: x_2, x_d: xdot_d})


resistance = a_star + b_star * x_2 + c_star * x_2**2


@paper.claim("25", "Rate of the speed error", "identity",
             r"\dot{e}_2 = \dot{x}_2 - \dot{r} = u + g + f(\mathbf{x}) - \dot{r} = u - \frac{a_0}{m} - \frac{b_0}{m}x_2 - "
             r"\frac{c_0}{m}x_2^2 + f(\mathbf{x}) - \dot{r}", "proved", premises=("4",), rests_on=("4", "28"),
             where=IN_SPEEDS | {"g": -resistance, r"f(\mathbf{x})": f})
def speed_error_rate() -> Goal:
    """D(e_2) of (23) along (4), with r of (27)."""
    with_plant = u - resistance + f - D(law.r)
    return Goal((equal(D(law.e_2), D(x_2) - D(law.r)), equal(D(x_2) - D(law.r), with_plant),
                 equal(with_plant, u - a_star - b_star * x_2 - c_star * x_2**2 + f - D(law.r))), flow=open_rates)


virtual = sp.Symbol("r", real=True)


@paper.claim("26", "Rate of V_1", "identity",
             r"\dot{V}_1 = \frac{e_1\dot{e}_1}{k^2 - e_1^2} = \frac{e_1(x_2 - \dot{x}_d)}{k^2 - e_1^2} = "
             r"\frac{e_1(e_2 + r - \dot{x}_d)}{k^2 - e_1^2}", "proved", premises=("24",), rests_on=("20", "24"),
             where={"x_2": x_2, "r": virtual})
def barrier_rate() -> Goal:
    """D(V_1) with e_1' of (24) and e_2 of (23), for any virtual law r."""
    inverse = 1 / (k**2 - e_1**2)
    return Goal((equal(D(V_1), e_1 * D(e_1) * inverse), equal(e_1 * D(e_1) * inverse, e_1 * (x_2 - xdot_d) * inverse),
                 equal(e_1 * (x_2 - xdot_d) * inverse, e_1 * (e_2 + virtual - xdot_d) * inverse)),
                (inside, equal(e_2, x_2 - virtual)), {e_1: x_2 - xdot_d})


paper.definition("27", "The virtual law", r"r = -\alpha e_1 + \dot{x}_d")


@paper.claim("28", "Rate of the virtual law", "identity", r"\dot{r} = -\alpha\dot{e}_1 + \ddot{x}_d", "proved",
             premises=("24",), where=IN_SPEEDS)
def virtual_law_rate() -> Goal:
    """D(r) of (27)."""
    return Goal((equal(D(law.r), -alpha * D(law.e_1) + xddot_d),), flow={x_1: x_2, x_d: xdot_d, xdot_d: xddot_d})


@paper.claim("29", "Rate of V_1 under the virtual law", "identity",
             r"\dot{V}_1 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1e_2}{k^2 - e_1^2}", "proved", premises=("26",))
def barrier_rate_closed() -> Goal:
    """D(V_1) along the closed loop."""
    return Goal((equal(D(V_1), V_1_rate),), (inside,), {e_1: flow[e_1]})


paper.definition("30", "The function of the second step", r"V_2 = V_1 + \frac{1}{2}e_2^2")


@paper.claim("31", "Rate of V_2", "identity",
             r"\dot{V}_2 = \dot{V}_1 + e_2\dot{e}_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1e_2}{k^2 - e_1^2} + "
             r"e_2\dot{e}_2", "proved", premises=("29",))
def v2_rate() -> Goal:
    """D(V_2) of (30) with e_2' free."""
    return Goal((equal(D(V_2), D(V_1) + e_2 * D(e_2)), equal(D(V_1) + e_2 * D(e_2), V_1_rate + e_2 * D(e_2))),
                (inside,), {e_1: flow[e_1], e_2: e_2_rate})


rdot_errors = -alpha * (e_2 - alpha * e_1) + xddot_d


@paper.claim("32", "Rate of V_2 with the plant", "identity",
             r"\dot{V}_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1e_2}{k^2 - e_1^2} + e_2[u - \frac{a_0}{m} - "
             r"\frac{b_0}{m}x_2 - \frac{c_0}{m}x_2^2 + f(x) - \dot{r}]", "proved", premises=("25", "31"),
             where={r"\dot{r}": rdot_errors}, reading="The rate of r is (28) in the errors.")
def v2_rate_plant() -> Goal:
    """D(V_2) along (4) with u free."""
    along = {e_1: flow[e_1], e_2: in_errors(lie_derivative(law.e_2, open_rates))}
    pulled = u - a_star - b_star * x_2_errors - c_star * x_2_errors**2 + f - rdot_errors
    return Goal((equal(D(V_2), V_1_rate + e_2 * pulled),), (inside,), along)

"""yang2021, section 5.1: the design of the laws by V_1 and V_2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.proof.claim import D, Goal, equal
from workbench.proof.derive import lie_derivative

from .. import laws as law
from ..error_dynamics import e_1, e_2, flow, in_errors, open_rates, speed_error_rate_printed
from ..laws import alpha, k, x_1, x_2
from ..lyapunov import V_1, V_2, V_1_rate, inside
from ..paper import paper


@paper.claim("24", "Rate of the position error", "identity", r"\dot e_1 = x_2 - \dot x_d", "proved")
def position_error_rate() -> Goal:
    """D(e_1) of (22) along (4)."""
    return Goal((equal(D(law.e_1), x_2 - xdot_d),), flow={x_1: x_2, x_d: xdot_d})


@paper.claim("25", "Rate of the speed error", "identity",
             r"\dot e_2 = u - \tfrac{a_0}{m} - \tfrac{b_0}{m}x_2 - \tfrac{c_0}{m}x_2^2 + f(x) - \dot r", "proved",
             premises=("4", "28"))
def speed_error_rate() -> Goal:
    """D(e_2) of (23) along (4), with r of (27) and its rate (28)."""
    return Goal((equal(D(law.e_2), speed_error_rate_printed),), flow=open_rates)


@paper.claim("26", "Rate of V_1", "identity",
             r"\dot V_1 = \frac{e_1\dot e_1}{k^2 - e_1^2} = \frac{e_1(e_2 + r - \dot x_d)}{k^2 - e_1^2}", "proved",
             premises=("20", "24"))
def barrier_rate() -> Goal:
    """D(V_1) with e_1' = e_2 + r - x_d' for any virtual law r."""
    virtual = sp.Symbol("r", real=True)
    return Goal((equal(D(V_1), e_1 * D(e_1) / (k**2 - e_1**2)),
                 equal(D(V_1), e_1 * (e_2 + virtual - xdot_d) / (k**2 - e_1**2))), (inside,),
                {e_1: e_2 + virtual - xdot_d})


@paper.claim("28", "Rate of the virtual law", "identity", r"\dot r = -\alpha\dot e_1 + \ddot x_d", "proved",
             premises=("24",))
def virtual_law_rate() -> Goal:
    """D(r) of (27)."""
    return Goal((equal(D(law.r), -alpha * (x_2 - xdot_d) + xddot_d),),
                flow={x_1: x_2, x_d: xdot_d, xdot_d: xddot_d})


@paper.claim("29", "Rate of V_1 under the virtual law", "identity",
             r"\dot V_1 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2}", "proved",
             premises=("26",))
def barrier_rate_closed() -> Goal:
    """D(V_1) along the closed loop."""
    return Goal((equal(D(V_1), V_1_rate),), (inside,), {e_1: flow[e_1]})


e_2_rate = sp.Symbol("edot_2", real=True)


@paper.claim("31", "Rate of V_2", "identity",
             r"\dot V_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\dot e_2", "proved",
             premises=("29",))
def v2_rate() -> Goal:
    """D(V_2) with e_2' free."""
    return Goal((equal(D(V_2), V_1_rate + e_2 * e_2_rate),), (inside,), {e_1: flow[e_1], e_2: e_2_rate})


@paper.claim("32", "Rate of V_2 with the plant", "identity",
             r"\dot V_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\left[u - "
             r"\tfrac{a_0}{m} - \tfrac{b_0}{m}x_2 - \tfrac{c_0}{m}x_2^2 + f(x) - \dot r\right]", "proved",
             premises=("25", "31"))
def v2_rate_plant() -> Goal:
    """D(V_2) along (4) with u free."""
    along = {e_1: flow[e_1], e_2: in_errors(lie_derivative(law.e_2, open_rates))}
    return Goal((equal(D(V_2), V_1_rate + e_2 * in_errors(speed_error_rate_printed)),), (inside,), along)

"""yang2021, section 6: the laws sampled at 1 ms, by Jury's conditions."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import desired_speed as xdot_d
from workbench.proof.claim import Goal, less
from workbench.trains.train import c_star

from ..error_dynamics import e_1, e_2, epsilon, flow, lambdas, sigmas, tildes
from ..laws import beta
from ..paper import paper
from ..stated_values import cruise, stated_gains

period, v_c = sp.symbols("T_s v_c", positive=True)


def _speed_and_estimate_loop() -> sp.Matrix:
    """Jacobian of (40), (36) in (e_2, c_tilde) at zero error, desired speed v_c, constant desired curve."""
    states = (e_2, tildes[2])
    at_rest = {e_1: 0, e_2: 0, **dict.fromkeys(tildes, 0), epsilon: 0, xdot_d: v_c, c_star: 0}
    without_network = {total: sp.Integer(0) for total in flow[e_2].atoms(sp.Sum)}
    return sp.Matrix([[sp.diff(flow[row].xreplace(without_network), column).subs(at_rest) for column in states]
                      for row in states])


def _sampled_goal(corrected: bool) -> Goal:
    """Jury's conditions: a 2 x 2 update M is stable when det M < 1 and |trace M| < 1 + det M."""
    rate = _speed_and_estimate_loop()
    if corrected:  # the estimate moves first, the speed error answers to the new estimate
        estimate_first = sp.Matrix([[1, 0], [period * rate[1, 0], 1 + period * rate[1, 1]]])
        speed_then = sp.Matrix([[1 + period * rate[0, 0], period * rate[0, 1]], [0, 1]])
        update = speed_then * estimate_first
    else:
        update = sp.eye(2) + period * rate
    det, trace = sp.expand(update.det()), sp.expand(update.trace())
    return Goal((less(det, 1), less(trace, 1 + det), less(-trace, 1 + det)))


at_cruise = {beta: stated_gains[beta], lambdas[2]: stated_gains[lambdas[2]], sigmas[2]: stated_gains[sigmas[2]],
             v_c: Fraction(round(cruise * 100), 100)}
JURY = (r"\det M < 1,\ |\mathrm{tr}\,M| < 1 + \det M,\quad M = \partial(e_2, \tilde c)(t + T_s)/"
        r"\partial(e_2, \tilde c)(t)")


@paper.claim("36.sampling", "(36) and the speed error, sampled at 1 ms by explicit Euler, are stable", "condition",
             JURY, "violated", origin="ours", rests_on=(), at={**at_cruise, period: Fraction(1, 1000)},
             repair={**at_cruise, period: Fraction(1, 25000)},
             note="The paper states no sampling, so this is a condition on an implementation. Linearised at cruise speed: the estimate of c works through v^2 and is corrected through v^2, so "
                  "the pair oscillates at sqrt(lambda_3) v^2 rad/s, and an explicit step feeds the oscillation more "
                  "than beta damps it. The paper states no step. The simulation leaves the barrier with this order.")
def explicit_sampling() -> Goal:
    """Jury's conditions of the explicit update."""
    return _sampled_goal(corrected=False)


@paper.claim("36.sampling.corrected", "The same with the estimate corrected before it is used", "condition",
             JURY, "proved", origin="ours", rests_on=(), at={**at_cruise, period: Fraction(1, 1000)},
             note="The order the simulation uses. It stays stable up to about 2/(sqrt(lambda_3) v^2), that is "
                  f"{2000 / (float(stated_gains[lambdas[2]]) ** 0.5 * cruise**2):.1f} ms at cruise speed.")
def corrected_sampling() -> Goal:
    """Jury's conditions when the estimate moves first."""
    return _sampled_goal(corrected=True)

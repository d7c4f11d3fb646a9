"""Theorem 1, step 2: the auxiliary system against the saturation, (49)-(51), and Remark 5."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater
from workbench.proof.derive import lie_derivative
from workbench.trains.multi_particle import over_cars

from ..energy_function import V_of
from ..goal_forms import carried, integrated
from ..laws import Delta_u, any_gains, auxiliary, c_1, c_2, c_3, c_lambda_candidates, gains, lambda_1, lambda_2
from ..one_car import one_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..stated_values import stated_gains

INT_LAMBDA = (r"\int_{0}^{T} \left( \left\| \boldsymbol{\lambda}_{1,i} \right\|^{2} + \left\| \boldsymbol{\lambda}_{2,i} "
              r"\right\|^{2} \right) d\tau")
INT_LAMBDA_2 = r"\int_{0}^{T} \left\| \boldsymbol{\lambda}_{2,i} \right\|^{2} d\tau"
INT_U = r"\int_{0}^{T} \left\| \Delta \boldsymbol{u}_{i} \right\|^{2} d\tau"


c_z = sp.Symbol("c_z", positive=True)
minimum_z = (at_most(c_z, c_1), at_most(c_z, c_2))
lam_1, lam_2, delta_car = sp.symbols("lambda_1 lambda_2 Delta_u", real=True)
V_lambda = V_of(lambda_1) + V_of(lambda_2)
c_lambda = sp.Symbol("c_lambda", real=True)
minimum_lambda = tuple(at_most(c_lambda, x) for x in c_lambda_candidates)
C_LAMBDA = r"c_{\lambda} = \min(c_1 - \frac{1}{2}, c_2 - \frac{1}{2} - \frac{c_3}{2})"
IN_49 = {r"V_{\lambda,i}": V_lambda, r"c_\lambda": c_lambda}


@paper.claim("49.rate", "Rate of V_lambda", "identity",
             r"\dot{V}_{\lambda,i} = -c_1 \left\| \boldsymbol{\lambda}_{1,i} \right\|^2 + \boldsymbol{\lambda}_{1,i}^T "
             r"\boldsymbol{\lambda}_{2,i} - c_2 \left\| \boldsymbol{\lambda}_{2,i} \right\|^2 + c_3 "
             r"\boldsymbol{\lambda}_{2,i}^T \Delta \boldsymbol{u}_i", "proved", scope=EVERY_TRAIN, where=IN_49)
def auxiliary_rate() -> Goal:
    """D(V_lambda) along (9)."""
    stated = (-c_1 * over_cars(lambda_1**2) + over_cars(lambda_1 * lambda_2) - c_2 * over_cars(lambda_2**2)
              + c_3 * over_cars(lambda_2 * Delta_u))
    return Goal((equal(D(V_lambda), stated),), flow=auxiliary)


positive_c_lambda = tuple(greater(x, 0) for x in c_lambda_candidates)


def _young(sign: int, assume: tuple[Relation, ...] = ()) -> Goal:
    bound = (-(c_1 + sign * sp.S.Half) * over_cars(lambda_1**2) - (c_2 - sp.S.Half - c_3 / 2) * over_cars(lambda_2**2)
             + c_3 * over_cars(Delta_u**2) / 2)
    return Goal((at_most(D(V_lambda), bound),), assume, auxiliary)


def _line_49(sign: str) -> str:
    return (rf"\dot{{V}}_{{\lambda,i}} \leq -(c_1 {sign} \frac{{1}}{{2}}) \left\| \boldsymbol{{\lambda}}_{{1,i}} \right\|^2 - "
            r"(c_2 - \frac{1}{2} - \frac{c_3}{2}) \left\| \boldsymbol{\lambda}_{2,i} \right\|^2 + \frac{c_3}{2} \left\| "
            r"\Delta \boldsymbol{u}_i \right\|^2")


@paper.claim("49", "Young's inequality for V_lambda", "inequality", _line_49("+"), "refuted", premises=("49.rate",),
             scope=EVERY_TRAIN, glyph="49.glyph", where=IN_49, correction=lambda: _young(-1),
             corrected_statement=_line_49("-"),
             reading="With c_lambda > 0, as the paper prints below it.",
             note="As the extracted text has it, with c_1 + 1/2. The next line and c_lambda use c_1 - 1/2, so this is "
                  "a slip of one sign; should the page show a minus, it is none.")
def auxiliary_young() -> Goal:
    """D(V_lambda) along (9) against the printed bound, for c_lambda > 0."""
    return _young(1, positive_c_lambda)


@paper.claim("49.glyph", "Young's inequality for V_lambda, with c_1 - 1/2", "inequality", _line_49("-"), "proved",
             origin="ours", glyph="49", premises=("49.rate",), scope=EVERY_TRAIN, where=IN_49)
def auxiliary_young_minus() -> Goal:
    """D(V_lambda) along (9) against the bound with a minus."""
    return _young(-1)


@paper.claim("49.last", "The last line of (49)", "inequality",
             r"\dot{V}_{\lambda,i} \leq -c_\lambda (\left\| \boldsymbol{\lambda}_{1,i} \right\|^2 + \left\| "
             r"\boldsymbol{\lambda}_{2,i} \right\|^2) + \frac{c_3}{2} \left\| \Delta \boldsymbol{u}_i \right\|^2",
             "proved", premises=("49.rate",), rests_on=("49",), scope=EVERY_TRAIN, where=IN_49,
             note="For every c_lambda up to min(c_1 - 1/2, c_2 - 1/2 - c_3/2), of any sign. From (9) itself, so our proof "
                  "does not rest on the printed line before it.")
def auxiliary_decay() -> Goal:
    """D(V_lambda) along (9) against the bound with c_lambda."""
    bound = -c_lambda * over_cars(lambda_1**2 + lambda_2**2) + c_3 * over_cars(Delta_u**2) / 2
    return Goal((at_most(D(V_lambda), bound),), minimum_lambda, auxiliary)


@paper.claim("49.stated", "The gains of section IV meet the premise c_lambda > 0", "condition",
             C_LAMBDA + r" \text{ is a positive constant}", "violated", at=stated_gains, match="words",
             reading="Both c_1 - 1/2 and c_2 - 1/2 - c_3/2 are positive at c_1 = 0.01, c_2 = 100, c_3 = 0.04.",
             repair={**stated_gains, c_1: Fraction(1)},
             note="The paper prints the condition below (49), and section IV says that the gains are chosen 'according to the "
                  "requirements with respect to the stability of control system'. The gains are free in section III, so that "
                  "part 3 of Theorem 1 holds for c_lambda > 0; c_1 = 0.01 gives c_lambda = -0.49, and part 3, (51), (54), (55) "
                  "say nothing about the simulation. Besides c_1 > 1/2 there is another way out. For all positive gains, i >= "
                  "2, lambda(0) = 0 and a motion that exists on [0, T] one bound holds: the sum of c_1^2 times the integral of "
                  "|e_s|^2 and of the integral of |e_v|^2 is at most the sum of (2/c_2) (E_{i-1}(T) - E_i(T)), which tends to "
                  "zero, and of 2 (c_3/c_2)^2 times the integral of |Delta u|^2 (theorem1.3.any_gains).")
def auxiliary_gain_positive() -> Goal:
    """Both entries of the minimum."""
    return Goal(tuple(greater(r.right, 0) for r in minimum_lambda))


X, X_2, Y, V_end, V_start = sp.symbols("X X_2 Y V_lambda V_lambda_0", real=True)
IN_50 = {r"V_{\lambda,i}(T)": V_end, r"V_{\lambda,i}(0)": V_start, r"c_\lambda": c_lambda, INT_LAMBDA: X, INT_U: Y}


@paper.claim("50", "(49) integrated", "implication",
             rf"V_{{\lambda,i}}(T) - V_{{\lambda,i}}(0) \leq -c_{{\lambda}} {INT_LAMBDA} + \frac{{c_3}}{{2}} {INT_U}",
             "proved", premises=("49.last",), where=IN_50, scope=EVERY_TRAIN)
def auxiliary_integrated() -> Goal:
    """For any sign of c_lambda, from any state."""
    rates = {V_end: lie_derivative(V_lambda, auxiliary), X: over_cars(lambda_1**2 + lambda_2**2), Y: over_cars(Delta_u**2)}
    bound = at_most(V_end - V_start, -c_lambda * X + c_3 * Y / 2)
    return integrated(rates, bound, carried(paper.shown("49.last"), auxiliary), (c_lambda, *gains),
                      {V_end: V_start}, V_end + c_lambda * X - c_3 * Y / 2)


IN_51 = {r"c_\lambda": c_lambda, INT_LAMBDA: X, INT_U: Y}


@paper.claim("51", "The auxiliary state against the saturation", "implication",
             rf"{INT_LAMBDA} \leq \frac{{c_3}}{{2c_{{\lambda}}}} {INT_U}", "proved", premises=("50",), where=IN_51,
             scope=EVERY_TRAIN,
             reading="With c_lambda > 0, as the paper prints below (49), and V_lambda(0) = 0, which it takes for a fact.",
             note="c_lambda > 0 does not hold at the stated gains: 49.stated.")
def auxiliary_bound() -> Goal:
    """(50) with V_lambda(0) = 0 <= V_lambda(T)."""
    given = (*paper.shown("50"), equal(V_start, 0), at_least(V_end, 0), greater(c_lambda, 0))
    return Goal((at_most(X, c_3 * Y / (2 * c_lambda)),), given)


@paper.claim("51.any_gains", "A bound in place of (51) for all positive gains", "implication",
             rf"{INT_LAMBDA} \leq \left(\tfrac{{c_3}}{{c_2}}\right)^2\left(1 + \tfrac{{1}}{{c_1^2}}\right){INT_U}",
             "proved", origin="ours", scope=EACH_CAR, where=IN_51,
             note="It needs no c_lambda > 0; at the stated gains the factor is 0.0016.")
def auxiliary_bound_any_gains() -> Goal:
    """From (9): int lambda_2^2 <= (c_3/c_2)^2 int Delta_u^2 and int lambda_1^2 <= int lambda_2^2 / c_1^2."""
    rates = {one_car(x): one_car(rate) for x, rate in auxiliary.items()}
    storage = lam_1**2 / c_1 + (1 + 1 / c_1**2) * lam_2**2 / c_2
    return integrated({**rates, X: lam_1**2 + lam_2**2, Y: delta_car**2}, at_most(X, any_gains * Y), (), gains,
                      decreasing=X + storage - any_gains * Y)


@paper.claim("51.lambda_2", "lambda_2 against the saturation", "implication",
             rf"{INT_LAMBDA_2} \leq \left(\tfrac{{c_3}}{{c_2}}\right)^2 {INT_U}", "proved", origin="ours", scope=EVERY_TRAIN,
             where={INT_LAMBDA_2: X_2, INT_U: Y}, note="For all positive gains; at the stated ones the factor is 1.6e-7.")
def auxiliary_speed_bound() -> Goal:
    """From (9): c_2 lambda_2^2 added up falls by the square of c_2 lambda_2 - c_3 Delta u."""
    rates = {lambda_2: auxiliary[lambda_2], X_2: over_cars(lambda_2**2), Y: over_cars(Delta_u**2)}
    storage = over_cars(lambda_2**2) / c_2
    return integrated(rates, at_most(X_2, (c_3 / c_2) ** 2 * Y), (), (c_2, c_3),
                      decreasing=X_2 + storage - (c_3 / c_2) ** 2 * Y)


@paper.claim("remark5", "Remark 5: the auxiliary state decays when the saturation ends", "implication",
             r"\text{it should be emphasized that $\lambda_{1,i}$ and $\lambda_{2,i}$ gradually decay to zero after the end "
             r"of input constraints, i.e., the auxiliary system will be non-activation.}", "proved", match="words",
             scope=EACH_CAR,
             reading="With Delta u = 0 the function W = lambda_1^2 + lambda_2^2/(c_1 c_2) falls at least as fast as "
                     "exp(-min(c_1, c_2) t).",
             note="It holds for all positive gains, exponentially, at the stated gains with a time constant of 1/c_1 = "
                  "100 s for lambda_1.")
def auxiliary_forgets() -> Goal:
    """A decreasing function of the state of (9) without input; c_z <= c_1, c_2."""
    W = lam_1**2 + lam_2**2 / (c_1 * c_2)
    rates = {one_car(x): one_car(rate).xreplace({delta_car: sp.S.Zero}) for x, rate in auxiliary.items()}
    return Goal((at_most(D(W), -c_z * W),), minimum_z, rates)

"""Theorem 1, step 2: the auxiliary system against the saturation, (49)-(51), and Remark 5."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater
from workbench.trains.multi_particle import over_cars

from ..energy_function import V_of
from ..goal_forms import integrated
from ..laws import Delta_u, any_gains, auxiliary, c_1, c_2, c_3, c_lambda_candidates, gains, lambda_1, lambda_2
from ..one_car import one_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..stated_values import stated_gains

INT_LAMBDA = r"\int_0^T(\|\lambda_{1,i}\|^2 + \|\lambda_{2,i}\|^2)d\tau"
INT_U = r"\int_0^T\|\Delta u_i\|^2d\tau"


c_z = sp.Symbol("c_z", positive=True)
minimum_z = (at_most(c_z, c_1), at_most(c_z, c_2))
lam_1, lam_2, delta_car = sp.symbols("lambda_1 lambda_2 Delta_u", real=True)
V_lambda = V_of(lambda_1) + V_of(lambda_2)
c_lambda = sp.Symbol("c_lambda", real=True)
minimum_lambda = tuple(at_most(c_lambda, x) for x in c_lambda_candidates)


@paper.claim("49.rate", "Rate of V_lambda", "identity",
             r"\dot V_{\lambda,i} = -c_1\|\lambda_{1,i}\|^2 + \lambda_{1,i}^T\lambda_{2,i} - c_2\|\lambda_{2,i}\|^2 + "
             r"c_3\lambda_{2,i}^T\Delta u_i", "proved", scope=EVERY_TRAIN)
def auxiliary_rate() -> Goal:
    """D(V_lambda) along (9)."""
    stated = (-c_1 * over_cars(lambda_1**2) + over_cars(lambda_1 * lambda_2) - c_2 * over_cars(lambda_2**2)
              + c_3 * over_cars(lambda_2 * Delta_u))
    return Goal((equal(D(V_lambda), stated),), flow=auxiliary)


def _young(sign: int) -> Goal:
    bound = (-(c_1 + sign * sp.S.Half) * over_cars(lambda_1**2) - (c_2 - sp.S.Half - c_3 / 2) * over_cars(lambda_2**2)
             + c_3 * over_cars(Delta_u**2) / 2)
    return Goal((at_most(D(V_lambda), bound),), flow=auxiliary)


@paper.claim("49", "Young's inequality for V_lambda", "inequality",
             r"\dot V_{\lambda,i} \le -(c_1 + \tfrac12)\|\lambda_{1,i}\|^2 - (c_2 - \tfrac12 - "
             r"\tfrac{c_3}2)\|\lambda_{2,i}\|^2 + \tfrac{c_3}2\|\Delta u_i\|^2", "refuted", premises=("49.rate",),
             scope=EVERY_TRAIN, correction=lambda: _young(-1),
             corrected_statement=r"\dot V_{\lambda,i} \le -(c_1 - \tfrac12)\|\lambda_{1,i}\|^2 - (c_2 - \tfrac12 - "
                                 r"\tfrac{c_3}2)\|\lambda_{2,i}\|^2 + \tfrac{c_3}2\|\Delta u_i\|^2",
             note="As the extracted text has it, with c_1 + 1/2. The next line and c_lambda use c_1 - 1/2, so this is "
                  "a slip of one sign; should the page show a minus, it is none.")
def auxiliary_young() -> Goal:
    """D(V_lambda) along (9) against the printed bound."""
    return _young(1)


@paper.claim("49.last", "The last line of (49)", "inequality",
             r"\dot V_{\lambda,i} \le -c_\lambda(\|\lambda_{1,i}\|^2 + \|\lambda_{2,i}\|^2) + "
             r"\tfrac{c_3}2\|\Delta u_i\|^2,\ c_\lambda = \min(c_1 - \tfrac12, c_2 - \tfrac12 - \tfrac{c_3}2)",
             "proved", premises=("49.rate",), scope=EVERY_TRAIN,
             note="From (9) itself, so it does not rest on the printed 49.")
def auxiliary_decay() -> Goal:
    """D(V_lambda) along (9) against the bound with c_lambda."""
    bound = -c_lambda * over_cars(lambda_1**2 + lambda_2**2) + c_3 * over_cars(Delta_u**2) / 2
    return Goal((at_most(D(V_lambda), bound),), minimum_lambda, auxiliary)


@paper.claim("49.stated", "c_lambda is a positive constant at the stated gains", "condition",
             r"c_\lambda = \min(c_1 - \tfrac12, c_2 - \tfrac12 - \tfrac{c_3}2) > 0", "violated", at=stated_gains,
             repair={**stated_gains, c_1: Fraction(1)},
             note="The paper's own condition below (49). c_1 = 0.01 gives c_lambda = -0.49, so (51), (54), (55) and "
                  "part 3 of Theorem 1 say nothing about the simulation. Besides c_1 > 1/2 there is another way out: "
                  "51.any_gains holds for all positive gains.")
def auxiliary_gain_positive() -> Goal:
    """Both entries of the minimum."""
    return Goal(tuple(greater(r.right, 0) for r in minimum_lambda))


X, Y, V_aux, V_aux_0, rate_aux, x_rate, y_rate = sp.symbols("X Y V_lambda V_lambda_0 w_lambda x y", real=True)


@paper.claim("50", "(49) integrated", "implication",
             rf"V_{{\lambda,i}}(T) - V_{{\lambda,i}}(0) \le -c_\lambda{INT_LAMBDA} + \tfrac{{c_3}}2{INT_U}",
             "proved", premises=("49.last",))
def auxiliary_integrated() -> Goal:
    """For any sign of c_lambda."""
    always = (at_most(rate_aux, -c_lambda * x_rate + c_3 * y_rate / 2),)
    return integrated({V_aux: rate_aux, X: x_rate, Y: y_rate}, at_most(V_aux - V_aux_0, -c_lambda * X + c_3 * Y / 2),
                      always, (c_lambda, c_3), {V_aux: V_aux_0}, V_aux + c_lambda * X - c_3 * Y / 2)


c_lambda_positive = sp.Symbol("c_lambda", positive=True)


@paper.claim("51", "The auxiliary state against the saturation", "implication",
             rf"c_\lambda > 0 \Rightarrow {INT_LAMBDA} \le \tfrac{{c_3}}{{2c_\lambda}}{INT_U}", "proved",
             premises=("50",),
             note="With V_lambda(0) = 0, which the paper takes for a fact, and c_lambda > 0; see 49.stated.")
def auxiliary_bound() -> Goal:
    """(50) with V_lambda(0) = 0 <= V_lambda(T)."""
    integrated_50 = at_most(V_aux, -c_lambda_positive * X + c_3 * Y / 2)
    return Goal((at_most(X, c_3 * Y / (2 * c_lambda_positive)),), (integrated_50, at_least(V_aux, 0)))


@paper.claim("51.any_gains", "A bound in place of (51) for all positive gains", "implication",
             rf"{INT_LAMBDA} \le \left(\tfrac{{c_3}}{{c_2}}\right)^2\left(1 + \tfrac{{1}}{{c_1^2}}\right){INT_U}",
             "proved", scope=EACH_CAR,
             note="Not in the paper. It needs no c_lambda > 0; at the stated gains the factor is 0.0016.")
def auxiliary_bound_any_gains() -> Goal:
    """From (9): int lambda_2^2 <= (c_3/c_2)^2 int Delta_u^2 and int lambda_1^2 <= int lambda_2^2 / c_1^2."""
    rates = {one_car(x): one_car(rate) for x, rate in auxiliary.items()}
    storage = lam_1**2 / c_1 + (1 + 1 / c_1**2) * lam_2**2 / c_2
    return integrated({**rates, X: lam_1**2 + lam_2**2, Y: delta_car**2}, at_most(X, any_gains * Y), (), gains,
                      decreasing=X + storage - any_gains * Y)


@paper.claim("remark5", "Remark 5: the auxiliary state decays when the saturation ends", "implication",
             r"\Delta u_i = 0 \Rightarrow \dot W \le -\min(c_1, c_2)W,\ W = \lambda_1^2 + \tfrac{1}{c_1c_2}\lambda_2^2",
             "proved", scope=EACH_CAR,
             note="The remark is printed in words. It holds for all positive gains, exponentially, at the stated gains "
                  "with a time constant of 1/c_1 = 100 s for lambda_1.")
def auxiliary_forgets() -> Goal:
    """A decreasing function of the state of (9) without input; c_z <= c_1, c_2."""
    W = lam_1**2 + lam_2**2 / (c_1 * c_2)
    rates = {one_car(x): one_car(rate).xreplace({delta_car: sp.S.Zero}) for x, rate in auxiliary.items()}
    return Goal((at_most(D(W), -c_z * W),), minimum_z, rates)

"""yang2021: the objectives of section 5, what Theorem 1 makes of them, and of the first one where the coefficients vary."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal
from workbench.trains.train import u

from ..error_dynamics import (
    EVERY_NETWORK,
    e_1,
    e_2,
    eps_star,
    lambdas,
    sigmas,
    star_rates,
    stars,
    tildes,
    varying_flow,
    x_2_errors,
)
from ..laws import alpha, k
from ..lyapunov import V, V_rate, V_t, V_t_rate, W_star_square, barrier, inside, l_, l_stated, mu, slowest
from ..paper import paper
from .section_5_1_laws import a_dagger, b_dagger, c_dagger
from .section_5_2_decay import delta

position_most, speed_most, acceleration_most = sp.symbols("X_d V_d A_d", nonnegative=True)
u_most = sp.Symbol("u_star", nonnegative=True)


def _bounded_input() -> tuple[Relation, ...]:
    """33.bounded, with letters for the input and its bound."""
    above, below = paper.shown("33.bounded")
    named = {above.left: u, above.right: u_most, below.right: -u_most}
    return above.subs(named), below.subs(named)


@paper.claim("objective.input", "The input is bounded, whatever Assumption 4 says", "implication",
             r"V \le B,\ |\dot{x}_d| \le V_d,\ |\ddot{x}_d| \le A_d \Rightarrow x_2^2 \le 3(2B + \alpha^2k^2 + V_d^2),\ "
             r"\dot{r}^2 \le 3(2\alpha^2B + \alpha^4k^2 + A_d^2),\ |u| \le u^*", "proved", origin="ours",
             premises=("33.bounded", "theorem1.bounded"),
             reading="B is V(0) + l/mu. The bounds that 33.bounded takes: of the speed and of the rate of r as they are here, of e_2, the estimates and the weights by theorem1.bounded, of a Gaussian by 1.",
             note="V <= B keeps k^2 - e_1^2 >= k^2 exp(-2B), and with it the last term of (33) below exp(2B)/k. The desired curve is bounded by Assumption 3.")
def input_bounded_by_v() -> Goal:
    """The speed and the rate of r in the errors, and (33) by what is shown of it."""
    of_e_2, *_ = paper.shown("theorem1.bounded")
    return Goal((at_most((e_2 - alpha * e_1 + xdot_d) ** 2, 3 * (of_e_2.right + alpha**2 * k**2 + speed_most**2)),
                 at_most((xddot_d - alpha * (e_2 - alpha * e_1)) ** 2, 3 * (alpha**2 * of_e_2.right + alpha**4 * k**2 + acceleration_most**2)),
                 at_most(sp.Abs(u), u_most)),
                (inside, of_e_2, at_most(xdot_d**2, speed_most**2), at_most(xddot_d**2, acceleration_most**2), *_bounded_input()),
                lemmas=(at_most(e_1**2, k**2),))


@paper.claim("objective.stable", "The second objective of section 5: all signals of the closed loop are bounded, for constant coefficients and mu > 0", "implication",
             r"\text{The FAO is stable; that is, all closed-loop signals are bounded.}", "proved", severity="result", match="words",
             premises=("theorem1.bounded", "theorem1.barrier", "objective.input", "33.bounded"), rests_on=("theorem1.bounded", "theorem1.barrier", "A3", "A4"),
             scope=EVERY_NETWORK,
             reading="Position and speed by the bounds of the errors and of the desired curve (A3), the input by objective.input, which does not suppose Assumption 4; the errors and estimates are "
                     "theorem1.bounded. For constant coefficients and gains with mu > 0.",
             note="The position is bounded on a line of finite length; Assumption 3 says the same of the desired one. If u* of Assumption 4 is meant as the limit of an actuator, "
                  "(33) does not keep it: A4.limit.")
def all_signals_bounded() -> Goal:
    """x_1 = e_1 + x_d with |e_1| < k; x_2 = e_2 - alpha e_1 + x_d' and u by objective.input."""
    speed, *_ = paper.shown("objective.input")
    return Goal((at_most((e_1 + x_d) ** 2, 2 * k**2 + 2 * position_most**2), at_most(x_2_errors**2, speed.right), at_most(u**2, u_most**2)),
                (inside, at_most(x_d**2, position_most**2), at_most(xdot_d**2, speed_most**2), speed, *_bounded_input()))


OBJECTIVE = (r"\text{When the coefficients of the basic resistance Davis equation are uncertain or time-varying, the additional resistance "
             "cannot be accurately modeled, and the disturbance is unknown, the train can track the desired speed and position "
             "curve with high precision, ensuring that the tracking error during train operation converges to a sufficiently "
             "small area quantified by the control parameter.}")


@paper.claim("objective.varying", "The first objective of section 5, for coefficients that vary in time", "implication", OBJECTIVE,
             "gap", severity="result", match="words", rests_on=("51",), scope=EVERY_NETWORK,
             reading="Where a* varies, V' <= -mu V + l of (51) holds all the same, with mu and l of (49) and (50); taken where "
                     "e_1 = e_2 = 0 and b* and c* are known and constant.",
             note="Theorem 1 and its proof are of unknown constants, for which the objective is met; varying ones, which this objective, the introduction and the conclusions name too, they do not cover: "
                  "(41) is without the rates of the coefficients, which Assumption 5 does not bound and objective.rate has.")
def varying_decay() -> Goal:
    """(41) less the term that it lacks where a* moves, against (51)."""
    at_rest = {e_1: sp.Integer(0), e_2: sp.Integer(0), tildes[1]: sp.Integer(0), tildes[2]: sp.Integer(0)}
    rate = V_rate.xreplace(at_rest) - tildes[0] * star_rates[0] / lambdas[0]
    bound = (-mu * V + l_stated).xreplace(at_rest).replace(sp.log, lambda of: sp.log(sp.cancel(of)))  # log 1 where e_1 = 0
    return Goal((at_most(rate, bound),), (*(at_least(star, 0) for star in stars), *slowest))


@paper.claim("objective.rate", "The rate of V where the coefficients vary", "identity",
             r"\dot V = (41) - \tfrac{1}{\lambda_1}\tilde a\dot a^* - \tfrac{1}{\lambda_2}\tilde b\dot b^* - "
             r"\tfrac{1}{\lambda_3}\tilde c\dot c^*", "proved", origin="ours", scope=EVERY_NETWORK, rests_on=())
def varying_rate_of_v() -> Goal:
    """D(V) along the closed loop in which a*, b* and c* move."""
    lacking = sum((tilde * rate / lam for tilde, rate, lam in zip(tildes, star_rates, lambdas, strict=True)), sp.Integer(0))
    return Goal((equal(D(V), V_rate - lacking),), (inside,), varying_flow)


error, rate = sp.symbols("x r", real=True)
gain, leakage = sp.symbols("gain sigma", positive=True)
most = sp.Symbol("d", nonnegative=True)


@paper.claim("objective.young", "Young's inequality for the rate of a coefficient", "inequality",
             r"|r| \le d \Rightarrow -\tfrac{1}{\lambda}xr \le \tfrac14\sigma x^2 + \tfrac{d^2}{\sigma\lambda^2}", "proved",
             origin="ours", rests_on=())
def young_rate() -> Goal:
    """For one coefficient, its error x and its rate r."""
    return Goal((at_most(-error * rate / gain, leakage * error**2 / 4 + most**2 / (leakage * gain**2)),),
                (at_most(rate**2, most**2),))


rate_of_41 = sp.Symbol("V_41", real=True)
daggers = (a_dagger, b_dagger, c_dagger)
lacking, extra = sp.symbols("p_1:4", real=True), sp.symbols("q_1:4", nonnegative=True)
l_varying = eps_star**2 / 2 + W_star_square / 2 + sum(
    (sigma * dagger**2 / 2 + q for sigma, dagger, q in zip(sigmas, daggers, extra, strict=True)), sp.Integer(0))
CONDITIONS = (r"|a^*| \le a^\dagger, |b^*| \le b^\dagger, |c^*| \le c^\dagger,\ |\dot a^*| \le d_1, |\dot b^*| \le d_2, |\dot c^*| \le d_3,\ "
              r"\text{with, in place of (49) and (50), } \mu = \min[2\alpha, 2\beta - 1, \chi, \tfrac12\lambda_1\sigma_1, \tfrac12\lambda_2\sigma_2, \tfrac12\lambda_3\sigma_3] > 0,\ "
              r"l = \tfrac12\varepsilon^{*2} + \tfrac12W^{*2} + \tfrac12\sigma_1a^{\dagger2} + \tfrac12\sigma_2b^{\dagger2} + \tfrac12\sigma_3c^{\dagger2} + "
              r"\tfrac{d_1^2}{\sigma_1\lambda_1^2} + \tfrac{d_2^2}{\sigma_2\lambda_2^2} + \tfrac{d_3^2}{\sigma_3\lambda_3^2}")
NAMED = "mu and l are those of this line, not of (49) and (50)"


@paper.claim("objective.decay", "V decays where the coefficients vary at bounded rates", "implication", rf"{CONDITIONS} \Rightarrow \dot V \le -\mu V + l",
             "proved", origin="ours", premises=("objective.rate", "objective.young", "48"), rests_on=(), scope=EVERY_NETWORK,
             reading=f"{NAMED}; p_i and q_i are the left side and the last term of objective.young for each coefficient, and V_41 is the right side of (41), which (48) bounds and from "
                     "which the rate of V differs by objective.rate.")
def decay_with_bounded_rates() -> Goal:
    """The rate of V against a decay at half the rate of the estimates."""
    young = tuple(r.subs({-error * rate / gain: p, most**2 / (leakage * gain**2): q}).subs({error: tilde, leakage: sigma})
                  for p, q, tilde, sigma in zip(lacking, extra, tildes, sigmas, strict=True)
                  for r in paper.shown("objective.young"))
    slower = tuple(at_most(2 * mu, lam * sigma) for lam, sigma in zip(lambdas, sigmas, strict=True))
    obeyed = tuple(r.subs({V_rate: rate_of_41}) for r in paper.shown("48"))
    known = tuple(at_most(star**2, dagger**2) for star, dagger in zip(stars, daggers, strict=True))
    return Goal((at_most(V_t_rate, -mu * V + l_varying),),
                (inside, *slowest[:3], *slower, equal(V_t_rate, rate_of_41 + sum(lacking)), *obeyed, *young, *known))


@paper.claim("objective.mended", "Coefficients that vary within bounds and at bounded rates", "implication",
             rf"{CONDITIONS} \Rightarrow \limsup|e_2| \le \sqrt{{\tfrac{{2l}}{{\mu}}}},\ "
             r"\limsup|e_1| \le \min\left(k\sqrt{1 - e^{-2l/\mu}}, \tfrac{1}{\alpha}\sqrt{\tfrac{2l}{\mu}}\right),\ "
             r"\limsup|x_2 - \dot{x}_d| \le 2\sqrt{\tfrac{2l}{\mu}}", "proved", origin="ours",
             mends="objective.varying", premises=("objective.decay", "52.T.mended", "theorem1.speed"), rests_on=(), scope=EVERY_NETWORK,
             reading=f"{NAMED}. From a time on, and for every delta > 0, as Theorem 1 is read.",
             note="mu and l are those of this statement: (52) and what follows it take any that V decays by. The train tracks position and speed into a neighbourhood that the gains "
                  "set, to which the rates of the coefficients add. How small it can be made depends on these rates "
                  "by d_i^2/(sigma_i lambda_i^2), which large lambda_i reduce.")
def tracked_where_coefficients_vary() -> Goal:
    """What (52), which holds of every V that decays as objective.decay says, and theorem1.speed make of it."""
    near, late = l_ / mu + delta, paper.shown("52.T.mended")
    position, speed = paper.shown("theorem1.speed")
    return Goal((at_most(e_2**2, 2 * near), at_most(e_1**2, k**2 * (1 - sp.exp(-2 * near))),
                 at_most(e_1**2, (2 * near + delta) / alpha**2), at_most(speed.left, 8 * near + 4 * delta)),
                (inside, equal(V_t, V), *late, position, speed), facts=(2 * near - sp.log(barrier),))

"""yang2021, section 6: what the bounds say at the stated gains, and the printed figures."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.proof.claim import Goal, at_least, at_most, greater

from .. import laws as law
from ..error_dynamics import eps_star, lambdas, sigmas
from ..laws import alpha, beta, chi, k, x_1, x_2
from ..lyapunov import W_star_square, l_stated, mu, slowest
from ..paper import paper
from ..stated_values import least_error, scenario, stated_davis, stated_gains
from .section_5_2_decay import minimum_is_positive

W_square = sp.Symbol("W_star_square", nonnegative=True)
smallest_rate = min(2 * stated_gains[alpha], 2 * stated_gains[beta] - 1, stated_gains[chi],
                    *(stated_gains[lam] * stated_gains[s] for lam, s in zip(lambdas, sigmas, strict=True)))
best_case = {**{s: v for s, v in stated_gains.items() if s != k}, **stated_davis, mu: smallest_rate,
             eps_star: least_error, W_square: Fraction(0)}
l_numbers = l_stated.xreplace({W_star_square: W_square})
level_at_best = float((l_numbers / mu).subs(best_case))
ultimate_speed_bound = float(sp.sqrt((2 * l_numbers / mu).subs(best_case)))


@paper.claim("49.stated", "mu is positive at the stated gains", "condition",
             r"\mu = \min[2\alpha, 2\beta - 1, \chi, \lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] > 0", "proved",
             origin="implied", rests_on=("51.choice",),
             at={s: v for s, v in stated_gains.items() if s != k},
             note=f"mu = {smallest_rate}: a time constant of {1 / smallest_rate} s, against a run of "
                  f"{scenario.desired_curve().trip_time_s:.0f} s.")
def positive_rate() -> Goal:
    """Every entry of the minimum; the last one decides."""
    return minimum_is_positive()


repaired_gains = {alpha: Fraction(1, 2), beta: Fraction(1), chi: Fraction(1), mu: Fraction(1),
                  **dict.fromkeys(lambdas, Fraction(20)), **dict.fromkeys(sigmas, Fraction(1, 20)),
                  **stated_davis, eps_star: least_error, W_square: Fraction(1, 20)}


@paper.claim("53.stated", "At the gains of section 6.1, 'the simulation environment of Theorem 1', its neighborhood is small enough", "condition",
             r"\sqrt{\tfrac{2l}{\mu}} \le 0.26 + \alpha k", "violated", origin="implied", severity="data", section="6.1",
             rests_on=(), reading="Small enough for the reported speed error of at most 0.26 m/s, which with |e_1| < k makes |e_2| <= 0.26 + alpha k.",
             at={**best_case, k: stated_gains[k]}, repair={**repaired_gains, k: stated_gains[k]},
             note=f"mu = {float(smallest_rate):.0e}/s, so that V needs {1 / float(smallest_rate) / 3600:.1f} hours to come down to a share of 1/e, in a run of "
                  f"{scenario.desired_curve().trip_time_s / 60:.0f} minutes. With W* = 0 and the least eps* that Table 1 allows (7.error), in the paper's favour, l/mu is {level_at_best:.1f}: all that "
                  f"Theorem 1 says is |e_2| <= {ultimate_speed_bound:.1f} m/s in the end, and of e_1 nothing beyond the constraint (theorem1.stated). The reported accuracy does not come from the theorem. "
                  "The gains at which it holds are for W*^2 <= 1/20, at the price of lambda_3 v^4 beyond any usual sampling rate.")
def bound_explains_speed_error() -> Goal:
    """2 l <= (0.26 + alpha k)^2 mu."""
    return Goal((at_most(2 * l_numbers, (sp.Rational(26, 100) + alpha * k) ** 2 * mu),), slowest)


@paper.claim("theorem1.stated", "At the gains of section 6.1 the neighborhood of e_1 is within 0.2 m", "condition",
             r"k\sqrt{1 - e^{-2l/\mu}} \le 0.2", "violated", origin="ours", rests_on=(),
             at={**best_case, k: stated_gains[k]}, repair={**repaired_gains, k: stated_gains[k]},
             note="The ultimate bound of V keeps e_1 only below 0.20999 m, which is k itself to all digits that the paper prints; the other bound, sqrt(2l/mu)/alpha of "
                  f"theorem1.speed, is {ultimate_speed_bound / float(stated_gains[alpha]):.0f} m.")
def bound_explains_position_error() -> Goal:
    """k^2 (1 - exp(-2 l/mu)) <= 0.2^2."""
    return Goal((at_most(k**2 * (1 - sp.exp(-2 * l_numbers / mu)), sp.Rational(1, 25)),), slowest)


reach, rate_reach, estimate_reach, curve_reach, u_max, u_brake = sp.symbols(
    "e_max edot_max g_max a_max u_max u_brake", positive=True)


def _command(error: sp.Expr, error_rate: sp.Expr, estimates: sp.Expr, acceleration: sp.Expr) -> sp.Expr:
    """u of (33) with its estimates gathered in one number."""
    put = {x_1: error, x_d: sp.Integer(0), x_2: error_rate, xdot_d: sp.Integer(0), xddot_d: acceleration}
    return estimates + law.feedback.xreplace(put)


def barrier_at(error_m: float) -> float:
    """The last term of (33) in m/s^2 at a position error."""
    return error_m / (float(stated_gains[k]) ** 2 - error_m**2)


@paper.claim("33.figures", "Figures 8 and 9 fit (33): an error of 0.142 m with an input of at most 0.48 m/s^2",
             "condition",
             r"e_1 = -0.142: u \le 0.48;\quad e_1 = 0.142: u \ge -3\ \tfrac{m}{s^2}", "violated", origin="ours", rests_on=(),
             at={reach: Fraction(142, 1000), rate_reach: Fraction(26, 100), estimate_reach: Fraction(1),
                 curve_reach: Fraction(1), u_max: Fraction(48, 100), u_brake: Fraction(3),
                 **{s: stated_gains[s] for s in (alpha, beta, k)}},
             note="The limit of 3 m/s^2 is ours, and so are the estimates; the sign of the printed error is not stated. If it is negative, (33) commands several times the "
                  "largest input printed; if positive, a braking that no train has. Taken in the paper's favour: "
                  "estimates between 0 and 1 m/s^2, a desired acceleration of up to 1 m/s^2, the printed speed error of "
                  f"0.26 m/s in the helpful direction. The barrier term alone is {barrier_at(0.142):.1f} m/s^2 at 0.142 m, {barrier_at(0.178):.1f} at the "
                  f"0.178 m of Table 2 and {barrier_at(0.2):.0f} at the 0.2 m that the text and Table 2 give for POCRAC.")
def printed_figures_fit() -> Goal:
    """The smallest command at the negative error, the largest at the positive one."""
    behind = _command(-reach, rate_reach, sp.Integer(0), -curve_reach)
    ahead = _command(reach, -rate_reach, estimate_reach, curve_reach)
    return Goal((at_most(behind, u_max), at_least(ahead, -u_brake)), (greater(k**2 - reach**2, 0),))

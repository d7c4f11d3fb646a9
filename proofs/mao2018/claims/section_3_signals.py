"""mao2018, section III: what bounds the control and the rate of z_2, once V_2 and the speed are bounded.

Bounds are letters: of squares of the estimates and of their errors R, of x_2^2 X, of x_m''^2 A, and so on (letters.py).
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_most

from ..active_mode import REGRESSORS, chi_d, chis, d, eta, hats, lambda_0, m, nu_healthy, rho_0, rho_hat, zeta
from ..counterexamples import at_instant
from ..error_dynamics import ACTIVE_MODE, Flow, d_0, disturbed, filippov
from ..paper import paper
from ..plant import r_1, r_2, s, x_2, xddot_m, xdot_m, z_1, z_2

B, R_max, X_max, A_max, Z_max, W_max = sp.symbols("B R X A Z W", nonnegative=True)
P_max, C_max, S_max, Phi_max = sp.symbols("P C S Phi", nonnegative=True)
zeta_one, w_i, e_i, rho_error = sp.symbols("zeta w_i e_i rho_tilde", real=True)
wanted_one = zeta_one - eta - r_2 * z_2
bounded_errors = (at_most(z_1**2, 2 * B), at_most(z_2**2, 2 * B))
most_wanted = 6 * (Z_max + 2 * B * (1 + r_1**2 + r_1**4 + r_2**2) + A_max)
rho_m = sp.Symbol("rho_m0", positive=True)  # of (36), as it is read
nu_read = nu_healthy.xreplace({rho_0: rho_m})
most_nu = lambda_0**2 / rho_m**2
bounded_curve, bounded_speed = at_most(xddot_m**2, A_max), at_most(xdot_m**2, A_max)


@paper.claim("35.zeta", "zeta_i is bounded with the estimates and the speed", "inequality",
             r"\zeta_i^2 \le 5R(1 + X + X^2 + g^2 + 0.004^2)\ \text{for}\ \hat a_i^2, \dots, \hat D_i^2 \le R,\ x_2^2 \le X", "proved",
             origin="ours", scope=ACTIVE_MODE, note="So is the same sum of the estimation errors, whose squares are bounded alike.")
def zeta_bounded() -> Goal:
    """Five terms, each bounded."""
    sizes = (R_max, R_max * X_max, R_max * X_max**2, *(R_max * by**2 for by in REGRESSORS[3:]))
    return Goal((at_most(zeta**2, 5 * sp.Add(*sizes)),),
                (*(at_most(hat**2, R_max) for hat in hats), *(at_most(chi, 1) for chi in chis), at_most(x_2**2, X_max)))


@paper.claim("35.wanted", "What rho_hat multiplies in the control is bounded with x_m''", "inequality",
             r"(\zeta_i - \eta - r_2z_2)^2 \le 6(Z + 2B(1 + r_1^2 + r_1^4 + r_2^2) + A)\ \text{for}\ \zeta_i^2 \le Z,\ z_1^2, z_2^2 \le 2B,\ "
             r"\ddot x_m^2 \le A", "proved", premises=("35.zeta",), origin="ours", scope=ACTIVE_MODE)
def wanted_bounded() -> Goal:
    """Six terms, each bounded."""
    return Goal((at_most(wanted_one**2, most_wanted),), (at_most(zeta_one**2, Z_max), *bounded_errors, bounded_curve))


def _quiet(goal: Goal) -> Goal:
    """The goal on the desired curve, at a constant desired speed so far as its bound knows."""
    values: Flow = dict.fromkeys((zeta_one, z_1, z_2, xdot_m, A_max, B, Z_max, d, e_i, s), sp.Integer(0))
    values |= dict.fromkeys((rho_hat, rho_error, R_max, lambda_0, rho_m, m, chi_d, d_0, r_1, r_2), sp.Integer(1))
    used = {symbol for r in (*goal.show, *goal.assume) for side in (r.left, r.right) for symbol in side.free_symbols}
    return at_instant(goal, {symbol: value for symbol, value in values.items() if symbol in used})


@paper.claim("theorem1.F", "The control F is bounded", "implication",
             r"\text{Then, from (35), the boundedness of the control } F(t) \text{ is ensured}", "gap", match="words", rests_on=("38",),
             scope=ACTIVE_MODE,
             reading="The bound of theorem1.F.mended, with one of x_m' instead of x_m''.",
             note="(35) holds eta of (32), and this x_m'', of which no assumption says that it is bounded. It does not follow from a "
                  "bounded x_m': with x_m' = sin(t^2), exact estimates, no disturbance and a start on the curve the train stays on "
                  "it, and m F = 2 t cos(t^2) + a + b x_2 + c x_2^2 + ... Where the sentence after Theorem 1 has x_m'' for x_m' "
                  "(theorem1.alpha), the paper supposes that bound there, after the theorem; it should be an assumption of it.")
def control_bounded() -> Goal:
    """With x_m' bounded alone."""
    force = nu_read * chi_d + rho_hat * wanted_one
    return _quiet(Goal((at_most(force**2, 2 * most_nu + 2 * R_max * most_wanted),),
                       (*filippov, at_most(chi_d, 1), at_most(rho_hat**2, R_max), at_most(zeta_one**2, Z_max), *bounded_errors,
                        bounded_speed)))


@paper.claim("theorem1.F.mended", "The control F is bounded with x_m''", "implication",
             r"F^2 \le 2\left(\tfrac{\lambda_i^0}{\rho_m^0}\right)^2 + 2RW\ \text{for}\ \hat\rho_i^2 \le R,\ "
             r"(\zeta_i - \eta - r_2z_2)^2 \le W", "proved", premises=("35.wanted",), origin="ours", mends="theorem1.F", scope=ACTIVE_MODE)
def control_bounded_mended() -> Goal:
    """Two terms, each bounded; w is what rho_hat multiplies."""
    return Goal((at_most((nu_read * chi_d + rho_hat * w_i) ** 2, 2 * most_nu + 2 * R_max * W_max),),
                (*filippov, at_most(chi_d, 1), at_most(rho_hat**2, R_max), at_most(w_i**2, W_max)))


def closed_z_2(wanted: sp.Expr) -> sp.Expr:
    """z_2' of theorem1.z2.loop, by the sum of the resistances' errors, the error of rho_hat and what rho_hat multiplies."""
    return -z_1 - r_2 * z_2 - e_i - m * rho_error * wanted + m * nu_read * chi_d + d * chi_d


def rate_of_z_2(wanted: sp.Expr, most: sp.Expr, *given: Relation) -> Goal:
    """The square of z_2' against a bound, most being that of the square of what rho_hat multiplies."""
    bound = 6 * (2 * B * (1 + r_2**2) + Z_max + m**2 * R_max * most + m**2 * most_nu + d_0**2)
    parts = ((m * nu_read * chi_d, m**2 * most_nu), (d * chi_d, d_0**2), (m * rho_error * wanted, m**2 * R_max * most))
    return Goal((at_most(closed_z_2(wanted) ** 2, bound),),
                (*filippov, *disturbed[:2], at_most(chi_d, 1), at_most(rho_error**2, R_max), at_most(e_i**2, Z_max), *bounded_errors,
                 *given), lemmas=tuple(at_most(part**2, size) for part, size in parts))


def rate_of_z_2_open() -> Goal:
    """With x_m' bounded alone."""
    goal = rate_of_z_2(wanted_one, most_wanted, at_most(zeta_one**2, Z_max), bounded_speed)
    return _quiet(Goal(goal.show, goal.assume))

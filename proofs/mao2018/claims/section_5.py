"""mao2018, section V: unparameterizable failures, (48)-(52), and Theorem 3."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..active_mode import chi_d, d, delta_0, lambda_0, m, nu_failed, nu_s_sum, rho_0, rho_k0, signal_of
from ..counterexamples import already, exact, one_failed, unit_gains
from ..error_dynamics import (
    ACTIVE_MODE,
    ALL_SIGNALS,
    Flow,
    disturbed,
    failed_train,
    filippov,
    k_v,
    laws_printed,
    laws_true,
    size,
    within,
)
from ..lyapunov import V_40, V_true, decay, m_idle, square_integrable
from ..paper import paper
from ..plant import s, z_1, z_2
from ..steady_state_error import STEADY_STATE_ERROR, epsilon, steady_state_error
from .section_4_design import LEFT, OUTWEIGHED, left_by, outweighed

delta, delta_1, delta_2 = sp.symbols("delta delta_1 delta_2", real=True)
bound_1, bound_2 = sp.symbols("delta_1_0 delta_2_0", positive=True)


def _compensated_51(failures: int) -> Goal:
    """The terms of V_2' that (49), (50) compensate with two failed motors; the disturbance's counted `failures` times."""
    true = z_2 * m * (delta_1 + delta_2 - k_v * (bound_1 + bound_2) * s / rho_k0) + z_2 * (
        d * chi_d - m * k_v * lambda_0 * s / rho_0)
    stated = sum((m * z_2 * rest - m * k_v / rho_k0 * most * size for rest, most in (
        (delta_1, bound_1), (delta_2, bound_2))), sp.Integer(0))
    stated += failures * (z_2 * d * chi_d - m * k_v / rho_0 * lambda_0 * size)
    return Goal((equal(true, stated),), (*filippov, at_most(chi_d, 1)))


TERMS_51 = (r"%s\left(m_iz_2\bar\delta_j\chi_{mi} - \tfrac{m_ik_\nu}{\rho_{k\nu}^0}\delta_j^0|z_2|\chi_{mi}%s z_2\bar d_i"
            r"\chi_{\bar di} - \tfrac{m_ik_\nu}{\rho_i^0}\lambda_i^0|z_2|\chi_{%si}%s")


@paper.claim("51.a", "The terms that (49), (50) compensate", "identity",
             r"\dot V_2 + r_1z_1^2 + r_2z_2^2 = \sum_i" + TERMS_51 % (r"\sum_{j=1}^{n-k_\nu}", " +", r"\bar d", r"\right)"),
             "refuted", premises=("45.a", "17"), scope="one active mode, n - k_nu = 2",
             correction=lambda: _compensated_51(1),
             corrected_statement=r"\sum_i\Big[" + TERMS_51 % (r"\sum_{j=1}^{n-k_\nu}", r"\right) +", "m", r"\Big]"),
             note="The sum over j counts the disturbance and nu_di once for each failed motor. Cosmetic: both terms "
                  "together are not positive. True as printed for n - k_nu = 1, as in case 3. All that 45.a finds "
                  "wrong is left out here.")
def compensation_terms() -> Goal:
    """z_2 m_i k_nu (nu_s + nu_d) + z_2 m_i delta + z_2 d_i chi_di against the printed double sum."""
    return already(_compensated_51(2), {k_v: sp.Integer(14), m: sp.Integer(1), chi_d: sp.Integer(1)})


def unparameterized(laws: Flow) -> Flow:
    """(7), (8), (17) with (48)-(50) and the laws given; delta is the sum of the delta_j of failed motors."""
    return {**failed_train(signal_of(nu_failed + nu_s_sum) + delta / k_v), **laws}


rest_bounds = (at_most(delta, delta_0), at_least(delta, -delta_0), at_least(k_v, rho_k0))


@paper.claim("48", "What the controller leaves of the rate of V_2", "identity",
             LEFT % r"\textstyle\sum_j\nu_{sj} + \nu_{di}", "proved", premises=("17", "42"), scope=ALL_SIGNALS)
def unparameterized_controller_in_rate() -> Goal:
    """(48) in the bracket of V_2'."""
    return left_by(signal_of(nu_failed + nu_s_sum), nu_failed, nu_s_sum)


@paper.claim("49", "nu_s outweighs the unparameterizable failures", "inequality",
             r"|\bar\delta_j| \le \delta_j^0,\ k_\nu \ge \rho_{k\nu}^0 \Rightarrow z_2m_i\left(k_\nu\textstyle\sum_j\nu_{sj} + "
             r"\sum_j\bar\delta_j\right) \le 0", "proved", premises=("17",), scope=ACTIVE_MODE,
             note="delta is the sum over the failed motors, delta_0 that of their bounds.")
def failures_outweighed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return Goal((at_most(z_2 * m * (k_v * nu_s_sum + delta), 0),), (*filippov, *rest_bounds))


@paper.claim("50", "nu_d outweighs the disturbance, as in (43)", "inequality",
             OUTWEIGHED % r"\lambda_i^0 \ge d_i^0 \ge |\bar d_i|", "proved", premises=("43",), scope=ACTIVE_MODE,
             note="(50) is (43) again.")
def disturbance_outweighed_again() -> Goal:
    """(43) again."""
    return outweighed(nu_failed, *disturbed)


def _bound_51(repaired: bool) -> Goal:
    V, laws = (V_true, laws_true) if repaired else (V_40, laws_printed)
    return Goal((at_most(D(V), decay),),
                (*filippov, *disturbed, *rest_bounds, at_most(chi_d, 1), at_least(m * k_v, rho_0)),
                unparameterized(laws), lemmas=within)


@paper.claim("51", "V_2 does not increase with unparameterizable failures: the whole argument", "implication",
             r"|\bar\delta_j| \le \delta_j^0,\ k_\nu \ge \rho_{k\nu}^0,\ m_ik_\nu \ge \rho_i^0 \Rightarrow \dot V_2 \le "
             r"-r_1z_1^2 - r_2z_2^2", "gap", premises=("17", "39", "45", "25.idle"), scope=ALL_SIGNALS,
             correction=lambda: _bound_51(repaired=True),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2\ \text{with 45 repaired}",
             note="For the reasons of 45 alone. delta is the sum over the failed motors of delta_j, delta_0 that of "
                  "delta_j^0. (48) sums nu_sj up to n - k_nu, which the controller does not know; the bound holds for "
                  "every delta_0 that is large enough, so the sum may run over the n_bar motors with the largest "
                  "delta_j^0.")
def v2_bound_unparameterized() -> Goal:
    """D(V_2) of (40) along (7), (8), (17) with (27)-(31), (37), (41), (44), (48)-(50)."""
    return already(_bound_51(repaired=False), exact | one_failed | unit_gains | {
        m_idle: sp.Integer(3), delta: sp.Integer(0), delta_0: sp.Integer(1), rho_k0: sp.Integer(15)})


w_rate = sp.Symbol("Vdot_2", real=True)


def _rate_52(relation: Callable[[sp.Expr, sp.Expr], Relation]) -> Goal:
    return Goal((relation(w_rate, decay),), (at_most(w_rate, decay),))


@paper.claim("52", "V_2 decreases at exactly this rate", "implication",
             r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 \le 0", "gap", premises=("51",), correction=lambda: _rate_52(at_most),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 \le 0",
             note="Cosmetic: (51) gives at most, not equality; only that is used.")
def rate_52() -> Goal:
    """The equality from the bound of (51)."""
    return _rate_52(equal)


@paper.claim("theorem3", "The position error tends to zero with unparameterizable failures", "limit",
             r"\lim_{t\to\infty}(x_1 - x_m) = 0\ \text{under (27)-(31), (37), (41), (44), (48)-(50)}", "gap",
             premises=("45", "51", "52"), scope=ALL_SIGNALS, correction=square_integrable,
             corrected_statement=r"\text{with 45 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)",
             note="False as printed: " + STEADY_STATE_ERROR + "The bound delta_j^0 is 1, delta_j is 0. Mended as 45 is, 51 "
                  "holds, and Theorem 3 with it.")
def theorem_3() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    one = sp.Integer(1)
    return steady_state_error(at_most(z_1**2, epsilon), nu_failed + nu_s_sum,
                           {epsilon: sp.Rational(1, 4), lambda_0: one, delta: sp.Integer(0), delta_0: one,
                            rho_k0: sp.Integer(15)}, *disturbed, *rest_bounds, extra_force=delta)

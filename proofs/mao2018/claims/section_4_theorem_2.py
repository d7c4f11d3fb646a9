"""mao2018, section IV: the rate (45) of V_2, its jumps (46) at failures, and Theorem 2."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..active_mode import basis, chi_d, d, lambda_0, m, nu_failed, over_basis, rho_0, signal_of
from ..counterexamples import already, exact, one_failed, unit_gains
from ..error_dynamics import ALL_SIGNALS, disturbed, failed_train, filippov, k_v, laws_printed, laws_true, size, within
from ..lyapunov import V_40, V_true, decay, m_idle, square_integrable
from ..paper import paper
from ..plant import z_1, z_2
from ..steady_state_error import STEADY_STATE_ERROR, epsilon, steady_state_error

REPAIR = ("Repaired: (44) with a plus; in V_2 the weight m_i k_nu for rho_knu and rho_i, and no sum over the modes "
          "for rho_knu and xi, which takes either one mass in all modes or estimates of xi and rho_knu for each mode "
          "that rest while it is idle. ")


def _rate_45(repaired: bool) -> Goal:
    V, laws, own = (V_true, laws_true, 1) if repaired else (V_40, laws_printed, chi_d)
    stated = decay - m * k_v / rho_0 * lambda_0 * size * own + z_2 * d * chi_d
    return Goal((equal(D(V), stated),), (*filippov, at_most(chi_d, 1)), {**failed_train(signal_of(nu_failed)), **laws})


@paper.claim("45.a", "Rate of V_2 in closed loop with failures", "identity",
             r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 + \sum_i\left(-\tfrac{m_ik_\nu}{\rho_i^0}\lambda_i^0|z_2|\chi_{\bar di} + "
             r"z_2\bar d_i\chi_{\bar di}\right)", "refuted", premises=("41", "44", "37.failures"), scope=ALL_SIGNALS,
             correction=lambda: _rate_45(repaired=True),
             corrected_statement=r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 + \sum_i\left(-\tfrac{m_ik_\nu}{\rho_i^0}\lambda_i^0|z_2|"
                                 r"\chi_{mi} + z_2\bar d_i\chi_{\bar di}\right)",
             note=REPAIR + "(42) lacks the indicator chi_di that (35) has, so that chi_mi stands in the corrected "
                  "rate, which only helps. (43)'s bound rho_i^0 is one of m_i k_nu, as the text says after a slip.")
def v2_rate_failed_closed() -> Goal:
    """D(V_2) of (40) along (39), (27)-(31), (37), (41)-(44), as printed."""
    return already(_rate_45(repaired=False), exact | one_failed)


def _bound_45(repaired: bool) -> Goal:
    V, laws = (V_true, laws_true) if repaired else (V_40, laws_printed)
    return Goal((at_most(D(V), decay),), (*filippov, *disturbed, at_most(chi_d, 1), at_least(m * k_v, rho_0)),
                {**failed_train(signal_of(nu_failed)), **laws}, lemmas=within)


@paper.claim("45", "V_2 does not increase with failures: the whole argument", "implication",
             r"m_ik_\nu \ge \rho_i^0,\ \lambda_i^0 \ge d_i^0 \ge |\bar d_i| \Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2",
             "gap", premises=("39", "25.idle"), scope=ALL_SIGNALS, correction=lambda: _bound_45(repaired=True),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2\ \text{with}\ \dot{\hat\rho}_{k\nu} = "
                                 r"+\Gamma_{k\nu}z_2\hat\xi^T\varpi\ \text{and the weights of}\ V_2\ \text{repaired}",
             note=REPAIR + "With it the checker derives V_2' from the plant and the laws and confirms the bound.")
def v2_bound_failed() -> Goal:
    """D(V_2) of (40) along the closed loop as printed."""
    return already(_bound_45(repaired=False), exact | one_failed | unit_gains | {m_idle: sp.Integer(3)})


weight, error_before, jump = (sp.IndexedBase(name, real=True)[basis] for name in ("omega", "error", "jump"))
V_rest = sp.Symbol("V_rest", nonnegative=True)


@paper.claim("46", "A failure raises V_2 by a finite amount", "implication",
             r"V_2(T_p^+) \le 2V_2(T_p^-) + \sum_q\omega_q(\Delta_q)^2", "proved",
             scope="every number of parameters that jump",
             note="The sum runs over the parameters that jump at T_p (xi, rho_knu, all rho_i) by Delta_q, omega_q "
                  "being twice their weight in V_2. The weights with k_nu do not grow when a motor fails. With "
                  "finitely many failures V_2 is finite after the last one, as the paper says.")
def finite_jump() -> Goal:
    """(e + Delta)^2 <= 2 e^2 + 2 Delta^2, term by term; weights are omega^2/2."""
    before = V_rest + over_basis(weight**2 * error_before**2 / 2)
    after = V_rest + over_basis(weight**2 * (error_before + jump) ** 2 / 2)
    return Goal((at_most(after, 2 * before + over_basis(weight**2 * jump**2)),))


@paper.claim("47", "After the last failure V_2 stays finite and the errors are square integrable", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 \le 0 \Rightarrow V_2(t) + "
             r"\int_{T_{\bar M}}^t (r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(T_{\bar M})", "proved",
             premises=("40", "45", "46", "25.switch", "filippov"), scope=ALL_SIGNALS,
             note="Time counts from T_M here. 'z_1 in L_2 and so lim z_1 = 0' needs the bounded rate of z_1 too, which "
                  "section III gives.")
def finite_after_failures() -> Goal:
    """J + V does not increase, where J is the integral."""
    return square_integrable()


@paper.claim("theorem2", "The position error tends to zero with failures", "limit",
             r"\lim_{t\to\infty}(x_1 - x_m) = 0\ \text{under (27)-(31), (37), (41)-(44)}", "gap", premises=("45", "47"),
             scope=ALL_SIGNALS, correction=square_integrable,
             corrected_statement=r"\text{with 45 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0),\ \text{so}\ "
                                 r"z_1 \to 0\ \text{as in Theorem 1}",
             note="False as printed: " + STEADY_STATE_ERROR + "The cause is the sign of (44); with it mended (45) holds when all "
                  "modes have one mass, as in section VIII, and Theorem 2 with it.")
def theorem_2() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return steady_state_error(at_most(z_1**2, epsilon), nu_failed, {epsilon: sp.Rational(1, 4), lambda_0: sp.Integer(1)},
                           *disturbed)

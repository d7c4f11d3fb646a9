"""mao2018, section IV: the rate (45) of V_2, its jumps at failures, and Theorem 2."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal

from ..active_mode import (
    Gamma_k,
    basis,
    chi_d,
    d,
    failure_hat,
    lambda_0,
    m,
    nu_failed,
    over_basis,
    rho_0,
    rho_hat,
    rho_k_hat,
    signal_of,
    varpi,
    xi_hat,
)
from ..counterexamples import at_instant, failing, one_mode
from ..error_dynamics import (
    ALL_SIGNALS,
    disturbed,
    failed_train,
    filippov,
    k_v,
    laws_printed,
    laws_true,
    over_modes,
    within,
)
from ..lyapunov import V_40, V_true, decay, square_integrable, tracks
from ..modes import (
    EVERY_MODE,
    V_40_i,
    chi_di,
    chi_mi,
    d_i,
    estimates,
    lambda_i,
    m_i,
    one_region,
    p,
    p_hat,
    rho_0i,
    rho_hat_i,
    rho_law_i,
    size,
    train,
    wanted_i,
    xi_square,
    xi_square_rate,
)
from ..paper import paper
from ..plant import s, z_1, z_2
from ..steady_state_error import LAWS, STEADY_STATE_ERROR, epsilon, steady_state_error
from .section_3_signals import C_max, P_max, Phi_max, R_max, S_max, W_max, w_i

REPAIR = ("Repaired: (44) with a plus; in V_2 the weight m_i k_nu for rho_knu and rho_i, and no sum over the modes "
          "for rho_knu and xi, which takes one mass in all modes. Where the mass changes finitely often, as at stations, the same holds "
          "from the last change on (46.mass); a mass that changes for ever stays open. ")
ONE_MASS = r",\ m_1 = \dots = m_l\text{, from } T_{\bar M} \text{ on, the last failure or change of its constants, time zero being then}"
BOUNDED = (r"\text{: }\lim_{t\to\infty} e(t) = 0\text{, and}\ z_1, z_2\ \text{and all estimates are bounded; all signals are, if}\ "
           r"x_m, \dot x_m, \ddot x_m\ \text{and all}\ f_{j\rho}\ \text{are}")


def loop_by_modes(nu: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """(39), (42) with nu_di = nu, (27)-(31), (37), (41), (44) as printed, with sums over the modes."""
    force = k_v * (-rho_k_hat * p_hat + nu + rho_hat_i * wanted_i) + p
    return {**train(m_i * chi_mi * force), **estimates, rho_hat_i: rho_law_i, rho_k_hat: -Gamma_k * z_2 * p_hat,
            xi_square: xi_square_rate}


@paper.claim("45.a", "Rate of V_2 in closed loop with failures", "identity",
             r"\dot{V}_2 = -r_1z_1^2(t) - r_2z_2^2(t) + \sum_{i=1}^{l}\left(-\frac{m_ik_{\nu}}{\rho_i^0}\lambda_i^0|z_2(t)|"
             r"\chi_{\bar{d}i}(t) + z_2(t)\bar{d}_i(t)\chi_{\bar{d}i}(t)\right)", "refuted",
             premises=("35.modes",), rests_on=("41", "42", "43", "44", "37.failures"), scope=EVERY_MODE,
             where={"V_2": V_40_i},
             corrected_statement=r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 + \sum_i\left(-\tfrac{m_ik_\nu}{\rho_i^0}\lambda_i^0|z_2|"
                                 r"\chi_{mi} + z_2\bar d_i\chi_{\bar di}\right)", correction=lambda: _rate_45_mended(),  # noqa: PLW0108 - defined below
             reading="One mode and k_nu = 1, where the weights of (40) fit: (44) alone is at fault here.",
             note=REPAIR + "(42) lacks the indicator chi_di that (35) has, so that chi_mi stands in the corrected "
                  "rate, which only helps. (43)'s bound rho_i^0 is one of m_i k_nu, as the text says after a slip.")
def v2_rate_failed_closed() -> Goal:
    """D(V_2) of (40) along (39), (27)-(31), (37), (41)-(44), as printed; one mode."""
    stated = decay + over_modes(-m_i * k_v / rho_0i * lambda_i * size * chi_di + z_2 * d_i * chi_di)
    return one_mode(Goal((equal(D(V_40_i), stated),), (*one_region, *filippov), loop_by_modes(-lambda_i * s / rho_0i)))


def _rate_45_mended() -> Goal:
    stated = decay - m * k_v / rho_0 * lambda_0 * s * z_2 + z_2 * d * chi_d
    return Goal((equal(D(V_true), stated),), (at_most(chi_d, 1),), {**failed_train(signal_of(nu_failed)), **laws_true})


def _bound_45(mended: bool) -> Goal:
    V, laws = (V_true, laws_true) if mended else (V_40, laws_printed)
    return Goal((at_most(D(V), decay),), (*filippov, *disturbed, at_most(chi_d, 1), at_least(m * k_v, rho_0)),
                {**failed_train(signal_of(nu_failed)), **laws}, lemmas=within)


def _printed_45() -> Goal:
    return failing(_bound_45(mended=False))


ALONE_44 = ("Shown where (44) alone is at fault: one mode, k_nu = 1 of two motors, so that the weights of (40) fit, and exact "
            "estimates of rho_i. ")
BOUND = r"\dot{V}_2 \leq -r_1z_1^2(t) - r_2z_2^2(t)"
WEIGHTS = (r"m_1 = \dots = m_l\ \text{and, without sums over the modes, the weights}\ m_ik_\nu\ \text{of}\ \tilde\rho_{k\nu}^2\ "
           r"\text{and}\ \tilde\rho_i^2\text{,}\ m_i\ \text{of}\ \tilde\xi^T\tilde\xi\ \text{in}\ V_2")
MENDED_45 = (BOUND + r"\ \text{with}\ \dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi\text{,}\ " + WEIGHTS)


@paper.claim("45", "V_2 does not increase with failures: the whole argument", "inequality", BOUND, "refuted",
             premises=("39", "25.idle"), rests_on=("45.a", "43"), scope=ALL_SIGNALS, where={"V_2": V_40}, closed_loop=True,
             reading=ALONE_44,
             note="The last line of (45), for m_i k_nu >= rho_i^0 and lambda_i^0 >= d_i^0 >= |d_i|. " + REPAIR +
                  "With it the checker derives V_2' from the plant and the laws and confirms the bound (45.mended).")
def v2_bound_failed() -> Goal:
    """D(V_2) of (40) along the closed loop as printed."""
    return _printed_45()


@paper.claim("45.mended", "V_2 does not increase with failures, laws and weights mended", "inequality", MENDED_45, "proved",
             premises=("39", "25.idle", "44.mended"), origin="ours", mends="45", scope=ALL_SIGNALS, note=REPAIR)
def v2_bound_failed_mended() -> Goal:
    """D(V_2) along the closed loop with (44) mended, the weights fitting."""
    return _bound_45(mended=True)


@paper.claim("46", "V_2 does not increase between failures and switches", "inequality", BOUND, "refuted",
             premises=("39", "25.idle"), rests_on=("45",), scope=ALL_SIGNALS, where={"V_2": V_40}, closed_loop=True,
             note="(45) again, and false with it; mended as 45.mended.")
def v2_bound_between() -> Goal:
    """The same instant as for (45)."""
    return _printed_45()


a_mode, a_before, a_after = sp.symbols("a_mode a_before a_after", real=True)


@paper.claim("46.parameters", "The text after (45): The parameters of a mode change their values when the mode switches", "inequality",
             r"\text{the unknown system parameters } a_i, b_i, c_i, \vartheta_i \text{, and } D_i \text{ change their values, at time } "
             r"T_q", "refuted", severity="cosmetic", match="words", rests_on=("8.modes",),
             reading="Of a_i, which by (9), (10) is one unknown constant of its mode: before and after T_q it is not the same.",
             note="The text before (41) says that they are constant for all such time intervals. That is what (9), (10) have, and "
                  "the proof needs it (25.switch): were they to jump, V_2 would at each of infinitely many instants.")
def parameters_jump() -> Goal:
    """A constant at two instants."""
    return Goal((differ(a_before, a_after),), (equal(a_before, a_mode), equal(a_after, a_mode)))


weight, error_before, jump = (sp.IndexedBase(name, real=True)[basis] for name in ("omega", "error", "jump"))
V_rest = sp.Symbol("V_rest", nonnegative=True)


@paper.claim("46.jump", "A failure raises V_2 by a finite amount", "implication",
             r"\text{Since there are only a finite number of failures in the system, } V_2(T_{\bar{M}}) \text{ is finite}",
             "proved", match="words", scope="every number of parameters that jump",
             reading="V_2(T_p^+) <= 2 V_2(T_p^-) + sum_q omega_q Delta_q^2 over the parameters that jump at T_p (xi, "
                     "rho_knu, all rho_i) by Delta_q, omega_q being twice their weight in V_2.",
             note="The weights with k_nu do not grow when a motor fails. That V_2 does not grow between the failures is "
                  "(46).")
def finite_jump() -> Goal:
    """(e + Delta)^2 <= 2 e^2 + 2 Delta^2, term by term; weights are omega^2/2."""
    before = V_rest + over_basis(weight**2 * error_before**2 / 2)
    after = V_rest + over_basis(weight**2 * (error_before + jump) ** 2 / 2)
    return Goal((at_most(after, 2 * before + over_basis(weight**2 * jump**2)),))


errors = sp.Symbol("E_m", nonnegative=True)
mass_before, mass_after = sp.symbols("m_before m_after", positive=True)


@paper.claim("46.mass", "A change of the mass raises V_2 by a finite factor", "inequality",
             r"V_2(T^+) \le \left(1 + \tfrac{m^+}{m^-}\right)V_2(T^-)", "proved", origin="ours",
             note="The weights of the errors of rho_knu and xi hold the mass of the active mode, all others that of their own mode.")
def finite_factor() -> Goal:
    """What the mass multiplies, and the rest of V_2."""
    before, after = (V_rest + mass * errors for mass in (mass_before, mass_after))
    return Goal((at_most(after, (1 + mass_after / mass_before) * before),))


@paper.claim("47", "V_2 does not increase after the last failure", "inequality", BOUND + r" \leq 0", "refuted",
             premises=("39", "25.idle"), rests_on=("46",), scope=ALL_SIGNALS, where={"V_2": V_40}, closed_loop=True,
             note="(45) again, and false with it; mended as 45.mended.")
def v2_bound_after() -> Goal:
    """The same instant as for (45)."""
    goal = _printed_45()
    return Goal((*goal.show, at_most(decay, 0)), goal.assume, goal.flow)


@paper.claim("47.finite", "Where (47) holds, the errors are square integrable", "implication",
             r"\text{it follows that all the variables}\ldots\text{are bounded}\ldots (47) \text{ implies } z_1(t) \in L_2 "
             r"\text{ and so } \lim_{t\to\infty} z_1(t) = 0", "proved", match="words",
             premises=("40", "46.jump", "25.switch", "filippov"), rests_on=("47", "46.jump"), scope=ALL_SIGNALS,
             reading="Where (47) holds, V_2(t) and the integral of r_1 z_1^2 + r_2 z_2^2 from T_M on are together at most "
                     "V_2(T_M).",
             note="Time counts from T_M here. The limit needs the bounded rate of z_1 too, which section III gives.")
def finite_after_failures() -> Goal:
    """J + V does not increase, where J is the integral."""
    return square_integrable()


rho_k_one, nu_c, xi_one, varpi_one, p_one = sp.symbols("rho_k_hat nu_c xi_hat_1 varpi_1 xi_hat_varpi", real=True)


def _signal(pushed: sp.Expr, most: sp.Expr, *given: Relation) -> Goal:
    """(42) by its three parts against their bounds; pushed: xi_hat^T varpi, most: the bound of its square."""
    return Goal((at_most((-rho_k_one * pushed + nu_c + rho_hat * w_i) ** 2, 3 * (R_max * most + C_max + R_max * W_max)),),
                (at_most(rho_k_one**2, R_max), at_most(rho_hat**2, R_max), at_most(nu_c**2, C_max), at_most(w_i**2, W_max), *given))


@paper.claim("47.signal", "The text after (47): nu_0 is bounded", "implication",
             r"\text{Then, with the failure compensation controller (42), the boundedness of } \nu_0(t) \text{ is ensured}", "gap",
             match="words", rests_on=(), scope=ALL_SIGNALS,
             reading="The bound of 47.signal.mended for one basis signal of which nothing is known: Phi bounds varpi^T varpi there and is any "
                     "number here.",
             note="It takes bounded basis signals f_jrho, which neither (11) nor (A1) asks for: a failed motor with f = e^t has to be "
                  "outweighed by nu_0. It takes a bounded x_m'' as well (theorem1.F). Sections V and VI say the same of (48).")
def signal_bounded() -> Goal:
    """With nothing known of the basis signal."""
    one, zero = sp.Integer(1), sp.Integer(0)
    return at_instant(_signal(xi_one * varpi_one, ((S_max + Phi_max) / 2) ** 2, at_most(xi_one**2, S_max)), {
        nu_c: zero, C_max: zero, w_i: zero, W_max: zero, rho_hat: zero, rho_k_one: one, R_max: one, xi_one: one, S_max: one,
        Phi_max: zero})


@paper.claim("47.basis", "xi_hat^T varpi is bounded with the basis signals", "inequality",
             r"2|\hat\xi^T\varpi| \le \hat\xi^T\hat\xi + \varpi^T\varpi", "proved", origin="ours", scope=ALL_SIGNALS)
def basis_bounded() -> Goal:
    """Term by term."""
    sizes = over_basis(xi_hat**2) + over_basis(varpi**2)
    return Goal((at_most(2 * failure_hat, sizes), at_least(2 * failure_hat, -sizes)))


@paper.claim("47.signal.mended", "nu_0 is bounded with x_m'' and the basis signals", "implication",
             r"\nu_0^2 \le 3(RP + C + RW)\ \text{for}\ \hat\rho_{k\nu}^2, \hat\rho_i^2 \le R,\ (\hat\xi^T\varpi)^2 \le P,\ \nu_c^2 \le C,\ "
             r"w^2 \le W", "proved", origin="ours", mends="47.signal", premises=("35.wanted", "47.basis"), scope=ALL_SIGNALS,
             reading="nu_c stands for nu_di and the nu_sj, w for what rho_hat multiplies.")
def signal_bounded_mended() -> Goal:
    """Three parts, each bounded."""
    return _signal(p_one, P_max, at_most(p_one**2, P_max))


THEOREM = (r"\text{The adaptive failure compensation controller %s applied to the system %s, guarantees that all %s"
           r"closed-loop signals are bounded and the tracking error } e(t) = x_1(t) - x_m(t) \text{ satisfies } "
           r"\lim_{t\to\infty} e(t) = 0")
SQUARE_IN_TIME = "The printed closed loop has a motion along which z_1^2 stays at 1: e(t) does not tend to zero. "
TRACKS = ("Shown for all times after the last failure or change of its constants, from which time counts: V_2, and so every estimation error, z_1, z_2 and "
          "the integral of r_1 z_1^2 + r_2 z_2^2, are at most what V_2 after it allows; V_2 has no jump at a switch, since "
          "estimates and parameters have none (25.switch). The limit is Barbalat's lemma, as for Theorem 1, and takes no bound "
          "of the desired curve. Of all other signals nu_0 is bounded by 47.signal.mended, x_2 by theorem1.bounded. ")


@paper.claim("theorem2", "Theorem 2: the position error tends to zero with failures", "limit",
             THEOREM % ("(42), with the adaptive scheme (27)-(31), (37), (41) and (44)",
                        "(7)-(8) with actuator failures (13)-(15)", "the "), "refuted",
             match="words", severity="result", closed_loop=True, rests_on=("47", "47.finite", "47.signal", "43"), scope=ALL_SIGNALS,
             reading=SQUARE_IN_TIME + "Decided as z_1^2 <= 1/4 from some time on.",
             note="False as printed: " + STEADY_STATE_ERROR % LAWS + "Lengths are in m, times in s, and the train's mass is the unit of mass. It is "
                  "no exception: in 24 runs of this loop, integrated and not certified, that start 0.01 off it in every state the error stays "
                  "within 0.04 of 1 for 40 s; along the motion of theorem2.speed it grows without end. The cause is the sign of (44): with a "
                  "plus there it holds as theorem2.mended states, with one mass in all modes, as in section VIII. The theorem's list of what is "
                  "applied leaves out (43).")
def theorem_2() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return steady_state_error(at_most(z_1**2, epsilon), nu_failed, {epsilon: sp.Rational(1, 4), lambda_0: sp.Integer(1)},
                              *disturbed)


@paper.claim("theorem2.mended", "Theorem 2 with a plus in (44) and one mass in all modes", "implication",
             r"\text{Theorem 2 with } \dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi" + ONE_MASS + BOUNDED, "proved",
             origin="ours", mends="theorem2", severity="result", scope=ALL_SIGNALS, reading=TRACKS, note=REPAIR,
             premises=("45.mended", "40.mended", "46.jump", "25.switch", "filippov", "theorem1.rate", "theorem1.bounded",
                       "47.signal.mended", "barbalat"))
def theorem_2_mended() -> Goal:
    """From what (45) mended and (40) mended show of V_2 alone."""
    return tracks(V_true, paper.shown("45.mended"), paper.shown("40.mended"))

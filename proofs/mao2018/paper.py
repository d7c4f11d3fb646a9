"""mao2018: every claim of sections II to VII, and the stated data of section VIII.

Z. Mao, G. Tao, B. Jiang, X.-G. Yan, Adaptive Actuator Compensation of Position Tracking for High-Speed Trains
with Disturbances, IEEE Transactions on Vehicular Technology 67 (2018) 5706-5717.

Exactly one mode is active at any instant. Where the step is linear in the modes, goals carry sums over all l
of them; elsewhere the active mode has symbols of its own, and the idle ones, whose indicators are zero and
whose estimates therefore rest (25.idle), are gathered in V_idle and in m_idle, the sum of their m_i. That is
every number of modes. Failure terms are sums over every number of basis signals. s is sgn(z_2) as Filippov has
it: s z_2 = |z_2| and |s| <= 1, so that any value in [-1, 1] is met at z_2 = 0. Signs in the printed equations are
taken as the extracted text has them.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less
from workbench.proof.paper import Paper

from .equations import (
    F_35,
    REGRESSORS,
    D_c,
    Delta_b,
    Delta_c,
    F,
    Gamma_d,
    Gamma_k,
    Gamma_m,
    Gamma_xi,
    M,
    a_r,
    alpha_1,
    alpha_rate,
    b_r,
    basis,
    c_r,
    chi_d,
    chis,
    curvature,
    d,
    d_force,
    delta_0,
    drag,
    estimate_laws,
    eta,
    failure_hat,
    g,
    gains,
    hats,
    k_1,
    k_2,
    lambda_0,
    lambda_hat,
    lambda_law,
    lambda_law_true,
    m,
    newton_1,
    nu_damp,
    nu_failed,
    nu_healthy,
    nu_s_sum,
    nu_unknown,
    over_basis,
    r_1,
    r_2,
    rho_0,
    rho_hat,
    rho_k0,
    rho_k_hat,
    rho_k_law,
    rho_k_law_true,
    rho_law,
    rho_law_61,
    rho_law_61_true,
    s,
    signal_60,
    signal_of,
    slope_ramp,
    speed_error,
    t,
    trues,
    varpi,
    vartheta,
    wanted,
    x_1,
    x_2,
    x_m,
    xddot_m,
    xdot_m,
    xi_hat,
    xi_law,
    z_1,
    z_2,
    zeta,
)

paper = Paper("mao2018", " ".join((__doc__ or "").split("\n\n")[1].split()))

ALL_MODES = "every number of modes (term by term under the sum)"
ACTIVE_MODE = "every number of modes: one active, the others at rest"
ALL_SIGNALS = "every number of modes (one active, the others at rest) and of basis signals"

Flow = dict[sp.Expr, sp.Expr]

# --- the train (7)-(10), its errors, the laws and V ---------------------------------------------------------------

mode, motor = sp.symbols("i j", integer=True, positive=True)
mode_count, motor_count = sp.symbols("l n", integer=True, positive=True)


def over_modes(summand: sp.Expr) -> sp.Expr:
    """Sum over the modes i = 1..l."""
    return sp.Sum(summand, (mode, 1, mode_count))


def over_motors(summand: sp.Expr) -> sp.Expr:
    """Sum over the motors j = 1..n."""
    return sp.Sum(summand, (motor, 1, motor_count))


def of_mode(name: str) -> sp.Expr:
    """A quantity of mode i, under a sum over the modes."""
    return sp.IndexedBase(name, real=True)[mode]


NAMES = ("a", "b", "c", "vartheta", "D_o")
V_idle = sp.Symbol("V_idle", nonnegative=True)
resistance = sum((x * chi * by for x, chi, by in zip(trues, chis, REGRESSORS, strict=True)), sp.Integer(0))
V_1 = z_1**2 / 2  # (22)
V_estimates = sum(((x - hat) ** 2 / (2 * gain) for x, hat, gain in zip(trues, hats, gains, strict=True)), sp.Integer(0))


def already(goal: Goal, values: Flow) -> Goal:
    """The goal at an instant at which symbols have these values: false there is false at large.

    A moving one among them must be an exact estimate or z_1 = 0: it enters V_2 by a square that vanishes, so that its
    rate does not matter.
    """
    return Goal(tuple(r.subs(values) for r in goal.show), tuple(r.subs(values) for r in goal.assume),
                {state: rate.xreplace(values) for state, rate in goal.flow.items() if state not in values})


def train(force: sp.Expr) -> Flow:
    """z_1 and z_2 along (7), (8) with (19), (21)."""
    return {z_1: speed_error, z_2: m * force - resistance + d * chi_d - alpha_rate}


# An easy instant: no resistance, its estimates exact, a constant desired speed, sixteen motors of which one failed.
exact: Flow = dict.fromkeys((*trues, *hats, V_idle, xddot_m), sp.Integer(0))
filippov = (equal(s * z_2, sp.Abs(z_2)), at_most(s, 1), at_least(s, -1))
size = sp.Abs(z_2)


# --- section II: the train ----------------------------------------------------------------------------------------

@paper.claim("4", "The train with grade and curve", "identity",
             r"M\ddot x = F - (a_r + b_r\dot x + c_r\dot x^2) - Mg\sin\theta - 0.004DM + d", "proved",
             note="The extracted text has q for g. sin(theta) is written vartheta, as the paper does from (5) on.")
def with_grade_and_curve() -> Goal:
    """(2) and (3) put into (1)."""
    return Goal((equal(newton_1, F - (a_r + b_r * x_2 + c_r * x_2**2) - M * g * vartheta
                       - sp.Rational(4, 1000) * D_c * M + d_force),))


@paper.claim("5", "The train per unit of mass", "identity",
             r"\ddot x = mF - (a + b\dot x + c\dot x^2) - g\vartheta - 0.004D + \bar d", "proved", premises=("4",))
def per_mass() -> Goal:
    """(4) divided by M with m = 1/M, a = a_r/M and so on."""
    stated = F / M - (a_r / M + b_r / M * x_2 + c_r / M * x_2**2) - g * vartheta - curvature * D_c + d_force / M
    return Goal((equal(newton_1 / M, stated),))


ramp = slope_ramp(sp.Rational(1, 4), sp.Integer(800))


def _ramp_goal(*begin: Relation) -> Goal:
    return Goal((less(0, ramp), at_most(ramp, 1)), (*begin, at_most(t, 804)))


@paper.claim("6", "The ramp of section VIII is an indicator as (6) asks", "inequality",
             r"\Psi_{\vartheta 3}(t) = 0.25(t - 800) \in (0, 1]\ \text{for}\ t \in [800, 804]", "refuted",
             correction=lambda: _ramp_goal(greater(t, 800)),
             corrected_statement=r"0.25(t - 800) \in (0, 1]\ \text{for}\ t \in (800, 804]",
             note="Cosmetic: (6) asks for Psi in (0, 1] and in the next sentence for a ramp that starts at 0. No step "
                  "of the proofs needs Psi > 0.")
def ramp_in_range() -> Goal:
    """Positive and at most 1 on the closed interval."""
    return _ramp_goal(at_least(t, 800))


def parameters_of_mode() -> list[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """Parameter, indicator and regressor of a, b, c, vartheta and D in mode i."""
    return [(of_mode(n), of_mode(f"chi_{n}"), by) for n, by in zip(NAMES, REGRESSORS, strict=True)]


m_of, chi_m_of, d_of, chi_d_of = of_mode("m"), of_mode("chi_m"), of_mode("d"), of_mode("chi_d")
acceleration_by_modes = over_modes(m_of * chi_m_of) * F - sum(
    (over_modes(x * chi) * by for x, chi, by in parameters_of_mode()), sp.Integer(0)) + over_modes(d_of * chi_d_of)


@paper.claim("7", "Position and speed", "identity", r"\dot x_1 = x_2", "proved", premises=("5",),
             note="A definition: x_1 = x, x_2 = x'.")
def position_and_speed() -> Goal:
    """The first state's rate is the second."""
    return Goal((equal(D(x_1), x_2),), flow={x_1: x_2})


@paper.claim("8", "The piecewise model", "identity",
             r"\dot x_1 = x_2,\ \dot x_2 = mF - a - bx_2 - cx_2^2 - g\vartheta - 0.004D + \bar d\ \text{with (9), (10)}",
             "proved", premises=("5",), scope=ALL_MODES,
             note="(7) and (8) with the sums (9), (10), gathered mode by mode as (24) uses them. The paper supposes "
                  "that the state is in one region only; that it is in some region at every instant is meant too.")
def by_modes() -> Goal:
    """(8) with (9), (10): the sums are linear in the modes."""
    gathered = over_modes(m_of * chi_m_of * F - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                    sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_1), x_2), equal(D(x_2), gathered)), flow={x_1: x_2, x_2: acceleration_by_modes})


d_most, M_least = sp.symbols("d_max M_min", positive=True)


@paper.claim("10", "A bound of the disturbance per unit of mass is available", "inequality",
             r"|d| \le d_{max},\ M \ge M_{min} \Rightarrow |\bar d| \le \frac{d_{max}}{M_{min}}", "proved")
def disturbance_per_mass() -> Goal:
    """From the bound of d and the mass of the empty train."""
    return Goal((at_most(sp.Abs(d_force) / M, d_most / M_least),),
                (at_most(sp.Abs(d_force), d_most), at_least(M, M_least)))


nu_0 = sp.Symbol("nu_0", real=True)
failed, F_0, F_rho, f_rho, delta_j = (sp.IndexedBase(n, real=True)[motor] for n in (
    "failed", "F_0", "F_rho", "f_rho", "delta"))
healthy_count = over_motors(1 - failed)  # k_nu


@paper.claim("13", "The force with failures", "identity", r"F = \sum_{j=1}^n F_j = k_\nu\nu_0 + \xi^T\varpi", "proved",
             scope="every number of motors, the varying basis signals of a motor gathered in one",
             note="failed_j is 1 for a failed motor and else 0; xi_j must be read as 0 for a healthy motor, and all "
                  "healthy motors get the same nu_0.")
def force_with_failures() -> Goal:
    """(12) with (11) for failed motors and nu_0 for the others; k_nu counts the healthy ones."""
    total = over_motors((1 - failed) * nu_0 + failed * (F_0 + F_rho * f_rho))
    return Goal((equal(total, healthy_count * nu_0 + over_motors(failed * F_0 + failed * F_rho * f_rho)),))


@paper.claim("17", "The force with unparameterizable failures", "identity",
             r"F = k_\nu\nu_0 + \xi^T\varpi + \sum_{j=1}^{n-k_\nu}\bar\delta_j", "proved", premises=("13",),
             scope="every number of motors, the varying basis signals of a motor gathered in one",
             note="The sum up to n - k_nu supposes that failed motors are numbered first.")
def force_with_rest() -> Goal:
    """(12) with (16) for failed motors."""
    total = over_motors((1 - failed) * nu_0 + failed * (F_0 + F_rho * f_rho + delta_j))
    stated = healthy_count * nu_0 + over_motors(failed * F_0 + failed * F_rho * f_rho) + over_motors(failed * delta_j)
    return Goal((equal(total, stated),))


# --- section III: healthy actuators ---------------------------------------------------------------------------------


@paper.claim("20", "Rate of the position error", "identity",
             r"\dot z_1 = \dot x_1 - \dot x_m = z_2 + \alpha_1 - \dot x_m", "proved", premises=("8",))
def position_error_rate() -> Goal:
    """D(z_1) of (18) along (7), with (19)."""
    virtual = sp.Symbol("alpha_1", real=True)
    return Goal((equal(D(x_1 - x_m), x_2 - xdot_m), equal(D(x_1 - x_m), (x_2 - virtual) + virtual - xdot_m)),
                flow={x_1: x_2, x_m: xdot_m})


@paper.claim("23", "Rate of V_1", "identity",
             r"\dot V_1 = z_1(z_2 - r_1z_1 + \dot x_m - \dot x_m) = -r_1z_1^2 + z_1z_2", "proved", premises=("20",))
def v1_rate() -> Goal:
    """D(V_1) along (20), (21)."""
    return Goal((equal(D(V_1), -r_1 * z_1**2 + z_1 * z_2),), flow={z_1: speed_error})


@paper.claim("24", "Rate of z_2", "identity",
             r"\dot z_2 = \sum_i\left(m_i\chi_iF - a_i\chi_i - b_i\chi_ix_2 - c_i\chi_ix_2^2 - g\vartheta_i\chi_i - "
             r"0.004D_i\chi_i + \bar d_i\chi_i\right) - \dot\alpha_1", "proved", premises=("8",), scope=ALL_MODES,
             note="(24), (26) print one chi_i for all indicators. Read as each parameter's own, which (9), (10), the "
                  "laws (27)-(31) and (39) force; one common chi_i would be false while a ramp lasts.")
def speed_error_rate() -> Goal:
    """D(x_2 - alpha_1) along (7), (8) with (9), (10)."""
    stated = over_modes(m_of * chi_m_of * F - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                  sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_2 - alpha_1), stated + r_1 * (x_2 - xdot_m) - xddot_m),),
                flow={x_1: x_2, x_2: acceleration_by_modes, x_m: xdot_m, xdot_m: xddot_m})


V_healthy = V_1 + z_2**2 / 2 + V_estimates + m * (1 / m - rho_hat) ** 2 / (2 * Gamma_m) + V_idle  # (25)


@paper.claim("25", "V_2 is not negative and bounds the errors", "inequality",
             r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved", scope=ACTIVE_MODE)
def lyapunov_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_healthy, z_1**2 / 2 + z_2**2 / 2), at_least(V_healthy, 0)))


chi_m = sp.Symbol("chi_m", nonnegative=True)


@paper.claim("25.idle", "Modes whose indicators are zero add a constant to V_2", "implication",
             r"\chi_{\varrho i} = 0 \Rightarrow \frac{d}{dt}\left[\tfrac12\Gamma_{ai}^{-1}\tilde a_i^2 + \dots + "
             r"\tfrac12\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i^2\right] = 0", "proved", scope="each idle mode",
             note="This lets the claims below gather the idle modes in the constant V_idle.")
def idle_modes() -> Goal:
    """The laws (27)-(31), (37) with all indicators zero."""
    own = V_estimates + m * (1 / m - rho_hat) ** 2 / (2 * Gamma_m)
    laws = {**estimate_laws, rho_hat: -Gamma_m * z_2 * (zeta - eta - r_2 * z_2) * chi_m}
    return Goal((equal(D(own), 0),), tuple(equal(chi, 0) for chi in (*chis, chi_m)), laws)


@paper.claim("25.switch", "V_2 does not jump when the mode switches", "identity",
             r"V_2(T_q^+) = V_2(T_q^-)", "proved", scope=ACTIVE_MODE,
             note="V_2 sums over all modes and contains no indicator, and by (9) the parameters of a mode are "
                  "constants. Section IV says that a_i, b_i, c_i, ... change their values at T_q and calls V_2 "
                  "discontinuous there; they do not, or infinitely many jumps would void the argument.")
def no_jump_at_switches() -> Goal:
    """The derivative of V_2 by every indicator is zero."""
    one = sp.Integer(1)
    return Goal((equal(D(V_healthy), 0),), flow={**dict.fromkeys(chis, one), chi_d: one})


hat_rates = sp.symbols("a_hat_dot b_hat_dot c_hat_dot vartheta_hat_dot D_hat_dot", real=True)
rho_rate, z_2_rate, idle_rate = sp.symbols("rho_hat_dot zdot_2 Vdot_idle", real=True)
rho_part = m / Gamma_m * (1 / m - rho_hat) * -rho_rate
free_laws: Flow = {**dict(zip(hats, hat_rates, strict=True)), rho_hat: rho_rate, V_idle: idle_rate}


@paper.claim("26.a", "Rate of V_2 before the plant is put in", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_1z_2 + z_2\dot z_2 + \sum_i\left(\Gamma_{ai}^{-1}\tilde a_i\dot{\tilde a}_i + "
             r"\dots + \tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i\right)", "proved", premises=("23",),
             scope=ACTIVE_MODE, note="The idle modes' terms stand as the rate of V_idle on both sides.")
def v2_rate_open() -> Goal:
    """D(V_2) with free rates of z_2 and of the estimates."""
    errors = sum(((x - hat) * -rate / gain for x, hat, gain, rate in zip(trues, hats, gains, hat_rates, strict=True)),
                 sp.Integer(0))
    return Goal((equal(D(V_healthy), -r_1 * z_1**2 + z_1 * z_2 + z_2 * z_2_rate + errors + rho_part + idle_rate),),
                flow={z_1: speed_error, z_2: z_2_rate, **free_laws})


def _rate_26(bracket: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> Goal:
    """The second form of (26); bracket(rate of the estimate, Gamma z_2 chi ...) multiplies the estimation error."""
    errors = sum(((x - hat) / gain * bracket(rate, gain * z_2 * chi * by) for x, hat, gain, chi, by, rate in zip(
        trues, hats, gains, chis, REGRESSORS, hat_rates, strict=True)), sp.Integer(0))
    stated = (-r_1 * z_1**2 + z_2 * z_1 + z_2 * (m * F - zeta + d * chi_d) + z_2 * (r_1 * speed_error - xddot_m)
              + errors + rho_part + idle_rate)
    return Goal((equal(D(V_healthy), stated),), tuple(at_most(chi, 1) for chi in (*chis, chi_d)),
                {**train(F), **free_laws})


only_a: Flow = dict.fromkeys((*trues[1:], *hats[1:], V_idle, idle_rate, F, d, rho_rate), sp.Integer(0))


RATE_26 = (r"\dot V_2 = \dots + \sum_i\left(%s\Gamma_{ai}^{-1}\tilde a_i(\dot{%s a}_i %s \Gamma_{ai}z_2\chi_i) + \dots"
           r"\right)")


def _rate_26_claim(part: str, accent: str, bracket: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> None:
    @paper.claim(f"26.{part}", f"Rate of V_2 with the plant, the dotted letters read as {part}s", "identity",
                 RATE_26 % ("", accent, "+"), "refuted", premises=("24", "26.a"), scope=ACTIVE_MODE,
                 correction=lambda: _rate_26(lambda rate, by: -(rate + by)),
                 corrected_statement=RATE_26 % ("-", r"\hat", "+"),
                 note="A sign: the bracket needs a minus in front (hats) or inside (tildes); the extraction leaves "
                      "open which accent is printed, and neither is right. Cosmetic: the laws (27)-(31) make the "
                      "right bracket zero.")
    def rate() -> Goal:
        return already(_rate_26(bracket), only_a)


_rate_26_claim("hat", r"\hat", lambda rate, by: rate + by)
_rate_26_claim("tilde", r"\tilde", lambda rate, by: -rate + by)


def _law_claim(equation: str, i: int, letter: str, law: str) -> None:
    x, hat, gain, chi, by = trues[i], hats[i], gains[i], chis[i], REGRESSORS[i]

    @paper.claim(equation, f"The law of the estimate of {letter} cancels its error in the rate of V_2", "identity",
                 rf"{law} \Rightarrow \frac{{d}}{{dt}}\left[\frac{{\tilde {letter}_i^2}}{{2\Gamma}}\right] - "
                 rf"z_2 \tilde {letter}_i \chi \cdot (\dots) = 0", "proved", premises=("26.a",), scope="each mode")
    def cancels() -> Goal:
        """D of the error's term in V_2 against its term in z_2 z_2'."""
        return Goal((equal(D((x - hat) ** 2 / (2 * gain)) - z_2 * (x - hat) * chi * by, 0),), flow=estimate_laws)


_law_claim("27", 0, "a", r"\dot{\hat a}_i = -\Gamma_{ai}z_2\chi_{ai}")
_law_claim("28", 1, "b", r"\dot{\hat b}_i = -\Gamma_{bi}z_2\chi_{bi}x_2")
_law_claim("29", 2, "c", r"\dot{\hat c}_i = -\Gamma_{ci}z_2\chi_{ci}x_2^2")
_law_claim("30", 3, r"\vartheta", r"\dot{\hat\vartheta}_i = -\Gamma_{\vartheta i}z_2\chi_{\vartheta i}g")
_law_claim("31", 4, "D", r"\dot{\hat D}_i = -0.004\Gamma_{Di}z_2\chi_{Di}")

open_loop: Flow = {**train(F), **estimate_laws, rho_hat: rho_rate}


@paper.claim("33", "Rate of V_2 under the laws (27)-(31)", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\left(\eta + \sum_i(m_i\chi_iF - \zeta_i\chi_i + \bar d_i\chi_i)\right) + "
             r"\sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i", "proved",
             premises=("24", "25.idle", "27", "28", "29", "30", "31"), scope=ACTIVE_MODE,
             note="The display before (32). It does not rest on the misprinted form of (26).")
def v2_rate_laws() -> Goal:
    """D(V_2) along the plant with F free."""
    return Goal((equal(D(V_healthy), -r_1 * z_1**2 + z_2 * (eta + m * F - zeta + d * chi_d) + rho_part),),
                flow=open_loop)


def _rate_34(damped: bool) -> Goal:
    rho = 1 / m
    inner = F - rho * zeta + rho * d * chi_d + rho * eta + (rho * r_2 * z_2 if damped else 0)
    stated = -r_1 * z_1**2 + z_2 * m * inner - (r_2 * z_2**2 if damped else 0) + rho_part
    return Goal((equal(D(V_healthy), stated),), flow=open_loop)


@paper.claim("34.a", "Rate of V_2 with rho_i", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_i\chi_{mi}(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + "
             r"\rho_i\eta) + \sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i", "proved", premises=("33",),
             scope=ACTIVE_MODE,
             note="Uses that the chi_mi are 0 or 1 and sum to 1, and that the other indicators of idle modes are zero.")
def v2_rate_rho() -> Goal:
    """m_i rho_i = 1 in the active mode."""
    return _rate_34(damped=False)


@paper.claim("34", "Rate of V_2 with the damping split off", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_i\chi_{mi}(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + "
             r"\rho_i\eta + \rho_ir_2z_2) - r_2z_2^2 + \sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i",
             "proved", premises=("34.a",), scope=ACTIVE_MODE,
             note="rho_i(t) before r_2 z_2 is the constant rho_i.")
def v2_rate_damped() -> Goal:
    """r_2 z_2^2 added and taken away."""
    return _rate_34(damped=True)


d_0 = sp.Symbol("d_0", positive=True)
healthy: Flow = {**train(F_35), **estimate_laws, rho_hat: rho_law}
disturbed = (at_most(d, d_0), at_least(d, -d_0), at_least(lambda_0, d_0))
within = (at_most(d * chi_d, lambda_0), at_least(d * chi_d, -lambda_0))
decay = -r_1 * z_1**2 - r_2 * z_2**2


@paper.claim("35", "What the controller leaves of (34)", "identity",
             r"z_2m_i(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + \rho_i\eta + \rho_ir_2z_2) = -z_2m_i\tilde\rho_i"
             r"(\zeta_i - \eta - r_2z_2) + z_2m_i\nu_{di}\chi_{\bar di} + z_2\bar d_i\chi_{\bar di}", "proved",
             premises=("34",), scope=ACTIVE_MODE, note="(35) put into (34): an estimation error and the disturbance.")
def controller_in_rate() -> Goal:
    """(35) in the bracket of (34)."""
    inner = F_35 - zeta / m + d * chi_d / m + eta / m + r_2 * z_2 / m
    left = -z_2 * m * (1 / m - rho_hat) * wanted + z_2 * m * nu_healthy * chi_d + z_2 * d * chi_d
    return Goal((equal(z_2 * m * inner, left),), (at_most(chi_d, 1),))


@paper.claim("36", "nu_d outweighs the disturbance", "inequality",
             r"m_i \ge \rho_m^0,\ \lambda_i^0 \ge d_i^0 \ge |\bar d_i| \Rightarrow z_2(m_i\nu_{di} + \bar d_i)\chi_{\bar di} "
             r"\le 0", "proved", premises=("10",), scope=ACTIVE_MODE,
             note="The printed (36) is garbled in the extracted text; read as in 38.a. The text calls rho_m^0 a lower "
                  "bound of m_i, which this needs.")
def disturbance_outweighed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return Goal((at_most(z_2 * (m * nu_healthy + d) * chi_d, 0),),
                (*filippov, *disturbed, at_least(m, rho_0), at_most(chi_d, 1)))


@paper.claim("37", "The law of rho_hat cancels its error in the rate of V_2", "identity",
             r"\dot{\hat\rho}_i = -\Gamma_{mi}z_2(\zeta_i - \eta - r_2z_2)\chi_{mi} \Rightarrow -z_2m_i\tilde\rho_i"
             r"(\zeta_i - \eta - r_2z_2) + \tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i = 0", "proved",
             premises=("34",), scope="each mode, healthy motors",
             note="With failures rho_i is 1/(m_i k_nu) and the weight in V_2 no longer fits: see 37.failures.")
def rho_law_cancels() -> Goal:
    """The error's term of z_2 m_i F against D of its term in V_2."""
    error = 1 / m - rho_hat
    return Goal((equal(-z_2 * m * error * wanted + D(m * error**2 / (2 * Gamma_m)), 0),), flow={rho_hat: rho_law})


@paper.claim("38.a", "Rate of V_2 in closed loop", "identity",
             r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 + \sum_i\left(-\tfrac{m_i}{\rho_m^0}\lambda_i^0|z_2|\chi_{\bar di} + "
             r"z_2\bar d_i\chi_{\bar di}\right)", "proved", premises=("34", "37"), scope=ACTIVE_MODE,
             note="(36) is garbled; read as nu_di = -(lambda_i^0/rho_m^0) sgn(z_2), which the text below it, (38), "
                  "(43) and (50) force.")
def v2_rate_closed() -> Goal:
    """D(V_2) along (7), (8), (27)-(31), (35)-(37)."""
    stated = decay - m / rho_0 * lambda_0 * size * chi_d + z_2 * d * chi_d
    return Goal((equal(D(V_healthy), stated),), filippov, healthy)


@paper.claim("38", "V_2 does not increase: the whole argument in one certificate", "implication",
             r"m_i \ge \rho_m^0,\ \lambda_i^0 \ge d_i^0 \ge |\bar d_i| \Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2",
             "proved", premises=("8", "25.idle"), scope=ACTIVE_MODE,
             note="The checker derives V_2' from (25), the plant and the laws by itself, and re-checks the bound for "
                  "every value that Filippov's sign may take at z_2 = 0.")
def v2_bound() -> Goal:
    """D(V_2) along the closed loop against -r_1 z_1^2 - r_2 z_2^2."""
    return Goal((at_most(D(V_healthy), decay),), (*filippov, *disturbed, at_least(m, rho_0)), healthy)


theta_, rate_one, rate_two, most = sp.symbols("theta Vdot_1 Vdot_2 most", real=True)


@paper.claim("38.filippov", "A convex combination of two modes obeys (38) too", "inequality",
             r"\dot V_2^{(1)}, \dot V_2^{(2)} \le w \Rightarrow \theta\dot V_2^{(1)} + (1-\theta)\dot V_2^{(2)} \le w",
             "proved", premises=("38",),
             note="Filippov solutions may slide along the border of two regions of (6), where the velocity is a convex "
                  "combination of theirs. V_2 is smooth and the same for all modes, so its rate is the same "
                  "combination.")
def sliding_between_modes() -> Goal:
    """The rate of V_2 is linear in the velocity."""
    return Goal((at_most(theta_ * rate_one + (1 - theta_) * rate_two, most),),
                (at_least(theta_, 0), at_most(theta_, 1), at_most(rate_one, most), at_most(rate_two, most)))


paper.axiom("filippov", "Solutions exist and V_2 decreases along them",
            r"\text{a Filippov solution exists, and}\ \dot V_2 \in \{\nabla V_2^T f : f \in \text{the convex hull}\}",
            "Filippov 1988; Shevitz and Paden 1994 (the paper's [25], [26])", hypotheses=("38", "38.filippov"))

J, V_t, w_t, V_0 = sp.symbols("J V_t w V_0", real=True)
B, v_most = sp.symbols("B v_max", nonnegative=True)


def _square_integrable() -> Goal:
    """r_1 int z_1^2 + r_2 int z_2^2 <= V(0) for every V >= 0 with V' <= -r_1 z_1^2 - r_2 z_2^2."""
    return Goal((at_most(J, V_0), at_most(V_t + J, V_0)), (at_least(V_t, 0),), {t: sp.Integer(1), V_t: w_t, J: -decay},
                (at_most(w_t, decay),), {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0)},
                decreasing=J + V_t)


@paper.claim("theorem1.integral", "The errors are square integrable", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 \Rightarrow \int_0^t (r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)", "proved",
             premises=("38", "25", "25.switch", "filippov"))
def errors_square_integrable() -> Goal:
    """J + V does not increase, where J is the integral."""
    return _square_integrable()


bounded_errors = (at_most(z_1**2, 2 * B), at_most(z_2**2, 2 * B))


@paper.claim("theorem1.bounded", "Position and speed are bounded", "implication",
             r"V_2 \le B,\ |\dot x_m| \le v_{max} \Rightarrow z_1^2, z_2^2 \le 2B,\ x_2^2 \le 6B(1 + r_1^2) + 3v_{max}^2",
             "proved", premises=("38", "25"),
             note="It takes a bounded desired speed (and, for F, a bounded desired acceleration), which the paper "
                  "supposes silently.")
def speed_bounded() -> Goal:
    """x_2 = z_2 - r_1 z_1 + x_m', each part bounded."""
    return Goal((at_most((speed_error + xdot_m) ** 2, 6 * B * (1 + r_1**2) + 3 * v_most**2),),
                (*bounded_errors, at_most(xdot_m**2, v_most**2)))


@paper.claim("theorem1.rate", "The rate of z_1 is bounded", "implication",
             r"V_2 \le B \Rightarrow \dot z_1^2 \le 4B(1 + r_1^2)", "proved", premises=("20", "theorem1.bounded"))
def z1_rate_bounded() -> Goal:
    """z_1' = z_2 - r_1 z_1."""
    return Goal((at_most(D(z_1) ** 2, 4 * B * (1 + r_1**2)),), bounded_errors, {z_1: speed_error})


paper.axiom("theorem1", "The position error tends to zero",
            r"\int_0^\infty z_1^2\,d\tau < \infty,\ |\dot z_1| \le \text{const} \Rightarrow \lim_{t\to\infty} z_1 = 0",
            "Barbalat's lemma", hypotheses=("theorem1.integral", "theorem1.rate", "filippov"),
            note="Theorem 1 stands: no step before it that it rests on is false.")


@paper.claim("theorem1.z2", "z_2 in closed loop, and its bounded rate", "implication",
             r"\dot z_2 = -z_1 - r_2z_2 - \tilde a_i\chi_{ai} - \dots - m_i\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
             r"m_i\nu_{di}\chi_{\bar di} + \bar d_i\chi_{\bar di}", "proved", premises=("24", "theorem1.bounded"),
             scope=ACTIVE_MODE,
             note="Every term on the right is bounded when V_2, the desired speed and the desired acceleration are. "
                  "With z_2 square integrable, Barbalat's lemma gives z_2 -> 0 as the paper says.")
def z2_closed() -> Goal:
    """D(z_2) along the closed loop."""
    errors = sum(((x - hat) * chi * by for x, hat, chi, by in zip(trues, hats, chis, REGRESSORS, strict=True)),
                 sp.Integer(0))
    stated = -z_1 - r_2 * z_2 - errors - m * (1 / m - rho_hat) * wanted + m * nu_healthy * chi_d + d * chi_d
    return Goal((equal(D(z_2), stated),), flow=healthy)


@paper.claim("theorem1.speed", "The speed tracks too", "limit",
             r"z_1, z_2 \to 0 \Rightarrow x_2 - \dot x_m \to 0", "proved", premises=("theorem1", "theorem1.z2"),
             note="Decided as a bound: (x_2 - x_m')^2 is at most 2 z_2^2 + 2 r_1^2 z_1^2.")
def speed_tracks() -> Goal:
    """x_2 - x_m' = z_2 + alpha_1 - x_m'."""
    difference = x_2 - xdot_m
    inside = (equal(z_1, x_1 - x_m), equal(z_2, x_2 - alpha_1))
    return Goal((at_most(difference**2, 2 * z_2**2 + 2 * r_1**2 * z_1**2),), inside)


# --- section IV: parameterizable failures ---------------------------------------------------------------------------

k_v = sp.Symbol("k_v", positive=True)
m_idle = sp.Symbol("m_idle", nonnegative=True)
rho_k_rate = sp.Symbol("rho_k_hat_dot", real=True)
xi = sp.IndexedBase("xi", real=True)[basis]
failure = over_basis(xi * varpi)
rho_i, rho_k = 1 / (m * k_v), 1 / k_v
m_all = m + m_idle  # the sum of all m_i
one_failed: Flow = {k_v: sp.Integer(15), m_idle: m * 3}  # 15 healthy motors, four modes of one mass (section VIII)
stopped: Flow = dict.fromkeys((failure, failure_hat, over_basis((xi - xi_hat) ** 2), xi_hat), sp.Integer(0))
unit_gains: Flow = {**dict.fromkeys((r_1, r_2, Gamma_k, Gamma_xi, Gamma_m, m, lambda_0, d_0, chi_d), sp.Integer(1)),
                    d: sp.Integer(0), z_1: sp.Integer(0), rho_0: sp.Integer(15), rho_hat: sp.Rational(1, 15)}


def failed_train(signal: sp.Expr) -> Flow:
    """(39): z_1 and z_2 with the force (13) that nu_0 = signal makes."""
    return train(k_v * signal + failure)


def lyapunov(of_k: sp.Expr, of_xi: sp.Expr, of_rho: sp.Expr) -> sp.Expr:
    """V_1 + z_2^2/2 and the squared errors, those of rho_knu, xi and rho_i with the weights given."""
    return (V_1 + z_2**2 / 2 + of_k * (rho_k - rho_k_hat) ** 2 / (2 * Gamma_k)
            + of_xi * over_basis((xi - xi_hat) ** 2) / (2 * Gamma_xi) + V_estimates
            + of_rho * (rho_i - rho_hat) ** 2 / (2 * Gamma_m) + V_idle)


V_40 = lyapunov(m_all, m_all, m)
V_true = lyapunov(m * k_v, m, m * k_v)  # with the weights that fit
laws_printed: Flow = {**estimate_laws, **xi_law, rho_k_hat: rho_k_law, rho_hat: rho_law}
laws_true: Flow = {**laws_printed, rho_k_hat: rho_k_law_true}


REPAIR = ("Repaired: (44) with a plus; in V_2 the weight m_i k_nu for rho_knu and rho_i, and no sum over the modes "
          "for rho_knu and xi, which takes either one mass in all modes or estimates of xi and rho_knu for each mode "
          "that rest while it is idle. ")


@paper.claim("39", "Rate of z_2 with failures", "identity",
             r"\dot z_2 = \sum_i\left(m_i\chi_{mi}(k_\nu\nu_0 + \xi^T\varpi) - a_i\chi_{ai} - \dots + \bar d_i\chi_{\bar di}"
             r"\right) - \dot\alpha_1", "proved", premises=("13", "24"), scope=ALL_MODES)
def speed_error_rate_failed() -> Goal:
    """(24) with (13); xi^T varpi is one number here."""
    force = k_v * nu_0 + sp.Symbol("xi_varpi", real=True)
    stated = over_modes(m_of * chi_m_of * force - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                      sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_2 - alpha_1), stated + r_1 * (x_2 - xdot_m) - xddot_m),),
                flow={x_1: x_2, x_2: acceleration_by_modes.xreplace({F: force}), x_m: xdot_m, xdot_m: xddot_m})


@paper.claim("40", "V_2 bounds the errors", "inequality", r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved",
             scope=ALL_SIGNALS)
def failure_lyapunov_not_negative() -> Goal:
    """Squares with positive weights, as printed and with the weights that fit."""
    return Goal(tuple(at_least(V, z_1**2 / 2 + z_2**2 / 2) for V in (V_40, V_true)))


def _rate_41(of_k: sp.Expr, of_xi: sp.Expr) -> Goal:
    inner = (nu_0 + rho_k * failure_hat - rho_i * zeta + rho_i * d * chi_d + rho_i * eta + rho_i * r_2 * z_2)
    stated = (-r_1 * z_1**2 + z_2 * m * k_v * inner - r_2 * z_2**2 - of_k / Gamma_k * (rho_k - rho_k_hat) * rho_k_rate
              - m / Gamma_m * (rho_i - rho_hat) * rho_rate)
    return Goal((equal(D(lyapunov(of_k, of_xi, m)), stated),), (),
                {**failed_train(nu_0), **estimate_laws, **xi_law, rho_k_hat: rho_k_rate, rho_hat: rho_rate})


RATE_41 = (r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_ik_\nu\chi_{mi}(\nu_0 + \rho_{k\nu}\hat\xi^T\varpi - \rho_i\zeta_i + \dots)"
           r" - r_2z_2^2 + \sum_i\tfrac{m_i}{\Gamma_{k\nu}}\tilde\rho_{k\nu}\dot{\tilde\rho}_{k\nu} + "
           r"\sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i")


@paper.claim("41", "Rate of V_2 under the laws (27)-(31), (41)", "identity", RATE_41, "refuted",
             premises=("39", "25.idle"), scope=ALL_SIGNALS, correction=lambda: _rate_41(m, m),
             corrected_statement=r"\dot V_2 = \dots\ \text{if}\ V_2\ \text{has}\ m_i\ \text{of one mode instead of}\ "
                                 r"\textstyle\sum_im_i\ \text{before}\ \tilde\rho_{k\nu}^2\ \text{and}\ \tilde\xi^T\tilde\xi",
             note="The display before (42). (40) weighs the error of xi with the sum of all m_i, the train with the "
                  "m_i of the active mode, so a term -(sum of the idle m_i) z_2 xi_tilde^T varpi is left over. True "
                  "for l = 1. With equal masses, as in section VIII, one m in V_2 mends it; with different masses "
                  "each mode needs its own estimates of xi and rho_knu.")
def v2_rate_failed() -> Goal:
    """D(V_2) of (40) along (39) with nu_0 and the rates of rho_hat and rho_knu_hat free."""
    return already(_rate_41(m_all, m_all), exact | one_failed)


def _law_44(weight: sp.Expr, sign: int) -> Goal:
    error = rho_k - rho_k_hat
    return Goal((equal(z_2 * m * k_v * error * failure_hat + D(weight * error**2 / (2 * Gamma_k)), 0),),
                flow={rho_k_hat: sign * rho_k_law})


LAW_44 = (r"\dot{\hat\rho}_{k\nu} = %s\Gamma_{k\nu}z_2\hat\xi^T\varpi \Rightarrow z_2m_ik_\nu\tilde\rho_{k\nu}\hat\xi^T\varpi "
          r"+ \tfrac{%s}{\Gamma_{k\nu}}\tilde\rho_{k\nu}\dot{\tilde\rho}_{k\nu} = 0")


def _left_by(signal: sp.Expr, compensation: sp.Expr, *more: sp.Expr) -> Goal:
    """A controller in the bracket of the display before (42): estimation errors, compensation and what is more."""
    inner = signal + rho_k * failure_hat + rho_i * (d * chi_d - wanted)
    left = (rho_k - rho_k_hat) * failure_hat - (rho_i - rho_hat) * wanted + compensation + rho_i * d * chi_d
    return Goal((equal(z_2 * m * k_v * inner, z_2 * m * k_v * sp.Add(left, *more)),), (at_most(chi_d, 1),))


LEFT = (r"z_2m_ik_\nu(\nu_0 + \rho_{k\nu}\hat\xi^T\varpi - \rho_i\zeta_i + \dots) = z_2m_ik_\nu(\tilde\rho_{k\nu}\hat\xi^T"
        r"\varpi - \tilde\rho_i(\zeta_i - \eta - r_2z_2) + %s + \rho_i\bar d_i\chi_{\bar di})")


@paper.claim("42", "What the controller leaves of the rate of V_2", "identity", LEFT % r"\nu_{di}", "proved",
             premises=("39",), scope=ALL_SIGNALS, note="(42) put into the display before it.")
def failure_controller_in_rate() -> Goal:
    """(42) in the bracket of V_2'."""
    return _left_by(signal_of(nu_failed), nu_failed)


def _outweighed(compensation: sp.Expr, *assume: Relation) -> Goal:
    return Goal((at_most(z_2 * (m * k_v * compensation + d * chi_d), 0),),
                (*filippov, at_most(chi_d, 1), at_least(m * k_v, rho_0), *assume), lemmas=within)


OUTWEIGHED = r"m_ik_\nu \ge \rho_i^0,\ %s \Rightarrow z_2(m_ik_\nu\nu_{di} + \bar d_i\chi_{\bar di}) \le 0"


@paper.claim("43", "nu_d outweighs the disturbance with failures too", "inequality",
             OUTWEIGHED % r"\lambda_i^0 \ge d_i^0 \ge |\bar d_i|", "proved", premises=("10",), scope=ACTIVE_MODE,
             note="rho_i^0 bounds m_i k_nu from below, as the inequality in the text says (its words say m_i).")
def disturbance_outweighed_failed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return _outweighed(nu_failed, *disturbed)


@paper.claim("44", "The law of rho_knu_hat cancels its error in the rate of V_2", "identity", LAW_44 % ("-", "m_i"),
             "refuted", premises=("41",), scope=ALL_SIGNALS, correction=lambda: _law_44(m * k_v, -1),
             corrected_statement=LAW_44 % ("", "m_ik_\\nu"),
             note="The sign is wrong: the two terms add up to (k_nu + 1) m_i z_2 rho_tilde xi_hat^T varpi, and no "
                  "positive weight in V_2 makes them cancel. (44) drives the estimate the wrong way; see theorem2 for "
                  "what it does. Taken for l = 1, so that 41 plays no part. Should the page show a plus, theorem2 and "
                  "45 hold but for the weights.")
def rho_k_law_cancels() -> Goal:
    """The error's term of z_2 m_i k_nu nu_0 against D of its term in (40)."""
    return already(_law_44(m, 1), one_failed)


@paper.claim("44.weight", "With the sign of (44) mended the term cancels in (40)", "identity", LAW_44 % ("", "m_i"),
             "refuted", premises=("44",), scope=ALL_SIGNALS, correction=lambda: _law_44(m * k_v, -1),
             corrected_statement=LAW_44 % ("", "m_ik_\\nu"),
             note="The weight in (40) lacks k_nu: true only for k_nu = 1. Cosmetic, since V_2 is free to choose.")
def rho_k_law_weight() -> Goal:
    """The same with a plus in (44)."""
    return already(_law_44(m, -1), one_failed)


def _law_37(weight: sp.Expr) -> Goal:
    error = rho_i - rho_hat
    return Goal((equal(-z_2 * m * k_v * error * wanted + D(weight * error**2 / (2 * Gamma_m)), 0),),
                flow={rho_hat: rho_law})


@paper.claim("37.failures", "(37) cancels its error with failures too", "identity",
             r"\rho_i = \tfrac{1}{m_ik_\nu}:\ -z_2m_ik_\nu\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
             r"\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i = 0", "refuted", premises=("41",), scope="each mode",
             correction=lambda: _law_37(m * k_v),
             corrected_statement=r"-z_2m_ik_\nu\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
                                 r"\tfrac{m_ik_\nu}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i = 0",
             note="The weight in (40) lacks k_nu. Cosmetic: V_2 with m_i k_nu mends it, the law stands.")
def rho_law_failed() -> Goal:
    """The error's term of z_2 m_i k_nu nu_0 against D of its term in (40)."""
    return already(_law_37(m), exact | one_failed)


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


# --- a closed loop in which the error stays at 1 m for ever -----------------------------------------------------------

Xi, Xi_hat = sp.symbols("Xi Xi_hat", real=True)
n_b, epsilon = sp.symbols("n_b epsilon", positive=True)
sign_of_z_2 = (at_most(z_2, s * z_2), at_most(-z_2, s * z_2))  # with |s| <= 1: s z_2 = |z_2|


def _standing_error(show: Relation, compensation: sp.Expr, constants: Flow, *assume: Relation,
                    extra_force: sp.Expr | None = None, lambda_law: sp.Expr | None = None, damped: bool = False) -> Goal:
    """The closed loop as printed, with every failure constant, and a motion along it with z_1 = z_2 = 1 for ever.

    varpi is 1 for each of n_b = 16 motors, Xi = xi^T varpi and Xi_hat = xi_hat^T varpi. The estimates that integrate
    z_2 grow with t; what (44) makes of rho_knu_hat Xi_hat grows as fast as rho_hat (zeta - eta - r_2 z_2), against it.
    """
    signal = signal_of(compensation) + (rho_hat * nu_damp if damped else 0)
    rates: Flow = {**failed_train(signal), **estimate_laws, rho_k_hat: rho_k_law,
                   rho_hat: rho_law_61 if damped else rho_law, Xi_hat: n_b * Gamma_xi * z_2}
    rates[z_2] += m * (extra_force or 0) - (Delta_b * x_2 + Delta_c * x_2**2 if damped else 0)
    if lambda_law is not None:
        rates[lambda_hat] = lambda_law
    rates = {state: rate.xreplace({failure: Xi, failure_hat: Xi_hat}) for state, rate in rates.items()}
    dots = {state: sp.Symbol(f"{state}_dot", real=True) for state in rates}
    one, zero = sp.Integer(1), sp.Integer(0)
    fixed: Flow = {**dict.fromkeys((*trues, d, xddot_m), zero), **dict.fromkeys(
        (*chis, *gains, r_1, r_2, m, x_2, xdot_m, Gamma_xi, Gamma_k, Gamma_m, s, chi_d, d_0), one),
        g: sp.Rational(981, 100), n_b: sp.Integer(16), k_v: sp.Integer(15), rho_0: sp.Integer(15),
        gains[0]: sp.Integer(12), gains[3]: sp.Rational(100, 981) ** 2, gains[4]: sp.Integer(250) ** 2, **constants}
    damping = (k_1 + k_2).xreplace(fixed) if damped else zero
    motion: Flow = {z_1: one, z_2: one, Xi_hat: 16 * t + 4 * damping / 3, rho_k_hat: -8 * t**2 - 4 * damping * t / 3,
                    rho_hat: 8 * t**2 + 2 * damping * t / 3}
    motion |= {hat: rate.xreplace({z_2: one}).xreplace(fixed) * t for hat, rate in estimate_laws.items()}
    motion[hats[0]] += 2 - 5 * damping / 3
    if lambda_law is not None:
        motion |= {lambda_hat: 1 - 16 * t, rho_k_hat: sp.Rational(1, 15) - 8 * t**2}
    fixed[Xi] = sp.expand(-rates[z_2].xreplace(motion).xreplace(fixed).xreplace({Xi: zero}))
    always = (*(equal(dots[state], rate) for state, rate in rates.items()), equal(x_2, speed_error + xdot_m), *sign_of_z_2)
    used = {symbol for relation in (show, *assume, *always) for side in (relation.left, relation.right)
            for symbol in side.free_symbols}
    return Goal((show,), (at_most(s, 1), at_least(s, -1), at_least(m * k_v, rho_0), *assume), {t: one, **dots}, always,
                eventually=t, model={**{x: value for x, value in fixed.items() if x in used}, **motion})


STANDING = ("a closed loop with (27)-(31), (37), (41), (44) as printed in which z_1 = z_2 = 1 for all t >= 0: one mode, 16 "
            "motors of which one has failed with a constant force, a constant desired speed, no disturbance. "
            "xi_hat grows like t, rho_knu_hat and rho_hat like t^2, and they hold the error up. The motion is exact but "
            "does not attract: runs that start beside it leave it. ")


@paper.claim("47", "After the last failure V_2 stays finite and the errors are square integrable", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 \le 0 \Rightarrow V_2(t) + "
             r"\int_{T_{\bar M}}^t (r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(T_{\bar M})", "proved",
             premises=("40", "45", "46", "25.switch", "filippov"), scope=ALL_SIGNALS,
             note="Time counts from T_M here. 'z_1 in L_2 and so lim z_1 = 0' needs the bounded rate of z_1 too, which "
                  "section III gives.")
def finite_after_failures() -> Goal:
    """J + V does not increase, where J is the integral."""
    return _square_integrable()


@paper.claim("theorem2", "The position error tends to zero with failures", "limit",
             r"\lim_{t\to\infty}(x_1 - x_m) = 0\ \text{under (27)-(31), (37), (41)-(44)}", "gap", premises=("45", "47"),
             scope=ALL_SIGNALS, correction=_square_integrable,
             corrected_statement=r"\text{with 45 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0),\ \text{so}\ "
                                 r"z_1 \to 0\ \text{as in Theorem 1}",
             note="False as printed: " + STANDING + "The cause is the sign of (44); with it mended (45) holds when all "
                  "modes have one mass, as in section VIII, and Theorem 2 with it.")
def theorem_2() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return _standing_error(at_most(z_1**2, epsilon), nu_failed, {epsilon: sp.Rational(1, 4), lambda_0: sp.Integer(1)},
                           *disturbed)


# --- section V: unparameterizable failures ----------------------------------------------------------------------------

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
    return _left_by(signal_of(nu_failed + nu_s_sum), nu_failed, nu_s_sum)


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
    return _outweighed(nu_failed, *disturbed)


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
             premises=("45", "51", "52"), scope=ALL_SIGNALS, correction=_square_integrable,
             corrected_statement=r"\text{with 45 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)",
             note="False as printed: " + STANDING + "The bound delta_j^0 is 1, delta_j is 0. Mended as 45 is, 51 "
                  "holds, and Theorem 3 with it.")
def theorem_3() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    one = sp.Integer(1)
    return _standing_error(at_most(z_1**2, epsilon), nu_failed + nu_s_sum,
                           {epsilon: sp.Rational(1, 4), lambda_0: one, delta: sp.Integer(0), delta_0: one,
                            rho_k0: sp.Integer(15)}, *disturbed, *rest_bounds, extra_force=delta)


# --- section VI: unknown bounds of the disturbance --------------------------------------------------------------------

V_53 = V_true + (lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)
bounded_by_unknown = (at_most(d, lambda_0), at_least(d, -lambda_0))


@paper.claim("53", "V_2 bounds the errors", "inequality", r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved",
             premises=("40",), scope=ALL_SIGNALS)
def unknown_bound_lyapunov_not_negative() -> Goal:
    """(40) and one more square, as printed and with the weights that fit."""
    more = (lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)
    return Goal(tuple(at_least(V, z_1**2 / 2 + z_2**2 / 2) for V in (V_40 + more, V_53)))


def _law_54(law: sp.Expr) -> Goal:
    error = lambda_0 - lambda_hat
    return Goal((at_most(D(error**2 / (2 * Gamma_d)) + error * size * chi_d, 0),), (*filippov, at_most(chi_d, 1)),
                {lambda_hat: law})


@paper.claim("54", "The law of lambda_hat cancels its error in the rate of V_2", "inequality",
             r"\dot{\hat\lambda}_i^0 = -\Gamma_{di}z_2\,\mathrm{sgn}(z_2)\chi_{\bar di} \Rightarrow \tilde\lambda_i^0|z_2|"
             r"\chi_{\bar di} + \Gamma_{di}^{-1}\tilde\lambda_i^0\dot{\tilde\lambda}_i^0 \le 0", "refuted",
             scope="each mode", correction=lambda: _law_54(lambda_law_true),
             corrected_statement=r"\dot{\hat\lambda}_i^0 = \Gamma_{di}z_2\,\mathrm{sgn}(z_2)\chi_{\bar di} \Rightarrow "
                                 r"\tilde\lambda_i^0|z_2|\chi_{\bar di} + \Gamma_{di}^{-1}\tilde\lambda_i^0"
                                 r"\dot{\tilde\lambda}_i^0 = 0",
             note="The sign of (54) is wrong: the estimate of the bound can only fall, where the disturbance needs it "
                  "to grow, and once it is negative (56) pushes away from z_2 = 0. (57) is what the opposite sign "
                  "gives.")
def lambda_law_cancels() -> Goal:
    """The estimation error's part of z_2 (d + m_i k_nu nu_d) against D of its term in (53)."""
    return _law_54(lambda_law)


def _terms_57(law: sp.Expr, coefficient: sp.Expr) -> Goal:
    true = (m * k_v * z_2 * nu_unknown + z_2 * d * chi_d + D((lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)))
    stated = (-coefficient / rho_0 * lambda_hat * size * chi_d + lambda_hat * size * chi_d - size * lambda_0 * chi_d
              + z_2 * d * chi_d)
    return Goal((equal(true, stated),), (*filippov, at_most(chi_d, 1)), {lambda_hat: law})


TERMS_57 = (r"\dot V_2 + r_1z_1^2 + r_2z_2^2 = \sum_i\left(-\tfrac{%s}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - "
            r"|z_2|\lambda_i^0 + z_2\bar d_i\right)\chi_{\bar di}%s")


@paper.claim("57.a", "The terms of the unknown bound in the rate of V_2", "identity", TERMS_57 % ("m_i", ""), "refuted",
             premises=("45.a", "54"), scope="one active mode", correction=lambda: _terms_57(lambda_law_true, m * k_v),
             corrected_statement=TERMS_57 % (r"m_ik_\nu", r"\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{di}|z_2|\chi_{\bar di}"),
             note="With (54) as printed the two middle terms have the opposite sign; the first also lacks k_nu. All "
                  "that 45.a finds wrong is left out here.")
def unknown_bound_terms() -> Goal:
    """z_2 m_i k_nu nu_d + z_2 d_i chi_di and D of the last term of (53)."""
    return already(_terms_57(lambda_law, m), {k_v: sp.Integer(15), m: sp.Integer(1)})


def _terms_bound(*assume: Relation) -> Goal:
    stated = (-m / rho_0 * lambda_hat * size + lambda_hat * size - size * lambda_0 + z_2 * d) * chi_d
    return Goal((at_most(stated, 0),), (*bounded_by_unknown, at_least(m, rho_0), at_most(chi_d, 1), *assume))


@paper.claim("57.b", "The bound drawn in (57)", "inequality",
             r"\sum_i\left(-\tfrac{m_i}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - |z_2|\lambda_i^0 + z_2\bar d_i"
             r"\right)\chi_{\bar di} \le 0", "refuted", scope="one active mode",
             correction=lambda: _terms_bound(at_least(lambda_hat, 0)),
             corrected_statement=r"\hat\lambda_i^0 \ge 0 \Rightarrow \dots \le 0",
             note="It needs lambda_hat >= 0, because m_i/rho_m^0 may exceed 1. That is nowhere asked for; the "
                  "corrected law keeps it (54.sign) when lambda_hat(0) >= 0.")
def unknown_bound_step() -> Goal:
    """The printed terms, with the coefficient m_i/rho_m^0 >= 1 as printed."""
    return _terms_bound()


lambda_start = sp.Symbol("lambda_hat_0", nonnegative=True)


@paper.claim("55", "What the controller leaves of the rate of V_2", "identity", LEFT % r"\nu_{di}", "proved",
             premises=("42",), scope=ALL_SIGNALS, note="(55) is (42) with the nu_di of (56).")
def unknown_bound_controller_in_rate() -> Goal:
    """(55) in the bracket of V_2'."""
    return _left_by(signal_of(nu_unknown), nu_unknown)


@paper.claim("56", "nu_d outweighs the disturbance once the estimate reaches its bound", "inequality",
             OUTWEIGHED % r"\hat\lambda_i^0 \ge |\bar d_i|", "proved", scope=ACTIVE_MODE,
             note="rho_m^0 in (56) is read as the rho_i^0 of the next line. Nothing makes the estimate reach the bound, "
                  "and with (54) as printed it never rises: see 54.")
def estimated_bound_outweighs() -> Goal:
    """With an estimate that is no smaller than the disturbance."""
    return Goal((at_most(z_2 * (m * k_v * nu_unknown + d * chi_d), 0),),
                (*filippov, at_most(chi_d, 1), at_least(m * k_v, rho_0), at_most(d, lambda_hat),
                 at_least(d, -lambda_hat)), lemmas=(at_least(lambda_hat, 0),))


@paper.claim("54.sign", "The corrected law keeps lambda_hat from falling", "implication",
             r"\dot{\hat\lambda}_i^0 = \Gamma_{di}|z_2|\chi_{\bar di},\ \hat\lambda_i^0(0) \ge 0 \Rightarrow "
             r"\hat\lambda_i^0(t) \ge 0", "proved", scope="each mode",
             note="A helper for 57, not printed.")
def lambda_not_negative() -> Goal:
    """-lambda_hat does not increase."""
    drift = sp.Symbol("lambda_hat_dot", real=True)
    return Goal((at_least(lambda_hat, 0),), (), {t: sp.Integer(1), lambda_hat: drift}, (at_least(drift, 0),),
                {t: sp.Integer(0), lambda_hat: lambda_start}, decreasing=-lambda_hat)


def _bound_57(repaired: bool) -> Goal:
    law = lambda_law_true if repaired else lambda_law
    flow = {**failed_train(signal_of(nu_unknown)), **laws_true, lambda_hat: law}
    return Goal((at_most(D(V_53), decay),),
                (*filippov, *bounded_by_unknown, at_least(m * k_v, rho_0), at_least(lambda_hat, 0)), flow)


@paper.claim("57", "V_2 does not increase with unknown bounds: the whole argument", "implication",
             r"\lambda_i^0 \ge |\bar d_i|,\ m_ik_\nu \ge \rho_i^0,\ \hat\lambda_i^0 \ge 0 \Rightarrow \dot V_2 \le -r_1z_1^2 - "
             r"r_2z_2^2", "gap", premises=("39", "45", "25.idle"), scope=ALL_SIGNALS,
             correction=lambda: _bound_57(repaired=True),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{di}|z_2|"
                                 r"\chi_{\bar di},\ \hat\lambda_i^0(0) \ge 0",
             note=REPAIR + "All this granted, and lambda_hat >= 0 too, (54) as printed still breaks the bound, and its "
                  "opposite sign mends it.")
def v2_bound_unknown() -> Goal:
    """D(V_2) along (7), (8), (27)-(31), (37), (41), (54)-(56) and (44) repaired."""
    return already(_bound_57(repaired=False), exact | unit_gains | stopped | {
        k_v: sp.Integer(15), rho_k_hat: sp.Rational(1, 15), Gamma_d: sp.Integer(1)})


@paper.claim("theorem4", "The position error tends to zero with unknown bounds", "limit",
             r"\lim_{t\to\infty}(x_1 - x_m) = 0\ \text{under (27)-(31), (37), (41), (44), (54)-(56)}", "gap",
             premises=("57",), scope=ALL_SIGNALS, correction=_square_integrable,
             corrected_statement=r"\text{with 45 and 57 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)",
             note="False as printed: " + STANDING + "rho_knu_hat starts at its true value here, and lambda_hat falls "
                  "from 1 without end. Mended as 45 and 57 are, Theorem 4 holds.")
def theorem_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    one = sp.Integer(1)
    return _standing_error(at_most(z_1**2, epsilon), nu_unknown,
                           {epsilon: sp.Rational(1, 4), lambda_0: one, Gamma_d: sp.Integer(16)}, *disturbed,
                           lambda_law=lambda_law)


delta_hat, Gamma_delta = sp.Symbol("delta_hat", real=True), sp.Symbol("Gamma_delta", positive=True)


@paper.claim("VI.extension", "The scheme, repaired, extends to unparameterizable failures of unknown bound",
             "implication", r"\nu_s = -\tfrac{1}{\rho_{k\nu}^0}\hat\delta^0\mathrm{sgn}(z_2),\ \dot{\hat\delta}^0 = \Gamma_\delta|z_2|,\ "
             r"\hat\delta^0, \hat\lambda^0 \ge 0 \Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2", "proved", premises=("57",),
             scope=ALL_SIGNALS,
             note="'Easily', without equations, in the text below Theorem 4; delta^0 bounds the sum of the delta_j. "
                  "Holds with the signs repaired, V_2 getting the term m_i (delta_tilde^0)^2/(2 Gamma_delta).")
def unknown_failure_bound() -> Goal:
    """(57) repaired, with an estimate of delta^0 too."""
    V = V_53 + m * (delta_0 - delta_hat) ** 2 / (2 * Gamma_delta)
    signal = signal_of(nu_unknown - delta_hat * s / rho_k0) + delta / k_v
    flow = {**failed_train(signal), **laws_true, lambda_hat: lambda_law_true, delta_hat: Gamma_delta * z_2 * s}
    return Goal((at_most(D(V), decay),),
                (*filippov, *bounded_by_unknown, *rest_bounds, at_least(m * k_v, rho_0), at_least(lambda_hat, 0),
                 at_least(delta_hat, 0)), flow)


# --- section VII: unparameterizable system parameters -------------------------------------------------------------------

b_0, c_0 = sp.symbols("b_0 c_0", nonnegative=True)
constant = b_0**2 / (4 * k_1) + c_0**2 / (4 * k_2)
uncertain = (at_most(Delta_b, b_0), at_least(Delta_b, -b_0), at_most(Delta_c, c_0), at_least(Delta_c, -c_0))


def uncertain_train(law: sp.Expr) -> Flow:
    """(58)-(60) with (13), (27)-(31), (41), (43), (44) repaired, and the law of rho_hat given."""
    moving = failed_train(signal_60)
    return {**moving, z_2: moving[z_2] - drag, **laws_true, rho_hat: law}


def _law_61(law: sp.Expr) -> Goal:
    error = rho_i - rho_hat
    return Goal((equal(-z_2 * m * k_v * error * (nu_damp + wanted) + D(m * k_v * error**2 / (2 * Gamma_m)), 0),),
                flow={rho_hat: law})


@paper.claim("58", "Position and speed", "identity", r"\dot x_1 = x_2", "proved", premises=("7",), note="(7) again.")
def position_and_speed_again() -> Goal:
    """The first state's rate is the second."""
    return Goal((equal(D(x_1), x_2),), flow={x_1: x_2})


@paper.claim("59", "The train with unparameterizable parameters", "identity",
             r"\dot x_2 = mF - a - (b + \Delta b)x_2 - (c + \Delta c)x_2^2 - g\vartheta - 0.004D + \bar d", "proved",
             premises=("5",), note="(5) with b + Delta_b and c + Delta_c for b and c.")
def uncertain_per_mass() -> Goal:
    """(1) divided by M, with the uncertain coefficients per unit of mass in it."""
    uncertain_newton = newton_1.xreplace({b_r: b_r + M * Delta_b, c_r: c_r + M * Delta_c})
    stated = (F / M - a_r / M - (b_r / M + Delta_b) * x_2 - (c_r / M + Delta_c) * x_2**2 - g * vartheta
              - curvature * D_c + d_force / M)
    return Goal((equal(uncertain_newton / M, stated), equal(newton_1 / M - drag, stated)))


@paper.claim("60", "What the controller leaves of the rate of V_2", "identity",
             LEFT % r"\nu_{di} + \rho_i\nu_\Delta - \tilde\rho_i\nu_\Delta", "proved", premises=("42",),
             scope=ALL_SIGNALS, note="So the law of rho_hat has to cancel nu_Delta + zeta_i - eta - r_2 z_2: see 61.")
def damped_controller_in_rate() -> Goal:
    """(60) in the bracket of V_2'."""
    return _left_by(signal_60, nu_failed, rho_i * nu_damp, -(rho_i - rho_hat) * nu_damp)


@paper.claim("62", "The nonlinear damping damps", "inequality",
             r"z_2\nu_\Delta = -k_1z_2^2x_2^2 - k_2z_2^2x_2^4 \le 0", "proved")
def damping_damps() -> Goal:
    """z_2 times (62)."""
    return Goal((equal(z_2 * nu_damp, -k_1 * z_2**2 * x_2**2 - k_2 * z_2**2 * x_2**4), at_most(z_2 * nu_damp, 0)))


LAW_61 = (r"\dot{\hat\rho}_i = -\gamma_{mi}z_2(%s\nu_\Delta + \zeta_i - \eta - r_2z_2)\chi_{mi} \Rightarrow -z_2m_ik_\nu"
          r"\tilde\rho_i(\nu_\Delta + \zeta_i - \eta - r_2z_2) + \tfrac{m_ik_\nu}{\gamma_{mi}}\tilde\rho_i"
          r"\dot{\tilde\rho}_i = 0")


@paper.claim("61", "The law of rho_hat with nonlinear damping cancels its error", "identity", LAW_61 % "-", "refuted",
             premises=("37.failures",), scope="each mode, all failures", correction=lambda: _law_61(rho_law_61_true),
             corrected_statement=LAW_61 % "",
             note="The sign of nu_Delta in (61) does not fit (60). What is left over multiplies the damping of (64) by "
                  "2 rho_hat/rho_i - 1: it turns into a drive while rho_hat is below half of rho_i. The weight m_i "
                  "k_nu is granted.")
def rho_law_damped() -> Goal:
    """The error's term of z_2 m_i k_nu nu_0 against D of its term in V_2."""
    return already(_law_61(rho_law_61), exact | one_failed)


def _rate_63(damping: sp.Expr) -> Goal:
    stated = decay - m * k_v / rho_0 * lambda_0 * size + z_2 * d * chi_d + damping
    return Goal((equal(D(V_true), stated),), (*filippov, at_most(chi_d, 1)), uncertain_train(rho_law_61_true))


RATE_63 = (r"\dot V_2 = -r_1z_1^2 - r_2z_2^2 + \sum_i\left(-\tfrac{m_ik_\nu}{\rho_i^0}\lambda_i^0|z_2|\chi_i + z_2\bar d_i"
           r"\chi_{\bar di}\right) + %s")


@paper.claim("63", "Rate of V_2 with nonlinear damping", "identity",
             RATE_63 % r"\nu_\Delta - \Delta b\,z_2^2x_2 - \Delta c\,z_2^2x_2^2", "refuted", premises=("45.a", "61"),
             scope=ALL_SIGNALS, correction=lambda: _rate_63(z_2 * (nu_damp - drag)),
             corrected_statement=RATE_63 % r"z_2\nu_\Delta - \Delta b\,z_2x_2 - \Delta c\,z_2x_2^2",
             note="Cosmetic: the powers of z_2 are wrong, and the next display has the right ones. Stated with all "
                  "that 45.a and 61 find wrong repaired.")
def v2_rate_damping() -> Goal:
    """D(V_2) along (58)-(60) repaired."""
    return already(_rate_63(nu_damp - Delta_b * z_2**2 * x_2 - Delta_c * z_2**2 * x_2**2), exact | one_failed | unit_gains)


X, Z = sp.symbols("x_2_size z_2_size", nonnegative=True)
two_terms = -k_1 * Z**2 * X**2 + b_0 * Z * X - k_2 * Z**2 * X**4 + c_0 * Z * X**2  # (64)


@paper.claim("63.bound", "The uncertain resistance against the damping", "inequality",
             r"z_2(\nu_\Delta - \Delta b\,x_2 - \Delta c\,x_2^2) \le -k_1z_2^2x_2^2 + b_0|z_2||x_2| - k_2z_2^2x_2^4 + "
             r"c_0|z_2|x_2^2", "proved",
             note="The display after (63), which has the powers of z_2 right.")
def drag_bound() -> Goal:
    """|Delta_b| <= b_0 and |Delta_c| <= c_0."""
    sizes = tuple(r for x, most in ((x_2, X), (z_2, Z)) for r in (
        at_most(x, most), at_most(-x, most), equal(most**2, x**2)))  # most = |x|
    return Goal((at_most(z_2 * (nu_damp - drag), two_terms),), (*uncertain, *sizes),
                lemmas=(at_most(z_2 * x_2, Z * X), at_least(z_2 * x_2, -Z * X), equal(Z**2 * X**2, z_2**2 * x_2**2),
                        equal(Z**2 * X**4, z_2**2 * x_2**4)))


@paper.claim("64", "The maximum of (64) and where it is attained", "inequality",
             r"-k_1z_2^2x_2^2 + b_0|z_2||x_2| - k_2z_2^2x_2^4 + c_0|z_2|x_2^2 \le \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2},\ "
             r"\text{with equality at}\ |x_2| = \tfrac{k_1c_0}{k_2b_0},\ |z_2| = \tfrac{k_2b_0^2}{2k_1^2c_0}", "proved",
             note="For b_0, c_0 > 0; the stated point divides by both. The bound holds for b_0 = 0 or c_0 = 0 too "
                  "(64.bound).")
def largest_value() -> Goal:
    """Two completed squares, and the value at the stated point."""
    b, c = sp.symbols("b_0 c_0", positive=True)
    value, top = two_terms.xreplace({b_0: b, c_0: c}), constant.xreplace({b_0: b, c_0: c})
    at_point = value.xreplace({X: k_1 * c / (k_2 * b), Z: k_2 * b**2 / (2 * k_1**2 * c)})
    return Goal((at_most(value, top), equal(at_point, top)))


@paper.claim("64.bound", "The bound of (64), for b_0 or c_0 equal to zero too", "inequality",
             r"b_0, c_0 \ge 0:\ \dots \le \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}", "proved")
def largest_value_degenerate() -> Goal:
    """Two completed squares."""
    return Goal((at_most(two_terms, constant),))


def _bound_65(law: sp.Expr) -> Goal:
    damped = z_2 * (nu_damp - drag)
    return Goal((at_most(D(V_true), decay + constant),),
                (*filippov, *disturbed, *uncertain, at_most(chi_d, 1), at_least(m * k_v, rho_0)), uncertain_train(law),
                lemmas=(*within, at_most(Delta_b**2, b_0**2), at_most(Delta_c**2, c_0**2), at_most(damped, constant),
                        at_most(D(V_true), decay + damped)))


@paper.claim("65", "Bound of the rate of V_2 with nonlinear damping: the whole argument", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}", "gap",
             premises=("39", "45", "25.idle"), scope=ALL_SIGNALS, correction=lambda: _bound_65(rho_law_61_true),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}\ \text{with}\ "
                                 r"+\nu_\Delta\ \text{in (61)}",
             note=REPAIR + "All this granted, (61) as printed still breaks the bound, and its opposite sign mends it.")
def v2_bound_damping() -> Goal:
    """D(V_2) along (58)-(61), everything but (61) repaired."""
    rest: Flow = dict.fromkeys((Delta_b, Delta_c, b_0, c_0), sp.Integer(0))
    gains_one = {x: value for x, value in unit_gains.items() if x != rho_hat} | {x_2: sp.Integer(1)}
    return already(_bound_65(rho_law_61), exact | gains_one | rest | stopped | {
        k_v: sp.Integer(15), k_1: sp.Integer(1), k_2: sp.Integer(1), rho_k_hat: sp.Rational(1, 15)})


K = sp.Symbol("K", positive=True)
inequality_65 = at_most(w_t, decay + K)


@paper.claim("65.ball", "Outside the ball of (65) the errors shrink", "implication",
             r"r_1z_1^2 + r_2z_2^2 > \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} \Rightarrow \tfrac{d}{dt}(z_1^2 + z_2^2) < 0", "gap",
             premises=("65",), scope=ALL_SIGNALS,
             note="'V_2' is negative outside some ball, so the solution is uniformly bounded' would need V_2 to be a "
                  "function of z_1 and z_2. It contains the estimation errors, for which (65) has no term: outside "
                  "the ball V_2 falls while z_1^2 + z_2^2 may rise. Shown for the repaired laws.")
def errors_shrink() -> Goal:
    """D(z_1^2 + z_2^2) along (58)-(61) repaired, with an error in the estimate of a alone."""
    values: Flow = {**{x: v for x, v in (exact | unit_gains).items() if x not in (hats[0], z_1)}, k_v: sp.Integer(15),
                    rho_k_hat: sp.Rational(1, 15), **dict.fromkeys((x_2, Delta_b, Delta_c, failure, failure_hat), sp.Integer(0)),
                    **dict.fromkeys((k_1, k_2, b_0, c_0, *chis), sp.Integer(1))}
    flow = uncertain_train(rho_law_61_true)
    return already(Goal((less(D(z_1**2 + z_2**2), 0),), (*filippov, greater(-decay, constant)),
                        {z: flow[z] for z in (z_1, z_2)}), values)


@paper.claim("65.bounded", "(65) makes V_2 bounded", "limit",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + K,\ V_2 \ge \tfrac12(z_1^2 + z_2^2) \Rightarrow V_2\ \text{bounded}", "gap",
             premises=("65",),
             note="Decided as what boundedness would give, V_2 <= t from some time on; V_2 = 1 + 2t with z_1 = z_2 = 0 "
                  "and K = 2 obeys (65). It is a solution of the inequality, not of the closed loop; leakage or "
                  "projection in the adaptive laws, which the paper mentions in section VI, would close this step.")
def damped_bounded() -> Goal:
    """V_2 = 1 + 2 t."""
    always = (inequality_65, at_least(V_t, z_1**2 / 2 + z_2**2 / 2))
    values: Flow = {z_1: sp.Integer(0), z_2: sp.Integer(0), r_1: sp.Integer(1), r_2: sp.Integer(1), K: sp.Integer(2)}
    return Goal((at_most(V_t, t),), (), {t: sp.Integer(1), V_t: w_t}, always, eventually=t,
                model={**values, V_t: 1 + 2 * t})


damped_constants: Flow = {lambda_0: sp.Integer(1), b_0: sp.Integer(1), c_0: sp.Integer(1),
                          Delta_b: sp.Integer(0), Delta_c: sp.Integer(0)}


@paper.claim("theorem5", "All signals are bounded with nonlinear damping", "limit",
             r"\hat\xi^T\varpi\ \text{bounded under (27)-(31), (41), (43), (44), (60)-(62)}", "gap", premises=("65", "65.bounded"),
             scope=ALL_SIGNALS,
             note="False as printed: " + STANDING + "Delta_b = Delta_c = 0 and k_1 = k_2 = 1. Decided as what "
                  "boundedness would give, (xi_hat^T varpi)^2 <= t from some time on. Mended as 45 and 65 are, (65) "
                  "holds, but boundedness of the estimates still does not follow from it (65.bounded).")
def theorem_5() -> Goal:
    """The printed closed loop, with a motion along which xi_hat grows without end."""
    return _standing_error(at_most(Xi_hat**2, t), nu_failed, {**damped_constants, k_1: sp.Integer(1), k_2: sp.Integer(1)},
                           *disturbed, *uncertain, damped=True)


@paper.claim("remark4.constant", "The constant of (65) can be made as small as desired", "implication",
             r"k_1 \ge \tfrac{b_0^2}{2\rho},\ k_2 \ge \tfrac{c_0^2}{2\rho} \Rightarrow \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} "
             r"\le \rho", "proved", note="For every rho > 0; it takes known bounds b_0 and c_0, which section VII lets "
                                         "be unknown.")
def small_constant() -> Goal:
    """Large k_1 and k_2."""
    rho = sp.Symbol("rho", positive=True)
    return Goal((at_most(constant, rho),), (at_least(k_1 * 2 * rho, b_0**2), at_least(k_2 * 2 * rho, c_0**2)))


@paper.claim("remark4.mean", "What (65) says of the errors: a bound of their mean squares", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + K \Rightarrow \tfrac1t\int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le \tfrac{V_2(0)}{t} + K",
             "proved", premises=("65",), note="Not printed; the part of Remark 4 that follows once (65) is repaired.")
def mean_square() -> Goal:
    """J + V - K t does not increase, where J is the integral."""
    return Goal((at_most(J, V_0 + K * t),), (at_least(V_t, 0), at_least(t, 0)),
                {t: sp.Integer(1), V_t: w_t, J: -decay}, (inequality_65,),
                {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0)}, decreasing=J + V_t - K * t)


@paper.claim("remark4", "Large k_1 and k_2 make the tracking errors small", "limit",
             r"k_1, k_2\ \text{large} \Rightarrow z_1^2 \le \epsilon\ \text{from some time on}", "gap",
             premises=("65", "remark4.constant"), scope=ALL_SIGNALS, correction=mean_square,
             corrected_statement=r"\text{with 65 repaired:}\ \tfrac1t\int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le \tfrac{V_2(0)}{t} + "
                                 r"\tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}",
             note="False as printed, shown for k_1 = k_2 = 1000 and the same for all: " + STANDING + "Even with the "
                  "laws repaired (65) bounds the errors in the mean only, not at each instant (65.ball).")
def remark_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return _standing_error(at_most(z_1**2, epsilon), nu_failed,
                           {**damped_constants, epsilon: sp.Rational(1, 4), k_1: sp.Integer(1000), k_2: sp.Integer(1000)},
                           *disturbed, *uncertain, damped=True)


# --- section VIII: the stated data --------------------------------------------------------------------------------------

c_before, c_after, a_stated, a_force = sp.symbols("c_before c_after a_stated a_r", real=True)


def decimal(text: str) -> Fraction:
    """A printed decimal as an exact number."""
    return Fraction(text)


@paper.claim("VIII.ramp", "The indicator of the slope is continuous at 800 s and 804 s", "identity",
             r"0.25(t - 800)|_{800} = 0,\ 0.25(t - 800)|_{804} = 1", "proved", premises=("6",),
             note="Up to 800 s the slope's indicator is zero, and after 804 s it must be 1, which the paper leaves "
                  "unsaid. At 1400 s it falls to zero in a step.")
def ramp_continuous() -> Goal:
    """The ramp's values at its ends."""
    return Goal((equal(ramp.xreplace({t: sp.Integer(800)}), 0),
                 equal(ramp.xreplace({t: sp.Integer(804)}), 1)))


@paper.claim("VIII.continuous", "The parameters of the simulation do not change abruptly", "condition",
             r"c(400^-) = c(400^+)", "violated",
             at={c_before: decimal("1.12e-6"), c_after: decimal("9.12e-6")},
             note="The introduction motivates the indicators by parameters that do not change abruptly. In section "
                  "VIII all but the slope's are 0-1 functions, and c jumps by a factor of eight at the tunnel. No "
                  "proof needs continuity.")
def resistance_continuous() -> Goal:
    """c before and after the tunnel's portal."""
    return Goal((equal(c_before, c_after),))


@paper.claim("VIII.units", "a_1 fits both its unit kN and its definition a = a_r/M", "condition",
             r"a_1 = \frac{a_r}{M},\ a_r = 8.63\cdot10^{-3}\ \mathrm{kN},\ M = 400\ \mathrm{t}", "violated",
             at={a_stated: decimal("8.63e-3"), a_force: decimal("8.63e-3"), M: Fraction(400)},
             repair={a_stated: decimal("8.63e-3"), a_force: decimal("3.452"), M: Fraction(400)},
             note="(9), (10) take a_i per unit of mass (kN/t = m/s^2); section VIII gives the a_i, b_i, c_i that it "
                  "refers to (9), (10) in kN, a rolling resistance of 8.6 N for the whole train. Read as kN/t the "
                  "value is an ordinary one of 3.45 kN.")
def resistance_units() -> Goal:
    """The same number as a force and as a force per mass."""
    return Goal((equal(a_stated, a_force / M),))


@paper.claim("66.transient", "The disturbance of the tunnel is a step", "inequality",
             r"200 - \tfrac1{20} < 200(1 - e^{-10t}) < 200\ \text{for}\ t \ge 400", "proved",
             note="(66) counts t from the start, so that the exponential is over when the tunnel begins; t - 400 may "
                  "have been meant. Within the known bound of 200 either way.")
def transient_is_over() -> Goal:
    """exp(-10 t) is tiny at 400 s."""
    value = 200 * (1 - sp.exp(-10 * t))
    return Goal((greater(value, 200 - sp.Rational(1, 20)), less(value, 200)), (at_least(t, 400),))


b_stated, c_stated, Delta_b_most, Delta_c_most = sp.symbols("b_1 c_1 Delta_b_max Delta_c_max", real=True)


@paper.claim("VIII.case5", "The uncertain parameters of case 5 leave a resistance", "condition",
             r"b_1 \ge \max|\Delta b|,\ c_1 \ge \max|\Delta c|", "violated",
             at={b_stated: decimal("7.295e-6"), c_stated: decimal("1.12e-6"), Delta_b_most: decimal("0.001"),
                 Delta_c_most: decimal("0.001")},
             note="The paper prints no such condition; it is what makes b + Delta_b and c + Delta_c resistances at all "
                  "times. Delta_c is about 900 times c, so that for nearly half of each period the air drives the "
                  "train; at 60 m/s it makes 3.6 in the unit of c v^2, against 0.004 of c v^2 itself.")
def uncertainty_below_resistance() -> Goal:
    """b_1 and c_1 against the amplitudes of Delta_b and Delta_c."""
    return Goal((at_least(b_stated, Delta_b_most), at_least(c_stated, Delta_c_most)))

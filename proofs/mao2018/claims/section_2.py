"""mao2018, section II: the train, its modes and its failures."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less

from ..active_mode import REGRESSORS
from ..error_dynamics import ALL_MODES, NAMES, motor, of_mode, over_modes, over_motors
from ..felt_force import a_t, b_t, c_t, d_bar, m_t
from ..notation import in_time
from ..paper import paper
from ..plant import D_c, F, M, a_r, b_r, c_r, curvature, d_force, g, slope_ramp, t, vartheta, x_1, x_2

v, acceleration = sp.symbols("v acceleration", real=True)  # x' and x''
F_g, F_c = sp.symbols("F_g F_c", real=True)
model_1 = (equal(M * acceleration, F - a_r - b_r * v - c_r * v**2 - F_g - F_c + d_force),
           equal(F_g, M * g * vartheta), equal(F_c, curvature * D_c * M))  # (1), (2), (3)
FORCES = in_time({"M": M, r"\ddot{x}": acceleration, r"\dot{x}": v, "F": F, "a_r": a_r, "b_r": b_r, "c_r": c_r, "D": D_c,
                  "d": d_force, r"\sin\theta": vartheta}) | {r"\dot{x}^2(t)": v**2, "q": g}


paper.axiom("1", "Newton's law for the train",
            r"M(t)\ddot{x}(t) = F(t) - a_r(t) - b_r(t)v(t) - c_r(t)v^2(t) - F_g(t) - F_c(t) + d(t)",
            "Rochard and Schmid 2000, the paper's [18]", hypotheses=(), severity="cosmetic")
paper.axiom("2", "The force of a grade", r"F_g(t) = M(t)g\sin\theta(t)", "Garg 1984, the paper's [19]", hypotheses=(), severity="cosmetic")
paper.axiom("3", "The force of a curve", r"F_c(t) = 0.004D(t)M(t)", "Garg 1984, the paper's [19]", hypotheses=(), severity="cosmetic")


@paper.claim("4", "The train with grade and curve", "identity",
             r"M(t)\ddot{x}(t) = F(t) - (a_r(t) + b_r(t)\dot{x}(t) + c_r(t)\dot{x}^2(t)) - M(t)q\sin\theta(t) - "
             r"0.004D(t)M(t) + d(t)", "proved", where=FORCES,
             reading="q is g, as in (2); sin(theta) is one letter, which the paper calls vartheta from (5) on.")
def with_grade_and_curve() -> Goal:
    """(2) and (3) put into (1)."""
    return Goal((equal(M * acceleration, F - (a_r + b_r * v + c_r * v**2) - M * g * vartheta
                       - curvature * D_c * M + d_force),), model_1)


PER_MASS = in_time({"m": m_t, "a": a_t, "b": b_t, "c": c_t, r"\bar{d}": d_bar, "D": D_c, r"\vartheta": vartheta,
                    r"\ddot{x}": acceleration, r"\dot{x}": v, "F": F}) | {r"\dot{x}^{2}(t)": v**2, "q": g}


@paper.claim("5", "The train per unit of mass", "identity",
             r"\ddot{x}(t) = m(t)F(t) - (a(t) + b(t)\dot{x}(t) + c(t)\dot{x}^{2}(t)) - q\vartheta(t) - 0.004D(t) + "
             r"\bar{d}(t)", "proved", premises=("4",), where=PER_MASS, reading="q is g, as in (2) and (8).",
             note="With m = 1/M, a = a_r/M, b = b_r/M, c = c_r/M and d_bar = d/M, as the text before (5) has them.")
def per_mass() -> Goal:
    """(4) divided by M."""
    new = ((m_t, 1), (a_t, a_r), (b_t, b_r), (c_t, c_r), (d_bar, d_force))
    return Goal((equal(acceleration, m_t * F - (a_t + b_t * v + c_t * v**2) - g * vartheta - curvature * D_c + d_bar),),
                (*paper.shown("4"), *(equal(x, force / M) for x, force in new)))


ramp = slope_ramp(sp.Rational(1, 4), sp.Integer(800))


def _ramp_goal(*begin: Relation) -> Goal:
    return Goal((less(0, ramp), at_most(ramp, 1)), (*begin, at_most(t, 804)))


paper.definition("6.definition", "The indicator functions",
                 r"\chi_{\varrho i}(t) = \begin{cases} \Psi_{\varrho i}(t), & \text{if } (x(t), \dot{x}(t)) \in \Omega_i, \\ 0, & \text{otherwise} \end{cases}")


@paper.claim("6", "The ramp of section VIII is an indicator as (6) asks", "inequality",
             r"\Psi_{\varrho i}(t) \in (0, 1],\ \chi_{\theta 3} = 0.25(t - 800)\ \text{for}\ t \in [800, 804]", "refuted",
             origin="implied", severity="cosmetic",
             reading="Section VIII's ramp is held against the range that (6) asks of every Psi.",
             correction=lambda: _ramp_goal(greater(t, 800)),
             corrected_statement=r"0.25(t - 800) \in (0, 1]\ \text{for}\ t \in (800, 804]",
             note="(6) asks for Psi in (0, 1] and in the next sentences for a ramp that starts at 0, or ends there. No "
                  "step of the proofs needs Psi > 0.")
def ramp_in_range() -> Goal:
    """Positive and at most 1 on the closed interval."""
    return _ramp_goal(at_least(t, 800))


def parameters_of_mode() -> list[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """Parameter, indicator and regressor of a, b, c, vartheta and D in mode i."""
    return [(of_mode(n), of_mode(f"chi_{n}"), by) for n, by in zip(NAMES, REGRESSORS, strict=True)]


m_of, chi_m_of, d_of, chi_d_of = of_mode("m"), of_mode("chi_m"), of_mode("d"), of_mode("chi_d")
acceleration_by_modes = over_modes(m_of * chi_m_of) * F - sum(
    (over_modes(x * chi) * by for x, chi, by in parameters_of_mode()), sp.Integer(0)) + over_modes(d_of * chi_d_of)


@paper.claim("7", "Position and speed", "identity", r"\dot{x}_1(t) = x_2(t)", "proved",
             note="From the definitions x_1 = x and x_2 = x'.")
def position_and_speed() -> Goal:
    """The first state's rate is the second."""
    return Goal((equal(D(x_1), x_2),), (equal(x_2, v),), flow={x_1: v})


@paper.claim("8", "The train in state space", "identity",
             r"\dot{x}_2(t) = m(t)F(t) - a(t) - b(t)x_2(t) - c(t)x_2^2(t) - g\vartheta(t) - 0.004D(t) + \bar{d}(t)",
             "proved", premises=("5",), where=PER_MASS)
def speed_rate() -> Goal:
    """(5) with x_2 = x'."""
    return Goal((equal(D(x_2), m_t * F - a_t - b_t * x_2 - c_t * x_2**2 - g * vartheta - curvature * D_c + d_bar),),
                (*paper.shown("5"), equal(v, x_2)), flow={x_2: acceleration})


paper.definition("9", "The piecewise parameters",
                 r"m(t) = \sum_{i=1}^{l}m_i\chi_{mi}(t),\ a(t) = \sum_{i=1}^{l}a_i\chi_{ai}(t),\ \ldots,\ \bar{d}(t) = \sum_{i=1}^{l}\bar{d}_i(t)\chi_{\bar{d}i}(t)",
                 note="(9) and (10), seven sums alike.")


@paper.claim("8.modes", "The piecewise model, gathered mode by mode", "identity",
             r"\dot{x}_2(t) = \sum_{i=1}^{l}\left(m_i\chi_{mi}F - a_i\chi_{ai} - b_i\chi_{bi}x_2 - c_i\chi_{ci}x_2^2 - "
             r"g\vartheta_i\chi_{\vartheta i} - 0.004D_i\chi_{Di} + \bar d_i\chi_{\bar di}\right)", "proved",
             premises=("8",), origin="implied", scope=ALL_MODES,
             reading="(8) with the sums (9), (10) put in, as (24) and (39) use it.",
             note="The paper supposes that the state is in one region only; that it is in some region at every instant "
                  "is meant too.")
def by_modes() -> Goal:
    """(8) with (9), (10): the sums are linear in the modes."""
    gathered = over_modes(m_of * chi_m_of * F - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                    sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_2), gathered),), flow={x_2: acceleration_by_modes})


d_most, M_least = sp.symbols("d_max M_min", positive=True)


@paper.claim("10", "A bound of the disturbance per unit of mass is available", "inequality",
             r"\text{Because bounds on $d(t)$ is known, and the masses of the empty and full train are also known, "
             r"the bounds of the term $\bar{d}(t) = d(t)/M(t)$ is available}", "proved", match="words",
             reading="|d| <= d_max and M >= M_min give |d/M| <= d_max/M_min.",
             note="Section II says twice that the bound of d is unknown, before and after (5), and else that it is "
                  "known; known is what (36) needs.")
def disturbance_per_mass() -> Goal:
    """From the bound of d and the mass of the empty train."""
    return Goal((at_most(sp.Abs(d_force) / M, d_most / M_least),),
                (at_most(sp.Abs(d_force), d_most), at_least(M, M_least)))


nu_0 = sp.Symbol("nu_0", real=True)
failed, F_0, F_rho, f_rho, delta_j = (sp.IndexedBase(n, real=True)[motor] for n in (
    "failed", "F_0", "F_rho", "f_rho", "delta"))
EVERY_MOTOR = "every number of motors, the varying basis signals of a motor gathered in one"
healthy = over_motors(1 - failed)  # k_nu
known = over_motors(failed * (F_0 + F_rho * f_rho))  # xi^T varpi


def force_of_motors(extra: sp.Expr) -> sp.Expr:
    """(12): nu_0 from healthy motors, what (11) says and something extra from failed ones, for which failed_j = 1."""
    return over_motors((1 - failed) * nu_0 + failed * (F_0 + F_rho * f_rho + extra))


def _letters(extra: sp.Expr) -> dict[str, sp.Expr]:
    return {"F(t)": force_of_motors(extra), r"k_{\nu}": healthy, r"\nu_0(t)": nu_0, r"\xi^T\varpi(t)": known,
            r"\sum_{j=1}^{n-k_\nu}\bar\delta_j(t)": over_motors(failed * delta_j)}


paper.axiom("11", "The failure of a motor",
            r"F_j(t) = \bar{F}_j(t) = \bar{F}_{j0} + \sum_{\rho=1}^{s_j}\bar{F}_{j\rho}f_{j\rho}(t),\ t \ge t_j",
            "Tao, Chen and Joshi 2002, the paper's [17]", hypotheses=(), severity="cosmetic")
paper.definition("12", "The force of all motors", r"F(t) = \sum_{j=1}^{n}F_j(t)")


@paper.claim("13", "The force with failures", "identity", r"F(t) = k_{\nu}\nu_{0}(t) + \xi^{T}\varpi(t)", "proved",
             scope=EVERY_MOTOR, where=_letters(sp.Integer(0)),
             note="xi_j must be read as 0 for a healthy motor, k_nu counts the healthy ones, and all of them get the "
                  "same nu_0.")
def force_with_failures() -> Goal:
    """(12) with (11) for failed motors and nu_0 for the others."""
    return Goal((equal(force_of_motors(sp.Integer(0)), healthy * nu_0 + known),))


paper.definition("14", "The parameters of the failures",
                 r"\xi_j = [\bar{F}_{j0},\ \bar{F}_{j1}, \dots, \bar{F}_{js_j}]^T \in R^{s_j + 1}")
paper.definition("15", "The basis signals of the failures",
                 r"\varpi(t) = [1, f_{11}(t), \dots, f_{1s_1}(t), \dots, 1, f_{n1}(t), \dots, f_{ns_n}(t)]^T")


F_j, F_of_11, F_0_one, F_1_one, f_one = sp.symbols("F_j Fbar_j F_0 F_1 f_1", real=True)
model_11 = equal(F_of_11, F_0_one + F_1_one * f_one)
fails = equal(F_j, F_of_11)  # of a motor that fails, after t_j
FORCE_11 = {r"F_j(t)": F_j, r"\bar{F}_j(t)": F_of_11, r"\bar{F}_{j0}": F_0_one, r"\bar{F}_{j1}": F_1_one, r"\sin(wt)": f_one}


def _failure_of_11(name: str, title: str, printed: str, shown: tuple[Relation, ...], given: tuple[Relation, ...],
                   reading: str) -> None:
    @paper.claim(f"11.{name}", title, "identity", printed, "proved", severity="cosmetic", scope=EVERY_MOTOR, where=FORCE_11,
                 reading=reading)
    def special_case() -> Goal:
        """(11), the varying basis signals gathered in one."""
        return Goal((fails, *shown), (equal(F_j, F_0_one + F_1_one * f_one), model_11, *given))


_failure_of_11("total", "A motor that stops is a failure of (11)", r"F_j(t) = \bar{F}_j(t) = \bar{F}_{j0} = 0",
               (equal(F_of_11, F_0_one), equal(F_0_one, 0)),
               (equal(F_0_one, 0), equal(F_1_one, 0)), "With all constants of (11) zero.")
_failure_of_11("constant", "A constant torque is a failure of (11)", r"F_j(t) = \bar{F}_j(t) = \bar{F}_{j0}", (equal(F_of_11, F_0_one),),
               (equal(F_1_one, 0),), "With the constants of the basis signals zero.")
_failure_of_11("periodic", "A sine of known frequency is a failure of (11)", r"F_j(t) = \bar{F}_j(t) = \bar{F}_{j1}\sin(wt)",
               (equal(F_of_11, F_1_one * f_one),),
               (equal(F_0_one, 0),), "With the sine as the basis signal.")


motors, most_failed, failures = sp.symbols("n n_bar failures", nonnegative=True)


@paper.claim("A1", "At least one motor is left", "inequality",
             r"\text{any up to } \bar{n}\ (\bar{n} < n) \text{ actuators fail}\ldots k_{\nu} \text{ only takes one integer "
             r"in the interval } [n - \bar{n}, n]", "proved", match="words",
             reading="k_nu is n less the number of failed motors.")
def motors_left() -> Goal:
    """n - failures, with failures <= n_bar < n."""
    left = motors - failures
    return Goal((at_least(left, motors - most_failed), at_most(left, motors), greater(left, 0)),
                (at_most(failures, most_failed), less(most_failed, motors)))


@paper.claim("17", "The force with unparameterizable failures", "identity",
             r"F(t) = k_{\nu}\nu_{0}(t) + \xi^{T}\varpi(t) + \sum_{j=1}^{n-k_{\nu}}\bar{\delta}_{j}(t)", "proved",
             premises=("13",), scope=EVERY_MOTOR, where=_letters(delta_j),
             reading="The sum up to n - k_nu runs over the failed motors, as if these were numbered first.")
def force_with_rest() -> Goal:
    """(12) with (16) for failed motors."""
    return Goal((equal(force_of_motors(delta_j), healthy * nu_0 + known + over_motors(failed * delta_j)),))


paper.definition("16.definition", "The failure with an unparameterizable term",
                 r"F_j(t) = \bar{F}_j(t) = \bar{F}_{j0} + \sum_{\rho=1}^{s_j}\bar{F}_{j\rho}f_{j\rho}(t) + \bar{\delta}_j(t),\ t \ge t_j")


delta_one = sp.Symbol("deltabar_j", real=True)


@paper.claim("16", "Without the unparameterizable term (16) is (11)", "implication",
             r"\text{As } \bar{\delta}_j(t) = 0 \text{, (16) is equivalent to the parametric failure (11)}", "proved",
             severity="cosmetic", scope=EVERY_MOTOR, match="words", reading="Both forces agree where the term is zero.")
def parametric_again() -> Goal:
    """(16) at zero against (11)."""
    return Goal((equal(F_0_one + F_1_one * f_one + delta_one, F_of_11),), (model_11, equal(delta_one, 0)))

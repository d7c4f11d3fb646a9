"""mao2018, section II: the train, its modes and its failures."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less

from ..active_mode import REGRESSORS
from ..error_dynamics import ALL_MODES, NAMES, motor, of_mode, over_modes, over_motors
from ..paper import paper
from ..plant import D_c, F, M, a_r, b_r, c_r, curvature, d_force, g, newton_1, slope_ramp, t, vartheta, x_1, x_2


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

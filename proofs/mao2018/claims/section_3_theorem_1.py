"""mao2018, section III: the controller (35)-(37), the rate (38) of V_2, and Theorem 1."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..active_mode import (
    F_35,
    REGRESSORS,
    Gamma_m,
    alpha_1,
    chi_d,
    chis,
    d,
    eta,
    hats,
    lambda_0,
    m,
    nu_healthy,
    rho_0,
    rho_hat,
    rho_law,
    speed_error,
    trues,
    wanted,
    zeta,
)
from ..error_dynamics import ACTIVE_MODE, disturbed, filippov, healthy_loop, size
from ..lyapunov import V_healthy, decay, square_integrable
from ..paper import paper
from ..plant import r_1, r_2, x_1, x_2, x_m, xdot_m, z_1, z_2


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
    return Goal((equal(D(V_healthy), stated),), filippov, healthy_loop)


@paper.claim("38", "V_2 does not increase: the whole argument in one certificate", "implication",
             r"m_i \ge \rho_m^0,\ \lambda_i^0 \ge d_i^0 \ge |\bar d_i| \Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2",
             "proved", premises=("8", "25.idle"), scope=ACTIVE_MODE,
             note="The checker derives V_2' from (25), the plant and the laws by itself, and re-checks the bound for "
                  "every value that Filippov's sign may take at z_2 = 0.")
def v2_bound() -> Goal:
    """D(V_2) along the closed loop against -r_1 z_1^2 - r_2 z_2^2."""
    return Goal((at_most(D(V_healthy), decay),), (*filippov, *disturbed, at_least(m, rho_0)), healthy_loop)


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

B, v_most = sp.symbols("B v_max", nonnegative=True)


@paper.claim("theorem1.integral", "The errors are square integrable", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 \Rightarrow \int_0^t (r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)", "proved",
             premises=("38", "25", "25.switch", "filippov"))
def errors_square_integrable() -> Goal:
    """J + V does not increase, where J is the integral."""
    return square_integrable()


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
    return Goal((equal(D(z_2), stated),), flow=healthy_loop)


@paper.claim("theorem1.speed", "The speed tracks too", "limit",
             r"z_1, z_2 \to 0 \Rightarrow x_2 - \dot x_m \to 0", "proved", premises=("theorem1", "theorem1.z2"),
             note="Decided as a bound: (x_2 - x_m')^2 is at most 2 z_2^2 + 2 r_1^2 z_1^2.")
def speed_tracks() -> Goal:
    """x_2 - x_m' = z_2 + alpha_1 - x_m'."""
    difference = x_2 - xdot_m
    inside = (equal(z_1, x_1 - x_m), equal(z_2, x_2 - alpha_1))
    return Goal((at_most(difference**2, 2 * z_2**2 + 2 * r_1**2 * z_1**2),), inside)

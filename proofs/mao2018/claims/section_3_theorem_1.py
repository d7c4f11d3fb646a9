"""mao2018, section III: what (38) makes of the errors, and Theorem 1."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..active_mode import REGRESSORS, alpha_1, chi_d, chis, d, hats, m, nu_healthy, rho_hat, speed_error, trues, wanted
from ..error_dynamics import ACTIVE_MODE, healthy_loop
from ..lyapunov import V_healthy, square_integrable, tracks
from ..paper import paper
from ..plant import r_1, r_2, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2

theta_, rate_one, rate_two, most = sp.symbols("theta Vdot_1 Vdot_2 most", real=True)


@paper.claim("38.filippov", "A convex combination of two modes obeys (38) too", "inequality",
             r"\dot V_2^{(1)}, \dot V_2^{(2)} \le w \Rightarrow \theta\dot V_2^{(1)} + (1-\theta)\dot V_2^{(2)} \le w",
             "proved", premises=("38",), origin="implied",
             note="Filippov solutions may slide along the border of two regions of (6), where the velocity is a convex "
                  "combination of theirs. V_2 is smooth and the same for all modes, so its rate is the same "
                  "combination.")
def sliding_between_modes() -> Goal:
    """The rate of V_2 is linear in the velocity."""
    return Goal((at_most(theta_ * rate_one + (1 - theta_) * rate_two, most),),
                (at_least(theta_, 0), at_most(theta_, 1), at_most(rate_one, most), at_most(rate_two, most)))


paper.axiom("filippov", "Solutions exist and V_2 decreases along them",
            r"\text{the system solution is defined in the Filippov sense [25], [26]}",
            "Filippov 1988; Shevitz and Paden 1994 (the paper's [25], [26])", hypotheses=("38", "38.filippov"),
            match="words", reading="A Filippov solution exists, and the rate of V_2 along it lies in the convex hull of "
                                   "its rates by the velocities nearby.")

B, v_most = sp.symbols("B v_max", nonnegative=True)


@paper.claim("theorem1.integral", "The errors are square integrable", "implication",
             r"\text{Since } V_2 \text{ is bounded, } \int_0^\infty z_1^2(\tau)d\tau < \infty \text{ and } "
             r"\int_0^\infty z_2^2(\tau)d\tau < \infty", "proved", premises=("38", "25", "25.switch", "filippov"),
             rests_on=("38",), match="words",
             reading="r_1 times the one integral and r_2 times the other are together at most V_2(0), at all times.")
def errors_square_integrable() -> Goal:
    """J + V does not increase, where J is the integral."""
    return square_integrable()


bounded_errors = (at_most(z_1**2, 2 * B), at_most(z_2**2, 2 * B))


@paper.claim("theorem1.bounded", "Position and speed are bounded", "implication",
             r"\text{all the variables are bounded}\ldots \text{From (21), } \alpha_1(t) \text{ is bounded, so is } x_2(t)",
             "proved", premises=("38", "25"), rests_on=("38",), match="words",
             reading="V_2 <= B gives z_1^2, z_2^2 <= 2B and x_2^2 <= 6B(1 + r_1^2) + 3 v_max^2, v_max the highest "
                     "desired speed.",
             note="It takes a bounded desired speed (and, for F, a bounded desired acceleration), which the paper "
                  "supposes silently; the list of bounded signals names xi_hat, which section III does not have.")
def speed_bounded() -> Goal:
    """x_2 = z_2 - r_1 z_1 + x_m', each part bounded."""
    return Goal((at_most((speed_error + xdot_m) ** 2, 6 * B * (1 + r_1**2) + 3 * v_most**2),),
                (*bounded_errors, at_most(xdot_m**2, v_most**2)))


@paper.claim("theorem1.rate", "The rate of z_1 is bounded", "implication",
             r"\text{According to (20), } \dot{z}_1(t) \text{ is bounded}", "proved",
             premises=("20", "theorem1.bounded"), match="words", reading="V_2 <= B gives z_1'^2 <= 4B(1 + r_1^2).")
def z1_rate_bounded() -> Goal:
    """z_1' = z_2 - r_1 z_1."""
    return Goal((at_most(D(z_1) ** 2, 4 * B * (1 + r_1**2)),), bounded_errors, {z_1: speed_error})


paper.axiom("barbalat", "A square integrable error with a bounded rate tends to zero",
            r"\int_0^\infty z_1^2\,d\tau < \infty,\ |\dot z_1| \le \text{const} \Rightarrow \lim_{t\to\infty} z_1 = 0",
            "Barbalat's lemma", hypotheses=("theorem1.integral", "theorem1.rate"), origin="implied")


@paper.claim("theorem1", "Theorem 1: all signals are bounded and the position error tends to zero", "implication",
             r"\text{The adaptive controller (35), with the adaptive scheme (27)-(31) and (36)-(37) applied to the system "
             r"(7)-(8), guarantees that all the closed-loop signals are bounded and the tracking error } e(t) = x_1(t) - "
             r"x_m(t) \text{ satisfies } \lim_{t\to\infty} e(t) = 0", "proved", match="words", severity="result",
             premises=("38", "25", "25.switch", "filippov", "theorem1.bounded", "theorem1.rate", "barbalat"),
             rests_on=("36.glyph", "38", "theorem1.integral", "theorem1.rate", "theorem1.alpha"), scope=ACTIVE_MODE,
             reading="Shown for all times: V_2, and so every estimation error, z_1, z_2 and the integral of r_1 z_1^2 + "
                     "r_2 z_2^2, are at most what V_2(0) allows. The limit is Barbalat's lemma, with the bounded rate of "
                     "theorem1.rate. (36) is read as in 36.glyph.",
             note="That all signals are bounded, F among them, takes a desired curve with bounded x_m, x_m' and x_m'', which "
                  "no assumption of the paper says, see theorem1.alpha.")
def theorem_1() -> Goal:
    """From what (38) and (25) show of V_2 alone."""
    return tracks(V_healthy, paper.shown("38"), paper.shown("25"))


@paper.claim("theorem1.alpha", "The rate of alpha_1 is bounded", "implication",
             r"\text{From (21), } \dot{\alpha}(t) \text{ is bounded, due to the bounded } \dot{z}_1(t) \text{ and } \dot{x}_m(t)",
             "gap", match="words", rests_on=(), correction=lambda: _alpha_rate_bounded(at_most(xddot_m**2, v_most**2)),
             reading="alpha_1' = -r_1 z_1' + x_m'' by (21); a bound of z_1' and x_m' would have to bound it.",
             corrected_statement=r"|\dot z_1| \le B,\ |\ddot x_m| \le v_{\max} \Rightarrow \dot\alpha_1^2 \le 2r_1^2B^2 + 2v_{\max}^2",
             note="It takes a bounded x_m'', which does not follow from a bounded x_m': x_m' = sin(t^2) has the rate "
                  "2 t cos(t^2), and F follows it. With bounded x_m, x_m' and x_m'', as any train's are, Theorem 1 stands.")
def alpha_rate_bounded() -> Goal:
    """From a bounded z_1' and x_m' alone."""
    return _alpha_rate_bounded()


def _alpha_rate_bounded(*given: Relation) -> Goal:
    rate = sp.Symbol("zdot_1", real=True)
    shown = at_most((-r_1 * rate + xddot_m) ** 2, 2 * r_1**2 * B**2 + 2 * v_most**2)
    return Goal((shown,), (at_most(rate**2, B**2), at_most(xdot_m**2, v_most**2), *given))


@paper.claim("theorem1.z2", "z_2 in closed loop, and its bounded rate", "implication",
             r"\text{According to (24), } \dot{z}_2(t) \text{ is bounded. It shows that } \lim_{t\to\infty} z_2(t) = 0",
             "proved", premises=("24.mended", "theorem1.bounded"), rests_on=("24", "theorem1.bounded"), match="words",
             scope=ACTIVE_MODE,
             reading="z_2' = -z_1 - r_2 z_2 - a_tilde chi_a - ... - m_i rho_tilde (zeta_i - eta - r_2 z_2) + m_i nu_di "
                     "chi_di + d_i chi_di, every term of which is bounded.",
             note="The bound takes that of V_2, the desired speed and the desired acceleration. With z_2 square "
                  "integrable, Barbalat's lemma gives z_2 -> 0 as the paper says.")
def z2_closed() -> Goal:
    """D(z_2) along the closed loop."""
    errors = sum(((x - hat) * chi * by for x, hat, chi, by in zip(trues, hats, chis, REGRESSORS, strict=True)),
                 sp.Integer(0))
    stated = -z_1 - r_2 * z_2 - errors - m * (1 / m - rho_hat) * wanted + m * nu_healthy * chi_d + d * chi_d
    return Goal((equal(D(z_2), stated),), flow=healthy_loop)


@paper.claim("theorem1.speed", "The speed tracks too", "limit",
             r"\lim_{t\to\infty} x_2(t) - \dot{x}_m(t) = 0", "proved", premises=("theorem1", "theorem1.z2"),
             severity="result",
             reading="Decided as a bound: (x_2 - x_m')^2 is at most 2 z_2^2 + 2 r_1^2 z_1^2, and both errors tend to zero.")
def speed_tracks() -> Goal:
    """x_2 - x_m' = z_2 + alpha_1 - x_m'."""
    difference = x_2 - xdot_m
    inside = (equal(z_1, x_1 - x_m), equal(z_2, x_2 - alpha_1))
    return Goal((at_most(difference**2, 2 * z_2**2 + 2 * r_1**2 * z_1**2),), inside)

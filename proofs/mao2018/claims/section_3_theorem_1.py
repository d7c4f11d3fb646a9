"""mao2018, section III: what (38) makes of the errors, and Theorem 1."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..active_mode import REGRESSORS, alpha_1, chi_d, chis, d, hats, m, nu_healthy, rho_hat, speed_error, trues, wanted
from ..error_dynamics import ACTIVE_MODE, healthy_loop
from ..lyapunov import V_healthy, square_integrable, tracks
from ..paper import paper
from ..plant import r_1, r_2, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2
from .section_3_signals import A_max, B, W_max, bounded_errors, control_bounded, rate_of_z_2, rate_of_z_2_open, w_i

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

v_most = sp.Symbol("v_max", nonnegative=True)


@paper.claim("theorem1.integral", "The errors are square integrable", "implication",
             r"\text{Since } V_2 \text{ is bounded, } \int_0^\infty z_1^2(\tau)d\tau < \infty \text{ and } "
             r"\int_0^\infty z_2^2(\tau)d\tau < \infty", "proved", premises=("38", "25", "25.switch", "filippov"),
             rests_on=("38",), match="words",
             reading="r_1 times the one integral and r_2 times the other are together at most V_2(0), at all times.")
def errors_square_integrable() -> Goal:
    """J + V does not increase, where J is the integral."""
    return square_integrable()


@paper.claim("theorem1.bounded", "The errors are bounded, and the speed with the desired speed", "implication",
             r"\text{all the variables are bounded}\ldots \text{From (21), } \alpha_1(t) \text{ is bounded, so is } x_2(t)",
             "proved", premises=("38", "25"), rests_on=("38",), match="words",
             reading="V_2 <= B gives z_1^2, z_2^2 <= 2B and x_2^2 <= 6B(1 + r_1^2) + 3 v_max^2, v_max the highest "
                     "desired speed.",
             note="It takes a bounded desired speed; the list of bounded signals names xi_hat, which section III does not have.")
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


HOLDS_1 = ("Shown for all times: V_2, and so every estimation error, z_1, z_2 and the integral of r_1 z_1^2 + r_2 z_2^2, are at "
           "most what V_2(0) allows. The limit is Barbalat's lemma, with the bounded rate of theorem1.rate. ")


@paper.claim("theorem1", "Theorem 1: all signals are bounded and the position error tends to zero", "implication",
             r"\text{The adaptive controller (35), with the adaptive scheme (27)-(31) and (36)-(37) applied to the system "
             r"(7)-(8), guarantees that all the closed-loop signals are bounded and the tracking error } e(t) = x_1(t) - "
             r"x_m(t) \text{ satisfies } \lim_{t\to\infty} e(t) = 0", "gap", match="words", severity="result",
             rests_on=("36.glyph", "38", "theorem1.integral", "theorem1.rate", "theorem1.F"), scope=ACTIVE_MODE,
             reading="Decided of F, one of all the signals, as theorem1.F is.",
             note="e tends to zero as the paper says, whatever the desired curve. That all signals are bounded takes bounded x_m, "
                  "x_m' and x_m'', which has to be added.")
def theorem_1() -> Goal:
    """With x_m' bounded alone."""
    return control_bounded()


@paper.claim("theorem1.mended", "Theorem 1 with the error tending to zero as printed, and all signals bounded for bounded x_m, "
             "x_m' and x_m''", "implication",
             r"\text{Theorem 1: } \lim_{t\to\infty} e(t) = 0\text{, and}\ z_1, z_2\ \text{and all estimates are bounded; all signals are, if}\ "
             r"x_m, \dot x_m\ \text{and}\ \ddot x_m\ \text{are}", "proved", origin="ours", mends="theorem1", severity="result",
             premises=("38", "25", "25.switch", "filippov", "theorem1.bounded", "theorem1.rate", "theorem1.F.mended", "barbalat"),
             scope=ACTIVE_MODE, reading=HOLDS_1 + "(36) is read as in 36.glyph.",
             note="x_2 is bounded by theorem1.bounded, F by theorem1.F.mended.")
def theorem_1_mended() -> Goal:
    """The same."""
    return tracks(V_healthy, paper.shown("38"), paper.shown("25"))


@paper.claim("theorem1.alpha", "The rate of alpha_1 is bounded", "implication",
             r"\text{From (21), } \dot{\alpha}(t) \text{ is bounded, due to the bounded } \dot{z}_1(t) \text{ and } \dot{x}_m(t)",
             "gap", match="words", rests_on=(), glyph="theorem1.alpha.dots",
             reading="alpha_1' = -r_1 z_1' + x_m'' by (21); a bound of z_1' and x_m' would have to bound it. The extracted text loses "
                     "dots elsewhere, in (30), (31) and (41); with two dots over x_m the line holds.",
             note="No assumption says that x_m'' is bounded: see theorem1.F.")
def alpha_rate_bounded() -> Goal:
    """From a bounded z_1' and x_m' alone."""
    return _alpha_rate_bounded(xdot_m)


@paper.claim("theorem1.alpha.dots", "The rate of alpha_1 is bounded with x_m''", "implication",
             r"\text{From (21), } \dot{\alpha}(t) \text{ is bounded, due to the bounded } \dot{z}_1(t) \text{ and } \ddot{x}_m(t)",
             "proved", origin="ours", glyph="theorem1.alpha")
def alpha_rate_bounded_dots() -> Goal:
    """From a bounded z_1' and x_m''."""
    return _alpha_rate_bounded(xddot_m)


def _alpha_rate_bounded(of_curve: sp.Expr) -> Goal:
    rate = sp.Symbol("zdot_1", real=True)
    shown = at_most((-r_1 * rate + xddot_m) ** 2, 2 * r_1**2 * B**2 + 2 * A_max)
    return Goal((shown,), (at_most(rate**2, B**2), at_most(of_curve**2, A_max)))


@paper.claim("theorem1.z2.loop", "z_2 in closed loop", "identity",
             r"\dot z_2 = -z_1 - r_2z_2 - \tilde a_i\chi_{ai} - \dots - m_i\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
             r"m_i\nu_{di}\chi_{\bar di} + \bar d_i\chi_{\bar di}", "proved", premises=("24.mended",), origin="ours", scope=ACTIVE_MODE)
def z2_closed() -> Goal:
    """D(z_2) along the closed loop."""
    errors = sum(((x - hat) * chi * by for x, hat, chi, by in zip(trues, hats, chis, REGRESSORS, strict=True)),
                 sp.Integer(0))
    stated = -z_1 - r_2 * z_2 - errors - m * (1 / m - rho_hat) * wanted + m * nu_healthy * chi_d + d * chi_d
    return Goal((equal(D(z_2), stated),), flow=healthy_loop)


RATE_OF_Z_2 = r"\text{According to (24), } \dot{z}_2(t) \text{ is bounded. It shows that } \lim_{t\to\infty} z_2(t) = 0"


@paper.claim("theorem1.z2", "The rate of z_2 is bounded", "implication", RATE_OF_Z_2, "gap", glyph="theorem1.z2.dots",
             rests_on=("24", "theorem1.bounded", "theorem1.F", "theorem1.alpha"), match="words", scope=ACTIVE_MODE, reading="The bound of theorem1.z2.mended, with one of x_m' instead of x_m''. e is the sum of the errors of a, ..., D.",
             note="It takes a bounded x_m'', which the sentence before names in the other reading of it (theorem1.alpha). With z_2 square "
                  "integrable, Barbalat's lemma then gives z_2 -> 0 as the paper says.")
def z2_rate() -> Goal:
    """With x_m' bounded alone."""
    return rate_of_z_2_open()


@paper.claim("theorem1.z2.mended", "The rate of z_2 is bounded with x_m''", "implication",
             r"\dot z_2^2 \le 6\left(2B(1 + r_2^2) + Z + m_i^2RW + m_i^2\left(\tfrac{\lambda_i^0}{\rho_m^0}\right)^2 + (d_i^0)^2\right)\ "
             r"\text{for}\ (\zeta_i - \eta - r_2z_2)^2 \le W", "proved", premises=("theorem1.z2.loop", "35.zeta", "35.wanted"),
             origin="ours", mends="theorem1.z2", scope=ACTIVE_MODE,
             reading="w is what rho_hat multiplies, e the sum of the errors of a, ..., D.")
def z2_rate_mended() -> Goal:
    """Six terms, each bounded."""
    return rate_of_z_2(w_i, W_max, at_most(w_i**2, W_max))


@paper.claim("theorem1.z2.dots", "The rate of z_2 is bounded, the sentence before naming a bounded x_m''", "implication", RATE_OF_Z_2,
             "proved", premises=("theorem1.z2.loop", "35.zeta", "35.wanted"), origin="ours", glyph="theorem1.z2", scope=ACTIVE_MODE,
             note="The same as theorem1.z2.mended.")
def z2_rate_dots() -> Goal:
    """Six terms, each bounded."""
    return z2_rate_mended()


SPEED = "Decided as a bound: (x_2 - x_m')^2 is at most 2 z_2^2 + 2 r_1^2 z_1^2, and both errors tend to zero."


LIMIT_OF_SPEED = r"\lim_{t\to\infty} x_2(t) - \dot{x}_m(t) = 0"


@paper.claim("theorem1.speed", "The speed tracks too", "limit", LIMIT_OF_SPEED, "gap", glyph="theorem1.speed.dots",
             rests_on=("theorem1.integral", "theorem1.rate", "theorem1.z2"),
             severity="result", reading="Decided of the bounded rate of z_2 that the limit of z_2 needs, as theorem1.z2 is.",
             note="It takes a bounded x_m'', as theorem1.z2 does, which the text names in the other reading of theorem1.alpha.")
def speed_tracks() -> Goal:
    """With x_m' bounded alone."""
    return rate_of_z_2_open()


@paper.claim("theorem1.speed.mended", "The speed tracks too for bounded x_m' and x_m''", "limit",
             r"\lim_{t\to\infty} x_2(t) - \dot{x}_m(t) = 0\ \text{for bounded}\ \dot x_m, \ddot x_m", "proved", origin="ours",
             premises=("theorem1.integral", "theorem1.bounded", "theorem1.z2.mended", "barbalat"), mends="theorem1.speed", severity="result",
             reading=SPEED)
def speed_tracks_mended() -> Goal:
    """x_2 - x_m' = z_2 + alpha_1 - x_m'."""
    difference = x_2 - xdot_m
    inside = (equal(z_1, x_1 - x_m), equal(z_2, x_2 - alpha_1))
    return Goal((at_most(difference**2, 2 * z_2**2 + 2 * r_1**2 * z_1**2),), inside)


@paper.claim("theorem1.speed.dots", "The speed tracks too, the text naming bounded x_m' and x_m''", "limit", LIMIT_OF_SPEED, "proved",
             origin="ours", premises=("theorem1.integral", "theorem1.bounded", "theorem1.z2.dots", "barbalat"), glyph="theorem1.speed",
             reading=SPEED)
def speed_tracks_dots() -> Goal:
    """The same."""
    return speed_tracks_mended()

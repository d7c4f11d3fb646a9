"""lee2010: errors of the attitude, their motion under the law, and a function V that makes them decay."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from ..laws import attitude_error, c, k_r, k_w, misalignment, moment
from ..paper import EVERY_ATTITUDE, EVERY_MATRIX, paper
from ..plant import J, W, hat

# Q = R_d^T R as nine numbers, and as what a unit quaternion gives; Omega_d and its rate in the desired axes.
Q = sp.Matrix(3, 3, sp.symbols("Q_11 Q_12 Q_13 Q_21 Q_22 Q_23 Q_31 Q_32 Q_33", real=True))
eta, *axis = sp.symbols("eta epsilon_1:4", real=True)
eps = sp.Matrix(axis)
unit = equal(eta**2 + eps.dot(eps), 1)
rotation = sp.eye(3) + 2 * eta * hat(eps) + 2 * hat(eps) ** 2
W_d = sp.Matrix(sp.symbols("W_1d W_2d W_3d", real=True))
W_d_rate = sp.Matrix(sp.symbols("a_1d a_2d a_3d", real=True))
e = sp.Matrix(sp.symbols("e_1:4", real=True))  # e_Omega, as numbers of their own
along = sp.Matrix(sp.symbols("n_1:4", real=True))
Psi, error, slip = misalignment(Q), attitude_error(Q), W - Q.T * W_d  # the last two are e_R and e_Omega
slope = (Q.trace() * sp.eye(3) - Q.T) / 2  # C, by which e_R moves with e_Omega


def relative(turn: sp.Matrix) -> dict[sp.Expr, sp.Expr]:
    """Q turning with an angular velocity in body axes."""
    return dict(zip(Q, Q * hat(turn), strict=True))


@paper.claim("8", "The attitude's error function is one less a cosine", "identity",
             r"\Psi(R, R_d) = \tfrac12 \operatorname{tr}(I - R_d^T R) = 2 |\epsilon|^2", "proved", match="read",
             reading="Of the quaternion (eta, eps) of R_d^T R: eta is the cosine of half the angle between the two.")
def error_function() -> Goal:
    """So it lies between 0 and 2."""
    found = misalignment(rotation)
    return Goal((equal(found, 2 * eps.dot(eps)), at_least(found, 0), at_most(found, 2)), (unit,))


@paper.claim("9", "Its derivative", "identity",
             r"D_R \Psi \cdot R \hat\eta = -\tfrac12 \operatorname{tr}(R_d^T R \hat\eta) "
             r"= \tfrac12 (R_d^T R - R^T R_d)^\vee \cdot \eta", "proved", scope=EVERY_MATRIX,
             reading="eta is any angular velocity here, in body axes; the second half is e_R, (10).")
def derivative() -> Goal:
    """Of any matrix."""
    return Goal((equal(D(Psi), -(Q * hat(along)).trace() / 2), equal(D(Psi), error.dot(along))), flow=relative(along),
                inputs=tuple(along))


@paper.claim("11", "The error of the angular velocity is that of the relative attitude", "identity",
             r"\frac{d}{dt} (R_d^T R) = (R_d^T R) \hat e_\Omega,\ e_\Omega = \Omega - R^T R_d \Omega_d", "proved",
             scope=EVERY_ATTITUDE, reading="Left, R' and R_d' each by its own angular velocity.")
def angular_velocity_error() -> Goal:
    """Of rotations alone: the rows of their matrices must be their cofactors."""
    left = rotation * hat(W) - hat(W_d) * rotation
    right = rotation * hat(W - rotation.T * W_d)
    return Goal(tuple(equal(one, two) for one, two in zip(left, right, strict=True)), (unit,))


LOOP = {**relative(slip), **dict(zip(W, J.inv() * (moment(Q, W_d, W_d_rate) - W.cross(J * W)), strict=True)),
        **dict(zip(W_d, W_d_rate, strict=True))}


@paper.claim("16", "The loop of the attitude", "identity",
             r"M = -k_R e_R - k_\Omega e_\Omega + \Omega \times J \Omega - J (\hat\Omega R^T R_d \Omega_d "
             r"- R^T R_d \dot\Omega_d) \Rightarrow J \dot e_\Omega = -k_R e_R - k_\Omega e_\Omega", "proved",
             premises=("5", "11"), scope=EVERY_ATTITUDE)
def loop() -> Goal:
    """With the moment that is simulated, for any motion of the desired attitude."""
    left, right = J * slip.applyfunc(D), -k_r * error - k_w * slip
    return Goal(tuple(equal(one, two) for one, two in zip(left, right, strict=True)), flow=LOOP,
                inputs=tuple(W_d_rate))


ERRORS = {**relative(e), **dict(zip(e, J.inv() * (-k_r * error - k_w * e), strict=True))}
energy = (e.T * J * e)[0] / 2 + k_r * Psi


@paper.claim("slope", "The attitude error moves with that of the angular velocity", "identity",
             r"\dot e_R = C e_\Omega,\ C = \tfrac12 (\operatorname{tr}(R^T R_d) I - R^T R_d)", "proved",
             origin="implied", premises=("11",), scope=EVERY_MATRIX)
def error_rate() -> Goal:
    """Of any matrix."""
    return Goal(tuple(equal(D(one), two) for one, two in zip(error, slope * e, strict=True)), flow=ERRORS)


turned = (rotation.trace() * sp.eye(3) - rotation.T) / 2


@paper.claim("slope.bound", "and no faster", "inequality", r"|C e_\Omega|^2 = |e_\Omega|^2 - |\epsilon \times e_\Omega|^2 "
             r"- 4 \eta^2 (\epsilon \cdot e_\Omega)^2 \le |e_\Omega|^2", "proved", origin="implied", scope=EVERY_ATTITUDE)
def slope_bound() -> Goal:
    """What is lost is a sum of squares."""
    across, lost = eps.cross(e), 4 * eta**2 * eps.dot(e) ** 2
    square = (turned * e).dot(turned * e)
    return Goal((equal(square, e.dot(e) - across.dot(across) - lost), at_least(across.dot(across) + lost, 0)), (unit,))


@paper.claim("Psi.square", "The attitude error by the error function", "identity", r"|e_R|^2 = \Psi (2 - \Psi)", "proved",
             origin="implied", premises=("8",), scope=EVERY_ATTITUDE)
def error_square() -> Goal:
    """The square of a sine; it vanishes at half a turn too."""
    found, psi = attitude_error(rotation), misalignment(rotation)
    return Goal((equal(found.dot(found), psi * (2 - psi)),), (unit,))


@paper.claim("energy", "Without a cross term V decreases by the damping", "identity",
             r"\dot V = -k_\Omega |e_\Omega|^2 \le 0,\ V = \tfrac12 e_\Omega^T J e_\Omega + k_R \Psi", "proved",
             origin="implied", premises=("9", "11", "16"), scope=EVERY_ATTITUDE)
def energy_rate() -> Goal:
    """The attitude error cancels."""
    return Goal((equal(D(energy), -k_w * e.dot(e)), at_most(-k_w * e.dot(e), 0)), flow=ERRORS)


most, least, psi, psi_0, speed_0, V_now, kinetic = sp.symbols("J_max J_min Psi Psi_0 w_0 V T", nonnegative=True)
size_r, size_w = sp.symbols("r w", nonnegative=True)  # |e_R| and |e_Omega|


@paper.claim("region", "An attitude that starts less than half a turn off stays so", "implication",
             r"|e_\Omega(0)|^2 < \frac{2}{\lambda_{\max}(J)} k_R (2 - \Psi(0)) \Rightarrow \Psi(t) < 2", "proved",
             origin="implied", premises=("energy",),
             reading="V is k_R Psi and a kinetic part T, never more than at first, where T is at most lambda_max |e_Omega|^2 / 2.")
def region() -> Goal:
    """The first proposition's condition is that V is less at first than at half a turn."""
    start = greater(2 * k_r * (2 - psi_0), most * speed_0**2)
    known = (at_most(V_now, most * speed_0**2 / 2 + k_r * psi_0), equal(V_now, kinetic + k_r * psi), at_least(kinetic, 0))
    return Goal((greater(2, psi),), (start, *known))


crossed = energy + c * error.dot(e)
falls = (-k_w * e.dot(e) + c * e.dot(slope * e) - c * k_r * (error.T * J.inv() * error)[0]
         - c * k_w * (error.T * J.inv() * e)[0])


@paper.claim("V", "V's rate with a cross term", "identity",
             r"\dot V = -k_\Omega |e_\Omega|^2 + c\, e_\Omega^T C e_\Omega - c k_R e_R^T J^{-1} e_R "
             r"- c k_\Omega e_R^T J^{-1} e_\Omega", "proved", origin="implied", premises=("16", "slope"),
             scope=EVERY_ATTITUDE)
def rate() -> Goal:
    """Of V and c times the product of both errors."""
    return Goal((equal(D(crossed), falls),), flow=ERRORS)


most_c = 4 * k_r * k_w * least**2 / (k_w**2 * most + 4 * k_r * least**2)
positive = (greater(least, 0), greater(most, 0))
form = (c * k_r / most * size_r**2 - c * k_w / least * size_r * size_w + (k_w - c) * size_w**2)
product, own, mixed = sp.symbols("s_1:4", real=True)


@paper.claim("bound", "V's rate is bounded by a form of the errors' sizes", "implication",
             r"-\dot V \ge \frac{c k_R}{\lambda_{\max}} |e_R|^2 - \frac{c k_\Omega}{\lambda_{\min}} |e_R| |e_\Omega| "
             r"+ (k_\Omega - c) |e_\Omega|^2", "proved", origin="implied", premises=("V", "slope.bound"),
             reading="s_1, s_2 and s_3 are the products with C, and with the inverse of J, of which the inequality of Cauchy "
                     "and Schwarz, the bound of C and the least and greatest inertia say what is assumed.")
def bound() -> Goal:
    """Each term by its own bound."""
    rate_now = -k_w * size_w**2 + c * product - c * k_r * own - c * k_w * mixed
    known = (at_most(product, size_w**2), at_least(most * own, size_r**2), at_least(least * mixed, -size_r * size_w))
    return Goal((at_least(-rate_now, form),), (*positive, *known))


@paper.claim("W", "V decreases for a small cross term", "implication",
             r"c < \frac{4 k_R k_\Omega \lambda_{\min}^2}{k_\Omega^2 \lambda_{\max} + 4 k_R \lambda_{\min}^2} \Rightarrow "
             r"\frac{c k_R}{\lambda_{\max}} |e_R|^2 - \frac{c k_\Omega}{\lambda_{\min}} |e_R| |e_\Omega| "
             r"+ (k_\Omega - c) |e_\Omega|^2 > 0", "proved", origin="implied", premises=("bound",), severity="result",
             reading="As a quadratic form, by its minors.")
def small_cross_term() -> Goal:
    """Its determinant is the condition itself."""
    det = c * k_r / most * (k_w - c) - (c * k_w / (2 * least)) ** 2
    return Goal((greater(c * k_r / most, 0), greater(det, 0)), (*positive, greater(most_c, c)))


@paper.claim("below", "V is positive for a small cross term", "implication",
             r"c^2 < k_R \lambda_{\min}(J) \Rightarrow \tfrac12 \lambda_{\min} |e_\Omega|^2 + k_R \Psi - c |e_R| |e_\Omega| "
             r"\ge \tfrac12 (\lambda_{\min} |e_\Omega|^2 - 2 c |e_R| |e_\Omega| + k_R |e_R|^2) \ge 0", "proved",
             origin="implied", premises=("Psi.square",))
def positive_V() -> Goal:
    """Psi is at least half of |e_R|^2."""
    least_form = (least * size_w**2 - 2 * c * size_r * size_w + k_r * size_r**2) / 2
    whole = least * size_w**2 / 2 + k_r * psi - c * size_r * size_w
    return Goal((at_least(whole, least_form), at_least(least * least_form, 0)),
                (greater(least, 0), equal(size_r**2, psi * (2 - psi)), greater(k_r * least, c**2)))


STATED = {k_r: Fraction(881, 100), k_w: Fraction(254, 100), least: Fraction(820, 10000), most: Fraction(1377, 10000),
          c: Fraction(1, 2)}


@paper.claim("stated", "Under the stated gains there is such a cross term", "condition",
             r"c = \tfrac12:\ c < \frac{4 k_R k_\Omega \lambda_{\min}^2}{k_\Omega^2 \lambda_{\max} + 4 k_R \lambda_{\min}^2},\ "
             r"c^2 < k_R \lambda_{\min}", "proved", origin="implied", at=STATED)
def stated_gains() -> Goal:
    """k_R = 8.81, k_Omega = 2.54 and inertias from 0.082 to 0.1377 kg m^2."""
    return Goal((greater(most_c, c), greater(k_r * least, c**2)))


paper.axiom("proposition1", "The attitude errors decay exponentially",
            r"\Psi(0) < 2,\ |e_\Omega(0)|^2 < \frac{2}{\lambda_{\max}(J)} k_R (2 - \Psi(0)) \Rightarrow "
            r"(e_R, e_\Omega) \to 0 \text{ exponentially}",
            "comparison lemma for V between two quadratic forms of the errors, Psi staying off 2", severity="result",
            hypotheses=("region", "W", "below", "Psi.square"))

wrong = J * (hat(W) * Q.T * W_d - Q.T * W_d_rate) - k_w * Q.T * W_d
PLAIN = {**LOOP, **dict(zip(W, J.inv() * (moment(Q, sp.zeros(3, 1), sp.zeros(3, 1)) - W.cross(J * W)), strict=True))}
plain_energy = (slip.T * J * slip)[0] / 2 + k_r * Psi


def pushed() -> Goal:
    """V's rate with what the desired attitude's motion leaves over."""
    return Goal((equal(D(plain_energy), -k_w * slip.dot(slip) + slip.dot(wrong)),), flow=PLAIN, inputs=tuple(W_d_rate))


@paper.claim("feedforward", "Without the desired rates in the law V decreases too", "inequality", r"\dot V \le 0", "refuted",
             origin="ours", premises=("energy",), correction=pushed, scope=EVERY_ATTITUDE,
             corrected_statement=r"\dot V = -k_\Omega |e_\Omega|^2 + e_\Omega^T (J (\hat\Omega R^T R_d \Omega_d - R^T R_d "
                                 r"\dot\Omega_d) - k_\Omega R^T R_d \Omega_d)",
             note="The paper claims nothing for this case. Implementations often take the desired attitude as one that does "
                  "not turn; but it follows the position's errors and turns with them.")
def without_feedforward() -> Goal:
    """As a question: may Omega_d and its rate be dropped?"""
    return Goal((at_most(-k_w * e.dot(e) + e.dot(sp.Matrix(sp.symbols("p_1:4", real=True))), 0),))

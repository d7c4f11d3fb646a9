"""mao2018, section VI: unknown bounds of the disturbance, (53)-(57), and Theorem 4."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..active_mode import (
    Gamma_d,
    chi_d,
    d,
    delta_0,
    lambda_0,
    lambda_hat,
    lambda_law,
    lambda_law_true,
    m,
    nu_unknown,
    rho_0,
    rho_k0,
    signal_of,
)
from ..counterexamples import already, at_instant, failing
from ..error_dynamics import (
    ACTIVE_MODE,
    ALL_SIGNALS,
    disturbed,
    failed_train,
    filippov,
    k_v,
    laws_printed,
    laws_true,
    size,
)
from ..felt_force import of_every_mode, printed_signal, signal_law
from ..lyapunov import V_40, V_53, decay, tracks
from ..modes import EVERY_MODE, p_hat
from ..paper import paper
from ..plant import s, t, z_1, z_2
from ..steady_state_error import LAWS, STEADY_STATE_ERROR, epsilon, steady_state_error
from .section_3_signals import rho_m
from .section_4_design import LEFT, NU_0, OUTWEIGHED, SIGNAL, bounds_errors, left_by
from .section_4_theorem_2 import ALONE_44, BOUND, BOUNDED, ONE_MASS, REPAIR, SQUARE_IN_TIME, THEOREM, TRACKS, WEIGHTS
from .section_5 import delta, rest_bounds

bounded_by_unknown = (at_most(d, lambda_0), at_least(d, -lambda_0))
V_53_printed = V_40 + (lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)


paper.definition("53.definition", "The Lyapunov function of section VI",
                 r"V_2 = V_1 + \frac{1}{2}z_2^2 + \dots + \sum_{i=1}^{l}\frac{1}{2}\left(\dots + \Gamma_{di}^{-1}(\tilde{\lambda}_i^0)^2 + \dots\right)",
                 note="(40) with one more square in the sum over the modes. Its gain is called Gamma_{d_i^0} from the next line on.")


@paper.claim("53", "V_2 bounds the errors", "inequality", r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved",
             premises=("40",), origin="implied", scope=ALL_SIGNALS, reading="The text calls V_2 a Lyapunov function.")
def unknown_bound_lyapunov_not_negative() -> Goal:
    """(40) and one more square."""
    return bounds_errors(V_53_printed)


@paper.claim("53.mended", "V_2 with the weights that fit bounds the errors", "inequality",
             r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved", origin="ours", mends="53", scope=ALL_SIGNALS)
def fitting_unknown_bound_lyapunov() -> Goal:
    """The weights of 40.mended and one more square, with the weight m_i k_nu/rho_i^0."""
    return bounds_errors(V_53)


def _law_54(sign: int) -> Goal:
    """D of the square of the error of lambda_hat, which has to be -|z_2| chi times the error."""
    error = lambda_0 - lambda_hat
    return Goal((equal(D(error**2 / (2 * Gamma_d)), -sp.Abs(z_2) * chi_d * error),),
                flow={lambda_hat: sign * Gamma_d * z_2 * sp.sign(z_2) * chi_d})


LAW_54 = r"\dot{\hat{\lambda}}_i^0(t) = %s\Gamma_{d_i^0}z_2(t)\operatorname{sgn}[z_2(t)]\chi_{\bar{d}i}(t)"
CANCELS_54 = LAW_54 + (r"\ \Rightarrow\ \tfrac{d}{dt}\left[\tfrac{1}{2\Gamma_{d_i^0}}(\tilde\lambda_i^0)^2\right] = "
                       r"-\tilde\lambda_i^0|z_2|\chi_{\bar di}")
paper.definition("54.law", "The law of lambda_hat", LAW_54 % "-", note="What it is for is decided in 54.")


@paper.claim("54", "With the minus of (54) the square of its error adds to the rate of V_2 what (57) says", "identity",
             CANCELS_54 % "-", "refuted", origin="implied", scope="each mode", correction=lambda: _law_54(1),
             corrected_statement=CANCELS_54 % "",
             reading="The two middle terms of (57), lambda_hat |z_2| - |z_2| lambda_i^0, are what (54) has to make.",
             note="The sign of (54) is wrong: with the minus the estimate of the bound can only fall, where the disturbance needs "
                  "it to grow, and once it is negative (56) pushes away from z_2 = 0. (57) is what a plus gives. The extracted "
                  "text has a clear minus, as in (44). Theorem 4 falls with either sign, see theorem4.reading.")
def lambda_law_cancels() -> Goal:
    """The law as printed."""
    return _law_54(-1)


@paper.claim("54.glyph", "With a plus for the minus of (54) it adds what (57) says", "identity", CANCELS_54 % "", "proved",
             origin="ours", mends="54", scope="each mode")
def lambda_law_plus() -> Goal:
    """The same with a plus."""
    return _law_54(1)


def _terms_57(coefficient: sp.Expr) -> Goal:
    """The terms that (54) with a plus makes, lambda_hat being of any sign; rho_m^0 in (56) as printed."""
    true = (m * k_v * z_2 * nu_unknown.xreplace({rho_0: rho_m}) + z_2 * d * chi_d
            + D((lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)))
    stated = (-coefficient / rho_m * lambda_hat * size * chi_d + lambda_hat * size * chi_d - size * lambda_0 * chi_d
              + z_2 * d * chi_d)
    return Goal((equal(true, stated),), (*filippov, at_most(chi_d, 1), at_least(m, rho_m)), {lambda_hat: lambda_law_true})


TERMS_57 = (r"\dot V_2 + r_1z_1^2 + r_2z_2^2 = \sum_i\left(-\tfrac{%s}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - "
            r"|z_2|\lambda_i^0 + z_2\bar d_i\right)\chi_{\bar di}%s")


@paper.claim("57.a", "The terms of the unknown bound in the rate of V_2", "identity", TERMS_57 % ("m_i", ""), "refuted",
             premises=("54.glyph",), rests_on=("54.glyph", "55", "56"), scope="one active mode",
             correction=lambda: _terms_57(m * k_v),
             corrected_statement=TERMS_57 % (r"m_ik_\nu", r"\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{d_i^0}|z_2|\chi_{\bar di}"),
             reading="The equation of (57), decay taken to the left; of V_2' only the terms of d_i, nu_di and lambda_hat. (54) is "
                     "taken with a plus, with which the two middle terms are right. rho_m^0 is the bound of m_i of section III. Shown "
                     "for k_nu = 15 and m_i = rho_m^0 = 1.",
             note="The first term lacks k_nu. That only helps the bound where lambda_hat is not negative.")
def unknown_bound_terms() -> Goal:
    """z_2 m_i k_nu nu_d + z_2 d_i chi_di and D of the last term of (53)."""
    return already(_terms_57(m), {k_v: sp.Integer(15), m: sp.Integer(1), rho_m: sp.Integer(1), chi_d: sp.Integer(1)})


def _terms_bound(*more: Relation) -> Goal:
    """The terms of (57) as printed."""
    stated = (-m / rho_m * lambda_hat * size - (lambda_0 - lambda_hat) * size + z_2 * d) * chi_d
    return Goal((at_most(stated, 0),), (*bounded_by_unknown, at_least(m, rho_m), at_most(chi_d, 1), *more))


STEP_57 = (r"\sum_i\left(-\tfrac{m_i}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - |z_2|\lambda_i^0 + z_2\bar d_i"
           r"\right)\chi_{\bar di} \le 0")


@paper.claim("57.b", "The bound drawn in (57)", "inequality", STEP_57, "refuted", origin="implied", severity="cosmetic",
             scope="one active mode", reading="The step from the first line of (57) to the second.",
             correction=lambda: _terms_bound(at_least(lambda_hat, 0)),
             corrected_statement=r"\hat\lambda_i^0 \ge 0\ \Rightarrow\ " + STEP_57,
             note="It fails where lambda_hat is negative alone, which a plus in (54) and an initial estimate lambda_hat(0) >= 0 "
                  "exclude (54.sign); the paper prints neither. (56) and (57) print rho_m^0, the bound of m_i of section III, and "
                  "the line after (56) defines rho_i^0, the bound of m_i k_nu. Either serves: in theorem4.mended the weight m_i k_nu/rho_i^0 of "
                  "lambda_tilde makes lambda_hat drop out, whatever its sign, and rho_m^0 is at most m_i k_nu too.")
def unknown_bound_step() -> Goal:
    """The printed terms, rho_m^0 a bound of m_i."""
    return _terms_bound()


lambda_start = sp.Symbol("lambda_hat_0", nonnegative=True)


@paper.claim("55.law", "The controller for unknown bounds", "identity", printed_signal(r"\hat{\xi}(t)\varpi(t)"), "proved",
             rests_on=(), scope=EVERY_MODE, where=SIGNAL | {
                 r"\nu_{di}(t)": of_every_mode(nu_unknown), r"\hat{\xi}(t)\varpi(t)": p_hat},
             reading=NU_0 + "xi_hat varpi stands for xi_hat^T varpi.")
def unknown_bound_law() -> Goal:
    """D(x_2) of (8) with the signal that is simulated."""
    return signal_law(signal_of(nu_unknown), of_every_mode(nu_unknown))


@paper.claim("55", "What the controller leaves of the rate of V_2", "identity", LEFT % r"\nu_{di}", "proved",
             premises=("42",), origin="implied", scope=ALL_SIGNALS,
             reading="(55), which is (42) with the nu_di of (56), put into the display before (42).")
def unknown_bound_controller_in_rate() -> Goal:
    """(55) in the bracket of V_2'."""
    return left_by(signal_of(nu_unknown), nu_unknown)


paper.definition("56.law", "The signal with an estimated bound",
                 r"\nu_{di}(t) = -\frac{1}{\rho_m^0}\hat{\lambda}_i^0(t)\operatorname{sgn}[z_2(t)]\chi_{\bar{d}i}(t)",
                 note="Section III defines rho_m^0, a bound of m_i; the next line defines rho_i^0, one of m_i k_nu, see 56.")


@paper.claim("56", "nu_d outweighs the disturbance once the estimate reaches its bound", "inequality",
             OUTWEIGHED % r"\hat\lambda_i^0 \ge |\bar d_i|", "proved", origin="implied", scope=ACTIVE_MODE,
             reading="What (56) is designed for; its rho_m^0 is read as the rho_i^0 of the next line.",
             note="Nothing makes the estimate reach the bound, and with (54) as printed it never rises: see 54. With "
                  "rho_m^0 a bound of m_i, as in section III, it holds as well, since k_nu is at least 1.")
def estimated_bound_outweighs() -> Goal:
    """With an estimate that is no smaller than the disturbance."""
    return Goal((at_most(z_2 * (m * k_v * nu_unknown + d * chi_d), 0),),
                (*filippov, at_most(chi_d, 1), at_least(m * k_v, rho_0), at_most(d, lambda_hat),
                 at_least(d, -lambda_hat)), lemmas=(at_least(lambda_hat, 0),))


@paper.claim("54.sign", "The corrected law keeps lambda_hat from falling", "implication",
             r"\dot{\hat\lambda}_i^0 = \Gamma_{d_i^0}|z_2|\chi_{\bar di},\ \hat\lambda_i^0(0) \ge 0 \Rightarrow "
             r"\hat\lambda_i^0(t) \ge 0", "proved", origin="ours", scope="each mode")
def lambda_not_negative() -> Goal:
    """-lambda_hat does not increase."""
    drift = sp.Symbol("lambda_hat_dot", real=True)
    return Goal((at_least(lambda_hat, 0),), (), {t: sp.Integer(1), lambda_hat: drift}, (at_least(drift, 0),),
                {t: sp.Integer(0), lambda_hat: lambda_start}, decreasing=-lambda_hat, inputs=(drift,))


given_57 = (*filippov, *bounded_by_unknown, at_least(m * k_v, rho_0))


def _bound_57(V: sp.Expr, laws: dict[sp.Expr, sp.Expr], law: sp.Expr, *more: Relation) -> Goal:
    flow = {**failed_train(signal_of(nu_unknown)), **laws, lambda_hat: law}
    return Goal((at_most(D(V), decay),), (*given_57, *more), flow)


MENDED_57 = (r"\dot{V}_2 \leq -r_1z_1^2 - r_2z_2^2\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{d_i^0}|z_2|\chi_{\bar di},\ "
             r"\dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi,\ \text{the weight}\ \tfrac{m_ik_\nu}{\rho_i^0}\ \text{of}\ "
             r"(\tilde\lambda_i^0)^2,\ " + WEIGHTS)


@paper.claim("57", "V_2 does not increase with unknown bounds: the whole argument", "inequality", BOUND + r" \leq 0",
             "refuted", premises=("39", "25.idle"), rests_on=("44", "37.failures", "54", "57.a", "57.b"), scope=ALL_SIGNALS, closed_loop=True,
             where={"V_2": V_53_printed},
             reading=ALONE_44 + "lambda_hat is exact, so that (54) plays no part, and rho_i^0 = m_i serves as rho_m^0 too.",
             note="The last line of (57), for lambda_i^0 >= |d_i| and m_i k_nu >= rho_i^0. Mended as 57.mended. " + REPAIR)
def v2_bound_unknown() -> Goal:
    """D(V_2) along (7), (8), (27)-(31), (37), (41), (44), (54)-(56)."""
    goal = at_instant(failing(_bound_57(V_53_printed, laws_printed, lambda_law)), {lambda_hat: sp.Integer(1)})
    return Goal((*goal.show, at_most(decay, 0)), goal.assume, goal.flow)


@paper.claim("57.mended", "V_2 does not increase with unknown bounds, laws and weights mended", "inequality", MENDED_57,
             "proved", premises=("39", "25.idle", "44.mended", "54.glyph"), origin="ours", mends="57",
             scope=ALL_SIGNALS, note=REPAIR)
def v2_bound_unknown_mended() -> Goal:
    """The same with (44) and (54) mended, the weights fitting."""
    return _bound_57(V_53, laws_true, lambda_law_true)


@paper.claim("theorem4", "Theorem 4: the position error tends to zero with unknown bounds", "limit",
             THEOREM % ("(55), with signal (56) and the adaptive scheme (27)-(31), (37), (41), (44), and(54)",
                        "(7)-(8) with actuator failures (13)-(15)", ""), "refuted",
             match="words", severity="result", closed_loop=True, rests_on=("57", "47.signal"), scope=ALL_SIGNALS,
             reading=SQUARE_IN_TIME + "Decided as z_1^2 <= 1/4 from some time on. The bound in (56) is 1, which is one of m_i as well "
                                      "as one of m_i k_nu.",
             note="False as printed: " + STEADY_STATE_ERROR % f"{LAWS}, (54)" + "lambda_hat falls from 1. With a plus in (54) Theorem 4 falls too "
                  "(theorem4.reading); with a plus in (44) and in (54) it holds as theorem4.mended states. The text before it "
                  "names (48) and (52) where (55) and (57) are meant.")
def theorem_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return _error_stays(lambda_law)


def _error_stays(law: sp.Expr) -> Goal:
    constants = {epsilon: sp.Rational(1, 4), lambda_0: sp.Integer(1), Gamma_d: sp.Integer(16), rho_0: sp.Integer(1)}
    return steady_state_error(at_most(z_1**2, epsilon), nu_unknown, constants, *disturbed, at_least(m, rho_0), lambda_law=law)


@paper.claim("theorem4.reading", "Theorem 4 with a plus in (54) alone", "limit", r"\dot{\hat\lambda}_i^0 = +\Gamma_{d_i^0}|z_2|\chi_{\bar di} "
             r"\Rightarrow \lim_{t\to\infty} e(t) = 0", "refuted", origin="ours", closed_loop=True, rests_on=(), scope=ALL_SIGNALS,
             note="lambda_hat grows from 1 without end, and rho_knu_hat starts at -1.")
def theorem_4_in_the_other_reading() -> Goal:
    """(44) as printed, (54) with a plus."""
    return _error_stays(lambda_law_true)


@paper.claim("theorem4.mended", "Theorem 4 with a plus in (44) and (54) and one mass in all modes", "implication",
             r"\text{Theorem 4 with } \dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi,\ \dot{\hat\lambda}_i^0 = "
             r"+\Gamma_{d_i^0}|z_2|\chi_{\bar di}\text{, in (56) any positive bound that is at most all}\ m_ik_\nu\text{, as}\ \rho_i^0\ "
             r"\text{and}\ \rho_m^0\ \text{are}" + ONE_MASS + BOUNDED, "proved", origin="ours",
             mends="theorem4", severity="result", scope=ALL_SIGNALS, reading=TRACKS, note=REPAIR,
             premises=("57.mended", "53.mended", "46.jump", "25.switch", "filippov", "theorem1.rate", "theorem1.bounded",
                       "47.signal.mended", "barbalat"))
def theorem_4_mended() -> Goal:
    """From what (57) mended and (53) mended show of V_2 alone."""
    return tracks(V_53, paper.shown("57.mended"), paper.shown("53.mended"))


delta_hat, Gamma_delta = sp.Symbol("delta_hat", real=True), sp.Symbol("Gamma_delta", positive=True)


@paper.claim("VI.extension", "The scheme, repaired, extends to unparameterizable failures of unknown bound",
             "implication", r"\nu_s = -\tfrac{1}{\rho_{k\nu}^0}\hat\delta^0\mathrm{sgn}(z_2),\ \dot{\hat\delta}^0 = \Gamma_\delta|z_2| "
             r"\Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2", "proved",
             premises=("57.mended",), origin="ours", scope=ALL_SIGNALS,
             note="The text below Theorem 4 says, without equations, that the method is 'easily extended'. With the signs "
                  "repaired it is; delta^0 bounds the sum of the delta_j, and V_2 gets the term "
                  "m_i k_nu (delta_tilde^0)^2/(2 rho_knu^0 Gamma_delta).")
def unknown_failure_bound() -> Goal:
    """(57) repaired, with an estimate of delta^0 too."""
    V = V_53 + m * k_v / rho_k0 * (delta_0 - delta_hat) ** 2 / (2 * Gamma_delta)
    signal = signal_of(nu_unknown - delta_hat * s / rho_k0) + delta / k_v
    flow = {**failed_train(signal), **laws_true, lambda_hat: lambda_law_true, delta_hat: Gamma_delta * z_2 * s}
    return Goal((at_most(D(V), decay),),
                (*filippov, *bounded_by_unknown, *rest_bounds, at_least(m * k_v, rho_0)), flow)

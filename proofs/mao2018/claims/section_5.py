"""mao2018, section V: unparameterizable failures, (48)-(52), and Theorem 3."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, less

from ..active_mode import chi_d, d, delta_0, lambda_0, m, nu_failed, nu_s_sum, rho_0, rho_k0, signal_of
from ..counterexamples import already, at_instant, failing
from ..error_dynamics import (
    ACTIVE_MODE,
    ALL_SIGNALS,
    Flow,
    disturbed,
    failed_train,
    filippov,
    k_v,
    laws_printed,
    laws_true,
    size,
    within,
)
from ..felt_force import of_every_mode, printed_signal, signal_law
from ..lyapunov import V_40, V_true, decay, tracks
from ..modes import EVERY_MODE, p_hat
from ..paper import paper
from ..plant import s, z_1, z_2
from ..steady_state_error import LAWS, STEADY_STATE_ERROR, epsilon, steady_state_error
from .section_4_design import LEFT, NU_0, OUTWEIGHED, SIGNAL, left_by, outweighed
from .section_4_theorem_2 import ALONE_44, BOUND, BOUNDED, MENDED_45, ONE_MASS, REPAIR, SQUARE_IN_TIME, THEOREM, TRACKS

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


@paper.claim("48.law", "The controller with unparameterizable failures", "identity",
             printed_signal(r"\hat{\xi}(t)\varpi(t)", r"\sum_{j=1}^{n-k_{\nu}}\nu_{sj}(t) + "), "proved",
             rests_on=(), scope=EVERY_MODE, where=SIGNAL | {
                 r"\nu_{di}(t)": of_every_mode(nu_failed), r"\hat{\xi}(t)\varpi(t)": p_hat,
                 r"\sum_{j=1}^{n-k_{\nu}}\nu_{sj}(t)": nu_s_sum}, reading=NU_0
                     + "xi_hat varpi stands for xi_hat^T varpi, and the sum over j, of (49), for -delta_0 sgn(z_2)/rho_knu^0 with the sum "
                       "delta_0 of all delta_j^0.")
def unparameterized_law() -> Goal:
    """D(x_2) of (8) with the signal that is simulated."""
    return signal_law(signal_of(nu_failed + nu_s_sum), of_every_mode(nu_failed), before=nu_s_sum)


@paper.claim("48", "What the controller leaves of the rate of V_2", "identity",
             LEFT % r"\textstyle\sum_j\nu_{sj} + \nu_{di}", "proved", premises=("17", "42"), origin="implied",
             scope=ALL_SIGNALS, reading="(48) put into the display before (42); (48) prints xi_hat varpi for xi_hat^T varpi.")
def unparameterized_controller_in_rate() -> Goal:
    """(48) in the bracket of V_2'."""
    return left_by(signal_of(nu_failed + nu_s_sum), nu_failed, nu_s_sum)


k_one, k_other, n, n_bar = sp.symbols("k_nu k_nu_other n n_bar", positive=True)


@paper.claim("48.pattern", "The controller can be computed from what is known", "implication",
             r"\sum_{j=1}^{n-k_{\nu}}\nu_{sj}(t)\ \text{of (48) is known to the controller}",
             "gap", premises=("A1",), origin="implied", severity="step",
             reading="Two failure patterns that (A1) allows, with one bound delta_j^0 for all motors, must give the same "
                     "sum of nu_sj, since which of them it is cannot be known.",
             note="(48) sums nu_sj up to n - k_nu, the unknown number of failed motors. Mended without loss: the bound of "
                  "51.mended holds for every delta_0 that is large enough, so the sum may run over the n_bar motors with "
                  "the largest delta_j^0.")
def computable() -> Goal:
    """The sum of nu_sj for two values of k_nu."""
    patterns = tuple(r for k in (k_one, k_other) for r in (at_least(k, n - n_bar), at_most(k, n)))
    return Goal((equal((n - k_one) * -bound_1 * s / rho_k0, (n - k_other) * -bound_1 * s / rho_k0),),
                (*patterns, less(n_bar, n), at_most(s, 1), at_least(s, -1)))


rest_bounds = (at_most(delta, delta_0), at_least(delta, -delta_0), at_least(k_v, rho_k0))


paper.definition("49.law", "The signal against unparameterizable failures",
                 r"\nu_{sj}(t) = -\frac{1}{\rho_{k\nu}^0}\delta_j^0\text{sgn}[z_2(t)]",
                 note="What it is for is decided in 49.")


@paper.claim("49", "nu_s outweighs the unparameterizable failures", "inequality",
             r"|\bar\delta_j| \le \delta_j^0,\ k_\nu \ge \rho_{k\nu}^0 \Rightarrow z_2m_i\left(k_\nu\textstyle\sum_j\nu_{sj} + "
             r"\sum_j\bar\delta_j\right) \le 0", "proved", premises=("17",), origin="implied", scope=ACTIVE_MODE,
             reading="What (49) is designed for.",
             note="delta is the sum over the failed motors, delta_0 that of their bounds.")
def failures_outweighed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return Goal((at_most(z_2 * m * (k_v * nu_s_sum + delta), 0),), (*filippov, *rest_bounds))


paper.definition("50.law", "The signal against the disturbance",
                 r"\nu_{di}(t) = -\frac{1}{\rho_i^0}\lambda_i^0\operatorname{sgn}[z_2(t)]",
                 note="(43) again.")


@paper.claim("50", "nu_d outweighs the disturbance, as in (43)", "inequality",
             OUTWEIGHED % r"\lambda_i^0 \ge d_i^0 \ge |\bar d_i|", "proved", premises=("43",), origin="implied",
             scope=ACTIVE_MODE, reading="What (50) is designed for.", note="(50) is (43) again.")
def disturbance_outweighed_again() -> Goal:
    """(43) again."""
    return outweighed(nu_failed, *disturbed)


@paper.claim("51.a", "The terms that (49), (50) compensate", "identity",
             r"\dot V_2 + r_1z_1^2 + r_2z_2^2 = \sum_i" + TERMS_51 % (r"\sum_{j=1}^{n-k_\nu}", " +", r"\bar d", r"\right)"),
             "refuted", premises=("17",), rests_on=("48",), severity="cosmetic",
             scope="one active mode, n - k_nu = 2",
             reading="The equation of (51), decay taken to the left; of V_2' only the terms of delta_j, d_i and what "
                     "compensates them, for two failed motors.",
             correction=lambda: _compensated_51(1),
             corrected_statement=r"\sum_i\Big[" + TERMS_51 % (r"\sum_{j=1}^{n-k_\nu}", r"\right) +", "m", r"\Big]"),
             note="The sum over j counts the disturbance and nu_di once for each failed motor. Both terms together are "
                  "not positive, so that the bound survives. True as printed for n - k_nu = 1, as in case 3. All that "
                  "45.a finds wrong is left out here.")
def compensation_terms() -> Goal:
    """z_2 m_i k_nu (nu_s + nu_d) + z_2 m_i delta + z_2 d_i chi_di against the printed double sum."""
    return already(_compensated_51(2), {k_v: sp.Integer(14), m: sp.Integer(1), chi_d: sp.Integer(1)})


def unparameterized(laws: Flow) -> Flow:
    """(7), (8), (17) with (48)-(50) and the laws given; delta is the sum of the delta_j of failed motors."""
    return {**failed_train(signal_of(nu_failed + nu_s_sum) + delta / k_v), **laws}


def _bound_51(mended: bool) -> Goal:
    V, laws = (V_true, laws_true) if mended else (V_40, laws_printed)
    return Goal((at_most(D(V), decay),),
                (*filippov, *disturbed, *rest_bounds, at_most(chi_d, 1), at_least(m * k_v, rho_0)),
                unparameterized(laws), lemmas=within)


SUMS = "delta is the sum over the failed motors of delta_j, delta_0 that of delta_j^0. "


@paper.claim("51", "V_2 does not increase with unparameterizable failures: the whole argument", "inequality", BOUND,
             "refuted", premises=("17", "39", "25.idle"), rests_on=("44", "37.failures", "51.a", "49", "50"), scope=ALL_SIGNALS,
             where={"V_2": V_40}, closed_loop=True, reading=ALONE_44,
             note="The last line of (51), for |delta_j| <= delta_j^0, k_nu >= rho_knu^0 and what (45) asks. Mended as "
                  "51.mended. " + SUMS)
def v2_bound_unparameterized() -> Goal:
    """D(V_2) of (40) along (7), (8), (17) with (27)-(31), (37), (41), (44), (48)-(50)."""
    return at_instant(failing(_bound_51(mended=False)), {
        delta: sp.Integer(0), delta_0: sp.Integer(1), rho_k0: sp.Integer(1)})


@paper.claim("51.mended", "V_2 does not increase with unparameterizable failures, laws and weights mended", "inequality",
             MENDED_45, "proved", premises=("17", "39", "25.idle", "44.mended"), origin="ours", mends="51",
             scope=ALL_SIGNALS, note=REPAIR + SUMS)
def v2_bound_unparameterized_mended() -> Goal:
    """The same with (44) mended, the weights fitting."""
    return _bound_51(mended=True)


w_rate = sp.Symbol("Vdot_2", real=True)


def _rate_52(relation: Callable[[sp.Expr, sp.Expr], Relation]) -> Goal:
    return Goal((relation(w_rate, decay), at_most(decay, 0)), (at_most(w_rate, decay),))


RATE_52 = {r"\dot{V}_2": w_rate}


@paper.claim("52", "V_2 decreases at exactly this rate", "implication",
             r"\dot{V}_2 = -r_1z_1^2(t) - r_2z_2^2(t) \leq 0", "gap", rests_on=("51",), severity="cosmetic",
             where=RATE_52, reading="What follows from (51), taken as true.",
             note="(51) gives at most, not equality; only that is used.")
def rate_52() -> Goal:
    """The equality from the bound of (51)."""
    return _rate_52(equal)


@paper.claim("52.glyph", "V_2 decreases at least at this rate", "implication",
             r"\dot{V}_2 \leq -r_1z_1^2(t) - r_2z_2^2(t) \leq 0", "proved", origin="ours", mends="52", where=RATE_52,
             note="What follows from (51), taken as true.")
def rate_52_at_most() -> Goal:
    """The inequality, and its sign."""
    return _rate_52(at_most)


@paper.claim("theorem3", "Theorem 3: the position error tends to zero with unparameterizable failures", "limit",
             THEOREM % ("(48), with the signals (32)-(33) and (49)-(50), and adaptive scheme (27)-(31), (37), (41), and (44)",
                        "(7)-(8) under actuator failures (16)", "the "), "refuted",
             match="words", severity="result", closed_loop=True, rests_on=("52", "47.signal", "48.pattern", "49", "50"), scope=ALL_SIGNALS,
             reading=SQUARE_IN_TIME + "Decided as z_1^2 <= 1/4 from some time on.",
             note="False as printed: " + STEADY_STATE_ERROR % LAWS + "The bound delta_j^0 is 1, delta_j is 0. With a plus in (44) "
                  "it holds as theorem3.mended states.")
def theorem_3() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    one = sp.Integer(1)
    return steady_state_error(at_most(z_1**2, epsilon), nu_failed + nu_s_sum,
                              {epsilon: sp.Rational(1, 4), lambda_0: one, delta: sp.Integer(0), delta_0: one,
                               rho_k0: sp.Integer(15)}, *disturbed, *rest_bounds, extra_force=delta)


@paper.claim("theorem3.mended", "Theorem 3 with a plus in (44), one mass in all modes and a sum that is known", "implication",
             r"\text{Theorem 3 with } \dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi\text{, the sum in (48) over the}\ "
             r"\bar n\ \text{motors with the largest}\ \delta_j^0" + ONE_MASS + BOUNDED, "proved",
             origin="ours", mends="theorem3", severity="result", scope=ALL_SIGNALS, reading=TRACKS, note=REPAIR,
             premises=("51.mended", "40.mended", "46.jump", "25.switch", "filippov", "theorem1.rate", "theorem1.bounded",
                       "47.signal.mended", "barbalat"))
def theorem_3_mended() -> Goal:
    """From what (51) mended and (40) mended show of V_2 alone."""
    return tracks(V_true, paper.shown("51.mended"), paper.shown("40.mended"))

"""yang2021, section 5.2: the rate of V, its bound, and what (51) makes of V."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import neuron, over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal, greater, less
from workbench.trains.train import a_star

from ..error_dynamics import (
    EVERY_NETWORK,
    W_star,
    W_tilde,
    e_1,
    e_2,
    eps_star,
    epsilon,
    flow,
    h,
    lambdas,
    sigmas,
    stars,
    tildes,
    x_2_errors,
)
from ..laws import alpha, beta, chi, k
from ..lyapunov import V, V_1_rate, V_rate, barrier, bound_48, error_bound, inside, l_, l_stated, leak, mu, slowest
from ..paper import paper
from .section_5_1 import e_2_rate


@paper.claim("38", "V is not negative", "inequality", r"V \ge 0", "proved", premises=("20",), scope=EVERY_NETWORK)
def lyapunov_not_negative() -> Goal:
    """The barrier and squares with positive weights."""
    return Goal((at_least(V, 0),), (inside,))


estimate_rates = sp.symbols("adot_hat bdot_hat cdot_hat", real=True)
W_rate = sp.IndexedBase("Wdot_hat", real=True)[neuron]


@paper.claim("39", "Rate of V before the laws are put in", "identity",
             r"\dot V = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\dot e_2 + "
             r"\tfrac1\chi\tilde W^T\dot{\tilde W} + \tfrac1{\lambda_1}\tilde a\dot{\tilde a} + "
             r"\tfrac1{\lambda_2}\tilde b\dot{\tilde b} + \tfrac1{\lambda_3}\tilde c\dot{\tilde c}", "proved",
             premises=("31",), scope=EVERY_NETWORK)
def v_rate_open() -> Goal:
    """D(V) with free rates of e_2 and of the estimates."""
    along = {e_1: flow[e_1], e_2: e_2_rate, W_tilde: W_rate, **dict(zip(tildes, estimate_rates, strict=True))}
    stated = V_1_rate + e_2 * e_2_rate + over_neurons(W_tilde * W_rate / chi) + sum(
        (x * rate / lam for x, rate, lam in zip(tildes, estimate_rates, lambdas, strict=True)), sp.Integer(0))
    return Goal((equal(D(V), stated),), (inside,), along)


resistance_error = tildes[0] + tildes[1] * x_2_errors + tildes[2] * x_2_errors**2


@paper.claim("40", "Rate of the speed error in closed loop", "identity",
             r"\dot e_2 = \tilde a + \tilde b x_2 + \tilde c x_2^2 - \beta e_2 - \frac{e_1}{k^2 - e_1^2} - "
             r"\tilde W^T h(x) + \varepsilon(x)", "proved", premises=("17", "25"), scope=EVERY_NETWORK)
def speed_error_rate_closed() -> Goal:
    """D(e_2) with (33) put in."""
    stated = resistance_error - beta * e_2 - e_1 / (k**2 - e_1**2) - over_neurons(W_tilde * h) + epsilon
    return Goal((equal(D(e_2), stated),), (inside,), flow)


@paper.claim("41", "Rate of V in closed loop", "identity",
             r"\dot V = -\frac{\alpha e_1^2}{k^2 - e_1^2} - \beta e_2^2 + e_2\varepsilon(x) - \tilde W^T\hat W - "
             r"\sigma_1\tilde a\hat a - \sigma_2\tilde b\hat b - \sigma_3\tilde c\hat c", "proved",
             premises=("39", "40"), scope=EVERY_NETWORK,
             note="The text has a dotted W-tilde in the last terms of (41) and on the left of (44); (37), and the "
                  "middle of (44), force W-hat, which is read here.")
def v_rate_closed() -> Goal:
    """D(V) along the whole closed loop, from (38), (4), (33)-(37)."""
    return Goal((equal(D(V), V_rate),), (inside,), flow)


def _step_42(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(-alpha * e_1**2 / (k**2 - e_1**2), -alpha * sp.log(barrier)),), (inside,))


@paper.claim("42", "Lemma 2 applied", "inequality",
             r"-\frac{\alpha e_1^2}{k^2 - e_1^2} < -\alpha\log\frac{k^2}{k^2 - e_1^2}", "refuted", premises=("21",),
             correction=lambda: _step_42(strict=False),
             corrected_statement=r"-\frac{\alpha e_1^2}{k^2 - e_1^2} \le -\alpha\log\frac{k^2}{k^2 - e_1^2}",
             note="As Lemma 2: equality at e_1 = 0.")
def step_42() -> Goal:
    """The strict inequality as printed."""
    return _step_42(strict=True)


@paper.claim("43", "Young's inequality for the approximation error", "inequality",
             r"e_2\varepsilon(x) \le \tfrac12 e_2^2 + \tfrac12\varepsilon^{*2}", "proved", premises=("7",))
def young_error() -> Goal:
    """With |epsilon| <= epsilon*."""
    return Goal((at_most(e_2 * epsilon, e_2**2 / 2 + eps_star**2 / 2),), error_bound)


@paper.claim("44", "Young's inequality for the weights", "inequality",
             r"-\tilde W^T\hat W = -\tilde W^T\tilde W - \tilde W^T W^* \le -\tfrac12\tilde W^T\tilde W + "
             r"\tfrac12 W^{*2}", "proved", scope=EVERY_NETWORK,
             note="W-hat is read on the left, see (41).")
def young_weights() -> Goal:
    """Term by term under the sum; both the equality and the bound."""
    left = -over_neurons(W_tilde * (W_tilde + W_star))
    middle = -over_neurons(W_tilde**2) - over_neurons(W_tilde * W_star)
    return Goal((equal(left, middle),
                 at_most(left, -over_neurons(W_tilde**2) / 2 + over_neurons(W_star**2) / 2)))


def _young_estimate(equation: str, i: int, name: str) -> None:
    sigma, tilde, star = sigmas[i], tildes[i], stars[i]
    n = i + 1

    @paper.claim(equation, f"Young's inequality for the estimate of {name}", "inequality",
                 rf"-\sigma_{n}\tilde {name}\hat {name} \le -\tfrac12\sigma_{n}\tilde {name}^2 + "
                 rf"\tfrac12\sigma_{n} {name}^{{*2}}", "proved")
    def young() -> Goal:
        return Goal((at_most(-leak[i], -sigma * tilde**2 / 2 + sigma * star**2 / 2),))


_young_estimate("45", 0, "a")
_young_estimate("46", 1, "b")
_young_estimate("47", 2, "c")


@paper.claim("48", "Bound of the rate of V", "implication",
             r"\dot V \le -\alpha\log\frac{k^2}{k^2-e_1^2} - (\beta-\tfrac12)e_2^2 - \tfrac12\tilde W^T\tilde W - "
             r"\tfrac12\sigma_1\tilde a^2 - \tfrac12\sigma_2\tilde b^2 - \tfrac12\sigma_3\tilde c^2 + "
             r"\tfrac12\varepsilon^{*2} + \tfrac12 W^{*2} + \tfrac12\sigma_1a^{*2} + \tfrac12\sigma_2b^{*2} + "
             r"\tfrac12\sigma_3c^{*2}", "proved", premises=("41", "42", "43", "44", "45", "46", "47"),
             scope=EVERY_NETWORK,
             note="The non-strict form of (42) suffices, so this bound stands although (42) as printed is false.")
def rate_bound() -> Goal:
    """The right side of (41), by the tangent of the logarithm and completed squares."""
    return Goal((at_most(V_rate, bound_48),), (inside, *error_bound))


def minimum_is_positive(*extra: Relation) -> Goal:
    """(49): every entry of the minimum, for gains that are positive and as `extra` says."""
    return Goal(tuple(greater(r.right, 0) for r in slowest), extra)


@paper.claim("49", "Positive gains make mu positive", "implication",
             r"\alpha, \beta, \chi, \lambda_i, \sigma_i > 0 \Rightarrow \mu = \min[2\alpha, 2\beta-1, \chi, "
             r"\lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] > 0", "gap",
             correction=lambda: minimum_is_positive(greater(beta, sp.Rational(1, 2))),
             corrected_statement=r"\alpha, \chi, \lambda_i, \sigma_i > 0,\ \beta > \tfrac12 \Rightarrow \mu > 0",
             note="The paper asks for beta > 0 below (37); (52) divides by mu and needs mu > 0, hence beta > 1/2. The "
                  "paper leaves mu > 0 to the choice of gains, and the stated beta = 0.51 meets it, by little.")
def positive_minimum() -> Goal:
    """Every entry of the minimum, for all positive gains."""
    return minimum_is_positive()


@paper.claim("50", "l is positive, as Lemma 1 asks, for a train with resistance", "implication",
             r"a^* \ne 0 \Rightarrow l = \tfrac12\varepsilon^{*2} + \tfrac12W^{*2} + \tfrac12\sigma_1a^{*2} + \tfrac12\sigma_2b^{*2} + "
             r"\tfrac12\sigma_3c^{*2} > 0", "proved", scope=EVERY_NETWORK,
             note="Without any resistance, weights and error l = 0, and Lemma 1 does not apply as printed.")
def offset_positive() -> Goal:
    """Squares, one of them not zero."""
    return Goal((greater(l_stated, 0),), (differ(a_star, 0),))


@paper.claim("51", "V decays up to l", "implication",
             r"\mu = \min[2\alpha, 2\beta-1, \chi, \lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] "
             r"\Rightarrow \dot V \le -\mu V + l", "proved", premises=("48", "50"), scope=EVERY_NETWORK,
             note="With (49) and (50), for mu > 0; see 49 for when it is.")
def decay() -> Goal:
    """The right side of (48): every term of V decays at least at the rate mu."""
    return Goal((at_most(bound_48, -mu * V + l_stated),), (inside, *slowest))


@paper.claim("51.whole", "V decays up to l: the whole argument in one certificate", "implication",
             r"\dot V \le -\mu V + l\ \text{along (4), (27), (33)-(37) with (7)}", "proved",
             premises=("7",), scope=EVERY_NETWORK,
             note="The checker derives V' from (38), the plant and the laws by itself and re-checks every step "
                  "down to (51), without resting on the paper's intermediate lines.")
def decay_whole() -> Goal:
    """D(V) along the closed loop against -mu V + l."""
    return Goal((at_most(D(V), -mu * V + l_stated),), (inside, *error_bound, *slowest), flow,
                lemmas=(at_most(epsilon**2, eps_star**2), at_most(D(V), bound_48)))


zeta, V_now = sp.symbols("zeta V", real=True)


def _invariant(numerator: sp.Expr) -> Goal:
    return Goal((less(-mu * V_now + l_, 0),),
                (greater(zeta, 0), greater(mu, numerator / zeta), greater(V_now, zeta)))


@paper.claim("51.zeta.l", "mu > l/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow \dot V \le -\mu V + l < 0", "proved", premises=("51",),
             note="With the letter l in the numerator, which (51) forces; see 51.zeta. Later claims rest on this one.")
def invariant_set() -> Goal:
    """-mu V + l < 0 above zeta."""
    return _invariant(l_)


@paper.claim("51.zeta", "mu > 1/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{1}{\zeta},\ V > \zeta \Rightarrow \dot V \le -\mu V + l < 0", "refuted", premises=("51",),
             correction=lambda: _invariant(l_),
             corrected_statement=r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow -\mu V + l < 0",
             note="As the extracted text has it, with the digit 1. It tells l from 1 in (52) to (57), so the digit is "
                  "taken as printed; should the page show the letter l, this is no erratum, and 51.zeta.l holds.")
def invariant_set_digit() -> Goal:
    """-mu V + l may be positive above zeta when l is large."""
    return _invariant(sp.Integer(1))


t, V_t, w, V_0 = sp.symbols("t V_t w V_0", real=True)
decaying = (at_most(w, -mu * V_t + l_), at_least(t, 0))
along_v = {t: sp.Integer(1), V_t: w}
from_zero = {t: sp.Integer(0), V_t: V_0}


@paper.claim("52", "Bound of V", "implication",
             r"0 \le V(t) \le \frac{l}{\mu} + \left[V(0) - \frac{l}{\mu}\right]e^{-\mu t}", "proved",
             premises=("51", "38"),
             note="For mu > 0: exp(mu t)(V - l/mu) does not increase. 0 <= V is 38.")
def comparison() -> Goal:
    """For every V with V' <= -mu V + l at all times."""
    return Goal((at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t)),), (), along_v, decaying, from_zero,
                decreasing=sp.exp(mu * t) * (V_t - l_ / mu), inputs=(w,))


@paper.claim("52.T", "From some time on V is at most l/mu", "limit",
             r"\exists T\ \forall t > T:\ 0 \le V(t) \le \frac{l}{\mu}", "gap", premises=("52",),
             correction=lambda: _converges(V_t, sp.Integer(1), V_t),
             corrected_statement=r"\forall\delta>0\ \exists T\ \forall t > T:\ V(t) \le \frac{l}{\mu} + \delta",
             note="(52) lets V stay above l/mu for ever: V = 1 + exp(-t) obeys V' <= -V + 1 and never comes down "
                  "to 1. True is the limit: V comes below l/mu + delta, for every delta > 0.")
def reached_in_finite_time() -> Goal:
    """V(t) = 1 + exp(-t) with mu = l = 1."""
    one = sp.Integer(1)
    return Goal((at_most(V_t, l_ / mu),), (), along_v, decaying, from_zero, eventually=t,
                model={V_t: 1 + sp.exp(-t), mu: one, l_: one, V_0: sp.Integer(2)}, inputs=(w,))


C, delta = sp.symbols("C delta", positive=True)


def _converges(whole: sp.Expr, factor: sp.Expr, bounded: sp.Expr) -> Goal:
    """bounded <= factor l/mu + delta once t >= factor C/(delta mu), when whole <= l/mu + C exp(-mu t)."""
    late = at_least(t, factor * C / (delta * mu))
    below = at_most(whole, l_ / mu + C * sp.exp(-mu * t))
    domain = (inside,) if whole.has(e_1) else ()
    return Goal((at_most(bounded, factor * l_ / mu + delta),), (*domain, late, below))


def _ultimate_bound(equation: str, name: str, factor: sp.Expr, square: sp.Expr, latex: str) -> None:
    @paper.claim(equation, f"Compact set of {name}", "limit",
                 rf"{latex} \to \left\{{|{latex}| \le \sqrt{{\tfrac{{{sp.latex(factor)} l}}{{\mu}}}}\right\}}", "proved",
                 premises=("52",), scope=EVERY_NETWORK,
                 note="Decided in squares and as a limit with the time named: |.|^2 <= (bound)^2 + delta for all "
                      "t >= T(delta). The paper argues through the finite T of (52), which is not needed.")
    def ultimate() -> Goal:
        return _converges(V, factor, square)


_ultimate_bound("53", "e_2", sp.Integer(2), e_2**2, "e_2")
_ultimate_bound("54", "the weights", 2 * chi, over_neurons(W_tilde**2), r"\tilde W")
_ultimate_bound("55", "the estimate of a", 2 * lambdas[0], tildes[0] ** 2, r"\tilde a")
_ultimate_bound("56", "the estimate of b", 2 * lambdas[1], tildes[1] ** 2, r"\tilde b")
_ultimate_bound("57", "the estimate of c", 2 * lambdas[2], tildes[2] ** 2, r"\tilde c")

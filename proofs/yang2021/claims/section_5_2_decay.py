"""yang2021, section 5.2: the bound of the rate of V, (48)-(51), and what it makes of V, (52)-(57)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal, greater, less
from workbench.trains.train import a_star

from ..error_dynamics import (
    EVERY_NETWORK,
    W_tilde,
    e_2,
    eps_star,
    epsilon,
    flow,
    lambdas,
    sigmas,
    tildes,
)
from ..laws import alpha, beta, chi
from ..lyapunov import (
    V_0,
    V,
    V_now,
    V_rate,
    V_t,
    V_t_rate,
    along_v,
    barrier,
    bound_48,
    decaying,
    error_bound,
    from_zero,
    inside,
    l_,
    l_stated,
    mu,
    slowest,
    t,
    zeta,
)
from ..paper import paper
from .section_5_2 import CONSTANT

L = r"\frac{1}{2}\varepsilon^{*2} + \frac{1}{2}\mathbf{W}^{*2} + \frac{1}{2}\sigma_1a^{*2} + \frac{1}{2}\sigma_2b^{*2} + " \
    r"\frac{1}{2}\sigma_3c^{*2}"


@paper.claim("48", "Bound of the rate of V", "implication",
             r"\dot{V} \leq -\alpha \log \frac{k^2}{k^2 - e_1^2} - (\beta - \frac{1}{2})e_2^2 - "
             r"\frac{1}{2}\tilde{\mathbf{W}}^T\tilde{\mathbf{W}} - \frac{1}{2}\sigma_1\tilde{a}^2 - \frac{1}{2}\sigma_2\tilde{b}^2 - "
             rf"\frac{{1}}{{2}}\sigma_3\tilde{{c}}^2 + {L}", "proved",
             premises=("41.glyph", "42.mended", "43", "44.glyph", "45", "46", "47"),
             rests_on=("41.glyph", "42", "43", "44.glyph", "45", "46", "47"), scope=CONSTANT,
             where={r"\dot{V}": V_rate}, reading="The rate of V is the last line of (41), with W-hat.",
             note="The non-strict form of (42) suffices, so this bound stands although (42) as printed is false.")
def rate_bound() -> Goal:
    """The rate of V by (41), the tangent of the logarithm and completed squares."""
    return Goal((at_most(V_rate, bound_48),), (inside, *error_bound))


def minimum_is_positive(*extra: Relation) -> Goal:
    """(49): every entry of the minimum, for gains that are positive and as `extra` says."""
    return Goal(tuple(greater(r.right, 0) for r in slowest), extra)


paper.definition("49", "The rate mu",
                 r"\mu = \min[2\alpha, 2\beta - 1, \chi, \lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3]")


@paper.claim("49.positive", "mu is positive where beta is above 1/2 and the other gains are positive", "implication",
             r"\alpha, \chi, \lambda_i, \sigma_i > 0,\ \beta > \tfrac12 \Rightarrow \mu = \min[2\alpha, 2\beta-1, \chi, "
             r"\lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] > 0", "proved", origin="ours",
             note="Below (37) the text prints beta > 0, and after (51) it selects gains with mu > l/zeta, which have beta > 1/2, as the stated 0.51 is: worth printing beside beta > 0. "
                  "With another split of (43) every beta > 0 would do: 51.beta.")
def positive_minimum() -> Goal:
    """Every entry of the minimum."""
    return minimum_is_positive(greater(beta, sp.Rational(1, 2)))


paper.definition("50.definition", "The bound l",
                 r"l = \frac{1}{2}\varepsilon^{*2} + \frac{1}{2}\mathbf{W}^{*2} + \frac{1}{2}\sigma_1a^{*2} + \frac{1}{2}\sigma_2b^{*2} + \frac{1}{2}\sigma_3c^{*2}")


@paper.claim("50", "l is positive, as Lemma 1 asks", "implication", r"l > 0", "proved", scope=EVERY_NETWORK, origin="implied",
             where={"l": l_stated}, reading="l of (50) in (19), for a train that resists at standstill.",
             note="Without any resistance, weights and error l = 0, and Lemma 1 does not apply as printed.")
def offset_positive() -> Goal:
    """Squares, one of them not zero."""
    return Goal((greater(l_stated, 0),), (differ(a_star, 0),))


bracket = (sp.log(barrier) / 2 + e_2**2 / 2 + over_neurons(W_tilde**2) / (2 * chi) + sum(
    (tilde**2 / (2 * lam) for tilde, lam in zip(tildes, lambdas, strict=True)), sp.Integer(0)))


@paper.claim("51", "V decays up to l", "implication",
             r"\dot{V} \leq -\mu[\frac{1}{2} \log \frac{k^2}{k^2 - e_1^2} + \frac{1}{2}e_2^2 + "
             r"\frac{1}{2\chi}\tilde{\mathbf{W}}^T\tilde{\mathbf{W}} + \frac{1}{2\lambda_1}\tilde{a}^2 + "
             r"\frac{1}{2\lambda_2}\tilde{b}^2 + \frac{1}{2\lambda_3}\tilde{c}^2] + l \leq -\mu V + l", "proved",
             premises=("48",), rests_on=("48",), scope=CONSTANT, where={"l": l_stated, r"\dot{V}": V_t_rate},
             reading="For every rate of V that obeys (48); mu is at most every entry of (49), and l is (50).",
             note="For mu > 0; see 49.positive for when it is.")
def decay() -> Goal:
    """From (48): every term of V decays at least at the rate mu."""
    held = -mu * bracket + l_stated
    obeyed = tuple(r.subs({V_rate: V_t_rate}) for r in paper.shown("48"))
    return Goal((at_most(V_t_rate, held), at_most(held, -mu * V + l_stated)), (inside, *slowest, *obeyed))


@paper.claim("51.whole", "V decays up to l: the whole argument in one certificate", "implication",
             r"\dot{V} \leq -\mu V + l\ \text{along (4), (27), (33)-(37) with (7)}", "proved", origin="ours",
             premises=("7.bounded",), rests_on=(), scope=CONSTANT,
             note="The checker derives V' from (38), the plant and the laws by itself and re-checks every step "
                  "down to (51), without resting on the paper's intermediate lines.")
def decay_whole() -> Goal:
    """D(V) along the closed loop against -mu V + l."""
    return Goal((at_most(D(V), -mu * V + l_stated),), (inside, *error_bound, *slowest), flow,
                lemmas=(at_most(epsilon**2, eps_star**2), at_most(D(V), bound_48)))


any_beta = (slowest[0], at_most(mu, beta), *slowest[2:])
l_beta = l_stated - eps_star**2 / 2 + eps_star**2 / (2 * beta)


@paper.claim("51.beta", "With beta > 0 alone V decays up to another l", "implication",
             r"\dot V \le -\mu V + l,\ \mu = \min[2\alpha, \beta, \chi, \lambda_i\sigma_i],\ l = \tfrac{\varepsilon^{*2}}{2\beta} + \tfrac12W^{*2} + "
             r"\tfrac12\sigma_1a^{*2} + \tfrac12\sigma_2b^{*2} + \tfrac12\sigma_3c^{*2}", "proved", origin="ours", premises=("7.bounded",), rests_on=(), scope=CONSTANT,
             note="By e_2 eps <= beta e_2^2/2 + eps*^2/(2 beta) in place of (43). At the stated beta = 0.51 the entry is 0.51 instead of 0.02, at about twice the price of eps*.")
def decay_for_any_beta() -> Goal:
    """D(V) along the closed loop with the other split of e_2 eps."""
    split = beta * e_2**2 / 2 + eps_star**2 / (2 * beta)
    return Goal((at_most(D(V), -mu * V + l_beta),), (inside, *error_bound, *any_beta), flow,
                lemmas=(at_most(epsilon**2, eps_star**2), at_most(e_2 * epsilon, split),
                        at_most(D(V), bound_48 - eps_star**2 / 2 - e_2**2 / 2 + split)))


def _gains(share: sp.Expr) -> Goal:
    """Gains whose mu is above share/zeta for any zeta."""
    chosen = (equal(mu, share / zeta + 1), equal(alpha, mu / 2), equal(beta, (1 + mu) / 2), equal(chi, mu),
              *(equal(lam, mu) for lam in lambdas), *(equal(s, 1) for s in sigmas))
    return Goal((*slowest, greater(mu, share / zeta)), (greater(zeta, 0), *chosen))


WITNESS = "Such gains are sigma_i = 1, mu = 1 + 1/zeta, alpha = mu/2, beta = (1 + mu)/2, chi = lambda_i = mu."


@paper.claim("51.choice", "The text after (51): Gains with mu > 1/zeta, and with mu > l/zeta, can be chosen", "implication", r"\mu > \frac{1}{\zeta}", "proved",
             rests_on=("51",), glyph="51.choice.glyph", reading=f"For every zeta > 0. {WITNESS} With l for 1: 51.choice.glyph.")
def gains_can_be_chosen() -> Goal:
    """The entries of (49) and 1/zeta at the witness."""
    return _gains(sp.Integer(1))


@paper.claim("51.choice.glyph", "Gains with mu > l/zeta can be chosen", "implication", r"\mu > \frac{l}{\zeta}", "proved",
             origin="ours", glyph="51.choice",
             reading=WITNESS.replace("1/zeta", "l/zeta") + " Of the gains only sigma_i enter l, which may be any number.",
             note="With the letter l in the numerator; see 51.zeta.")
def gains_can_be_chosen_for_l() -> Goal:
    """The same with l of (50), which the gains sigma_i enter."""
    return _gains(l_)


OF_V = {"V": V_now, r"\dot{V}": V_t_rate}


def _invariant(numerator: sp.Expr) -> Goal:
    return Goal((less(V_t_rate, 0),), (greater(zeta, 0), at_most(V_t_rate, -mu * V_now + l_), greater(mu, numerator / zeta),
                                       greater(V_now, zeta)))


@paper.claim("51.zeta", "The text after (51): mu > 1/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{1}{\zeta},\ V > \zeta \Rightarrow \dot{V} < 0", "refuted", where=OF_V, rests_on=("51",), glyph="51.zeta.glyph",
             correction=lambda: _invariant(l_),
             corrected_statement=r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow \dot{V} < 0",
             reading="For every V with V' <= -mu V + l of (51): mu > 1/zeta can be satisfied; if V > zeta, then V' < 0.",
             note="The extracted text has the digit 1, and tells l from 1 in (52) to (57). With the letter l the line holds, "
                  "see 51.zeta.glyph.")
def invariant_set_digit() -> Goal:
    """-mu V + l may be positive above zeta when l is large."""
    return _invariant(sp.Integer(1))


@paper.claim("51.zeta.glyph", "mu > l/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow \dot{V} < 0", "proved", where=OF_V, origin="ours", glyph="51.zeta", rests_on=("51",),
             reading="For every V with V' <= -mu V + l of (51).", note="With the letter l in the numerator, which (51) forces.")
def invariant_set() -> Goal:
    """-mu V + l < 0 above zeta."""
    return _invariant(l_)


bound_52 = l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t)


@paper.claim("52", "Bound of V", "implication",
             r"0 \leq V(t) \leq \frac{l}{\mu} + [V(0) - \frac{l}{\mu}]\exp^{-\mu t}", "proved",
             premises=("38",), rests_on=("51", "38"), where={r"\exp^{-\mu t}": sp.exp(-mu * t)},
             reading="For every V with V' <= -mu V + l at all times, and V(t) = (38); exp^(-mu t) is e^(-mu t), and mu > 0.",
             note="exp(mu t)(V - l/mu) does not increase.")
def comparison() -> Goal:
    """For every V with V' <= -mu V + l at all times."""
    not_negative = tuple(r.subs({V: V_t}) for r in paper.shown("38"))
    return Goal((at_most(0, V_t), at_most(V_t, bound_52)), not_negative, along_v, decaying, from_zero,
                decreasing=sp.exp(mu * t) * (V_t - l_ / mu), inputs=(V_t_rate,))


C, delta = sp.symbols("C delta", positive=True)


@paper.claim("52.T.mended", "V comes below l/mu + delta, for every delta > 0", "limit",
             r"\forall\delta > 0\ \exists T\ \forall t > T: V(t) \leq \frac{l}{\mu} + \delta", "proved", origin="ours",
             mends="52.T", premises=("52",), rests_on=("52",), reading="T = C/(delta mu) with C at least V(0) - l/mu.")
def comes_near() -> Goal:
    """From (52)."""
    return Goal((at_most(V_t, l_ / mu + delta),),
                (at_least(t, C / (delta * mu)), at_least(C, V_0 - l_ / mu), paper.shown("52")[1]),
                lemmas=(at_most(sp.exp(-mu * t) * C, delta),))


def late() -> tuple[Relation, ...]:
    """(38) from the time on that 52.T.mended names."""
    return (inside, *(r.subs({V_t: V}) for r in paper.shown("52.T.mended")))


def _ultimate_bound(equation: str, name: str, printed: str, factor: sp.Expr, square: sp.Expr, letters: str) -> None:
    @paper.claim(equation, f"Compact set of {name}", "limit", printed, "proved", premises=("52.T.mended",),
                 rests_on=("52.T", "38"), scope=EVERY_NETWORK, match="words",
                 reading=f"{letters} converges to the set: its square comes below that of the bound and any delta beside it, "
                         "for good.",
                 note="The paper argues through the moment T of (52), which need not exist; that the distance to the set goes to zero does not need it.")
    def ultimate() -> Goal:
        return Goal((at_most(square, factor * (l_ / mu + delta)),), late())


def _printed_set(letter: str, inner: str) -> str:
    return (rf"\text{{${letter}$ converges to $\Omega_{{{letter}}} = \left\{{ {letter} \mid |{letter}| \leq "
            rf"\sqrt{{\frac{{{inner}l}}{{\mu}}}} \right\}}$}}")


_ultimate_bound("53", "e_2", _printed_set("e_2", "2"), sp.Integer(2), e_2**2, "e_2")
_ultimate_bound("54", "the weights", _printed_set(r"\tilde{\mathbf{W}}", r"2\chi "), 2 * chi, over_neurons(W_tilde**2), "W-tilde")
for _i, _name in enumerate("abc"):
    _ultimate_bound(str(55 + _i), f"the estimate of {_name}", _printed_set(rf"\tilde{{{_name}}}", rf"2\lambda_{_i + 1} "),
                    2 * lambdas[_i], tildes[_i] ** 2, f"{_name}-tilde")

"""yang2021, section 5.2: the rate of V and what bounds its terms, (39)-(47)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import neuron, over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less

from ..error_dynamics import (
    EVERY_NETWORK,
    W_star,
    W_tilde,
    e_1,
    e_2,
    e_2_rate,
    eps_star,
    epsilon,
    f_true,
    flow,
    h,
    lambdas,
    sigmas,
    star_rates,
    stars,
    tildes,
    x_2_errors,
)
from ..laws import alpha, beta, chi, k
from ..lyapunov import V, V_1_rate, W_star_square, barrier, error_bound, inside, leak
from ..notation import W_hat
from ..paper import paper
from .section_5_1 import rdot_errors

paper.definition("38.definition", "The Lyapunov function",
                 r"V = \frac{1}{2}\log\frac{k^2}{k^2 - e_1^2} + \frac{1}{2}e_2^2 + \frac{1}{2\chi}\tilde{W}^T\tilde{W} + \frac{1}{2\lambda_1}\tilde{a}^2 + "
                 r"\frac{1}{2\lambda_2}\tilde{b}^2 + \frac{1}{2\lambda_3}\tilde{c}^2")


@paper.claim("38", "V is not negative", "inequality", r"V \geq 0", "proved", premises=("20",), origin="implied",
             scope=EVERY_NETWORK, note="Used in (52), which prints 0 <= V(t).")
def lyapunov_not_negative() -> Goal:
    """The barrier and squares with positive weights."""
    return Goal((at_least(V, 0),), (inside,))


estimate_rates = sp.symbols("rate_a rate_b rate_c", real=True)
W_rate = sp.IndexedBase("Wdot_tilde", real=True)[neuron]


@paper.claim("39", "Rate of V before the laws are put in", "identity",
             r"\dot{V} = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1e_2}{k^2 - e_1^2} + e_2\dot{e}_2 + "
             r"\frac{1}{\chi}\tilde{W}^T\dot{\tilde{W}} + \frac{1}{\lambda_1}\tilde{a}\dot{\tilde{a}} + "
             r"\frac{1}{\lambda_2}\tilde{b}\dot{\tilde{b}} + \frac{1}{\lambda_3}\tilde{c}\dot{\tilde{c}}", "proved",
             premises=("31",), scope=EVERY_NETWORK,
             where={r"\tilde{W}^T\dot{\tilde{W}}": over_neurons(W_tilde * W_rate)},
             note="Whatever the rates of the estimation errors are, of coefficients that vary too.")
def v_rate_open() -> Goal:
    """D(V) with free rates of e_2 and of the estimation errors."""
    along = {e_1: flow[e_1], e_2: e_2_rate, W_tilde: W_rate, **dict(zip(tildes, estimate_rates, strict=True))}
    stated = V_1_rate + e_2 * D(e_2) + over_neurons(W_tilde * W_rate) / chi + sum(
        (x * D(x) / lam for x, lam in zip(tildes, lambdas, strict=True)), sp.Integer(0))
    return Goal((equal(D(V), stated),), (inside,), along)


barrier_term = e_1 / (k**2 - e_1**2)
hats = tuple(tilde + star for tilde, star in zip(tildes, stars, strict=True))


def _davis(a: sp.Expr, b: sp.Expr, c: sp.Expr) -> sp.Expr:
    return a + b * x_2_errors + c * x_2_errors**2


f_hat = over_neurons(W_hat * h)
speed_rate = _davis(*tildes) - beta * e_2 - barrier_term - over_neurons(W_tilde * h) + epsilon


@paper.claim("40", "Rate of the speed error in closed loop", "identity",
             r"\dot{e}_2 = \hat{a} + \hat{b}x_2 + \hat{c}x_2^2 - \hat{f}(x) + \dot{r} - \beta e_2 - \frac{e_1}{k^2 - e_1^2} - a^* - "
             r"b^*x_2 - c^*x_2^2 + f(x) - \dot{r} = \tilde{a} + \tilde{b}x_2 + \tilde{c}x_2^2 + \tilde{f}(x) - \beta e_2 - "
             r"\frac{e_1}{k^2 - e_1^2} = \tilde{a} + \tilde{b}x_2 + \tilde{c}x_2^2 - \beta e_2 - \frac{e_1}{k^2 - e_1^2} - "
             r"\tilde{W}^Th(x) + \varepsilon(x)", "proved", premises=("17", "25", "33"), scope=EVERY_NETWORK,
             where={r"\hat{f}(x)": f_hat, "f(x)": f_true, r"\tilde{f}(x)": f_true - f_hat, r"\dot{r}": rdot_errors},
             reading="f is (7), f-hat is (16) and the rate of r is (28) in the errors.")
def speed_error_rate_closed() -> Goal:
    """D(e_2) with (33) put in."""
    first = (_davis(*hats) - f_hat + rdot_errors - beta * e_2 - barrier_term - _davis(*stars) + f_true - rdot_errors)
    second = _davis(*tildes) + f_true - f_hat - beta * e_2 - barrier_term
    return Goal((equal(D(e_2), first), equal(first, second), equal(second, speed_rate)), (inside,), flow)


@paper.claim("41.rates", "Where the coefficients vary the estimation errors do not move as the estimates do", "identity",
             r"\dot{\tilde{a}} = \dot{\hat{a}},\ \dot{\tilde{b}} = \dot{\hat{b}},\ \dot{\tilde{c}} = \dot{\hat{c}}", "refuted",
             origin="ours", reading="(41) puts (34)-(36) in for the rates of the errors; asked where a*, b* and c* move.",
             note="No fault of (41), whose coefficients are unknown values, a* = a_0/m and so on, as those of Theorem 1 are: for constant ones, however uncertain, the line holds. "
                  "The first objective of section 5 promises more, see objective.varying.")
def errors_move_as_estimates() -> Goal:
    """The rates of a_tilde and a_hat where a* moves."""
    moving = dict(zip(stars, star_rates, strict=True)) | {
        tilde: rate - of_star for tilde, rate, of_star in zip(tildes, estimate_rates, star_rates, strict=True)}
    return Goal(tuple(equal(D(tilde), D(tilde + star)) for tilde, star in zip(tildes, stars, strict=True)), flow=moving)


# A counterexample is a train with resistance, and its Gaussians lie between 0 and 1.
in_domain = (*(at_least(star, 0) for star in stars), greater(over_neurons(h), 0), at_least(over_neurons(h), over_neurons(h**2)))


def _v_rate_goal(last: sp.Expr, *domain: Relation) -> Goal:
    """(41) with `last` at the place that reads W-tilde with a dot in the extracted text."""
    start = V_1_rate + e_2 * speed_rate
    put_in = start + over_neurons(W_tilde * (chi * e_2 * h - chi * last)) / chi + sum(
        (tilde * (-lam * (regressor * e_2 + sigma * hat)) / lam for tilde, lam, regressor, sigma, hat in zip(
            tildes, lambdas, (1, x_2_errors, x_2_errors**2), sigmas, hats, strict=True)), sp.Integer(0))
    kept = -over_neurons(W_tilde * last)
    multiplied = start + e_2 * over_neurons(W_tilde * h) + kept + sum(
        (-regressor * tilde * e_2 - sigma * tilde * hat for tilde, regressor, sigma, hat in zip(
            tildes, (1, x_2_errors, x_2_errors**2), sigmas, hats, strict=True)), sp.Integer(0))
    end = (-alpha * e_1**2 / (k**2 - e_1**2) - beta * e_2**2 + e_2 * epsilon + kept - sum(leak, sp.Integer(0)))
    return Goal((equal(D(V), put_in), equal(put_in, multiplied), equal(multiplied, end)), (inside, *domain), flow)


def _printed_41(last: str) -> str:
    inner = (r"e_2[\tilde{a} + \tilde{b}x_2 + \tilde{c}x_2^2 - \beta e_2 - \frac{e_1}{k^2 - e_1^2} - \tilde{W}^Th(x) + "
             r"\varepsilon(x)]")
    start = rf"-\frac{{\alpha e_1^2}}{{k^2 - e_1^2}} + \frac{{e_1e_2}}{{k^2 - e_1^2}} + {inner}"
    return (rf"\dot{{V}} = {start} + \frac{{1}}{{\chi}}\tilde{{W}}^T[\chi e_2h(x) - \chi{last}] + "
            r"\frac{1}{\lambda_1}\tilde{a}[-\lambda_1(e_2 + \sigma_1\hat{a})] + \frac{1}{\lambda_2}\tilde{b}"
            r"[-\lambda_2(x_2e_2 + \sigma_2\hat{b})] + \frac{1}{\lambda_3}\tilde{c}[-\lambda_3(x_2^2e_2 + \sigma_3\hat{c})] "
            rf"= {start} + e_2\tilde{{W}}^Th(x) - \tilde{{W}}^T{last} - \tilde{{a}}e_2 - \sigma_1\tilde{{a}}\hat{{a}} - "
            r"\tilde{b}x_2e_2 - \sigma_2\tilde{b}\hat{b} - \tilde{c}x_2^2e_2 - \sigma_3\tilde{c}\hat{c} "
            rf"= -\frac{{\alpha e_1^2}}{{k^2 - e_1^2}} - \beta e_2^2 + e_2\varepsilon(x) - \tilde{{W}}^T{last} - "
            r"\sigma_1\tilde{a}\hat{a} - \sigma_2\tilde{b}\hat{b} - \sigma_3\tilde{c}\hat{c}")


DOTTED, HAT = r"\dot{\tilde{W}}", r"\hat{W}"
ON_THE_WAY_41 = ("34", "35", "36", "37", "39", "40")
CONSTANT = "every number of neurons and every hidden function, for constant a*, b*, c*"


def _where_41(last: str, value: sp.Expr) -> dict[str, sp.Expr]:
    return {rf"\tilde{{W}}^T[\chi e_2h(x) - \chi{last}]": over_neurons(W_tilde * (chi * e_2 * h - chi * value)),
            rf"\tilde{{W}}^T{last}": over_neurons(W_tilde * value)}


@paper.claim("41", "Rate of V in closed loop", "identity", _printed_41(DOTTED), "refuted", glyph="41.glyph",
             premises=("39", "40"), rests_on=ON_THE_WAY_41, scope=CONSTANT,
             where=_where_41(DOTTED, flow[W_tilde]),
             reading="The dotted W-tilde of the extracted text is the rate that (37) gives.",
             note="Where the text has W-tilde with a dot, (37) forces W-hat; the middle of (44) has it too. It may be a "
                  "misread accent: 41.glyph decides the line with W-hat.")
def v_rate_closed_dotted() -> Goal:
    """D(V) along the whole closed loop, with the rate of the weights in the last term."""
    return _v_rate_goal(flow[W_tilde], *in_domain)


@paper.claim("41.glyph", "Rate of V in closed loop, with W-hat", "identity", _printed_41(HAT), "proved", glyph="41",
             origin="ours", premises=("39", "40"), rests_on=ON_THE_WAY_41, scope=CONSTANT, where=_where_41(HAT, W_hat))
def v_rate_closed() -> Goal:
    """D(V) along the whole closed loop, from (38), (4), (33)-(37)."""
    return _v_rate_goal(W_hat)


def _step_42(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(-alpha * e_1**2 / (k**2 - e_1**2), -alpha * sp.log(barrier)),), (inside,))


@paper.claim("42", "Lemma 2 applied", "inequality",
             r"-\frac{\alpha e_1^2}{k^2 - e_1^2} < -\alpha \log \frac{k^2}{k^2 - e_1^2}", "refuted", rests_on=("21",),
             severity="cosmetic", correction=lambda: _step_42(strict=False),
             corrected_statement=r"-\frac{\alpha e_1^2}{k^2 - e_1^2} \le -\alpha\log\frac{k^2}{k^2 - e_1^2}",
             note="As Lemma 2: equality at e_1 = 0. (48) needs no more than the non-strict form.")
def step_42() -> Goal:
    """The strict inequality as printed."""
    return _step_42(strict=True)


@paper.claim("42.mended", "Lemma 2 applied, not strict", "inequality",
             r"-\frac{\alpha e_1^2}{k^2 - e_1^2} \leq -\alpha \log \frac{k^2}{k^2 - e_1^2}", "proved", origin="ours", mends="42",
             premises=("21.mended",))
def step_42_mended() -> Goal:
    """Lemma 2 without strictness, times alpha."""
    return Goal(_step_42(strict=False).show, (inside, *paper.shown("21.mended")))


@paper.claim("43", "Young's inequality for the approximation error", "inequality",
             r"e_2\varepsilon(x) \leq \frac{1}{2}e_2^2 + \frac{1}{2}\varepsilon^{*2}", "proved", premises=("7.bounded",),
             note="At all times for the eps* of 7.bounded, which contains f*; for that of (8) where x is in Theta_x.")
def young_error() -> Goal:
    """With |epsilon| <= epsilon*."""
    return Goal((at_most(e_2 * epsilon, e_2**2 / 2 + eps_star**2 / 2),), error_bound)


def _young_weights(left: sp.Expr, *domain: Relation) -> Goal:
    split = -over_neurons(W_tilde * W_hat)
    middle = -over_neurons(W_tilde**2) - over_neurons(W_tilde * W_star)
    return Goal((equal(-over_neurons(W_tilde * left), split), equal(split, middle),
                 at_most(middle, -over_neurons(W_tilde**2) / 2 + W_star_square / 2)), domain)


def _printed_44(left: str) -> str:
    return (rf"-\tilde{{W}}^T{left} = -\tilde{{W}}^T(\tilde{{W}} + W^*) = -\tilde{{W}}^T\tilde{{W}} - \tilde{{W}}^TW^* \leq "
            r"-\frac{1}{2}\tilde{W}^T\tilde{W} + \frac{1}{2}W^{*2}")


@paper.claim("44", "Young's inequality for the weights", "inequality", _printed_44(DOTTED), "refuted", scope=EVERY_NETWORK,
             glyph="44.glyph", where={rf"\tilde{{W}}^T{DOTTED}": over_neurons(W_tilde * flow[W_tilde])},
             reading="The dotted W-tilde of the extracted text is the rate that (37) gives.",
             note="As in (41): its own middle, W-tilde + W*, is W-hat.")
def young_weights_dotted() -> Goal:
    """With the rate of the weights on the left."""
    return _young_weights(flow[W_tilde], *in_domain[-2:])


@paper.claim("44.glyph", "Young's inequality for the weights, with W-hat", "inequality", _printed_44(HAT), "proved",
             scope=EVERY_NETWORK, origin="ours", glyph="44")
def young_weights() -> Goal:
    """Term by term under the sum; the equalities and the bound."""
    return _young_weights(W_hat)


def _young_estimate(equation: str, i: int, name: str) -> None:
    sigma, tilde, star = sigmas[i], tildes[i], stars[i]
    n = i + 1

    @paper.claim(equation, f"Young's inequality for the estimate of {name}", "inequality",
                 rf"-\sigma_{n}\tilde{{{name}}}\hat{{{name}}} \leq -\frac{{1}}{{2}}\sigma_{n}\tilde{{{name}}}^2 + "
                 rf"\frac{{1}}{{2}}\sigma_{n} {name}^{{*2}}", "proved")
    def young() -> Goal:
        return Goal((at_most(-leak[i], -sigma * tilde**2 / 2 + sigma * star**2 / 2),))


_young_estimate("45", 0, "a")
_young_estimate("46", 1, "b")
_young_estimate("47", 2, "c")

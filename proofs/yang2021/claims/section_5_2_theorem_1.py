"""yang2021, section 5.2: Theorem 1 and the sentences after (57)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Goal, at_least, at_most, equal, greater, less
from workbench.trains.train import a_star

from ..error_dynamics import (
    EVERY_NETWORK,
    W_star,
    W_tilde,
    e_1,
    e_2,
    lambdas,
    sigmas,
    stars,
    tildes,
)
from ..laws import alpha, beta, chi, k
from ..lyapunov import (
    V_0,
    V_1,
    V,
    V_t,
    W_star_square,
    barrier,
    inside,
    l_,
    level,
    mu,
    slowest,
    t,
    zeta,
)
from ..paper import paper
from .section_5_2_decay import delta, late


@paper.claim("theorem1.level", "V stays below V(0) + l/mu", "implication",
             r"V(t) \leq V(0) + \frac{l}{\mu}", "proved", premises=("52",), origin="ours")
def level_kept() -> Goal:
    """From (52), uniformly in t."""
    return Goal((at_most(V_t, V_0 + l_ / mu),), (at_least(V_0, 0), at_least(t, 0), paper.shown("52")[1]))


def _squares(bound: sp.Expr) -> list[tuple[sp.Expr, sp.Expr]]:
    """The square of each error but e_1, and what it is at most where V is at most a bound."""
    return [(e_2**2, 2 * bound), (over_neurons(W_tilde**2), 2 * chi * bound),
            *((tilde**2, 2 * lam * bound) for tilde, lam in zip(tildes, lambdas, strict=True))]


@paper.claim("theorem1.bounded", "All error signals and estimates are bounded", "implication",
             r"\text{all error signals $e_1, e_2, \tilde{\mathbf{W}}, \tilde{a}, \tilde{b}$, and $\tilde{c}$ are bounded; thus, "
             r"$\hat{\mathbf{W}}, \hat{a}, \hat{b}$, and $\hat{c}$ are bounded}", "proved", premises=("theorem1.level",),
             rests_on=("lemma1", "51"), scope=EVERY_NETWORK, match="words",
             reading="The squares of the errors by V(0) + l/mu at all times, and those of the estimates by these and the true "
                     "values; |e_1| < k is Lemma 1.",
             note="The second objective of section 5, that all closed-loop signals are bounded; the input follows, see A4.")
def bounded() -> Goal:
    """Every term of V is at most V."""
    bound = V_0 + l_ / mu
    errors = [at_most(square, most) for square, most in _squares(bound)]
    estimates = [at_most((tilde + star) ** 2, 4 * lam * bound + 2 * star**2)
                 for tilde, star, lam in zip(tildes, stars, lambdas, strict=True)]
    weights = at_most(over_neurons((W_tilde + W_star) ** 2), 4 * chi * bound + 2 * W_star_square)
    return Goal((*errors, *estimates, weights), (inside, *(r.subs({V_t: V}) for r in paper.shown("theorem1.level"))))


starting: dict[sp.Expr, sp.Expr] = {symbol: sp.Symbol(f"{symbol}_0", real=True) for symbol in (e_1, e_2, *tildes)}
W_start, V_start = over_neurons(W_tilde**2), V.xreplace(starting)


@paper.claim("theorem1.start", "The initial state of Theorem 1 is one with V(0) <= zeta", "implication",
             r"\frac{1}{2} \log \frac{k^2}{k^2 - e_1^2(0)} + \frac{1}{2}e_2^2(0) + \frac{1}{2\chi}\tilde{W}^2(0) + "
             r"\frac{1}{2\lambda_1}\tilde{a}^2(0) + \frac{1}{2\lambda_2}\tilde{b}^2(0) + \frac{1}{2\lambda_3}\tilde{c}^2(0) "
             r"\leq \zeta", "proved", rests_on=("38",), scope=EVERY_NETWORK,
             where={r"\zeta": V_start, "e_1^2(0)": starting[e_1]**2, "e_2^2(0)": starting[e_2]**2, r"\tilde{W}^2(0)": W_start,
                    **{rf"\tilde{{{name}}}^2(0)": starting[tilde]**2 for name, tilde in zip("abc", tildes, strict=True)}},
             reading="zeta is V(0) of (38), the least that the line allows, and what theorem1.zeta supposes to be at most zeta.",
             note="'zeta is any positive constant', says the text: of the initial state it is a condition, not a free choice.")
def initial_state() -> Goal:
    """(38) at the start against the printed sum."""
    a_0, b_0, c_0 = (starting[tilde] for tilde in tildes)
    stated = (sp.log(k**2 / (k**2 - starting[e_1]**2)) / 2 + starting[e_2]**2 / 2 + W_start / (2 * chi) + a_0**2 / (2 * lambdas[0])
              + b_0**2 / (2 * lambdas[1]) + c_0**2 / (2 * lambdas[2]))
    return Goal((at_most(stated, V_start),), (inside.subs(starting),))


@paper.claim("theorem1.zeta", "V(0) <= zeta keeps V <= zeta", "implication", r"V(0) \leq \zeta,\ t \geq 0 \Rightarrow V(t) \leq \zeta",
             "proved", premises=("52", "51.zeta.glyph"), rests_on=("51.choice", "51.zeta.glyph"),
             reading="With mu > l/zeta, as 51.zeta.glyph has it.")
def stays_below_zeta() -> Goal:
    """From (52)."""
    return Goal((at_most(V_t, zeta),),
                (greater(mu * zeta, l_), at_most(V_0, zeta), at_least(t, 0), paper.shown("52")[1]))


@paper.claim("theorem1.barrier", "The position error stays inside the constraint", "implication",
             r"V \text{ is bounded, and } |e_1| < k", "proved", premises=("theorem1.level",), rests_on=("lemma1", "51"), match="words",
             reading="A bound B of V_1 names the distance that is kept: e_1^2 <= k^2 (1 - exp(-2B)) < k^2.",
             note="Lemma 1 gives |e_1(t)| < k; V(0) + l/mu is such a bound.")
def distance_from_barrier() -> Goal:
    """A bound of V_1 is a bound of e_1 strictly inside k."""
    return Goal((at_most(e_1**2, k**2 * (1 - sp.exp(-2 * level))), less(k**2 * (1 - sp.exp(-2 * level)), k**2)),
                (inside, at_most(V_1, level)), facts=(2 * level - sp.log(barrier),))


@paper.claim("theorem1", "Theorem 1: with Assumption 1 struck, which no train of (4) meets and no proof uses, the tracking error converges to a neighbourhood set by the gains, and the loop is stable",
             "implication",
             r"\text{the tracking error will converge to a small enough neighborhood quantified by the designed control "
             r"parameter, whereby the FAO is stable}", "proved", severity="result", match="words", scope=EVERY_NETWORK,
             premises=("lemma1", "51.whole", "52.T.mended", "theorem1.barrier", "theorem1.bounded", "theorem1.speed"),
             rests_on=("lemma1", "51", "52", "53", "54", "55", "56", "57", "theorem1.bounded", "theorem1.zeta"),
             reading="From a time on, and for every delta > 0, log(k^2/(k^2 - e_1^2))/2, e_2^2/2, |W-tilde|^2/(2 chi), "
                     "a-tilde^2/(2 lambda_1) and so on are at most l/mu + delta, e_1^2 is at most k^2 (1 - exp(-2(l/mu + "
                     "delta))), and alpha^2 e_1^2 and the square of the speed's error x_2 - x_d' = e_2 - alpha e_1 are at most what theorem1.speed says; for "
                     "constant coefficients, which the theorem calls uncertain, and gains with mu > 0. eps* in l bounds eps wherever the train is (7.bounded), and so contains f*: the "
                     "smaller one of (8) is of Theta_x, and that x stays there is not shown.",
             note="It stands by V' <= -mu V + l (51.whole, along the loop itself) and the limit of (52). It needs neither Assumption 1, nor "
                  "strictness in Lemma 2, nor the moment T of (52), nor that the network approximates well. With (49) it needs mu > 0, and so beta > 1/2 (49.positive), where "
                  "the text below (37) has beta > 0; by another split of (43) every beta > 0 would do (51.beta). How small the "
                  "neighbourhood is at the stated gains is another matter, see 53.stated.")
def theorem_1() -> Goal:
    """All errors from the time on that 52.T.mended names."""
    near = l_ / mu + delta
    position, speed = paper.shown("theorem1.speed")
    return Goal((at_most(V_1, near), at_most(e_1**2, k**2 * (1 - sp.exp(-2 * near))), *(at_most(*pair) for pair in _squares(near)),
                 at_most(e_1**2, (2 * near + delta) / alpha**2), at_most(speed.left, 8 * near + 4 * delta)), (*late(), position, speed),
                facts=(2 * near - sp.log(barrier),))


wanted, wanted_position, wanted_speed = sp.symbols("rho rho_1 rho_2", positive=True)


@paper.claim("theorem1.small", "The text after (57): the tracking error can be made arbitrarily small by the gains", "implication",
             r"\text{the tracking error of the FAO can be adjusted to any small value by selecting the appropriate control "
             r"parameters}",
             "proved", severity="result", premises=("theorem1", "theorem1.speed"), rests_on=("53", "theorem1"), match="words",
             reading="For all rho_1 and rho_2 > 0 there are gains that meet (49) and with which the squares of the errors of position and speed come below rho_1 and rho_2, and any delta beside "
                     "them: sigma_i = 1, mu = 2l k^2/rho_1 + 8l/rho_2, alpha = mu/2, beta = (1 + mu)/2, chi = lambda_i = mu. Then k^2 (1 - exp(-2l/mu)), which bounds e_1^2, is at most rho_1, and "
                     "8l/mu, which by theorem1.speed bounds (x_2 - x_d')^2, at most rho_2.",
             note="Of the gains only sigma_i enter l. It does not extend to the estimates: by (54)-(57) their bounds contain "
                  "chi/mu >= 1 and lambda_i/mu >= 1/sigma_i.")
def arbitrarily_small() -> Goal:
    """The entries of (49) and the two bounds at the witness."""
    chosen = (equal(mu, 2 * l_ * k**2 / wanted_position + 8 * l_ / wanted_speed), equal(alpha, mu / 2), equal(beta, (1 + mu) / 2), equal(chi, mu),
              *(equal(lam, mu) for lam in lambdas), *(equal(s, 1) for s in sigmas))
    return Goal((*slowest, at_most(8 * l_, wanted_speed * mu), at_most(k**2 * (1 - sp.exp(-2 * l_ / mu)), wanted_position)), chosen,
                facts=(-2 * l_ / mu,), lemmas=(at_most(2 * l_ * k**2, wanted_position * mu),))


a_hat_start = sp.Symbol("a_hat_0", real=True)
start = dict(zip((*tildes, over_neurons(W_tilde**2)), sp.symbols("a_tilde_0 b_tilde_0 c_tilde_0 W_tilde_square_0", real=True),
                 strict=True))


def _influence() -> Goal:
    gains = (*lambdas, chi)
    squares = [s**2 for s in list(start.values())[:3]] + [sp.Symbol("W_tilde_square_0", nonnegative=True)]
    share = sum((square / (2 * gain) for square, gain in zip(squares, gains, strict=True)), sp.Integer(0))
    return Goal((at_most(share, wanted),), tuple(at_least(gain * wanted, 2 * square)
                                                 for square, gain in zip(squares, gains, strict=True)))


@paper.claim("theorem1.initial", "The text after (57): the initial estimation errors can be made arbitrarily small by the gains", "inequality",
             r"\text{the initial estimation errors $\tilde{\mathbf{W}}(0), \tilde{a}(0), \tilde{b}(0)$, and $\tilde{c}(0)$, and their "
             r"influence on the system performance can also be adjusted to any small value by selecting appropriate control "
             r"parameters}", "refuted", match="words",
             rests_on=(), correction=_influence,
             corrected_statement=r"\text{the influence of the initial estimation errors on } V(0):\ "
                                 r"\chi \ge \tfrac{2}{\rho}\tilde{W}^2(0),\ \lambda_1 \ge \tfrac{2}{\rho}\tilde{a}^2(0),\ \lambda_2 \ge \tfrac{2}{\rho}\tilde{b}^2(0),\ "
                                 r"\lambda_3 \ge \tfrac{2}{\rho}\tilde{c}^2(0) \Rightarrow \tfrac{1}{2\chi}\tilde{W}^2(0) + \tfrac{1}{2\lambda_1}\tilde{a}^2(0) + "
                                 r"\tfrac{1}{2\lambda_2}\tilde{b}^2(0) + \tfrac{1}{2\lambda_3}\tilde{c}^2(0) \le \rho",
             reading="|a-hat(0) - a*| <= rho for every rho > 0, whatever the gains: the first half of the sentence, on the "
                     "errors themselves.",
             note="No gain enters the initial errors, and that half of the sentence should be struck. At the stated a-hat(0) = 0.25 and a* = 0.3 the error is 0.05. Their "
                  "influence can be made small, see theorem1.initial.influence.")
def initial_errors() -> Goal:
    """The error in a at the start, which no gain changes."""
    return Goal((at_most(sp.Abs(a_hat_start - a_star), wanted),), (greater(a_star, 0),))


@paper.claim("theorem1.initial.influence", "The text after (57): the influence of the initial estimation errors on V(0) can be made arbitrarily small",
             "implication",
             r"\text{and their influence on the system performance can also be adjusted to any small value by selecting "
             r"appropriate control parameters}", "proved", premises=("52",), match="words",
             reading="Their influence is their share in V(0) of (52): at most rho for every rho > 0 when chi and every lambda_i "
                     "are at least 2/rho times the square of their error.")
def influence_of_initial_errors() -> Goal:
    """The shares of all four initial errors in V(0), for large enough gains."""
    return _influence()

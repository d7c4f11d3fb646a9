"""yang2021, section 5.2: Theorem 1, and Assumption 4 as what follows from it."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, differ, equal, greater, less
from workbench.trains.train import a_star

from ..error_dynamics import EVERY_NETWORK, e_1, lambdas, sigmas
from ..laws import alpha, beta, chi, k
from ..lyapunov import V_1, barrier, inside, l_, l_stated, level, mu, slowest
from ..paper import paper
from .section_5_2 import V_0, V_t, t, zeta


@paper.claim("theorem1.bounded", "All error signals are bounded", "implication",
             r"V(t) \le V(0) + \frac{l}{\mu}\ \forall t \ge 0", "proved", premises=("52",))
def bounded() -> Goal:
    """From (52), uniformly in t."""
    bound = at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t))
    return Goal((at_most(V_t, V_0 + l_ / mu),), (at_least(V_0, 0), at_least(t, 0), bound))


@paper.claim("theorem1.zeta", "V(0) <= zeta keeps V <= zeta", "implication",
             r"V(0) \le \zeta,\ \mu > \frac{l}{\zeta} \Rightarrow V(t) \le \zeta\ \forall t \ge 0", "proved",
             premises=("52", "51.zeta.l"))
def stays_below_zeta() -> Goal:
    """From (52)."""
    bound = at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t))
    return Goal((at_most(V_t, zeta),), (greater(mu * zeta, l_), at_most(V_0, zeta), at_least(t, 0), bound))


@paper.claim("theorem1.barrier", "The position error stays inside the constraint", "implication",
             r"V_1(t) \le B \Rightarrow e_1^2 \le k^2(1 - e^{-2B}) < k^2", "proved",
             premises=("theorem1.bounded", "lemma1"),
             note="Lemma 1 gives |e_1(t)| < k; a bound B of V names the distance that is kept.")
def distance_from_barrier() -> Goal:
    """A bound of V_1 is a bound of e_1 strictly inside k."""
    return Goal((at_most(e_1**2, k**2 * (1 - sp.exp(-2 * level))), less(k**2 * (1 - sp.exp(-2 * level)), k**2)),
                (inside, at_most(V_1, level)), facts=(2 * level - sp.log(barrier),))


@paper.claim("A4", "Assumption 4 follows: the barrier term of the input is bounded when V is", "implication",
             r"V_1 \le B \Rightarrow \frac{|e_1|}{k^2 - e_1^2} \le \frac{e^{2B}}{k}", "proved",
             premises=("theorem1.bounded",),
             note="Assumption 4 supposes a bounded input, which is for the proof to show: with all signals bounded the "
                  "other terms of (33) are, and this bounds the last one. At the stated gains B is above l/mu, "
                  "so the bound is of no use for choosing an actuator, and a saturated input voids (41).")
def input_bounded() -> Goal:
    """The last term of (33) against a bound of V_1."""
    inverse = 1 / (k**2 - e_1**2)
    most = sp.exp(2 * level) / k
    return Goal((at_most(e_1 * inverse, most), at_least(e_1 * inverse, -most)), (inside, at_most(V_1, level)),
                facts=(2 * level - sp.log(barrier),),
                lemmas=(at_most(inverse, most / k), at_most(e_1, k), at_least(e_1, -k)))


wanted = sp.Symbol("rho", positive=True)


@paper.claim("theorem1.small", "The bound of e_2 can be made arbitrarily small by the gains", "implication",
             r"\forall\rho > 0\ \exists\,\alpha,\beta,\chi,\lambda_i,\sigma_i:\ \frac{2l}{\mu} \le \rho", "proved",
             premises=("53",), scope=EVERY_NETWORK,
             note="Witness: sigma_i = 1, mu = 2l/rho, alpha = mu/2, beta = (1 + mu)/2, chi = lambda_i = mu. It does "
                  "not extend to the estimates: by (54)-(57) their bounds contain chi/mu >= 1 and "
                  "lambda_i/mu >= 1/sigma_i.")
def arbitrarily_small() -> Goal:
    """mu meets (49) with equality, and 2 l/mu = rho."""
    one = sp.Integer(1)
    l_one = l_stated.xreplace(dict.fromkeys(sigmas, one))
    rate = 2 * l_one / wanted
    gains = {alpha: rate / 2, beta: (1 + rate) / 2, chi: rate, **dict.fromkeys(lambdas, rate),
             **dict.fromkeys(sigmas, one), mu: rate}
    return Goal((*(equal(r.left.xreplace(gains), r.right.xreplace(gains)) for r in slowest),
                 equal(2 * l_one, wanted * rate), greater(rate, 0)), (differ(a_star, 0),))


first_error, lambda_any = sp.symbols("a_tilde_0 lambda_0", real=True)


@paper.claim("theorem1.initial", "The influence of the initial estimation errors can be made arbitrarily small",
             "implication",
             r"\forall\rho > 0\ \exists\lambda_1 > 0:\ \tfrac{1}{2\lambda_1}\tilde a(0)^2 \le \rho", "proved",
             premises=("52",),
             note="Their influence enters through V(0) in (52), where a large lambda_1 (lambda_2, lambda_3, chi alike) "
                  "makes their share small. Witness: any lambda_1 of at least a_tilde(0)^2/(2 rho). The initial "
                  "errors themselves, which the sentence also names, do not depend on the gains.")
def initial_errors() -> Goal:
    """The share of an initial error in V(0), for every large enough gain."""
    return Goal((at_most(first_error**2 / (2 * lambda_any), wanted),),
                (greater(lambda_any, 0), at_least(lambda_any, first_error**2 / (2 * wanted))))

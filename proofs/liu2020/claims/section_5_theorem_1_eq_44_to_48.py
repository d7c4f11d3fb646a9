"""Section 5, Theorem 1: the decay of V_1, (44)-(48), and the theorem."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from ..error_dynamics import (
    W_f_off,
    W_v_off,
    delta,
    delta_off,
    delta_tilde,
    eps_tilde,
    observer_loop,
    one_neuron,
    t,
    theta,
    theta_off,
)
from ..laws import alpha_1, beta_1, g_f, k_1, k_2, k_3, kappa_1, s_tilde, sigma_f, v_tilde
from ..lyapunov import (
    V_1,
    V_f,
    bounded_by_eigenvalue,
    delta_size,
    lambda_f,
    mu,
    norm_f,
    positive,
    rates_1,
    rho,
    square_f,
)
from ..paper import EVERY_NETWORK, paper
from ..smooth_sign import constant, smooth_sign_facts
from .section_5_theorem_1_eq_41_to_43 import bound_43, delta_bounds, mu_1_stated, slack, smooth_1

entry_1, entry_2 = sp.symbols("G_1 G_2", positive=True)
W_1, W_2 = sp.symbols("W_1 W_2", real=True)


def weights_decay_claim(equation: str, net: str, sigma: sp.Expr, eigenvalue: sp.Expr, norm: sp.Expr,
                        square: sp.Expr) -> None:
    """State which eigenvalue of the inverse gain of a network sets the rate of its weights."""
    g = rf"\Gamma_{net}^{{-1}}"

    @paper.claim(f"{equation}.weights", "The smallest eigenvalue of the inverse gain sets the weights' rate",
                 "inequality",
                 rf"\rho \le \frac{{\sigma_{net}}}{{\lambda_{{\min}}({g})}} \Rightarrow -\tfrac{{\sigma_{net}}}{{2}}"
                 rf"\|\tilde W_{net}\|^2 \le -\tfrac{{\rho}}{{2}}\tilde W_{net}^T{g}\tilde W_{net}", "refuted",
                 scope="two neurons, diagonal gain; the correction for every number of neurons and every gain matrix",
                 correction=lambda: Goal((at_most(-sigma / 2 * norm, -rho / 2 * square),),
                                         (at_most(rho * eigenvalue, sigma), bounded_by_eigenvalue(square, norm, eigenvalue))),
                 corrected_statement=rf"\rho \le \frac{{\sigma_{net}}}{{\lambda_{{\max}}({g})}} \Rightarrow "
                                     rf"-\tfrac{{\sigma_{net}}}{{2}}\|\tilde W_{net}\|^2 \le -\tfrac{{\rho}}{{2}}"
                                     rf"\tilde W_{net}^T{g}\tilde W_{net}",
                 note="Gamma_u in the text is taken for Gamma_f. The largest eigenvalue belongs here; the two agree only for "
                      "a gain that is a multiple of the identity. Costs speed, not the theorem.")
    def weights_decay() -> Goal:
        return Goal((at_most(-sigma / 2 * (W_1**2 + W_2**2), -rho / 2 * (entry_1 * W_1**2 + entry_2 * W_2**2)),),
                    (equal(eigenvalue, entry_1), at_most(entry_1, entry_2), at_most(rho * eigenvalue, sigma)))


weights_decay_claim("44", "f", sigma_f, lambda_f, norm_f, square_f)


def _estimate_decay(printed: bool) -> Goal:
    rate = at_most(rho, beta_1 / alpha_1) if printed else at_most(rho, alpha_1 * beta_1)
    return Goal((at_most(-beta_1 / 2 * delta_tilde**2, -rho * delta_tilde**2 / (2 * alpha_1)),), (rate,))


@paper.claim("44.estimate", "The rate of the estimate of delta", "inequality",
             r"\rho \le \frac{\beta_1}{\alpha_1} \Rightarrow -\tfrac{\beta_1}{2}\tilde\delta^2 \le "
             r"-\rho\frac{\tilde\delta^2}{2\alpha_1}", "refuted", correction=lambda: _estimate_decay(printed=False),
             corrected_statement=r"\rho \le \alpha_1\beta_1 \Rightarrow -\tfrac{\beta_1}{2}\tilde\delta^2 \le "
                                 r"-\rho\frac{\tilde\delta^2}{2\alpha_1}",
             note="Fails for alpha_1 < 1. (56) has the right entry, alpha_1 beta_1.")
def estimate_decay() -> Goal:
    """With the entry as printed."""
    return _estimate_decay(printed=True)


gain_f = greater(over_neurons(g_f**2), 0)  # not without any gain

smallest_f = at_least(square_f, lambda_f * norm_f)  # what the smallest eigenvalue means


@paper.claim("45", "V_1 decays up to mu_1", "implication",
             r"\rho_1 = \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\min}(\Gamma_f^{-1})}, \frac{\beta_1}{\alpha_1}"
             r"\right\} \Rightarrow \dot V_1 \le -\rho_1V_1 + \mu_1", "gap",
             premises=("43", "44.weights", "44.estimate"), scope=EVERY_NETWORK,
             correction=lambda: Goal((at_most(bound_43, -rho * V_1 + mu_1_stated),), (
                 *rates_1, at_most(rho, alpha_1 * beta_1), bounded_by_eigenvalue(square_f, norm_f, lambda_f))),
             corrected_statement=r"\rho_1 = \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, "
                                 r"\alpha_1\beta_1\right\} \Rightarrow \dot V_1 \le -\rho_1V_1 + \mu_1",
             note="From (43) with rho_1 of (44); see 44.weights and 44.estimate for the entries that fail.")
def decay_1() -> Goal:
    """The right side of (43) with the entries of (44) as printed."""
    return Goal((at_most(bound_43, -rho * V_1 + mu_1_stated),),
                (*rates_1, at_most(rho, beta_1 / alpha_1), smallest_f, gain_f))


V_t, V_start, w, level = sp.symbols("V_t V_0 w Theta", real=True)
decaying = (at_most(w, -rho * V_t + mu), at_least(t, 0))
along_v = {t: sp.Integer(1), V_t: w}
from_zero = {t: sp.Integer(0), V_t: V_start}
bound_47 = mu / rho + (V_start - mu / rho) * sp.exp(-rho * t)


def after_decay(i: int, decay: str, growth: str, bound: str, norm: str, not_negative: str) -> None:
    """What the paper concludes from V' <= -rho V + mu, the same for both theorems."""

    @paper.claim(f"{decay}.level", f"V_{i} does not grow at the level Theta_{i}", "implication",
                 rf"V_{i} = \Theta_{i},\ \rho_{i} > \frac{{\mu_{i}}}{{\Theta_{i}}} \Rightarrow \dot V_{i} \le 0", "proved",
                 premises=(decay,), note=r"Read with V_1 = Theta_1, as for V_2, where the text has 'in'." if i == 1 else "")
    def no_growth() -> Goal:
        return Goal((at_most(w, 0),), (greater(level, 0), greater(rho, mu / level), equal(V_t, level),
                                       at_most(w, -rho * V_t + mu)))

    @paper.claim(growth, f"Rate of V_{i} exp(rho t)", "implication",
                 rf"\frac{{d}}{{dt}}\left(V_{i}e^{{\rho_{i}t}}\right) \le e^{{\rho_{i}t}}\mu_{i}", "proved",
                 premises=(decay,), note="(45) is multiplied, not (43) as the text has it." if i == 1 else "")
    def growth_bound() -> Goal:
        return Goal((at_most(D(V_t * sp.exp(rho * t)), mu * sp.exp(rho * t)),), decaying, along_v)

    @paper.claim(bound, f"Bound of V_{i}", "implication",
                 rf"0 \le V_{i}(t) \le \varphi_{i} + (V_{i}(0) - \varphi_{i})e^{{-\rho_{i}t}},\quad \varphi_{i} = "
                 rf"\frac{{\mu_{i}}}{{\rho_{i}}}", "proved", premises=(growth, not_negative),
                 note=f"exp(rho t)(V - phi) does not increase. 0 <= V_{i} is {not_negative}.")
    def comparison() -> Goal:
        return Goal((at_most(V_t, bound_47),), (), along_v, decaying, from_zero,
                    decreasing=sp.exp(rho * t) * (V_t - mu / rho), inputs=(w,))

    @paper.claim(f"{bound}.level", f"V_{i}(0) <= Theta_{i} keeps V_{i} <= Theta_{i}", "implication",
                 rf"V_{i}(0) \le \Theta_{i},\ \rho_{i} > \frac{{\mu_{i}}}{{\Theta_{i}}} \Rightarrow V_{i}(t) \le "
                 rf"\Theta_{i}\ \forall t \ge 0", "proved", premises=(bound,))
    def stays_below() -> Goal:
        return Goal((at_most(V_t, level),), (greater(level, 0), greater(rho * level, mu), at_most(V_start, level),
                                             at_least(t, 0), at_most(V_t, bound_47)))

    @paper.claim(f"{norm}.zero", f"The errors of V_{i} become arbitrarily small as t goes to infinity", "limit",
                 rf"\forall c > 0\ \exists T\ \forall t > T:\ V_{i}(t) \le c", "gap", premises=(bound,),
                 correction=lambda: Goal((at_most(V_t, mu / rho + slack),), (
                     greater(slack, 0), at_least(V_start, 0), at_least(t, V_start / (rho * slack)),
                     at_most(V_t, bound_47)), lemmas=(greater(t * rho * slack, V_start - mu / rho),)),
                 corrected_statement=rf"\forall c > 0\ \exists T\ \forall t > T:\ V_{i}(t) \le \varphi_{i} + c",
                 note="The sentence after the norm bound, and the 'exponential convergence of sliding surfaces' before it: "
                      "V = mu/rho for ever obeys the decay inequality. If the gains are meant, 47.small is the true form.")
    def vanishes() -> Goal:
        one = sp.Integer(1)
        return Goal((at_most(V_t, sp.S.Half),), (), along_v, decaying, from_zero, eventually=t,
                    model={V_t: one, mu: one, rho: one, V_start: one}, inputs=(w,))


after_decay(1, "45", "46", "47", "48", "36")

wanted = sp.Symbol("V_wanted", positive=True)
prior_size, off_size = sp.symbols("W_off_square delta_off_square", nonnegative=True)


@paper.claim("47.small", "The bound of V_1 can be made arbitrarily small by the gains", "implication",
             r"\forall\phi > 0\ \exists\,k_i, \sigma_f, \Gamma_f, \alpha_1, \beta_1:\ \frac{\mu_1}{\rho_1} \le \phi", "proved",
             premises=("47",),
             note="'Increasing the value of rho_1'. With the corrected rho_1. Witness: sigma_f = beta_1 = 1, rho = mu_1/phi, "
                  "Gamma_f = rho times the identity, alpha_1 = rho, k_1 = k_3 = rho/2, k_2 = 1 + k_1 k_3.")
def arbitrarily_small() -> Goal:
    """Every entry of the corrected rho_1 is met with equality."""
    total = prior_size / 2 + off_size / 2 + constant * kappa_1 * delta_size
    rate, one = total / wanted, sp.Integer(1)
    gains = {sigma_f: one, beta_1: one, rho: rate, lambda_f: 1 / rate, alpha_1: rate, k_1: rate / 2, k_3: rate / 2}
    entries = (*rates_1, at_most(rho, alpha_1 * beta_1))
    return Goal((*(equal(r.left.xreplace(gains), r.right.xreplace(gains)) for r in entries),
                 equal(total, wanted * rate), greater(rate, 0)), (greater(delta_size, 0),))


norm_48 = s_tilde**2 + v_tilde**2 + square_f


@paper.claim("48", "Norm of the errors", "inequality",
             r"\left\|\tilde s, \tilde v, \sqrt{\tilde W_f^T\Gamma_f^{-1}\tilde W_f}, \tfrac{1}{\alpha_1}\tilde\delta"
             r"\right\| \le \sqrt{2V_1} \le \sqrt{2\varphi_1 + 2(V_1(0) - \varphi_1)e^{-\rho_1t}}", "refuted",
             premises=("47",), scope=EVERY_NETWORK,
             correction=lambda: Goal((equal(norm_48 + delta_tilde**2 / alpha_1, 2 * V_1),)),
             corrected_statement=r"\left\|\tilde s, \tilde v, \sqrt{\tilde W_f^T\Gamma_f^{-1}\tilde W_f}, "
                                 r"\tfrac{1}{\sqrt{\alpha_1}}\tilde\delta\right\| = \sqrt{2V_1}",
             note="In squares. Fails for alpha_1 < 1; of no consequence for the theorem.")
def norm_bound() -> Goal:
    """The squares of the left side against 2 V_1."""
    return Goal((at_most(norm_48 + (delta_tilde / alpha_1) ** 2, 2 * V_1),))


limit = sp.Symbol("B_max", positive=True)


def runaway(loop: dict[sp.Expr, sp.Expr], estimate: sp.Expr) -> Goal:
    """A solution of the printed loop in which one estimate grows beyond every bound and all other errors are zero."""
    single = {one_neuron(state): one_neuron(rate) for state, rate in loop.items()}
    rates = {state: sp.Symbol(f"{state}_dot", real=True) for state in single}
    always = tuple(equal(rates[state], rate) for state, rate in single.items())
    constants = {symbol for rate in single.values() for symbol in rate.free_symbols} - set(single)
    zero = {delta, theta, delta_off, theta_off, one_neuron(W_f_off), one_neuron(W_v_off)}
    model = {symbol: sp.Integer(symbol not in zero) for symbol in constants} | dict.fromkeys(single, sp.Integer(0))
    model |= {limit: sp.Integer(100), estimate: 101 * sp.exp(t)}
    return Goal((at_most(estimate, limit),), (), {t: sp.Integer(1)} | rates, (at_least(t, 0), *always), eventually=t,
                model=model, inputs=tuple(rates.values()))


s_tilde_rate = sp.Symbol("s_tilde_rate", real=True)
V_weighted = (k_2 + k_1 * k_3) * s_tilde**2 / 2 + v_tilde**2 / 2 + V_f + delta_tilde**2 / (2 * alpha_1)
mu_1_bound = positive(mu_1_stated)


def _theorem_1_corrected() -> Goal:
    rates = (at_most(rho, k_3), at_most(rho * (k_2 + k_1 * k_3 + 2 * k_1**2), 2 * k_1 * k_2),
             at_most(rho * lambda_f, sigma_f), at_most(rho, alpha_1 * beta_1))
    damped = (-k_1 * k_2 * s_tilde**2 - k_3 * s_tilde_rate**2 - sigma_f / 2 * norm_f - beta_1 / 2 * delta_tilde**2
              + mu_1_bound)
    return Goal((at_most(D(V_weighted), -rho * V_weighted + mu_1_bound),),
                (equal(s_tilde_rate, v_tilde - k_1 * s_tilde), *delta_bounds, *rates,
                 bounded_by_eigenvalue(square_f, norm_f, lambda_f)), observer_loop(-1, eps_tilde),
                facts=smooth_sign_facts(v_tilde, kappa_1),
                lemmas=(*smooth_1, at_most(v_tilde**2, 2 * s_tilde_rate**2 + 2 * k_1**2 * s_tilde**2),
                        at_most(D(V_weighted), damped), at_most(damped, -rho * V_weighted + mu_1_bound)))


@paper.claim("theorem1", "Theorem 1: all signals of the observer are ultimately bounded", "limit",
             r"\exists B\ \exists T\ \forall t > T:\ \tilde\delta \le B\ \text{along (13), (18)-(21)}", "gap",
             premises=("45", "48"), scope="the correction: " + EVERY_NETWORK, correction=_theorem_1_corrected,
             corrected_statement=r"\frac{d}{dt}V \le -\rho V + \mu_1,\ V = \tfrac12(k_2 + k_1k_3)\tilde s^2 + "
                                 r"\tfrac12\tilde v^2 + \tfrac12\tilde W_f^T\Gamma_f^{-1}\tilde W_f + \tfrac{1}{2\alpha_1}"
                                 r"\tilde\delta^2\ \text{for all}\ k_i > 0,\ \text{minus signs in (19), (21), a constant}\ "
                                 r"\delta \ge |\tilde\varepsilon_f|",
             note="False as printed: with perfect estimates of everything but delta (eps_tilde = delta = 0) the printed loop "
                  "has a solution in which delta_hat grows as exp(alpha_1 beta_1 t), beyond every B; the model shows "
                  "B = 100. The correction needs no (40), so it covers all ten columns of Table 2. It still uses the "
                  "unmeasured v_tilde (19.measured) and the bound of (15) for all t (15.inside).")
def theorem_1() -> Goal:
    """delta_hat(t) = 101 exp(t) along the printed loop, one neuron."""
    return runaway(observer_loop(), delta_tilde)

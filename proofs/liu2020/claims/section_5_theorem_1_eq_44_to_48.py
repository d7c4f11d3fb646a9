"""Section 5, Theorem 1: the decay of V_1, (44)-(48), for both theorems where they share it."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater

from ..error_dynamics import delta_off, delta_tilde, t, theta_tilde
from ..exact_motions import observer_leaves_prior, tracking_leaves_prior
from ..laws import alpha_1, alpha_2, beta_1, g_f, s_tilde, sigma_f, v_tilde
from ..lyapunov import (
    V_1,
    bounded_by_eigenvalue,
    delta_size,
    lambda_f,
    largest_f,
    mu,
    norm_f,
    rates_1,
    rho,
    square_f,
)
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from .section_5_theorem_1_eq_41_to_43 import mu_1_stated

RHO_1 = (r"\rho_1 := \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\min}(\Gamma_u^{-1})}, \frac{\beta_1}{\alpha_1}"
         r"\right\}")
RHO_2 = (r"\rho := \min\left\{2k_1, 2k_3, \frac{2\chi k_5}{M}, \frac{\sigma_f}{\lambda_{\min}(\Gamma_u^{-1})}, "
         r"\alpha_1\beta_1, \frac{\sigma_v}{\lambda_{\min}(\Gamma_v^{-1})}, \alpha_2\beta_2\right\}")
paper.definition("44", "The bound mu_1 and the rate rho_1 of V_1",
                 r"\mu_1 := \frac{\sigma_f}{2}\|W_f - W_{f0}\|^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2 + 0.2785\kappa_1|\delta|,\ "
                 + RHO_1,
                 reading="The accent over delta in (delta - delta_0)^2 is read as in (43).",
                 note="Gamma_u stands for Gamma_f. That rho_1 is the rate of decay is decided entry by entry, see 44.weights and 44.estimate.")

entry_1, entry_2 = sp.symbols("G_1 G_2", positive=True)
W_1, W_2 = sp.symbols("W_1 W_2", real=True)
GAMMA_U = " Gamma_u, which the paper does not define, is taken for Gamma_f."


def weights_decay_claim(equation: str, net: str, sigma: sp.Expr, eigenvalue: sp.Expr, largest: sp.Expr, norm: sp.Expr,
                        square: sp.Expr) -> None:
    """State which eigenvalue of the inverse gain of a network sets the rate of its weights."""
    g = rf"\Gamma_{net}^{{-1}}"
    bound = (rf"-\tfrac{{\sigma_{net}}}{{2}}\|\tilde W_{net}\|^2 \le -\tfrac{{\rho}}{{2}}\tilde W_{net}^T{g}"
             rf"\tilde W_{net}")
    corrected = rf"\rho \le \frac{{\sigma_{net}}}{{\lambda_{{\max}}({g})}} \Rightarrow {bound}"

    def by_largest() -> Goal:
        return Goal((at_most(-sigma / 2 * norm, -rho / 2 * square),),
                    (at_most(rho * largest, sigma), bounded_by_eigenvalue(square, norm, largest)))

    @paper.claim(f"{equation}.weights", "The smallest eigenvalue of the inverse gain sets the weights' rate",
                 "inequality", RHO_1 if net == "f" else RHO_2, "refuted",
                 rests_on=(), scope="two neurons, diagonal gain", correction=by_largest,
                 corrected_statement=corrected,
                 reading=f"An entry of rho is read by its use: a rho of at most sigma_{net}/lambda_min is the rate of the weights."
                         + (" Gamma_u is taken for Gamma_f." if net == "f" else ""),
                 note="The largest eigenvalue belongs here; the two agree only for a gain that is a multiple of the "
                      "identity. Costs speed, not the theorem." + (GAMMA_U if net == "f" else ""))
    def weights_decay() -> Goal:
        return Goal((at_most(-sigma / 2 * (W_1**2 + W_2**2), -rho / 2 * (entry_1 * W_1**2 + entry_2 * W_2**2)),),
                    (equal(eigenvalue, entry_1), at_most(entry_1, entry_2), at_most(rho * eigenvalue, sigma)))

    @paper.claim(f"{equation}.weights.mended", "The largest eigenvalue of the inverse gain sets the weights' rate",
                 "inequality", corrected, "proved", origin="ours", mends=f"{equation}.weights", rests_on=(),
                 scope="every number of neurons and every gain matrix")
    def weights_decay_mended() -> Goal:
        """W_tilde^T Gamma^-1 W_tilde is at most lambda_max |W_tilde|^2."""
        return by_largest()


weights_decay_claim("44", "f", sigma_f, lambda_f, largest_f, norm_f, square_f)

DELTA_DECAY = r"-\frac{\beta_1}{2}\tilde\delta^2 \le -\rho\frac{\tilde\delta^2}{2\alpha_1}"


def _estimate_decay(rate: sp.Expr) -> Goal:
    return Goal((at_most(-beta_1 / 2 * delta_tilde**2, -rho * delta_tilde**2 / (2 * alpha_1)),), (at_most(rho, rate),))


@paper.claim("44.estimate", "The last entry of (44) sets the rate of the estimate of delta", "inequality", RHO_1, "refuted",
             rests_on=(), where={r"\rho": rho},
             reading="As the entry of the weights: a rho of at most beta_1/alpha_1 is the rate of the estimate.",
             correction=lambda: _estimate_decay(alpha_1 * beta_1),
             corrected_statement=r"\rho \le \alpha_1\beta_1 \Rightarrow " + DELTA_DECAY,
             note="Fails for alpha_1 < 1. (56) has the right entry, alpha_1 beta_1. With that of the weights corrected as well, the "
                  "minimum in (44) is of 2 k_1, 2 k_3, sigma_f/lambda_max(Gamma_f^-1) and alpha_1 beta_1.")
def estimate_decay() -> Goal:
    """With the entry of (44)."""
    return _estimate_decay(beta_1 / alpha_1)


@paper.claim("44.estimate.glyph", "The rate of the estimate of delta, with a product", "inequality",
             r"\rho \le \alpha_1\beta_1 \Rightarrow " + DELTA_DECAY, "proved", origin="ours", mends="44.estimate",
             where={r"\rho": rho})
def estimate_decay_product() -> Goal:
    """With the entry of (56)."""
    return _estimate_decay(alpha_1 * beta_1)


gain_f = greater(over_neurons(g_f**2), 0)  # not without any gain
smallest_f = at_least(square_f, lambda_f * norm_f)  # what the smallest eigenvalue means
V_1_dot = sp.Symbol("Vdot_1", real=True)
robust_size = sp.Symbol("delta_size", nonnegative=True)  # |delta|
mu_1 = mu_1_stated.xreplace({delta_size: robust_size})
DECAY_1 = {r"\mu_1": mu_1, r"\dot V_1": V_1_dot, r"\rho_1": rho} | ERRORS


estimate_alone = (equal(delta_off, 0), equal(robust_size, 0), equal(delta_tilde, 1), equal(10 * alpha_1, 1))


def bounded_43() -> Relation:
    """(43) for the rate of V_1, |delta| one number."""
    shown, = paper.shown("43")
    return Relation(V_1_dot, shown.operator, shown.right.xreplace({delta_size: robust_size}))


def _decay_1() -> Goal:
    """(45) from (43) with the entries of (44) that hold."""
    return Goal((at_most(V_1_dot, -rho * V_1 + mu_1),), (
        bounded_43(), *rates_1(largest_f), at_most(rho, alpha_1 * beta_1),
        bounded_by_eigenvalue(square_f, norm_f, largest_f)))


@paper.claim("45", "V_1 decays up to mu_1", "implication", r"\dot V_1 \le -\rho_1V_1 + \mu_1", "gap",
             premises=("43",), rests_on=("43", "44.weights", "44.estimate"), scope=EVERY_NETWORK, where=DECAY_1,
             correction=_decay_1,
             corrected_statement=r"\rho_1 = \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, "
                                 r"\alpha_1\beta_1\right\} \Rightarrow \dot V_1 \le -\rho_1V_1 + \mu_1",
             reading="rho_1 is at most each entry of (44).",
             note="From (43) with rho_1 of (44); see 44.weights and 44.estimate for the entries that fail. Decided "
                  "where the estimate of delta alone is off, for alpha_1 = 0.1.")
def decay_1() -> Goal:
    """From (43) with the entries of (44) as printed."""
    return Goal((at_most(V_1_dot, -rho * V_1 + mu_1),),
                (bounded_43(), *rates_1(lambda_f), at_most(rho, beta_1 / alpha_1), smallest_f, gain_f, *estimate_alone))


V_t, V_start, w, level, c = sp.symbols("V_t V_0 w Theta c", real=True)
decaying = (at_most(w, -rho * V_t + mu), at_least(t, 0))
along_v = {t: sp.Integer(1), V_t: w}
from_zero = {t: sp.Integer(0), V_t: V_start}
bound_47 = mu / rho + (V_start - mu / rho) * sp.exp(-rho * t)
in_the_end = (greater(c, 0), at_least(V_start, 0), at_least(t, V_start / (rho * c)))


@paper.claim("comparison", "What decays up to mu is bounded by its start and mu/rho", "implication",
             r"\dot V \le -\rho V + \mu \Rightarrow V \le \frac{\mu}{\rho} + (V(0) - \frac{\mu}{\rho})e^{-\rho t}", "proved",
             origin="ours", where={"V": V_t, r"\dot V": w, r"\rho": rho, r"\mu": mu, "V(0)": V_start, "t": t},
             note="For any V: what (46) and (47) do, free of (45).")
def comparison_lemma() -> Goal:
    """exp(rho t)(V - mu/rho) does not increase."""
    return Goal((at_most(V_t, bound_47),), (), along_v, decaying, from_zero, decreasing=sp.exp(rho * t) * (V_t - mu / rho),
                inputs=(w,))


@paper.claim("comparison.end", "What decays up to mu comes as near to mu/rho as is wanted", "implication",
             r"\dot V \le -\rho V + \mu \Rightarrow \forall c > 0\ \exists T\ \forall t > T:\ V(t) \le \frac{\mu}{\rho} + c",
             "proved", origin="ours", premises=("comparison",),
             where={"V": V_t, "V(t)": V_t, r"\rho": rho, r"\mu": mu, "t": t, "c": c},
             note="For any V that is not negative, at the latest from t = V(0)/(rho c) on.")
def comes_near() -> Goal:
    """What (47) means for large t."""
    return Goal((at_most(V_t, mu / rho + c),), (*in_the_end, at_most(V_t, bound_47)),
                lemmas=(greater(t * rho * c, V_start - mu / rho),))


def ends_near(value: sp.Expr, drive: sp.Expr, *shown: Relation) -> Goal:
    """`shown` of a V = value that comes as near to mu/rho, mu = drive, as comparison.end says."""
    return Goal(shown, (*paper.shown("comparison.end"), equal(V_t, value), equal(mu, drive), greater(c, 0)))


near_end = mu / rho + c


def after_decay(i: int, decay: str, growth: str, bound: str, not_negative: str) -> None:
    """What the paper concludes from V' <= -rho V + mu, the same for both theorems."""
    letters = {f"V_{i}": V_t, f"V_{i}(t)": V_t, f"V_{i}(0)": V_start, rf"\dot V_{i}(t)": w, rf"\mu_{i}": mu,
               rf"\rho_{i}": rho, rf"\varphi_{i}": mu / rho, rf"\Theta_{i}": level, "t": t, "c": c}

    @paper.claim(f"{decay}.level", f"V_{i} does not grow at the level Theta_{i}", "implication",
                 rf"V_{i} = \Theta_{i},\ \rho_{i} > (\mu_{i}/\Theta_{i}) \Rightarrow \dot V_{i}(t) \le 0", "proved",
                 premises=(decay,), where=letters,
                 reading="'If ..., then ...' in the text; Theta is a positive level." + (
                     " V_1 is at the level, as for V_2, where the text has 'in'." if i == 1 else ""))
    def no_growth() -> Goal:
        """At V = Theta the decay outweighs mu."""
        return Goal((at_most(w, 0),), (greater(level, 0), greater(rho, mu / level), equal(V_t, level),
                                       at_most(w, -rho * V_t + mu)))

    @paper.claim(growth, f"Rate of V_{i} exp(rho t)", "implication",
                 rf"\frac{{d}}{{dt}}\left(V_{i}(t)e^{{\rho_{i}t}}\right) \le e^{{\rho_{i}t}}\mu_{i}", "proved",
                 premises=(decay,), where=letters,
                 note="(45) is multiplied, not (43) as the text has it." if i == 1 else "")
    def growth_bound() -> Goal:
        """The product rule."""
        return Goal((at_most(D(V_t * sp.exp(rho * t)), mu * sp.exp(rho * t)),), decaying, along_v)

    @paper.claim(bound, f"Bound of V_{i}", "implication",
                 rf"0 \le V_{i}(t) \le \varphi_{i} + (V_{i}(0) - \varphi_{i})e^{{-\rho_{i}t}}", "proved",
                 premises=(growth, not_negative), where=letters,
                 note=f"exp(rho t)(V - phi) does not increase. 0 <= V_{i} is {not_negative}.")
    def comparison() -> Goal:
        return Goal((at_most(0, V_t), at_most(V_t, bound_47)), (at_least(V_t, 0),), along_v, decaying,
                    from_zero, decreasing=sp.exp(rho * t) * (V_t - mu / rho), inputs=(w,))

    @paper.claim(f"{bound}.level", f"V_{i}(0) <= Theta_{i} keeps V_{i} <= Theta_{i}", "implication",
                 rf"V_{i}(0) \le \Theta_{i},\ \rho_{i} > (\mu_{i}/\Theta_{i}) \Rightarrow V_{i}(t) \le \Theta_{i}",
                 "proved", premises=(bound,), rests_on=(f"{decay}.level",), where=letters,
                 reading="For all t >= 0, as the text says.")
    def stays_below() -> Goal:
        """The bound lies between V(0) and phi, both below Theta."""
        return Goal((at_most(V_t, level),), (greater(level, 0), greater(rho, mu / level), at_most(V_start, level),
                                             at_least(t, 0), at_most(V_t, bound_47)))


def errors_vanish(i: int, norm: str, rests_on: tuple[str, ...]) -> None:
    """What the paper says of the errors of V_i below `norm`.

    rests_on: what it needs of the bound of V's rate, by whatever rho > 0 it decays.
    """
    size = delta_tilde / alpha_1 if i == 1 else theta_tilde / alpha_2
    in_print = "delta" if i == 1 else "theta"
    needs = ("the leakage of (19), (21) turned, (40), a constant delta >= |eps_tilde_f|, lambda_max and alpha_1 beta_1 in "
             "(44)" if i == 1 else
             "besides what V_1 needs the leakage of (32), (35) and the learning sign of (32) turned, (28), a constant theta >= "
             "|eps_v - (M/chi) d| and lambda_max in (56)")

    @paper.claim(f"{norm}.zero", f"The errors of V_{i} become arbitrarily small as t goes to infinity", "limit",
                 (r"\text{the error variable}\ \ldots\ \text{can be arbitrarily decreased to}\ t \to \infty" if i == 1 else
                  r"\text{the error variable}\ \ldots\ \text{can be made arbitrarily small as}\ t \to \infty"),
                 "refuted", match="words", closed_loop=True, severity="result", rests_on=rests_on,
                 scope="one neuron in each network",
                 reading=f"Along the printed loop {in_print}_tilde/alpha_{i}, which the sentence names, is in the end at most "
                         "1/2, as what becomes arbitrarily small is.",
                 note=f"Where all other errors are zero, nothing drives the laws, and {in_print}_hat leaves its prior as "
                      f"exp(alpha_{i} beta_{i} t): it is so for all gains. Nor does the sentence follow from the decay of "
                      f"V_{i}, which V = mu/rho for ever obeys; the same holds of 'exponential convergence of sliding "
                      f"surfaces' before it. That V_{i} decays needs {needs}." + (
                          " Then it comes near to phi_1, see 48.mended, which gains make small, see 47.small.mended." if i == 1
                          else " With all of these it comes near to phi_2, see 60.mended; (28) is open."))
    def vanishes() -> Goal:
        shown = at_most(size, sp.Rational(1, 2))
        return observer_leaves_prior(shown) if i == 1 else tracking_leaves_prior(shown)


after_decay(1, "45", "46", "47", "36")


@paper.claim("47.small", "V_1 is bounded", "limit",
             r"\text{Equation (47) shows that}\ V_1(t)\ \text{is bounded because increasing the value of}\ \rho_1\ "
             r"\text{can be decreased}", "refuted", match="words", closed_loop=True, rests_on=("47",), scope="one neuron",
             reading="Along (13), (18) to (21) as printed: with V_1 delta_tilde is bounded, and then in the end below t.",
             note="V_1 grows as exp(2 alpha_1 beta_1 t) where the estimate of delta alone is off, for all gains. That gains make the "
                  "bound mu_1/rho_1 small is true once V_1 decays, see 47.small.mended.")
def v1_bounded() -> Goal:
    """The motion of the estimate alone."""
    return observer_leaves_prior(at_most(delta_tilde, t))


norm_48 = s_tilde**2 + v_tilde**2 + square_f
norm_key = (r"\left\|\tilde s, \tilde v, \sqrt{\tilde W_f^T\Gamma_f^{-1}\tilde W_f}, \frac{1}{\alpha_1}\tilde\delta"
            r"\right\|")


@paper.claim("48", "Norm of the errors", "implication",
             norm_key + r" \le \sqrt{2\varphi_1 + 2(V_1(0) - \varphi_1)e^{-\rho_1t}}", "gap",
             premises=("47",), scope=EVERY_NETWORK,
             where={norm_key: sp.sqrt(norm_48 + (delta_tilde / alpha_1) ** 2), r"\varphi_1": mu / rho, "V_1(0)": V_start,
                    r"\rho_1": rho, "t": t},
             correction=lambda: Goal((equal(norm_48 + delta_tilde**2 / alpha_1, 2 * V_1),)),
             corrected_statement=r"\left\|\tilde s, \tilde v, \sqrt{\tilde W_f^T\Gamma_f^{-1}\tilde W_f}, "
                                 r"\tfrac{1}{\sqrt{\alpha_1}}\tilde\delta\right\| = \sqrt{2V_1}",
             note="From (47). Fails for alpha_1 < 1; of no consequence for the theorem.")
def norm_bound() -> Goal:
    """The norm against twice the bound of (47)."""
    return Goal((at_most(sp.sqrt(norm_48 + (delta_tilde / alpha_1) ** 2),
                         sp.sqrt(2 * mu / rho + 2 * (V_start - mu / rho) * sp.exp(-rho * t))),),
                (at_least(t, 0), at_most(V_1, bound_47)))

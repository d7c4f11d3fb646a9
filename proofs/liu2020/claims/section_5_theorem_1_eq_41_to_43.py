"""Section 5, Theorem 1: Lemmas 1 and 2, and the bound of the rate of V_1, (41)-(43)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater

from ..error_dynamics import W_f_off, W_f_tilde, delta, delta_off, delta_tilde, eps_tilde, observer_loop
from ..goal_forms import small_hidden, with_gain, within
from ..laws import beta_1, g_f, gamma_1, h_f, indexed, k_1, k_2, k_3, kappa_1, s_tilde, sigma_f, v_tilde
from ..lyapunov import V_1, delta_size, norm_f, positive, prior_f
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..smooth_sign import constant, constant_suffices, smooth_sign, smooth_sign_facts
from .section_5_theorem_1_eq_36_to_40 import leak_delta, leak_f

x_tilde, x_off = indexed("x_tilde"), indexed("x_off")  # x_off is truth minus prior
square_error, square_prior = over_neurons(x_tilde**2), over_neurons(x_off**2)
EVERY_DIMENSION = "every dimension"
x = sp.Symbol("x", real=True)
LEMMA = {r"\tilde\theta": x_tilde, r"\hat\theta - \theta_0": x_tilde + x_off, r"\theta - \theta_0": x_off}


def _lemma_1(sign: int, factor: int = 1) -> Goal:
    """Lemma 1 for an estimation error of sign (estimate - truth), its left side times a factor."""
    left = factor * over_neurons(x_tilde * (sign * x_tilde + x_off))
    middle = -square_error + over_neurons(x_tilde * x_off)
    bound = -square_error / 2 + square_prior / 2
    return Goal((at_most(left, bound),) if factor == -1 else (equal(left, middle), at_most(left, bound)))


@paper.claim("41", "Lemma 1 for truth minus estimate; for the paper's errors, estimate minus truth, it is false", "inequality",
             r"\tilde\theta^T(\hat\theta - \theta_0) = -\|\tilde\theta\|^2 + \tilde\theta^T(\theta - \theta_0) \le "
             r"-0.5\|\tilde\theta\|^2 + 0.5\|\theta - \theta_0\|^2", "proved", severity="result", rests_on=(),
             scope=EVERY_DIMENSION, where=LEMMA | {r"\hat\theta - \theta_0": x_off - x_tilde},
             reading="theta_tilde = theta - theta_hat, truth minus estimate: the lemma is cited, and does not say which it "
                     "is. The accent in the first bracket is read as a hat, as in (42) and (54).",
             note="The paper's own errors are estimate minus truth; to them it does not apply, see 41.reversed.")
def lemma_1() -> Goal:
    """With truth minus estimate."""
    return _lemma_1(-1)


@paper.claim("41.reversed", "Lemma 1 for an error of the opposite sign, estimate minus truth", "inequality",
             r"\tilde\theta = \hat\theta - \theta:\quad \tilde\theta^T(\hat\theta - \theta_0) = -\|\tilde\theta\|^2 + "
             r"\tilde\theta^T(\theta - \theta_0) \le -\tfrac12\|\tilde\theta\|^2 + \tfrac12\|\theta - \theta_0\|^2",
             "refuted", origin="ours", rests_on=(), scope=EVERY_DIMENSION, correction=lambda: _lemma_1(1, -1),
             corrected_statement=r"-\tilde\theta^T(\hat\theta - \theta_0) \le -\tfrac12\|\tilde\theta\|^2 + "
                                 r"\tfrac12\|\theta - \theta_0\|^2",
             reading="The errors W_tilde, delta_tilde and theta_tilde that (42) and (54) apply the lemma to.",
             note="With estimate minus truth the square has a plus sign; with minus signs before the leakage of (19), (21), "
                  "(32), (35) the mended form serves.")
def lemma_1_reversed() -> Goal:
    """With the paper's estimation errors."""
    return _lemma_1(1)


@paper.claim("41.mended", "Lemma 1 for a leakage with a minus sign", "inequality",
             r"-\tilde\theta^T(\hat\theta - \theta_0) \le -0.5\|\tilde\theta\|^2 + 0.5\|\theta - \theta_0\|^2", "proved",
             origin="ours", mends="41.reversed", scope=EVERY_DIMENSION, where=LEMMA)
def lemma_1_mended() -> Goal:
    """The left side times -1."""
    return _lemma_1(1, -1)


scale, slack, kappa = sp.symbols("h delta_any kappa", real=True)
LEMMA_2 = {"x^T": x, "x": x, r"\|x\|": sp.Abs(x), "h": scale, r"\delta": slack, r"\kappa": kappa, r"\upsilon": constant}


@paper.claim("lemma2", "Lemma 2", "inequality",
             r"h\|x\| - x^Th\tanh(\upsilon hx/\kappa) \le h\delta", "refuted", severity="result",
             glyph="lemma2.glyph", scope="x in one dimension, the case that the proofs use", where=LEMMA_2, rests_on=(),
             reading="For any delta > 0, x and h, as the text says, with kappa > 0.",
             correction=lambda: Goal(smooth_sign(x, kappa_1), facts=smooth_sign_facts(x, kappa_1),
                                     lemmas=(constant_suffices,)),
             corrected_statement=r"|x| - x\tanh\frac{x}{\kappa} \le 0.2785\kappa",
             note="As extracted delta is free of kappa, and h may be negative or small. With one letter for kappa and h "
                  "delta it is the known lemma, see lemma2.glyph. The proofs use the form of the correction.")
def lemma_2() -> Goal:
    """As extracted, for n = 1."""
    left = scale * sp.Abs(x) - x * scale * sp.tanh(constant * scale * x / kappa)
    return Goal((at_most(left, scale * slack),), (greater(slack, 0), greater(kappa, 0)))


known = sp.Symbol("delta_known", positive=True)


@paper.claim("lemma2.glyph", "Lemma 2 with delta in the place of kappa and of the product h delta, for a scalar x, all that is used", "inequality",
             r"h|x| - xh\tanh(\upsilon hx/\delta) \le \delta", "proved", origin="ours", glyph="lemma2",
             scope="x in one dimension, the case that the proofs use", where=LEMMA_2 | {r"\delta": known},
             premises=("lemma2.constant",))
def lemma_2_known() -> Goal:
    """The known lemma, for n = 1."""
    argument = constant * scale * x / known
    return Goal((at_most(scale * sp.Abs(x) - x * scale * sp.tanh(argument), known),),
                facts=smooth_sign_facts(scale * x, known / constant),
                lemmas=(constant_suffices, *smooth_sign(scale * x, known / constant)))


@paper.claim("lemma2.constant", "0.2785 is the constant of Lemma 2", "inequality",
             r"\upsilon = e^{-(\upsilon + 1)},\ \text{that is,}\ \upsilon = 0.2785", "proved", rests_on=(),
             reading="To four digits: log(1/c) - 1 - c changes its sign between c = 0.27845 and c = 0.2785.",
             note="1 + c + log c >= 0 for c = 0.2785: rounded upwards in the fourth digit, on the safe side.")
def constant_of_lemma_2() -> Goal:
    """log(1/c) against 1 + c at two values of c."""
    below = constant - sp.Rational(5, 100000)
    return Goal((constant_suffices, greater(sp.log(1 / below), 1 + below)))


# --- section 5: the bounds of Theorem 1 -----------------------------------------------------------------------


def _robust_bound(error: sp.Expr, residual: sp.Expr, bound: sp.Expr, kappa: sp.Expr, *given: Relation) -> Goal:
    """error residual - error tanh(error/kappa) bound <= 0.2785 kappa bound."""
    left = error * residual - error * sp.tanh(error / kappa) * bound
    return Goal((at_most(left, constant * kappa * bound),), given,
                facts=smooth_sign_facts(error, kappa) if given else (),
                lemmas=(constant_suffices, *smooth_sign(error, kappa)) if given else ())


def robust_claims(equation: str, name: str, symbols: tuple[sp.Expr, ...], latex: tuple[str, ...],
                  definition: str) -> None:
    """State Lemma 2 as it is applied to a residual: with the residual as its own bound, and with its absolute value.

    symbols and latex: the error, what disturbs it, the bound and the width of the smooth sign.
    """
    error, residual, bound, kappa = symbols
    e, r, b, k = latex
    defined = {"42": "38.delta", "54": "52.theta"}[equation]
    left = rf"{e}{b} - {e}\gamma({e}){b}"
    drive = rf"{e}({r})" if "-" in r else e + r
    corrected = rf"|{r}| \le {b} \Rightarrow {drive} - {e}\gamma({e}){b} \le 0.2785{k}{b}"

    @paper.claim(f"{equation}.{name}", f"Lemma 2 applied to {name}", "inequality", rf"{left} \le 0.2785{k}{b}",
                 "refuted", premises=("lemma2.glyph",), rests_on=("lemma2.glyph", defined),
                 correction=lambda: _robust_bound(error, residual, bound, kappa, *within(residual, bound)),
                 corrected_statement=corrected,
                 note=f"False for negative {name}, which its definition allows ({name} = {definition}). An absolute value "
                      f"on the right does not help, see {equation}.{name}.size. True when {name} is read as a bound of "
                      f"|{definition}|.")
    def robust_bound() -> Goal:
        return _robust_bound(error, bound, bound, kappa)

    @paper.claim(f"{equation}.{name}.size", f"The same with the absolute value of {name}", "inequality",
                 rf"{left} \le 0.2785{k}|{b}|", "refuted", origin="implied", premises=("lemma2.glyph",),
                 rests_on=(f"{equation}.{name}",),
                 note="What the next bound prints. On the left both terms are positive when "
                      f"{name} and the error are negative: the robust term then drives the error instead of damping it.")
    def robust_bound_size() -> Goal:
        return Goal((at_most(error * bound - error * sp.tanh(error / kappa) * bound,
                             constant * kappa * sp.Abs(bound)),))

    @paper.claim(f"{equation}.{name}.mended", f"Lemma 2 applied to {name} as a bound", "inequality", corrected,
                 "proved", origin="ours", mends=f"{equation}.{name}", premises=("lemma2.glyph",),
                 where={r: residual} | RESIDUALS)
    def robust_bound_mended() -> Goal:
        """The tangents of exp on either side of zero."""
        return _robust_bound(error, residual, bound, kappa, *within(residual, bound))


RESIDUALS = {r"\tilde\varepsilon_f": eps_tilde}
robust_claims("42", "delta", (v_tilde, eps_tilde, delta, kappa_1),
              (r"\tilde v", r"\tilde\varepsilon_f", r"\delta", r"\kappa_1"), "eps_tilde")


OPPOSITE = ("Lemma 1 is for truth minus estimate, the errors here are estimate minus truth, see 41.reversed. True when the "
            "leakage enters with minus.")


def leak_claims(equation: str, name: str, leak: sp.Expr, printed: sp.Expr, bound: sp.Expr,
                latex: tuple[str, str, str], leakage: str, remark: str) -> None:
    """State Lemma 1 as it is applied to the leakage of an estimate; latex: its left side, middle and right side."""
    scope = EVERY_NETWORK if leak.has(sp.Sum) else "all values of the domain"

    @paper.claim(f"{equation}.{name}", f"Lemma 1 applied to the leakage of {name}", "inequality",
                 rf"{latex[0]} = {latex[1]} \le {latex[2]}", "refuted", rests_on=("41", leakage), where=ERRORS,
                 scope=scope, correction=lambda: Goal((at_most(-leak, bound),)),
                 corrected_statement=rf"-{latex[0]} \le {latex[2]}", note=remark,
                 reading="Accents and signs of norms as (19), (21), (32), (35) and Lemma 1 have them.")
    def leak_bound() -> Goal:
        return Goal((equal(leak, printed), at_most(leak, bound)))

    @paper.claim(f"{equation}.{name}.mended", f"Lemma 1 applied to the turned leakage of {name}", "inequality",
                 rf"-{latex[0]} \le {latex[2]}", "proved", origin="ours", mends=f"{equation}.{name}", where=ERRORS,
                 rests_on=(), scope=scope)
    def leak_bound_mended() -> Goal:
        """By Young's inequality, for estimate minus truth."""
        return Goal((at_most(-leak, bound),))


bound_f = -sigma_f / 2 * norm_f + sigma_f / 2 * prior_f
bound_delta = -beta_1 / 2 * delta_tilde**2 + beta_1 / 2 * delta_off**2
leak_claims("42", "weights", leak_f, sigma_f * (-norm_f + over_neurons(W_f_tilde * W_f_off)), bound_f,
            (r"\sigma_f\tilde W_f^T(\hat W_f - W_{f0})",
             r"\sigma_f(-\|\tilde W_f\|^2 + \tilde W_f^T(W_f - W_{f0}))",
             r"-\frac{\sigma_f}{2}\|\tilde W_f\|^2 + \frac{\sigma_f}{2}\|W_f - W_{f0}\|^2"),
            "19.leakage", OPPOSITE)
leak_claims("42", "estimate", leak_delta, -beta_1 * delta_tilde**2 + beta_1 * delta_tilde * delta_off,
            bound_delta,
            (r"\beta_1\tilde\delta(\hat\delta - \delta_0)", r"-\beta_1\tilde\delta^2 + \beta_1\tilde\delta"
             r"(\delta - \delta_0)", r"-\frac{\beta_1}{2}\tilde\delta^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2"),
            "21.leakage", f"{OPPOSITE} (42) prints this line twice.")

mu_1_stated = sigma_f / 2 * prior_f + beta_1 / 2 * delta_off**2 + constant * kappa_1 * delta_size
bound_43 = (-k_1 * s_tilde**2 - k_3 * v_tilde**2 - sigma_f / 2 * norm_f - beta_1 / 2 * delta_tilde**2 + mu_1_stated)
condition_40 = equal(-k_2 + k_1 * k_3 + 1, 0)
delta_bounds = (at_least(delta, 0), *within(eps_tilde, delta))
smooth_1 = (constant_suffices, *smooth_sign(v_tilde, kappa_1),
            at_most(v_tilde * eps_tilde - v_tilde * gamma_1(v_tilde) * delta, constant * kappa_1 * delta))
PRINTED_43 = (r"\dot V_1 \le -k_1\tilde s^2 - k_3\tilde v^2 - \frac{\sigma_f}{2}\|\tilde W_f\|^2 + \frac{\sigma_f}{2}"
              r"\|W_f - W_{f0}\|^2 - \frac{\beta_1}{2}\tilde\delta^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2 + "
              r"0.2785\kappa_1|\delta|")


def _mended_43() -> Goal:
    return Goal((at_most(D(V_1), positive(bound_43)),), (condition_40, *delta_bounds), observer_loop(-1, eps_tilde),
                facts=smooth_sign_facts(v_tilde, kappa_1), lemmas=smooth_1)


@paper.claim("43", "Bound of the rate of V_1", "inequality", PRINTED_43, "refuted", premises=("39.mended",),
             rests_on=("39", "42.delta", "42.delta.size", "42.weights", "42.estimate"), scope=EVERY_NETWORK,
             where=ERRORS, correction=_mended_43,
             corrected_statement=r"\text{the same with minus signs before the leakage of (19), (21), with (40), and for a "
                                 r"constant}\ \delta \ge |\tilde\varepsilon_f|",
             reading="The accent over delta in (delta - delta_0)^2 is read as Lemma 1 forces it.",
             note="Along the laws as printed, with (40) and a constant delta. Two causes, each of which suffices: the sign "
                  "of the leakage, by which it is broken here for delta >= 0, and a delta that may be negative "
                  "(42.delta.size).")
def v1_rate_bound() -> Goal:
    """D(V_1) along (13), (18)-(21) against the printed bound, for delta >= 0."""
    return Goal((at_most(D(V_1), bound_43),), (condition_40, at_least(delta, 0), *small_hidden(h_f),
                                            *with_gain(g_f)), observer_loop())


@paper.claim("43.mended", "Bound of the rate of V_1, leakage turned", "inequality",
             r"\dot V_1 \le -k_1\tilde s^2 - k_3\tilde v^2 - \frac{\sigma_f}{2}\|\tilde W_f\|^2 + \frac{\sigma_f}{2}"
             r"\|W_f - W_{f0}\|^2 - \frac{\beta_1}{2}\tilde\delta^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2 + "
             r"0.2785\kappa_1\delta", "proved", origin="ours", mends="43",
             premises=("40.cross", "42.delta.mended", "42.weights.mended", "42.estimate.mended"), rests_on=(),
             scope=EVERY_NETWORK, where=ERRORS,
             note="Along (13), (18) to (21) with minus signs before the leakage, with (40) and a constant delta >= "
                  "|eps_tilde_f|.")
def v1_rate_bound_mended() -> Goal:
    """D(V_1) along the loop with the leakage turned."""
    return _mended_43()

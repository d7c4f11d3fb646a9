"""Section 3: the laws of the observer, (19)-(21), and Remarks 1 and 2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_most, equal

from ..error_dynamics import W_f_tilde, delta, delta_tilde, in_errors, observer_loop, w_f
from ..exact_motions import UPDATE_SIGNAL, observer_motion
from ..laws import (
    W_f_0,
    W_f_hat,
    alpha_1,
    beta_1,
    delta_0,
    delta_hat,
    e_v,
    gamma_1,
    h_f,
    k_1,
    kappa_1,
    observer_laws,
    robust_1,
    s_error,
    s_tilde,
    sigma_f,
    tracking_laws,
    update_signal,
    v_error,
    v_hat,
    v_tilde,
)
from ..lyapunov import V_f
from ..notation import ERRORS, OBSERVED
from ..paper import EVERY_NETWORK, paper
from ..plant import v
from ..smooth_sign import constant_suffices, smooth_sign, smooth_sign_facts
from .section_3_eq_11_to_18 import along_plant, v_other


@paper.claim("19.cancels", "(19) cancels the weights in the rate of V_1", "identity",
             r"\tilde v\tilde W_f^Th_f(\hat z_1) + \tilde W_f^T\Gamma_f^{-1}\cdot\Gamma_f(-h_f(\hat z_1)\tilde v) = 0",
             "proved", origin="implied", scope=EVERY_NETWORK, where=ERRORS,
             note="Without the leakage, for which see 19.leakage.")
def weights_cancel() -> Goal:
    """D of the weights' part of V_1 without leakage."""
    rate = observer_loop()[w_f].xreplace({sigma_f: sp.Integer(0)})
    return Goal((equal(v_tilde * over_neurons(W_f_tilde * h_f) + D(V_f), 0),), flow={w_f: sp.expand(rate)})


@paper.claim("19.signal", "The signal of the update laws is the speed estimate's error", "identity",
             r"\dot{\tilde s} + k_1\tilde s = \tilde v", "proved", origin="implied", premises=("13",),
             where=OBSERVED)
def update_signal_is_error() -> Goal:
    """s_tilde' + k_1 s_tilde along (12)."""
    return Goal((equal(D(s_error) + k_1 * s_error, v_error),), flow=along_plant)


@paper.claim("19.measured", "The update laws need the measured position only", "identity",
             r"s, \hat s, \hat v\ \text{given} \Rightarrow \dot{\tilde s} + k_1\tilde s\ \text{given}", "refuted",
             origin="implied", premises=("19.signal",),
             note="The signal of (19), (20), (21) is v_hat - v: two trains with the same measured position and estimates "
                  "but different speeds give different signals. It can be had only by differentiating the measured "
                  "position, that is, by measuring the speed that the method claims not to need. Unlike in (12), no "
                  "integration hides it: D_1 takes its tanh.")
def measured_position_suffices() -> Goal:
    """The update signal for two speeds."""
    return Goal((equal(update_signal, update_signal.xreplace({v: v_other})),))


def _leakage(square: sp.Expr, leak: int) -> Goal:
    """The distance of an estimate from its prior does not grow while the errors that drive it are zero."""
    laws = observer_laws(leak) | tracking_laws(leak)
    moving = {estimate: sp.expand(rate.xreplace({v_hat: v, e_v: sp.Integer(0)})) for estimate, rate in laws.items()
              if square.has(estimate)}
    return Goal((at_most(D(square), 0),), flow=moving)


SIGMA = ("What a sigma-correction, as the paper calls the term, is for. With the printed plus sign the estimate leaves its "
         "prior exponentially. The sign is no slip of the pen: (39), (42), (53) and (54) carry it on and rely on Lemma 1, "
         "which holds only for the opposite estimation error, see 41.")


def leakage_claim(equation: str, name: str, square: sp.Expr, latex: tuple[str, str], corrected: str) -> None:
    """State that an estimate's leakage draws it to its prior, by the law as printed and by the corrected one."""
    scope = EVERY_NETWORK if square.has(sp.Sum) else "all values of the domain"
    law, decrease = latex

    @paper.claim(f"{equation}.leakage", f"The leakage draws {name} to its prior", "inequality",
                 rf"{law} \Rightarrow {decrease}", "refuted", origin="implied", scope=scope,
                 correction=lambda: _leakage(square, -1), corrected_statement=corrected, note=SIGMA)
    def leakage() -> Goal:
        return _leakage(square, 1)

    @paper.claim(f"{equation}.mended", f"The leakage draws {name} to its prior, its sign turned", "inequality",
                 rf"{corrected} \Rightarrow {decrease}", "proved", origin="ours", mends=f"{equation}.leakage", scope=scope)
    def mended_leakage() -> Goal:
        """Along the law with a minus sign before the leakage."""
        return _leakage(square, -1)


leakage_claim("19", "the weights", over_neurons((W_f_hat - W_f_0) ** 2),
              (r"\tilde v = 0,\ \dot{\hat W}_f = \Gamma_f\sigma_f(\hat W_f - W_{f0})",
               r"\frac{d}{dt}\|\hat W_f - W_{f0}\|^2 \le 0"),
              r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)\tilde v - \sigma_f(\hat W_f - W_{f0}))")


@paper.claim("20.cancels", "(20) and (21) cancel the estimate of delta in the rate of V_1", "identity",
             r"\tilde v D_1 + \tfrac1{\alpha_1}\tilde\delta\cdot\alpha_1\gamma(\tilde v)\tilde v = "
             r"-\tilde v\gamma(\tilde v)\delta", "proved", origin="implied", where={"D_1": in_errors(robust_1)},
             note="Without the leakage, for which see 21.leakage, and for a constant delta, see 38.delta.")
def robust_term_cancels() -> Goal:
    """D of the part of V_1 with delta_tilde, without leakage."""
    rate = observer_loop()[delta_tilde].xreplace({beta_1: sp.Integer(0)})
    return Goal((equal(v_tilde * in_errors(robust_1) + D(delta_tilde**2 / (2 * alpha_1)),
                       -v_tilde * gamma_1(v_tilde) * delta),), flow={delta_tilde: rate})


leakage_claim("21", "the estimate of delta", (delta_hat - delta_0) ** 2,
              (r"\tilde v = 0,\ \dot{\hat\delta} = \alpha_1\beta_1(\hat\delta - \delta_0)",
               r"\frac{d}{dt}(\hat\delta - \delta_0)^2 \le 0"),
              r"\dot{\hat\delta} = \alpha_1(\gamma(\tilde v)\tilde v - \beta_1(\hat\delta - \delta_0))")


# The signal of the update laws as it is printed, s_tilde' being free.
s_tilde_rate = sp.Symbol("sdot_tilde", real=True)
GAMMA_OF_SIGNAL = r"\gamma(\dot{\tilde s} + k_1\tilde s)"
free_signal = {s_tilde: s_tilde_rate}
signal = s_tilde_rate + k_1 * s_tilde


@paper.claim("remark1", "Remark 1: the smooth sign", "inequality",
             r"|\dot{\tilde s} + k_1\tilde s| \le (\dot{\tilde s} + k_1\tilde s)\gamma(\dot{\tilde s} + k_1\tilde s) + "
             r"\kappa_1", "proved", rests_on=(), where={GAMMA_OF_SIGNAL: gamma_1(UPDATE_SIGNAL)})
def remark_1() -> Goal:
    """With tanh."""
    return Goal((at_most(sp.Abs(UPDATE_SIGNAL), UPDATE_SIGNAL * gamma_1(UPDATE_SIGNAL) + kappa_1),), flow=free_signal,
                facts=smooth_sign_facts(signal, kappa_1), lemmas=(constant_suffices, *smooth_sign(signal, kappa_1)))


@paper.claim("remark1.linear", "Remark 1: the linear choice of gamma", "inequality",
             r"\gamma(\dot{\tilde s} + k_1\tilde s) = (\dot{\tilde s} + k_1\tilde s)/4\kappa_1", "proved", rests_on=(),
             reading="That this gamma 'can also be selected' is read as: it meets the inequality of Remark 1.",
             note="With this gamma the constant 0.2785 of (42), (43) has to be 1.")
def remark_1_linear() -> Goal:
    """A square: (|s_tilde' + k_1 s_tilde| - 2 kappa_1)^2 >= 0."""
    linear = UPDATE_SIGNAL / (4 * kappa_1)
    return Goal((at_most(sp.Abs(UPDATE_SIGNAL), UPDATE_SIGNAL * linear + kappa_1),), flow=free_signal)


@paper.claim("remark2", "Remark 2: the estimation errors can be set to approximately zero", "limit",
             r"\text{the estimation error}\ (\tilde s, \tilde v)\ \text{can be set to approximately zero}", "refuted",
             severity="result", match="words", closed_loop=True, rests_on=("theorem1",),
             scope="one neuron",
             reading="Along (13), (18)-(21) as printed v_tilde is in the end at most 0.5 m/s.",
             note="v_tilde stays at log(3)/2 = 0.549 m/s for ever, though the network is exact, the priors are right and "
                  "(40) holds, while W_f_hat and delta_hat grow against each other. Lengths and kappa_1 scale with it.")
def estimates_settle() -> Goal:
    """A motion with a constant v_tilde."""
    return observer_motion(at_most(v_tilde, sp.Rational(1, 2)))

"""Section 3: the laws of the observer, (19)-(21), and Remarks 1 and 2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_most, equal

from ..error_dynamics import W_f_tilde, delta, delta_tilde, in_errors, observer_loop, one_neuron, w_f
from ..exact_motions import UPDATE_SIGNAL, observer_motion
from ..laws import (
    W_f_0,
    W_f_hat,
    alpha_1,
    beta_1,
    delta_0,
    delta_hat,
    e_v,
    g_f,
    g_v,
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
from .section_1 import v_other
from .section_3_eq_11_to_18 import along_plant

GAMMA_OF_SIGNAL = r"\gamma(\dot{\tilde s} + k_1\tilde s)"
HATS = "The extracted text has hats, and stray letters, over s where the section speaks of the estimation error."
LAW_19 = (r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)(\dot{\tilde s} + k_1\tilde s) + \sigma_f(\hat W_f - W_{f0}))")
LAW_21 = (rf"\dot{{\hat\delta}} = \alpha_1({GAMMA_OF_SIGNAL}(\dot{{\tilde s}} + k_1\tilde s) + "
          r"\beta_1(\hat\delta - \delta_0))")

paper.definition("19", "The law of the weights of the observer", LAW_19, reading=HATS,
                 note="What its last term does is 19.leakage.")
paper.definition("20", "The robust term of the observer", rf"D_1 = -{GAMMA_OF_SIGNAL}\hat\delta", reading=HATS)
paper.definition("21", "The law of the estimate of delta", LAW_21, note="What its last term does is 21.leakage.",
                 reading=f"The accent over the last delta is read as the index 0. {HATS}")


@paper.claim("19.cancels", "The first term of (19) cancels the weights in the rate of V_1", "identity",
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


@paper.claim("19.measured", "The update laws need no more than the position measured at the instant", "implication",
             r"s, \hat s, \hat v\ \text{given at an instant} \Rightarrow \dot{\tilde s} + k_1\tilde s\ \text{given}", "gap",
             origin="implied", premises=("19.signal",),
             note="The signal of (19), (20), (21) is v_hat - v: two trains with the same measured position and estimates "
                  "but different speeds give different signals. It can be had only by differentiating the measured "
                  "position. No integration hides it, as in (12): D_1 takes its tanh, and with the linear gamma of Remark 1 "
                  "delta_hat' takes its square.")
def measured_position_suffices() -> Goal:
    """The update signal for two speeds."""
    return Goal((equal(update_signal, update_signal.xreplace({v: v_other})),))


G_f, G_v = sp.symbols("G_f G_v", positive=True)  # eigenvalues of the gains


def _undriven(estimate: sp.Expr, leak: int) -> sp.Expr:
    """The rate of an estimate, of one weight in a network, while the error that drives its law is zero."""
    rate = (observer_laws(leak) | tracking_laws(leak))[estimate].xreplace({v_hat: v, e_v: sp.Integer(0)})
    return one_neuron(rate).xreplace({one_neuron(g_f) ** 2: G_f, one_neuron(g_v) ** 2: G_v})


SIGMA = ("The last term is a sigma-correction, as the text before (35) calls it: it is to draw the estimate to its prior. "
         "With the printed plus sign the estimate leaves its prior exponentially. The sign is no slip of the pen: (39), "
         "(42), (53) and (54) carry it on and apply Lemma 1, which is for the opposite estimation error, see 41.reversed. The "
         "conditions are those of the corrected law; the values of the finding are along the printed one, plus sign and all. "
         "Mended are (19), (21), (32) and (35) by a minus before the leakage, and (32) by a plus before h_v e_v as well, see "
         "32.cancels.")


def leakage_claim(equation: str, name: str, law: str, corrected: str, decay: str, estimate: sp.Expr, prior: sp.Expr,
                  section: str) -> None:
    """State that the leakage of a law draws an estimate to its prior, as printed and with its sign turned.

    decay: LaTeX of what is to hold while nothing else drives the law.
    """
    scope = "each weight, along the eigenvectors of the gain matrix" if isinstance(estimate, sp.Indexed) else (
        "all values of the domain")
    printed, turned = _undriven(estimate, 1), _undriven(estimate, -1)
    own, its_prior = one_neuron(estimate), one_neuron(prior)

    def distance_falls(rate: sp.Expr) -> Goal:
        return Goal((at_most(D((own - its_prior) ** 2), 0),), flow={own: rate})

    @paper.claim(f"{equation}.leakage", f"The leakage draws {name} to the prior", "inequality", law, "refuted",
                 rests_on=(), correction=lambda: distance_falls(turned), corrected_statement=corrected,
                 scope=scope, note=SIGMA, section=section,
                 reading="The distance from the prior does not grow while the error in the law is zero.")
    def leakage() -> Goal:
        return distance_falls(printed)

    @paper.claim(f"{equation}.mended", f"The leakage draws {name} to the prior, its sign turned", "inequality",
                 rf"{corrected},\ {decay}", "proved", origin="ours", mends=f"{equation}.leakage", scope=scope,
                 section=section)
    def mended_leakage() -> Goal:
        """Along the law with a minus sign before the leakage."""
        return distance_falls(turned)


leakage_claim("19", "the weights", LAW_19,
              r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)(\dot{\tilde s} + k_1\tilde s) - \sigma_f(\hat W_f - W_{f0}))",
              r"\tilde v = 0 \Rightarrow \frac{d}{dt}(\hat W_f - W_{f0})_i^2 \le 0", W_f_hat, W_f_0, "3")


@paper.claim("20.cancels", "(20) and the first term of (21) cancel the estimate of delta in the rate of V_1", "identity",
             r"\tilde v D_1 + \tfrac1{\alpha_1}\tilde\delta\cdot\alpha_1\gamma(\tilde v)\tilde v = "
             r"-\tilde v\gamma(\tilde v)\delta", "proved", origin="implied", where={"D_1": in_errors(robust_1)},
             note="Without the leakage, for which see 21.leakage, and for a constant delta, see 38.delta.")
def robust_term_cancels() -> Goal:
    """D of the part of V_1 with delta_tilde, without leakage."""
    rate = observer_loop()[delta_tilde].xreplace({beta_1: sp.Integer(0)})
    return Goal((equal(v_tilde * in_errors(robust_1) + D(delta_tilde**2 / (2 * alpha_1)),
                       -v_tilde * gamma_1(v_tilde) * delta),), flow={delta_tilde: rate})


leakage_claim("21", "the estimate of delta", LAW_21,
              rf"\dot{{\hat\delta}} = \alpha_1({GAMMA_OF_SIGNAL}(\dot{{\tilde s}} + k_1\tilde s) - "
              r"\beta_1(\hat\delta - \delta_0))",
              r"\tilde v = 0 \Rightarrow \frac{d}{dt}(\hat\delta - \delta_0)^2 \le 0", delta_hat, delta_0, "3")


# The signal of the update laws as it is printed, s_tilde' being free.
s_tilde_rate = sp.Symbol("sdot_tilde", real=True)
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
             r"\text{the estimation error}\ (\tilde s, \tilde v)\ \text{can be set to approximately zero}", "gap",
             severity="result", match="words", rests_on=("theorem1",), scope="one neuron",
             reading="The remark names no gains. Decided is whether its laws alone give a small error: along (13), (18)-(21) "
                     "as printed v_tilde is in the end at most 30 m/s.",
             note="v_tilde stays at 30 log(3) = 33 m/s for ever, though the network is exact, the priors are right and (40) "
                  "holds, while W_f_hat and delta_hat grow against each other. This does not refute the remark, if it asks "
                  "for some gains: v_tilde there is kappa_1 log(3)/2, and kappa_1 is 60 m/s. Whether some gains do for all "
                  "starts is open: for k_1 = k_3 = 2, k_2 = 5, Gamma_f = h_f = 1, alpha_1 = 8, beta_1 = 0.05, sigma_f = 0.01, kappa_1 = 0.1 simulated errors "
                  "come to rest near zero, while delta_hat and W_f_hat diverge; delta_hat can for all gains (48.zero). With the "
                  "leakage turned the remark holds, see remark2.mended.")
def estimates_settle() -> Goal:
    """A motion with a constant v_tilde."""
    return observer_motion(at_most(v_tilde, 30))

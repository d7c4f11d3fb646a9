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
    gamma_1,
    h_f,
    k_1,
    kappa_1,
    observer_laws,
    robust_1,
    s_error,
    s_hat,
    s_hat_rate,
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
from ..plant import s, v
from ..smooth_sign import constant_suffices, smooth_sign, smooth_sign_facts
from .section_1 import v_other
from .section_3_eq_11_to_18 import along_plant

# The laws of one neuron as they run, and the letters that they are printed in.
GAMMA_OF_SIGNAL = r"\gamma(\dot{\tilde s} + k_1\tilde s)"
printed_signal = D(s_error) + k_1 * s_error
PRINTED_LAWS = OBSERVED | {r"\hat W_f": one_neuron(W_f_hat), "W_{f0}": one_neuron(W_f_0), r"\Gamma_f": one_neuron(g_f**2),
                           r"h_f(\hat z_1)": one_neuron(h_f), GAMMA_OF_SIGNAL: gamma_1(printed_signal)}
HATS = "The extracted text has hats, and stray letters, over s where the section speaks of the estimation error."


@paper.claim("19", "The law of the weights of the observer", "identity",
             r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)(\dot{\tilde s} + k_1\tilde s) + \sigma_f(\hat W_f - W_{f0}))", "proved",
             rests_on=(), scope="every neuron", where=PRINTED_LAWS,
             reading="Of one neuron, which stands for each; the rate is that of its weight in the loop that runs as "
                     f"printed. {HATS}")
def rate_of_weight() -> Goal:
    """The rate of one weight as it is simulated, against the printed line."""
    weight, prior = one_neuron(W_f_hat), one_neuron(W_f_0)
    stated = one_neuron(g_f**2) * (-one_neuron(h_f) * printed_signal + sigma_f * (weight - prior))
    return Goal((equal(D(weight), stated),), flow={s: v, s_hat: s_hat_rate, weight: one_neuron(observer_laws()[W_f_hat])})


@paper.claim("20", "The robust term of the observer", "identity", rf"D_1 = -{GAMMA_OF_SIGNAL}\hat\delta", "proved", rests_on=(),
             where=PRINTED_LAWS | {"D_1": robust_1}, reading=f"D_1 as it runs. {HATS}")
def robust_term() -> Goal:
    """D_1 as it is simulated, by v_hat - v, against the printed line."""
    return Goal((equal(robust_1, -gamma_1(printed_signal) * delta_hat),), flow=along_plant)


@paper.claim("21", "The law of the estimate of delta", "identity",
             rf"\dot{{\hat\delta}} = \alpha_1({GAMMA_OF_SIGNAL}(\dot{{\tilde s}} + k_1\tilde s) + "
             r"\beta_1(\hat\delta - \delta_0))", "proved", rests_on=(), where=PRINTED_LAWS,
             reading=f"The rate is that of the loop that runs as printed; the accent over the last delta is a zero's. {HATS}")
def rate_of_estimate() -> Goal:
    """The rate of delta_hat as it is simulated, against the printed line."""
    stated = alpha_1 * (gamma_1(printed_signal) * printed_signal + beta_1 * (delta_hat - delta_0))
    return Goal((equal(D(delta_hat), stated),), flow={**along_plant, delta_hat: observer_laws()[delta_hat]})


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
         "prior exponentially. The sign is no slip of the pen: (39), (42), (53) and (54) carry it on and apply Lemma 1, "
         "which holds only for the opposite estimation error, see 41.reversed.")


def leakage_claim(equation: str, name: str, square: sp.Expr, latex: tuple[str, str], corrected: str, section: str) -> None:
    """State that an estimate's leakage draws it to the prior, by the law as printed and by the corrected one."""
    scope = EVERY_NETWORK if square.has(sp.Sum) else "all values of the domain"
    law, decrease = latex

    @paper.claim(f"{equation}.leakage", f"The leakage draws {name} to the prior", "inequality",
                 rf"{law} \Rightarrow {decrease}", "refuted", origin="implied", scope=scope,
                 correction=lambda: _leakage(square, -1), corrected_statement=corrected, note=SIGMA, section=section)
    def leakage() -> Goal:
        return _leakage(square, 1)

    @paper.claim(f"{equation}.mended", f"The leakage draws {name} to the prior, its sign turned", "inequality",
                 rf"{corrected} \Rightarrow {decrease}", "proved", origin="ours", mends=f"{equation}.leakage", scope=scope,
                 section=section)
    def mended_leakage() -> Goal:
        """Along the law with a minus sign before the leakage."""
        return _leakage(square, -1)


leakage_claim("19", "the weights", over_neurons((W_f_hat - W_f_0) ** 2),
              (r"\tilde v = 0,\ \dot{\hat W}_f = \Gamma_f\sigma_f(\hat W_f - W_{f0})",
               r"\frac{d}{dt}\|\hat W_f - W_{f0}\|^2 \le 0"),
              r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)\tilde v - \sigma_f(\hat W_f - W_{f0}))", "3")


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
              r"\dot{\hat\delta} = \alpha_1(\gamma(\tilde v)\tilde v - \beta_1(\hat\delta - \delta_0))", "3")


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
             r"\text{the estimation error}\ (\tilde s, \tilde v)\ \text{can be set to approximately zero}", "refuted",
             severity="result", match="words", closed_loop=True, rests_on=("theorem1",),
             scope="one neuron",
             reading="For all gains, of which the remark demands nothing: along (13), (18)-(21) as printed v_tilde is in the "
                     "end at most 30 m/s.",
             note="v_tilde stays at 30 log(3) = 33 m/s for ever, though the network is exact, the priors are right and (40) "
                  "holds, while W_f_hat and delta_hat grow against each other; it scales with kappa_1, 60 m/s here. A "
                  "standing train can be taken for one of 119 km/h so: v = 0, u = f_d = a_0, d = 0, W_f* = 0 and the centre of the neuron at the constant "
                  "z_1_hat. For small beta_1 and sigma_f the speed error may stay small in a run, since the leakage then "
                  "needs long; delta_hat leaves its prior for all gains (48.zero). With the leakage turned the remark "
                  "holds, see remark2.mended.")
def estimates_settle() -> Goal:
    """A motion with a constant v_tilde."""
    return observer_motion(at_most(v_tilde, 30))

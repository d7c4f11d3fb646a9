"""Section 3: the loop that runs has the laws (12), (19)-(21) as they are printed."""

from __future__ import annotations

from workbench.proof.claim import D, Goal, equal

from ..error_dynamics import one_neuron
from ..laws import (
    W_f_0,
    W_f_hat,
    alpha_1,
    beta_1,
    delta_0,
    delta_hat,
    g_f,
    gamma_1,
    h_f,
    k_1,
    observer_laws,
    robust_1,
    s_error,
    s_hat,
    s_hat_rate,
    sigma_f,
    v_hat,
)
from ..notation import OBSERVED
from ..paper import paper
from ..plant import s, v
from .section_3_eq_11_to_18 import LAW_12, along_plant, along_printed
from .section_3_eq_19_to_21 import GAMMA_OF_SIGNAL, LAW_19, LAW_21

# The laws of one neuron as they run, and the letters that they are printed in.
printed_signal = D(s_error) + k_1 * s_error
PRINTED_LAWS = OBSERVED | {r"\hat W_f": one_neuron(W_f_hat), "W_{f0}": one_neuron(W_f_0), r"\Gamma_f": one_neuron(g_f**2),
                           r"h_f(\hat z_1)": one_neuron(h_f), GAMMA_OF_SIGNAL: gamma_1(printed_signal)}


@paper.claim("12.runs", "The estimate of the position runs by (12)", "identity", LAW_12, "proved", origin="ours", where=OBSERVED,
             reading="The rate is that of the estimate in the loop that runs.")
def position_estimate() -> Goal:
    """D(s_hat) of the observer."""
    return Goal((equal(D(s_hat), v_hat - k_1 * s_error),), flow=along_printed)


@paper.claim("19.runs", "The weights of the observer run by (19)", "identity", LAW_19, "proved", origin="ours",
             scope="every neuron", where=PRINTED_LAWS,
             reading="Of one neuron, which stands for each; the rate is that of its weight in the loop that runs as printed.")
def rate_of_weight() -> Goal:
    """The rate of one weight as it is simulated, against the printed line."""
    weight, prior = one_neuron(W_f_hat), one_neuron(W_f_0)
    stated = one_neuron(g_f**2) * (-one_neuron(h_f) * printed_signal + sigma_f * (weight - prior))
    return Goal((equal(D(weight), stated),), flow={s: v, s_hat: s_hat_rate, weight: one_neuron(observer_laws()[W_f_hat])})


@paper.claim("20.runs", "The robust term of the observer runs by (20)", "identity", rf"D_1 = -{GAMMA_OF_SIGNAL}\hat\delta",
             "proved", origin="ours", where=PRINTED_LAWS | {"D_1": robust_1}, reading="D_1 as it runs.")
def robust_term() -> Goal:
    """D_1 as it is simulated, by v_hat - v, against the printed line."""
    return Goal((equal(robust_1, -gamma_1(printed_signal) * delta_hat),), flow=along_plant)


@paper.claim("21.runs", "The estimate of delta runs by (21)", "identity", LAW_21, "proved", origin="ours",
             where=PRINTED_LAWS, reading="The rate is that of the loop that runs as printed.")
def rate_of_estimate() -> Goal:
    """The rate of delta_hat as it is simulated, against the printed line."""
    stated = alpha_1 * (gamma_1(printed_signal) * printed_signal + beta_1 * (delta_hat - delta_0))
    return Goal((equal(D(delta_hat), stated),), flow={**along_plant, delta_hat: observer_laws()[delta_hat]})

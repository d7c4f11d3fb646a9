"""Section 4: the loop that runs has the laws (31), (32), (34), (35) as they are printed."""

from __future__ import annotations

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, equal

from ..error_dynamics import one_neuron
from ..laws import (
    D_2,
    W_v_0,
    W_v_hat,
    alpha_2,
    beta_2,
    command,
    e_v,
    g_v,
    gamma_2,
    h_v,
    k_5,
    robust_2,
    sigma_v,
    theta_0,
    theta_hat,
    tracking_laws,
)
from ..paper import EVERY_NETWORK, paper
from ..plant import M, acceleration, chi, d, f_d, u, v
from .section_4_eq_28_to_35 import LAW_32, LAW_35

felt_input = M / chi * (D(v) - d) + f_d  # what (9) says of the input of a moving train
robust_of_train = felt_input - over_neurons(W_v_hat * h_v) - k_5 * e_v


@paper.claim("31.runs", "The input of the train that runs is (31)", "identity", r"u(t) = \hat W_v^Th_v(z_2) + k_5e_v + D_2",
             "proved", origin="ours", scope=EVERY_NETWORK, where={"u(t)": felt_input},
             reading="u is the input that the train feels, by (9).",
             note="The input of the loop that is run, read back from the train's acceleration.")
def control_law() -> Goal:
    """The train of (9) with the command that is simulated."""
    stated = over_neurons(W_v_hat * h_v) + k_5 * e_v + D_2
    return Goal((equal(felt_input, stated),), flow={v: acceleration.xreplace({u: command})})


@paper.claim("32.runs", "The weights of the controller run by (32)", "identity", LAW_32, "proved", origin="ours",
             scope="every neuron",
             where={r"\hat W_v": one_neuron(W_v_hat), "W_{v0}": one_neuron(W_v_0), r"\Gamma_v": one_neuron(g_v**2),
                    "h(z_2)": one_neuron(h_v)},
             reading="Of one neuron, which stands for each; the rate is that of its weight in the loop that runs as printed.")
def rate_of_weight() -> Goal:
    """The rate of one weight as it is simulated, against the printed line."""
    weight, prior = one_neuron(W_v_hat), one_neuron(W_v_0)
    stated = one_neuron(g_v**2) * (-one_neuron(h_v) * e_v + sigma_v * (weight - prior))
    return Goal((equal(D(weight), stated),), flow={weight: one_neuron(tracking_laws()[W_v_hat])})


@paper.claim("34.runs", "The robust term of the controller runs by (34)", "identity", r"D_2 = \gamma(e_v)\hat\theta", "proved",
             origin="ours", scope=EVERY_NETWORK, where={"D_2": robust_of_train, r"\gamma(e_v)": gamma_2(e_v)},
             reading="D_2 is what the input of the train, read back from its acceleration by (9), has besides the first two "
                     "terms of (31).")
def robust_term() -> Goal:
    """The loop that is run, without the network and k_5 e_v."""
    running = acceleration.xreplace({u: command.xreplace({D_2: robust_2})})
    return Goal((equal(robust_of_train, gamma_2(e_v) * theta_hat),), flow={v: running})


@paper.claim("35.runs", "The estimate of theta runs by (35)", "identity", LAW_35, "proved", origin="ours",
             reading="The rate is that of the loop that runs as printed.")
def rate_of_estimate() -> Goal:
    """The rate of theta_hat as it is simulated, against the printed line."""
    return Goal((equal(D(theta_hat), alpha_2 * (gamma_2(e_v) * e_v + beta_2 * (theta_hat - theta_0))),),
                flow={theta_hat: tracking_laws()[theta_hat]})

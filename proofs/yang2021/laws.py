"""The laws of yang2021: RBFNN-POCRAC and POCRAC, as printed in (5), (16), (22)-(37), and RBFNN-PID."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import (
    ControlLaw,
    LawState,
    desired_acceleration,
    desired_position,
    desired_speed,
    neuron,
    over_neurons,
    position,
    speed,
)

from .network import center_step, center_step_as_printed, hidden_output
from .rbf_pid import incremental_pid

alpha, beta, chi, k = sp.symbols("alpha beta chi k", positive=True)
lambda_1, lambda_2, lambda_3 = sp.symbols("lambda_1:4", positive=True)
sigma_1, sigma_2, sigma_3 = sp.symbols("sigma_1:4", positive=True)
a_hat, b_hat, c_hat = sp.symbols("a_hat b_hat c_hat", real=True)

W_hat = sp.IndexedBase("W_hat", real=True)[neuron]
center_1 = sp.IndexedBase("c_1", real=True)[neuron]
center_2 = sp.IndexedBase("c_2", real=True)[neuron]
width = sp.IndexedBase("b_h", positive=True)[neuron]

x_1, x_2 = position, speed

h = hidden_output((x_1, x_2), (center_1, center_2), width)

e_1 = x_1 - desired_position  # (22)
edot_1 = x_2 - desired_speed  # (24)
r = -alpha * e_1 + desired_speed  # (27)
rdot = -alpha * edot_1 + desired_acceleration  # (28)
e_2 = x_2 - r  # (23)

adaptation = (
    LawState(a_hat, rate=-lambda_1 * (e_2 + sigma_1 * a_hat)),  # (34)
    LawState(b_hat, rate=-lambda_2 * (x_2 * e_2 + sigma_2 * b_hat)),  # (35)
    LawState(c_hat, rate=-lambda_3 * (x_2**2 * e_2 + sigma_3 * c_hat)),  # (36)
)
weight_adaptation = LawState(W_hat, rate=chi * e_2 * h - chi * W_hat)  # (37)

f_hat = over_neurons(W_hat * h)  # (16)
resistance_estimate = a_hat + b_hat * x_2 + c_hat * x_2**2
feedback = rdot - beta * e_2 - e_1 / (k**2 - e_1**2)

rbfnn_pocrac = ControlLaw(
    id="yang2021.rbfnn_pocrac",
    title="RBFNN-POCRAC",
    source="yang2021 (27), (33)-(37)",
    information="full state, model unknown",
    command=resistance_estimate - f_hat + feedback,  # (33)
    states=(*adaptation, weight_adaptation),
    parameters=(alpha, beta, chi, k, lambda_1, lambda_2, lambda_3, sigma_1, sigma_2, sigma_3),
    neuron_data=(center_1, center_2, width),
    domain=(k**2 - e_1**2,),
    errors={"e_1": e_1, "e_2": e_2},
)

pocrac = ControlLaw(
    id="yang2021.pocrac",
    title="POCRAC",
    source="yang2021 (27), (33)-(36) without the network",
    information="full state, model unknown",
    command=resistance_estimate + feedback,
    states=adaptation,
    parameters=(alpha, beta, k, lambda_1, lambda_2, lambda_3, sigma_1, sigma_2, sigma_3),
    domain=(k**2 - e_1**2,),
    errors={"e_1": e_1, "e_2": e_2},
)

rbf_pid = incremental_pid("yang2021.rbf_pid", "RBFNN-PID", "textbook RBF-PID with yang2021 (10)-(15), (14) corrected",
                          center_step)
rbf_pid_printed = incremental_pid("yang2021.rbf_pid_printed", "RBFNN-PID, (14) as printed",
                                  "textbook RBF-PID with yang2021 (10)-(15) as printed", center_step_as_printed)

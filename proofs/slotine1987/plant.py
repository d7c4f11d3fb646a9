"""slotine1987: an arm of two links in a horizontal plane, H(q) q'' + C(q, q') q' = tau."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

q_1, q_2, w_1, w_2 = sp.symbols("q_1 q_2 w_1 w_2", real=True)  # angles (rad) and their rates (rad/s)
tau_1, tau_2, d_1, d_2 = sp.symbols("tau_1 tau_2 d_1 d_2", real=True)  # torques and disturbing torques (N m)
# Inertias (kg m^2): a_3 and a_4 are those of the load at the elbow, along the second link and across it.
a_1, a_2 = sp.symbols("a_1 a_2", positive=True)
a_3, a_4 = sp.symbols("a_3 a_4", real=True)
A = (a_1, a_2, a_3, a_4)
cosine, sine = sp.cos(q_2), sp.sin(q_2)

elbow = a_3 * cosine + a_4 * sine
h = a_3 * sine - a_4 * cosine
H = sp.Matrix([[a_1 + 2 * elbow, a_2 + elbow], [a_2 + elbow, a_2]])
C = sp.Matrix([[-h * w_2, -h * (w_1 + w_2)], [h * w_1, 0]])
determinant = H[0, 0] * H[1, 1] - H[0, 1] ** 2

w = sp.Matrix([w_1, w_2])
driving = sp.Matrix([tau_1 + d_1, tau_2 + d_2]) - C * w
accelerations = sp.Matrix([[H[1, 1], -H[0, 1]], [-H[0, 1], H[0, 0]]]) * driving / determinant

# m_1 = 1, l_1 = 1, l_c1 = 0.5, I_1 = 0.12, m_e = 2, l_ce = 0.6, I_e = 0.25, delta_e = 30 degrees, in SI.
arm = Plant(
    "slotine1987.arm", states=(q_1, q_2, w_1, w_2), rates=(w_1, w_2, *accelerations), inputs=(tau_1, tau_2),
    disturbances=(d_1, d_2), title="two links in a horizontal plane",
    parameters=tuple(Parameter(symbol, value, "kg m^2") for symbol, value in zip(
        A, (3.34, 0.97, 1.2 * float(sp.sqrt(3)) / 2, 0.6), strict=True)),
    domain=(determinant,), units={q_1: "rad", q_2: "rad", w_1: "rad/s", w_2: "rad/s", tau_1: "N m", tau_2: "N m"})

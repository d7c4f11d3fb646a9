"""Theorem 1, step 3: boundedness of all variables."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most
from workbench.trains.multi_particle import c_0, c_a, c_d, c_k, c_v, over_cars

from ..energy_function import E_1, E
from ..goal_forms import J_i, along_iterations, i_axis, y_i
from ..laws import z_1, z_2
from ..one_car import estimate, g_high, g_low
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import car_forces
from .section_3_theorem_1_step_2_eq_52_to_55 import PART_3

level = sp.Symbol("B", positive=True)


@paper.claim("theorem1.1.z", "z_1 and z_2 are bounded, uniformly in the iterations", "implication",
             r"\|z_{1,i}(t)\|^2 + \|z_{2,i}(t)\|^2 \le 2E_1(t)", "proved",
             premises=("46", "45.bounded"), scope=EVERY_TRAIN)
def z_bounded() -> Goal:
    """V_i <= E_i <= E_1."""
    return Goal((at_most(over_cars(z_1**2 + z_2**2), 2 * E_1),), (at_most(E, E_1),))


@paper.claim("theorem1.1.mass", "The estimate of the mass is bounded", "implication",
             r"\underline M \le \hat M_i \le \overline M", "proved", scope=EACH_CAR)
def mass_estimate_bounded() -> Goal:
    """(22)."""
    return Goal((at_least(estimate, g_low), at_most(estimate, g_high)), (at_most(g_low, g_high),))


@paper.claim("theorem1.1.estimates", "E_i bounded makes the other estimates bounded", "implication",
             r"E_i \le E_1 \Rightarrow \tilde\theta_i(t)\ \text{bounded}", "gap", premises=("46", "45.bounded"),
             note="E_i holds integrals of the squared errors, which do not bound their values: theta_tilde_i(tau)^2 = "
                  "(B+i+1) tau^(B+i) on [0, 1] has the integral 1 and ends above B, for every B. In each iteration the "
                  "estimates are bounded when v is, by (17)-(21), but no bound for all iterations is shown.")
def estimates_bounded() -> Goal:
    """y = theta_tilde_i(1)^2 from the integral J of theta_tilde_i^2, which is bounded."""
    return along_iterations(at_most(y_i, level), (at_most(J_i, 1), at_least(J_i, 0), at_least(y_i, 0)),
                            {J_i: sp.Integer(1), y_i: level + i_axis + 1}, {level: sp.Integer(1)})


def _train_energy() -> Goal:
    """Kinetic and coupler energy of six cars under forces F_j = u_j + f^a_j - c_0 m_j, named f_a_j."""
    newton, _, symbols = car_forces(6)
    S, Vs, masses = symbols["s"], symbols["v"], symbols["m"]
    spring, damper, rolling, air = (sp.Symbol(str(x), nonnegative=True) for x in (c_k, c_d, c_v, c_a))
    put = {c_k: spring, c_d: damper, c_v: rolling, c_a: air, c_0: sp.S.Zero}
    kinetic = sum((m_j * v_j**2 / 2 for m_j, v_j in zip(masses, Vs, strict=True)), sp.S.Zero)
    stretch = sum((spring * (S[j] - S[j + 1]) ** 2 / 2 for j in range(5)), sp.S.Zero)
    rates = dict(zip(S, Vs, strict=True)) | {v_j: force.xreplace(put) / m_j
                                             for v_j, force, m_j in zip(Vs, newton, masses, strict=True)}
    forced = sum((f_j**2 / (2 * m_j) for f_j, m_j in zip(symbols["f_a"], masses, strict=True)), sp.S.Zero)
    return Goal((at_most(D(kinetic + stretch), kinetic + stretch + forced),), (at_least(Vs[0], 0),), rates)


@paper.claim("theorem1.1.state", "s and v are bounded according to (54) and (55)", "implication",
             rf"\int_0^T\|e_{{s,i}}\|^2d\tau \le {PART_3} \Rightarrow s_i\ \text{{bounded}}", "gap",
             premises=("54", "55"), correction=_train_energy,
             corrected_statement=r"v_1 \ge 0 \Rightarrow \dot K \le K + \sum_j\tfrac{F_j^2}{2m_j},\ K = "
                                 r"\sum_j\tfrac{m_j}2v_j^2 + \sum_j\tfrac{c_k}2(s_j - s_{j+1})^2,\ F_j = u_j + f^a_j - "
                                 r"c_0m_j",
             scope="corrected for six cars",
             note="The bounds contain the saturation, of which nothing is shown: mu is not bounded anywhere, so Delta "
                  "u, lambda and s may grow with the iterations while z stays small (the model; and integrals do not "
                  "bound values). The train itself helps out: with limited forces its energy stays bounded on [0, T] "
                  "while it does not run backwards (then (2) would push instead of resist), and with it lambda = e - "
                  "z.")
def state_bounded() -> Goal:
    """The integral J of e_s^2 from E_{i-1} <= E_1 and the saturation y, both constants of (54) taken as 1."""
    always = (at_most(J_i, 1 + y_i), at_least(J_i, 0), at_least(y_i, 0))
    return along_iterations(at_most(J_i, level), always, {J_i: level + i_axis + 1, y_i: level + i_axis + 1},
                            {level: sp.Integer(1)})

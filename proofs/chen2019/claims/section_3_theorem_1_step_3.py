"""Theorem 1, step 3: boundedness of all variables."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most
from workbench.trains.multi_particle import c_0, c_a, c_d, c_k, c_v, over_cars

from ..energy_function import E_1, S_1, S_2, Z_1, Z_2, E, E_now, J
from ..goal_forms import J_i, along_iterations, i_axis, y_i
from ..laws import learning_gains, z_1, z_2
from ..one_car import estimate, g_high, g_low
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import car_forces

level = sp.Symbol("B", positive=True)


def _below_e_1() -> tuple[Relation, ...]:
    """E_i <= E_1, from (46), for E_i by (25)."""
    return (*(r.subs({E_now: E}) for r in paper.shown("46")), at_least(S_1 + Z_1, 0), at_least(S_2 + Z_2, 0))


@paper.claim("theorem1.1.z", "z_1 and z_2 are bounded, uniformly in the iterations", "implication",
             r"\text{The boundedness of $E_i$, $z_{1,i}$, $z_{2,i}$ and the tracking errors have been proved in the last "
             r"steps.}", "proved", match="words", premises=("46", "45.bounded"), scope=EVERY_TRAIN,
             reading="|z_1|^2 + |z_2|^2 <= 2 E_1 at every instant of every iteration.")
def z_bounded() -> Goal:
    """V_i <= E_i <= E_1."""
    return Goal((at_most(over_cars(z_1**2 + z_2**2), 2 * E_1),), _below_e_1())


@paper.claim("theorem1.1.mass", "The estimate of the mass is bounded", "implication",
             r"\text{the saturation operator is applied to the learning process of $M$ to retain its estimation within the "
             r"required bounds.}", "proved", match="words", scope=EACH_CAR, reading="M_low <= M_hat_i <= M_high, by (22).")
def mass_estimate_bounded() -> Goal:
    """(22)."""
    return Goal((at_least(estimate, g_low), at_most(estimate, g_high)), (at_most(g_low, g_high),))


def _no_bound_of_values() -> Goal:
    """y, a squared value at an instant, from the integral J of such squares, which is bounded."""
    return along_iterations(at_most(y_i, level), (at_most(J_i, 1), at_least(J_i, 0), at_least(y_i, 0)),
                            {J_i: sp.Integer(1), y_i: level + i_axis + 1}, {level: sp.Integer(1)})


@paper.claim("theorem1.1.estimates", "E_i bounded makes the other estimates bounded", "implication",
             r"\text{According the definition of $E_i$, it can draw the conclusion that $\Theta_{v,i}$, $\theta_{a,i}$, "
             r"$\theta_{k,i}$, $\theta_{d,i}$, $\eta_i$ and $M_i$ are all bounded.}", "gap", match="words",
             premises=("46", "45.bounded"),
             reading="The values of the estimates at an instant, for all iterations, from E_i <= E_1.",
             note="E_i holds integrals of the squared errors, which do not bound their values: theta_tilde_i(tau)^2 = "
                  "(B+i+1) tau^(B+i) on [0, 1] has the integral 1 and ends above B, for every B. In each iteration the "
                  "estimates are bounded when v is, by (17)-(21), but no bound for all iterations is shown.")
def estimates_bounded() -> Goal:
    """y = theta_tilde_i(1)^2 from the integral J of theta_tilde_i^2, which is bounded."""
    return _no_bound_of_values()


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


ENERGY = (r"v_1 \ge 0 \Rightarrow \dot K \le K + \sum_j\tfrac{F_j^2}{2m_j},\ K = \sum_j\tfrac{m_j}2v_j^2 + "
          r"\sum_j\tfrac{c_k}2(s_j - s_{j+1})^2,\ F_j = u_j + f^a_j - c_0m_j")


@paper.claim("theorem1.1.state", "s and v are bounded according to (54) and (55)", "implication",
             r"\text{since $s_r$ and $v_r$ are the known bounded variables in the interval [0, T], the displacement $s_i$ "
             r"and velocity $v_i$ are also bounded in [0, T] according to (54) and (55).}", "gap", match="words",
             premises=("54", "55"), correction=_train_energy, corrected_statement=ENERGY,
             reading="The integral of e_s^2 is bounded for all iterations, from (54) and E_{i-1} <= E_1.",
             scope="corrected for six cars",
             note="The bounds contain the saturation, of which nothing is shown: mu is not bounded anywhere, so Delta "
                  "u, lambda and s may grow with the iterations while z stays small (the model; and integrals do not "
                  "bound values). The train itself helps out, see theorem1.1.energy.")
def state_bounded() -> Goal:
    """The integral J of e_s^2 from E_{i-1} <= E_1 and the saturation y, both constants of (54) taken as 1."""
    always = (at_most(J_i, 1 + y_i), at_least(J_i, 0), at_least(y_i, 0))
    return along_iterations(at_most(J_i, level), always, {J_i: level + i_axis + 1, y_i: level + i_axis + 1},
                            {level: sp.Integer(1)})


@paper.claim("theorem1.1.energy", "With limited forces the train's energy stays bounded on [0, T]", "implication", ENERGY,
             "proved", origin="ours", mends="theorem1.1.state", scope="six cars",
             note="So v and the stretch of the couplers are bounded by the limits of the forces, whatever the law, while "
                  "the train does not run backwards (then (2) would push instead of resist); and with them lambda = e - "
                  "z.")
def energy_bounded() -> Goal:
    """The rate of the kinetic and coupler energy along (1)-(3)."""
    return _train_energy()


@paper.claim("theorem1.1", "Theorem 1, part 1: all variables are bounded", "implication",
             r"\text{All variables are bounded.}", "gap", severity="result", match="words",
             premises=("theorem1.1.z", "theorem1.1.mass", "theorem1.1.estimates", "theorem1.1.state"),
             rests_on=("theorem1.1.z", "theorem1.1.mass", "theorem1.1.estimates", "theorem1.1.state", "16.unique"),
             reading="The values of all variables at an instant, for all iterations, by what the proof shows of them: "
                     "integrals of squares that are bounded.",
             note="What is shown is theorem1.1.mended. The values of the estimates, and of mu with them, are not bounded "
                  "by their integrals; no motion is known in which they grow.")
def all_bounded() -> Goal:
    """The squared value y of a variable from the integral J of such squares."""
    return _no_bound_of_values()


@paper.claim("theorem1.1.mended", "Part 1 for z at every instant and for the errors of the estimates as integrals",
             "implication",
             r"\|z_{1,i}\|^2 + \|z_{2,i}\|^2 \le 2E_1,\ \int_0^t\mathrm{tr}(\tilde\Theta_{v,i}^2)d\tau \le 2\gamma_vE_1,\ "
             r"\dots,\ \int_0^t\mathrm{tr}(\tilde M_i^2)d\tau \le 2\gamma_ME_1", "proved", origin="ours",
             mends="theorem1.1", premises=("46", "45.bounded"), scope=EVERY_TRAIN,
             note="Uniformly in the iterations. With theorem1.1.mass and theorem1.1.energy the estimate of the mass, s, v "
                  "and lambda are bounded at every instant as well.")
def all_bounded_as_shown() -> Goal:
    """Each part of E_i is at most E_i <= E_1."""
    shown = tuple(at_most(integral, 2 * gain * E_1) for integral, gain in zip(J, learning_gains, strict=True))
    return Goal((at_most(over_cars(z_1**2 + z_2**2), 2 * E_1), *shown), _below_e_1())

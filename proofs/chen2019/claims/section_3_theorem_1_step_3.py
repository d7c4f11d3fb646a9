"""Theorem 1, step 3: boundedness of all variables."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most
from workbench.trains.multi_particle import over_cars

from ..energy_function import E_1, S_1, S_2, Z_1, Z_2, E, E_now, J
from ..goal_forms import along_iterations, i_axis
from ..laws import learning_gains, limited, z_1, z_2
from ..one_car import estimate, g_high, g_low
from ..paper import EACH_CAR, EVERY_TRAIN, paper

level = sp.Symbol("B", positive=True)
# Of an iteration: the integral of the squared error of an estimate, and this square at the end.
I_theta, theta_end = sp.symbols("I_theta theta_end", real=True)


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
    """A squared value at an instant from the integral of such squares, which is bounded."""
    always = (at_most(I_theta, 1), at_least(I_theta, 0), at_least(theta_end, 0))
    return along_iterations(at_most(theta_end, level), always, {I_theta: sp.Integer(1), theta_end: i_axis + 2},
                            {level: sp.Integer(1)})


@paper.claim("theorem1.1.estimates", "E_i bounded makes the other estimates bounded", "implication",
             r"\text{According the definition of $E_i$, it can draw the conclusion that $\Theta_{v,i}$, $\theta_{a,i}$, "
             r"$\theta_{k,i}$, $\theta_{d,i}$, $\eta_i$ and $M_i$ are all bounded.}", "gap", match="words",
             premises=("46", "45.bounded"),
             reading="The values of the estimates at an instant, bounded by one bound for all iterations, from E_i <= E_1. For one "
                     "iteration alone it is trivial, once the motion exists on [0, T].",
             note="E_i holds integrals of the squared errors, which do not bound their values: theta_tilde_i(tau)^2 = "
                  "(i+2) tau^(i+1) on [0, 1] has the integral 1 and ends at i+2. This is no motion of the loop; it shows what the "
                  "step lacks. No motion is known in which the estimates grow. In each iteration they are bounded when v is, "
                  "by (17)-(21), but no bound for all iterations is shown.")
def estimates_bounded() -> Goal:
    """theta_tilde_i(1)^2 from the integral of theta_tilde_i^2, which is bounded."""
    return _no_bound_of_values()


# A car and its neighbours: places, speeds, and the forces over its mass; coefficients may change with the time.
s_j, s_ahead, s_behind, v_j, v_ahead, v_behind, phi_j = sp.symbols("s_j s_ahead s_behind v_j v_ahead v_behind f_j", real=True)
k_rel, d_rel, resisting = sp.symbols("k_j d_j r_j", nonnegative=True)
k_most, d_most, phi_most = sp.symbols("k_max d_max f_max", nonnegative=True)


def _grows_linearly() -> Goal:
    """The rate of a car's (s^2 + v^2)/2 along (1)-(3) against the squares of its own and its neighbours' states."""
    stretch, stretching = s_ahead - 2 * s_j + s_behind, v_ahead - 2 * v_j + v_behind
    rates = {s_j: v_j, v_j: phi_j - resisting * v_j + k_rel * stretch + d_rel * stretching}
    near = s_ahead**2 + s_j**2 + s_behind**2 + v_ahead**2 + v_j**2 + v_behind**2
    pulls = ((k_rel, k_most, stretch), (d_rel, d_most, stretching))
    lemmas = tuple(at_most(rel * pull * v_j, most * (pull**2 + v_j**2) / 2) for rel, most, pull in pulls)
    return Goal((at_most(D(s_j**2 / 2 + v_j**2 / 2), phi_most**2 / 2 + (1 + 4 * k_most + 4 * d_most) * near),),
                (at_most(k_rel, k_most), at_most(d_rel, d_most), at_most(phi_j**2, phi_most**2)), rates, lemmas=lemmas)


I_e, I_u = sp.symbols("I_e I_u", real=True)  # of an iteration: the integrals of |e_s|^2 and |Delta u|^2

ENERGY = (r"v_1 \ge 0,\ k_j = \tfrac{c_k}{m_j} \le k_{\max},\ d_j = \tfrac{c_d}{m_j} \le d_{\max},\ |f_j| = \left|\tfrac{u_j + "
          r"f^a_j}{m_j} - c_0\right| \le f_{\max} \Rightarrow \tfrac{d}{dt}\tfrac12(s_j^2 + v_j^2) \le \tfrac12f_{\max}^2 + (1 + "
          r"4k_{\max} + 4d_{\max})\sum_{l=j-1}^{j+1}(s_l^2 + v_l^2),\ s_0 = s_1, v_0 = v_1, s_{n+1} = s_n, v_{n+1} = v_n")


@paper.claim("theorem1.1.state", "s and v are bounded according to (54) and (55)", "implication",
             r"\text{since $s_r$ and $v_r$ are the known bounded variables in the interval [0, T], the displacement $s_i$ "
             r"and velocity $v_i$ are also bounded in [0, T] according to (54) and (55).}", "gap", match="words",
             premises=("54", "55"), correction=_grows_linearly, corrected_statement=ENERGY,
             reading="The integral of e_s^2 is bounded by one bound for all iterations, from (54) and E_{i-1} <= E_1; the constants of "
                     "(54) are taken as 1. For one iteration alone it is trivial, once the motion exists on [0, T].",
             note="The numbers are no motion of the loop; they show what the step lacks. No motion of the loop is known in which s or v "
                  "grows with the iterations. The bounds contain the saturation, of which nothing is shown: mu is not bounded anywhere, so that (54) and "
                  "(55) alone let s grow with the iterations; and integrals do not bound values. The limits of the forces bound "
                  "s and v as long as v_1 >= 0, which nothing in the paper ensures: added over the cars, the rate of |s|^2 + "
                  "|v|^2 is at most a constant plus a multiple of it, and Gronwall's inequality does the rest. Where v_1 < 0 the "
                  "aerodynamic force of (2) drives the train backwards: from rest with all brakes at 4e4 N, within the limits, "
                  "v_1 of the train of Table 1 is unbounded before 440 s; in a simulation the loop itself runs away, too (theorem1.1). "
                  "With v_1 |v_1| in place of v_1^2 this ends.")
def state_bounded() -> Goal:
    """The integral of e_s^2 from E_{i-1} <= E_1 and that of the saturation, both constants of (54) taken as 1."""
    always = (at_most(I_e, 1 + I_u), at_least(I_e, 0), at_least(I_u, 0))
    return along_iterations(at_most(I_e, level), always, {I_e: i_axis + 2, I_u: i_axis + 2}, {level: sp.Integer(1)})


@paper.claim("theorem1.1.energy", "With limited forces and v_1 >= 0 s and v stay bounded on [0, T]", "implication", ENERGY,
             "proved", origin="ours", mends="theorem1.1.state",
             scope="every inner car, coefficients of any course in time; at an end of the train the missing neighbour is the car itself",
             reading="The resistance over the mass is r v_j with r >= 0: r is c_v, and c_v + c_a sum_k m_k v_1/m_1 for the "
                     "first car.",
             note="Added over the cars, where no car counts more than three times, the rate of (|s|^2 + |v|^2)/2 is at most a "
                  "constant plus a multiple of it: by Gronwall's inequality s and v are bounded on [0, T] by the limits of the "
                  "forces, whatever the law, and with them lambda = e - z. It needs bounded coefficients, a lower bound of the "
                  "masses (Assumption 1), and v_1 >= 0, or v_1 |v_1| in (2).")
def energy_bounded() -> Goal:
    """The rate of s^2 + v^2 of a car along (1)-(3)."""
    return _grows_linearly()


hat_before, change, low, high, truth = sp.symbols("hat_prev step theta_low theta_high theta", real=True)
gain = sp.Symbol("gamma", positive=True)
projected = limited(hat_before + gain * change, low, high)


@paper.claim("theorem1.1.saturated", "A saturation in (17) to (21), as (22) has it, bounds the estimates", "implication",
             r"\hat\theta_i = \mathrm{sat}(\hat\theta_{i-1} + \gamma d, \underline\theta, \overline\theta),\ \underline\theta \le "
             r"\theta \le \overline\theta \Rightarrow \underline\theta \le \hat\theta_i \le \overline\theta,\ "
             r"\frac{1}{2\gamma}(\tilde\theta_i^2 - \tilde\theta_{i-1}^2) \le d\,\tilde\theta_i", "proved", origin="ours",
             scope="every entry of an estimate", reading="d is c_3 times what drives the estimate.",
             note="A repair for the estimates: with known bounds of the parameters, (27) to (31) hold under their integrals as "
                  "they stand, so that the rest of the proof is kept, and all estimates are bounded at every instant.")
def saturated_learning() -> Goal:
    """Case by case of the saturation."""
    now, before = projected - truth, hat_before - truth
    return Goal((at_least(projected, low), at_most(projected, high), at_most((now**2 - before**2) / (2 * gain), change * now)),
                (at_most(low, truth), at_most(truth, high)))


@paper.claim("theorem1.1", "Theorem 1, part 1: all variables are bounded", "implication",
             r"\text{All variables are bounded.}", "gap", severity="result", match="words",
             premises=("theorem1.1.z", "theorem1.1.mass", "theorem1.1.estimates", "theorem1.1.state"),
             rests_on=("theorem1.1.z", "theorem1.1.mass", "theorem1.1.estimates", "theorem1.1.state"),
             reading="The values of all variables at an instant, for all iterations, by what the proof shows of them: "
                     "integrals of squares that are bounded.",
             note="What is shown is theorem1.1.mended, which is less; s, v and lambda are bounded as long as v_1 >= 0, which nothing in "
                  "the paper ensures (theorem1.1.energy). In a simulation, which is no proof, the loop runs away backwards in its "
                  "first iteration, under all assumptions: the train of Table 1, its masses known, is to stand where f^a = m c_0 - 39.9 "
                  "kN on motor cars and m c_0 on trailers, so that u_r is 39.9 kN and 0, at c_1 = 0.01, c_2 = 10, c_3 = 0.04, gamma_v = 0.125, gamma_a = "
                  "2.5e-4 and 100 for the others; it rolls back, at 26 m/s the aerodynamic force of (2) wins over "
                  "what the motors have left, and at 3617 s it is faster than 1e4 m/s: for longer T no motion exists on [0, T]. "
                  "At the gains of section IV it rolls back at 10 m/s and does not run away. The values of the estimates, and of mu with them, are not bounded by "
                  "their integrals; no motion is known in which they grow. A saturation in (17) to (21), as (22) has it, would "
                  "bound the estimates (theorem1.1.saturated).")
def all_bounded() -> Goal:
    """The squared value of a variable from the integral of such squares."""
    return _no_bound_of_values()


@paper.claim("theorem1.1.mended", "Part 1 for z at every instant and for the errors of the estimates as integrals",
             "implication",
             r"\|z_{1,i}\|^2 + \|z_{2,i}\|^2 \le 2E_1,\ \int_0^t\mathrm{tr}(\tilde\Theta_{v,i}^2)d\tau \le 2\gamma_vE_1,\ "
             r"\dots,\ \int_0^t\mathrm{tr}(\tilde M_i^2)d\tau \le 2\gamma_ME_1", "proved", origin="ours",
             premises=("46", "45.bounded"), scope=EVERY_TRAIN,
             note="Uniformly in the iterations. The estimate of the mass is bounded as well (theorem1.1.mass), and so are s, v and "
                  "lambda as long as v_1 >= 0 (theorem1.1.energy).")
def all_bounded_as_shown() -> Goal:
    """Each part of E_i is at most E_i <= E_1."""
    shown = tuple(at_most(integral, 2 * gain * E_1) for integral, gain in zip(J, learning_gains, strict=True))
    return Goal((at_most(over_cars(z_1**2 + z_2**2), 2 * E_1), *shown), _below_e_1())

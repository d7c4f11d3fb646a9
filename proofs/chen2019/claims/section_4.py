"""Sections IV and V: the laws with numbers, what the text says of the runs, and what is concluded."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal
from workbench.proof.printed_values import as_printed
from workbench.trains.multi_particle import over_cars, s, v

from ..goal_forms import along_iterations, i_axis
from ..laws import (
    As,
    Av,
    M_hat,
    c_3,
    driven_by,
    estimates,
    lambda_1,
    learning_gains,
    limited,
    mass_step,
    mu_law,
    phi,
    s_r,
    v_dot,
    v_r,
    v_r_dot,
    z_2,
)
from ..notation import ONE_CAR
from ..one_car import one_car, u_low
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import compact_force
from ..stated_values import MOTOR_CARS, cruise_stated, stated, stated_gains, stated_learning, train
from .section_2 import mu_car
from .section_3_theorem_1_step_3 import I_e, I_u

TABLE_1 = as_printed({
    "m": (train["car_mass_kg"], "50000"), "c_0": (train["c_0_n_per_kg"], "7.75e-3"), "c_v": (train["c_v_n_s_per_m_kg"], "2.28e-4"),
    "c_a": (train["c_a_n_s2_per_m2_kg"], "1.66e-5"), "c_k": (train["coupler_n_per_m"], "2e6"), "c_d": (train["coupler_n_s_per_m"], "1e5")})
GAINS = as_printed({name: (stated["gains"][name], text) for name, text in (
    ("c_1", "0.01"), ("c_2", "100"), ("c_3", "0.04"), ("gamma_v", "10"), ("gamma_a", "0.02"), ("gamma_k", "8000"), ("gamma_d", "8000"),
    ("gamma_eta", "8000"), ("gamma_M", "8000"))})
STUDY = "The values that the simulation takes for them, from the study's file."


@paper.claim("section4.gains", "The stated gains", "condition",
             r"c_1 = 0.01, c_2 = 100, c_3 = 0.04, \text{ the learning gains as } \gamma_{\nu} = 10, \gamma_a = 0.02, \gamma_k = \gamma_d = "
             r"\gamma_{\eta} = \gamma_M = 8000", "proved", match="words", severity="data", at=GAINS.at, rests_on=(), reading=STUDY)
def gains_as_printed() -> Goal:
    """Nine gains."""
    return GAINS.goal()


@paper.claim("table1", "The train of Table 1", "condition", r"m_1, \ldots, m_6: 5 \times 10^{4};\ c_0: 7.75 \times 10^{-3};\ "
             r"c_v: 2.28 \times 10^{-4};\ c_a: 1.66 \times 10^{-5};\ c_k: 2 \times 10^{6};\ c_d: 1 \times 10^{5}", "proved", match="words", severity="data",
             at=TABLE_1.at, rests_on=(), reading=STUDY)
def train_as_printed() -> Goal:
    """Six numbers of Table 1."""
    return TABLE_1.goal()


ON_TRACK = as_printed({
    "n": (train["cars"], "6"), **{f"motor_{k}": (car, str(2 * k - 1)) for k, car in enumerate(MOTOR_CARS, 1)},
    "u_plus": (train["traction_n"], "40000"), "u_minus": (train["braking_n"], "40000"), "v_cruise": (stated["reference"]["cruise_mps"], "83.5"),
    "i_last": (stated["trials"]["count"], "30")})


@paper.claim("section4.train", "Cars, motors, limits, cruising speed and iterations", "condition",
             r"\text{six cars [...] the distribution of motor cars is 101010 [...] } \underline{u} = [-4, \ldots, -4]^T \times 10^4,\ \overline{u} = "
             r"[4, 0, 4, 0, 4, 0]^T \times 10^4 \text{ [...] 83.5 m/s [...] 30 iterations}", "proved", match="words", severity="data",
             at=ON_TRACK.at, rests_on=(), reading=STUDY)
def train_and_track_as_printed() -> Goal:
    """Eight numbers of section IV."""
    return ON_TRACK.goal()


given_gains = tuple(equal(x, value) for x, value in stated_gains.items())
PRINTED_LAW = (r"\boldsymbol{u}_{i} = \operatorname{sat}\left(-25 \times \left[100 \times (\boldsymbol{v}_{i} - "
               r"\boldsymbol{v}_{r} + 0.01 \times \boldsymbol{s}_{i} - 0.01 \times \boldsymbol{s}_{r}) + "
               r"\dot{\boldsymbol{v}}_{i} - \dot{\boldsymbol{v}}_{r} + 0.01 \times \boldsymbol{v}_{i} - 0.01 \times "
               r"\boldsymbol{v}_{r} + \boldsymbol{s}_{i} - \boldsymbol{s}_{r} - \boldsymbol{\lambda}_{1,i}\right] - "
               r"(\hat{\Theta}_{v,i} \boldsymbol{v}_{i} + \hat{\theta}_{a,i} \phi(\boldsymbol{v}_{i}) + \hat{\theta}_{k,i} A "
               r"\boldsymbol{s}_{i} + \hat{\theta}_{d,i} A \boldsymbol{v}_{i} + \hat{\boldsymbol{\eta}}_{i} - \hat{M}_{i} "
               r"\dot{\boldsymbol{v}}_{i}), \underline{\boldsymbol{u}}, \overline{\boldsymbol{u}}\right)")
theta_hat_car = sp.Symbol("hat", real=True)


@paper.claim("section4.law", "The printed control law is (16) at the stated gains", "identity", PRINTED_LAW, "proved",
             scope=EACH_CAR,
             reading="What is saturated here is mu of (16), with (12) and (10), at c_1 = 0.01, c_2 = 100, c_3 = 0.04; the "
                     "limits are those of (8).")
def printed_law() -> Goal:
    """mu of (16) at the stated gains, against what the line saturates."""
    hundredth = sp.Rational(1, 100)
    inner = (100 * (v - v_r + hundredth * s - hundredth * s_r) + v_dot - v_r_dot + hundredth * v - hundredth * v_r
             + s - s_r - lambda_1)
    printed = -25 * inner - (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot)
    return Goal((equal(mu_car, one_car(printed)),), (*given_gains, equal(mu_car, one_car(mu_law))))


# The index of the estimate, its law, and the printed line.
STATED_LEARNING = (
    ("17", "v", r"\hat{\Theta}_{v,i} = \hat{\Theta}_{v,i-1} + 0.4 \times \mathcal{D}(z_{2,i}) \cdot \mathcal{D}(v_i)",
     r"\hat{\Theta}_{v,i-1}", "0.4"),
    ("18", "a", r"\hat{\theta}_{a,i} = \hat{\theta}_{a,i-1} + 0.0008 \times z_{2,i}^T \phi(v_i)", r"\hat{\theta}_{a,i-1}",
     "0.0008"),
    ("19", "k", r"\hat{\theta}_{k,i} = \hat{\theta}_{k,i-1} + 320 \times z_{2,i}^T As_i", r"\hat{\theta}_{k,i-1}", "320"),
    ("20", "d", r"\hat{\theta}_{d,i} = \hat{\theta}_{d,i-1} + 320 \times z_{2,i}^T Av_i", r"\hat{\theta}_{d,i-1}", "320"),
    ("21", "eta", r"\hat{\eta}_i = \hat{\eta}_{i-1} + 320 \times z_{2,i}", r"\hat{\eta}_{i-1}", "320"))
hat_before = sp.Symbol("hat_prev", real=True)
DRIVEN = (one_car(driven_by[0]), *(over_cars(z_2 * x) for x in (phi, As, Av)), one_car(z_2))


def _stated_learning(number: int) -> None:
    equation, index, line, before, factor = STATED_LEARNING[number]
    gain, driven, of_car = learning_gains[number], DRIVEN[number], index in ("v", "eta")
    now = line.partition(" = ")[0]

    @paper.claim(f"{equation}.stated", f"The printed learning rule with its number is ({equation}) at the stated gains",
                 "identity", line, "proved", scope=EACH_CAR if of_car else EVERY_TRAIN,
                 where={**(ONE_CAR if of_car else {}), _typed(now): theta_hat_car, before: hat_before},
                 reading=f"({equation}) with {gain} = {stated_learning[gain]} and c_3 = 0.04.")
    def stated() -> Goal:
        rule = equal(theta_hat_car, hat_before + gain * c_3 * driven)
        return Goal((equal(theta_hat_car, hat_before + sp.Rational(factor) * driven),),
                    (equal(gain, stated_learning[gain]), equal(c_3, stated_gains[c_3]), rule))


def _typed(letter: str) -> str:
    """A letter as the notation types it."""
    return {r"\hat{\Theta}_{v,i}": r"\hat\Theta_{v,i}", r"\hat{\eta}_i": r"\hat{\eta}_i"}.get(
        letter, letter.replace(r"\hat{\theta}", r"\hat\theta"))


for number in range(5):
    _stated_learning(number)

M_before = sp.Symbol("M_hat_prev", real=True)


@paper.claim("22.stated", "The printed learning rule of the mass is (22) at the stated gains", "identity",
             r"\hat{M}_i = \operatorname{sat} \left(\hat{M}_{i-1} - 320 \times \mathcal{D}(z_{2,i}) \cdot "
             r"\mathcal{D}(\dot{v}_i), \underline{M}, \overline{M} \right)", "proved", scope=EACH_CAR,
             reading="What is saturated here is what (22) saturates, with gamma_M = 8000 and c_3 = 0.04; the bounds are "
                     "those of (22).",
             note="The bounds of the mass, which (22) and its initial estimate need, are stated nowhere.")
def stated_mass_learning() -> Goal:
    """The argument of the saturation in (22), against that with the number."""
    z, acceleration = one_car(z_2), one_car(v_dot)
    gain, free = learning_gains[5], sp.Symbol("h", real=True)
    rule = equal(free, M_before + mass_step(z, acceleration))
    return Goal((equal(free, M_before - 320 * z * acceleration),),
                (equal(gain, stated_learning[gain]), equal(c_3, stated_gains[c_3]), rule))


speed_kmh = sp.Symbol("v_kmh", real=True)


@paper.claim("section4.cruise", "83.5 m/s are approximately 300 km/h", "condition",
             r"\text{83.5 m/s (approximately 300 km/h) is considered as the final cruising velocity.}", "proved",
             match="words", at={speed_kmh: cruise_stated * Fraction(18, 5)},
             reading="83.5 m/s in km/h, rounded to whole km/h, lies within 1 of 300.", note="300.6 km/h.")
def cruising_speed() -> Goal:
    """The speed in km/h against 300."""
    return Goal((at_least(speed_kmh, 299), at_most(speed_kmh, 301)))


@paper.claim("section4.traction", "Traction comes from motor cars only, braking from all cars", "implication",
             r"\text{during the entire process of each operation, the traction forces are only provided by the motor cars, "
             r"i.e., Car 1, 3, 5, and the braking forces come from all the motor cars and trailers.}", "proved",
             match="words", severity="cosmetic", rests_on=("5",), scope=EACH_CAR,
             reading="By (5) the force of a trailer lies between u^- and 0, whatever mu is, and takes every such value.")
def trailers_only_brake() -> Goal:
    """The saturation of a trailer, and of a value within its limits."""
    u, x = limited(mu_car, u_low, sp.S.Zero), sp.Symbol("x", real=True)
    inside = limited(x, u_low, sp.S.Zero)
    return Goal((at_most(u, 0), at_least(u, u_low), at_most(inside, x), at_least(inside, x)),
                (at_most(u_low, 0), at_least(x, u_low), at_most(x, 0)))


def _saturation_is_left() -> Goal:
    """The integral of |e_s|^2 from a bound that tends to zero and the integral of |Delta u|^2."""
    always = (at_most(I_e, 1 / (i_axis + 1) + I_u), at_least(I_e, 0), at_least(I_u, 0), at_least(i_axis, 0))
    return along_iterations(at_most(I_e, sp.S.Half), always, {I_e: sp.Integer(1), I_u: sp.Integer(1)}, {})


SATURATION_LEFT = ("By what is shown: the integral of |e_s|^2 is at most what tends to zero, here 1/(i + 1), and the integral of "
                   "|Delta u|^2, with the constants of theorem1.3.any_gains taken as 1; to tend to zero, it must be at most 1/2 from some "
                   "iteration on.")


@paper.claim("section4.converge", "With more iterations the tracking errors converge further", "implication",
             r"\text{theoretically, the tracking errors could be further converged if there are more iterations to be "
             r"executed without the consideration of simulation cost.}", "gap", match="words",
             premises=("theorem1.3.any_gains",), rests_on=("theorem1.2",), scope=EACH_CAR, reading=SATURATION_LEFT,
             note="z -> 0 is shown, Delta u -> 0 is not: e_s = z_1 + lambda_1, and lambda vanishes only if the saturation does. "
                  "That is impossible at the stated numbers on level track, because Assumption 2 fails there.")
def errors_converge_further() -> Goal:
    """e from what is shown of z and the saturation."""
    return _saturation_is_left()


@paper.claim("section5.converge", "The convergence of the tracking errors is proved", "implication",
             r"\text{the stability of control systems and the convergence of tracking errors are proved via constructing "
             r"CEF}", "gap", severity="result", match="words", premises=("theorem1.3.any_gains",),
             rests_on=("theorem1.2",), scope=EACH_CAR, reading=SATURATION_LEFT,
             note="Theorem 1 shows z -> 0, nothing shows Delta u -> 0; this is no motion, it shows what is missing. At the numbers "
                  "of section IV the errors cannot tend to zero on level track, because Assumption 2 fails there: for ten "
                  "seconds of cruise the errors of place of a trailer and its neighbours cannot stay below 0.159 mm while their errors "
                  "of speed stay below 0.159 mm/s (A2.floor). No motion is known that meets Assumption 2 and keeps an error.")
def convergence_of_errors() -> Goal:
    """e from what is shown of z and the saturation."""
    return _saturation_is_left()


paper.axiom("figures", "Figures 1 to 9: errors and unsaturated inputs shrink over 30 iterations",
            r"\text{the maximum absolute errors at each iteration are given in Fig. 5, both of which [...] illustrate the asymptotic "
            r"convergence of tracking errors. [...] the input signals calculated directly by the controller at the 30th iteration are "
            r"closer to the scope specified by the input constraints than the first iteration.}",
            "read off the figures by the authors", hypotheses=(), match="words", severity="data",
            note="A statement on simulations, which the study runs anew. That the errors go to zero does not follow from thirty "
                 "iterations, nor from the theory: section4.converge, A2.floor.")

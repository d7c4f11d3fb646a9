"""Section III: the control law (16) and the learning rules (17)-(22) in letters, and what they are chosen for."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, equal
from workbench.trains.multi_particle import over_cars, v

from ..error_dynamics import rates_with, u_of_7
from ..laws import (
    As,
    Av,
    M_hat,
    alpha,
    alpha_dot,
    c_2,
    c_3,
    errors,
    estimates,
    gamma_mass,
    lambda_2,
    learning_gains,
    mu_law,
    phi,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)
from ..notation import ONE_CAR, in_fonts
from ..one_car import one_car, unbounded_step
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import compact_force
from .section_3 import CAR_Z_PUT_IN

felt_mu = u_of_7 - (D(lambda_2) + c_2 * lambda_2) / c_3  # the input that (9) says for the rate of lambda_2


@paper.claim("16", "The control law", "identity",
             r"\boldsymbol{\mu}_{i} = -\frac{1}{c_{3}} \left[c_{2} \left(\boldsymbol{v}_{i} - \boldsymbol{v}_{r} - "
             r"\boldsymbol{\alpha}_{i} \right) + \dot{\boldsymbol{v}}_{i} - \dot{\boldsymbol{v}}_{r} - "
             r"\dot{\boldsymbol{\alpha}}_{i} + z_{1,i} \right] - \left(\hat{\Theta}_{v,i} \boldsymbol{v}_{i} + "
             r"\hat{\theta}_{a,i} \phi(\boldsymbol{v}_{i}) + \hat{\theta}_{k,i} A \boldsymbol{s}_{i} + \hat{\theta}_{d,i} A "
             r"\boldsymbol{v}_{i} + \hat{\boldsymbol{\eta}}_{i} - \hat{M}_{i} \dot{\boldsymbol{v}}_{i} \right)", "proved",
             rests_on=(), scope=EACH_CAR,
             where={**CAR_Z_PUT_IN, **{rf"{font}_i": one_car(felt_mu) for font in in_fonts(r"\mu")}},
             reading="mu is the input of the loop that runs, read back from the rate of its auxiliary state by (9) and from "
                     "its force by (7). The v in the index of Theta is bold in print.",
             note="mu contains the acceleration that it causes, see 16.loop.")
def control_law() -> Goal:
    """(7), (9) with the law that is simulated."""
    inner = c_2 * (v - v_r - alpha) + v_dot - v_r_dot - alpha_dot + errors[z_1]
    stated = -inner / c_3 - (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot)
    return Goal((equal(one_car(felt_mu), one_car(stated)),),
                flow={one_car(x): one_car(r) for x, r in rates_with(mu_law).items()})


paper.definition("16.limited", "The input is limited", r"\boldsymbol{u}_i = \operatorname{sat}(\boldsymbol{\mu}_i, "
                 r"\underline{\boldsymbol{u}}, \overline{\boldsymbol{u}})", note="(8) again.")

hat, hat_before = sp.symbols("hat hat_prev", real=True)
CHOSEN = ("Decided as what the rule is chosen for: by (24) and (%s) the estimate's error enters the change of the energy function "
          "with the factor of its step over the gain, less c_3 times what stands beside it in (24), which must vanish.")
# The rule, its number, the line of its change over an iteration, and what stands beside the error in (24).
RULES = (
    ("17", "Theta_v", "27", r"\hat{\Theta}_{\nu,i}", r" + \gamma_{\nu} \cdot c_3 \cdot \mathcal{D}(\mathbf{z}_{2,i}) \cdot \mathcal{D}(\mathbf{v}_i)",
     one_car(z_2 * v)),
    ("18", "theta_a", "28", r"\hat{\theta}_{\nu,i}", r" + \gamma_{\nu} \cdot c_2 \cdot \tau_i^T \cdot \phi(\mathbf{v}_i)", over_cars(z_2 * phi)),
    ("19", "theta_k", "29", r"\hat{\theta}_{k,i}", r" + \gamma_{k} \cdot c_{3} \cdot z_{2,i}^T \mathcal{A}s_{i}", over_cars(z_2 * As)),
    ("20", "theta_d", "30", r"\hat{\theta}_{d,i}", r" + \gamma_d \cdot c_3 \cdot z_{2,i}^T A \mathbf{v}_i", over_cars(z_2 * Av)),
    ("21", "eta", "31", r"\hat{\boldsymbol{\eta}}_i", r" + \gamma_{\boldsymbol{\eta}} \cdot c_3 \cdot \boldsymbol{z}_{2,i}", one_car(z_2)))
TYPED = {"17": r"\hat\Theta_{\nu,i}", "19": r"\hat\theta_{k,i}", "20": r"\hat\theta_{d,i}"}


def before(letter: str) -> str:
    """The letter of the estimate an iteration earlier."""
    return letter.replace(",i}", ",i-1}").replace("}_i", "}_{i-1}")


def chosen(number: int, stated: sp.Expr) -> Goal:
    """The step for which the estimate's error drops out, against a printed one."""
    gain, driven = learning_gains[number], RULES[number][-1]
    return Goal((equal(hat, hat_before + stated),), (equal((hat - hat_before) / gain - c_3 * driven, 0),))


def _rule(number: int) -> None:
    equation, name, change, letter, step, driven = RULES[number]
    of_car = equation in ("17", "21")

    @paper.claim(equation, f"The learning rule of {name}", "identity", f"{letter} = {before(letter)}{step}", "proved",
                 premises=("24",), rests_on=("24",), scope=EACH_CAR if of_car else EVERY_TRAIN, reading=CHOSEN % change,
                 where={**(ONE_CAR if of_car else {}), TYPED.get(equation, letter): hat, before(letter): hat_before})
    def learning_rule() -> Goal:
        """The step over the gain against c_3 times what is learned from."""
        return chosen(number, learning_gains[number] * c_3 * driven)


_rule(0)
GARBLED = {r"\hat{\theta}_{\nu,i}": hat, r"\hat{\theta}_{\nu,i-1}": hat_before, r"\tau_i": z_2}


@paper.claim("18", "The learning rule of theta_a", "identity",
             f"{RULES[1][3]} = {before(RULES[1][3])}{RULES[1][4]}", "proved", premises=("24",), rests_on=("24",),
             scope=EVERY_TRAIN, where=GARBLED,
             reading=CHOSEN % "28" + " The extracted line is garbled: tau_i is read as z_{2,i}, theta_nu as theta_a, gamma_nu as gamma_a "
                                     "and c_2 as c_3, as section IV has it, with 0.0008 = 0.02 times 0.04.")
def garbled_rule() -> Goal:
    """With gamma_a and c_3, as 18.glyph."""
    return rule_of_theta_a()


@paper.claim("18.glyph", "The learning rule of theta_a, as (28) and section IV have it", "identity",
             r"\hat{\theta}_{a,i} = \hat{\theta}_{a,i-1} + \gamma_a \cdot c_3 \cdot z_{2,i}^T \cdot \phi(\mathbf{v}_i)", "proved",
             origin="ours", premises=("24",), rests_on=("24",), scope=EVERY_TRAIN,
             where={r"\hat\theta_{a,i}": hat, r"\hat{\theta}_{a,i-1}": hat_before}, reading=CHOSEN % "28")
def rule_of_theta_a() -> Goal:
    """With gamma_a and c_3."""
    return chosen(1, learning_gains[1] * c_3 * over_cars(z_2 * phi))


for _number in (2, 3, 4):
    _rule(_number)

free = sp.Symbol("h", real=True)
mass_before, z_car, a_car = sp.symbols("M_hat_prev z_2 v_dot", real=True)


@paper.claim("22", "The learning rule of the mass", "identity",
             r"\hat{M}_{i} = \operatorname{sat}\left(\hat{M}_{i-1} - \gamma_{M} \cdot c_{3} \cdot \mathcal{D}(\mathbf{z}_{2,i}) \cdot "
             r"\mathcal{D}(\dot{\mathbf{v}}_{i}), \underline{M}, \overline{M}\right)", "proved", premises=("24",), rests_on=("24",),
             scope=EACH_CAR, reading="What is saturated here is decided as the others: the step for which the error of the mass drops out of "
                                     "the change of the energy function. What the saturation does to it is (33).")
def mass_rule() -> Goal:
    """The step over the gain against minus c_3 z_2 v'."""
    return Goal((equal(free, unbounded_step),), (equal((free - mass_before) / gamma_mass + c_3 * z_car * a_car, 0),))


paper.definition("22.start", "The first estimates",
                 r"\hat{\Theta}_{\nu,0} = 0,\ \hat{\theta}_{a,0} = 0,\ \hat{\theta}_{k,0} = 0,\ \hat{\theta}_{d,0} = 0,\ \hat{\boldsymbol{\eta}}_0 = 0,\ "
                 r"\hat{M}_0 = \underline{M}", note="The ends of (17)-(22).")

"""Section III, the design of the controller: rates along (7), (9), (16) up to (24), and the energy function (25)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.trains.multi_particle import each_car, over_cars, v

from ..energy_function import E, V, V_of, decay, estimation_terms
from ..error_dynamics import flow, rates_with, u_of_7
from ..goal_forms import integrated
from ..laws import (
    As,
    Av,
    Delta_u,
    M,
    M_hat,
    alpha,
    alpha_dot,
    auxiliary,
    c_1,
    c_2,
    c_3,
    errors,
    estimates,
    lambda_1,
    lambda_2,
    mu,
    phi,
    s_r,
    tildes,
    true_parameters,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)
from ..notation import LYAPUNOV, NOTATION, ONE_CAR, in_fonts
from ..one_car import one_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import compact_force

# The errors of (10) put in for z, in a printed line of the train and of one car.
Z_PUT_IN = {f"{font}_{{{k},i}}": errors[z] for font in in_fonts("z") for k, z in (("1", z_1), ("2", z_2))}
CAR_Z_PUT_IN = {**ONE_CAR, **{letter: one_car(x) for letter, x in Z_PUT_IN.items()}}
# The references as the paper has them, vectors with the same entry for each car: then lines add vectors alone.
REFERENCES = dict(zip((s_r, v_r, v_r_dot), each_car("s_r v_r v_r_dot"), strict=True))
V_PUT_IN = {**Z_PUT_IN, "V_{1,i}": V_of(errors[z_1]), "V_{2,i}": V_of(errors[z_2])}
VECTORS = {letter: x.xreplace(REFERENCES) for letter, x in {**NOTATION, **V_PUT_IN}.items()}

paper.definition("8", "The inputs of all cars", r"\boldsymbol{u}_i = \operatorname{sat}(\boldsymbol{\mu}_i, "
                 r"\underline{\boldsymbol{u}}, \overline{\boldsymbol{u}})")
paper.definition("9", "The auxiliary system", r"\dot{\boldsymbol{\lambda}}_{1,i} = -c_1\boldsymbol{\lambda}_{1,i} + "
                 r"\boldsymbol{\lambda}_{2,i},\ \dot{\boldsymbol{\lambda}}_{2,i} = -c_2\boldsymbol{\lambda}_{2,i} + c_3\Delta"
                 r"\boldsymbol{u}_i")
paper.definition("10", "The errors of the design", r"z_{1,i} = s_i - s_r - \lambda_{1,i},\ z_{2,i} = v_i - v_r - \alpha_i - "
                 r"\lambda_{2,i}")
paper.definition("12", "The virtual controller", r"\boldsymbol{\alpha}_i = -c_1(\boldsymbol{s}_i - \boldsymbol{s}_r)")
paper.definition("23", "The Lyapunov function of an iteration", r"V_i = V_{1,i} + V_{2,i}")
paper.definition("25.definition", "The composite energy function",
                 r"E_{i} = V_{i} + \frac{1}{2\gamma_{\nu}}\int_{0}^{t}\operatorname{tr}(\tilde{\Theta}_{\nu,i}^{2})d\tau + "
                 r"\frac{1}{2\gamma_{a}}\int_{0}^{t}\tilde{\theta}_{a,i}^{2}d\tau + \dots + \frac{1}{2\gamma_{M}}\int_{0}^{t}"
                 r"\operatorname{tr}(\tilde{M}_{i}^{2})d\tau")

idle_1, idle_2 = (one_car(x) for x in (lambda_1, lambda_2))


@paper.claim("9.zero", "Without saturation the auxiliary state stays zero", "implication",
             r"\text{It could be found that $\lambda_{1,i}$ and $\lambda_{2,i}$ remain zero when there is no saturation "
             r"to occur, i.e., $\Delta u_i = 0$, otherwise nonzero.}", "proved", severity="cosmetic", match="words",
             scope=EACH_CAR,
             reading="From lambda(0) = 0, which the sentence supposes and (9) does not state, and with Delta u = 0 all "
                     "the time, lambda = 0 at every time.")
def auxiliary_stays_zero() -> Goal:
    """A positive definite function of lambda that starts at zero and does not increase."""
    W = idle_1**2 + idle_2**2 / (c_1 * c_2)
    rates = {one_car(x): one_car(rate).xreplace({one_car(Delta_u): sp.S.Zero}) for x, rate in auxiliary.items()}
    return integrated(rates, at_most(W, 0), (), (c_1, c_2, c_3), decreasing=W)


@paper.claim("25", "The CEF is not negative", "inequality", r"E_i \ge 0", "proved", severity="step",
             scope=EVERY_TRAIN, where={"E_i": E},
             note="Printed in words below (47): 'Since E_i is nonnegative'.")
def cef_not_negative() -> Goal:
    """Squares and integrals of squares, with positive gains."""
    return Goal((at_least(E, 0),))


@paper.claim("11", "Rate of z_1", "identity",
             r"\dot{z}_{1,i} = \mathbf{v}_i - \mathbf{v}_r - \mathbf{\lambda}_{2,i} + c_1 \mathbf{\lambda}_{1,i} = "
             r"z_{2,i} + \mathbf{\alpha}_i + c_1 \mathbf{\lambda}_{1,i}", "proved", scope=EACH_CAR, where=CAR_Z_PUT_IN)
def z_1_rate() -> Goal:
    """D(z_1) along (7), (9), for any mu; alpha by (12)."""
    rates = {one_car(x): one_car(r) for x, r in rates_with(mu).items()}
    z = {x: one_car(expr) for x, expr in errors.items()}
    return Goal((equal(D(z[z_1]), one_car(v - v_r - lambda_2 + c_1 * lambda_1)),
                 equal(D(z[z_1]), z[z_2] + one_car(alpha + c_1 * lambda_1))), flow=rates)


@paper.claim("13", "Rate of V_1", "identity",
             r"\dot{V}_{1,i} = -c_1 \|z_{1,i}\|^2 + z_{1,i}^T z_{2,i}", "proved",
             premises=("11",), scope=EVERY_TRAIN, where=V_PUT_IN)
def v_1_rate() -> Goal:
    """D(V_1) with (10) put in, along (7), (9) with any mu."""
    stated = -c_1 * over_cars(z_1**2) + over_cars(z_1 * z_2)
    return Goal((equal(D(V_of(errors[z_1])), stated.xreplace(errors)),), flow=rates_with(mu))


delta_u = u_of_7 - mu
unforced_rate = v_dot - v_r_dot - alpha_dot + c_2 * lambda_2  # what is left of z_2' without c_3 Delta_u
bracket_14 = c_3 * mu + c_3 * (compact_force(true_parameters, v, phi, As, Av) - M * v_dot) + unforced_rate
FORCED = {f"{font}_i": u_of_7 for font in in_fonts("u")} | {rf"\Delta {font}_i": delta_u for font in in_fonts("u")}


@paper.claim("14", "Rate of z_2", "identity",
             r"\dot{z}_{2,i} = c_3 \left(\boldsymbol{u}_i + \Theta_3 \boldsymbol{v}_i + \theta_a \phi(\boldsymbol{v}_i) "
             r"+ \theta_k A \boldsymbol{s}_i + \theta_d A \boldsymbol{v}_i + \eta \right) - c_3 M \dot{\boldsymbol{v}}_i "
             r"+ \dot{\boldsymbol{v}}_i - \dot{\boldsymbol{v}}_r - \dot{\boldsymbol{\alpha}}_i + c_2 \lambda_{2,i} - c_3 "
             r"\Delta \boldsymbol{u}_i = c_3 \boldsymbol{\mu}_i + c_3 \left(\Theta_v \boldsymbol{v}_i + \theta_a "
             r"\phi(\boldsymbol{v}_i) + \theta_k A \boldsymbol{s}_i + \theta_d A \boldsymbol{v}_i + \eta - M "
             r"\dot{\boldsymbol{v}}_i \right) + \dot{\boldsymbol{v}}_i - \dot{\boldsymbol{v}}_r - "
             r"\dot{\boldsymbol{\alpha}}_i + c_2 \lambda_{2,i}", "proved", premises=("7",), scope=EACH_CAR,
             where={**CAR_Z_PUT_IN, **{letter: one_car(x) for letter, x in FORCED.items()},
                    r"\Theta_3": one_car(true_parameters[0])},
             reading="'Theta_3' in the first line is Theta_v; u is the force that (7) says for the acceleration.",
             note="The line adds c_3 times (7), so c_3 has the unit 1/kg; factors 1/s^2 and 1/s of value 1 before z_1 "
                  "are left out.")
def z_2_rate() -> Goal:
    """D(z_2) along (7), (9), for any mu; both lines of (14)."""
    first_line = (c_3 * (u_of_7 + compact_force(true_parameters, v, phi, As, Av)) - c_3 * M * v_dot + unforced_rate
                  - c_3 * delta_u)
    rate = D(one_car(errors[z_2]))
    return Goal((equal(rate, one_car(first_line)), equal(rate, one_car(bracket_14))),
                flow={one_car(x): one_car(r) for x, r in rates_with(mu).items()})


@paper.claim("15", "Rate of V_2, with the estimates put in", "identity",
             r"\dot{V}_{2,i} = \mathbf{z}_{2,i}^{T} \left[c_{3}\boldsymbol{\mu}_{i} + c_{3} \left(\Theta_{v} "
             r"\boldsymbol{v}_{i} + \theta_{a} \boldsymbol{\phi}(\boldsymbol{v}_{i}) + \theta_{k} A \boldsymbol{s}_{i} + "
             r"\theta_{d} A \boldsymbol{v}_{i} + \boldsymbol{\eta} - M \dot{\boldsymbol{v}}_{i} \right) + "
             r"\dot{\boldsymbol{v}}_{i} - \dot{\boldsymbol{v}}_{r} - \dot{\boldsymbol{\alpha}}_{i} + c_{2} "
             r"\boldsymbol{\lambda}_{2,i} \right] = \mathbf{z}_{2,i}^{T} \left[ c_{3} \boldsymbol{\mu}_{i} + c_{3} \left("
             r"\hat{\Theta}_{v,i} \boldsymbol{v}_{i} + \hat{\theta}_{a,i} \boldsymbol{\phi}(\boldsymbol{v}_{i}) + "
             r"\hat{\theta}_{k,i} A \boldsymbol{s}_{i} + \hat{\theta}_{d,i} A \boldsymbol{v}_{i} + "
             r"\hat{\boldsymbol{\eta}}_{i} - \hat{M}_{i} \dot{\boldsymbol{v}}_{i} \right) + \dot{\boldsymbol{v}}_{i} - "
             r"\dot{\boldsymbol{v}}_{r} - \dot{\boldsymbol{\alpha}}_{i} + c_{2} \boldsymbol{\lambda}_{2,i} \right] - c_{3} "
             r"\mathbf{z}_{2,i}^{T} \tilde{\Theta}_{v,i} \boldsymbol{v}_{i} - c_{3} \mathbf{z}_{2,i}^{T} "
             r"\tilde{\theta}_{a,i} \boldsymbol{\phi}(\boldsymbol{v}_{i}) - c_{3} \mathbf{z}_{2,i}^{T} "
             r"\tilde{\theta}_{k,i} A \boldsymbol{s}_{i} - c_{3} \mathbf{z}_{2,i}^{T} \tilde{\theta}_{d,i} A "
             r"\boldsymbol{v}_{i} - c_{3} \mathbf{z}_{2,i}^{T} \tilde{\boldsymbol{\eta}}_{i} + c_{3} \mathbf{z}_{2,i}^{T} "
             r"\tilde{M}_{i} \dot{\boldsymbol{v}}_{i}", "proved", premises=("14",), scope=EVERY_TRAIN,
             where={**VECTORS, r"\tilde\Theta_{v,i}": estimates[0] - true_parameters[0],
                    **{rf"\tilde\theta_{{{x},i}}": hat - true for x, hat, true in
                       zip("akd", estimates[1:4], true_parameters[1:4], strict=True)},
                    r"\tilde{\boldsymbol{\eta}}_i": estimates[4] - true_parameters[4], r"\tilde M_i": M_hat - M},
             reading="With tilde = hat minus true for all of them; the extracted text has a hat where it defines the "
                     "error of Theta_v.")
def v_2_rate() -> Goal:
    """D(V_2) along (7), (9), for any mu: both sides of the second equality."""
    with_hats = c_3 * mu + c_3 * (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot) + unforced_rate
    wrong = tuple(hat - true for hat, true in zip((*estimates, M_hat), (*true_parameters, M), strict=True))
    z = errors[z_2]
    shown = (equal(D(V_of(z)), over_cars(z * bracket_14)),
             equal(D(V_of(z)), over_cars(z * with_hats) + sp.Add(*estimation_terms(z, wrong))))
    return Goal(tuple(r.subs(REFERENCES) for r in shown),
                flow={x.xreplace(REFERENCES): rate.xreplace(REFERENCES) for x, rate in rates_with(mu).items()})


@paper.claim("24", "Rate of V in closed loop", "identity",
             r"\dot{V}_{i} = -c_{1} \|z_{1,i}\|^{2} - c_{2} \|z_{2,i}\|^{2} - c_{3} z_{2,i}^{T} \tilde{\Theta}_{\nu,i} "
             r"v_{i} - c_{3} z_{2,i}^{T} \tilde{\theta}_{a,i} \phi(v_{i}) - c_{3} z_{2,i}^{T} \tilde{\theta}_{k,i} A s_{i} "
             r"- c_{3} z_{2,i}^{T} \tilde{\theta}_{d,i} A v_{i} - c_{3} z_{2,i}^{T} \tilde{\eta}_{i} + c_{3} z_{2,i}^{T} "
             r"\tilde{M}_{i} \dot{v}_{i}", "proved", premises=("13", "15"), scope=EVERY_TRAIN, where=LYAPUNOV,
             note="For every acceleration that solves the loop, saturated or not; see 16.loop for when one does.")
def v_rate() -> Goal:
    """D(V) along (7), (9), (16)."""
    return Goal((equal(D(V), decay + sp.Add(*estimation_terms(z_2, tildes))),), flow=flow)

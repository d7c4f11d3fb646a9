"""Section III, the design of the controller: rates along (7), (9), (16) up to (24), and the energy function (25)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, equal
from workbench.trains.multi_particle import over_cars, v

from ..energy_function import E, V, V_of, decay, estimation_terms
from ..error_dynamics import flow, rates_with, u_of_7
from ..laws import (
    As,
    Av,
    M,
    M_hat,
    alpha,
    alpha_dot,
    c_1,
    c_2,
    c_3,
    errors,
    estimates,
    lambda_1,
    lambda_2,
    mu,
    phi,
    tildes,
    true_parameters,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)
from ..one_car import one_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from ..plant import compact_force


@paper.claim("25", "The CEF is not negative", "inequality", r"E_i \ge 0", "proved", scope=EVERY_TRAIN)
def cef_not_negative() -> Goal:
    """Squares and integrals of squares, with positive gains."""
    return Goal((at_least(E, 0),))


@paper.claim("11", "Rate of z_1", "identity",
             r"\dot z_{1,i} = v_i - v_r - \lambda_{2,i} + c_1\lambda_{1,i} = z_{2,i} + \alpha_i + c_1\lambda_{1,i}",
             "proved", scope=EACH_CAR)
def z_1_rate() -> Goal:
    """D(z_1) along (7), (9), for any mu; alpha by (12)."""
    rates = {one_car(x): one_car(r) for x, r in rates_with(mu).items()}
    z = {x: one_car(expr) for x, expr in errors.items()}
    return Goal((equal(D(z[z_1]), one_car(v - v_r - lambda_2 + c_1 * lambda_1)),
                 equal(D(z[z_1]), z[z_2] + one_car(alpha + c_1 * lambda_1))), flow=rates)


@paper.claim("13", "Rate of V_1", "identity", r"\dot V_{1,i} = -c_1\|z_{1,i}\|^2 + z_{1,i}^T z_{2,i}", "proved",
             premises=("11",), scope=EVERY_TRAIN)
def v_1_rate() -> Goal:
    """D(V_1) with (10) put in, along (7), (9) with any mu."""
    stated = -c_1 * over_cars(z_1**2) + over_cars(z_1 * z_2)
    return Goal((equal(D(V_of(errors[z_1])), stated.xreplace(errors)),), flow=rates_with(mu))


delta_u = u_of_7 - mu
unforced_rate = v_dot - v_r_dot - alpha_dot + c_2 * lambda_2  # what is left of z_2' without c_3 Delta_u
bracket_14 = c_3 * mu + c_3 * (compact_force(true_parameters, v, phi, As, Av) - M * v_dot) + unforced_rate


@paper.claim("14", "Rate of z_2", "identity",
             r"\dot z_{2,i} = c_3\mu_i + c_3(\Theta_v v_i + \theta_a\phi(v_i) + \theta_k A s_i + \theta_d A v_i + "
             r"\eta - M\dot v_i) + \dot v_i - \dot v_r - \dot\alpha_i + c_2\lambda_{2,i}", "proved", premises=("7",),
             scope=EACH_CAR, note="'Theta_3' in the first line of (14) is Theta_v. The line adds c_3 times (7), so c_3 "
                                  "has the unit 1/kg; factors 1/s^2 and 1/s of value 1 before z_1 are left out.")
def z_2_rate() -> Goal:
    """D(z_2) along (7), (9), for any mu; both lines of (14)."""
    first_line = (c_3 * (u_of_7 + compact_force(true_parameters, v, phi, As, Av)) - c_3 * M * v_dot + unforced_rate
                  - c_3 * delta_u)
    rate = D(one_car(errors[z_2]))
    return Goal((equal(rate, one_car(first_line)), equal(rate, one_car(bracket_14))),
                flow={one_car(x): one_car(r) for x, r in rates_with(mu).items()})


@paper.claim("15", "Rate of V_2, with the estimates put in", "identity",
             r"\dot V_{2,i} = z_{2,i}^T[c_3\mu_i + c_3(\hat\Theta_{v,i}v_i + \dots - \hat M_i\dot v_i) + \dot v_i - "
             r"\dot v_r - \dot\alpha_i + c_2\lambda_{2,i}] - c_3z_{2,i}^T\tilde\Theta_{v,i}v_i - \dots + "
             r"c_3z_{2,i}^T\tilde M_i\dot v_i", "proved", premises=("14",), scope=EVERY_TRAIN,
             note="With tilde = hat minus true for all of them; the extracted text has a hat on the error of Theta_v.")
def v_2_rate() -> Goal:
    """D(V_2) along (7), (9), for any mu: both sides of the second equality."""
    with_hats = c_3 * mu + c_3 * (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot) + unforced_rate
    wrong = tuple(hat - true for hat, true in zip((*estimates, M_hat), (*true_parameters, M), strict=True))
    z = errors[z_2]
    return Goal((equal(D(V_of(z)), over_cars(z * bracket_14)),
                 equal(D(V_of(z)), over_cars(z * with_hats) + sp.Add(*estimation_terms(z, wrong)))),
                flow=rates_with(mu))


@paper.claim("24", "Rate of V in closed loop", "identity",
             r"\dot V_i = -c_1\|z_{1,i}\|^2 - c_2\|z_{2,i}\|^2 - c_3z_{2,i}^T\tilde\Theta_{v,i}v_i - "
             r"c_3z_{2,i}^T\tilde\theta_{a,i}\phi(v_i) - c_3z_{2,i}^T\tilde\theta_{k,i}As_i - "
             r"c_3z_{2,i}^T\tilde\theta_{d,i}Av_i - c_3z_{2,i}^T\tilde\eta_i + c_3z_{2,i}^T\tilde M_i\dot v_i",
             "proved", premises=("13", "15"), scope=EVERY_TRAIN,
             note="For every acceleration that solves the loop, saturated or not; see 16.loop for when one does.")
def v_rate() -> Goal:
    """D(V) along (7), (9), (16)."""
    return Goal((equal(D(V), decay + sp.Add(*estimation_terms(z_2, tildes))),), flow=flow)

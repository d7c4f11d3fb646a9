"""The law of chen2019: auxiliary system (9), backstepping (10)-(12), control (16), learning along the trials (17)-(22).

Symbols with the index j have one value per car; `_hat` is an estimate of this trial, `_prev` of the trial before at the
same instant. c_3 has the unit 1/kg; factors 1/s^2 and 1/s of value 1 before z_1 are left out as in the paper.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from workbench.trains.multi_particle import (
    coefficients,
    differences,
    each_car,
    f_a,
    first,
    m,
    m_total,
    over_cars,
    rates,
    rest_force,
    s,
    v,
)

from .plant import compact_force, compact_parameters

v_dot, lambda_1, lambda_2, Delta_u, mu = each_car("v_dot lambda_1 lambda_2 Delta_u mu")
z_1, z_2, phi, As, Av = each_car("z_1 z_2 phi As Av")
Theta, eta, M = each_car("Theta_v eta M")
Theta_hat, eta_hat, M_hat = each_car("Theta_v_hat eta_hat M_hat")
Theta_tilde, eta_tilde, M_tilde = each_car("Theta_v_tilde eta_tilde M_tilde")
theta = sp.symbols("theta_a theta_k theta_d", real=True)
theta_hat = sp.symbols("theta_a_hat theta_k_hat theta_d_hat", real=True)
theta_tilde = sp.symbols("theta_a_tilde theta_k_tilde theta_d_tilde", real=True)
s_r, v_r, v_r_dot = sp.symbols("s_r v_r v_r_dot", real=True)  # the same for all cars
c_1, c_2, c_3 = gains = sp.symbols("c_1 c_2 c_3", positive=True)
learning_gains = sp.symbols("gamma_v gamma_a gamma_k gamma_d gamma_eta gamma_M", positive=True)
gamma_v, gamma_a, gamma_k, gamma_d, gamma_eta, gamma_mass = learning_gains


def limited(value: sp.Expr, low: sp.Expr, high: sp.Expr) -> sp.Expr:
    """sat(value, low, high) of (4), (5), (8), (22), for low <= high."""
    return sp.Min(sp.Max(value, low), high)


# --- the parameters of (7), estimates and their errors --------------------------------------------------------------

true_parameters = (Theta, *theta, eta)
estimates = (Theta_hat, *theta_hat, eta_hat)
tildes = (Theta_tilde, *theta_tilde, eta_tilde, M_tilde)

# --- the law --------------------------------------------------------------------------------------------------------

auxiliary = {lambda_1: -c_1 * lambda_1 + lambda_2, lambda_2: -c_2 * lambda_2 + c_3 * Delta_u}  # (9)
alpha = -c_1 * (s - s_r)  # (12)
errors = {z_1: s - s_r - lambda_1, z_2: v - v_r - alpha - lambda_2}  # (10)
alpha_dot = sp.diff(alpha, s) * v + sp.diff(alpha, s_r) * v_r
mu_law = (-(c_2 * (v - v_r - alpha) + v_dot - v_r_dot - alpha_dot + errors[z_1]) / c_3
          - (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot))  # (16)

# (17)-(21): the step of each estimate per trial; q_a, q_k, q_d are the numbers z_2^T phi, z_2^T As, z_2^T Av.
q_sums = sp.symbols("q_a q_k q_d", real=True)
q_values = tuple(over_cars(z_2 * y) for y in (phi, As, Av))
driven_by = (z_2 * v, *q_sums, z_2)
learning_steps = tuple(gain * c_3 * x for gain, x in zip(learning_gains, driven_by, strict=False))


def mass_step(z: sp.Expr, acceleration: sp.Expr) -> sp.Expr:
    """The step of (22) before it is limited."""
    return -gamma_mass * c_3 * z * acceleration


def answer_to_lambda() -> sp.Expr:
    """d mu / d lambda_2 of one car, through the estimates of the same instant; its couplers at rest."""
    own = {q: term.function for q, term in zip(q_sums, q_values, strict=True)}
    alone = {As: sp.Integer(0), Av: sp.Integer(0), phi: first * v**2}
    learned = {hat: hat + step.xreplace(own) for hat, step in zip(estimates, learning_steps, strict=True)}
    command = mu_law.xreplace(learned).xreplace(alone)
    return sp.factor(sp.diff(command.xreplace({z_2: errors[z_2]}), lambda_2))


# The squares under the integrals of the energy function (25); those of the scalars are the same for all cars.
squares = (over_cars(Theta_tilde**2), *(x**2 for x in theta_tilde), over_cars(eta_tilde**2), over_cars(M_tilde**2))


def halved(terms: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    """Each term over twice its learning gain, as in (25)."""
    return tuple(x / (2 * gain) for x, gain in zip(terms, learning_gains, strict=True))


# c_lambda below (49) is the least of these; any_gains is the factor of claim 51.any_gains, which needs no c_lambda > 0.
c_lambda_candidates = (c_1 - sp.Rational(1, 2), c_2 - sp.Rational(1, 2) - c_3 / 2)
any_gains = (c_3 / c_2) ** 2 * (1 + 1 / c_1**2)

# --- the loop through the acceleration ------------------------------------------------------------------------------


def mu_of(kappa: sp.Expr, acceleration: sp.Expr, mass_estimate: sp.Expr) -> sp.Expr:
    """(16) of one car as a function of the acceleration; the terms without it are kappa (claim 16.loop)."""
    return kappa + (mass_estimate - 1 / c_3) * acceleration


def loop_force(mass: sp.Expr, kappa: sp.Expr, rest: sp.Expr, room: sp.Expr, low: sp.Expr, high: sp.Expr) -> sp.Expr:
    """The force that solves (1), (8), (16) of one car (claim 16.exists); room = m + 1/c_3 - m_hat must be positive."""
    return limited(mass * (kappa + rest) / room - rest, low, high)


# --- one sample of all cars, as it runs -----------------------------------------------------------------------------

u_low, u_high, m_low, m_high, v_dot_used = each_car("u_low u_high m_low m_high v_dot_used")
T_s, tau = sp.symbols("T_s tau", positive=True)
# Estimates of the trial before at this instant, and those that this instant's errors correct.
Theta_prev, eta_prev, M_prev = memory_prev = each_car("Theta_v_prev eta_prev M_prev")
Theta_old, eta_old, M_old = memory_old = each_car("Theta_v_old eta_old M_old")
theta_prev = sp.symbols("theta_a_prev theta_k_prev theta_d_prev", real=True)
theta_old = sp.symbols("theta_a_old theta_k_old theta_d_old", real=True)

ACCELERATION_RULES = ("exact", "sampled", "filtered")
CAR_STATE = (s, v, lambda_1, lambda_2)
CAR_DATA = (m, first, u_low, u_high, m_low, m_high)
CAR_RATES = tuple((rates | auxiliary)[x] for x in CAR_STATE)
CONTROL_SCALARS = (s_r, v_r, v_r_dot, *theta_prev, *theta_old)
VALUES = (*coefficients, m_total, *gains, *learning_gains, T_s, tau)


@dataclass(frozen=True)
class ControlSample:
    """What a sample computes of every car: by name, the learned estimates, and those that all cars share.

    computed: u, Delta_u, mu, z_1, z_2; used: the acceleration that the next sample uses; room: positive while the
    acceleration is unique; change: what the car adds to the change of the energy function's integrand.
    """

    computed: dict[str, sp.Expr]
    kept: tuple[sp.Expr, ...]
    shared: tuple[sp.Expr, ...]


def control_sample(rule: str) -> ControlSample:
    """(8)-(22) at one instant, the acceleration by one of ACCELERATION_RULES; KeyError for another.

    exact: the acceleration that solves the loop, with the estimate of the mass of the trial before; sampled: that of
    the sample before; filtered: that of the samples before through a low-pass of time constant tau.
    """
    along_train = {phi: first * v**2, As: differences(s), Av: differences(v)}
    known: dict[sp.Expr, sp.Expr] = along_train | {z: expr.xreplace(along_train) for z, expr in errors.items()}
    driven = tuple(x.xreplace(dict(zip(q_sums, q_values, strict=True))).xreplace(known) for x in learning_steps)
    rolling, *scalars, rest_step = driven
    before = (Theta_prev, *theta_prev, eta_prev)
    hats = tuple(old + step for old, step in zip(before, driven, strict=True))
    law = mu_law.xreplace(dict(zip(estimates, hats, strict=True))).xreplace(known)
    z = known[z_2]
    by_rule = {
        "exact": (M_prev, None),
        "sampled": (limited(M_prev + mass_step(z, v_dot_used), m_low, m_high), v_dot_used),
        "filtered": (limited(M_prev + mass_step(z, v_dot_used), m_low, m_high), v_dot_used),
    }
    mass_hat, used = by_rule[rule]
    room: sp.Expr = sp.Integer(1)
    if used is None:
        kappa, room = law.xreplace({v_dot: sp.Integer(0)}), m + 1 / c_3 - mass_hat
        force = loop_force(m, kappa, rest_force, room, u_low, u_high)
        used = (force + rest_force) / m
    command = law.xreplace({v_dot: used, M_hat: mass_hat})
    if rule != "exact":
        force = limited(command, u_low, u_high)
    caused = (force + rest_force) / m
    following = v_dot_used + (1 - sp.exp(-T_s / tau)) * (caused - v_dot_used) if rule == "filtered" else caused
    kept = (Theta_old + rolling, eta_old + rest_step, limited(M_old + mass_step(z, used), m_low, m_high))
    shared = tuple(old + step for old, step in zip(theta_old, scalars, strict=True))
    now, before = (energy_density(*x) for x in ((kept, shared), (memory_old, theta_old)))
    computed = {"u": force, "Delta_u": force - command, "mu": command, "z_1": known[z_1], "z_2": z, "used": following,
                "room": room, "change": now[0] - before[0]}
    return ControlSample(computed, kept, (*shared, now[1] - before[1]))


def energy_density(by_car: tuple[sp.Expr, ...], scalars: tuple[sp.Expr, ...]) -> tuple[sp.Expr, sp.Expr]:
    """The integrand of (25) for estimates of (Theta_v, eta, M) and theta: what one car adds, and what all share."""
    true = (*compact_parameters(m, m_total, f_a), m)
    hats = (by_car[0], *scalars, *by_car[1:])
    wrong = {tilde: hat - value for tilde, hat, value in zip(tildes, hats, true, strict=True)}
    terms = [(term.function if isinstance(term, sp.Sum) else term, isinstance(term, sp.Sum)) for term in squares]
    values = halved(tuple(term.xreplace(wrong) for term, _ in terms))
    return tuple(sp.Add(*(x for x, (_, of_car) in zip(values, terms, strict=True) if of_car is wanted))
                 for wanted in (True, False))

"""yang2021: the closed loop in error coordinates, from the plant (4) and the laws (27), (33)-(37)."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.model.law import neuron, over_neurons
from workbench.proof.derive import lie_derivative
from workbench.trains.train import a_star, b_star, c_star, f, single_particle_per_mass, u

from . import laws as law
from .laws import alpha, x_1, x_2

EVERY_NETWORK = "every number of neurons and every hidden function (term by term under the sum)"

lambdas = (law.lambda_1, law.lambda_2, law.lambda_3)
sigmas = (law.sigma_1, law.sigma_2, law.sigma_3)
stars = (a_star, b_star, c_star)
hats = (law.a_hat, law.b_hat, law.c_hat)
tildes = sp.symbols("a_tilde b_tilde c_tilde", real=True)
e_1, e_2, epsilon = sp.symbols("e_1 e_2 epsilon", real=True)
eps_star = sp.Symbol("epsilon_star", nonnegative=True)
W_tilde = sp.IndexedBase("W_tilde", real=True)[neuron]
W_star = sp.IndexedBase("W_star", real=True)[neuron]
h = sp.IndexedBase("h", real=True)[neuron]  # any hidden function, the Gaussian (5) among them

plant = single_particle_per_mass()
f_true = over_neurons(W_star * h) + epsilon  # (7)
rates = {x_1: plant.rates[x_1], x_2: plant.rates[x_2].xreplace({u: law.rbfnn_pocrac.command, f: f_true}),
         x_d: xdot_d, xdot_d: xddot_d}
rates |= {s.symbol: s.rate for s in law.rbfnn_pocrac.states}
to_errors = {x_1: e_1 + x_d, x_2: e_2 - alpha * e_1 + xdot_d, law.W_hat: W_tilde + W_star}
to_errors |= {hat: tilde + star for hat, tilde, star in zip(hats, tildes, stars, strict=True)}


def in_errors(expr: sp.Expr) -> sp.Expr:
    """An expression of the closed loop in e_1, e_2 and the estimation errors."""
    return sp.expand(expr.xreplace({law.h: h}).xreplace(to_errors))


x_2_errors = in_errors(x_2)
flow = {e_1: in_errors(lie_derivative(law.e_1, rates)), e_2: in_errors(lie_derivative(law.e_2, rates))}
flow |= {tilde: in_errors(rates[hat]) for tilde, hat in zip(tildes, hats, strict=True)}
flow[W_tilde] = in_errors(rates[law.W_hat])

# Before the control law is put in, u is free: (26)-(32).
open_rates = {x_1: x_2, x_2: plant.rates[x_2], x_d: xdot_d, xdot_d: xddot_d}
speed_error_rate_printed = u - a_star - b_star * x_2 - c_star * x_2**2 + f - law.rdot  # the right side of (25)
e_2_rate = sp.Symbol("edot_2", real=True)  # before the plant is put in

# The same closed loop where a*, b* and c* move too, as section 5 has them "uncertain or time-varying".
star_rates = sp.symbols("adot_star bdot_star cdot_star", real=True)
varying_flow = flow | dict(zip(stars, star_rates, strict=True)) | {
    tilde: flow[tilde] - rate for tilde, rate in zip(tildes, star_rates, strict=True)}

# Assumption 2; the bound is that of the line of Table 1 (claim A2).
f_star = sp.Symbol("f_star", positive=True)
STATED_F_STAR = Fraction(6, 100)  # m/s^2

"""yang2021: the barrier Lyapunov function (20), (30), (38), its rate (41) and the bound (48)-(51) of it."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import at_least, at_most, greater

from .error_dynamics import W_star, W_tilde, e_1, e_2, eps_star, epsilon, lambdas, sigmas, stars, tildes
from .laws import alpha, beta, chi, k

inside = greater(k**2 - e_1**2, 0)
barrier = k**2 / (k**2 - e_1**2)
V_1 = sp.log(barrier) / 2  # (20)
V_2 = V_1 + e_2**2 / 2  # (30)
V_weights = over_neurons(W_tilde**2 / (2 * chi))
V_estimates = sum((tilde**2 / (2 * lam) for tilde, lam in zip(tildes, lambdas, strict=True)), sp.Integer(0))
V = V_2 + V_weights + V_estimates  # (38)

V_1_rate = -alpha * e_1**2 / (k**2 - e_1**2) + e_1 * e_2 / (k**2 - e_1**2)  # (29)
leak = [sigma * tilde * (tilde + star) for sigma, tilde, star in zip(sigmas, tildes, stars, strict=True)]
V_rate = (-alpha * e_1**2 / (k**2 - e_1**2) - beta * e_2**2 + e_2 * epsilon
          - over_neurons(W_tilde * (W_tilde + W_star)) - sum(leak, sp.Integer(0)))  # (41)

error_bound = (at_most(epsilon, eps_star), at_least(epsilon, -eps_star))  # (7)
W_star_square = over_neurons(W_star**2)
l_stated = eps_star**2 / 2 + W_star_square / 2 + sum(
    (sigma * star**2 / 2 for sigma, star in zip(sigmas, stars, strict=True)), sp.Integer(0))  # (50)
bound_48 = (-alpha * sp.log(barrier) - (beta - sp.Rational(1, 2)) * e_2**2 - over_neurons(W_tilde**2) / 2
            - sum((s * x**2 / 2 for s, x in zip(sigmas, tildes, strict=True)), sp.Integer(0)) + l_stated)  # (48)
mu, l_ = sp.symbols("mu l", positive=True)
slowest = (at_most(mu, 2 * alpha), at_most(mu, 2 * beta - 1), at_most(mu, chi),
           *(at_most(mu, lam * sigma) for lam, sigma in zip(lambdas, sigmas, strict=True)))  # (49)

level = sp.Symbol("B", nonnegative=True)  # of V_1 and of V

# V as a function of time alone, for what (51) says of it.
t, V_t, V_t_rate, V_0 = sp.symbols("t V_t w V_0", real=True)
zeta, V_now = sp.symbols("zeta V", real=True)
decaying = (at_most(V_t_rate, -mu * V_t + l_), at_least(t, 0))
along_v = {t: sp.Integer(1), V_t: V_t_rate}
from_zero = {t: sp.Integer(0), V_t: V_0}

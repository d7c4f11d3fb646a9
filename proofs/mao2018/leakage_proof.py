"""mao2018: V_2 is bounded with leakage, the signs of the laws mended (claims 45.mended, 61.glyph, 65.mended)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.gains.certificate import goal_certificate
from workbench.proof.claim import D, Goal, Relation, at_least, at_most

from .active_mode import (
    Gamma_k,
    Gamma_m,
    Gamma_xi,
    chi_d,
    gains,
    hats,
    m,
    nu_damp,
    over_basis,
    rho_0,
    rho_hat,
    rho_k_hat,
    rho_law_61_true,
    trues,
    xi_hat,
)
from .error_dynamics import (
    Flow,
    b_0,
    c_0,
    disturbed,
    filippov,
    k_v,
    rho_i,
    rho_k,
    uncertain,
    uncertain_train,
    within,
    xi,
)
from .leakage import forgetting, leak
from .lyapunov import V_0, V_idle, V_t, V_true, constant, decay
from .plant import Delta_b, Delta_c, drag, r_1, r_2, t, z_1, z_2

mu = sp.Symbol("mu", positive=True)
E_idle = sp.Symbol("E_idle", nonnegative=True)
V_idle_rate = sp.Symbol("Vdot_idle", real=True)


def _weighed(term: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> sp.Expr:
    """The sum of a term of (true, estimate) over all estimates, with the weights that fit in V_2 (claim 45)."""
    scalars = [(x, hat, 1, gain) for x, hat, gain in zip(trues, hats, gains, strict=True)]
    scalars += [(rho_k, rho_k_hat, m * k_v, Gamma_k), (rho_i, rho_hat, m * k_v, Gamma_m)]
    failures = over_basis(term(xi, xi_hat)) * m / Gamma_xi
    return failures + sum((w * term(x, hat) / gain for x, hat, w, gain in scalars), sp.Integer(0))


def _rate(idle: sp.Expr, more: sp.Expr, given: tuple[Relation, ...], flow_idle: Flow) -> Goal:
    """The bound of V_2' with leakage; idle: what V_2 has of the idle modes, more: what its bound has of them."""
    flow = uncertain_train(rho_law_61_true)
    flow |= forgetting({x: rate for x, rate in flow.items() if x not in (z_1, z_2)}) | flow_idle
    V = V_true - V_idle + idle
    errors = _weighed(lambda x, hat: (x - hat) ** 2 / 2)
    zero = _weighed(lambda x, hat: x**2 / 2)
    pull = leak * _weighed(lambda x, hat: (x - hat) * hat)
    pulled = at_most(pull, -leak * errors + leak * zero)
    damped = z_2 * (nu_damp - drag)
    along = at_most(D(V), decay + damped + pull + more)
    given = (*filippov, *disturbed, *uncertain, at_most(chi_d, 1), at_least(m * k_v, rho_0), *given)
    return Goal((at_most(D(V), decay + constant - leak * errors + leak * zero + more),), given, flow, lemmas=(
        *within, at_most(Delta_b**2, b_0**2), at_most(Delta_c**2, c_0**2), at_most(damped, constant),
        along, pulled), inputs=tuple(rate for rate in flow_idle.values() if rate.is_Symbol))


def rate_of_every_mode() -> Goal:
    """V_2' with every estimate forgetting, also those of the idle modes, whose part of V_2 obeys what idle_mode shows."""
    more = -leak * V_idle + leak * E_idle
    return _rate(V_idle, more, (at_most(V_idle_rate, more),), {V_idle: V_idle_rate})


def idle_mode() -> Goal:
    """The part of V_2 of one mode whose indicators are zero, with leakage."""
    def part(term: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> sp.Expr:
        own = sum((term(x, hat) / gain for x, hat, gain in zip(trues, hats, gains, strict=True)), sp.Integer(0))
        return own + m * k_v * term(rho_i, rho_hat) / Gamma_m

    errors, zero = part(lambda x, hat: (x - hat) ** 2 / 2), part(lambda x, hat: x**2 / 2)
    return Goal((at_most(D(errors), -leak * errors + leak * zero),),
                flow={hat: -leak * hat for hat in (*hats, rho_hat)})


def leakage_goals() -> dict[str, Goal]:
    """V_2' <= -mu V_2 + K + leak E_0 with mu = min(2 r_1, 2 r_2, leak), along the loop itself, in three steps.

    E_0 is what the estimates weigh in V_2 while they are zero. While one mode lasts, whose part of V_2 this is: for what
    the other modes add see rate_of_every_mode.
    """
    rate = _rate(sp.Integer(0), sp.Integer(0), (), {})
    whole = sp.Symbol("E", nonnegative=True)
    slowest = (at_most(mu, 2 * r_1), at_most(mu, 2 * r_2), at_most(mu, leak))
    decayed = Goal((at_most(decay - leak * whole, -mu * (z_1**2 / 2 + z_2**2 / 2 + whole)),), slowest)
    w, offset = sp.symbols("w Lambda", real=True)
    bounded = Goal((at_most(V_t, offset / mu + (V_0 - offset / mu) * sp.exp(-mu * t)),), (),
                   {t: sp.Integer(1), V_t: w}, (at_most(w, -mu * V_t + offset), at_least(t, 0)),
                   {t: sp.Integer(0), V_t: V_0}, decreasing=sp.exp(mu * t) * (V_t - offset / mu), inputs=(w,))
    return {"rate": rate, "decay": decayed, "bounded": bounded}


def leakage_certificates() -> list[dict[str, Any]]:
    """The certificates of the three steps."""
    return [goal_certificate(f"mao2018:leakage.{name}", goal) for name, goal in leakage_goals().items()]

"""jiao2025: the laws along the trials (8)-(18).

k counts samples, i trials; `_i`, `_prev`, `_prev2` stand for trials i, i-1, i-2 at the same sample, Delta for the
difference of two successive trials. Forces in N, speeds in m/s.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from .plant import u_prev

rho, lamda, mu, eta, epsilon, K_p, K_d = sp.symbols("rho lamda mu eta epsilon K_p K_d", positive=True)
phi, phi_i, phi_prev, phi_first = sp.symbols("phi phi_hat_i phi_hat_prev phi_hat_1", real=True)
e_prev, e_prev2 = sp.symbols("e_prev e_prev2", real=True)
gamma, gamma_prev2 = sp.symbols("gamma gamma_prev2", real=True)
Delta_u, Delta_v = sp.symbols("Delta_u Delta_v", real=True)
e_next, e_now = sp.symbols("e_next e_now", real=True)


def input_step(estimate: sp.Expr, error: sp.Expr) -> sp.Expr:
    """u(k,i) - u(k,i-1) of (8), (11) and, with the modified error, (14)."""
    return rho * estimate / (lamda + estimate**2) * error


def estimate_step(step: sp.Expr, innovation: sp.Expr) -> sp.Expr:
    """phi_hat(k,i) - phi_hat(k,i-1) of (10), (12) and, with the modified innovation, (15)."""
    return eta * step / (mu + step**2) * innovation


def pd_step(error_next: sp.Expr, error: sp.Expr) -> sp.Expr:
    """u(k,i) - u(k,i-1) of (18) as printed."""
    return K_p * error_next + K_d * error


def reset(estimate: sp.Expr, step: sp.Expr) -> sp.Expr:
    """(13): the estimate, or the first one where it is too small, turned, or where the input hardly changed."""
    dropped = sp.Or(sp.Abs(estimate) <= epsilon, sp.Abs(step) <= epsilon,
                    sp.Ne(sp.sign(estimate), sp.sign(phi_first)))
    return sp.Piecewise((phi_first, dropped), (estimate, True))


@dataclass(frozen=True)
class TrialLaw:
    """A law that learns from trial to trial, sample by sample: what u(k,i) and phi_hat(k,i) become.

    The expressions may use, of trial i-1 at sample k: u_prev, phi_prev, phi_first, Delta_u = u(k,i-1) - u(k,i-2),
    Delta_v = v(k+1,i-1) - v(k+1,i-2), e_next = e*(k+1,i-1), e_now = e*(k,i-1), gamma = gamma(k+1,i-1) and
    gamma_prev2 = gamma(k+1,i-2). Errors and Delta_v are zero where data are missing, Delta_u is zero for i = 1,
    and the estimate is phi_first then. random_lengths: whether it is made for trials that end early.
    """

    id: str
    title: str
    source: str
    next_input: sp.Expr
    next_estimate: sp.Expr
    parameters: tuple[sp.Symbol, ...]
    random_lengths: bool = True


learned = phi_prev + estimate_step(Delta_u, gamma * (Delta_v - phi_prev * Delta_u))  # (15); (12) for gamma = 1
checked = reset(learned, Delta_u)  # (13)
# Claim 15.reset mended: where one of the two trials had ended nothing is known, and nothing is forgotten.
remembering = sp.Piecewise((checked, gamma * gamma_prev2 > 0), (phi_prev, True))
_adaptive = (rho, lamda, mu, eta, epsilon)

icfdl = TrialLaw(
    "jiao2025.icfdl", "iCFDL-MFAILC", "jiao2025 (13)-(15)",
    u_prev + input_step(checked, e_next), checked, _adaptive)
cfdl = TrialLaw(
    "jiao2025.cfdl", "CFDL-MFAILC", "jiao2025 (11)-(13)",
    u_prev + input_step(checked, e_next), checked, _adaptive, random_lengths=False)
icfdl_remembering = TrialLaw(
    "jiao2025.icfdl_remembering", "iCFDL-MFAILC that forgets no estimate over missing data",
    "jiao2025 (13)-(15), (13) only where two trials have data",
    u_prev + input_step(remembering, e_next), remembering, _adaptive)
fixed_estimate = TrialLaw(
    "jiao2025.fixed_estimate", "(14) with the first estimate kept", "jiao2025 (14) with phi_hat(k,i) = phi_hat(k,1)",
    u_prev + input_step(phi_first, e_next), phi_first, (rho, lamda), random_lengths=False)
pd = TrialLaw(
    "jiao2025.pd", "PD-type ILC", "jiao2025 (18)", u_prev + pd_step(e_next, e_now), phi_first, (K_p, K_d))
# Claim 18.name: as printed K_d acts on the error itself; here it acts on what its name says, the difference of the errors.
pd_difference = TrialLaw(
    "jiao2025.pd_difference", "PD-type ILC with K_d on the difference", "jiao2025 (18), K_d on e*(k+1) - e*(k)",
    u_prev + pd_step(e_next, e_next - e_now), phi_first, (K_p, K_d))

TRIAL_LAWS: dict[str, TrialLaw] = {
    law.id: law for law in (icfdl, cfdl, icfdl_remembering, fixed_estimate, pd, pd_difference)}

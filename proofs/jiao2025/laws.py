"""jiao2025: the train (1)-(3), the desired curve (16), the coefficients (17) and the laws along the trials (8)-(18).

k counts samples, i trials; `_i`, `_prev`, `_prev2` stand for trials i, i-1, i-2 at the same sample, Delta for the
difference of two successive trials. Forces in N, speeds in m/s.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

# --- the train ------------------------------------------------------------------------------------------------

T_s, M = sp.symbols("T_s M", positive=True)
v_i, v_prev, u_i, u_prev, f_a = sp.symbols("v_i v_prev u_i u_prev f_a", real=True)
b_0k, b_1k, b_2k = sp.symbols("b_0k b_1k b_2k", nonnegative=True)
k = sp.Symbol("k", real=True)
s_i = sp.Symbol("s_i", real=True)
slope_coefficient = sp.Symbol("x", real=True)
slope_angle = sp.Symbol("theta_s", real=True)
# N per unit of u, and by what (17) is divided: M as printed, 1 kg for resistances in N.
unit, divisor = sp.symbols("u_unit M_17", positive=True)


def basic_resistance(speed: sp.Expr) -> sp.Expr:
    """The basic resistance (3)."""
    return b_0k + b_1k * speed + b_2k * speed**2


def next_speed(speed: sp.Expr, force: sp.Expr, additional: sp.Expr = f_a) -> sp.Expr:
    """(1) with (3); (2) enters by its value f_a."""
    return speed + T_s / M * (force - additional - basic_resistance(speed))


additional_resistance = slope_coefficient * sp.sin(slope_angle)  # (2)

davis_newton = {b_0k: (2977, 275), b_1k: (sp.Rational("25.17"), sp.Rational("2.5")),
                b_2k: (sp.Rational("0.2864"), sp.Rational("0.04"))}  # (17) times M: mean and swing with sin(0.0037 k)


def coefficients(at: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """(17), divided by `divisor`, at the instant `at`."""
    wave = sp.sin(sp.Rational("0.0037") * at)
    return {b: (mean + swing * wave) / divisor for b, (mean, swing) in davis_newton.items()}


# v(k+1) and the position at k + 1 of a train that gets `unit` times the input
step_speed = next_speed(v_i, unit * u_i).xreplace(coefficients(k))
step_position = s_i + T_s * v_i
# The same with a resistance that opposes the motion: as printed, (3) drives a train that rolls backwards.
against_motion = sp.sign(v_i) * basic_resistance(sp.Abs(v_i))
step_speed_opposed = next_speed(
    v_i, unit * u_i, f_a + against_motion - basic_resistance(v_i)).xreplace(coefficients(k))

desired_pieces: tuple[tuple[int, int, sp.Expr], ...] = (  # (16): from, to, v_d(k)
    (0, 338, -sp.Rational(35, 57122) * (k - 338) ** 2 + 70),
    (338, 700, k / 181 + sp.Rational(12332, 181)),
    (700, 1000, -k / 100 + 79),
    (1000, 1600, k / 600 + sp.Rational(202, 3)),
    (1600, 2000, -sp.Rational(7, 16000) * (k - 1600) ** 2 + 70),
)


def desired_speed(at: int, piece: int) -> sp.Expr:
    """v_d at a sample by one piece of (16)."""
    return desired_pieces[piece][2].subs(k, at)


desired_curve = sp.Piecewise(*((speed, k <= to) for _, to, speed in desired_pieces[:-1]),
                             (desired_pieces[-1][2], True))

# --- the laws -------------------------------------------------------------------------------------------------

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
# Claim 18: as printed K_d acts on the error itself; here it acts on what its name says, the difference of the errors.
pd_difference = TrialLaw(
    "jiao2025.pd_difference", "PD-type ILC with K_d on the difference", "jiao2025 (18), K_d on e*(k+1) - e*(k)",
    u_prev + pd_step(e_next, e_next - e_now), phi_first, (K_p, K_d))

TRIAL_LAWS: dict[str, TrialLaw] = {
    law.id: law for law in (icfdl, cfdl, icfdl_remembering, fixed_estimate, pd, pd_difference)}

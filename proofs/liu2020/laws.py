"""The laws of liu2020: neural observer (12), (17)-(21) and output feedback controller (22), (23), (30)-(35).

The expressions are those that the claims decide. From them come the laws as printed and as corrected, in two
readings of the observer's damping: (12) and (14) print k_3 v_tilde, while (18) and (25) have k_3 s_tilde'.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from workbench.model.law import (
    ControlLaw,
    LawState,
    desired_acceleration,
    desired_position,
    desired_speed,
    neuron,
    over_neurons,
    period,
    position,
    speed,
)

from .plant import M, s, v


def indexed(name: str) -> sp.Indexed:
    """One number per neuron."""
    return sp.IndexedBase(name, real=True)[neuron]


s_hat, v_hat, delta_hat, theta_hat = sp.symbols("s_hat v_hat delta_hat theta_hat", real=True)
s_d, sdot_d, sddot_d = sp.symbols("s_d sdot_d sddot_d", real=True)
k_1, k_2, k_3, k_4, k_5 = sp.symbols("k_1:6", positive=True)
FEEDBACK_GAINS = tuple(map(str, (k_1, k_2, k_3, k_4, k_5)))
kappa_1, kappa_2, alpha_1, alpha_2, beta_1, beta_2 = sp.symbols(
    "kappa_1 kappa_2 alpha_1 alpha_2 beta_1 beta_2", positive=True)
sigma_f, sigma_v = sp.symbols("sigma_f sigma_v", positive=True)
delta_0, theta_0, D_1, D_2, e_v = sp.symbols("delta_0 theta_0 D_1 D_2 e_v", real=True)
W_f_hat, W_f_0, h_f, g_f = map(indexed, ("W_f_hat", "W_f_0", "h_f", "g_f"))
W_v_hat, W_v_0, h_v, g_v = map(indexed, ("W_v_hat", "W_v_0", "h_v", "g_v"))

# --- the observer -----------------------------------------------------------------------------------------------------

s_error, v_error = s_hat - s, v_hat - v  # (11)
s_hat_rate = v_hat - k_1 * s_error  # (12)
s_error_rate = sp.diff(s_error, s_hat) * s_hat_rate + sp.diff(s_error, s) * v  # along (9), (12)
f_hat = over_neurons(W_f_hat * h_f)  # (17); h_f stands for h_f(z_1_hat)


def speed_estimate_rate(damped: sp.Expr) -> sp.Expr:
    """v_hat' of (12); `damped` is what k_3 stands before: s_tilde' as in (18) and (25), v_tilde as (12) prints."""
    return f_hat - k_2 * s_error - k_3 * damped + D_1


v_hat_rate = speed_estimate_rate(s_error_rate)
update_signal = sp.expand(s_error_rate + k_1 * s_error)  # of (19)-(21)


def gamma_1(x: sp.Expr) -> sp.Expr:
    """The smooth sign of (20), (21)."""
    return sp.tanh(x / kappa_1)


def gamma_2(x: sp.Expr) -> sp.Expr:
    """The smooth sign of (34), (35)."""
    return sp.tanh(x / kappa_2)


robust_1 = -gamma_1(update_signal) * delta_hat  # (20)


def observer_laws(leak: int = 1) -> dict[sp.Expr, sp.Expr]:
    """(19), (21); leak = 1 as printed, -1 with the sign of the leakage corrected."""
    return {W_f_hat: g_f**2 * (-h_f * update_signal + leak * sigma_f * (W_f_hat - W_f_0)),
            delta_hat: alpha_1 * (gamma_1(update_signal) * update_signal + leak * beta_1 * (delta_hat - delta_0))}


# --- the controller ---------------------------------------------------------------------------------------------------

e_s_stated = s_d - s_hat  # (22)
e_v_stated = k_4 * e_s_stated + (sdot_d - v_hat)  # (23) with the second line of (22)
robust_2 = gamma_2(e_v) * theta_hat  # (34)
command = over_neurons(W_v_hat * h_v) + k_5 * e_v + D_2  # (31), N


def tracking_laws(leak: int = 1, learn: int = -1) -> dict[sp.Expr, sp.Expr]:
    """(32), (35); leak = 1 and learn = -1 as printed, the other signs are the corrected ones."""
    return {W_v_hat: g_v**2 * (learn * h_v * e_v + leak * sigma_v * (W_v_hat - W_v_0)),
            theta_hat: alpha_2 * (gamma_2(e_v) * e_v + leak * beta_2 * (theta_hat - theta_0))}


# --- the networks' inputs, of order one -------------------------------------------------------------------------------

s_scale, v_scale, a_scale, u_scale, width = sp.symbols("s_scale v_scale a_scale u_scale b_h", positive=True)
u_before = sp.Symbol("u_before", real=True)  # N; breaks the loop from u through h_f(z_1_hat) back to u
z_1_hat = (s_hat / s_scale, v_hat / v_scale, u_before / u_scale)
z_2 = (s / s_scale, v / v_scale, v_hat / v_scale, s_d / s_scale, sdot_d / v_scale, sddot_d / a_scale)
centers_f = tuple(indexed(f"c_f_{i}") for i in range(1, len(z_1_hat) + 1))
centers_v = tuple(indexed(f"c_v_{i}") for i in range(1, len(z_2) + 1))


def hidden(inputs: tuple[sp.Expr, ...], centers: tuple[sp.Expr, ...]) -> sp.Expr:
    """Gaussian output of one hidden neuron, (16) and (29)."""
    squared_distance = sum(((z - c) ** 2 for z, c in zip(inputs, centers, strict=True)), sp.Integer(0))
    return sp.exp(-squared_distance / width**2)


# --- the laws as they run ---------------------------------------------------------------------------------------------

Gamma_f, Gamma_v, tau = sp.symbols("Gamma_f Gamma_v tau", positive=True)
W_f_prior, W_v_prior = sp.symbols("W_f_prior W_v_prior", real=True)
xi, s_before, v_before, s_tilde, v_tilde = sp.symbols("xi s_before v_before s_tilde v_tilde", real=True)

# The filtered difference of the sampled position: what can be had of the speed by measuring the position alone.
differenced = v_before + period / (tau + period) * ((position - s_before) / period - v_before)

# Every neuron has the same gain and prior: Gamma is a multiple of the identity.
_alike = {g_f: sp.sqrt(Gamma_f), g_v: sp.sqrt(Gamma_v), W_f_0: W_f_prior, W_v_0: W_v_prior}
_measured = {s: position, s_d: desired_position, sdot_d: desired_speed, sddot_d: desired_acceleration}

FEEDBACK_PARAMETERS = (M, k_1, k_2, k_3, k_4, k_5)
LEARNING_PARAMETERS = (Gamma_f, sigma_f, W_f_prior, kappa_1, alpha_1, beta_1, delta_0, Gamma_v, sigma_v, W_v_prior,
                       kappa_2, alpha_2, beta_2, theta_0, width, s_scale, v_scale, a_scale, u_scale)


@dataclass(frozen=True)
class Reading:
    """What a law is made of.

    damped: what k_3 stands before, `v_tilde` as (12) prints or `s_tilde'` as (18) and (25) have it.
    signal: how v of the update laws is had, `measured` or as the `differenced` position.
    leak, learn: signs of the leakage and of (32), 1 and -1 as printed, -1 and 1 corrected; neither without learning.
    """

    damped: str = "v_tilde"
    signal: str = "measured"
    learning: bool = True
    leak: int = -1
    learn: int = 1


def law(name: str, title: str, source: str, reading: Reading) -> ControlLaw:
    """The law of a reading; its command is (31) per unit of mass.

    With k_3 s_tilde' the observer's state is xi = v_hat + k_3 s_tilde (claim 12.glyph), whose rate needs no speed. The states
    s_tilde and v_tilde only record the estimation errors at the sample; no law uses them.
    """
    by_rate = reading.damped == "s_tilde'"
    speed_had = differenced if reading.signal == "differenced" else speed
    estimate = xi - k_3 * s_error if by_rate else v_hat
    outputs = {h_f: hidden(z_1_hat, centers_f), h_v: hidden(z_2, centers_v)}
    robust = {D_1: robust_1, D_2: robust_2} if reading.learning else {D_1: sp.Integer(0), D_2: sp.Integer(0)}
    nothing = {} if reading.learning else {f_hat: sp.Integer(0), over_neurons(W_v_hat * h_v): sp.Integer(0)}

    def sampled(expr: sp.Expr, true_speed: sp.Expr = speed_had) -> sp.Expr:
        """An expression of the paper in what a law has at a sampling instant."""
        for step in (nothing, robust, _alike, outputs, {e_v: e_v_stated}, {v_hat: estimate},
                     {v: true_speed} | _measured):
            expr = expr.xreplace(step)
        return expr

    shifted = sp.expand(v_hat_rate + k_3 * s_error_rate)  # xi' of claim 12.glyph
    speed_state = LawState(xi, rate=sampled(shifted)) if by_rate else LawState(
        v_hat, rate=sampled(speed_estimate_rate(v_error)))
    states = [LawState(s_hat, rate=sampled(s_hat_rate)), speed_state,
              LawState(s_tilde, update=sampled(s_error)), LawState(v_tilde, update=sampled(v_error, speed))]
    if reading.signal == "differenced":
        states += [LawState(s_before, update=position), LawState(v_before, update=differenced)]
    if reading.learning:
        states += [LawState(u_before, update=sampled(command)),
                   *(LawState(state, rate=sampled(rate)) for state, rate in
                     (observer_laws(reading.leak) | tracking_laws(reading.leak, reading.learn)).items())]
    parameters = FEEDBACK_PARAMETERS + (LEARNING_PARAMETERS if reading.learning else ())
    needs_speed = any(expr.has(speed) for expr in (
        sampled(command), *(state.rate or state.update for state in states if state.symbol != v_tilde)))
    return ControlLaw(
        id=f"liu2020.{name}", title=title, source=f"liu2020 {source}",
        information="full state, model unknown" if needs_speed else "position only, model unknown",
        command=sampled(command) / M, states=tuple(states),
        parameters=parameters + ((tau,) if reading.signal == "differenced" else ()),
        neuron_data=(*centers_f, *centers_v) if reading.learning else (),
    )


_LINEAR = "(12), (22), (23), (31) without networks and robust terms"
_WHOLE = "(12), (17)-(23), (30)-(35)"
_MENDED = f"{_WHOLE}, signs of (19), (21), (32), (35) corrected"
_RATE = "k₃s̃′"

LAWS: dict[str, ControlLaw] = {made.id: made for made in (
    law("feedback", "feedback alone", _LINEAR, Reading(learning=False)),
    law("feedback_rate", f"feedback alone, {_RATE}", _LINEAR, Reading("s_tilde'", learning=False)),
    law("printed", "as printed", f"{_WHOLE} as printed", Reading(leak=1, learn=-1)),
    law("corrected", "signs corrected", _MENDED, Reading()),
    law("wrong_leakage", "leakage as printed, (32) corrected", _WHOLE, Reading(leak=1)),
    law("wrong_learning", "(32) as printed, leakage corrected", _WHOLE, Reading(learn=-1)),
    law("printed_rate", f"as printed, {_RATE}", f"{_WHOLE} as printed, (12) as in (18)",
        Reading("s_tilde'", leak=1, learn=-1)),
    law("corrected_rate", f"signs corrected, {_RATE}", f"{_MENDED}, (12) as in (18)", Reading("s_tilde'")),
    law("position_only", f"signs corrected, {_RATE}, position alone measured",
        f"{_MENDED}, (12) as in (18), v of (19)-(21), (30) by differences", Reading("s_tilde'", "differenced")),
    law("position_only_speed", "signs corrected, position alone measured",
        f"{_MENDED}, v of (12), (19)-(21), (30) by differences", Reading(signal="differenced")),
)}

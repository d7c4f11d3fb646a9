"""The laws of mao2018 for the four modes of its section VIII, put together from the active mode's expressions.

Indicators are functions of time with stated switch times. Each mode has its own estimates, which rest while it is
idle. The failure estimates are carried once instead of sixteen times: (15) repeats the same basis signals for every
motor, so that its copies, which start alike, stay alike.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Literal

import sympy as sp

from workbench.model.law import (
    ControlLaw,
    LawState,
    desired_acceleration,
    desired_position,
    desired_speed,
    position,
    speed,
    time,
)

from . import active_mode as active
from . import plant

MODES = (1, 2, 3, 4)
SLOPE_MODE = 3
switch_times = sp.symbols("T_2:5", nonnegative=True)
ramp_rate = sp.Symbol("psi_rate", positive=True)
layer = sp.Symbol("layer", nonnegative=True)
motors, nominal_mass, force_unit = sp.symbols("n M_0 F_unit", positive=True)
omega, phase = sp.symbols("omega phase", real=True)

Sign = Literal["44", "54", "61"]
Flow = dict[sp.Expr, sp.Expr]


def _since(start: sp.Expr) -> sp.Expr:
    return sp.Piecewise((1, time >= start), (0, True))


# chi_i of (6) for the parameters that come and go at once: 1 while mode i lasts.
indicators = tuple(begun - ended for begun, ended in zip(
    (sp.Integer(1), *map(_since, switch_times)), (*map(_since, switch_times), sp.Integer(0)), strict=True))
# The slope's grows to 1 first.
slope_indicator = indicators[SLOPE_MODE - 1] * sp.Min(1, plant.slope_ramp(
    ramp_rate, switch_times[SLOPE_MODE - 2]).xreplace({plant.t: time}))

error = position - desired_position  # (18)
_measured: Flow = {plant.x_1: position, plant.x_2: speed, plant.x_m: desired_position, plant.xdot_m: desired_speed,
                   plant.xddot_m: desired_acceleration}
z_2 = speed - active.alpha_1.xreplace(_measured)  # (19)
sign = sp.Piecewise((z_2 / (sp.Abs(z_2) + layer), layer > 0), (sp.sign(z_2), True))

signals = (sp.Integer(1), sp.sin(omega * time + phase))  # varpi of (15) for the failures (67)
xi_hats = sp.symbols("xi_hat_0 xi_hat_1", real=True)
_xi_varpi = motors * sum((xi * signal for xi, signal in zip(xi_hats, signals, strict=True)), sp.Integer(0))


def _own(symbol: sp.Expr, mode: int) -> sp.Symbol:
    return sp.Symbol(f"{symbol}_{mode}", real=True, positive=symbol.is_positive)


lambdas = tuple(_own(active.lambda_0, mode) for mode in MODES)


def in_mode(expr: sp.Expr, mode: int) -> sp.Expr:
    """An expression of the active mode with the symbols of mode 1 to 4, its indicators and what is measured."""
    chi = indicators[mode - 1]
    own = {symbol: _own(symbol, mode) for symbol in (*active.hats, active.rho_hat, active.lambda_0, active.lambda_hat)}
    chis = dict.fromkeys((*active.chis, active.chi_d), chi)
    if mode == SLOPE_MODE:
        chis[active.chis[active.REGRESSORS.index(plant.g)]] = slope_indicator
    return expr.xreplace({active.failure_hat: _xi_varpi, **own, **chis, plant.s: sign, plant.z_1: error,
                         plant.z_2: z_2}).xreplace(_measured)


def _over_modes(expr: sp.Expr) -> sp.Expr:
    """Sum over the modes, each with its chi_mi, of an expression of the active mode."""
    return sum((indicators[mode - 1] * in_mode(expr, mode) for mode in MODES), sp.Integer(0))


def _states(law: Flow, within: Callable[[int], sp.Expr] = lambda mode: sp.Integer(1)) -> tuple[LawState, ...]:
    return tuple(LawState(_own(hat, mode), rate=within(mode) * in_mode(rate, mode))
                 for mode in MODES for hat, rate in law.items())


def _chi_m(mode: int) -> sp.Expr:
    return indicators[mode - 1]


_common = (plant.r_1, plant.r_2, plant.g, *active.gains, active.Gamma_m, active.rho_0)
_when = (*switch_times, ramp_rate, layer)
_failing = (active.Gamma_k, active.Gamma_xi, motors, omega, phase)
_units = (nominal_mass, force_unit)


def _law(name: str, title: str, source: str, force: sp.Expr, states: tuple[LawState, ...],
         parameters: tuple[sp.Symbol, ...]) -> ControlLaw:
    return ControlLaw(
        id=f"mao2018.{name}", title=title, source=f"mao2018 {source}", information="full state, model unknown",
        command=force * force_unit / nominal_mass, states=states, parameters=(*_common, *parameters, *_when, *_units),
        errors={"z_1": error, "z_2": z_2})


healthy = _law(
    "healthy", "healthy motors", "(27)-(33), (35)-(37)", _over_modes(active.F_35),
    (*_states(active.estimate_laws), *_states({active.rho_hat: active.rho_law}, _chi_m)), lambdas)

Kind = Literal["failures", "unparameterized", "unknown_bound", "damped"]
# Of each law: its title, its equations, its signal nu_0, its own parameters, and the printed signs that are wrong.
KINDS: dict[Kind, tuple[str, str, sp.Expr, tuple[sp.Symbol, ...], tuple[Sign, ...]]] = {
    "failures": ("known bounds", "(41)-(44)", active.signal_of(active.nu_failed), lambdas, ("44",)),
    "unparameterized": ("unparameterizable failures", "(41), (44), (48)-(50)",
                        active.signal_of(active.nu_failed + active.nu_s_sum),
                        (*lambdas, active.delta_0, active.rho_k0), ("44",)),
    "unknown_bound": ("unknown bounds", "(41), (44), (54)-(56)", active.signal_of(active.nu_unknown), (active.Gamma_d,),
                      ("44", "54")),
    "damped": ("nonlinear damping", "(41), (43), (44), (60)-(62)", active.signal_60, (*lambdas, active.k_1, active.k_2),
               ("44", "61")),
}


def corrections(kind: Kind, mended: Collection[Sign]) -> str:
    """`as printed`, `corrected`, or which of several wrong signs are corrected."""
    wrong = KINDS[kind][-1]
    if not mended:
        return "as printed"
    return "corrected" if set(mended) == set(wrong) else f"({'), ('.join(mended)}) corrected"


def failure_law(kind: Kind, mended: Collection[Sign] = ()) -> ControlLaw:
    """A law of sections IV to VII with the signs of the equations named in `mended` turned, the others as printed."""
    title, source, signal, own, _ = KINDS[kind]
    rho_k_law = active.rho_k_law_true if "44" in mended else active.rho_k_law
    rho_law = active.rho_law if kind != "damped" else active.rho_law_61_true if "61" in mended else active.rho_law_61
    states = (*_states(active.estimate_laws), *_states({active.rho_hat: rho_law}, _chi_m),
              LawState(active.rho_k_hat, rate=in_mode(rho_k_law, MODES[0])),
              *(LawState(xi, rate=in_mode(active.xi_law[active.xi_hat], MODES[0]).xreplace({active.varpi: by}))
                for xi, by in zip(xi_hats, signals, strict=True)))
    if kind == "unknown_bound":
        states += _states({active.lambda_hat: active.lambda_law_true if "54" in mended else active.lambda_law})
    which = corrections(kind, mended)
    name = {"corrected": "corrected", "as printed": "printed"}.get(which, f"mended_{'_'.join(mended)}")
    # Every motor is told nu_0; a command is the force of all of them, failed ones included.
    return _law(f"{kind}_{name}", f"{title}, {which}", f"(27)-(33), (37), {source}, {which}",
                motors * _over_modes(signal), states, (*_failing, *own))


LAWS: tuple[ControlLaw, ...] = (healthy, *(failure_law(kind, mended) for kind, (*_, wrong) in KINDS.items()
                                           for mended in ((), wrong)))

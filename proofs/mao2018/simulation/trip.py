"""mao2018's section VIII in SI units: the train and its events, a law with its numbers, and their run, for a case."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp

from workbench.model.events import Failure, Mode, PushTerm, Term, failure_rows, mode_rows, push_rows
from workbench.model.law import ControlLaw
from workbench.simulate.closed_loop import Array, Run, Setting, run_law

from .. import active_mode, laws, plant

if TYPE_CHECKING:
    from ..study.record import CaseData, MaoStudy, ModeData, Tuning

Signs = tuple[laws.Sign, ...]
Values = tuple[Array, Array, Array, Array]
TONNE, KILONEWTON = 1e3, 1e3


def per_mass(study: MaoStudy) -> float:
    """What turns the mode table's kN, kN s/m and kN s^2/m^2 into those of the model (5), per unit of mass.

    The table's numbers belong to (9), (10), so they are read per tonne; as printed they are the whole train's.
    """
    return KILONEWTON / (TONNE if study.readings.resistance == "per tonne" else TONNE * study.train.mass_t)


def slope(study: MaoStudy, mode: ModeData) -> float:
    """vartheta = sin(theta) of a mode."""
    theta = mode.theta_deg if study.readings.angle == "radian" else math.radians(mode.theta_deg)
    return math.sin(theta)


def _number(expr: sp.Expr, values: dict[sp.Expr, float]) -> float:
    return float(expr.xreplace({symbol: sp.Float(value) for symbol, value in values.items()}))


def _sourced(values: dict[str, Any]) -> dict[str, Any]:
    return values | {"source": dict.fromkeys(values, "convention: converted from the study's file")}


def _window(term: Term) -> dict[str, Any]:
    return {key: getattr(term, key) for key in ("from_s", "to_s", "omega_rad_s", "phase_rad")}


def _modes(study: MaoStudy) -> list[Mode]:
    """(1)-(3) per unit of mass, the slope's force growing with its indicator."""
    scale, found = per_mass(study), []
    for mode in study.modes:
        at = {plant.M: 1.0, plant.g: study.train.gravity_mps2, plant.vartheta: slope(study, mode),
              plant.D_c: mode.curve_deg}
        values = {
            "from_s": mode.start_s, "davis_a_mps2": scale * mode.a_kn, "davis_b_per_s": scale * mode.b_kn_s_per_m,
            "davis_c_per_m": scale * mode.c_kn_s2_per_m2, "grade_mps2": _number(plant.F_g, at),
            "curve_mps2": _number(plant.F_c, at),
            "grade_ramp_s": 1 / mode.slope_ramp_per_s if mode.slope_ramp_per_s else 0.0,
        }
        found.append(Mode(**_sourced(values)))
    return found


def failures_of(study: MaoStudy, case: CaseData) -> list[Failure]:
    """(67), one motor of all, and what no basis signal describes (16)."""
    parts = [(part, 1 / study.train.motors) for part in study.failure if "failure" in case.events]
    parts += [(part, 0.0) for part in study.rest if "rest" in case.events]
    return [Failure(**_sourced(_window(part) | {
        "failed_share": share, "offset_n": part.offset, "amplitude_n": part.amplitude})) for part, share in parts]


def _pushes(study: MaoStudy, case: CaseData) -> list[PushTerm]:
    """-d/M of (66), and what (59) adds to the resistance."""
    unit = -study.readings.disturbance_unit_n / (TONNE * study.train.mass_t)
    found = [_window(term) | {"offset_mps2": unit * term.offset, "amplitude_mps2": unit * term.amplitude}
             for term in study.disturbances[case.disturbance].terms]
    if "drag" in case.events:
        scale = per_mass(study)
        found += [_window(term) | {"amplitude_mps2": scale * term.amplitude, "speed_power": term.speed_power}
                  for term in study.drag]
    return [PushTerm(**_sourced(values)) for values in found]


def setting_of(study: MaoStudy, case: CaseData, tuning: Tuning, end_s: float | None = None) -> Setting:
    """The train of a case, its events and its desired curve, in SI units."""
    mass = TONNE * study.train.mass_t
    return Setting(
        curve=study.reference.curve(), mass_kg=mass, nominal_mass_kg=mass, davis_n=(0.0, 0.0, 0.0),
        plant_step_s=tuning.period_s, end_s=end_s or study.horizon.end_s, log_every_s=study.horizon.log_every_s,
        position_band_m=abs(case.initial_position_m) or 1.0, initial_position_m=case.initial_position_m,
        terms=push_rows(_pushes(study, case)), failures=failure_rows(failures_of(study, case)),
        changes=mode_rows(_modes(study), mass, (1.0, 1.0, 1.0)))


def _scales(study: MaoStudy, tuning: Tuning) -> tuple[float, ...]:
    """By what the regressors of a, b, c, vartheta, D are divided: nothing, or their largest values."""
    if tuning.regressors == "SI":
        return (1.0,) * len(active_mode.REGRESSORS)
    at = {plant.x_2: max(study.reference.speeds_mps), plant.g: study.train.gravity_mps2}
    return tuple(_number(by, at) for by in active_mode.REGRESSORS)


def parameters(study: MaoStudy, case: CaseData, tuning: Tuning) -> dict[str, float]:
    """A law's parameters by name, forces in the law's unit."""
    law, mass = study.law, TONNE * study.train.mass_t
    m = law.force_unit_n / mass  # what the law's unit of force gives the train, m/s^2
    starts = [mode.start_s for mode in study.modes]
    bounds = study.disturbances[case.disturbance].bounds.by_mode
    healthy = 1 if case.law == "healthy" else study.train.motors - 1
    values = {str(gain): law.gain / scale**2
              for gain, scale in zip(active_mode.gains, _scales(study, tuning), strict=True)}
    values |= {str(symbol): study.readings.disturbance_unit_n * bound / (law.lower_bound_share * mass)
               for symbol, bound in zip(laws.lambdas, bounds, strict=True)}
    values |= {str(symbol): start for symbol, start in zip(laws.switch_times, starts[1:], strict=True)}
    return values | {
        "r_1": tuning.r_1_per_s, "r_2": tuning.r_2_per_s, "g": study.train.gravity_mps2, "Gamma_m": law.gain_rho,
        "Gamma_k": law.gain_rho_k, "Gamma_xi": law.gain_xi, "Gamma_d": law.gain_lambda,
        "rho_0": law.lower_bound_share * healthy * m, "rho_k0": float(healthy),
        "delta_0": law.rest_bound_n / law.force_unit_n, "k_1": law.k_1, "k_2": law.k_2, "layer": law.layer_mps,
        "psi_rate": study.modes[laws.SLOPE_MODE - 1].slope_ramp_per_s or 1.0, "n": float(study.train.motors),
        "omega": law.omega_rad_s, "phase": law.phase_rad, "M_0": mass, "F_unit": law.force_unit_n,
    }


def initial(study: MaoStudy, case: CaseData) -> dict[str, float]:
    """The estimates at the start: the stated share of what each would be if it were right, all motors healthy."""
    mass, scale = TONNE * study.train.mass_t, per_mass(study)
    motors = 1 if case.law == "healthy" else study.train.motors
    bounds = study.disturbances[case.disturbance].bounds.by_mode
    right: dict[str, float] = {"rho_k_hat": 1 / motors}
    for number, mode, bound in zip(laws.MODES, study.modes, bounds, strict=True):
        of_mode = (scale * mode.a_kn, scale * mode.b_kn_s_per_m, scale * mode.c_kn_s2_per_m2, slope(study, mode),
                   mode.curve_deg)
        right |= {f"{hat}_{number}": value for hat, value in zip(active_mode.hats, of_mode, strict=True)}
        right[f"rho_hat_{number}"] = mass / (study.law.force_unit_n * motors)
        right[f"lambda_hat_{number}"] = study.readings.disturbance_unit_n * bound / mass
    return {name: case.estimate_share * value for name, value in right.items()} | {
        "xi_hat_0": study.law.failure_start_n / (study.law.force_unit_n * study.train.motors), "xi_hat_1": 0.0}


def wrong_signs(case: CaseData) -> Signs:
    """The equations of a case's law whose printed sign is wrong."""
    return () if case.law == "healthy" else laws.KINDS[case.law][-1]


def law_of(case: CaseData, mended: Signs) -> ControlLaw:
    """The law of a case, with some of its wrong signs mended."""
    return laws.healthy if case.law == "healthy" else laws.failure_law(case.law, mended)


def values_of(law: ControlLaw, study: MaoStudy, case: CaseData, tuning: Tuning) -> Values:
    """The law's numbers in the order that it lists its symbols."""
    named, start = parameters(study, case, tuning), initial(study, case)
    return (np.array([named[str(symbol)] for symbol in law.parameters]),
            np.array([start[str(state.symbol)] for state in law.scalar_states]), np.zeros((0, 0)), np.zeros((0, 0)))


def run_under(law: ControlLaw, study: MaoStudy, case: CaseData, tuning: Tuning, setting: Setting) -> Run:
    """The run of a law with the numbers of a case, in a setting."""
    return run_law(law, values_of(law, study, case, tuning), setting, tuning.period_s, study.law.estimates,
                   plant=plant.train)

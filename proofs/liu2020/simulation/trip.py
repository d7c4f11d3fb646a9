"""liu2020's section 6 in SI units: train, line, reference, disturbances, and the numbers of a law."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp

from workbench.compile.kernel import numeric
from workbench.model.desired_curve import DesiredCurve, start_cruise_stop
from workbench.model.law import ControlLaw
from workbench.simulate.closed_loop import Array, Run, Setting, run_law
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2
from workbench.trains.track import ResistanceTable

from .. import plant as of_train
from ..laws import FEEDBACK_GAINS

if TYPE_CHECKING:
    from ..study.record import Line, LiuStudy, Section, Train

KMH_PER_MPS = 3.6
SLOPE_UNITS = {"percent": 1e-2, "permille": 1e-3}

_davis = numeric((of_train.v, of_train.a_0, of_train.a_1, of_train.a_2), of_train.davis(of_train.v))
_newton = numeric((of_train.u, of_train.f_d, of_train.d, of_train.chi, of_train.M), of_train.acceleration)
_opposing = numeric((of_train.additional, of_train.d, of_train.chi, of_train.M), of_train.opposing_force)


def davis_newton(train: Train) -> tuple[float, float, float]:
    """The coefficients of (61) in N, N s/m, N s^2/m^2, by the unit that they are read in."""
    per_mass = 1.0 if train.davis_unit.startswith("N/kg") else STANDARD_GRAVITY_MPS2 / 1000
    per_speed = KMH_PER_MPS if train.davis_unit.endswith("km/h") else 1.0
    a, b, c = (train.mass_kg * per_mass * value for value in train.davis)
    return a, b * per_speed, c * per_speed**2


def davis_at(train: Train, speed_mps: float) -> float:
    """The general resistance (8), N."""
    return float(_davis(speed_mps, *davis_newton(train)))


def section_force(section: Section, line: Line, train: Train) -> float:
    """The additional resistance (2)-(4) in a section, N.

    (3) is read with the centre angle in degrees: 0.1029 is the 10.5 N/kN per degree and metre of the rule that it
    states, times g/1000. The tunnel has no restricted ramp, since no row of Table 1 has both.
    """
    values: dict[sp.Basic, float] = {
        of_train.M: train.mass_kg, of_train.g: STANDARD_GRAVITY_MPS2,
        of_train.slope_angle: math.atan(section.slope * SLOPE_UNITS[line.slope_unit])}
    force = of_train.slope_force
    if section.curve_radius_m is not None:  # of any length, the angle over the length is 1/R
        values |= {of_train.centre_angle: math.degrees(1 / section.curve_radius_m), of_train.curve_length: 1.0}
        force += of_train.curve_force
    if section.tunnel_length_m > 0:
        values[of_train.tunnel_length] = section.tunnel_length_m
        force += of_train.tunnel_force
    return float(force.xreplace({symbol: sp.Float(value) for symbol, value in values.items()}))


def line_table(study: LiuStudy) -> ResistanceTable:
    """The additional resistance by position, N per kg of mass M."""
    edges, values = [0.0], [0.0]
    for section in study.line.sections:
        edges += [section.from_m, section.to_m]
        values += [section_force(section, study.line, study.train) / study.train.mass_kg, 0.0]
    keep = [i for i, edge in enumerate(edges) if i + 1 == len(edges) or edges[i + 1] > edge]
    return ResistanceTable(np.array([edges[i] for i in keep]), np.array([values[i] for i in keep]))


def rates(study: LiuStudy) -> tuple[float, float]:
    """Acceleration and braking rate of the reference, m/s^2: (9) at the ends of the input's range."""
    ref, train = study.reference, study.train
    highest = _newton(ref.highest_input_n, davis_at(train, ref.cruise_mps), 0.0, train.chi, train.mass_kg)
    lowest = _newton(ref.lowest_input_n, davis_at(train, 0.0), 0.0, train.chi, train.mass_kg)
    return float(highest), -float(lowest)


def desired_curve(study: LiuStudy) -> DesiredCurve:
    """The reference; raises WorkbenchError when the line is too short for it."""
    acceleration, braking = rates(study)
    return start_cruise_stop(study.line.length_m, study.reference.cruise_mps, acceleration, braking,
                             study.reference.ramp_s)


def disturbance_rows(study: LiuStudy, name: str) -> Array:
    """The disturbance as the kernel reads it: the part -(M/chi) d of `opposing_force`, per kg of mass M."""
    push, train = study.disturbances[name], study.train
    force = _opposing(0.0, push.largest_n / train.mass_kg, train.chi, train.mass_kg)
    row = [push.from_s, math.inf, 0.0, force / train.mass_kg, push.omega_rad_s, push.phase_rad, 0.0]
    return np.array([row] if force else []).reshape(-1, 7)


def setting_of(study: LiuStudy, disturbance: str) -> Setting:
    """What the runs happen in. The paper names no limits of force, so there are none."""
    curve, train, sampling = desired_curve(study), study.train, study.sampling
    return Setting(
        curve=curve, mass_kg=train.mass_kg, nominal_mass_kg=train.mass_kg, davis_n=davis_newton(train),
        plant_step_s=sampling.period_s, end_s=curve.trip_time_s, log_every_s=sampling.log_every_s,
        position_band_m=math.inf, line=line_table(study), terms=disturbance_rows(study, disturbance),
        plant_values=(train.chi,))


def centers(study: LiuStudy) -> Array:
    """Centres of both networks on the study's desired curve."""
    return centers_along(desired_curve(study), scales(study), study.networks.neurons)


def centers_along(curve: DesiredCurve, scale: Mapping[str, float], neurons: int) -> Array:
    """Centres of both networks, shape (3 + 6, neurons): z_1 and z_2 on a desired curve, evenly in position; u = 0."""
    time = np.linspace(0.0, curve.trip_time_s, 100_001)
    position, speed, acceleration = curve.at(time)
    wanted = np.linspace(0.0, curve.length_m, neurons)
    index = np.clip(np.searchsorted(position, wanted - 1e-9 * curve.length_m), 0, len(time) - 1)
    s, v, a = wanted / scale["s_scale"], speed[index] / scale["v_scale"], acceleration[index] / scale["a_scale"]
    return np.array([s, v, np.zeros_like(s), s, v, v, s, v, a])


def scales(study: LiuStudy) -> dict[str, float]:
    """What makes the networks' inputs of order one: line length, cruise speed, starting rate, highest input."""
    return {"s_scale": study.line.length_m, "v_scale": study.reference.cruise_mps, "a_scale": rates(study)[0],
            "u_scale": study.reference.highest_input_n}


def law_values(study: LiuStudy, law: ControlLaw, column: int,
               leak_rate_per_s: float | None = None) -> tuple[Array, Array, Array, Array]:
    """Parameters, initial scalar states, initial weights and centres of a law for a column of Table 2."""
    adapt, start = study.adaptation, study.start
    leak = adapt.leak_rate_per_s if leak_rate_per_s is None else leak_rate_per_s
    given: dict[str, float] = {name: getattr(study.gains, name)[column - 1] for name in FEEDBACK_GAINS}
    given |= scales(study) | {
        "M": study.train.mass_kg, "tau": study.sampling.speed_filter_s, "b_h": study.networks.width,
        "Gamma_f": adapt.gamma_f_per_s2, "alpha_1": adapt.alpha_1_per_s2, "kappa_1": adapt.kappa_1_mps,
        "Gamma_v": adapt.gamma_v_n_per_m, "alpha_2": adapt.alpha_2_n_per_m, "kappa_2": adapt.kappa_2_mps,
        "sigma_f": leak / adapt.gamma_f_per_s2, "beta_1": leak / adapt.alpha_1_per_s2,
        "sigma_v": leak / adapt.gamma_v_n_per_m, "beta_2": leak / adapt.alpha_2_n_per_m,
        "W_f_prior": start.weights, "W_v_prior": start.weights, "delta_0": start.robust, "theta_0": start.robust,
    }
    shifted = start.v_hat_mps + given["k_3"] * start.s_hat_m  # xi of claim 12.glyph with the train at position 0
    first = {"s_hat": start.s_hat_m, "v_hat": start.v_hat_mps, "xi": shifted, "s_tilde": start.s_hat_m,
             "v_tilde": start.v_hat_mps, "delta_hat": start.robust, "theta_hat": start.robust}
    count = study.networks.neurons if law.neuron_data else 0
    return (np.array([given[str(p)] for p in law.parameters], dtype=float),
            np.array([first.get(str(state.symbol), 0.0) for state in law.scalar_states], dtype=float),
            np.full((len(law.neuron_states), count), start.weights),
            centers(study) if law.neuron_data else np.zeros((0, 0)))


def run_under(law: ControlLaw, study: LiuStudy, column: int, setting: Setting,
              leak_rate_per_s: float | None = None) -> Run:
    """The run of a law with the gains of a column of Table 2, in a setting."""
    return run_law(law, law_values(study, law, column, leak_rate_per_s), setting, study.sampling.period_s, "explicit",
                   plant=of_train.model())

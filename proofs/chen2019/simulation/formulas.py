"""The formulas of chen2019 at the numbers of its study: forces, the energy function (25), errors that alternate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp

from workbench.trains.multi_particle import basic_resistance, coefficients, f_a, first, m, v

from .. import laws as law
from .cars_trials import Array, CarsRun
from .plans import law_values

if TYPE_CHECKING:
    from ..study.record import ChenStudy


def needed_force(study: ChenStudy, speed_mps: float, acceleration_mps2: float) -> float:
    """The force, N, that a train on level track needs of all its cars; the couplers cancel."""
    values = law_values(study)
    put = {symbol: sp.Float(values[str(symbol)]) for symbol in coefficients}
    mass, count = study.train.car_mass_kg, study.train.cars
    resistance = sum((basic_resistance(mass, speed_mps, mass * count if car == 0 else sp.Integer(0)).xreplace(put)
                      for car in range(count)), sp.Integer(0))
    return count * mass * acceleration_mps2 - float(resistance)


def trailer_force(study: ChenStudy, speed_mps: float, acceleration_mps2: float) -> float:
    """The force, N, that a trailer needs from its couplers on level track."""
    values = law_values(study)
    resistance = basic_resistance(study.train.car_mass_kg, speed_mps).xreplace(
        {symbol: sp.Float(values[str(symbol)]) for symbol in coefficients})
    return study.train.car_mass_kg * acceleration_mps2 - float(resistance)


def first_cef(study: ChenStudy) -> float:
    """(25) before the first trial, at T, on level track with constant coefficients: all initial estimates, z = 0."""
    values: dict[sp.Basic, sp.Expr] = {symbol: sp.Float(law_values(study)[str(symbol)]) for symbol in law.VALUES}
    initial = (sp.Integer(0), sp.Integer(0), sp.Float(study.mass_bounds.low_kg))
    of_car, shared = law.energy_density(initial, (sp.Integer(0),) * 3)
    values |= {m: sp.Float(study.train.car_mass_kg), f_a: sp.Integer(0)}
    density = study.train.cars * float(of_car.xreplace(values)) + float(shared.xreplace(values))
    return density * study.reference.trip_time_s


def cef_change(run: CarsRun) -> Array:
    """E_i - E_{i-1} at T of (26), trial by trial; before the first one z was zero."""
    v_end = run.total("v_end")
    return np.asarray(run.total("cef_change") + v_end - np.concatenate([[0.0], v_end[:-1]]))


def allowed_change(study: ChenStudy, run: CarsRun) -> Array:
    """The right side of (35) at T, trial by trial."""
    return np.asarray(-study.gains.c_1 * run.total("z_1_square_s") - study.gains.c_2 * run.total("z_2_square_s"))


def alternating_growth(study: ChenStudy, speed_mps: float) -> tuple[float, float]:
    """By how much, at most, an error of the saturated first car that alternates from sample to sample grows in a trial.

    For both memory rules, same sample first. While u is at its limit, lambda_2(k+1) = q lambda_2(k) + g Delta_u(k) by
    (9), mu answers to lambda_2 with K, and to what was learned in the trials before, so that with z_2 alternating
    z_2 of the next trial is (1 + q)/|1 + q - g K| and |1 + q - 2 g K|/|1 + q - g K| times that of this one.
    """
    rate = law.auxiliary[law.lambda_2]
    values: dict[sp.Basic, sp.Expr] = {symbol: sp.Float(law_values(study)[str(symbol)]) for symbol in law.VALUES}
    decay = float(sp.diff(rate, law.lambda_2).xreplace(values))
    q = math.exp(decay * study.sampling.period_s)
    g = (q - 1) / decay * float(sp.diff(rate, law.Delta_u).xreplace(values))
    answer = float(law.answer_to_lambda().xreplace(values | {v: sp.Float(speed_mps), first: sp.Integer(1)}))
    left = abs(1 + q - g * answer)
    return (1 + q) / left, abs(1 + q - 2 * g * answer) / left

"""What the runs of chen2019 gave, and what of it counts as learning."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import sympy as sp

from workbench.trains.multi_particle import basic_resistance, coefficients, f_a, first, m, v

from .. import laws as law
from ..simulation.cars_trials import Array, CarsRun
from .record import Change, ChenStudy
from .runs import STATED, CostPoint, law_values

# By what factor the largest error has to come back to be said to grow again.
AGAIN = 1.02
# How near to the reference a car is said to be on it.
NEAR_M, NEAR_MPS = 1.0, 0.1


@dataclass(frozen=True)
class Found:
    """The study and its runs; `runs` by the number of the change, cost by the length of the train."""

    study: ChenStudy
    runs: Mapping[int, CarsRun]
    cost: tuple[CostPoint, ...]

    @property
    def stated(self) -> CarsRun:
        """The run as stated."""
        return self.runs[STATED]

    def group(self, name: str) -> list[tuple[Change, CarsRun]]:
        """The runs of a group of changes."""
        return [(change, self.runs[i]) for i, change in enumerate(self.study.changes) if change.group == name]

    def find(self, **values: object) -> CarsRun | None:
        """The run with exactly these values changed (dots as double underscores), if the study has it."""
        wanted = {key.replace("__", "."): value for key, value in values.items()}
        return next((self.runs[i] for i, change in enumerate(self.study.changes) if change.set == wanted), None)

    @property
    def motors_and_trailers(self) -> tuple[list[int], list[int]]:
        """Motor cars and trailers, counted from 0."""
        motors = [car for car in range(self.study.train.cars) if self.study.train.has_motor(car)]
        return motors, [car for car in range(self.study.train.cars) if car not in motors]


def position_error(run: CarsRun) -> Array:
    """Largest position error of all cars, trial by trial, m."""
    return np.maximum(-run.of_cars("position_error_min"), run.of_cars("position_error_max")).max(axis=1)


def speed_error(run: CarsRun) -> Array:
    """Largest speed error of all cars, trial by trial, m/s."""
    return np.maximum(-run.of_cars("speed_error_min"), run.of_cars("speed_error_max")).max(axis=1)


def difference(run: CarsRun) -> Array:
    """Largest |Delta u| of all cars, trial by trial, N."""
    return run.of_cars("difference_max").max(axis=1)


def grows_from(errors: Array) -> int | None:
    """The trial with the least error, when it came back by more than AGAIN until the last one; else None."""
    if len(errors) == 0 or not errors[-1] > AGAIN * errors.min():
        return None
    return int(np.argmin(errors)) + 1


def rises(errors: Array) -> int:
    """In how many trials an error is larger than in the one before."""
    return int(np.sum(np.diff(errors) > 0))


def outcome(run: CarsRun) -> str:
    """What became of a run, in a few words."""
    if run.failed is not None:
        why = "no unique acceleration" if "unique" in run.failed else "diverges"
        return f"trial {len(run.totals) + 1}: {why}"
    turns = [turn for turn in (grows_from(position_error(run)), grows_from(speed_error(run)),
                               grows_from(difference(run))) if turn is not None]
    if turns:
        return f"grows again from trial {min(turns)} on"
    return "falls" if rises(position_error(run)) + rises(speed_error(run)) == 0 else "falls, not in every trial"


def largest_speed_error_at(found: Found, trial: int) -> tuple[float, float]:
    """Time (s) of the largest speed error of a logged trial, and the acceleration (m/s^2) of the reference then."""
    errors = np.abs(found.stated.log(trial, "speed_error_mps")).max(axis=1)
    time_s = float(np.argmax(errors)) * found.study.sampling.log_every_s
    return time_s, float(found.study.reference.curve().at(np.array([time_s]))[2][0])


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


def exponent(points: tuple[CostPoint, ...]) -> float:
    """The power of the number of cars with which the time of a sample grows, by least squares of the logarithms."""
    return float(np.polyfit(np.log([p.cars for p in points]), np.log([p.step_us for p in points]), 1)[0])

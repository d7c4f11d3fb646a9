"""yang2021: the numbers of Table 1 and of section 6, exactly as study.toml states them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import sympy as sp

from workbench.model.desired_curve import DavisCruise, davis_cruise_speed
from workbench.trains.line_resistance import (
    additional_specific_resistance,
    curvature_per_m,
    grade_permille,
    tunnel_n_per_kn,
)
from workbench.trains.scenario import load_scenario

from .error_dynamics import lambdas, sigmas, stars
from .laws import alpha, beta, chi, k

scenario = load_scenario(Path(__file__).with_name("study.toml"))
assert isinstance(scenario.reference, DavisCruise)


def rational(value: float) -> Fraction:
    """A stated decimal as the exact number that is printed."""
    return Fraction(str(value))


stated_davis = {s: rational(value) for s, value in zip(
    stars, (scenario.train.davis_a_mps2, scenario.train.davis_b_per_s, scenario.train.davis_c_per_m), strict=True)}
cruise = davis_cruise_speed(scenario.reference.cruise_mps2, *(float(stated_davis[s]) for s in stars))  # m/s
stated_k = rational(scenario.controllers["rbfnn_pocrac"].parameters["k"])
stated_gains = {s: rational(scenario.controllers["rbfnn_pocrac"].parameters[str(s)])
                for s in (alpha, beta, chi, k, *lambdas, *sigmas)}


def section_grades() -> list[Fraction]:
    """Slope (per mille) of the sections of Table 1 in their order, exact."""
    return [rational(_grade_at(border)) for border in _borders()]


def _borders() -> list[float]:
    return sorted({s.start_m for s in (*scenario.track.grade, *scenario.track.curve)})


def _grade_at(position: float) -> float:
    return next(s.grade_permille for s in scenario.track.grade if s.start_m <= position < s.end_m)


def section_resistances() -> list[Fraction]:
    """Additional resistance (N per kg) of the sections of Table 1 in their order, exact."""
    def at(position: float) -> Fraction:
        grade = _grade_at(position)
        radius = next(s.radius_m for s in scenario.track.curve if s.start_m <= position < s.end_m)
        value = additional_specific_resistance().subs({
            grade_permille: sp.Rational(str(grade)), curvature_per_m: 1 / sp.Rational(str(radius)),
            tunnel_n_per_kn: 0})
        return Fraction(int(value.p), int(value.q))

    return [at(border) for border in _borders()]


def largest_jump() -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
    """Resistance and slope just before and after the border with the largest jump of the resistance in Table 1."""
    return max(pairwise(zip(section_resistances(), section_grades(), strict=True)),
               key=lambda pair: abs(pair[0][0] - pair[1][0]))


(before_jump, grade_before), (after_jump, grade_after) = largest_jump()
least_error = abs(after_jump - before_jump) / 2  # (7.error)

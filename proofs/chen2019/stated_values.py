"""The numbers of section IV and of Table 1, exactly as study.toml states them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import sympy as sp

from workbench.files.toml import read_toml
from workbench.proof.printed_values import exact_decimal
from workbench.trains.multi_particle import c_0, c_a, c_d, c_k, c_v

from .laws import gains, learning_gains

stated = read_toml(Path(__file__).with_name("study.toml"))
train = stated["train"]
stated_gains = {symbol: exact_decimal(stated["gains"][str(symbol)]) for symbol in gains}
at_stated = {symbol: sp.Rational(x.numerator, x.denominator) for symbol, x in stated_gains.items()}
stated_learning = {symbol: exact_decimal(stated["gains"][str(symbol)]) for symbol in learning_gains}

table_1: dict[sp.Symbol, Fraction] = {symbol: exact_decimal(train[key]) for symbol, key in (
    (c_0, "c_0_n_per_kg"), (c_v, "c_v_n_s_per_m_kg"), (c_a, "c_a_n_s2_per_m2_kg"), (c_k, "coupler_n_per_m"),
    (c_d, "coupler_n_s_per_m"))}
mass_stated, limit_stated = exact_decimal(train["car_mass_kg"]), exact_decimal(train["traction_n"])
cruise_stated = exact_decimal(stated["reference"]["cruise_mps"])
pattern = train["motor_pattern"]
MOTOR_CARS = tuple(car for car in range(1, train["cars"] + 1) if pattern[(car - 1) % len(pattern)] == "1")

"""A run of chen2019's study as a plan: its train, reference, law and rules of sampling, with what the study states."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from workbench.trains.multi_particle import coefficients

from .. import laws as law
from .cars_trials import Array, CarsPlan

if TYPE_CHECKING:
    from ..study.record import ChenStudy


def car_data(study: ChenStudy) -> Array:
    """Rows by CAR_DATA, shape (6, cars): masses, which is first, limits (4), (5) and bounds (Assumption 1)."""
    train = study.train
    rows = {law.m: [train.car_mass_kg] * train.cars, law.first: [1.0] + [0.0] * (train.cars - 1),
            law.u_low: [-train.braking_n] * train.cars,
            law.u_high: [train.traction_n if train.has_motor(car) else 0.0 for car in range(train.cars)],
            law.m_low: [study.mass_bounds.low_kg] * train.cars, law.m_high: [study.mass_bounds.high_kg] * train.cars}
    return np.array([rows[row] for row in law.CAR_DATA])


def law_values(study: ChenStudy) -> dict[str, float]:
    """The numbers of `laws.VALUES` by name."""
    train = study.train
    table_1 = (train.c_0_n_per_kg, train.c_v_n_s_per_m_kg, train.c_a_n_s2_per_m2_kg, train.coupler_n_per_m,
               train.coupler_n_s_per_m)
    values = {str(symbol): value for symbol, value in zip(coefficients, table_1, strict=True)}
    gains = {str(symbol): float(getattr(study.gains, str(symbol))) for symbol in (*law.gains, *law.learning_gains)}
    return values | gains | {"m_total": train.cars * train.car_mass_kg, "T_s": study.sampling.period_s,
                             "tau": study.sampling.filter_s}


def plan(study: ChenStudy) -> CarsPlan:
    """The plan of a study's stated run."""
    sampling, line = study.sampling, study.line
    times: Array = np.arange(study.samples, dtype=float) * sampling.period_s
    return CarsPlan(
        acceleration=sampling.acceleration, memory=sampling.memory, slope=line.seen_by,
        reference=np.stack(study.reference.curve().at(times), axis=1), period_s=sampling.period_s,
        cars=car_data(study), values=law_values(study),
        slope_values={"grade": line.slope_permille / 1000, "wave": line.wave_m, "g": line.gravity_mps2},
        variation={"swing": study.variation.swing, "beat": study.variation.beat_s},
        start=(study.trials.lambda_1_m, study.trials.lambda_2_mps), trials=study.trials.count,
        kept=study.trials.shown, log_every=round(sampling.log_every_s / sampling.period_s))

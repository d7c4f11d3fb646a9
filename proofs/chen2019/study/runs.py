"""chen2019's runs: the stated one, its changes and the longer trains as plans, and each as numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from workbench.trains.multi_particle import coefficients

from .. import laws as law
from ..simulation.cars_trials import Array, CarsPlan, CarsRun, run_cars
from .record import ChenStudy, with_change

# The change of the study with this number; the stated run has none.
STATED = -1


@dataclass(frozen=True)
class CostPoint:
    """What a sample of a train costs: cars, time of a sample and of a sample and car (microseconds)."""

    cars: int
    step_us: float

    @property
    def car_us(self) -> float:
        """Time of a sample and car."""
        return self.step_us / self.cars


def changed(study: ChenStudy, number: int) -> ChenStudy:
    """The study of a run."""
    return study if number == STATED else with_change(study, study.changes[number])


def title(study: ChenStudy, number: int) -> str:
    """A run in words."""
    return "as stated" if number == STATED else study.changes[number].title


def reference(study: ChenStudy) -> Array:
    """Position (m), speed (m/s) and acceleration (m/s^2) of every sample, shape (samples, 3)."""
    times: Array = np.arange(study.samples, dtype=float) * study.sampling.period_s
    return np.stack(study.reference.curve().at(times), axis=1)


def car_data(study: ChenStudy) -> Array:
    """Rows by CAR_DATA, shape (6, cars): masses, which is first, limits (4), (5) and bounds (Assumption 1)."""
    train = study.train
    rows = {law.m: [train.car_mass_kg] * train.cars, law.first: [1.0] + [0.0] * (train.cars - 1),
            law.u_low: [-train.braking_n] * train.cars,
            law.u_high: [train.traction_n if train.has_motor(car) else 0.0 for car in range(train.cars)],
            law.m_low: [study.mass_bounds.low_kg] * train.cars, law.m_high: [study.mass_bounds.high_kg] * train.cars}
    return np.array([rows[row] for row in law.CAR_DATA])


def law_values(study: ChenStudy) -> dict[str, float]:
    """The numbers of `controllers.chen2019.VALUES` by name."""
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
    return CarsPlan(
        acceleration=sampling.acceleration, memory=sampling.memory, slope=line.seen_by, reference=reference(study),
        period_s=sampling.period_s, cars=car_data(study), values=law_values(study),
        slope_values={"grade": line.slope_permille / 1000, "wave": line.wave_m, "g": line.gravity_mps2},
        variation={"swing": study.variation.swing, "beat": study.variation.beat_s},
        start=(study.trials.lambda_1_m, study.trials.lambda_2_mps), trials=study.trials.count,
        kept=study.trials.shown, log_every=round(sampling.log_every_s / sampling.period_s))


def run_number(study: ChenStudy, number: int) -> tuple[int, CarsRun]:
    """Run the stated study or one of its changes; those about what else is assumed leave no log."""
    made = plan(changed(study, number))
    logged = number == STATED or study.changes[number].group == "rules"
    return number, run_cars(made if logged else replace(made, kept=()))


def cost(study: ChenStudy) -> tuple[CostPoint, ...]:
    """Time per sample of trains of several lengths, one after the other in this process."""
    points = []
    for cars in study.cost.cars:
        longer = study.model_copy(update={"train": study.train.model_copy(update={"cars": cars})})
        whole = plan(longer)
        short = replace(whole, reference=whole.reference[: round(study.cost.end_s / study.sampling.period_s)],
                        trials=study.cost.trials, kept=())
        points.append(CostPoint(cars, float(run_cars(short).step_us.min())))
    return tuple(points)

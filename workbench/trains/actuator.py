"""What lies between a command and the force at the rail: a delay, a lag, limits of the force's rate, adhesion.

In this order, at every plant step: the command reaches the drive `delay_s` late; the drive asks for no more than its
traction, braking and power limits at the present speed; its force follows with a lag, no faster than its rates allow;
the rail takes no more than the power limit and the adhesion of the driven wheels. What the rail does not take is gone,
so that nothing winds up. The force within a step is integrated exactly (`actuator_loop.force_after_lag`); its mean
drives the train over the step and does the work.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, Strict, model_validator

from workbench.files.toml import Positive, SourcedRecord
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2

Array = NDArray[np.float64]

# Beyond this no drive answers.
Seconds = Annotated[float, Strict(), Field(ge=0, le=60, allow_inf_nan=False)]
Share = Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]
Coefficient = Annotated[float, Strict(), Field(ge=0, le=1, allow_inf_nan=False)]


class Adhesion(SourcedRecord):
    """The largest force between wheel and rail: factor (decay_kmh / (v + offset_kmh) + floor) of the driven weight.

    The numbers are those of Curtius and Kniffler for a dry rail (Elektrische Bahnen, 1944; also what Open Rails
    computes slip with) unless others are stated; v in km/h. factor: what a wet or
    dirty rail leaves of it; adhesive_share: of the train's mass that stands on driven wheels, and for braking alike.
    Raises ValueError (through validation) for a coefficient above 1 at a standstill.
    """

    factor: Share = 1.0
    adhesive_share: Share = 1.0
    decay_kmh: Annotated[float, Strict(), Field(ge=0, le=1000, allow_inf_nan=False)] = 7.5
    offset_kmh: Positive = 44.0
    floor: Coefficient = 0.161

    @model_validator(mode="after")
    def _plausible(self) -> Self:
        most = float(self.coefficient(0.0))
        if not 0 < most <= 1:
            raise ValueError(f"a coefficient of {most:g} at a standstill is outside 0 to 1: correct factor, decay_kmh, "
                             "offset_kmh or floor")
        return self

    def coefficient(self, speed_mps: float | Array) -> float | Array:
        """The adhesion coefficient at a speed."""
        return self.factor * (self.decay_kmh / (3.6 * np.abs(speed_mps) + self.offset_kmh) + self.floor)


class Actuator(SourcedRecord):
    """Between command and force; what is not stated is not there.

    rise_n_per_s, fall_n_per_s: how fast the force can change towards traction and towards braking.
    """

    lag_s: Seconds = 0.0
    delay_s: Seconds = 0.0
    rise_n_per_s: Positive | None = None
    fall_n_per_s: Positive | None = None
    adhesion: Adhesion | None = None

    def delay_steps(self, plant_step_s: float) -> int:
        """The delay in plant steps; ValueError for one that is no whole number of them."""
        steps = self.delay_s / plant_step_s
        if abs(steps - round(steps)) > 1e-6:
            raise ValueError(f"delay_s = {self.delay_s:g} is not a whole number of plant steps of {plant_step_s:g} s: "
                             "choose a multiple")
        return round(steps)


# Layout of the array that the compiled loop reads and writes: the train's limits, which stand there without an
# actuator too, and then these, before the commands under way.
LIMITS = ("traction_n", "braking_n", "power_w")
LAYOUT = (*LIMITS, "lag_s", "delay_steps", "rise_n_per_s", "fall_n_per_s", "adhesion_decay_n_kmh",
          "adhesion_offset_kmh", "adhesion_floor_n", "force_n", "rate_limited_steps", "adhesion_limited_steps",
          "predicts", "believed_force_n", "nominal_mass_kg", "davis_a_n", "davis_b_n", "davis_c_n")
COUNTED = ("rate_limited_steps", "adhesion_limited_steps")


@dataclass(frozen=True)
class Known:
    """The train as its controller knows it, for a predictor: mass (kg) and Davis coefficients (N, N s/m, N s^2/m^2)."""

    mass_kg: float
    davis_n: tuple[float, float, float]


def drive(limits: tuple[float, float, float], actuator: Actuator | None, plant_step_s: float, mass_kg: float,
          known: Known | None = None) -> Array:
    """The array of one run, at rest; of the limits alone where there is no actuator.

    mass_kg: the true mass, whose weight gives the adhesion; known: of a law whose state is predicted over the delay.
    """
    if actuator is None:
        return np.array(limits)
    grip, steps = actuator.adhesion, actuator.delay_steps(plant_step_s)
    weight = grip.factor * grip.adhesive_share * mass_kg * STANDARD_GRAVITY_MPS2 if grip else np.inf
    values = dict(zip(LIMITS, limits, strict=True)) | {
        "lag_s": actuator.lag_s, "delay_steps": steps,
        "rise_n_per_s": actuator.rise_n_per_s or np.inf, "fall_n_per_s": actuator.fall_n_per_s or np.inf,
        "adhesion_decay_n_kmh": weight * grip.decay_kmh if grip else 0.0,
        "adhesion_offset_kmh": grip.offset_kmh if grip else 1.0,
        "adhesion_floor_n": weight * grip.floor if grip else np.inf}
    if known is not None:
        values |= {"predicts": 1.0, "nominal_mass_kg": known.mass_kg} | dict(
            zip(LAYOUT[-3:], known.davis_n, strict=True))
    return np.concatenate(([values.get(name, 0.0) for name in LAYOUT], np.zeros(steps)))


def drive_totals(values: Array) -> dict[str, float]:
    """What a run counted: plant steps at a limit of the rate and of the adhesion; none without an actuator."""
    if len(values) == len(LIMITS):
        return dict.fromkeys(COUNTED, 0.0)
    return {name: float(values[LAYOUT.index(name)]) for name in COUNTED}

"""A train as files state it: mass, resistance and limits, checked for plausibility."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import Positive, SourcedRecord

DavisCoefficient = Annotated[float, Strict(), Field(ge=0, allow_inf_nan=False)]
SLOW_MPS, RESISTS_MPS2 = 10.0, 10.0  # a train that resists with more at that speed has its coefficients in another unit


class Train(SourcedRecord):
    """A single-particle train: mass, Davis coefficients per unit of mass, traction and brake limits.

    length_m: over which the line's resistance is averaged, behind the front, whose position is the train's; a train
    without one is a point, to which every edge of a grade is a step of the force.
    Raises ValueError (through validation) for implausible values, which are mostly wrong units.
    """

    mass_kg: Annotated[float, Strict(), Field(gt=0, allow_inf_nan=False)]
    davis_a_mps2: DavisCoefficient
    davis_b_per_s: DavisCoefficient
    davis_c_per_m: DavisCoefficient
    max_traction_n: Positive
    max_braking_n: Positive
    max_power_w: Positive | None = None
    length_m: Positive | None = None

    @model_validator(mode="after")
    def _plausible(self) -> Self:
        if not 1e3 <= self.mass_kg <= 1e8:
            raise ValueError(f"mass_kg = {self.mass_kg:g} is no train between 1e3 and 1e8 kg: "
                             f"is it in tonnes?")
        for name in ("max_traction_n", "max_braking_n"):
            specific = getattr(self, name) / self.mass_kg
            if not 0.01 <= specific <= 20:
                raise ValueError(f"{name} gives {specific:g} m/s^2 for this mass, outside 0.01 to 20: "
                                 f"is it in kN?")
        a, b, c = self.davis_a_mps2, self.davis_b_per_s, self.davis_c_per_m
        resists = a + b * SLOW_MPS + c * SLOW_MPS**2
        if resists > RESISTS_MPS2:
            raise ValueError(f"davis_a_mps2, davis_b_per_s and davis_c_per_m give {resists:.3g} m/s^2 at "
                             f"{SLOW_MPS:g} m/s, more than {RESISTS_MPS2:g}: are they in N? They are per unit of mass: "
                             "divide by mass_kg")
        if self.max_power_w is not None and not 0.1 <= self.max_power_w / self.mass_kg <= 1e3:
            raise ValueError(f"max_power_w gives {self.max_power_w / self.mass_kg:g} W/kg for this mass, "
                             f"outside 0.1 to 1000: is it in kW?")
        return self

    @property
    def davis_newton(self) -> tuple[float, float, float]:
        """Davis coefficients (a_0, b_0, c_0) of this train in N, N s/m, N s^2/m^2."""
        return (self.davis_a_mps2 * self.mass_kg, self.davis_b_per_s * self.mass_kg,
                self.davis_c_per_m * self.mass_kg)

"""The [cars] table of a train's TOML file: how many cars, which of them drive, and what ties them together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Self

from pydantic import Field, Strict, model_validator

from workbench.errors import InputError
from workbench.files.toml import SourcedRecord
from workbench.optimal.inputs.line_checks import SHORTEST_TRAIN_M
from workbench.optimal.vehicle import Vehicle

if TYPE_CHECKING:
    from workbench.optimal.cars.car_train import CarTrain

# Beyond it a coupler swings faster than a simulated step of 5 ms can follow: rad/s of two neighbours, and 1/s.
FASTEST_SWING, FASTEST_DAMPING = 100.0, 100.0


class CarsTable(SourcedRecord):
    """Equal cars: together they are the train that the file states, its forces those of all motors and all brakes.

    motor_pattern: 1 for a motor car, 0 for a trailer, repeated along the train.
    """

    count: Annotated[int, Strict(), Field(ge=2, le=256)]
    motor_pattern: Annotated[str, Strict(), Field(pattern=r"^[01]+$", max_length=256)]
    coupler_n_per_m: Annotated[float, Strict(), Field(ge=1e4, le=1e9, allow_inf_nan=False)]
    coupler_n_s_per_m: Annotated[float, Strict(), Field(ge=0, le=1e8, allow_inf_nan=False)]

    @model_validator(mode="after")
    def _has_a_motor(self) -> Self:
        if not any(self.motors):
            raise ValueError(f"motor_pattern = '{self.motor_pattern}' gives {self.count} cars no motor: write a 1 for "
                             "each motor car")
        return self

    @property
    def motors(self) -> tuple[bool, ...]:
        """For each car whether it has a motor."""
        pattern = self.motor_pattern
        return tuple(pattern[car % len(pattern)] == "1" for car in range(self.count))


def car_train(table: CarsTable, vehicle: Vehicle) -> CarTrain:
    """The cars of a vehicle; raises InputError where they are no cars or too stiff to be simulated."""
    from workbench.optimal.cars.car_train import CarTrain  # noqa: PLC0415 - its expressions are sympy's

    found = CarTrain(vehicle, table.motors, table.coupler_n_per_m, table.coupler_n_s_per_m)
    mass, length = found.car_inertia_kg, vehicle.length_m / found.cars
    if not 1e3 <= mass <= 2e5:
        raise InputError("", "cars.count", f"{found.cars} cars of {vehicle.mass_kg:g} kg are {mass:g} kg each, outside "
                         "1e3 to 2e5: correct the number or the mass")
    if vehicle.length_m and length < SHORTEST_TRAIN_M:
        raise InputError("", "cars.count", f"{found.cars} cars of {vehicle.length_m:g} m are {length:g} m each: "
                         "correct the number or the length")
    swing, damping = 2 * (found.coupler_n_per_m / mass) ** 0.5, 4 * found.coupler_n_s_per_m / mass
    if swing > FASTEST_SWING or damping > FASTEST_DAMPING:
        raise InputError("", "cars.coupler_n_per_m", f"these couplers swing with {swing:.3g} rad/s and settle with "
                         f"{damping:.3g}/s, above {FASTEST_SWING:g} and {FASTEST_DAMPING:g}: take softer ones")
    return found


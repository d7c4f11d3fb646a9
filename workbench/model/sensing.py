"""What stands between a train and its controller: noise, an odometer, late measurements, late commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, Strict

from workbench.errors import WorkbenchError
from workbench.files.toml import Lateness, NonNegative, SourcedRecord

Array = NDArray[np.float64]

SpeedFrom = Literal["tachometer", "differences"]
# Wheels wear by some per cent; more is another wheel.
Scale = Annotated[float, Strict(), Field(ge=0.8, le=1.25, allow_inf_nan=False)]


@dataclass(frozen=True)
class Sensing:
    """What stands between train and controller: noise of position and speed, an odometer, late measurements, commands.

    position_noise_m, speed_noise_mps: standard deviations of what is added to each sample, drawn from `seed`; the
    delays are rounded to whole samples. The position is counted in pulses of position_quantum_m (0: none) by wheels
    that turn odometer_scale as far as they should, from the start and from every balise on, which lie balise_spacing_m
    apart (0: none) and tell the truth. The speed is that of the wheels, or with "differences" of the counted position
    over the last period. Raises WorkbenchError for a value that is negative or not finite, or a scale of no wheel.
    """

    position_noise_m: float = 0.0
    speed_noise_mps: float = 0.0
    measurement_delay_s: float = 0.0
    command_delay_s: float = 0.0
    seed: int = 0
    position_quantum_m: float = 0.0
    odometer_scale: float = 1.0
    balise_spacing_m: float = 0.0
    speed_from: SpeedFrom = "tachometer"

    def __post_init__(self) -> None:
        values = (self.position_noise_m, self.speed_noise_mps, self.measurement_delay_s, self.command_delay_s)
        if not all(np.isfinite(value) and value >= 0 for value in values):
            raise WorkbenchError(f"sensing: noise and delays {values} must be zero or positive: correct them")
        lengths = self.position_quantum_m, self.balise_spacing_m
        if not all(np.isfinite(value) and value >= 0 for value in lengths) or not 0.5 < self.odometer_scale < 2:
            raise WorkbenchError(f"sensing: pulses and balises {lengths} must be zero or positive and the odometer's "
                                 f"scale {self.odometer_scale:g} between 0.5 and 2: correct them")

    def arrays(self, samples: int, period_s: float) -> tuple[Array, Array, Array, Array]:
        """Noise, room for late measurements and commands, and the odometer, as the kernel reads them."""
        noise = np.zeros((0, 2))
        if self.position_noise_m or self.speed_noise_mps:
            drawn = np.random.default_rng(self.seed).standard_normal((samples, 2))
            noise = drawn * (self.position_noise_m, self.speed_noise_mps)
        late = [round(delay / period_s) for delay in (self.measurement_delay_s, self.command_delay_s)]
        return noise, np.zeros((late[0] + 1, 2)), np.zeros(late[1] + 1), self._odometer(period_s)

    def _odometer(self, period_s: float) -> Array:
        """Pulse (m), scale, spacing (m), period of differences (s) or 0; then what it remembers; empty without one."""
        differences = period_s if self.speed_from == "differences" else 0.0
        stated = (self.position_quantum_m, self.odometer_scale, self.balise_spacing_m, differences)
        # Balises alone put nothing right that is not wrong.
        return np.array([*stated, 0.0, 0.0, 0.0, 0.0]) if stated[:2] != (0.0, 1.0) or differences else np.zeros(0)


class Instruments(SourcedRecord):
    """`Sensing` as a scenario states it."""

    position_noise_m: NonNegative = 0.0
    speed_noise_mps: NonNegative = 0.0
    measurement_delay_s: Lateness = 0.0
    command_delay_s: Lateness = 0.0
    seed: Annotated[int, Strict(), Field(ge=0)] = 0
    position_quantum_m: NonNegative = 0.0
    odometer_scale: Scale = 1.0
    balise_spacing_m: NonNegative = 0.0
    speed_from: SpeedFrom = "tachometer"

    def sensing(self, scale: float = 1.0) -> Sensing:
        """For a run; scale: how the wheels differ further from what they should be."""
        stated = self.model_dump(exclude={"source"})
        return Sensing(**stated | {"odometer_scale": self.odometer_scale * scale})


PERFECT = Sensing()

"""What stands between a train and its controller: noise, late measurements, late commands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sensing:
    """What stands between train and controller: noise of position and speed, late measurements, late commands.

    position_noise_m, speed_noise_mps: standard deviations of what is added to each sample, drawn from `seed`; the
    delays are rounded to whole samples. Raises WorkbenchError for a value that is negative or not finite.
    """

    position_noise_m: float = 0.0
    speed_noise_mps: float = 0.0
    measurement_delay_s: float = 0.0
    command_delay_s: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        values = (self.position_noise_m, self.speed_noise_mps, self.measurement_delay_s, self.command_delay_s)
        if not all(np.isfinite(value) and value >= 0 for value in values):
            raise WorkbenchError(f"sensing: noise and delays {values} must be zero or positive: correct them")

    def arrays(self, samples: int, period_s: float) -> tuple[Array, Array, Array]:
        """Noise, and room for late measurements and commands, as the kernel reads them."""
        noise = np.zeros((0, 2))
        if self.position_noise_m or self.speed_noise_mps:
            drawn = np.random.default_rng(self.seed).standard_normal((samples, 2))
            noise = drawn * (self.position_noise_m, self.speed_noise_mps)
        late = [round(delay / period_s) for delay in (self.measurement_delay_s, self.command_delay_s)]
        return noise, np.zeros((late[0] + 1, 2)), np.zeros(late[1] + 1)


PERFECT = Sensing()

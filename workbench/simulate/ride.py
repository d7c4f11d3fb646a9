"""How a run feels and what it asks of the train: jerk, comfort, switchings and overspeed, at every plant step.

The compiled loop adds them up in the arrays that are made here. Jerk is the second difference of the speed over plant
steps, so a command that is held between samples shows in it as the steps that it makes. Comfort is the acceleration
weighted by the curve W_d of ISO 2631-1:1997 (horizontal vibration of who sits or stands; EN 12299 uses it for railway
passengers), root mean square over the run: below 0.315 m/s^2 the standard calls it not uncomfortable.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Layout of the array that the compiled loop adds to: these sums, three sections of a filter, counts.
SUMS = ("steps", "last_acceleration_mps2", "jerk_square_sum", "jerk_max_mps3", "force_sign", "force_switchings",
        "overspeed_max_mps", "overspeed_steps", "weighted_square_sum", "limit_section")
FILTERS, COUNTS = slice(10, 31), slice(31, None)
# |jerk| is counted in 64 bins an octave, of equal width within it, from 2^-21 m/s^3 to 2^20.
BINS_AN_OCTAVE, LOWEST_OCTAVE, OCTAVES = 64, -21, 41
# ISO 2631-1 annex A: band limits (Hz) with Butterworth's quality, and W_d's transition (Hz) with its quality.
LOW_HZ, HIGH_HZ, BUTTERWORTH = 0.4, 100.0, 0.5**0.5
TRANSITION_HZ, TRANSITION_QUALITY = 2.0, 0.63
# Above this share of the sampling rate a bilinear transform says nothing of a filter.
HIGHEST_SHARE = 0.45


NO_LIMITS = (np.zeros(1), np.full(1, np.inf))


@dataclass(frozen=True)
class SpeedLimits:
    """A line's speed limits: where each begins (m), and the limit (m/s), inf where there is none."""

    from_m: Array = field(default_factory=lambda: NO_LIMITS[0])
    limit_mps: Array = field(default_factory=lambda: NO_LIMITS[1])


@dataclass(frozen=True)
class Ride:
    """What the compiled loop writes of one run, laid out as above, and the speed limits that it reads."""

    values: Array
    limits: SpeedLimits

    def arrays(self) -> tuple[Array, Array, Array]:
        """In the order in which the compiled loop takes them."""
        return self.values, self.limits.from_m, self.limits.limit_mps

    def totals(self) -> dict[str, float]:
        """What the run came to, by name."""
        found = dict(zip(SUMS, self.values[:len(SUMS)].tolist(), strict=True))
        return {name: found[name] for name in SUMS if name.startswith(("jerk", "force_sw", "over", "weighted"))} | {
            "jerk_p95_mps3": self.percentile(0.95), "jerk_steps": max(0.0, found["steps"] - 1.0)}

    def percentile(self, share: float) -> float:
        """The |jerk| (m/s^3) that a share of the steps stays below, rounded up to the end of its bin (1.6 %)."""
        counts = self.values[COUNTS]
        total = counts.sum()
        if total == 0:
            return 0.0
        index = int(np.searchsorted(np.cumsum(counts), share * total * (1 - 1e-12)))
        octave, place = divmod(index, BINS_AN_OCTAVE)
        edge = 2.0 ** (octave + LOWEST_OCTAVE) * (1 + (place + 1) / BINS_AN_OCTAVE)
        return min(edge, float(self.values[SUMS.index("jerk_max_mps3")]))


def ride(step_s: float, limits: SpeedLimits) -> Ride:
    """An array for a run with plant steps of step_s, nothing added yet."""
    values = np.zeros(COUNTS.start + BINS_AN_OCTAVE * OCTAVES)
    values[FILTERS] = weighting(step_s).ravel()
    return Ride(values, limits)


@lru_cache(maxsize=64)  # the same for all runs of a sweep
def weighting(step_s: float) -> Array:
    """W_d of ISO 2631-1 as second-order sections, each b0 b1 b2 a1 a2 and two states at rest, shape (3, 7).

    A section whose frequency a plant step cannot show is left out: its row passes all. Not to be written to.
    """
    sections = ((LOW_HZ, BUTTERWORTH, (0.0, 0.0, 1.0)), (HIGH_HZ, BUTTERWORTH, (1.0, 0.0, 0.0)),
                (TRANSITION_HZ, TRANSITION_QUALITY, (1.0, 1.0, 0.0)))
    found = np.array([_section(frequency, quality, numerator, step_s) for frequency, quality, numerator in sections])
    found.flags.writeable = False
    return found


def _section(frequency_hz: float, quality: float, numerator: tuple[float, float, float], step_s: float) -> list[float]:
    """(n0 + n1 p + n2 p^2) / (1 + p/Q + p^2) with p = s / (2 pi f), by the bilinear transform that keeps f."""
    if frequency_hz * step_s > HIGHEST_SHARE:
        return [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    k = 1.0 / np.tan(np.pi * frequency_hz * step_s)
    n0, n1, n2 = numerator
    lead = 1.0 + k / quality + k * k
    forward = (n0 + n1 * k + n2 * k * k, 2.0 * n0 - 2.0 * n2 * k * k, n0 - n1 * k + n2 * k * k)
    return [*(value / lead for value in forward), 2.0 * (1.0 - k * k) / lead, (1.0 - k / quality + k * k) / lead,
            0.0, 0.0]

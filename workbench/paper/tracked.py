"""What the runs of controllers along references have in common: errors and energy, in one record."""

from __future__ import annotations

import math
from dataclasses import dataclass

from workbench.model.desired_curve import DesiredCurve
from workbench.simulate.closed_loop import Run


@dataclass(frozen=True)
class Tracked:
    """How a controller follows a reference, its own where rows are None.

    Position errors in m (None where the paper's law tracks speed alone), speed errors in m/s, root mean squares over
    the run and over all cars; energy_j: work of traction at the wheel. Of laws that learn, the last trial counts.
    failed: why the run ended early, else None; its numbers are NaN then.
    """

    paper: str
    controller: str
    trip_time_s: float
    length_m: float
    largest_position_m: float | None
    position_rms_m: float | None
    largest_speed_mps: float
    speed_rms_mps: float
    energy_j: float
    failed: str | None


def of_run(paper: str, run: Run, curve: DesiredCurve, work_unit: float = 1.0) -> Tracked:
    """Of one run along a curve; work_unit: J of the unit in which the run counts work."""
    total, samples = run.totals, max(1.0, run.totals["samples"])
    whole = math.nan if run.failed else 1.0

    def largest(name: str) -> float:
        return max(abs(total[f"{name}_error_min"]), abs(total[f"{name}_error_max"]))

    def rms(name: str) -> float:
        return whole * math.sqrt(total[f"{name}_error_square_sum"] / samples)

    return Tracked(paper, run.controller, curve.trip_time_s, curve.length_m, whole * largest("position"),
                   rms("position"), whole * largest("speed"), rms("speed"),
                   whole * work_unit * total["traction_work_j"], run.failed)

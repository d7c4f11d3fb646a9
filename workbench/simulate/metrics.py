"""A run as numbers: the row that `workbench compare` writes (SI units)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from workbench.simulate.closed_loop import Array, Run
from workbench.trains.scenario import Scenario


@dataclass(frozen=True)
class Metrics:
    """One row of a comparison. Errors are measured minus desired, extrema over every plant step.

    energy_J: traction work at the wheel, braking not recovered; jerk_rms, jerk_p95, jerk_max: of the second difference
    of the speed over plant steps (m/s^3), the 95th percentile up to 1.6 % high; logged_jerk_rms: over rows of
    the log, which misses what happens between them; comfort_rms: acceleration weighted by W_d of ISO 2631-1 (m/s^2);
    command_variation: of the commands, summed, each second (m/s^3); switchings: between traction and braking each
    second; overspeed_max: beyond the line's speed limits (m/s); saturated_fraction: of samples whose force was at a
    limit; rate_limited_fraction, adhesion_limited_fraction: of plant steps at these limits of an actuator;
    limit_violations: plant steps outside the position band; failed: why the run ended early, or None. Of a
    failed run the extrema hold up to its end, and what only a whole run has (RMS, stopping error, energy, ride) is
    NaN, in rows None.
    step_us_median, step_us_p99: of the controller alone, the plant excluded; MPC call by call, a compiled law in
    blocks, asked again at states that its run met; NaN where none was timed.
    """

    controller: str
    period_s: float
    position_error_min: float
    position_error_max: float
    speed_error_min: float
    speed_error_max: float
    position_rms: float
    speed_rms: float
    stopping_error: float
    energy_J: float
    jerk_rms: float
    jerk_p95: float
    jerk_max: float
    logged_jerk_rms: float
    comfort_rms: float
    command_variation: float
    switchings: float
    overspeed_max: float
    saturated_fraction: float
    rate_limited_fraction: float
    adhesion_limited_fraction: float
    limit_violations: int
    step_us_median: float
    step_us_p99: float
    deadline_misses: int
    failed: str | None
    command_max: float
    command_min: float
    speed_min: float
    time_of_max_position_error: float
    counters: dict[str, int]

    @property
    def largest_position_error(self) -> float:
        """Largest |position error|, m."""
        return max(abs(self.position_error_min), abs(self.position_error_max))

    def row(self) -> dict[str, object]:
        """The row as plain data; numbers of a run that failed before its first sample are None."""
        return finite(vars(self))


def finite(row: Mapping[str, object]) -> dict[str, object]:
    """A row with None for each number that is none."""
    return {key: None if isinstance(value, float) and not np.isfinite(value) else value for key, value in row.items()}


def rms(values: Array) -> float:
    """The root mean square of values, of which there is at least one."""
    return float(np.sqrt(np.mean(values**2)))


def measure(run: Run, scenario: Scenario) -> Metrics:
    """The metrics of a scenario's run."""
    return measure_run(run, scenario.track.length_m)


def measure_run(run: Run, length_m: float) -> Metrics:
    """The metrics of a run that should end after length_m."""
    total = run.totals
    whole = np.nan if run.failed else 1.0  # what only makes sense for a whole run is no number for a failed one
    samples = max(1.0, total["samples"])
    seconds = max(run.end_s, run.period_s)
    step_us_median, step_us_p99 = (np.percentile(run.step_us, (50, 99)).tolist() if len(run.step_us)
                                   else (float("nan"), float("nan")))
    # The log's rows are a whole number of plant steps apart, which log_every_s need not be.
    logged_jerk = np.diff(run.column("v_mps"), 2) / np.diff(run.column("t_s")[:2]) ** 2
    return Metrics(
        controller=run.controller, period_s=run.period_s,
        position_error_min=total["position_error_min"], position_error_max=total["position_error_max"],
        speed_error_min=total["speed_error_min"], speed_error_max=total["speed_error_max"],
        position_rms=whole * float(np.sqrt(total["position_error_square_sum"] / samples)),
        speed_rms=whole * float(np.sqrt(total["speed_error_square_sum"] / samples)),
        stopping_error=whole * (run.final_position_m - length_m),
        energy_J=whole * total["traction_work_j"],
        jerk_rms=whole * float(np.sqrt(total["jerk_square_sum"] / max(1.0, total["jerk_steps"]))),
        jerk_p95=whole * total["jerk_p95_mps3"], jerk_max=whole * total["jerk_max_mps3"],
        logged_jerk_rms=whole * (rms(logged_jerk) if len(logged_jerk) else 0.0),
        comfort_rms=whole * float(np.sqrt(total["weighted_square_sum"] / samples)),
        command_variation=whole * total["command_variation_mps2"] / seconds,
        switchings=whole * total["force_switchings"] / seconds, overspeed_max=whole * total["overspeed_max_mps"],
        saturated_fraction=total["saturated_samples"] / max(1.0, total["commands"]),
        rate_limited_fraction=total["rate_limited_steps"] / samples,
        adhesion_limited_fraction=total["adhesion_limited_steps"] / samples,
        limit_violations=int(total["band_violations"]),
        step_us_median=step_us_median, step_us_p99=step_us_p99,
        deadline_misses=int(np.sum(run.step_us > run.period_s * 1e6)),
        failed=run.failed, command_max=total["command_max_mps2"], command_min=total["command_min_mps2"],
        speed_min=total["speed_min_mps"], time_of_max_position_error=total["time_of_max_position_error_s"],
        counters=run.counters,
    )

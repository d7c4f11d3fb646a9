"""The JSON documents of optimal runs: what `workbench reference` writes. The types hold the functions that write them;
their schemas are made from them. SI units."""

from __future__ import annotations

from typing import Any, Literal, NotRequired

from typing_extensions import TypedDict


class SimulatedRun(TypedDict):
    """What a simulation of the run's force over time gave, held to its plan by a weak correction."""

    energy_J: float
    position_drift_m: float
    speed_drift_mps: float
    correction_N: float
    force_excess: float
    speed_excess_mps: float


class TimingRow(TypedDict):
    """An event of the timetable: its window, when and how fast the run meets it, and what binds at which price.

    price_W: joules that a second of room would save; limits that are not there are null.
    """

    position_m: float
    kind: str
    earliest_s: float | None
    latest_s: float | None
    slowest_mps: float
    fastest_mps: float | None
    dwell_s: float
    time_s: float
    simulated_time_s: float
    speed_mps: float
    smooth_time_s: float | None
    binds: Literal["latest", "earliest"] | None
    price_W: float


class SmoothDocument(TypedDict):
    """The smooth run, whose rows are the CSV file: acceleration averaged over window_s.

    usable_traction, usable_brakes: shares of the forces that its plan uses; gap: above the bound of all runs.
    """

    energy_J: float
    trip_time_s: float
    window_s: float
    max_jerk_mps3: float
    force_excess: float
    speed_excess_mps: float
    departure_s: float
    window_miss_s: float
    lower_bound_J: float
    gap: float
    usable_traction: float
    usable_brakes: float
    energy_without_reserve_J: float
    simulated_energy_J: NotRequired[float]
    position_drift_m: NotRequired[float]
    speed_drift_mps: NotRequired[float]
    correction_N: NotRequired[float]


class CertifiedRun(TypedDict):
    """The run that the bound is proved for: constant acceleration from row to row over position.

    profile: its rows by column; csv: the file that has them with every bit.
    """

    what: str
    energy_J: float
    lower_bound_J: float
    gap: float
    simulated_energy_J: float
    position_drift_m: float
    speed_drift_mps: float
    correction_N: float
    force_excess: float
    csv: str | None
    profile: dict[str, list[float]]


class ReferenceDocument(TypedDict):
    """What `workbench reference --json` writes: energy, proven bound, and the runs.

    gap: energy above the bound, as a share; trip_time_s and least_trip_time_s: of running, without waits at stops,
    which are in both energies and in the smooth run; csv: the smooth reference; cars: of a train of several cars.
    """

    version: Literal[1]
    energy_J: float
    lower_bound_J: float
    gap: float
    trip_time_s: float
    solver: str
    solve_s: float
    status: str
    least_trip_time_s: float | None
    check: SimulatedRun
    timing_points: list[TimingRow]
    smooth: NotRequired[SmoothDocument]
    csv: NotRequired[str]
    certified: NotRequired[CertifiedRun]
    cars: NotRequired[dict[str, Any]]

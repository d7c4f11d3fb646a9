"""A paper's main controller on a reference that is given, or on its own: errors and energy side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass

from workbench.errors import InputError
from workbench.model.curve_table import Row, TableCurve, curve_through
from workbench.model.desired_curve import DesiredCurve
from workbench.paper.loading import Loaded
from workbench.simulate.closed_loop import Run, simulate
from workbench.simulate.metrics import measure
from workbench.trains.scenario import Scenario

Rows = tuple[Row, ...] | None


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


def track(loaded: Loaded, rows: Rows = None) -> Tracked:
    """Run the main controller of a scenario or study on its own reference, or on that of the rows of a table.

    Raises InputError for a study that states no such run.
    """
    if loaded.kind is None:
        return _scenario(loaded.scenario, rows)
    if loaded.kind.track is None:
        raise InputError(loaded.path, "kind", "names a study without a run of its main controller: give its StudyKind "
                         "a `track`")
    return loaded.kind.track(loaded.study, curve_through(rows) if rows else None)


def _scenario(scenario: Scenario, rows: Rows) -> Tracked:
    if rows:
        why = dict.fromkeys(("kind", "file"), "convention: given")
        table = TableCurve(kind="table", file="given", source=why).model_copy(update={"rows": rows})
        scenario = scenario.model_copy(update={"reference": table})
    name = next(iter(scenario.controllers))
    run, curve = simulate(scenario, name), scenario.desired_curve()
    found = measure(run, scenario)
    largest = max(abs(found.speed_error_min), abs(found.speed_error_max))
    return Tracked(scenario.paper, name, curve.trip_time_s, curve.length_m, found.largest_position_error,
                   found.position_rms, largest, found.speed_rms, found.energy_J, run.failed)


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

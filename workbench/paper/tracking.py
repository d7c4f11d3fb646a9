"""A paper's main controller on a reference that is given, or on its own: errors and energy side by side."""

from __future__ import annotations

from workbench.errors import InputError
from workbench.model.curve_table import Row, TableCurve, curve_through
from workbench.paper.loading import Loaded
from workbench.paper.tracked import Tracked
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.trains.scenario import Scenario

Rows = tuple[Row, ...] | None


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

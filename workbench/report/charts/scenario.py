"""The charts of a scenario's runs: the line, one run over its reference, errors and commands, and the spread of the
drawn runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from workbench.paper.results import Curve, thinned
from workbench.report.charts.chart import Chart, Panel
from workbench.report.figures import N_PER_KG, SPREAD, Quantity, remark, series_of, spread_values
from workbench.report.svg import Array
from workbench.simulate.closed_loop import Run
from workbench.simulate.sweep import SweepRow
from workbench.trains.scenario import Scenario
from workbench.trains.track import resistance_table

TITLES: dict[Quantity, str] = {"position": "Position errors", "speed": "Speed errors", "command": "Commands"}


def line_chart(scenario: Scenario) -> Chart:
    """Resistance and grade of the line and the desired speed, by position."""
    track = scenario.track
    total = resistance_table(track)
    edges = np.append(total.position_m, track.length_m)
    grades = np.array([section.grade_permille for section in track.grade])
    ends = np.array([0.0, *(section.end_m for section in track.grade)])
    position, speed, _ = scenario.desired_curve().at(np.linspace(0.0, scenario.desired_curve().trip_time_s, 1200))
    return Chart("The line and the desired speed", "position (km)", (
        Panel("resistance (N/kN)", (_steps("total", edges / 1e3, total.specific_force / N_PER_KG),
                                    _steps("grade (‰)", ends / 1e3, grades))),
        Panel("desired speed (m/s)", (Curve("desired", position / 1e3, speed),))))


def _steps(label: str, edges: Array, values: Array) -> Curve:
    """Values that are constant from edge to edge, as a curve."""
    return Curve(label, np.repeat(edges, 2)[1:-1], np.repeat(values, 2))


def tracking_chart(run: Run) -> Chart:
    """Desired and measured speed and position of one run."""
    time = run.column("t_s")
    return Chart("Speed and position", "time (s)", tuple(
        Panel(label, (thinned("desired", time, run.column(wanted) * scale),
                      thinned(run.title, time, run.column(found) * scale)))
        for wanted, found, scale, label in (("v_desired_mps", "v_mps", 1.0, "speed (m/s)"),
                                            ("s_desired_m", "s_m", 1e-3, "position (km)"))))


def errors_chart(runs: Sequence[Run], quantity: Quantity) -> Chart:
    """One panel a controller, each with the scale that shows it."""
    titles = tuple(run.title for run in runs)
    panels = []
    for run in runs:
        time, value, unit = series_of(run, quantity)
        panels.append(Panel(unit, (thinned(run.title, time, value),), f"{run.title}: {remark(run, quantity)}"))
    return Chart(TITLES[quantity], "time (s)", tuple(panels), colours=titles)


def spread_chart(rows: Sequence[SweepRow], titles: Mapping[str, str]) -> Chart:
    """Of each controller's drawn runs the share that stays at or below a value."""
    names = list(dict.fromkeys(row.controller for row in rows))
    panels = []
    for label, _, keys in SPREAD:
        curves = []
        for name in names:
            values = spread_values(rows, name, keys)
            if values.size:
                curves.append(Curve(titles[name], 100.0 * np.arange(1, values.size + 1) / values.size, values))
        panels.append(Panel(label, tuple(curves), log_y=all((c.y > 0).all() for c in curves)))
    return Chart("Spread of the drawn runs", "share of the runs at or below (%)", tuple(panels),
                 colours=tuple(titles[name] for name in names))

"""The figures of a report, each as SVG text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from workbench.files.numbers import fixed, length, number
from workbench.report.svg import FAINT, INK, PALETTE, Array, drawing, svg, thin
from workbench.simulate.closed_loop import Run
from workbench.simulate.sweep import SweepRow
from workbench.trains.scenario import Scenario
from workbench.trains.track import resistance_table

START_S = 30.0
MOST_POINTS = 40
N_PER_KG = 9.80665e-3  # N for a kg, where a resistance is 1 N/kN
# What is shown of the drawn runs: its label, its column in a paper's table, the metrics of which the larger counts.
SPREAD: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("max |position error| (m)", "position_error_m", ("position_error_min", "position_error_max")),
    ("max |speed error| (m/s)", "speed_error_mps", ("speed_error_min", "speed_error_max")),
    ("|stopping error| (m)", "stopping_accuracy_m", ("stopping_error",)),
)

Quantity = Literal["position", "speed", "command"]


def colours(scenario: Scenario) -> dict[str, str]:
    """A colour for each controller of the scenario, the same in every figure."""
    return {name: PALETTE[i % len(PALETTE)] for i, name in enumerate(scenario.controllers)}


def line_profile(scenario: Scenario) -> str:
    """Grade, curve and total resistance in N/kN, and the desired speed in m/s, against position."""
    track, curve = scenario.track, scenario.desired_curve()
    with drawing("line"):
        figure = Figure(figsize=(9, 4.2), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
        total = resistance_table(track)
        edges = np.append(total.position_m, track.length_m) / 1e3
        above.stairs(total.specific_force / N_PER_KG, edges, fill=True, color=FAINT, alpha=0.35, baseline=0.0,
                     label="total")
        grades = np.array([s.grade_permille for s in track.grade])
        above.stairs(grades, np.array([0.0, *(s.end_m for s in track.grade)]) / 1e3, baseline=None,
                     color=PALETTE[0], linewidth=1.6, label="grade (‰)")
        bends = np.array([600 / s.radius_m for s in track.curve])
        above.stairs(bends, np.array([0.0, *(s.end_m for s in track.curve)]) / 1e3, baseline=None,
                     color=PALETTE[1], linewidth=1.6, linestyle="--", label="curve (600/R)")
        for i, section in enumerate(track.tunnel):
            above.hlines(section.resistance_n_per_kn, section.start_m / 1e3, section.end_m / 1e3,
                         color=PALETTE[2], linestyle=":", label="tunnel" if i == 0 else None)
        above.axhline(0, color=INK, linewidth=0.6)
        above.set(ylabel="resistance (N/kN)")
        above.legend(ncols=4, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2)
        position, speed, _ = curve.at(np.linspace(0.0, curve.trip_time_s, 1200))
        below.plot(*thin(position / 1e3, speed), color=INK)
        below.set(xlabel="position (km)", ylabel="desired speed (m/s)", ylim=(0, None),
                  xlim=(0, track.length_m / 1e3))
        kmh = below.secondary_yaxis("right", functions=(lambda v: v * 3.6, lambda v: v / 3.6))
        kmh.set_ylabel("(km/h)")
        return svg(figure, f"Resistance of the line of {track.length_m / 1e3:g} km by position, and the "
                           f"desired speed, at most {number(float(speed.max()))} m/s")


def tracking(run: Run) -> str:
    """Desired and measured speed (m/s) and position (km) of one run against time."""
    with drawing("tracking"):
        figure = Figure(figsize=(9, 4.2), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True)
        time = run.column("t_s")
        for axes, wanted, found, scale, label in ((above, "v_desired_mps", "v_mps", 1.0, "speed (m/s)"),
                                                  (below, "s_desired_m", "s_m", 1e-3, "position (km)")):
            axes.plot(*thin(time, run.column(wanted) * scale), color=FAINT, linewidth=4.5, label="desired",
                      solid_capstyle="butt")
            axes.plot(*thin(time, run.column(found) * scale), color=PALETTE[0], label=run.title)
            axes.set(ylabel=label)
        above.legend(ncols=2, loc="lower center")
        below.set(xlabel="time (s)", xlim=(0, float(time[-1])))
        return svg(figure, f"Desired and measured speed and position against time under {run.title}")


def errors(scenario: Scenario, runs: Sequence[Run], quantity: Quantity) -> str:
    """One row a controller: the whole run beside its first 30 s, each with the scale that shows it.

    quantity: position error (mm or m) with the band and the barrier k, speed error, or command u (m/s^2).
    """
    with drawing(quantity):
        figure = Figure(figsize=(9, 0.7 + 1.35 * len(runs)), layout="constrained")
        grid = figure.subplots(len(runs), 2, width_ratios=(2.2, 1), squeeze=False)
        tint = colours(scenario)
        for (whole, start), run in zip(grid, runs, strict=True):
            time, value, unit = series_of(run, quantity)
            first = time <= START_S
            for axes, part in ((whole, slice(None)), (start, first)):
                axes.axhline(0, color=INK, linewidth=0.6)
                axes.plot(*thin(time[part], value[part]), color=tint[run.controller], linewidth=1.1)
                axes.margins(x=0)
                axes.yaxis.set_major_locator(MaxNLocator(4))
                axes.tick_params(labelbottom=run is runs[-1])
            whole.set(ylabel=unit)
            start.set_xlim(0, START_S)
            whole.set_title(f"{run.title}: {remark(run, quantity)}")
            if quantity == "position":
                _draw_bounds(whole, start, scenario, run, unit)
        grid[0, 1].set_title(f"first {START_S:g} s")
        for axes in grid[-1]:
            axes.set_xlabel("time (s)")
        what = {"position": "Position error", "speed": "Speed error", "command": "Command"}[quantity]
        said = "; ".join(f"{run.title}: {remark(run, quantity)}" for run in runs)
        return svg(figure, f"{what} against time, one row a controller. {said}")


def series_of(run: Run, quantity: Quantity) -> tuple[Array, Array, str]:
    """Time in s, the quantity, and its unit, the one that suits its size."""
    time = run.column("t_s")
    if quantity == "command":
        return time, run.column("u_mps2"), "m/s²"
    measured, desired, unit = (("s_m", "s_desired_m", "m") if quantity == "position"
                               else ("v_mps", "v_desired_mps", "m/s"))
    value = run.column(measured) - run.column(desired)
    largest = float(np.abs(value).max(initial=0.0))
    return (time, value * 1e3, f"m{unit}") if largest < 1 else (time, value, unit)


def remark(run: Run, quantity: Quantity) -> str:
    """What a run's largest error or commands are, or when it failed."""
    total = run.totals
    if run.failed is not None:
        return f"failed at {fixed(run.end_s, 1)} s"
    if quantity == "command":
        return f"{number(total['command_min_mps2'])} to {number(total['command_max_mps2'])} m/s²"
    largest = max(-total[f"{quantity}_error_min"], total[f"{quantity}_error_max"])
    if quantity == "speed":
        return f"largest |error| {length(largest)}/s"
    return f"largest |error| {length(largest)} at {fixed(total['time_of_max_position_error_s'], 1)} s"


def _draw_bounds(whole: Axes, start: Axes, scenario: Scenario, run: Run, unit: str) -> None:
    """The watched band, dashed, and the law's barrier k, dotted, where they lie within the axis."""
    scale = 1e3 if unit == "mm" else 1.0
    barrier = scenario.controllers[run.controller].parameters.get("k")
    limits = start.get_ylim()
    for bound, style in ((scenario.simulation.position_band_m, "--"), (barrier, ":")):
        if bound is None or bound * scale > max(-whole.dataLim.y0, whole.dataLim.y1) * 1.3:
            continue
        for axes in (whole, start):
            for side in (bound * scale, -bound * scale):
                axes.axhline(side, color=INK, linewidth=0.9, linestyle=style)
    start.set_ylim(limits)


def spread(scenario: Scenario, rows: Sequence[SweepRow], titles: dict[str, str]) -> str:
    """Largest |position error|, largest |speed error| and |stopping error| of every run, on log axes.

    A dot a run (of many runs, 40 evenly ranked ones with both extremes), a bar at the median, and a diamond
    where the paper prints a value. `titles`: controller to the name shown.
    """
    names = [name for name in scenario.controllers if any(row.controller == name for row in rows)]
    printed = {row.controller: row for row in scenario.printed_table.rows} if scenario.printed_table else {}
    tint = colours(scenario)
    with drawing("spread"):
        figure = Figure(figsize=(9, 1.1 + 0.5 * len(names)), layout="constrained")
        grid = figure.subplots(1, 3, sharey=True)
        for axes, (label, printed_key, keys) in zip(grid, SPREAD, strict=True):
            for place, name in enumerate(names):
                _draw_strip(axes, place, np.maximum(spread_values(rows, name, keys), 1e-9), tint[name])
                if name in printed:
                    value = np.abs(getattr(printed[name], printed_key)).max()
                    axes.plot(value, place, "D", markersize=6, markerfacecolor="none", markeredgecolor=INK,
                              markeredgewidth=1.3)
            axes.set(xscale="log", xlabel=label, ylim=(len(names) - 0.5, -0.5))
            axes.grid(visible=False, axis="y")
        failed = {n: sum(row.controller == n and row.failed is not None for row in rows) for n in names}
        grid[0].set_yticks(range(len(names)), [
            titles.get(n, n) + (f"\n{failed[n]} failed" if failed[n] else "") for n in names
        ])
        grid[0].tick_params(axis="y", labelsize=9.0)
        signs = [Line2D([], [], color=INK, marker="o", alpha=0.55, markersize=4, linestyle="", label="a run"),
                 Line2D([], [], color=INK, marker="|", markersize=11, markeredgewidth=2, linestyle="",
                        label="median of the runs")]
        if printed:
            signs.append(Line2D([], [], color=INK, marker="D", markersize=6, markerfacecolor="none",
                                linestyle="", label="printed in the paper"))
        figure.legend(handles=signs, loc="outside upper left", ncols=3)
        return svg(figure, "Spread of the largest position error, the largest speed error and the stopping "
                           "error over the Monte Carlo runs; the numbers stand in the tables")


def spread_values(rows: Sequence[SweepRow], controller: str, keys: Sequence[str]) -> Array:
    """Of every run of a controller that did not fail the larger magnitude of the metrics `keys`, sorted."""
    whole = [row for row in rows if row.controller == controller and row.failed is None]
    return np.sort([max(abs(getattr(row, key) or 0.0) for key in keys) for row in whole])


def _draw_strip(axes: Axes, place: int, values: Array, colour: str) -> None:
    if not len(values):
        return
    shown = values[np.unique(np.linspace(0, len(values) - 1, min(len(values), MOST_POINTS)).astype(int))]
    # A fixed zigzag keeps equal values apart without a random number.
    height = place + 0.22 * ((np.arange(len(shown)) * 0.618) % 1.0 - 0.5)
    axes.plot(shown, height, "o", color=colour, markersize=4, alpha=0.55, markeredgewidth=0)
    axes.vlines(float(np.median(values)), place - 0.3, place + 0.3, color=colour, linewidth=2)

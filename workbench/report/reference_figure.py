"""An energy-optimal run over its line: speed under the limits with its regimes, and the line's force below."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from workbench.files.numbers import number
from workbench.files.writing import write_bytes
from workbench.optimal.profile import Profile
from workbench.optimal.regimes import REGIMES, regimes
from workbench.optimal.timetable import Timetable, TimingPoint
from workbench.optimal.vehicle import Vehicle
from workbench.report.svg import FAINT, INK, PALETTE, Array, drawing, svg, thin
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2

SPEED_WINDOW = "speeds asked for"
# Away from a page there are no page colours.
PAPER_GREY = "#9a9a9a"
COLOURS = dict(zip(REGIMES, (PALETTE[0], PALETTE[4], PALETTE[2], PALETTE[1]), strict=True))


def reference_figure(vehicle: Vehicle, profile: Profile, title: str, faint: str = FAINT,
                     timetable: Timetable | None = None) -> Figure:
    """Speed, limit and shaded regimes over position; below, the line's force as an equivalent grade in per mille.

    Timing points on the way are marked with their windows of time in s, and of speed where they have one.
    """
    x = profile.position_m / 1e3
    figure = Figure(figsize=(9, 5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    for name, (first, last) in stretches(regimes(vehicle, profile), x):
        above.axvspan(first, last, color=COLOURS[name], alpha=0.22, linewidth=0)
    above.stairs(profile.course.limit_mps * 3.6, x, baseline=None, color=faint, linewidth=1.6)
    above.plot(*thin(x, profile.speed_mps * 3.6, 800), color=INK, linewidth=1.4)
    for point in timetable.points[1:-1] if timetable else ():
        _mark(above, point, faint)
    above.set(ylabel="speed (km/h)", ylim=(0, None), title=title)
    windows = [line for line in above.get_lines() if line.get_label() == SPEED_WINDOW][:1]
    above.legend(handles=[*(Patch(color=COLOURS[name], alpha=0.22, label=name) for name in REGIMES), *windows],
                 ncols=5, loc="lower center")
    # N/kN of weight is the per mille of a grade.
    weight = vehicle.mass_kg * STANDARD_GRAVITY_MPS2 / 1000
    ends = profile.course.force_n / weight
    below.fill_between(np.repeat(x, 2)[1:-1], ends.ravel(), color=faint, alpha=0.5, linewidth=0)
    below.axhline(0, color=INK, linewidth=0.6)
    below.set(xlabel="position (km)", ylabel="grade and\ncurves (‰)", xlim=(float(x[0]), float(x[-1])))
    return figure


def _mark(axes: Axes, point: TimingPoint, faint: str) -> None:
    """A timing point: a line with its windows, and a bar over its range of speeds."""
    at = point.position_m / 1e3
    windows = [point.arrival, point.departure] if point.stands else [point.arrival]
    words = ", ".join(f"{_bound(w.earliest_s)}–{_bound(w.latest_s)} s" for w in windows)
    axes.axvline(at, color=faint, linewidth=0.8, linestyle=":")
    axes.annotate(words, (at, 1.0), (-3, -3), xycoords=("data", "axes fraction"), textcoords="offset points",
                  rotation=90, ha="right", va="top", fontsize=7)
    if not point.stands and (point.slowest_mps > 0 or math.isfinite(point.fastest_mps)):
        top = point.fastest_mps if math.isfinite(point.fastest_mps) else axes.get_ylim()[1] / 3.6
        axes.plot([at, at], [3.6 * point.slowest_mps, 3.6 * top], color=PALETTE[3], linewidth=5, alpha=0.5, zorder=1,
                  solid_capstyle="butt", label=SPEED_WINDOW)


def _bound(time_s: float) -> str:
    return f"{time_s:g}" if math.isfinite(time_s) else ""


def stretches(names: NDArray[np.str_], edges: Array) -> list[tuple[str, tuple[float, float]]]:
    """Runs of equal names with the edges they span."""
    change = np.flatnonzero(names[1:] != names[:-1]) + 1
    borders = [0, *change.tolist(), len(names)]
    return [(str(names[a]), (float(edges[a]), float(edges[b]))) for a, b in pairwise(borders)]


def reference_svg(vehicle: Vehicle, profile: Profile, title: str) -> str:
    """The figure as SVG for a page."""
    with drawing("reference"):
        return svg(reference_figure(vehicle, profile, title),
                   f"Speed of the energy-optimal run over {number((profile.position_m[-1]) / 1e3)} km under the speed "
                   "limits, with the regimes traction, cruise, coast and brake shaded; grade and curves below")


def save_figure(path: Path, vehicle: Vehicle, profile: Profile, title: str,
                timetable: Timetable | None = None) -> None:
    """Write the figure in the format of the file's ending; raises InputError where it cannot be written."""
    saved(path, lambda faint: reference_figure(vehicle, profile, title, faint, timetable))


def saved(path: Path, make: Callable[[str], Figure]) -> None:
    """Write what `make` draws with a faint colour that shows away from a page; raises InputError where it cannot."""
    grey = dict.fromkeys(("axes.edgecolor", "grid.color", "xtick.color", "ytick.color"), PAPER_GREY)
    with drawing("reference"), mpl.rc_context(grey):
        drawn = io.BytesIO()
        make(PAPER_GREY).savefig(drawn, dpi=150, format=path.suffix.lower().removeprefix("."))
    write_bytes(path, drawn.getvalue())

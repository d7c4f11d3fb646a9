"""The timing points of a run as lines of a table: windows, times, speeds, and what a second of room would save."""

from __future__ import annotations

from collections.abc import Iterator

from workbench.optimal.export import timing_rows
from workbench.optimal.reference import Reference
from workbench.optimal.smooth import SmoothReference


def timing_lines(found: Reference, smooth: SmoothReference) -> Iterator[str]:
    """A head, a line for each event, and by how much the smooth run misses a window where it does."""
    yield f"{'timing':>13} {'at m':>10}  {'window s':>19} {'time s':>9} {'km/h':>6}  binds"
    for row in timing_rows(found, smooth):
        window = f"{_limit(row['earliest_s'])} to {_limit(row['latest_s'])}"
        binds = f"{row['binds']}: {row['price_W'] / 1e3:.4g} kJ a second" if row["binds"] else ""
        yield (f"{row['kind']:>13} {row['position_m']:>10.1f}  {window:>19} {row['time_s']:>9.2f} "
               f"{3.6 * row['speed_mps']:>6.1f}  {binds}").rstrip()
    if smooth.miss_s > 0:
        yield f"timing        the smooth run misses a window by {smooth.miss_s:.2g} s"


def _limit(value: float | None) -> str:
    return "any" if value is None else f"{value:g}"

"""A plot as data: panels above one axis, each with its curves; as JSON for a page and as CSV for other programs."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from workbench.files.spreadsheet import text_cell
from workbench.paper.results import Curve, Plot
from workbench.report.plain_formulas import plain_words
from workbench.report.svg import Array, thin

BENEATH = ("desired", "printed")  # curves whose label begins so are drawn broad and faint, beneath the others
FEW = 60  # so few points are samples rather than a course: they are marked
BUCKETS = 700  # stretches of a curve of which the lowest and the highest point are drawn: enough to zoom into
DIGITS = 6


@dataclass(frozen=True)
class Panel:
    """Curves on one vertical axis; y_label with its unit, title above the panel where one is needed."""

    y_label: str
    curves: tuple[Curve, ...]
    title: str = ""
    log_y: bool = False


@dataclass(frozen=True)
class Chart:
    """Panels above one horizontal axis; x_label with its unit. One colour a label, `colours` ahead of the others."""

    title: str
    x_label: str
    panels: tuple[Panel, ...]
    log_x: bool = False
    colours: tuple[str, ...] = ()

    @property
    def csv_name(self) -> str:
        """What its table is called as a file, without its number."""
        return re.sub(r"[^a-z0-9]+", "-", self.title.lower()).strip("-")[:60]


def chart_of(plot: Plot) -> Chart:
    """A study's plot as a chart of one panel."""
    panel = Panel(plot.y_label, plot.curves, log_y=plot.log_y and any((c.y > 0).any() for c in plot.curves))
    return Chart(plot.title, plot.x_label, (panel,), plot.log_x)


def chart_json(chart: Chart) -> str:
    """All that a page draws the chart from, thinned to what can be zoomed into; safe within a script element."""
    labels = list(dict.fromkeys([*chart.colours, *(c.label for p in chart.panels for c in p.curves
                                                   if not c.label.startswith(BENEATH))]))
    panels = [{"y": plain_words(panel.y_label), "title": plain_words(panel.title), "log": panel.log_y,
               "curves": [_curve(curve, labels) for curve in panel.curves]} for panel in chart.panels]
    whole = {"title": plain_words(chart.title), "x": plain_words(chart.x_label), "log": chart.log_x, "panels": panels}
    text = json.dumps(whole, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c")


def _curve(curve: Curve, labels: Sequence[str]) -> dict[str, object]:
    x, y = thin(curve.x, curve.y, BUCKETS)
    found: dict[str, object] = {"label": plain_words(curve.label), "x": _rounded(x), "y": _rounded(y),
                                "points": len(curve.x)}
    if curve.label in labels:
        found["series"] = labels.index(curve.label)
    if len(curve.x) <= FEW:
        found["marked"] = True
    return found


def _rounded(values: Array) -> list[float | int]:
    """Numbers of six digits, whole ones without a fraction: a third of the text, finer than any screen."""
    found = (float(f"{value:.{DIGITS}g}") for value in np.asarray(values, dtype=float))
    return [int(value) if value == int(value) and abs(value) < 1e15 else value for value in found]


def chart_csv(chart: Chart) -> str:
    """Every point as it was computed: curve, x, y; with a column that names the panel where there are several."""
    text = io.StringIO(newline="")
    rows = csv.writer(text, lineterminator="\n")
    several = len(chart.panels) > 1
    x_label = text_cell(chart.x_label)
    rows.writerow(("curve", x_label, "value", "quantity") if several else
                  ("curve", x_label, text_cell(chart.panels[0].y_label)))
    for panel in chart.panels:
        named = (text_cell(f"{panel.title}: {panel.y_label}" if panel.title else panel.y_label),) if several else ()
        for curve in panel.curves:
            rows.writerows((text_cell(curve.label), f"{x:.10g}", f"{y:.10g}", *named)
                           for x, y in zip(curve.x, curve.y, strict=True))
    return text.getvalue()

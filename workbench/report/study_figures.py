"""A plot of a study as SVG text."""

from __future__ import annotations

import re

import numpy as np
from matplotlib.figure import Figure

from workbench.paper.results import Plot
from workbench.report.charts.chart import BENEATH, FEW
from workbench.report.plain_formulas import plain_words
from workbench.report.svg import FAINT, PALETTE, drawing, svg, thin

LINES = ("-", "--", ":", "-.")
# A legend line of the figure's width holds about so many letters.
LETTERS = 120
# A letter with an index, as v_d, and no name of several letters before the line, as mpc_linear.
_INDEXED = re.compile(r"(?<!\w)([^\W\d_][\u0300-\u036f]*)_([^\W_]{1,3})(?!\w)")


def study_plot(plot: Plot, name: str) -> str:
    """All curves of a plot on one pair of axes, thinned to what can be seen; `name` tells it from other figures."""
    with drawing(name):
        labels = [curve.label for curve in plot.curves]
        columns = max(1, min(len(labels), LETTERS // (max(map(len, labels), default=0) + 8)))
        rows = -(-len(labels) // columns)
        figure = Figure(figsize=(9, 3.3 + 0.17 * rows), layout="constrained")
        axes = figure.subplots()
        drawn = 0
        for curve in plot.curves:
            x, y = thin(curve.x, curve.y)
            if curve.label.startswith(BENEATH):
                axes.plot(x, y, color=FAINT, linewidth=4.5, label=lettered(curve.label), solid_capstyle="butt",
                          zorder=1)
                continue
            axes.plot(x, y, LINES[drawn // len(PALETTE) % len(LINES)], color=PALETTE[drawn % len(PALETTE)],
                      label=lettered(curve.label), marker="o" if len(curve.x) <= FEW else None, markersize=3)
            drawn += 1
        axes.set(xlabel=lettered(plot.x_label), ylabel=lettered(plot.y_label))
        axes.margins(x=0.01)
        if plot.log_y and any((curve.y > 0).any() for curve in plot.curves):
            axes.set_yscale("log", nonpositive="mask")
        if plot.log_x:
            axes.set_xscale("log", nonpositive="mask")
        if len(labels) > 1:
            figure.legend(loc="outside upper left", ncols=columns)
        return svg(figure, plain_words(f"{plot.title}: {plot.y_label} against {plot.x_label}; {_ranges(plot)}"))


def lettered(text: str) -> str:
    """A text for matplotlib, its letters with their indices: those that Unicode has small signs for, else as marks."""
    return _INDEXED.sub(r"$\\mathregular{\1_{\2}}$", plain_words(text).replace("$", r"\$"))


def _ranges(plot: Plot) -> str:
    """What who cannot see the figure should know of its curves."""
    return "; ".join(f"{plain_words(curve.label) or 'the curve'} from {np.min(curve.y):.3g} to {np.max(curve.y):.3g}"
                     for curve in plot.curves)

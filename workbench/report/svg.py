"""Matplotlib figures as small, reproducible SVG that takes its ink from the page around it."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from itertools import pairwise

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Okabe and Ito's palette, told apart with any colour vision, without its yellow and black: readable on white
# and on near black.
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
# Stand-ins that become the page's own colours in the SVG text.
INK, FAINT = "#010203", "#010204"
_PAGE_COLOURS = {INK: "currentColor", FAINT: "var(--faint, #b4b4b4)"} | {
    colour.lower(): f"var(--series-{i}, {colour})" for i, colour in enumerate(PALETTE)
}
# Text is laid out for DejaVu Sans, which matplotlib brings along; where it is missing another stands in.
FONT, STAND_INS = "'DejaVu Sans'", "'DejaVu Sans', Verdana, 'Segoe UI', Helvetica, Arial, sans-serif"
BUCKETS = 320


@contextmanager
def drawing(name: str) -> Iterator[None]:
    """Matplotlib's settings for one figure, from its making to `svg`; `name` makes its ids its own."""
    settings = {
        "svg.fonttype": "none", "svg.hashsalt": name, "font.family": "DejaVu Sans", "font.size": 9.0,
        "axes.titlesize": 9.0, "axes.labelsize": 9.0, "xtick.labelsize": 8.0, "ytick.labelsize": 8.0,
        "legend.fontsize": 8.0, "legend.frameon": False, "axes.edgecolor": FAINT, "axes.labelcolor": INK,
        "axes.titlecolor": INK, "text.color": INK, "xtick.color": FAINT, "xtick.labelcolor": INK,
        "ytick.color": FAINT, "ytick.labelcolor": INK, "grid.color": FAINT, "grid.linewidth": 0.4,
        "axes.grid": True, "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
        "axes.linewidth": 0.8, "lines.linewidth": 1.2, "axes.formatter.useoffset": False,
        "axes.titlelocation": "left", "path.simplify": True, "axes.formatter.limits": (-4, 5),
    }
    with mpl.rc_context(settings):
        yield


def svg(figure: Figure, alt: str) -> str:
    """The figure as an SVG element to stand in an HTML page; `alt` tells who cannot see it what it shows.

    The same figure gives the same bytes. Call it within the `drawing` that the figure was made in.
    """
    stream = io.StringIO()
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    figure.savefig(stream, format="svg", transparent=True, metadata=nothing)
    text = stream.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg"):], flags=re.DOTALL)
    text = re.sub("|".join(_PAGE_COLOURS), lambda m: _PAGE_COLOURS[m[0]], text)
    text = text.replace(FONT, STAND_INS)
    # Names of groups repeat from figure to figure; only those that something points to are kept.
    used = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', text))
    text = re.sub(r' id="([^"]*)"', lambda m: m[0] if m[1] in used else "", text)
    # A hundredth of a point is finer than any screen.
    text = re.sub(r'(?<= d=")[^"]*', lambda m: re.sub(r"(\.\d\d)\d+", r"\1", m[0]), text)
    text = re.sub(r"\n\s*", "\n", text)
    head = f'<svg role="img" aria-label="{escape(alt)}" '
    opening = re.sub(r' (?:width|height)="[^"]*pt"', "", text[: text.index(">")])
    return opening.replace("<svg ", head, 1) + text[text.index(">"):]


def thin(time: Array, value: Array, buckets: int = BUCKETS) -> tuple[Array, Array]:
    """Fewer points that look the same: of each bucket of neighbours its lowest and its highest, in order."""
    if len(time) <= 2 * buckets:
        return time, value
    edges = np.linspace(0, len(time), buckets + 1).astype(int)
    keep = {0, len(time) - 1}
    for first, last in pairwise(edges):
        part = value[first:last]
        keep |= {int(first + np.argmin(part)), int(first + np.argmax(part))}
    index = np.array(sorted(keep))
    return time[index], value[index]

"""A premise graph ready to stand on a page: its picture as SVG, and the same in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from workbench.proof.places import place_of
from workbench.proof.verdict import FAILED
from workbench.report.claims import ClaimRef, ClaimView
from workbench.report.formulas import in_html
from workbench.report.graph.layout import HEIGHT, Layout, Point, layout
from workbench.report.graph.premise_graph import PremiseGraph, premise_graphs
from workbench.report.plain_formulas import plain_told

LETTER, PADDING = 7.1, 26.0  # pixels: an average letter, the room around the letters of a box
LEGIBLE = 0.8  # how far a picture shrinks to fit the page, beyond which it scrolls


@dataclass(frozen=True)
class LineInWords:
    """A line on a broken path: what it is, what becomes of it, and the lines that rest on it, `failing` by itself."""

    line: ClaimRef
    verdict: str
    failing: bool
    used_by: tuple[ClaimRef, ...]


@dataclass(frozen=True)
class GraphView:
    """A graph ready to show; words: its lines in the order of the paper."""

    whole: bool
    svg: Markup
    words: tuple[LineInWords, ...]


def graph_views(claims: Sequence[ClaimView]) -> list[GraphView]:
    """The graphs of a paper's claims, the broken paths first."""
    return [_view(graph) for graph in premise_graphs(claims)]


def _view(graph: PremiseGraph) -> GraphView:
    used: dict[int, list[int]] = {}
    for a, b in graph.edges:
        used.setdefault(a, []).append(b)
    words = tuple(LineInWords(_ref(line), line.verdict, line.verdict in FAILED,
                              tuple(_ref(graph.lines[b]) for b in used.get(i, ())))
                  for i, line in enumerate(graph.lines))
    return GraphView(graph.whole, _svg(graph), words)


def _ref(line: ClaimView) -> ClaimRef:
    return ClaimRef(in_html(line.told.removeprefix("Equation ")), line.anchor)


def _label(line: ClaimView) -> str:
    place = place_of(line.equation) if line.place == place_of(line.equation, "") else line.place
    return place.removeprefix("Equation ").removeprefix("The ")


def _svg(graph: PremiseGraph) -> Markup:
    labels = [_label(line) for line in graph.lines]
    widths = [LETTER * len(label) + PADDING for label in labels]
    placed = layout(widths, graph.edges)
    what = "All lines below the headline statements" if graph.whole else "The lines on broken paths"
    parts = [Markup('<svg class="premises" role="group" aria-label="{}, as a graph: an edge runs from a line to what '
                    'rests on it" viewBox="0 0 {:.0f} {:.0f}" width="{:.0f}" height="{:.0f}" '
                    'style="min-width: {:.0f}px">').format(
                        what, placed.width, placed.height, placed.width, placed.height, LEGIBLE * placed.width)]
    order = sorted(range(len(graph.edges)), key=lambda i: graph.edges[i] in graph.broken)
    parts += [_edge(placed.courses[i], graph.edges[i] in graph.broken) for i in order]
    parts += [_box(line, label, placed, i, widths[i])
              for i, (line, label) in enumerate(zip(graph.lines, labels, strict=True))]
    return Markup("").join([*parts, Markup("</svg>")])


def _edge(course: Sequence[Point], broken: bool) -> Markup:
    """A smooth line through all points of a course, level at each, with a head at its end."""
    (x, y), *rest = course
    path = f"M{x:.1f} {y:.1f}"
    for nx, ny in rest:
        path += f"C{(x + nx) / 2:.1f} {y:.1f} {(x + nx) / 2:.1f} {ny:.1f} {nx:.1f} {ny:.1f}"
        x, y = nx, ny
    head = f"M{x - 6:.1f} {y - 3.5:.1f}L{x:.1f} {y:.1f}L{x - 6:.1f} {y + 3.5:.1f}"
    return Markup('<path class="{}" d="{}{}"/>').format("edge broken" if broken else "edge", path, head)


def _box(line: ClaimView, label: str, placed: Layout, i: int, width: float) -> Markup:
    x, y = placed.boxes[i]
    rests = " fails-below" if line.tainted_by and line.verdict not in FAILED else ""
    said = f"{line.verdict}{', rests on a line that fails' if rests else ''}{f'; {line.fate}' if line.fate else ''}"
    return Markup('<a href="#{}" class="line {}{}{}"><title>{}</title><rect x="{:.1f}" y="{:.1f}" width="{:.1f}" '
                  'height="{:g}" rx="5"/><text x="{:.1f}" y="{:.1f}">{} {}</text></a>').format(
        line.anchor, escape(line.verdict if line.sign != "?" else "undecided"), rests, " headline" if line.fate else "",
        f"{plain_told(line.told)}: {said}", x - width / 2, y - HEIGHT / 2, width, HEIGHT, x, y + 4.5, line.sign,
        label)

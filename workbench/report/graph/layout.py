"""Where the lines and edges of a graph lie: layers from left to right, few crossings, by grandalf."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from grandalf.graphs import Edge, Graph, Vertex
from grandalf.layouts import SugiyamaLayout

Point = tuple[float, float]
HEIGHT, BETWEEN, APART, MARGIN = 26.0, 46.0, 10.0, 8.0  # pixels: of a box, between layers, between boxes, around all


@dataclass(frozen=True)
class Layout:
    """Pixels: the middle of every box, the course of every edge from box to box, width and height of all."""

    boxes: tuple[Point, ...]
    courses: tuple[tuple[Point, ...], ...]
    width: float
    height: float


@dataclass
class _Box:
    """What the library reads of a vertex: it lays layers from top to bottom, so that sides are turned."""

    w: float
    h: float
    xy: Point = (0.0, 0.0)


@dataclass
class _Course:
    """What the library writes of an edge: its bends."""

    bends: list[Point] = field(default_factory=list)

    def setpath(self, points: Sequence[Point]) -> None:
        self.bends = [(x, y) for x, y in points]


def layout(widths: Sequence[float], edges: Sequence[tuple[int, int]]) -> Layout:
    """The places of boxes of these widths; parts that no edge connects stand below each other."""
    vertices = [Vertex(i) for i in range(len(widths))]
    for vertex, width in zip(vertices, widths, strict=True):
        vertex.view = _Box(HEIGHT, width)
    lines = [Edge(vertices[a], vertices[b]) for a, b in edges]
    for line in lines:
        line.view = _Course()
    boxes: dict[int, Point] = {}
    courses: dict[tuple[int, int], tuple[Point, ...]] = {}
    top = width = 0.0
    for part in Graph(vertices, lines).C:
        of_it = list(part.V())
        if len(of_it) > 1:
            placed = SugiyamaLayout(part)
            placed.xspace, placed.yspace = APART, BETWEEN
            placed.route_edge = lambda edge, points: None
            placed.init_all()
            placed.draw(8)
        # Turned: the library's y runs along the layers, to the right here.
        down = min(v.view.xy[0] for v in of_it) - HEIGHT / 2 - top - MARGIN
        right = min(v.view.xy[1] - v.view.h / 2 for v in of_it) - MARGIN
        for v in of_it:
            boxes[v.data] = (v.view.xy[1] - right, v.view.xy[0] - down)
        for edge in part.E():
            ends = edge.v[0].data, edge.v[1].data
            bends = [(y - right, x - down) for x, y in edge.view.bends[1:-1]]
            (ax, ay), (bx, by) = boxes[ends[0]], boxes[ends[1]]
            courses[ends] = ((ax + widths[ends[0]] / 2, ay), *bends, (bx - widths[ends[1]] / 2, by))
        top = max(boxes[v.data][1] for v in of_it) + HEIGHT / 2 + APART - MARGIN
        width = max(width, *(boxes[v.data][0] + widths[v.data] / 2 for v in of_it))
        top += MARGIN
    return Layout(tuple(boxes[i] for i in range(len(widths))), tuple(courses[edge] for edge in edges),
                  width + MARGIN, top + MARGIN)

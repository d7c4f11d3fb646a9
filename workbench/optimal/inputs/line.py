"""A line, and what a train of some length meets on it: the line, averaged over the train, becomes a course."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import astuple, dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from workbench.errors import InputError
from workbench.optimal.course import Course
from workbench.optimal.inputs.along_line import AlongLine, Array, steps
from workbench.optimal.inputs.line_checks import (
    FASTEST_MPS,
    LONGEST_TRAIN_M,
    SAME_PLACE_M,
    SHARPEST_RADIUS_M,
    SHORTEST_TRAIN_M,
    SLOWEST_MPS,
    STEEPEST_PERMILLE,
    require_starts,
    require_stops,
    require_tunnels,
)
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import (
    ROECKL_KNEE_M,
    STANDARD_GRAVITY_MPS2,
    curve_n_per_kn,
    of_weight,
    roeckl_sharp_n_per_kn,
    roeckl_wide_n_per_kn,
)

CurveRule = Literal["roeckl", "inverse_radius"]

# Roeckl's formula changes here, so that a clothoid's resistance jumps where it passes this curvature.
KNEE_PER_M = 1 / ROECKL_KNEE_M


def _roeckl(curvature_per_m: float) -> float:
    wide = curvature_per_m <= KNEE_PER_M
    return float((roeckl_wide_n_per_kn if wide else roeckl_sharp_n_per_kn)(curvature_per_m))


RULES: dict[CurveRule, Callable[[float], float]] = {"roeckl": _roeckl, "inverse_radius": curve_n_per_kn}

# A course is linear between its borders and the resistance of a clothoid is not: by how much it may differ, as a
# fraction of the largest resistance of curves on the run. The clothoid itself is followed ten times closer.
CURVE_TOLERANCE = 1e-3

# Borders that lie closer become one.
SHORTEST_SECTION_M = 1e-3


@dataclass(frozen=True)
class Tunnel:
    """A tunnel from start_m on, with what is known of it: its cross section, or the resistance it adds."""

    start_m: float
    length_m: float
    cross_section_m2: float | None = None
    resistance_n_per_kn: float = 0.0


@dataclass(frozen=True)
class Line:
    """A line from 0 to length_m; what holds from a position on holds up to the next one, at the end to length_m.

    stops_m: where trains may stop, first and last position included. limits: (position in m, limit in m/s).
    grades: (position in m, per mille, rising positive). curves: (position in m, curvature 1/R there and at the next
    position in 1/m, signed, linear between): clothoids; none is straight. tunnels do not overlap.
    curve_rule: the resistance of curves, `roeckl_specific_resistance` or `additional_specific_resistance` of
    line_resistance.py.
    An infinite limit is none. Raises InputError where positions or values cannot be those of a line.
    """

    name: str
    length_m: float
    stops_m: tuple[float, ...]
    limits: tuple[tuple[float, float], ...]
    grades: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    curves: tuple[tuple[float, float, float], ...] = ()
    tunnels: tuple[Tunnel, ...] = ()
    curve_rule: CurveRule = "roeckl"

    def __post_init__(self) -> None:
        require_stops("stops", self.stops_m)
        if self.stops_m[-1] != self.length_m:
            raise InputError("", "stops", f"end at {self.stops_m[-1]:g} m, the line at {self.length_m:g} m: "
                             "let the last stop be the line's end")
        require_starts("speed limits", [row[0] for row in self.limits], self.length_m)
        require_starts("gradients", [row[0] for row in self.grades], self.length_m)
        if self.curves:
            require_starts("curvatures", [row[0] for row in self.curves], self.length_m)
        require_tunnels("tunnels", [astuple(tunnel) for tunnel in self.tunnels], self.length_m)
        for number, (_, limit) in enumerate(self.limits):
            if not (SLOWEST_MPS <= limit <= FASTEST_MPS or limit == math.inf):
                raise InputError("", f"speed limits[{number}]", f"{limit:g} m/s is no speed limit between "
                                 f"{SLOWEST_MPS:g} and {FASTEST_MPS:g} m/s: correct it or its unit")
        for number, (_, grade) in enumerate(self.grades):
            if not abs(grade) <= STEEPEST_PERMILLE:
                raise InputError("", f"gradients[{number}]", f"{grade:g} per mille is no railway's grade, at most "
                                 f"{STEEPEST_PERMILLE:g}: correct it or its unit")
        for number, (_, *ends) in enumerate(self.curves):
            if not all(abs(curvature) <= 1 / SHARPEST_RADIUS_M for curvature in ends):
                raise InputError("", f"curvatures[{number}]", f"is sharper than R = {SHARPEST_RADIUS_M:g} m, which is "
                                 "no railway curve: correct the radius or its unit")

    def stops_between(self, from_m: float, to_m: float) -> tuple[float, ...]:
        """The stops strictly between two positions."""
        return tuple(stop for stop in self.stops_m if from_m < stop < to_m)


def course(line: Line, vehicle: Vehicle, from_m: float = 0.0, to_m: float | None = None,
           stops_m: Sequence[float] = ()) -> Course:
    """The course of a vehicle from one position of its front to another, to line.length_m where none is given.

    Grade, curve and tunnel forces and tunnel drag are means over [front - vehicle.length_m, front], the speed limit is
    the least there and the vehicle's own; behind the line's start its first values hold. Exact, to a millimetre of
    position, but for clothoids: their force differs by less than CURVE_TOLERANCE of the largest curve force of the run.
    stops_m: where to stop on the way.
    Raises InputError for positions that are no run on this line, and where no speed limit is known.
    """
    to_m = line.length_m if to_m is None else to_m
    _require_run(line, vehicle, from_m, to_m, stops_m)
    length, weight = vehicle.length_m, _forces(line.curve_rule, vehicle.mass_kg)
    grade = steps([x for x, _ in line.grades], [weight(g, 0.0, 0.0) for _, g in line.grades], line.length_m)
    curve, curve_borders = _curve_profile(line, lambda k: weight(0.0, k, 0.0))
    tunnel = _tunnel_profile(line, [weight(0.0, 0.0, t.resistance_n_per_kn) for t in line.tunnels])
    drag = _tunnel_profile(line, [_tunnel_drag(vehicle, t.cross_section_m2) for t in line.tunnels])

    at = [x for x, _ in line.limits]
    knots = {*grade.position_m, *curve_borders, *tunnel.position_m, *at}
    inner = {x for knot in knots for x in (knot, knot + length) if from_m < x < to_m}
    borders = _distinct(inner, (from_m, *stops_m, to_m))
    if line.curves:
        borders = _follow(curve, length, borders)
    force = sum((_ends(profile, length, borders) for profile in (grade, curve, tunnel)), np.zeros((1, 2)))
    middle = (borders[:-1] + borders[1:]) / 2
    first = np.clip(np.searchsorted(at, middle - length, side="right") - 1, 0, None)
    last = np.searchsorted(at, middle, side="right")
    allowed = [min(limit for _, limit in line.limits[a:b]) for a, b in zip(first, last, strict=True)]
    limit = np.minimum(np.array(allowed), vehicle.max_speed_mps)
    if not np.all(np.isfinite(limit)):
        raise InputError("", "speed limit", f"neither line '{line.name}' nor train '{vehicle.name}' has one: state a "
                         "speed limit of the line or the train's highest speed")
    return _merged(Course(borders, limit, force, _ends(drag, length, borders), tuple(sorted(stops_m))))


def _require_run(line: Line, vehicle: Vehicle, from_m: float, to_m: float, stops_m: Sequence[float]) -> None:
    if not (from_m >= 0 and from_m + 1 <= to_m <= line.length_m):
        raise InputError("", "from, to", f"{from_m:g} m to {to_m:g} m is no run of a metre or more on line "
                         f"'{line.name}' from 0 to {line.length_m:g} m: choose other ends")
    points = sorted((from_m, *stops_m, to_m))
    if stops_m and not (points[0] == from_m and points[-1] == to_m and min(np.diff(points)) >= 1):
        raise InputError("", "stops", f"must lie a metre or more apart, between {from_m:g} m and {to_m:g} m: remove "
                         "what does not")
    if not (vehicle.length_m == 0 or SHORTEST_TRAIN_M <= vehicle.length_m <= LONGEST_TRAIN_M):
        raise InputError("", "length", f"{vehicle.length_m:g} m is no train's, {SHORTEST_TRAIN_M:g} to "
                         f"{LONGEST_TRAIN_M:g} m, or 0 for a point: correct it or its unit")


def _forces(rule: CurveRule, mass_kg: float) -> Callable[[float, float, float], float]:
    """Force in N of a grade in per mille, a curvature in 1/m and a tunnel in N/kN; weight counts, not inertia."""
    resists = RULES[rule]
    return lambda grade, curvature, tunnel: mass_kg * float(
        of_weight(STANDARD_GRAVITY_MPS2, grade + resists(curvature) + tunnel))


def _curve_profile(line: Line, force: Callable[[float], float]) -> tuple[AlongLine, list[float]]:
    """The force of curves before smearing, and the borders between which it is smooth.

    The signed curvature is linear along a clothoid and its magnitude resists, so that it has a kink where the sign
    changes and, by Roeckl, a jump at the knee.
    """
    positions, borders = [0.0], [0.0]
    values: list[tuple[float, float]] = []
    ends = [*(x for x, *_ in line.curves[1:]), line.length_m]
    for (start, at_start, at_end), end in zip(line.curves, ends, strict=True) if line.curves else ():
        bends = [(level - at_start) / (at_end - at_start) for level in (-KNEE_PER_M, 0.0, KNEE_PER_M)
                 if min(at_start, at_end) < level < max(at_start, at_end)]
        shares = [0.0, *sorted(bends), 1.0]
        for low, high in pairwise(shares):
            one, two = (abs(at_start + share * (at_end - at_start)) for share in (low, high))
            # The knee belongs to one side only: the other side's value is that next to it.
            one, two = one + 1e-9 * (two - one), two + 1e-9 * (one - two)
            bow = abs(force((one + two) / 2) - (force(one) + force(two)) / 2)
            parts = math.ceil(2 * math.sqrt(bow / (0.1 * CURVE_TOLERANCE * max(force(one), force(two), 1e-300))))
            x_low, x_high = start + low * (end - start), start + high * (end - start)
            if x_high <= positions[-1]:  # a bend so close to the end that it has no length
                continue
            curvature = np.linspace(one, two, max(parts, 1) + 1)
            found = [force(k) for k in curvature]
            positions += np.linspace(x_low, x_high, len(curvature))[1:].tolist()
            values += pairwise(found)
            borders.append(x_high)
    if not values:
        return steps([0.0], [0.0], line.length_m), []
    return AlongLine(np.array(positions), np.array(values)), borders


def _tunnel_profile(line: Line, inside: Sequence[float]) -> AlongLine:
    """A value inside each tunnel and nothing outside."""
    starts, values = [0.0], [0.0]
    for tunnel, value in zip(line.tunnels, inside, strict=True):
        if tunnel.start_m - starts[-1] > SAME_PLACE_M:
            starts.append(tunnel.start_m)
            values.append(0.0)
        values[-1] = value
        starts.append(tunnel.start_m + tunnel.length_m)
        values.append(0.0)
    if line.length_m - starts[-1] <= SAME_PLACE_M:
        starts, values = starts[:-1], values[:-1]
    return steps(starts, values, line.length_m)


def _tunnel_drag(vehicle: Vehicle, cross_section_m2: float | None) -> float:
    """Added c in N s^2/m^2 in a tunnel: linear in 1/area between the areas of the train's table, nearest beyond.

    1/area, because what drives the drag is the share of the tunnel that the train blocks.
    """
    if cross_section_m2 is None or not vehicle.tunnel_drag:
        return 0.0
    table = sorted((1 / area, added) for area, added in vehicle.tunnel_drag)
    return float(np.interp(1 / cross_section_m2, [x for x, _ in table], [y for _, y in table]))


def _distinct(points: Iterable[float], kept: Sequence[float]) -> Array:
    """All of `kept`, and the points that lie apart from them and from each other, in order."""
    found: list[float] = []
    fixed = {float(x) for x in kept}
    for x in sorted({*map(float, points), *fixed}):
        if found and x - found[-1] < SHORTEST_SECTION_M:
            if x not in fixed:
                continue
            if found[-1] not in fixed:
                found.pop()
        found.append(x)
    return np.array(found)


def _ends(profile: AlongLine, length_m: float, borders: Array) -> Array:
    """Shape (n, 2): the mean over the train at the start and the end of each section."""
    # Of a jump that was merged into a border nearby, either end takes the value of its own side.
    step = np.minimum(2 * SHORTEST_SECTION_M, np.diff(borders) / 2)
    sides = ((borders[:-1], borders[:-1] + step), (borders[1:], borders[1:] - step))
    return np.stack([profile.mean(side, length_m, inside) for side, inside in sides], axis=1)


def _follow(curve: AlongLine, length_m: float, borders: Array) -> Array:
    """Further borders, so that straight lines between them follow the force of curves within the tolerance."""
    shares = np.linspace(0, 1, 9)[1:-1]
    for _ in range(6):
        ends, widths = _ends(curve, length_m, borders), np.diff(borders)
        inside = borders[:-1, None] + widths[:, None] * shares
        straight = ends[:, :1] + shares * (ends[:, 1:] - ends[:, :1])
        off = np.max(np.abs(curve.mean(inside, length_m, inside) - straight), axis=1)
        allowed = 0.8 * CURVE_TOLERANCE * max(np.max(ends), 1e-300)
        parts = np.where(widths > 2 * SHORTEST_SECTION_M, np.ceil(np.sqrt(off / allowed)), 1).astype(int)
        if np.all(parts <= 1):
            break
        further = [np.linspace(a, b, n + 1)[1:-1] for a, b, n in zip(borders[:-1], borders[1:], parts, strict=True)
                   if n > 1]
        borders = np.unique(np.concatenate((borders, *further)))
    return borders


def _merged(course: Course) -> Course:
    """The same course without the borders at which nothing changes."""
    rows = np.concatenate((course.force_n, course.drag), axis=1)
    # Rounding of the means over a train is some 1e-12 of the largest value.
    equal = 1e-10 * np.max(np.abs(rows), axis=0)[[0, 0, 2, 2]]
    kept, first = [0], 0
    for k in range(1, len(rows)):
        start, cut, end = course.position_m[first], course.position_m[k], course.position_m[k + 1]
        low, high = rows[first, [0, 2]], rows[k, [1, 3]]
        straight = np.repeat(low + (cut - start) / (end - start) * (high - low), 2)
        both = np.stack((rows[k - 1, [1, 3]], rows[k, [0, 2]]), axis=1).ravel()
        if (course.limit_mps[k] != course.limit_mps[k - 1] or course.position_m[k] in course.stops_m
                or np.any(np.abs(both - straight) > equal)):
            kept.append(k)
            first = k
    last = [*(k - 1 for k in kept[1:]), len(rows) - 1]
    return Course(course.position_m[[*kept, len(rows)]], course.limit_mps[kept],
                  np.stack((course.force_n[kept, 0], course.force_n[last, 1]), axis=1),
                  np.stack((course.drag[kept, 0], course.drag[last, 1]), axis=1), course.stops_m)

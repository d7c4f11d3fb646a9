"""Re-checks a bound's certificate in exact arithmetic. Standard library only; knows nothing of the optimiser.

A certificate holds the run (borders, limits, forces and drag of the line, stops and points, inertia and the speeds at
both ends), the train (resistance, limits of its forces, efficiencies), the events of the timetable with the price of
each, and p(s): its borders, and its values at both ends of each cell between them. Nothing else enters: what bound.py
says is made here. For both ends of each cell and each range of speeds a value is found that lies below inverse / v +
constant + slope v + square v^2 for every v of the range, whose coefficients come from the train, the line and p(s) with
one of the train's limits for each force, the same at both ends of a cell. Neighbouring ranges of one formula are one.
The bound is the sum of each cell's length times the mean of its two ends' least value, the line's part, that of the
ends, the jumps of p at the worst speed that each place allows, and the windows at their prices; a second costs on a
cell what the events that lie ahead of it make of it, with what auxiliaries draw from the first departure to the last
arrival.

Where the least value lies is looked for in floating point. That it is none too high is shown in whole numbers: times v
the formula less the value is a cubic that must not be negative, which is (v - v0)^2 times a line plus another line,
both not negative at the range's ends; or its Bernstein coefficients say so, on pieces that are halved until they do.
Numbers of the file count to 2^-60 of their unit and p to 2^-50; what is made of them is rounded towards a lower bound.
Digests say which line, train and times these are; whoever has their files can tell whether they are his.
"""

from __future__ import annotations

import hashlib
import json
import math
import sys
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

VERSION = 4
KEYS = {"version", "digests", "run", "train", "p", "origin_s", "auxiliary_w", "events", "lower_bound_J"}
# In bytes, cells, ranges of speed, and looks at a range or a piece of it: no certificate comes near them.
LARGEST, MOST_CELLS, MOST_RANGES, MOST_LOOKS, MOST_HALVINGS = 64 * 2**20, 100_000, 2_000, 3_000_000, 60
DEEPEST, HUGE, FASTEST = 6, 1e18, 200
TEXTS = ("digests", "kind")
# That a tunnel's drag is linear along a cell, as a share.
DRAG_NEAR = Fraction(1, 10**9)
# Binary digits behind the point: of numbers of the file, of p, of the formulas' coefficients and values, of energy.
FINE, OF_P = 60, 50
OF_VALUE, OF_ENERGY = OF_P + FINE, OF_P + 2 * FINE
# Ranges of speed on which a limit of the acceleration is held against those of the forces, and halvings by which the
# speed at which it passes one is found in each.
SPEED_RANGES, CROSSING_HALVINGS = 4, 30
# By so much what one brake leaves to the other is taken above itself, to 2^-FINE N, so that rounding does not make it
# negative.
LIFTED = 1 << 40
# A value is claimed one of these shares below what was found: of what it is the sum of there, or at the highest speed.
SLACKS = (1e-12, 1e-10, 1e-8, 1e-6)

Four = tuple[int, int, int, int]  # of 1 / v, 1, v and v^2, to 2^-OF_VALUE or, of the train's limits, to 2^-FINE


def _near(value: float | Fraction, digits: int = FINE) -> int:
    """A number as a multiple of 2^-digits that is not above it."""
    one, two = value.as_integer_ratio()
    return (one << digits) // two


def _above(value: float | Fraction, digits: int = FINE) -> int:
    return -_near(-value, digits)


def checked_bound(certificate: dict[str, Any]) -> Fraction:
    """The bound in J that the certificate proves; raises ValueError with the reason when it proves none."""
    if certificate.get("version") != VERSION:
        raise ValueError(f"is of version {certificate.get('version')!r}, not {VERSION}: write it again")
    if not set(certificate) <= KEYS:
        raise ValueError(f"has a part that no certificate has: {min(set(certificate) - KEYS)[:80]!r}")
    _require_plain_numbers(certificate)
    if certificate["digests"] != stated_digests(certificate):
        raise ValueError("its digests are not those of the line, train and times in it")
    run, p = certificate["run"], certificate["p"]
    if p.keys() != {"position_m", "left", "right"}:
        raise ValueError("p(s) has another part than its borders and its values at both sides of them")
    cells = list(_cells(run, p))
    train = _Train(certificate, max(cell.limit for cell in cells))
    auxiliary = Fraction(certificate.get("auxiliary_w", 0))
    if auxiliary > Fraction(certificate["train"]["auxiliary_w"]):
        raise ValueError("counts more auxiliaries than the train draws")
    legs, time_part = _legs(certificate["events"], Fraction(certificate["origin_s"]), auxiliary)
    if not legs or legs[-1][0] != cells[-1].b:
        raise ValueError("the cells do not end at the last event")
    total = _near(time_part, OF_ENERGY) + _line_part(run, cells) + _ends_and_jumps(run, train, cells)
    if len(cells) * len(train.ranges) * train.crossings > MOST_LOOKS:
        raise ValueError(f"needs more than {MOST_LOOKS} looks at ranges of speed")
    looks = [0]
    for cell, price in zip(cells, _prices(legs, cells), strict=True):
        total += (cell.b - cell.a) * sum(_least(train, cell, price, looks)) // 2
    return Fraction(total, 2**OF_ENERGY)


def _require_plain_numbers(part: Any, name: str = "", depth: int = 0) -> None:
    """Raises ValueError for numbers that no train, line or timetable has, also as texts, which may be as large as
    they like to a fraction, and for what is nested deeper than a certificate is."""
    if depth > DEEPEST:
        raise ValueError("is nested too deeply")
    if isinstance(part, dict):
        for key, inner in part.items():
            _require_plain_numbers(inner, name if name in TEXTS else key, depth + 1)
    elif isinstance(part, list):
        for inner in part:
            _require_plain_numbers(inner, name, depth + 1)
    elif (isinstance(part, str) and name not in TEXTS) or (isinstance(part, bool) and name != "waits"):
        raise ValueError(f"{name[:80]!r} holds a text or a truth value where a number belongs")
    elif isinstance(part, int | float) and not -HUGE < part < HUGE:
        raise ValueError(f"holds a number that is not between -{HUGE:g} and {HUGE:g}")


def stated_digests(certificate: dict[str, Any]) -> dict[str, str]:
    """The sha256 of line, train and times as they stand in a certificate: canonical JSON, keys sorted, no spaces."""
    run, events = certificate["run"], certificate["events"]
    ends = ("inertia_kg", "start_mps", "end_mps")
    parts = {"line": {name: value for name, value in run.items() if name not in ends},
             "train": certificate["train"] | {"inertia_kg": run["inertia_kg"]},
             "times": [[{name: value for name, value in event.items() if name != "price_w"} for event in events],
                       certificate["origin_s"], run["start_mps"], run["end_mps"]]}
    return {name: hashlib.sha256(json.dumps(part, sort_keys=True, separators=(",", ":"), allow_nan=False).encode())
            .hexdigest() for name, part in parts.items()}


class _Range(NamedTuple):
    """Speeds from low to high, and limits there, to 2^-FINE: of traction, of the electric brake, and of friction beside
    it."""

    low: int
    high: int
    pull: Four
    electric: Four
    friction: Four


class _Train:
    """Its resistance, limits and prices of force, to 2^-FINE, and ranges of speed up to the line's highest limit."""

    def __init__(self, certificate: dict[str, Any], top: int) -> None:
        train = certificate["train"]
        efficiency, returned = train["traction_efficiency"], train["regenerative_efficiency"]
        inertia_kg = certificate["run"]["inertia_kg"]
        self.inertia = _near(inertia_kg)
        self.a, self.b, self.c = (_near(value) for value in train["davis_n"])
        self.friction = _near(train["friction_brake_n"])
        if min(self.a, self.b, self.c, self.friction) < 0 or not 0 < efficiency <= 1 or not 0 <= returned <= 1:
            raise ValueError("the train's resistance, brakes or efficiencies are no train's")
        if self.inertia <= 0:
            raise ValueError("line, train and p(s) do not fit each other")
        self.pull_from, self.returned = _near(1 / Fraction(efficiency), OF_P), _above(returned, OF_P)
        fastest, hardest = (train[f"max_{name}_mps2"] for name in ("acceleration", "deceleration"))
        self.fastest = None if fastest is None else _above(Fraction(fastest) * Fraction(inertia_kg))
        self.hardest = None if hardest is None else _above(Fraction(hardest) * Fraction(inertia_kg))
        is_limited = fastest is not None or hardest is not None
        self.ranges = tuple(_ranges(train, top, is_limited, self.friction))
        self.crossings = 4 if is_limited else 1


def _ranges(train: dict[str, Any], top: int, is_limited: bool, friction: int) -> Iterator[_Range]:
    fast = top / 2**FINE
    borders = {0, top, *(top * k // SPEED_RANGES for k in range(1, SPEED_RANGES) if is_limited)}
    rows = train.get("braking_table") or []
    both = {"force_n": max(row[1] for row in rows), "power_w": None, "table": rows} if rows else None
    for limit in (train["traction"], train["regenerative"], both):
        borders |= {at for at in _changes(limit, fast) if 0 < at < top} if limit else set()
    if both:
        for low, high in pairwise(sorted(borders)):
            left = _less(_limit(both, low, high), _limit(train["regenerative"], low, high))
            borders |= {*_zeros(left, low, high), *_zeros(_less(left, (0, friction, 0, 0)), low, high)}
    if len(borders) > MOST_RANGES:
        raise ValueError(f"has more than {MOST_RANGES} ranges of speed")
    for low, high in pairwise(sorted(borders)):
        electric, beside = _limit(train["regenerative"], low, high), (0, friction, 0, 0)
        if both:
            electric, beside = _brakes(electric, _limit(both, low, high), beside, low, high)
        yield _Range(low, high, _limit(train["traction"], low, high), electric, beside)


def _brakes(electric: Four, both: Four, friction: Four, low: int, high: int) -> tuple[Four, Four]:
    """Limits of the electric brake and of friction where both together have one. A newton of the electric brake gains
    no less than one of friction, so that any of three pairs bounds what is gained: no limit of both; all of it
    electric; the electric brake full and friction what that leaves, where it is not negative: it bends downwards, so
    that the ends of the range tell."""
    a, b, c, d = _less(both, electric)
    left, v = (a, b + LIFTED, c, d), (low + high) / 2**(FINE + 1)
    if _at(left, v) <= LIFTED:
        return both, (0, 0, 0, 0)
    may = a <= 0 and d == 0 and all(at * (b + LIFTED << FINE) + (a << 2 * FINE) + c * at**2 >= 0 for at in (low, high))
    return electric, left if may and _at(left, v) < friction[1] else friction


def _zeros(apart: Four, low: int, high: int) -> Iterator[int]:
    """Speeds between two others at which a difference of limits without a square is zero or nearly so."""
    a, b, c, _ = apart
    inside = b * b - 4 * a * c
    roots = [-b + sign * math.isqrt(inside) for sign in (1, -1)] if c and inside >= 0 else []
    found = [(root << FINE) // (2 * c) for root in roots] if c else [-(a << FINE) // b] if b else []
    yield from (at for at in found if low < at < high)


def _changes(limit: dict[str, Any], fast: float) -> Iterator[int]:
    """Speeds to 2^-FINE at which a limit may change its formula: the rows of its table exactly, others nearby."""
    rows, power, force = limit["table"], limit["power_w"], limit["force_n"]
    lines = [(0.0, fast, float(force), 0.0)]
    for (v_one, one), (v_two, two) in pairwise(rows):
        slope = (two - one) / (v_two - v_one)
        lines.append((v_one, v_two, one - slope * v_one, slope))
        if slope:
            lines.append((v_one, v_two, force - one + slope * v_one, -slope))  # where the table meets the force
    yield from (_near(speed) for speed, _ in rows)
    for number, (low, high, constant, slope) in enumerate([*lines, *((0.0, fast, row[1], 0.0) for row in rows)]):
        met: list[float] = []
        if number and slope:
            met.append((force - constant) / slope)
        if power is not None and slope:
            inside = constant**2 + 4 * slope * power
            met += [(-constant + sign * math.sqrt(inside)) / (2 * slope) for sign in (1, -1)] if inside >= 0 else []
        elif power is not None and constant > 0:
            met.append(power / constant)
        yield from (_near(speed) for speed in met if low < speed < high)


def _limit(limit: dict[str, Any], low: int, high: int) -> Four:
    """A force that is never exceeded at speeds from low to high: the largest one, by the power, or by the table; of
    these the least at the middle."""
    force, power, rows, middle = limit["force_n"], limit["power_w"], limit["table"], (low + high) / 2**(FINE + 1)
    if force < 0 or (power is not None and power < 0) or any(row[1] < 0 for row in rows):
        raise ValueError("a largest force or power is negative")
    found: list[tuple[float, Four]] = [(float(force), (0, _above(force), 0, 0))]
    if power is not None:
        found.append((power / middle, (_above(power), 0, 0, 0)))
    speeds = [_near(speed) for speed, _ in rows]
    if any(two <= one for one, two in pairwise(speeds)):
        raise ValueError("a table's speeds do not increase")
    for at, row in ((0, high <= speeds[0]), (-1, low >= speeds[-1])) if rows else ():
        if row:
            found.append((float(rows[at][1]), (0, _above(rows[at][1]), 0, 0)))
    for (v_one, v_two), ((_, one), (_, two)) in zip(pairwise(speeds), pairwise(rows), strict=True):
        if v_one <= low and high <= v_two:
            slope = _above((Fraction(two) - Fraction(one)) * 2**FINE / (v_two - v_one))
            constant = _above(one) - (slope * v_one >> FINE)
            found.append(((constant + slope * middle) / 2**FINE, (0, constant, slope, 0)))
    return min(found)[1]


class _Cell(NamedTuple):
    """A cell from a to b in m and p at both ends; highest limit, tunnels' drag at both ends, and the line's least and
    largest force on it, all to 2^-FINE, p to 2^-OF_P."""

    a: int
    b: int
    p: tuple[int, int]
    limit: int
    drag: tuple[int, int]
    least_force: int
    most_force: int


def _at(limit: Four, v: float) -> float:
    """About a limit's force at a speed in m/s, to 2^-FINE."""
    return (limit[0] / v if limit[0] else 0.0) + limit[1] + v * (limit[2] + v * limit[3])


def _crossings(one: _Range, high: int, apart: Four) -> Iterator[int]:
    """The speed of a range, to 2^-FINE, at which a difference of limits changes its sign, a little below it."""
    below, above = max(one.low / 2**FINE, 1e-9), high / 2**FINE
    sign = _at(apart, below) > 0
    if (_at(apart, above) > 0) == sign:
        return
    for _ in range(CROSSING_HALVINGS):
        middle = (below + above) / 2
        below, above = (middle, above) if (_at(apart, middle) > 0) == sign else (below, middle)
    yield min(max(int(below * 2**FINE), one.low), high)


def _groups(train: _Train, cell: _Cell) -> Iterator[tuple[int, int, Four, Four, Four, bool]]:
    """Ranges of speed with the limits of the forces taken there: of traction, of the brakes at the price of what they
    return, and at that of friction; and whether all that is returned counts as gained. They are cut where a limit of
    the acceleration passes one of a force; neighbours of the same limits are one. Each limit is one from above, so that
    each alone is a bound from below; times what a newton costs at least, convex in p, it is concave along the cell
    where the limit is not negative."""
    nothing = 0, 0, 0, 0
    least_p, most_p = min(cell.p), max(cell.p)
    pulls, regains, rubs = most_p > train.pull_from, least_p < train.returned, least_p < 0
    top = 0, train.a + cell.most_force + (train.fastest or 0), train.b, train.c + max(cell.drag) + 1
    hardest = 0, (train.hardest or 0) - train.a - cell.least_force, -train.b, -train.c - min(cell.drag)
    middle_p = (cell.p[0] + cell.p[1]) / 2**(OF_P + 1)
    back = train.returned / 2**OF_P
    regain, rub = max(back - middle_p, 0.0), max(-middle_p, 0.0)
    may_top, may_brake = pulls and train.fastest is not None and top[1] >= 0, regains and train.hardest is not None
    kept: tuple[Four, Four, Four, bool] | None = None
    start = 0
    for one in train.ranges:
        if one.low >= cell.limit:
            break
        end = min(one.high, cell.limit)
        apart = [_less(top, one.pull)] if may_top else []
        if may_brake:
            apart += [hardest, _less(hardest, one.electric), _less(hardest, one.electric, one.friction)]
        for low, high in pairwise(sorted({one.low, end, *(at for of in apart for at in _crossings(one, end, of))})):
            v = (low + high) / 2**(FINE + 1)
            pull = top if may_top and _at(top, v) < _at(one.pull, v) else one.pull if pulls else nothing
            electric, rubbed, is_all = one.electric if regains else nothing, one.friction if rubs else nothing, False
            if may_brake and (hardest[1] << 2 * FINE) + (hardest[2] * high << FINE) + hardest[3] * high**2 >= 0:
                hard, most = _at(hardest, v), _at(one.electric, v)
                both, alone, mixed = regain * most + rub * _at(one.friction, v), regain * hard, back * most + rub * hard
                if alone < min(both, mixed):
                    electric, rubbed = hardest, nothing
                elif mixed < both:
                    rubbed, is_all = hardest, True
            found = pull, electric, rubbed, is_all
            if kept is not None and found != kept:
                yield start, low, *kept
                start = low
            kept = found
    if kept is not None:
        yield start, cell.limit, *kept


def _less(limit: Four, *others: Four) -> Four:
    """A limit less others."""
    a, b, c, d = (one - sum(of) for one, *of in zip(limit, *others, strict=True))
    return a, b, c, d


def _cells(run: dict[str, Any], p: dict[str, Any]) -> Iterator[_Cell]:
    """The cells between the borders of p, which fill the run; raises ValueError where they do not."""
    x, borders = [_near(value) for value in run["position_m"]], [_near(value) for value in p["position_m"]]
    limits, forces, drags, left, right = run["limit_mps"], run["force_n"], run["drag"], p["left"], p["right"]
    if not 0 < len(left) == len(right) == len(borders) - 1 <= MOST_CELLS or not (
            0 < len(limits) == len(forces) == len(drags) == len(x) - 1) or any(b <= a for a, b in pairwise(x)):
        raise ValueError("line, train and p(s) do not fit each other")
    if any(not 0 < limit < FASTEST for limit in limits) or not (
            0 <= run["start_mps"] < FASTEST and 0 <= run["end_mps"] < FASTEST):
        raise ValueError(f"a limit of speed is not between 0 and {FASTEST} m/s: are they in km/h?")
    if any(b <= a for a, b in pairwise(borders)) or (borders[0], borders[-1]) != (x[0], x[-1]):
        raise ValueError("the cells do not fill the run from its start to its end")
    if any(min(drag) < 0 for drag in drags):
        raise ValueError("a tunnel's drag is negative")
    section = 0
    for number, (a, b) in enumerate(pairwise(borders)):
        while x[section + 1] <= a:
            section += 1
        last = section
        while x[last + 1] < b:
            last += 1
        inside = range(section, last + 1)
        ends = [(k, max(a, x[k]), min(b, x[k + 1])) for k in inside]
        met = [_between(x, forces, k, at) for k, *both in ends for at in both]
        drag = [(at, _between(x, drags, k, at)) for k, *both in ends for at in both]
        start, stop = drag[0][1], drag[-1][1]
        for at, here in drag if start or stop or any(one for _, one in drag) else ():
            chord = start + (stop - start) * Fraction(at - a, b - a)
            if abs(here - chord) > DRAG_NEAR * (Fraction(2**FINE, 1000) + chord):
                raise ValueError(f"the cell from {a / 2**FINE:g} m crosses a change of the tunnels' drag")
        yield _Cell(a, b, (_near(left[number], OF_P), _near(right[number], OF_P)),
                    max(_above(limits[k]) for k in inside), (math.floor(start), math.floor(stop)),
                    math.floor(min(met)), math.ceil(max(met)))


def _between(x: list[int], ends: list[list[float]], section: int, at: int) -> Fraction | int:
    """At a place of a section what is linear on it, in 2^-FINE."""
    one, two = ends[section]
    first = _near(one)
    if one == two:
        return first
    return first + Fraction((_near(two) - first) * (at - x[section]), x[section + 1] - x[section])


def _line_part(run: dict[str, Any], cells: list[_Cell]) -> int:
    """The integral of p times the line's force, to 2^-OF_ENERGY."""
    x, forces, total, section = [_near(value) for value in run["position_m"]], run["force_n"], 0, 0
    for cell in cells:
        while x[section + 1] <= cell.a:
            section += 1
        here = section
        while here < len(forces) and x[here] < cell.b:
            one, two = max(cell.a, x[here]), min(cell.b, x[here + 1])
            p_one, p_two = cell.p if (one, two) == (cell.a, cell.b) else (
                cell.p[0] + Fraction((cell.p[1] - cell.p[0]) * (at - cell.a), cell.b - cell.a) for at in (one, two))
            g_one, g_two = (_between(x, forces, here, at) for at in (one, two))
            total += (two - one) * (2 * (p_one * g_one + p_two * g_two) + p_one * g_two + p_two * g_one) // 6
            here += 1
    return total


def _ends_and_jumps(run: dict[str, Any], train: _Train, cells: list[_Cell]) -> int:
    """What the speeds at both ends and the jumps of p give, these at the worst speed that line, stops and points allow,
    to 2^-OF_ENERGY."""
    start, end = _near(run["start_mps"]), _near(run["end_mps"])
    double = train.inertia * (cells[-1].p[1] * end**2 - cells[0].p[0] * start**2)
    points = {_near(position): (slowest, fastest) for position, slowest, fastest in run["points"]}
    stops = {_near(position) for position in run["stops_m"]}
    x, section = [_near(value) for value in run["position_m"]], 0
    for one, two in pairwise(cells):
        fall = one.p[1] - two.p[0]
        slowest, fastest = points.get(one.b, (0.0, None))
        while x[section + 1] < one.b:
            section += 1
        around = run["limit_mps"][section:section + 1 + (x[section + 1] == one.b)]
        top = 0.0 if one.b in stops else min(around if fastest is None else [*around, fastest])
        if not 0 <= slowest <= top:
            raise ValueError(f"between two speeds: {one.b / 2**FINE:g} m cannot be passed at those that are asked")
        double += train.inertia * fall * (_above(top) if fall < 0 else _near(slowest))**2
    return double >> FINE + 1


def _prices(legs: list[tuple[int, Fraction]], cells: list[_Cell]) -> Iterator[int]:
    """What a second costs on each cell at least, to 2^-OF_VALUE: the least of the legs that it lies on."""
    leg = 0
    for cell in cells:
        while leg < len(legs) - 1 and legs[leg][0] <= cell.a:
            leg += 1
        last = leg
        while last < len(legs) - 1 and legs[last][0] < cell.b:
            last += 1
        yield _near(min(level for _, level in legs[leg:last + 1]), OF_VALUE)


def _legs(events: list[dict[str, Any]], origin: Fraction,
          auxiliary: Fraction) -> tuple[list[tuple[int, Fraction]], Fraction]:
    """Where each leg ends with what a second costs on it, and what windows and least waits add to the bound."""
    if auxiliary < 0:
        raise ValueError("auxiliaries draw less than nothing")
    level, time_part = auxiliary, Fraction(0)
    legs: list[tuple[int, Fraction]] = []
    for number, event in reversed(list(enumerate(events))):
        price, dwell = Fraction(event["price_w"]), Fraction(event["dwell_s"])
        level += price if number else price - auxiliary  # which do not draw yet before the first departure
        limit = event["latest_s" if price > 0 else "earliest_s"]
        if level < 0 or dwell < 0 or (dwell > 0 and not event["waits"]) or (price != 0 and limit is None):
            raise ValueError(f"event {number}: price, dwell and window do not go together")
        time_part += dwell * level - (price * Fraction(limit) if price else 0)
        if not event["waits"]:
            legs.append((_near(event["position_m"]), level))
    legs.reverse()
    if not events[0]["waits"] or origin != Fraction(events[0]["earliest_s"]) or any(
            two <= one for (one, _), (two, _) in pairwise(legs)):
        raise ValueError("the events are not in order")
    return legs, time_part + origin * level


def _least(train: _Train, cell: _Cell, price: int, looks: list[int]) -> list[int]:
    """At both ends of a cell a value, to 2^-OF_VALUE, below c(u) - p u + price / v + p r(v) - p' inertia v^2 / 2 for
    every speed up to the limit and every force u that the train has there."""
    (p_a, p_b), (drag_a, drag_b) = cell.p, cell.drag
    bend = -(-max((p_b - p_a) * (drag_b - drag_a), 0) // 4)
    turn = -(-(train.inertia * (p_b - p_a) << FINE) // (2 * (cell.b - cell.a)))
    groups = list(_groups(train, cell))
    found: list[int] = []
    for p, drag in zip(cell.p, cell.drag, strict=True):
        pull, regain, rub = max(p - train.pull_from, 0), max(train.returned - p, 0), max(-p, 0)
        square = p * (train.c + drag) - abs(p) - bend - turn  # drag was rounded
        terms = []
        for low, high, traction, electric, rubbed, is_all in groups:
            gain = train.returned if is_all else regain
            terms.append((low, high, price - pull * traction[0] - gain * electric[0] - rub * rubbed[0],
                          p * train.a - pull * traction[1] - gain * electric[1] - rub * rubbed[1],
                          p * train.b - pull * traction[2] - gain * electric[2] - rub * rubbed[2],
                          square - pull * traction[3] - gain * electric[3] - rub * rubbed[3]))
        found.append(_below_all(terms, looks))
    return found


def _below_all(terms: list[tuple[int, int, int, int, int, int]], looks: list[int]) -> int:
    """A value that lies below all of them, nearly the largest one; raises ValueError where none is proven."""
    unit, fine = 2.0**-OF_VALUE, 2.0**-FINE
    lowest, size, near, places = math.inf, 0.0, 0.0, []
    for low, high, *whole in terms:
        one, two = low * fine, high * fine
        a, b, c, d = (value * unit for value in whole)
        at = _place(one, two, a, c, d)
        value = (a / at if at else math.inf if a > 0 else 0.0) + b + c * at + d * at * at
        if value < lowest:
            lowest, near = value, (abs(a) / at if at else 0.0) + abs(b) + abs(c) * at + abs(d) * at * at
        size = max(size, abs(a) / max(two, 1e-3) + abs(b) + abs(c) * two + abs(d) * two * two)
        places.append(min(max(int(at * 2**FINE), low), high))
    if not math.isfinite(lowest):
        raise ValueError("a second or a force costs so much that there is no least value")
    for less in sorted(slack * of for of in (near, size) for slack in SLACKS):
        value = int((lowest - less) * 2.0**60) << OF_VALUE - 60
        if all(_stays_above(term, value, at, looks) for term, at in zip(terms, places, strict=True)):
            return value
    raise ValueError("a least value is not proven")


def _place(low: float, high: float, a: float, c: float, d: float) -> float:
    """About where a / v + c v + d v^2 is least."""
    def rises(v: float) -> float:  # times v^2, which would hide the sign at standstill where there is no a / v
        return (c + 2 * d * v) * v * v - a if a else c + 2 * d * v

    def worth(v: float) -> float:
        return (a / v if v else math.inf if a > 0 else -math.inf if a < 0 else 0.0) + c * v + d * v * v

    ends = [low, high]
    turn = min(max(math.copysign(abs(a / d) ** (1 / 3), -a / d), low), high) if a * d < 0 else low
    for below, above in ((low, turn), (turn, high)):
        if above > below and rises(below) < 0 < rises(above):
            one, two, v = below, above, (below + above) / 2
            for _ in range(60):
                now, slope = rises(v), 2 * v * (c + 3 * d * v) if a else 2 * d
                one, two = (v, two) if now < 0 else (one, v)
                new = v - now / slope if slope else (one + two) / 2
                new = new if one < new < two else (one + two) / 2
                if abs(new - v) <= 1e-15 * v:
                    break
                v = new
            ends.append(v)
    return min(ends, key=worth)


def _stays_above(term: tuple[int, int, int, int, int, int], value: int, at: int, looks: list[int]) -> bool:
    """Whether inverse / v + constant + slope v + square v^2 is proven to be no less than the value from low to high."""
    low, high, inverse, constant, slope, square = term
    c0, c1, c2, c3 = inverse << 3 * FINE, constant - value << 2 * FINE, slope << FINE, square  # of v in 2^-FINE
    looks[0] += 1
    # (v - at)^2 (lead + c3 v) + rest + tilt v
    lead = c2 + 2 * at * c3
    tilt, rest = c1 + at * (2 * lead - at * c3), c0 - at * at * lead
    if min(lead + c3 * low, lead + c3 * high, rest + tilt * low, rest + tilt * high) >= 0:
        return True
    width = high - low
    a0 = c0 + low * (c1 + low * (c2 + low * c3))
    a1 = (c1 + low * (2 * c2 + 3 * low * c3)) * width
    a2 = (c2 + 3 * low * c3) * width**2
    pieces = [((3 * a0, 3 * a0 + a1, 3 * a0 + 2 * a1 + a2, 3 * (a0 + a1 + a2 + c3 * width**3)), 0)]
    while pieces:
        (p0, p1, p2, p3), depth = pieces.pop()
        looks[0] += 1
        if looks[0] > MOST_LOOKS:
            raise ValueError(f"needs more than {MOST_LOOKS} looks at ranges of speed")
        if min(p0, p1, p2, p3) >= 0:
            continue
        if min(p0, p3) < 0 or depth == MOST_HALVINGS:
            return False
        # Halves, times eight.
        left, inner, right = p0 + p1, p1 + p2, p2 + p3
        pieces += [((8 * p0, 4 * left, 2 * (left + inner), left + 2 * inner + right), depth + 1),
                   ((left + 2 * inner + right, 2 * (inner + right), 4 * right, 8 * p3), depth + 1)]
    return True


def _contents(path: Path) -> bytes:
    """A regular file's bytes; ValueError for a pipe or a device, which may never end, and for what is too large."""
    if not path.is_file():
        raise ValueError("is no regular file" if path.exists() else "there is no such file")
    with path.open("rb") as stream:
        found = stream.read(LARGEST + 1)
    if len(found) > LARGEST:
        raise ValueError(f"is larger than {LARGEST} bytes")
    return found


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(dict(pairs)) != len(pairs):
        raise ValueError("a key stands twice in one object")
    return dict(pairs)


def _no_number(text: str) -> Any:
    raise ValueError(f"{text} is no number")


REFUSALS = (ValueError, KeyError, IndexError, TypeError, OSError, ZeroDivisionError, OverflowError, RecursionError,
            AttributeError)  # what reading and checking a certificate raise where it proves nothing


def read_certificate(path: Path) -> dict[str, Any]:
    """A certificate's file as data; raises one of REFUSALS for a file that two readers could read as two things."""
    found: dict[str, Any] = json.loads(_contents(path), object_pairs_hook=_unique, parse_constant=_no_number)
    return found


def proven_bound(certificate: dict[str, Any]) -> Fraction:
    """The bound in J; raises one of REFUSALS unless it is the one that the certificate states, or more."""
    bound = checked_bound(certificate)
    if bound < Fraction(certificate["lower_bound_J"]):
        raise ValueError(f"it proves {float(bound):.9g} J, not {certificate['lower_bound_J']:.9g} J")
    return bound


def main(arguments: list[str]) -> int:
    """Check the files named; prints a line each; 0 when every one proves the bound that it states."""
    wrong = 0
    for name in arguments:
        try:
            certificate = read_certificate(Path(name))
            bound = proven_bound(certificate)
            of = ", ".join(f"{part} {digest[:12]}" for part, digest in certificate["digests"].items())
            line = f"{name}: proves {float(bound):.9g} J ({of})"
        except REFUSALS as trouble:
            line = f"{name}: INVALID: {trouble}"
            wrong += 1
        # A stranger's file says what it is: nothing in it may steer the terminal.
        sys.stdout.write("".join(c if c.isprintable() else " " for c in line) + "\n")
    return 1 if wrong or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

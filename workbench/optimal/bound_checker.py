"""Re-checks a bound's certificate in exact rational arithmetic. Standard library only; knows nothing of the optimiser.

A certificate holds the minimisations that the bound needs (see bound.py): for each end of each cell and each range of
speeds the value that is claimed to lie below inverse / v + constant + slope v + square v^2 for every v from low to
high. These coefficients are made here, from the train, the line and p(s); which of the train's limits they take is
said by each minimisation, the same at both ends of a cell. Times v this is a cubic that must not be negative. Its
Bernstein coefficients say so on pieces that are halved until they do. The bound is the claimed values, each cell's
length times the mean of its two ends' least, plus the fixed part, all summed as fractions.

The certificate holds the run (borders, limits, forces and drag of the line, stops and points, inertia and the speeds at
both ends), the train (resistance, limits of its forces, efficiencies) and p(s). The cells must fill the run, with the
line's limits, and the line's part, the ends' and the jumps must follow from it. Digests say which line, train and times
these are; whoever has their files can tell whether they are his.

The fixed part is held against what the events of the timetable make of it: no more than the line's and the ends'
part, the jumps at the worst speed that each place allows, and the windows at their prices; and the price of time in
every term against the sum of the prices of all events that lie ahead of its cell and of what auxiliaries draw from the
first departure to the last arrival.
"""

from __future__ import annotations

import hashlib
import json
import sys
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

MOST_HALVINGS = 60
# In bytes: no certificate comes near it.
LARGEST = 64 * 2**20
DEEPEST, HUGE, FASTEST = 6, 1e18, 200
TEXTS = ("digests", "kind")
# Of positions in m, and of sums as a share: what rounding may do.
NEAR, ROUNDED, DRAG_NEAR = Fraction(1, 10**6), Fraction(1, 10**12), Fraction(1, 10**9)


def nonnegative(coefficients: tuple[Fraction, ...], low: Fraction, high: Fraction) -> bool:
    """Whether a cubic c0 + c1 v + c2 v^2 + c3 v^3 is proven not to be negative from low to high."""
    c0, c1, c2, c3 = coefficients
    w = high - low
    # About low, then scaled to [0, 1]: a0 + a1 t + a2 t^2 + a3 t^3.
    a0 = c0 + low * (c1 + low * (c2 + low * c3))
    a1 = (c1 + low * (2 * c2 + 3 * low * c3)) * w
    a2 = (c2 + 3 * low * c3) * w * w
    a3 = c3 * w * w * w
    pieces = [((a0, a0 + a1 / 3, a0 + 2 * a1 / 3 + a2 / 3, a0 + a1 + a2 + a3), 0)]
    while pieces:
        bernstein, depth = pieces.pop()
        if min(bernstein) >= 0:
            continue
        if min(bernstein[0], bernstein[3]) < 0 or depth == MOST_HALVINGS:
            return False
        p0, p1, p2, p3 = bernstein
        q0, q1, q2 = (p0 + p1) / 2, (p1 + p2) / 2, (p2 + p3) / 2
        r0, r1 = (q0 + q1) / 2, (q1 + q2) / 2
        middle = (r0 + r1) / 2
        pieces += [((p0, q0, r0, middle), depth + 1), ((middle, r1, q2, p3), depth + 1)]
    return True


def checked_bound(certificate: dict[str, Any]) -> Fraction:
    """The bound in J that the certificate proves; raises ValueError with the reason when it proves none."""
    if certificate.get("version") != 3:
        raise ValueError("holds no line, no train and no p(s), so that nothing binds it to a run: write it again")
    _require_plain_numbers(certificate)
    if certificate["digests"] != stated_digests(certificate):
        raise ValueError("its digests are not those of the line, train and times in it")
    lengths = [Fraction(value) for value in certificate["cell_m"]]
    if not lengths or any(length <= 0 for length in lengths):
        raise ValueError("there are no cells, or a cell has no length")
    _check_run(certificate, lengths)
    cells = _cells(certificate)
    ways: list[dict[tuple[int, Fraction, Fraction], tuple[int, int, int]]] = [{}, {}]
    least: list[list[Fraction | None]] = [[None, None] for _ in lengths]
    reached: dict[tuple[int, int], Fraction] = {}
    terms = sorted(zip(*(certificate["terms"][name] for name in (
        "cell", "end", "low", "high", "value", "pull", "brake", "electric")), strict=True))
    for number, row in enumerate(terms):
        cell, end = int(row[0]), int(row[1])
        low, high, value = (Fraction(x) for x in row[2:5])
        way = int(row[5]), int(row[6]), int(row[7])
        if not 0 <= low < high or low != reached.get((cell, end), Fraction(0)):
            raise ValueError(f"term {number}: its speeds do not go on where those before it end")
        reached[cell, end] = high
        ways[end][cell, low, high] = way
        inverse, constant, slope, square = _coefficients(certificate, cells[cell], end, low, high, way)
        if not nonnegative((inverse + Fraction(certificate["cell_price_w"][cell]), constant - value, slope, square),
                           low, high):
            raise ValueError(f"term {number}: its value is not proven")
        before = least[cell][end]
        least[cell][end] = value if before is None else min(before, value)
    if ways[0] != ways[1]:
        raise ValueError("the two ends of a cell take different limits of the force")
    _check_timetable(certificate, lengths)
    total = Fraction(certificate["fixed_j"])
    for cell, (length, (left, right)) in enumerate(zip(lengths, least, strict=True)):
        top = Fraction(certificate["limit_mps"][cell])
        if left is None or right is None or min(reached[cell, 0], reached[cell, 1]) < top:
            raise ValueError(f"cell {cell}: not every speed up to its limit is looked at")
        total += length * (left + right) / 2
    return total


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
    elif isinstance(part, str) and name not in TEXTS:
        raise ValueError(f"{name[:80]!r} holds a text where a number belongs")
    elif isinstance(part, int | float) and not -HUGE < part < HUGE:
        raise ValueError(f"holds a number that is not between -{HUGE:g} and {HUGE:g}")


def _check_run(certificate: dict[str, Any], lengths: list[Fraction]) -> None:
    """Raises ValueError unless the cells fill the run without gaps, their limits are the line's, and the line's part,
    that of the ends and the jumps follow from the line's force, the inertia and p(s)."""
    run, p = certificate["run"], certificate["p"]
    inertia, start, end = (Fraction(run[name]) for name in ("inertia_kg", "start_mps", "end_mps"))
    x = [Fraction(value) for value in run["position_m"]]
    limits = [Fraction(value) for value in run["limit_mps"]]
    forces = [(Fraction(one), Fraction(two)) for one, two in run["force_n"]]
    left, right = ([Fraction(value) for value in p[side]] for side in ("left", "right"))
    if inertia <= 0 or start < 0 or end < 0 or any(b <= a for a, b in pairwise(x)) or not (
            len(x) - 1 == len(limits) == len(forces) > 0) or not len(left) == len(right) == len(lengths):
        raise ValueError("line, train and p(s) do not fit each other")
    if any(not 0 < limit < FASTEST for limit in limits) or max(start, end) >= FASTEST:
        raise ValueError(f"a limit of speed is not between 0 and {FASTEST} m/s: are they in km/h?")
    borders = [Fraction(value) for value in p["position_m"]]
    if len(borders) != len(lengths) + 1 or borders[0] != x[0] or borders[-1] != x[-1] or (
            Fraction(certificate["start_m"]) != x[0]) or any(
            abs(b - a - length) > NEAR for (a, b), length in zip(pairwise(borders), lengths, strict=True)):
        raise ValueError("the cells do not fill the run from its start to its end")
    line, section = Fraction(0), 0
    tops: list[Fraction] = []
    for (a, b), p_a, p_b in zip(pairwise(borders), left, right, strict=True):
        tops.append(Fraction(0))
        while x[section + 1] <= a:
            section += 1
        here = section
        while here < len(limits) and x[here] < b:
            tops[-1] = max(tops[-1], limits[here])
            one, two = max(a, x[here]), min(b, x[here + 1])
            p_one, p_two = (p_a + (p_b - p_a) * (at - a) / (b - a) for at in (one, two))
            g_one, g_two = (forces[here][0] + (forces[here][1] - forces[here][0]) * (at - x[here])
                            / (x[here + 1] - x[here]) for at in (one, two))
            line += (two - one) * ((p_one * g_one + p_two * g_two) / 3 + (p_one * g_two + p_two * g_one) / 6)
            here += 1
    if any(Fraction(stated) < top for stated, top in zip(certificate["limit_mps"], tops, strict=True)):
        raise ValueError("a cell's limit of speed is lower than the line's")
    ends = inertia * (right[-1] * end**2 - left[0] * start**2) / 2
    for name, found in (("line_j", line), ("ends_j", ends)):
        if Fraction(certificate[name]) > found + abs(found) * ROUNDED:
            raise ValueError(f"{name} is more than line and p(s) give")
    for number, stated in enumerate(certificate["jumps"]["inertia_times_fall"]):
        found = inertia * (right[number] - left[number + 1])
        if Fraction(stated) > found + inertia * (abs(right[number]) + abs(left[number + 1])) * ROUNDED:
            raise ValueError(f"jump {number} is more than p(s) gives")


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


class _Cell:
    """p and the tunnels' drag at both ends of a cell, the slope of p, and the extremes of the line's force."""

    def __init__(self, run: dict[str, Any], a: Fraction, b: Fraction, p: tuple[Fraction, Fraction]) -> None:
        borders = [Fraction(value) for value in run["position_m"]]
        forces: list[Fraction] = []
        drags: list[tuple[Fraction, Fraction]] = []  # place, and drag there
        for (start, end), force, drag in zip(pairwise(borders), run["force_n"], run["drag"], strict=True):
            for at in (max(a, start), min(b, end)) if start < b and end > a else ():
                share = (at - start) / (end - start)
                forces.append(Fraction(force[0]) + share * (Fraction(force[1]) - Fraction(force[0])))
                drags.append((at, Fraction(drag[0]) + share * (Fraction(drag[1]) - Fraction(drag[0]))))
        self.p, self.slope = p, (p[1] - p[0]) / (b - a)
        self.drag = drags[0][1], drags[-1][1]
        self.least_force, self.most_force = min(forces), max(forces)
        if any(found < 0 for _, found in drags):
            raise ValueError("a tunnel's drag is negative")
        for at, found in drags:
            chord = self.drag[0] + (at - a) / (b - a) * (self.drag[1] - self.drag[0])
            if abs(found - chord) > DRAG_NEAR * (Fraction(1, 1000) + chord):
                raise ValueError(f"the cell from {float(a):g} m crosses a change of the tunnels' drag")


def _cells(certificate: dict[str, Any]) -> list[_Cell]:
    p = certificate["p"]
    borders = [Fraction(value) for value in p["position_m"]]
    return [_Cell(certificate["run"], a, b, (Fraction(left), Fraction(right)))
            for (a, b), left, right in zip(pairwise(borders), p["left"], p["right"], strict=True)]


Coefficients = tuple[Fraction, Fraction, Fraction, Fraction]  # of 1 / v, 1, v and v^2


def _coefficients(certificate: dict[str, Any], cell: _Cell, end: int, low: Fraction, high: Fraction,
                  way: tuple[int, int, int]) -> Coefficients:
    """What lies below c(u) - p u + p r(v) - p' inertia v^2 / 2 for every force u that the train has at v.

    Each limit of a force is one from above, so that each alone is a bound from below; times what a newton costs at
    least, which is convex in p, it is concave along the cell where the limit is not negative.
    """
    train, inertia, p = certificate["train"], Fraction(certificate["run"]["inertia_kg"]), cell.p[end]
    a, b, c = (Fraction(value) for value in train["davis_n"])
    efficiency, returned = Fraction(train["traction_efficiency"]), Fraction(train["regenerative_efficiency"])
    friction = Fraction(train["friction_brake_n"])
    if min(a, b, c, friction) < 0 or not 0 < efficiency <= 1 or not 0 <= returned <= 1:
        raise ValueError("the train's resistance, brakes or efficiencies are no train's")
    pull, regain, rub = max(p - 1 / efficiency, Fraction(0)), max(returned - p, Fraction(0)), max(-p, Fraction(0))
    bend = max((cell.p[1] - cell.p[0]) * (cell.drag[1] - cell.drag[0]), Fraction(0)) / 4
    total = (Fraction(0), p * a, p * b, p * (c + cell.drag[end]) - bend - inertia * cell.slope / 2)
    if way[0] == 3:
        top = a + cell.most_force + inertia * Fraction(train["max_acceleration_mps2"])
        if top < 0:
            raise ValueError("the acceleration is limited where no force is needed for it")
        total = _plus(total, (Fraction(0), top, b, c + max(cell.drag)), -pull)
    else:
        total = _plus(total, _limit(train["traction"], way[0], low, high), -pull)
    hardest = (Fraction(0), Fraction(0), Fraction(0), Fraction(0))
    if way[1] in (1, 2):
        least = a + cell.least_force - inertia * Fraction(train["max_deceleration_mps2"])
        square = c + min(cell.drag)
        if least + b * high + square * high**2 > 0:
            raise ValueError("the deceleration is limited where no brake is needed for it")
        hardest = Fraction(0), least, b, square
    if way[1] == 1:
        return _plus(total, hardest, regain)
    electric = _limit(train["regenerative"], way[2], low, high)
    if way[1] == 2:
        return _plus(_plus(total, hardest, rub), electric, -returned)
    if way[1] != 0:
        raise ValueError("a minimisation takes no limit of the brakes")
    return _plus(_plus(total, electric, -regain), (Fraction(0), friction, Fraction(0), Fraction(0)), -rub)


def _plus(one: Coefficients, two: Coefficients, share: Fraction) -> Coefficients:
    inverse, constant, slope, square = (x + share * y for x, y in zip(one, two, strict=True))
    return inverse, constant, slope, square


def _limit(limit: dict[str, Any], kind: int, low: Fraction, high: Fraction) -> Coefficients:
    """A force that is never exceeded at speeds from low to high: the largest one, by the power, or by the table."""
    zero = Fraction(0)
    if kind == 0 and Fraction(limit["force_n"]) >= 0:
        return zero, Fraction(limit["force_n"]), zero, zero
    if kind == 1 and Fraction(limit["power_w"]) >= 0:
        return Fraction(limit["power_w"]), zero, zero, zero
    rows = [(Fraction(speed), Fraction(force)) for speed, force in limit["table"]] if kind == 2 else []
    if any(force < 0 for _, force in rows):
        raise ValueError("a force in a table is negative")
    if rows and high <= rows[0][0]:
        return zero, rows[0][1], zero, zero
    if rows and low >= rows[-1][0]:
        return zero, rows[-1][1], zero, zero
    for (v_one, one), (v_two, two) in pairwise(rows):
        if v_one <= low and high <= v_two:
            slope = (two - one) / (v_two - v_one)
            return zero, one - slope * v_one, slope, zero
    raise ValueError("a minimisation takes a limit that the train does not have at its speeds")


def _check_timetable(certificate: dict[str, Any], lengths: list[Fraction]) -> None:
    """Raises ValueError unless the prices of time and the fixed part follow from the events and the jumps."""
    legs, time_part = _legs(certificate["events"], Fraction(certificate["origin_s"]),
                            Fraction(certificate.get("auxiliary_w", 0)))
    prices = [Fraction(price) for price in certificate["cell_price_w"]]
    if len(prices) != len(lengths):
        raise ValueError("not every cell has a price of time")
    if Fraction(certificate.get("auxiliary_w", 0)) > Fraction(certificate["train"]["auxiliary_w"]):
        raise ValueError("counts more auxiliaries than the train draws")
    _check_prices(legs, Fraction(certificate["start_m"]), lengths, prices)
    fixed = (Fraction(certificate["line_j"]) + Fraction(certificate["ends_j"]) + time_part
             + _jumps(certificate, len(lengths) - 1))
    if Fraction(certificate["fixed_j"]) > fixed:
        raise ValueError("the fixed part is more than windows, jumps, line and ends give")


def _legs(events: list[dict[str, Any]], origin: Fraction,
          auxiliary: Fraction) -> tuple[list[tuple[Fraction, Fraction]], Fraction]:
    """Where each leg ends with what a second costs on it, and what windows and least waits add to the bound."""
    if auxiliary < 0:
        raise ValueError("auxiliaries draw less than nothing")
    level, time_part = auxiliary, Fraction(0)
    legs: list[tuple[Fraction, Fraction]] = []
    for number, event in reversed(list(enumerate(events))):
        price, dwell = Fraction(event["price_w"]), Fraction(event["dwell_s"])
        level += price if number else price - auxiliary  # which do not draw yet before the first departure
        limit = event["latest_s" if price > 0 else "earliest_s"]
        if level < 0 or dwell < 0 or (dwell > 0 and not event["waits"]) or (price != 0 and limit is None):
            raise ValueError(f"event {number}: price, dwell and window do not go together")
        time_part += dwell * level - (price * Fraction(limit) if price else 0)
        if not event["waits"]:
            legs.insert(0, (Fraction(event["position_m"]), level))
    if not events[0]["waits"] or origin != Fraction(events[0]["earliest_s"]) or any(
            two <= one for (one, _), (two, _) in pairwise(legs)):
        raise ValueError("the events are not in order")
    return legs, time_part + origin * level


def _check_prices(legs: list[tuple[Fraction, Fraction]], start: Fraction, lengths: list[Fraction],
                  prices: list[Fraction]) -> None:
    """Raises ValueError where a cell takes more for a second than a leg that it lies on."""
    # Lengths are rounded differences of positions, so that a border may lie beside an event's by a little.
    near, leg = Fraction(1, 10**6), 0
    for cell, (length, price) in enumerate(zip(lengths, prices, strict=True)):
        while leg < len(legs) - 1 and legs[leg][0] <= start + near:
            leg += 1
        last = leg
        while last < len(legs) - 1 and legs[last][0] < start + length - near:
            last += 1
        if price > min(level for _, level in legs[leg:last + 1]):
            raise ValueError(f"cell {cell}: its price of time is more than the events ahead of it give")
        start += length
    if abs(start - legs[-1][0]) > near:
        raise ValueError("the cells do not end at the last event")


def _jumps(certificate: dict[str, Any], count: int) -> Fraction:
    """All jumps at the worst speed each, which line, stops and points give."""
    jumps, run = certificate["jumps"], certificate["run"]
    points = {position: (slowest, fastest) for position, slowest, fastest in run["points"]}
    for border, low, high in zip(certificate["p"]["position_m"][1:-1], jumps["slowest_mps"], jumps["fastest_mps"],
                                 strict=True):
        slowest, fastest = points.get(border, (0.0, None))
        tops = [limit for limit, a, b in zip(run["limit_mps"], run["position_m"], run["position_m"][1:], strict=False)
                if a <= border <= b]
        top = 0.0 if border in run["stops_m"] else min(tops if fastest is None else [*tops, fastest])
        if low > slowest or high < top:
            raise ValueError(f"the speeds of the jump at {border} m are not those of line, stops and points")
    rows = list(zip(*(map(Fraction, jumps[name]) for name in ("inertia_times_fall", "slowest_mps", "fastest_mps")),
                    strict=True))
    if len(rows) != count or any(not 0 <= slowest <= fastest for _, slowest, fastest in rows):
        raise ValueError("the jumps are not one at each border, between two speeds")
    return sum((fall * (fastest if fall < 0 else slowest) ** 2 / 2 for fall, slowest, fastest in rows), Fraction(0))


def _contents(path: Path) -> bytes:
    """A regular file's bytes; ValueError for a pipe or a device, which may never end, and for what is too large."""
    if not path.is_file():
        raise ValueError("is no regular file")
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
            sys.stdout.write(f"{name}: proves {float(bound):.9g} J ({of})\n")
        except REFUSALS as trouble:
            sys.stdout.write(f"{name}: INVALID: {trouble}\n")
            wrong += 1
    return 1 if wrong or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

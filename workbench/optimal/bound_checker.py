"""Re-checks a bound's certificate in exact rational arithmetic. Standard library only; knows nothing of the optimiser.

A certificate holds the minimisations that the bound needs (see bound.py), each as numbers inverse, constant, slope,
square, low, high and the value that is claimed to lie below inverse / v + constant + slope v + square v^2 for every v
from low to high. Times v this is a cubic that must not be negative. Its Bernstein coefficients say so on pieces that
are halved until they do. The bound is the claimed values, each cell's length times the mean of its two ends' least,
plus the fixed part, all summed as fractions.

The certificate holds the run: borders, limits and forces of the line, inertia and the speeds at both ends, and p(s).
The cells must fill it, with the line's limits, and the line's part, the ends' and the jumps must follow from it. What
it does not hold are the train's forces and Davis values: the minimisations' coefficients are taken as they stand.

The fixed part is held against what the events of the timetable make of it: no more than the line's and the ends'
part, the jumps at the worst speed that each place allows, and the windows at their prices; and the price of time in
every term against the sum of the prices of all events that lie ahead of its cell and of what auxiliaries draw from the
first departure to the last arrival.
"""

from __future__ import annotations

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
# Of positions in m, and of sums as a share: what rounding may do.
NEAR, ROUNDED = Fraction(1, 10**6), Fraction(1, 10**12)


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
    if certificate.get("version") != 2:
        raise ValueError("holds no line, no train and no p(s), so that nothing binds it to a run: write it again")
    _require_plain_numbers(certificate)
    lengths = [Fraction(value) for value in certificate["cell_m"]]
    if not lengths or any(length <= 0 for length in lengths):
        raise ValueError("there are no cells, or a cell has no length")
    _check_run(certificate, lengths)
    least: list[list[Fraction | None]] = [[None, None] for _ in lengths]
    reached: dict[tuple[int, int], Fraction] = {}
    terms = sorted(zip(*(certificate["terms"][name] for name in (
        "cell", "end", "low", "high", "inverse", "constant", "slope", "square", "value")), strict=True))
    for number, row in enumerate(terms):
        cell, end = int(row[0]), int(row[1])
        low, high, inverse, constant, slope, square, value = (Fraction(x) for x in row[2:])
        if not 0 <= low < high or low != reached.get((cell, end), Fraction(0)):
            raise ValueError(f"term {number}: its speeds do not go on where those before it end")
        reached[cell, end] = high
        if not nonnegative((inverse, constant - value, slope, square), low, high):
            raise ValueError(f"term {number}: its value is not proven")
        before = least[cell][end]
        least[cell][end] = value if before is None else min(before, value)
    _check_timetable(certificate, lengths)
    total = Fraction(certificate["fixed_j"])
    for cell, (length, (left, right)) in enumerate(zip(lengths, least, strict=True)):
        top = Fraction(certificate["limit_mps"][cell])
        if left is None or right is None or min(reached[cell, 0], reached[cell, 1]) < top:
            raise ValueError(f"cell {cell}: not every speed up to its limit is looked at")
        total += length * (left + right) / 2
    return total


def _require_plain_numbers(part: Any, depth: int = 0) -> None:
    """Raises ValueError for numbers that no train, line or timetable has, and for what is nested deeper than a
    certificate is."""
    if depth > DEEPEST:
        raise ValueError("is nested too deeply")
    if isinstance(part, dict | list):
        for inner in part.values() if isinstance(part, dict) else part:
            _require_plain_numbers(inner, depth + 1)
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


def _check_timetable(certificate: dict[str, Any], lengths: list[Fraction]) -> None:
    """Raises ValueError unless the prices of time and the fixed part follow from the events and the jumps."""
    legs, time_part = _legs(certificate["events"], Fraction(certificate["origin_s"]),
                            Fraction(certificate.get("auxiliary_w", 0)))
    prices = [Fraction(price) for price in certificate["cell_price_w"]]
    if len(prices) != len(lengths):
        raise ValueError("not every cell has a price of time")
    _check_prices(legs, Fraction(certificate["start_m"]), lengths, prices)
    terms = certificate["terms"]
    for number, (cell, inverse, force) in enumerate(zip(terms["cell"], terms["inverse"], terms["of_force"],
                                                        strict=True)):
        if Fraction(inverse) > prices[cell] + Fraction(force):
            raise ValueError(f"term {number}: takes more for time than its cell's price")
    fixed = (Fraction(certificate["line_j"]) + Fraction(certificate["ends_j"]) + time_part
             + _jumps(certificate["jumps"], len(lengths) - 1))
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


def _jumps(jumps: dict[str, Any], count: int) -> Fraction:
    """All jumps at the worst speed each."""
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


def main(arguments: list[str]) -> int:
    """Check the files named; prints a line each; 0 when every one proves the bound that it states."""
    wrong = 0
    for name in arguments:
        try:
            certificate = json.loads(_contents(Path(name)), object_pairs_hook=_unique, parse_constant=_no_number)
            bound = checked_bound(certificate)
            if bound < Fraction(certificate["lower_bound_J"]):
                raise ValueError(f"it proves {float(bound):.9g} J, not {certificate['lower_bound_J']:.9g} J")
            sys.stdout.write(f"{name}: proves {float(bound):.9g} J\n")
        except (ValueError, KeyError, IndexError, TypeError, OSError, ZeroDivisionError, OverflowError,
                RecursionError, AttributeError) as trouble:
            sys.stdout.write(f"{name}: INVALID: {trouble}\n")
            wrong += 1
    return 1 if wrong or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

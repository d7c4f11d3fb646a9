"""Re-checks a bound's certificate in exact rational arithmetic. Standard library only; knows nothing of the optimiser.

A certificate holds the minimisations that the bound needs (see bound.py), each as numbers inverse, constant, slope,
square, low, high and the value that is claimed to lie below inverse / v + constant + slope v + square v^2 for every v
from low to high. Times v this is a cubic that must not be negative. Its Bernstein coefficients say so on pieces that
are halved until they do. The bound is the claimed values, each cell's length times the mean of its two ends' least,
plus the fixed part, all summed as fractions.
"""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

MOST_HALVINGS = 60


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
    lengths = [Fraction(value) for value in certificate["cell_m"]]
    if any(length <= 0 for length in lengths):
        raise ValueError("a cell has no length")
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
    total = Fraction(certificate["fixed_j"])
    for cell, (length, (left, right)) in enumerate(zip(lengths, least, strict=True)):
        top = Fraction(certificate["limit_mps"][cell])
        if left is None or right is None or min(reached[cell, 0], reached[cell, 1]) < top:
            raise ValueError(f"cell {cell}: not every speed up to its limit is looked at")
        total += length * (left + right) / 2
    return total


def main(arguments: list[str]) -> int:
    """Check the files named; prints a line each; 0 when every one proves the bound that it states."""
    wrong = 0
    for name in arguments:
        try:
            certificate = json.loads(Path(name).read_text(encoding="utf-8"))
            bound = checked_bound(certificate)
            if bound < Fraction(certificate["lower_bound_J"]):
                raise ValueError(f"it proves {float(bound):.9g} J, not {certificate['lower_bound_J']:.9g} J")
            sys.stdout.write(f"{name}: proves {float(bound):.9g} J\n")
        except (ValueError, KeyError, IndexError, TypeError, OSError, ZeroDivisionError, OverflowError) as trouble:
            sys.stdout.write(f"{name}: INVALID: {trouble}\n")
            wrong += 1
    return 1 if wrong or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

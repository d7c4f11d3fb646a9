"""A goal as the checker reads it, read once for all points that are looked at exactly."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from workbench.proof.checker import (
    SUM,
    CertificateError,
    Context,
    Poly,
    Ratio,
    bounds,
    margin,
    number,
    read_goal,
    same,
    start_at,
    substitute,
)

Point = dict[str, Fraction]
Bounds = tuple[Fraction, Fraction]


class Exact:
    """The goal's relations at rational points; CertificateError when the goal cannot be read."""

    def __init__(self, record: dict[str, Any]) -> None:
        self.context, given = read_goal(record)
        self.given = [_Relation(self.context, text) for text in (*record["assume"], *record.get("always", []))]
        self.shown = [_Relation(self.context, text) for text in record["show"]]
        self.initial = given.initial

    def meets(self, point: Point) -> bool:
        """Whether all assumptions hold, at time zero where initial values are named."""
        values = {name: number(value) for name, value in point.items()}
        try:
            if not all(same(values[name], start_at(self.context, v, values, None)) for name, v in self.initial.items()):
                return False
            return all(relation.holds(point) for relation in self.given)
        except CertificateError:
            return False

    def breaks(self, point: Point) -> bool:
        """Whether all assumptions hold and a relation shown does not, all of them being defined."""
        if not self.meets(point):  # first, as derivatives in what is shown cost more
            return False
        try:
            outcomes = [relation.holds(point) for relation in self.shown]  # all of them: each must be defined
            return not all(outcomes)
        except CertificateError:
            return False


class _Relation:
    """A relation, read when it is first looked at."""

    def __init__(self, context: Context, text: str) -> None:
        self._context, self._text = context, text
        self._read: tuple[list[tuple[Ratio, str]], Ratio, str] | None = None

    def holds(self, point: Point) -> bool:
        """Whether it holds at a point; CertificateError where it is undefined or the enclosure cannot tell."""
        if self._read is None:
            places = self._context.partial_operations(self._text)
            parts = [(self._context.node(part), wanted) for part, wanted in places]
            self._read = parts, *margin(self._context, self._text)
        parts, value, operator = self._read
        for part, wanted in parts:
            low, high = _value(self._context, part, point)
            if not (low > 0 or (wanted == "non-zero" and high < 0) or (wanted == "non-negative" and low == 0)):
                raise CertificateError("undefined at the point")
        low, high = _value(self._context, value, point)
        true, false = {">": (low > 0, high <= 0), ">=": (low >= 0, high < 0),
                       "==": (low == high == 0, low > 0 or high < 0),
                       "!=": (low > 0 or high < 0, low == high == 0)}[operator]
        if not (true or false):
            raise CertificateError("the enclosure at the point is too wide to decide")
        return true


def _value(context: Context, value: Ratio, point: Point) -> Bounds:
    """Bounds of a value at a point, where sums have one term; both are the value where no function stands in it."""
    if any(atom in context.functions for m in (*value.num, *value.den) for atom, _ in m):
        before = len(context.functions)
        try:
            return bounds(context, substitute(context, value, {name: number(v) for name, v in point.items()}))
        finally:  # functions of this point's numbers serve no other point
            for atom in list(context.functions)[before:]:
                del context.functions[atom]
    try:
        exact = _polynomial(value.num, point) / _polynomial(value.den, point)
    except (KeyError, ZeroDivisionError):
        raise CertificateError("no value at the point") from None
    return exact, exact


def _polynomial(poly: Poly, point: Point) -> Fraction:
    total = Fraction(0)
    for monomial, coefficient in poly.items():
        term = coefficient
        for atom, power in monomial:
            if atom != SUM:
                term *= point[atom] ** power
        total += term
    return total

"""Where a stated relation breaks: the numbers of a certificate put in, and both sides evaluated exactly."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import starmap
from typing import Any

from workbench.proof.checker import (
    Bounds,
    CertificateError,
    Context,
    Poly,
    Ratio,
    Terms,
    at,
    bounds,
    calls,
    holds,
    read_point,
    read_terms,
    roots_of,
    split_relation,
    substitute,
    symbols_of,
)
from workbench.report.certificate_latex import (
    SIGNS,
    expression_latex,
    letter_and_value,
    name_latex,
    numbers_of,
    numbers_put_in,
    rate_latex,
    relation_latex,
)
from workbench.report.dots import only_names
from workbench.report.number_style import Style, style_of, told_apart, value_latex
from workbench.report.side_values import Enclosed, closed_form, rounded, shown_values

_SIGN = re.compile(r"\w+ (?:>=?|!=) 0")  # the sign of a letter
_NAME = re.compile(r"[A-Za-z_]\w*")
_PUT_IN = re.compile(r"\w+ == -?\d+(?:/\d+)?")  # the value of a letter, which is told with the others
MANY = 6  # letters with one value, from which on they are called 'all others'


@dataclass(frozen=True)
class Counterexample:
    """A point, or a motion, at which everything assumed holds and a relation does not; all formulas are LaTeX.

    relation: the one that fails; values: what its two sides depend on, letters of one value together; others: the
    value of all letters of `values` that are not named in it, where they are many; left, right: the sides there, None
    where they are no numbers; everything: all that the certificate names, letter by letter; motion: whether the values
    are functions of time, with which the relation fails at all times; put_in: both sides with the numbers in place of
    the letters, where they are formulas without rates and sums; unbounded: what is greater than the time at all times
    of a motion, where the relation denies that; given: what is assumed beyond the signs of single letters, of a motion
    the loop that it obeys too; along: the rates of letters whose rate stands in the relation; beside: the values of
    letters that stand in these two alone.
    """

    relation: str
    operator: str
    values: tuple[str, ...]
    others: str | None
    left: str | None
    right: str | None
    everything: tuple[tuple[str, str], ...]
    motion: bool
    put_in: tuple[str, str] | None = None
    unbounded: str | None = None
    given: tuple[str, ...] = ()
    along: tuple[str, ...] = ()
    beside: tuple[str, ...] = ()


def counterexample_of(certificate: Mapping[str, Any]) -> Counterexample | None:
    """What breaks the goal of a certificate that shows it false; None for one that proves it."""
    if certificate.get("verdict") == "proved" or "point" not in certificate:
        return None
    goal = certificate["goal"]
    context = Context(goal.get("flow", {}), goal.get("indexed", []), goal.get("inputs", []))
    point = read_point(certificate["point"])
    if "functions" in certificate:
        return _motion(certificate, context, point)
    terms = read_terms(certificate["terms"], context, point) if "terms" in certificate else None
    failing = goal["show"][0]
    between = roots_of(dict(certificate))
    for name in between:
        point.pop(name)
    if len(goal["show"]) > 1:
        failing = next((text for text in goal["show"] if not _holds(context, text, point, terms, between)), failing)
    left, operator, right = split_relation(failing)
    deciding = _symbols(context, left) | _symbols(context, right)
    sides = _sides(context, (left, right), point, terms, between)
    style = style_of([*(Fraction(text) for row in (certificate["point"], *certificate.get("terms", []))
                        for name, text in row.items() if name not in between),
                      *(low for low, high in sides or () if low == high)])
    inexact = not between and terms is None and any(low < high for low, high in sides or ())
    closed = _closed(context, (left, right), point, style) if inexact else ()
    numbers = {name: Fraction(text) for name, text in sorted(certificate["point"].items())}
    shown = told_apart(numbers, style) | {name: rounded(numbers[name], 10) for name in between}
    rows = [{name: value_latex(Fraction(text), style) for name, text in sorted(row.items())}
            for row in certificate.get("terms", [])]
    values, others = _grouped({name: value for name, value in shown.items() if name in deciding})
    in_sums = tuple(f"{_indexed(name, i)} = {value}" for i, row in enumerate(rows, 1) for name, value in row.items()
                    if name in deciding)
    every = tuple(starmap(letter_and_value, shown.items())) + tuple(
        (_indexed(name, i), value) for i, row in enumerate(rows, 1) for name, value in row.items())
    given, along, more = _conditions(goal, failing)
    rates = [rate_latex(name, rate, style) for name, rate in along.items()]
    return Counterexample(relation_latex(failing, style), SIGNS[operator], values + in_sums, others,
                          *shown_values(sides, style, closed), every, False,
                          None if between else _put_in(left, right, certificate["point"], style), None,
                          _telling(given, style),
                          tuple(rate for rate in rates if not only_names(rate)),
                          _together({name: value for name, value in shown.items() if name in more - deciding}))


def _conditions(goal: Mapping[str, Any], failing: str) -> tuple[list[str], dict[str, str], set[str]]:
    """What a goal assumes beyond the signs of single letters, the rates that its relation takes, and their letters."""
    given = _beyond_signs(goal.get("assume", []))
    derived = {name for part in _derived(failing) for name in _names(part)}
    along = {name: rate for name, rate in goal.get("flow", {}).items() if name in derived}
    return given, along, {name for text in (*given, *along.values()) for name in _names(text)}


def _beyond_signs(relations: Iterable[str]) -> list[str]:
    return [text for text in relations if not _SIGN.fullmatch(text)]


def _telling(given: Iterable[str], style: Style) -> tuple[str, ...]:
    """What is assumed as LaTeX, without what has no letter, what is the value of one, and 0 = 0."""
    told = (relation_latex(text, style) for text in given if _names(text) and not _PUT_IN.fullmatch(text))
    return tuple(text for text in told if text != "0 = 0")


def _derived(relation: str) -> list[str]:
    """What the rates in a relation are taken of."""
    left, _, right = split_relation(relation)
    return [ast.unparse(node.args[0]) for side in (left, right) for node in ast.walk(ast.parse(side, mode="eval"))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "D"]


def _names(text: str) -> set[str]:
    return set(_NAME.findall(text))


def _put_in(left: str, right: str, point: Mapping[str, str], style: Style) -> tuple[str, str] | None:
    values = {name: Fraction(text) for name, text in point.items()}
    letters = [expression_latex(side, style) for side in (left, right)]
    sides = [numbers_put_in(side, values, style) or before for side, before in zip((left, right), letters, strict=True)]
    return None if sides == letters or any(
        "dt" in side or r"\sum" in side for side in sides) else (sides[0], sides[1])


def _motion(certificate: Mapping[str, Any], context: Context, point: dict[str, Ratio]) -> Counterexample:
    goal = certificate["goal"]
    left, operator, right = split_relation(goal["show"][0])
    functions = {name: context.read(text) for name, text in certificate["functions"].items()}
    deciding = _symbols(context, left) | _symbols(context, right)
    sides = [substitute(context, substitute(context, context.read(side), functions), point) for side in (left, right)]
    style = style_of([number for text in (*certificate["functions"].values(), *certificate["point"].values())
                      for number in numbers_of(text)] + [number for side in sides for number in _coefficients(side)])
    along = [_of_time(side, goal["eventually"], style) for side in sides]
    moving = {name: expression_latex(text, style) for name, text in sorted(certificate["functions"].items())}
    fixed = {name: value_latex(Fraction(text), style) for name, text in sorted(certificate["point"].items())}
    named = {name: value for name, value in (moving | fixed).items() if name in deciding or name in moving}
    values, others = _grouped(named)
    given = _beyond_signs((*goal.get("assume", []), *goal.get("always", [])))
    more = {name for text in given for name in _names(text)}
    grows = operator in ("<=", "<") and right.strip() == goal["eventually"]
    return Counterexample(relation_latex(goal["show"][0], style), SIGNS[operator], values, others, along[0], along[1],
                          tuple((name_latex(name), value) for name, value in (moving | fixed).items()), True,
                          unbounded=expression_latex(left) if grows else None,
                          given=_telling(given, style),
                          beside=_together({n: v for n, v in fixed.items() if n in more and n not in named}))


def _symbols(context: Context, text: str) -> set[str]:
    """The symbols on which the value of an expression depends."""
    return symbols_of(context, context.read(text))


def _holds(context: Context, text: str, point: dict[str, Ratio], terms: Terms | None, between: Bounds) -> bool:
    try:
        return holds(context, text, point, terms, between)
    except CertificateError:
        return True


class _AtPoint(Context):
    """Reads expressions without rates and sums as the numbers that they are at a point: nothing is multiplied out."""

    plain = False

    def __init__(self, point: Mapping[str, Ratio]) -> None:
        super().__init__({}, [])
        self.point = point

    def node(self, node: ast.expr) -> Ratio:
        """The value of a syntax tree at the point."""
        return self.point.get(node.id) or super().node(node) if isinstance(node, ast.Name) else super().node(node)


def _enclosed(context: Context, side: str, point: dict[str, Ratio], terms: Terms | None,
              between: Bounds) -> Enclosed:
    if calls(side, "D") or calls(side, "Sum"):
        return bounds(context, at(context, context.read(side), point, terms), dict(between))
    numbers = _AtPoint(point)
    return bounds(numbers, numbers.read(side), dict(between))


def _sides(context: Context, sides: Sequence[str], point: dict[str, Ratio], terms: Terms | None,
           between: Bounds) -> list[Enclosed] | None:
    """Between which fractions both sides lie at the point; None where they are no numbers."""
    try:
        return [_enclosed(context, side, point, terms, between) for side in sides]
    except CertificateError:
        return None


def _closed(context: Context, sides: Sequence[str], point: dict[str, Ratio], style: Style) -> list[str | None]:
    """Both sides where they are one exponential or logarithm of a number."""
    return [None if calls(side, "Sum") else closed_form(context, at(context, context.read(side), point, None), style)
            for side in sides]


def _coefficients(value: Ratio) -> list[Fraction]:
    """The numbers in a polynomial, where it is one."""
    below = value.den.get(()) if set(value.den) == {()} else None
    return [] if below is None else [Fraction(coefficient) / below for coefficient in value.num.values()]


def _of_time(value: Ratio, time: str, style: Style) -> str | None:
    """A polynomial of time as LaTeX; None for anything else."""
    powers = _powers(value.num, time)
    if powers is None or set(value.den) != {()}:
        return None
    below = value.den[()]
    text = ""
    for power, coefficient in sorted(powers.items()):
        size = value_latex(abs(Fraction(coefficient) / below), style)
        letter = "" if power == 0 else name_latex(time) if power == 1 else f"{name_latex(time)}^{{{power}}}"
        sign = ("-" if coefficient < 0 else "") if not text else (" - " if coefficient < 0 else " + ")
        text += sign + (letter if size == "1" and letter else f"{size} {letter}".strip())
    return text or "0"


def _powers(poly: Poly, time: str) -> dict[int, Fraction] | None:
    found: dict[int, Fraction] = {}
    for monomial, coefficient in poly.items():
        if any(name != time for name, _ in monomial):
            return None
        found[sum(power for _, power in monomial)] = Fraction(coefficient)
    return found


def _grouped(values: Mapping[str, str]) -> tuple[tuple[str, ...], str | None]:
    """Letters of one value together as `a = b = 1`, the telling ones first; a value that many have stands alone."""
    groups: dict[str, list[str]] = {}
    for letter, value in starmap(letter_and_value, values.items()):
        groups.setdefault(value, []).append(letter)
    largest = max(groups, key=lambda value: len(groups[value]), default=None)
    others = largest if largest is not None and len(groups[largest]) > MANY else None
    plain = sorted(groups, key=lambda value: (value in ("0", "1"), len(groups[value])))
    return tuple(" = ".join([*groups[value], value]).replace(r"= \approx", r"\approx")
                 for value in plain if value != others), others


def _together(values: Mapping[str, str]) -> tuple[str, ...]:
    """Letters of one value together, those of the value that many have among them."""
    named, many = _grouped(values)
    return named + (() if many is None else (rf"\text{{all other letters}}\ {many}",))


def _indexed(name: str, term: int) -> str:
    """The letter of an indexed symbol in one term of the sums."""
    letter = name_latex(name)
    return f"{letter[:-1]},{term}}}" if letter.endswith("}") and "_{" in letter else f"{letter}_{{{term}}}"

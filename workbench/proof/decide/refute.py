"""Search for a point where the assumptions hold and a relation fails; the checker has the last word."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import (
    Bounds,
    CertificateError,
    Context,
    at,
    bounds,
    check,
    holds,
    number,
    read_rational,
    read_terms,
    roots_of,
    split_relation,
)
from workbench.proof.claim import Goal, Verdict
from workbench.proof.decide.counts import counted_points
from workbench.proof.decide.exact_look import Exact
from workbench.proof.decide.model import find_model
from workbench.proof.decide.onward import needs_path, onward
from workbench.proof.decide.path import find_path, reached_points
from workbench.proof.decide.proposals import Point, descents, proposals
from workbench.proof.decide.roots import Root, roots_near
from workbench.proof.decide.simple_points import plainer_point, simplest_point
from workbench.proof.text import goal_text


@dataclass(frozen=True)
class Place:
    """A point, and what a certificate says of the symbols in it that are roots rather than rational."""

    point: Point
    roots: dict[str, list[Root]]


MOTIONS = 10  # points from which a motion is looked for that keeps what always holds
EXAMPLES = 4  # of each kind, when the checker wants another


def find_counterexample(goal: Goal, verdict: Verdict, seed: int = 1, quick: bool = False) -> dict[str, Any] | None:
    """A certificate with a rational point, or functions of time, that falsify the goal; or None.

    `quick` looks only at what costs less than an attempt at a proof.
    """
    record = goal_text(goal)
    try:
        exact = Exact(record)
        usual = goal.evaluated()
        if goal.eventually is not None:
            return None if quick else find_model(usual, record, verdict)
        further = MOTIONS if needs_path(usual) else None
        for point in islice((p for p in proposals(usual, seed, True, quick) if exact.breaks(p)), further):
            plain = plainer_point(exact, point)
            # A motion begins at its point: one that is simpler still need not lead anywhere.
            for shown in (*((simplest_point(exact, plain),) if further is None else ()), plain, point):
                certificate = {"version": 1, "verdict": verdict, "goal": record, "point": texts(shown)}
                if further is not None:
                    certificate |= onward(usual, shown) or {}
                if _accepted(certificate):
                    return certificate
        if (found := _at_other_counts(usual, record, verdict, seed, quick)) is not None:
            # That it fails is known now, so that no proof is looked for; with more looks one term may show it, too.
            return (find_counterexample(goal, verdict, seed) if quick else None) or found
    except (CertificateError, ClaimError):  # nothing that the checker would accept can be said of such a goal
        return None
    found = find_path(usual, record, verdict, seed, quick)
    return found if quick or found is not None else descended_counterexample(goal, verdict)


def descended_counterexample(goal: Goal, verdict: Verdict, seed: int = 1) -> dict[str, Any] | None:
    """The same with a point, rational or a root, to which least squares lead."""
    record = goal_text(goal)
    try:
        for place in _descended(goal, seed, True):
            certificate = {"version": 1, "verdict": verdict, "goal": record, "point": texts(place.point)} | place.roots
            if _accepted(certificate):
                return certificate
    except (CertificateError, ClaimError):
        pass
    return None


def _descended(goal: Goal, seed: int, break_shown: bool) -> Iterator[Place]:
    """Rational points near which floating point sees no obstacle, and points where symbols are roots; of goals of one
    instant without sums."""
    if goal.initial or goal.always or goal.inputs or any(isinstance(s, sp.Indexed) for s in goal.symbols()):
        return
    exact = Exact(goal_text(goal))
    for point, missed in descents(goal.evaluated(), seed, break_shown):
        if not missed:
            if exact.breaks(point) if break_shown else exact.meets(point):
                yield Place(point, {})
        else:
            yield from (Place(moved, {"roots": roots}) for moved, roots in roots_near(goal, point))


def _at_other_counts(goal: Goal, record: dict[str, Any], verdict: Verdict, seed: int,
                     quick: bool) -> dict[str, Any] | None:
    """A certificate with a point at which the sums have no term, two or three."""
    for point, terms in counted_points(goal, seed, quick):
        certificate = {"version": 1, "verdict": verdict, "goal": record, "point": texts(point),
                       "terms": [texts(term) for term in terms]}
        if _accepted(certificate):
            return certificate
    return None


def shown_point(certificate: dict[str, Any]) -> dict[str, str]:
    """The functions of time and the values of a counterexample, those of indexed symbols by their place."""
    terms = certificate.get("terms", [])
    rows = {f"{name}[{place}]": value for place, term in enumerate(terms, 1) for name, value in term.items()}
    count = {"terms of the sums": str(len(terms))} if "terms" in certificate else {}
    roots = {name: f"root near {float(Fraction(certificate['point'][name])):.10g}" for name in roots_of(certificate)}
    return dict(certificate.get("functions", {})) | count | rows | certificate["point"] | roots


def find_example(goal: Goal, seed: int = 1) -> dict[str, str] | None:
    """A rational point that meets all assumptions of a goal, so that nothing is proved from nothing."""
    try:
        exact = Exact(goal_text(goal))
        return next((texts(point) for point in proposals(goal.evaluated(), seed, False) if exact.meets(point)), None)
    except (CertificateError, ClaimError):
        return None


def examples(goal: Goal, seed: int = 1) -> Iterator[dict[str, Any]]:
    """What certificates say of instants at which all assumptions hold; of a flow with initial values, the first
    instant or one that a path leads to."""
    try:
        exact, usual = Exact(goal_text(goal)), goal.evaluated()
        points = (point for point in proposals(usual, seed, False) if exact.meets(point))
        yield from ({"example": texts(point)} for point in islice(points, EXAMPLES if goal.initial else 1))
        for reached in islice(reached_points(usual, seed, False) if goal.initial else (), EXAMPLES):
            yield {"example": reached.pop("point"), **reached}
        yield from _descended_examples(goal, seed)
    except (CertificateError, ClaimError):
        return


def quick_examples(goal: Goal, seed: int = 1) -> Iterator[dict[str, Any]]:
    """The same for a goal of one instant, from points that cost next to nothing."""
    try:
        exact, usual = Exact(goal_text(goal)), goal.evaluated()
        points = (point for point in proposals(usual, seed, False, quick=True) if exact.meets(point))
        yield from ({"example": texts(point)} for point in islice(points, 1))
        yield from _descended_examples(goal, seed)
    except (CertificateError, ClaimError):
        return


def _descended_examples(goal: Goal, seed: int) -> Iterator[dict[str, Any]]:
    yield from ({"example": texts(place.point), **place.roots}
                for place in islice(_descended(goal, seed, False), EXAMPLES))


def _accepted(certificate: dict[str, Any]) -> bool:
    try:
        check(certificate)
    except CertificateError:
        return False
    return True


def texts(point: Point) -> dict[str, str]:
    """A point as it stands in certificates."""
    return {name: str(value) for name, value in point.items()}


def value_at(goal: Goal, point: dict[str, str], terms: list[dict[str, str]] | None = None,
             between: Bounds | None = None) -> str:
    """The sides of the first relation that fails (or of the last) at a point, as exact or rounded numbers."""
    record = goal_text(goal)
    context = Context(record.get("flow", {}), record.get("indexed", []))
    values = {name: number(read_rational(v)) for name, v in point.items() if name not in (between or {})}
    rows = None if terms is None else read_terms(terms, context, values)
    for shown in record["show"]:
        if not holds(context, shown, values, rows, between) or shown is record["show"][-1]:
            break
    left, operator, right = split_relation(shown)
    sides = [bounds(context, at(context, context.read(side), values, rows), dict(between or {}))
             for side in (left, right)]
    a, b = (f"{float(low):.6g}" if low == high or float(low) == float(high) else f"{float((low + high) / 2):.6g}"
            for low, high in sides)
    return f"{a} {operator} {b}"

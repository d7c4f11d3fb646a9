"""Search for a point where the assumptions hold and a relation fails; the checker has the last word."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from typing import Any

from workbench.errors import ClaimError
from workbench.proof.checker import (
    CertificateError,
    Context,
    at,
    bounds,
    check,
    holds,
    number,
    read_rational,
    read_terms,
    split_relation,
)
from workbench.proof.claim import Goal, Verdict
from workbench.proof.decide.counts import counted_points
from workbench.proof.decide.exact_look import Exact
from workbench.proof.decide.model import find_model
from workbench.proof.decide.path import find_path, reached_points
from workbench.proof.decide.proposals import Point, proposals
from workbench.proof.text import goal_text

EXAMPLES = 4  # of each kind, when the checker wants another
SIMPLE = (Fraction(0), Fraction(1), Fraction(-1), Fraction(2), Fraction(1, 2), Fraction(-2), Fraction(3))


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
        for point in proposals(usual, seed, True, quick):
            if exact.breaks(point):
                for shown in (_simplest(exact, point), point):
                    certificate = {"version": 1, "verdict": verdict, "goal": record, "point": texts(shown)}
                    if _accepted(certificate):
                        return certificate
        if not quick and (found := _at_other_counts(usual, record, verdict, seed)) is not None:
            return found
    except (CertificateError, ClaimError):  # nothing that the checker would accept can be said of such a goal
        return None
    return find_path(usual, record, verdict, seed, quick)


def _simplest(exact: Exact, point: Point) -> Point:
    """A point that breaks the goal too, each value in turn made as simple as can be: zero first, then one."""
    for name, value in sorted(point.items()):
        rank = SIMPLE.index(value) if value in SIMPLE else len(SIMPLE)
        for simpler in SIMPLE[:rank]:
            tried = point | {name: simpler}
            if exact.breaks(tried):
                point = tried
                break
    return point


def _at_other_counts(goal: Goal, record: dict[str, Any], verdict: Verdict, seed: int) -> dict[str, Any] | None:
    """A certificate with a point at which the sums have no term, two or three."""
    for point, terms in counted_points(goal, seed):
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
    return dict(certificate.get("functions", {})) | count | rows | certificate["point"]


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
    except (CertificateError, ClaimError):
        return


def _accepted(certificate: dict[str, Any]) -> bool:
    try:
        check(certificate)
    except CertificateError:
        return False
    return True


def texts(point: Point) -> dict[str, str]:
    """A point as it stands in certificates."""
    return {name: str(value) for name, value in point.items()}


def value_at(goal: Goal, point: dict[str, str], terms: list[dict[str, str]] | None = None) -> str:
    """The sides of the first relation that fails (or of the last) at a point, as exact or rounded numbers."""
    record = goal_text(goal)
    context = Context(record.get("flow", {}), record.get("indexed", []))
    values = {name: number(read_rational(v)) for name, v in point.items()}
    rows = None if terms is None else read_terms(terms, context, values)
    for shown in record["show"]:
        if not holds(context, shown, values, rows) or shown is record["show"][-1]:
            break
    left, operator, right = split_relation(shown)
    sides = [bounds(context, at(context, context.read(side), values, rows)) for side in (left, right)]
    a, b = (f"{float(low):.6g}" if low == high or float(low) == float(high) else f"{float((low + high) / 2):.6g}"
            for low, high in sides)
    return f"{a} {operator} {b}"

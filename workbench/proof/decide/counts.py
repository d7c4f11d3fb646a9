"""Break a statement about sums at a number of terms other than one: none, two or three, each with values of its own."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice

import sympy as sp

from workbench.proof.claim import Goal, Relation, equal, name_of
from workbench.proof.decide.proposals import Point, proposals
from workbench.proof.derive import expand_derivatives

COUNTS, LOOKS = (0, 2, 3), 20


def counted_points(goal: Goal, seed: int, quick: bool = False) -> Iterator[tuple[Point, list[Point]]]:
    """(values of plain symbols, values of the indexed ones in each term) at which the goal seems to fail.

    `quick` looks at two terms alone, as `proposals` does.

    Raises ClaimError where written-out sums leave the language of goals.
    """
    indexed = sorted({s for s in goal.symbols() if isinstance(s, sp.Indexed)}, key=name_of)
    if not any(side.has(sp.Sum) for r in goal.relations() for side in (r.left, r.right)):
        return
    for count in (2,) if quick else COUNTS:
        own = {(s, i): sp.Symbol(f"term_{i}_of_{name_of(s)}", real=True) for s in indexed for i in range(count)}
        written = _written_out(goal, [{s: own[s, i] for s in indexed} for i in range(count)])
        for point in islice(proposals(written, seed, True, quick), LOOKS):
            terms = [{name_of(s): point.get(str(own[s, i]), Fraction(1)) for s in indexed} for i in range(count)]
            names = {str(symbol) for symbol in own.values()}
            yield {name: value for name, value in point.items() if name not in names}, terms


def _written_out(goal: Goal, terms: list[dict[sp.Expr, sp.Expr]]) -> Goal:
    """The goal at one instant, with initial values at time zero, its sums added up over so many terms."""
    def put(expr: sp.Expr) -> sp.Expr:
        carried = expand_derivatives(expr, goal.flow)
        return carried.replace(sp.Sum, lambda term, *_: sp.Add(*(term.xreplace(here) for here in terms)))

    def each(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(Relation(put(r.left), r.operator, put(r.right)) for r in relations)

    plain = tuple(s for s in goal.symbols() if isinstance(s, sp.Symbol))
    starts = [equal(here.get(s, s), put(value)) for s, value in goal.initial.items()
              for here in (terms if isinstance(s, sp.Indexed) else [{}])]
    return Goal(each(goal.show), (*each(goal.assume), *each(goal.always), *starts), named=plain)

"""Goals that differ from a given one in a single place, to test whether deciders tell true from almost true."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from workbench.proof.claim import Goal, Operator, Relation

TURNED: dict[Operator, Operator] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "==": "!=", "!=": "=="}
STRICT: dict[Operator, Operator] = {"<=": "<", ">=": ">"}
WEAK: dict[Operator, Operator] = {"<": "<=", ">": ">="}


@dataclass(frozen=True)
class Mutant:
    """A goal with one change: its kind, where it is, and the changed goal."""

    kind: str
    place: str
    goal: Goal


def mutants(goal: Goal) -> Iterator[Mutant]:
    """All mutants of a goal, in a fixed order: edited, turned and strict relations, weaker assumptions, wider domains.

    A mutant may be as true as the goal it comes from; who uses it must find out.
    """
    for number, relation in enumerate(goal.show):
        for kind, changed in _edited_relations(relation):
            show = (*goal.show[:number], changed, *goal.show[number + 1:])
            yield Mutant(kind, f"show {number + 1}", replace(goal, show=show))
    for number, relation in enumerate(goal.assume):
        rest = (*goal.assume[:number], *goal.assume[number + 1:])
        yield Mutant("remove an assumption", f"assume {number + 1}", replace(goal, assume=rest))
        if relation.operator in WEAK:
            weaker = Relation(relation.left, WEAK[relation.operator], relation.right)
            assume = (*goal.assume[:number], weaker, *goal.assume[number + 1:])
            yield Mutant("widen a domain", f"assume {number + 1}", replace(goal, assume=assume))
    for number in range(len(goal.always)):
        rest = (*goal.always[:number], *goal.always[number + 1:])
        yield Mutant("remove an assumption", f"always {number + 1}", replace(goal, always=rest))
    for symbol in goal.symbols():
        if isinstance(symbol, sp.Symbol) and symbol.is_nonnegative and symbol not in goal.flow:
            yield Mutant("widen a domain", f"sign of {symbol}", _renamed(goal, symbol))


def _edited_relations(relation: Relation) -> Iterator[tuple[str, Relation]]:
    left, operator, right = relation.left, relation.operator, relation.right
    yield "turn an inequality", Relation(left, TURNED[operator], right)
    if operator in STRICT:
        yield "make an inequality strict", Relation(left, STRICT[operator], right)
    for kind, changed in edits(left):
        yield kind, Relation(changed, operator, right)
    for kind, changed in edits(right):
        yield kind, Relation(left, operator, changed)


def edits(expr: sp.Expr) -> Iterator[tuple[str, sp.Expr]]:
    """The expression with one sign flipped, one rational coefficient changed, or one term dropped."""
    if isinstance(expr, sp.Rational):
        if expr != 0:
            yield "change a coefficient", expr * sp.Rational(3, 2)
        return
    if isinstance(expr, sp.Add):
        for number, term in enumerate(expr.args):
            others = (*expr.args[:number], *expr.args[number + 1:])
            yield "flip a sign", sp.Add(*others, -term)
            yield "drop a term", sp.Add(*others)
    changeable = 1 if isinstance(expr, (sp.Pow, sp.Sum)) else len(expr.args)  # neither exponents nor limits
    for number, part in enumerate(expr.args[:changeable] if not isinstance(expr, sp.Indexed) else ()):
        for kind, changed in edits(part):
            yield kind, expr.func(*expr.args[:number], changed, *expr.args[number + 1:])


def _renamed(goal: Goal, symbol: sp.Symbol) -> Goal:
    """The goal with one symbol of known sign made any real number."""
    free = {symbol: sp.Symbol(symbol.name, real=True)}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(r.subs(free) for r in relations)

    return replace(goal, show=put(goal.show), assume=put(goal.assume), always=put(goal.always),
                   lemmas=put(goal.lemmas), facts=tuple(f.xreplace(free) for f in goal.facts),
                   flow={s: rate.xreplace(free) for s, rate in goal.flow.items()},
                   initial={s: value.xreplace(free) for s, value in goal.initial.items()},
                   decreasing=goal.decreasing.xreplace(free) if goal.decreasing is not None else None,
                   model={free.get(s, s): v for s, v in goal.model.items()})

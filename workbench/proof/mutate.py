"""Goals that differ from a given one in a single place, to test whether deciders tell true from almost true."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any, Literal

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Operator, Relation, name_of

MutationKind = Literal[
    "flip a sign", "change a coefficient", "drop a term", "change an exponent", "turn an inequality",
    "change strictness", "remove an assumption", "widen a domain", "swap two symbols"]
Edit = tuple[MutationKind, sp.Expr]

KINDS: tuple[MutationKind, ...] = (
    "flip a sign", "change a coefficient", "drop a term", "change an exponent", "turn an inequality",
    "change strictness", "remove an assumption", "widen a domain", "swap two symbols")
TURNED: dict[Operator, Operator] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "==": "!=", "!=": "=="}
OTHER_STRICTNESS: dict[Operator, Operator] = {"<=": "<", ">=": ">", "<": "<=", ">": ">="}
WEAK: dict[Operator, Operator] = {"<": "<=", ">": ">="}
FACTORS = (sp.Rational(3, 2), sp.Rational(1, 2), sp.Rational(11, 10))  # up, down, and hardly noticed


@dataclass(frozen=True)
class Mutation:
    """One change of a goal: its kind, where it is, and the parts of the goal that it replaces."""

    kind: MutationKind
    place: str
    change: dict[str, Any]

    def of(self, goal: Goal) -> Goal | None:
        """The changed goal; None when the change leaves the language of goals (two sums multiplied, say)."""
        try:
            return replace(goal, **self.change)
        except ClaimError:
            return None


def mutations(goal: Goal) -> Iterator[Mutation]:
    """All mutations of a goal, in a fixed order, each once: of what is shown, of the flow, of what is assumed.

    A mutant may be as true as the goal it comes from; who uses it must find out.
    """
    seen: set[Any] = set()
    for kind, place, change in _changes(goal):
        key = tuple((part, tuple(value.items()) if isinstance(value, dict) else value)
                    for part, value in change.items())
        if key not in seen and any(getattr(goal, part) != value for part, value in change.items()):
            seen.add(key)
            yield Mutation(kind, place, change)


def _changes(goal: Goal) -> Iterator[tuple[MutationKind, str, dict[str, Any]]]:
    """(kind, place, changed parts of the goal)."""
    for number, relation in enumerate(goal.show):
        for kind, changed in _edited_relations(relation):
            yield kind, f"show {number + 1}", {"show": (*goal.show[:number], changed, *goal.show[number + 1:])}
    for moving, rate in goal.flow.items():
        if not isinstance(rate, (sp.Rational, sp.Symbol, sp.Indexed)):  # a free rate, or the clock, is no formula
            for kind, edited in edits(rate):
                yield kind, f"rate of {name_of(moving)}", {"flow": {**goal.flow, moving: edited}}
    for part in ("assume", "always"):
        relations = getattr(goal, part)
        for number, relation in enumerate(relations):
            before, after = relations[:number], relations[number + 1:]
            yield "remove an assumption", f"{part} {number + 1}", {part: (*before, *after)}
            for wider in _wider(relation):
                yield "widen a domain", f"{part} {number + 1}", {part: (*before, wider, *after)}
    for symbol in goal.symbols():
        if isinstance(symbol, sp.Symbol) and symbol.is_nonnegative and symbol not in goal.flow:
            for sign in ({"nonnegative": True}, {"real": True})[0 if symbol.is_positive else 1:]:
                yield "widen a domain", f"sign of {symbol}", _renamed(goal, symbol, sp.Symbol(symbol.name, **sign))


def _wider(relation: Relation) -> Iterator[Relation]:
    """Relations that say less: the bound itself let in, the bound moved out."""
    left, operator, right = relation.left, relation.operator, relation.right
    if operator in WEAK:
        yield Relation(left, WEAK[operator], right)
    if operator in ("<", "<="):
        yield Relation(left, operator, right + sp.Rational(1, 10))
    if operator in (">", ">="):
        yield Relation(left, operator, right - sp.Rational(1, 10))


def _edited_relations(relation: Relation) -> Iterator[tuple[MutationKind, Relation]]:
    left, operator, right = relation.left, relation.operator, relation.right
    yield "turn an inequality", Relation(left, TURNED[operator], right)
    if operator in OTHER_STRICTNESS:
        yield "change strictness", Relation(left, OTHER_STRICTNESS[operator], right)
    for kind, changed in edits(left):
        yield kind, Relation(changed, operator, right)
    for kind, changed in edits(right):
        yield kind, Relation(left, operator, changed)
    atoms = sorted(left.atoms(sp.Indexed) | right.atoms(sp.Indexed), key=name_of)
    hidden = {s for atom in atoms for s in atom.free_symbols}
    hidden |= {s for e in (left, right) for total in e.atoms(sp.Sum) for limit in total.limits
               for s in (limit[0], *limit[1].free_symbols, *limit[2].free_symbols)}
    plain = sorted((s for s in left.free_symbols | right.free_symbols if isinstance(s, sp.Symbol) and s not in hidden),
                   key=name_of)
    for one, two in (*combinations(plain, 2), *combinations(atoms, 2)):
        yield "swap two symbols", relation.subs({one: two, two: one})


def edits(expr: sp.Expr) -> Iterator[Edit]:
    """The expression with one thing changed: a sign, a coefficient, a term, an exponent; at any depth."""
    if expr == 0:
        return
    terms = expr.args if isinstance(expr, sp.Add) else (expr,)
    for number, term in enumerate(terms):
        others = (*terms[:number], *terms[number + 1:])
        yield "flip a sign", sp.Add(*others, -term)
        for factor in FACTORS:
            yield "change a coefficient", sp.Add(*others, factor * term)
        if others:
            yield "drop a term", sp.Add(*others)
        for kind, changed in _inner_edits(term):
            yield kind, sp.Add(*others, changed)


def _inner_edits(term: sp.Expr) -> Iterator[Edit]:
    """Changes inside a term: of exponents, and of whatever stands in brackets, functions and sums."""
    if isinstance(term, sp.Pow):
        base, exponent = term.args
        if exponent.is_Integer:
            for other in (exponent + sp.sign(exponent), exponent - sp.sign(exponent)):
                if other != 0:
                    yield "change an exponent", base**other
        elif exponent.is_Rational:
            yield "change an exponent", base ** (exponent * exponent.q)
    if isinstance(term, (sp.Symbol, sp.Indexed, sp.Rational, sp.NumberSymbol)):
        return
    # Neither exponents nor the limits of sums are terms.
    parts = term.args[:1] if isinstance(term, (sp.Pow, sp.Sum)) else term.args
    for number, part in enumerate(parts):
        if isinstance(part, (sp.Symbol, sp.Indexed, sp.Rational)) and isinstance(term, (sp.Mul, sp.Pow)):
            continue  # a change there is one of the whole term, or is no smaller one
        for kind, changed in _inner_edits(part) if isinstance(part, (sp.Pow, sp.Mul)) else edits(part):
            yield kind, term.func(*term.args[:number], changed, *term.args[number + 1:])


def _renamed(goal: Goal, symbol: sp.Symbol, wider: sp.Symbol) -> dict[str, Any]:
    """The parts of the goal with one symbol put in place of another of the same name."""
    free = {symbol: wider}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(r.subs(free) for r in relations)

    return {"show": put(goal.show), "assume": put(goal.assume), "always": put(goal.always),
            "lemmas": put(goal.lemmas), "facts": tuple(f.xreplace(free) for f in goal.facts),
            "flow": {s: rate.xreplace(free) for s, rate in goal.flow.items()},
            "initial": {s: value.xreplace(free) for s, value in goal.initial.items()},
            "decreasing": goal.decreasing.xreplace(free) if goal.decreasing is not None else None,
            "model": {free.get(s, s): v for s, v in goal.model.items()}}

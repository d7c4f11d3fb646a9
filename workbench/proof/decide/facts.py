"""What is known without proof: the assumptions of a goal, and the facts that the checker holds about functions."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from workbench.proof.checker import Context, bounds
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, Item, flatten
from workbench.proof.decide.laurent import Laurent, multiply, reduce_inverses, to_laurent
from workbench.proof.derive import Size
from workbench.proof.text import text

GRID = 10**9  # bounds of numbers such as log(2) are multiples of 1/GRID


@dataclass(frozen=True)
class Known:
    """Something of known sign: its factor items, its value, and whether it is > 0, >= 0 or == 0."""

    items: tuple[Item, ...]
    value: Laurent
    sign: str


def tangents(goal: Goal, atoms: Atoms) -> Iterator[tuple[str, sp.Expr, sp.Expr]]:
    """(fact, argument, what is at least 0) of the tangents that the checker knows of logarithms and exponentials.

    Of those that are atoms at first: whoever flattens what is given may add others.
    """
    arguments = [(argument, "exp_tangent") for argument in goal.facts]
    for argument in list(atoms.logs):
        arguments += [(argument, "log_tangent"), (1 / argument, "log_tangent")]
    for argument in list(atoms.exps):
        arguments += [(argument, "exp_tangent"), (-argument, "exp_tangent")]
    for nested, fact in arguments:
        argument = nested.xreplace(atoms.meanings())
        yield fact, argument, (argument - 1 - sp.log(argument) if fact == "log_tangent"
                               else sp.exp(argument, evaluate=False) - 1 - argument)


def known_facts(goal: Goal, relations: tuple[Relation, ...], atoms: Atoms) -> list[Known]:
    """Assumptions that are more than the sign of a symbol, and what the checker knows of every function."""
    known = [Known((), {(): Fraction(1)}, ">")]
    for position, relation in enumerate(relations):
        if relation.operator == "!=":
            value = to_laurent(flatten(relation.margin, atoms, goal.flow), atoms)
            known.append(Known(({"square_of": position},), reduce_inverses(multiply(value, value), atoms), ">"))
            continue
        if relation.margin.is_Symbol and relation.operator != "==":
            continue
        sign = "==" if relation.operator == "==" else ">" if relation.strict else ">="
        value = to_laurent(flatten(relation.margin, atoms, goal.flow), atoms)
        known.append(Known(({"assume": position},), value, sign))
    for fact, argument, excess in tangents(goal, atoms):
        value = to_laurent(flatten(excess, atoms, {}), atoms)
        known.append(Known(({"fact": fact, "of": text(argument)},), value, ">="))
    for root, (itself, square) in list(atoms.squares.items()):
        inner = flatten(itself.args[0], atoms, {})
        value = to_laurent(root**2 - (inner**2 if isinstance(itself, Size) else inner), atoms)
        known.append(Known((square,), value, "=="))
    return known + [bound for atom, meaning in atoms.meanings().items() if not meaning.free_symbols
                    for bound in _enclosure(atom, meaning, atoms)]


def _enclosure(atom: sp.Symbol, meaning: sp.Expr, atoms: Atoms) -> list[Known]:
    """Rational bounds of a number such as log(2), which the checker encloses on its own."""
    context = Context({}, [])
    written = text(meaning)
    low, high = bounds(context, context.read(written))
    below, above = Fraction(math.floor(low * GRID), GRID), Fraction(math.ceil(high * GRID), GRID)
    sides = ((f"{written} - {below}", atom - sp.Rational(below)), (f"{above} - {written}", sp.Rational(above) - atom))
    return [Known(({"fact": "enclosure", "of": of},), to_laurent(value, atoms), ">=") for of, value in sides]

"""Products of sums: every sum over the index is a number of its own, named in the script, as the checker closes it."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from functools import reduce
from typing import Any

from workbench.kernel.normal import Normal
from workbench.kernel.syntax import NAMED, operation
from workbench.proof.checker import (
    Context,
    Number,
    Poly,
    Ratio,
    Relations,
    constant,
    number,
    symbol,
)

OF_AN_ATOM = re.compile(rf"{NAMED}a(\d+)(?:_\w+)?")


class Closed(Context):
    """Reads every sum as an atom, so that sums may be multiplied; of an atom's own name it knows the atom."""

    plain = False

    def node(self, node: ast.expr) -> Ratio:
        """The value of a syntax tree, also of one that holds names of atoms (`tree_of`)."""
        if isinstance(node, ast.Name) and (found := OF_AN_ATOM.fullmatch(node.id)):
            return symbol(next(atom for atom in self.functions if atom.endswith(f"#{found[1]}")))
        return super().node(node)

    def call(self, name: str, argument: Ratio) -> Ratio:
        """A function of an argument; a sum is closed at once."""
        return self.closed(super().call(name, argument))


def read_closed(stated: dict[str, Any]) -> tuple[Context, Relations]:
    """The context and the assumptions of a goal that `read_goal` has found well-formed, all sums closed."""
    context = Closed(stated.get("flow", {}), stated.get("indexed", []), stated.get("inputs", []))
    given = Relations(context, stated.get("assume", []))
    given.always = stated.get("always", [])
    given.initial = {name: context.read(text) for name, text in stated.get("initial", {}).items()}
    return context, given


def tree_of(value: Ratio, normal: Normal) -> ast.expr:
    """A value without free indices as an expression, functions and sums in it by their names."""
    over = _tree_of(value.num, normal)
    return over if value.den == constant(1) else operation(over, ast.Div(), _tree_of(value.den, normal))


def _tree_of(poly: Poly, normal: Normal) -> ast.expr:
    terms = [reduce(lambda a, b: operation(a, ast.Mult(), b),
                    [_power(atom, power, normal) for atom, power in monomial], _number(coefficient))
             for monomial, coefficient in sorted(poly.items())]
    return reduce(lambda a, b: operation(a, ast.Add(), b), terms) if terms else ast.Constant(0)


def _power(atom: str, power: int, normal: Normal) -> ast.expr:
    name = f"{NAMED}{normal.name(atom)}" if atom in normal.context.functions else atom
    base = ast.Name(name, ast.Load())
    return base if power == 1 else operation(base, ast.Pow(), ast.Constant(power))


def _number(value: Number) -> ast.expr:
    size: ast.expr = ast.Constant(abs(value.numerator))
    if value.denominator != 1:
        size = operation(size, ast.Div(), ast.Constant(value.denominator))
    return size if value >= 0 else ast.UnaryOp(ast.USub(), size)


@dataclass(frozen=True)
class Total:
    """A sum over the index as a sum of weights times totals.

    text: that as Coq text; each: its term of the index i; proof: the Coq term that says `text = bigsum n each`.
    """

    value: Ratio
    text: str
    each: str
    proof: str


def total(term: Ratio, normal: Normal) -> list[tuple[Ratio, Ratio]]:
    """The sum of a term as (weight, total): one for every monomial of the index, or of the whole term where an index
    stands below its fraction bar."""
    context = normal.context
    if normal.indexed(Ratio(term.den)):
        return [(number(1), context.total_of(term))]
    weights: dict[tuple[tuple[str, int], ...], Poly] = {}
    for monomial, coefficient in term.num.items():
        own = tuple(factor for factor in monomial if normal.indexed(symbol(factor[0])))
        rest = tuple(factor for factor in monomial if factor not in own)
        weights.setdefault(own, {})[rest] = coefficient
    return [(Ratio(poly, term.den), context.total_of(Ratio({own: 1}))) for own, poly in weights.items()]


def written(parts: list[tuple[Ratio, Ratio]], normal: Normal) -> Total:
    """That sum as Coq text with its proof; its weights and totals are named already."""
    value, text, each, proof = number(0), "0", "0", "(no_terms n)"
    for weight, one in reversed(parts):
        (((atom, _),), _), = one.num.items()
        name, of = normal.name(atom), normal.ratio(weight)
        value = value + weight * one
        each = f"({of} * {normal.ratio(normal.context.functions[atom][1])} + {each})"
        proof = f"(linear_sum n {of} _ _ _ _ {name}_is {proof})"
        text = f"({of} * {name} + {text})"
    return Total(value, text, each, proof)

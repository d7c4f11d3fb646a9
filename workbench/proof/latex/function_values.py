"""Values of one function as letters, `f(x)` and `f(y)`: where the arguments are equal, so are the values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

import sympy as sp

from workbench.proof.claim import Goal, Relation, differ, name_of
from workbench.proof.latex.brackets import inside_all
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.tree import Group, Letter

Pair = tuple[sp.Symbol, sp.Symbol, tuple[sp.Expr, ...]]  # two values, and by what their arguments differ


def values_of_one_function(letters: Mapping[str, sp.Expr], goal: Goal) -> list[Pair]:
    """Every two letters of a goal that are values of one function."""
    notation, used = Notation(letters), set(goal.symbols())
    found = [(head, meaning, arguments) for head, meaning, arguments in _applied(notation) if meaning in used]
    return [(one, two, tuple(a - b for a, b in zip(first, second, strict=True)))
            for (head, one, first), (other, two, second) in combinations(found, 2)
            if head == other and len(first) == len(second)]


def _applied(notation: Notation) -> Iterator[tuple[Letter, sp.Symbol, tuple[sp.Expr, ...]]]:
    """The letters with arguments that are symbols: function, symbol, arguments."""
    time = {} if "t" in notation.typed else {"t": sp.Symbol("t")}
    known = Notation({typed: meaning for typed, meaning in notation.given.items() if typed != "(t)"} | time)
    for head, pieces in notation.products.items():
        for factors, meaning in pieces:
            if isinstance(head, Letter) and len(factors) == 2 and isinstance(factors[1], Group) and (
                    isinstance(meaning, sp.Symbol)):
                try:
                    yield head, meaning, tuple(Converter(known).side(side) for side in inside_all(factors[1]))
                except LatexError:  # an argument that is no number
                    continue


def one_value_at_one_argument(pairs: list[Pair], point: Mapping[str, str]) -> bool:
    """Whether a point gives no function two values at the same arguments."""
    values = {name: sp.Rational(text) for name, text in point.items()}

    def at(expr: sp.Expr) -> sp.Expr:
        return expr.xreplace({symbol: values[name_of(symbol)] for symbol in expr.free_symbols
                              if name_of(symbol) in values})

    return all(at(one) == at(two) or any(at(difference) != 0 for difference in differences)
               for one, two, differences in pairs)


def apart(pairs: list[Pair]) -> tuple[Relation, ...]:
    """That the first arguments of all these values differ."""
    return tuple(differ(differences[0], 0) for _, _, differences in pairs if not differences[0].is_number)

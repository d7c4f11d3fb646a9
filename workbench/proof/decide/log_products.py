"""Decide a sum of logarithms with rational coefficients by the product of their arguments.

Where s > 0 makes all coefficients n_i of s m = sum n_i log(a_i) + r whole numbers, and X is the product of all
a_i**(-n_i), s m = (1 + r - X) + (X - 1 - log X): it is enough that X <= 1 + r, which has no logarithm in it. It is
shown as a relation between the products of the a_i in X's denominator and in its numerator.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import accumulate, pairwise
from math import lcm
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.decide.first_lemmas import first_lemmas
from workbench.proof.decide.squares import find_squares
from workbench.proof.derive import Side, Size
from workbench.proof.text import text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Search = Callable[[Goal, Relation, Given], Proof | None]
MOST_FACTORS = 8  # of the product, each as often as it stands there
MOST_SYMBOLS = 3  # of what is tried before all else


def find_by_log_products(goal: Goal, shown: Relation, given: Given, search: Search | None = None) -> Proof | None:
    """A proof of an inequality between sums of logarithms; None where it is of another kind or none is found.

    One logarithm with coefficient 1 or -1 is left to its tangents. search: for what has no logarithm any more; without
    one a few symbols are tried, by the quickest searches.
    """
    parts = None if shown.operator in ("==", "!=") else _parts(shown.margin)
    if parts is None:
        return None
    scale, counts, rest = parts
    above, below = (sp.Mul(*(a ** abs(n) for a, n in counts.items() if n * turn > 0)) for turn in (-1, 1))
    whole = Relation(sp.expand((1 + rest) * below), ">" if shown.strict else ">=", sp.expand(above))
    first = (search or _at_once)(goal, whole, given)
    if first is None:
        return None
    factors = [a ** (1 if n < 0 else -1) for a, n in counts.items() for _ in range(abs(n))]
    products = list(accumulate(factors, lambda one, two: one * two))
    defined = first_lemmas(goal, Relation(sp.Add(*map(sp.log, products)), ">", sp.S.Zero), given)
    terms: list[list[dict[str, Any]]] = [
        [{"assume": len(given) + len(defined)}, {"positive": text(1 / below)}],
        [{"fact": "log_tangent", "of": text(products[-1])}],
        *([{"fact": "log_product", "of": text(product), "and": text(factor)}]
          for (product, _), factor in zip(pairwise(products), factors[1:], strict=True))]
    last: Proof = {"rule": "combination", "terms": [{"coefficient": str(1 / scale), "factors": term} for term in terms]}
    return after([*defined, (whole, first)], last)


def _at_once(goal: Goal, shown: Relation, given: Given) -> Proof | None:
    if len(shown.margin.free_symbols) > MOST_SYMBOLS or sp.fraction(sp.together(shown.margin))[1].has(sp.Add):
        return None
    return find_combination(goal, shown, given, quick=True) or find_squares(goal, shown, given)


def _parts(margin: sp.Expr) -> tuple[sp.Rational, dict[sp.Expr, int], sp.Expr] | None:
    """s, the n_i by their a_i, and r; None where this is no sum of some logarithms with rational coefficients."""
    if not margin.has(sp.log) or margin.has(sp.Sum, sp.Indexed, sp.Derivative, Size, Side):
        return None
    found: dict[sp.Expr, sp.Rational] = {}
    rest: list[sp.Expr] = []
    for term in sp.Add.make_args(sp.expand(margin, log=False)):
        coefficient, inner = term.as_coeff_Mul()
        if isinstance(inner, sp.log) and coefficient.is_Rational:
            found[inner.args[0]] = found.get(inner.args[0], sp.S.Zero) + coefficient
        else:
            rest.append(term)
    coefficients = [c for c in found.values() if c != 0]
    others = sp.Add(*rest)
    if (not coefficients or (len(coefficients) == 1 and abs(coefficients[0]) == 1)
            or any(side.has(sp.log, sp.exp) for side in (others, *found))):
        return None
    scale = sp.Integer(lcm(*(int(c.q) for c in coefficients)))
    counts = {a: int(c * scale) for a, c in found.items() if c != 0}
    return (scale, counts, others * scale) if sum(map(abs, counts.values())) <= MOST_FACTORS else None

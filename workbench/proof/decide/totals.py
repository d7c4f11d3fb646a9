"""Decide statements in which sums over an index are multiplied, for every number of terms.

Each sum of a monomial of the index is a number of its own, a total. With letters for the totals the statement is one
about numbers, which the other deciders know. What they may use of totals are lemmas, each shown by squares: a sum of
squares is not negative, and Cauchy's inequality (sum p q)^2 <= sum p^2 sum q^2 for all totals of that shape.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, at_least, at_most
from workbench.proof.derive import expand_derivatives, unfold
from workbench.proof.text import relation_text, text
from workbench.proof.typed import evaluated

Proof = dict[str, Any]
Lemma = tuple[Relation, Callable[[int], Proof]]  # what holds of totals; its proof, after so many assumptions
NO_TEXTS = ("rule", "fact", "coefficient")
MOST_TOTALS = 8


class Totals:
    """Letters for the sums of monomials of the index."""

    def __init__(self) -> None:
        self.letters: dict[sp.Expr, sp.Symbol] = {}
        self.limits: sp.Tuple | None = None
        self.squares: dict[sp.Expr, sp.Expr] = {}  # roots of the squares that are summed, and their totals

    def closed(self, expr: sp.Expr) -> sp.Expr:
        """The expression with every sum as a polynomial of totals; ClaimError for a term that is no polynomial."""
        if isinstance(expr, sp.Sum):
            self.limits = expr.limits[0]
            total = self._of_term(expr.function)
            if expr.function.is_Pow and expr.function.exp.is_Integer and expr.function.exp % 2 == 0:
                self.squares[expr.function.base ** (expr.function.exp / 2)] = total
            return total
        return expr.func(*map(self.closed, expr.args)) if expr.args and expr.has(sp.Sum) else expr

    def _of_term(self, term: sp.Expr) -> sp.Expr:
        found = []
        for part in sp.Add.make_args(sp.expand(term)):
            outer, own = sp.Mul(*(f for f in sp.Mul.make_args(part) if not f.has(sp.Indexed))), sp.Integer(1)
            for factor in sp.Mul.make_args(part):
                base, power = factor.as_base_exp()
                if factor.has(sp.Indexed):
                    if not (isinstance(base, sp.Indexed) and power.is_Integer and power > 0):
                        raise ClaimError("a product of sums is decided where their terms are polynomials")
                    own *= factor
            found.append(outer * self.of(own))
        return sp.Add(*found)

    def of(self, monomial: sp.Expr) -> sp.Symbol:
        """The letter of the sum of a monomial."""
        return self.letters.setdefault(monomial, sp.Symbol(f"total_{len(self.letters)}", real=True))

    def lemmas(self, of_roots: bool) -> Iterator[Lemma]:
        """What is known of the totals that have letters: sums of squares first, then in pairs.

        of_roots: also sum p q <= sqrt(sum p^2) sqrt(sum q^2).
        """
        roots = {root: self.letters[m] for m in self.letters if (root := _root(m)) is not None}
        for root, letter in (roots | self.squares).items():
            yield at_least(letter, 0), partial(_sum_of_squares, root)
        for one, other in combinations(roots, 2):
            if (mixed := self.letters.get(one * other)) is not None:
                yield at_most(mixed**2, roots[one] * roots[other]), partial(_cauchy, text(one), text(other))
                if of_roots:
                    yield (at_most(mixed, sp.sqrt(roots[one]) * sp.sqrt(roots[other])),
                           partial(_cauchy_of_roots, text(one), text(other)))

    def named(self, proof: Any) -> Any:
        """A proof in which letters are the sums that they stand for."""
        sums = {str(letter): f"Sum({text(monomial)})" for monomial, letter in self.letters.items()}
        pattern = re.compile(rf"\b({'|'.join(sums)})\b")

        def put(part: Any, key: str = "") -> Any:
            if isinstance(part, dict):
                return {name: put(value, name) for name, value in part.items()}
            if isinstance(part, list):
                return [put(value) for value in part]
            return pattern.sub(lambda found: sums[found[1]], part) if isinstance(part, str) and (
                key not in NO_TEXTS) else part

        return put(proof)


def find_by_totals(goal: Goal, shown: Relation, given: tuple[Relation, ...],
                   search: Callable[..., Proof | None]) -> Proof | None:
    """A proof of a relation between expressions of sums, from the relations given at their places; None if none.

    search: finds a proof of a relation between numbers.
    """
    if not any(side.has(sp.Sum) for side in (shown.left, shown.right)):
        return None
    totals = Totals()
    try:
        here, *known = (_closed(r, goal, totals) for r in (shown, *given))
    except ClaimError:
        return None
    if not 0 < len(totals.letters) <= MOST_TOTALS:
        return None
    lemmas = list(totals.lemmas(any(power.exp == sp.S.Half for power in here.margin.atoms(sp.Pow))))
    found = search(Goal((at_least(0, 0),), facts=goal.facts), here, (*known, *(lemma for lemma, _ in lemmas)))
    if found is None:
        return None
    found = totals.named(found)
    for place, (lemma, proof) in reversed(list(enumerate(lemmas, len(given)))):
        found = {"rule": "cut", "lemma": totals.named(relation_text(lemma)), "proof": proof(place), "then": found}
    return found


def _closed(relation: Relation, goal: Goal, totals: Totals) -> Relation:
    left, right = (totals.closed(unfold(expand_derivatives(evaluated(side), goal.flow)))
                   for side in (relation.left, relation.right))
    return Relation(left, relation.operator, right)


def _root(monomial: sp.Expr) -> sp.Expr | None:
    """The monomial whose square this one is."""
    powers = monomial.as_powers_dict() if monomial != 1 else {}
    if any(power % 2 for power in powers.values()):
        return None
    return sp.Mul(*(base ** (power / 2) for base, power in powers.items()))


def _sum_of_squares(root: sp.Expr, place: int) -> Proof:  # whatever is assumed
    return {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"sum_of_squares": text(root)}]}]}


def _cauchy(p: str, q: str, place: int) -> Proof:
    """Were c = (sum p q)^2 - X Y > 0 for X = sum p^2, Y = sum q^2, then, with D = X + 1,

    0 = sum ((Y D + c) p - (sum p q) D q)^2 + c^2 (X + 2) + c D^2 Y > 0.
    """
    x, y, mixed = f"Sum(({p})**2)", f"Sum(({q})**2)", f"Sum(({p})*({q}))"
    root = f"({y}*({x} + 1) + {mixed}**2 - {x}*{y})*({p}) - {mixed}*({x} + 1)*({q})"
    above = {"assume": place}
    return {"rule": "contradiction", "terms": [
        {"coefficient": "1", "factors": [{"sum_of_squares": root}]},
        {"coefficient": "1", "factors": [above, above, {"positive": f"{x} + 2"}]},
        {"coefficient": "1", "factors": [above, {"square": f"{x} + 1"}, {"sum_of_squares": q}]}]}


def _cauchy_of_roots(p: str, q: str, place: int) -> Proof:
    """Were c = sum p q - r s > 0 for the roots r, s of X = sum p^2, Y = sum q^2, then

    0 = c^2 + 2 r s c + (X Y - (sum p q)^2) + (r^2 - X) s^2 + X (s^2 - Y) > 0, the third being the assumption before.
    """
    x, y = f"Sum(({p})**2)", f"Sum(({q})**2)"
    above, roots = {"assume": place}, [{"fact": "sqrt_nonnegative", "of": of} for of in (x, y)]
    return {"rule": "contradiction", "terms": [
        {"coefficient": "1", "factors": [above, above]}, {"coefficient": "2", "factors": [*roots, above]},
        {"coefficient": "1", "factors": [{"assume": place - 1}]},
        {"coefficient": "1", "factors": [{"fact": "sqrt_square", "of": x}, {"any": f"sqrt({y})**2"}]},
        {"coefficient": "1", "factors": [{"fact": "sqrt_square", "of": y}, {"any": x}]}]}

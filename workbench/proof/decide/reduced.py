"""What is shown, less multiples of what is assumed equal, where that lowers its degree.

On the curve q = 0 the relation p >= 0 says the same as p - c q >= 0. Of two polynomials that agree on the curve the one
of lower degree has the smaller search, and smaller numbers: far out on a curve the terms of the other nearly cancel.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.text import assumptions, text
from workbench.proof.typed import evaluated

Term = dict[str, Any]
MOST_TERMS = 100  # of a polynomial that is divided


@dataclass(frozen=True)
class Reduced:
    """A goal, and by the place of each equality the multiple of its margin by which the margin shown is less."""

    goal: Goal
    multiples: dict[int, sp.Expr]

    def terms_as_stated(self, terms: list[Term]) -> list[Term] | None:
        """Terms that name the opposite of what is shown, the last assumption, for the goal as it is stated.

        With n for the opposite's margin here and m for that stated, n = m + (multiples of equalities): so n**k is m**k
        and (n - m) times the sum of n**i m**(k-1-i). None where they name the opposite otherwise than by powers.
        """
        last, stated = len(assumptions(self.goal)), list[Term]()
        for term in terms:
            if any(last in (item.get("inverse"), item.get("square_of")) for item in term["factors"]):
                return None
            stated.append(term)
            if times := term["factors"].count({"assume": last}):
                others = [item for item in term["factors"] if item != {"assume": last}]
                stated += [{"coefficient": term["coefficient"],
                            "factors": [*others, {"assume": place}, {"any": text(multiple * self._powers(times))}]}
                           for place, multiple in self.multiples.items()]
        return stated

    def _powers(self, times: int) -> sp.Expr:
        """(n**k - m**k) / (n - m) of the opposites' margins, here and as stated."""
        here = -sp.expand(self.goal.show[0].margin)
        assumed = assumptions(self.goal)
        as_stated = sp.expand(here - sum(m * evaluated(assumed[p].margin) for p, m in self.multiples.items()))
        return sp.expand(sum(here**i * as_stated**(times - 1 - i) for i in range(times)))


def reduced(goal: Goal) -> Reduced | None:
    """The goal, of one inequality of polynomials, with what is shown of lower degree; None if there is no such."""
    shown, given = goal.show[0], assumptions(goal)
    margin = sp.expand(evaluated(shown.margin))
    zeros = {place: sp.expand(evaluated(r.margin)) for place, r in enumerate(given) if r.operator == "=="}
    symbols = sorted(margin.free_symbols.union(*(zero.free_symbols for zero in zeros.values())), key=str)
    if shown.operator in ("==", "!=") or not margin.free_symbols or not zeros or not all(
            p.is_polynomial(*symbols) and len(sp.Add.make_args(p)) <= MOST_TERMS for p in (margin, *zeros.values())):
        return None
    try:
        polynomial, *divisors = (sp.Poly(p, *symbols, domain="QQ") for p in (margin, *zeros.values()))
    except sp.CoercionFailed:  # numbers that are not rational
        return None
    if polynomial.total_degree() < min(divisor.total_degree() for divisor in divisors):
        return None
    quotients = sp.reduced(polynomial, divisors, order="grevlex")[0]
    degree = polynomial.total_degree()
    highest = [_homogeneous(q, degree - d.total_degree()) for q, d in zip(quotients, divisors, strict=True)]
    rest = polynomial - sum(q * d for q, d in zip(highest, divisors, strict=True))
    if rest.is_ground or rest.total_degree() >= degree:
        return None
    multiples = {place: q.as_expr() for place, q in zip(zeros, highest, strict=True) if not q.is_zero}
    return Reduced(Goal((Relation(rest.as_expr(), ">" if shown.strict else ">=", sp.S.Zero),), goal.assume), multiples)


def _homogeneous(polynomial: sp.Poly, degree: int) -> sp.Poly:
    """Its terms of one degree."""
    kept = {monomial: c for monomial, c in polynomial.terms() if sum(monomial) == degree}
    return sp.Poly.from_dict(kept or {(0,) * len(polynomial.gens): 0}, *polynomial.gens, domain="QQ")

"""Cases by the signs of factors and symbols: what is one inequality in each quadrant is often none over all of them.

The expressions whose signs are told apart are factors of what is shown and of what is assumed, then single symbols of
no known sign. In each case the margin is shown by the signs of its factors, or by the usual search.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError
from workbench.proof.claim import Goal, Relation, at_least, at_most, greater, less
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.decide.exact_look import Exact
from workbench.proof.decide.proposals import proposals
from workbench.proof.decide.sample_points import NEAR_ZERO, holds_at, sample_points, value_at
from workbench.proof.decide.sign_cases import by_sign
from workbench.proof.text import goal_text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Search = Callable[[Goal, Relation, Given], "Proof | None"]

MOST_SPLITS = 6  # expressions tried
DEEPEST = 2  # cases one inside the other
MOST_SEARCHES = 12  # of each depth, since most that fail have no proof in cases either
OF_SIGN = {1: at_least, -1: at_most}


def find_by_splits(goal: Goal, shown: Relation, given: Given, search: Search) -> Proof | None:
    """A proof of an inequality in cases; None where none was found. `search` proves what is plain in one case."""
    margin = shown.margin
    if shown.operator in ("==", "!=") or any(r.margin.has(sp.Sum, sp.Indexed, sp.Derivative) for r in (shown, *given)):
        return None
    if not margin.free_symbols or len(set().union(*(r.margin.free_symbols for r in (shown, *given)))) > 6:
        return None
    if _fails_somewhere(Goal((shown,), given, goal.flow, facts=goal.facts)):  # a look costs less than a search
        return None
    points = sample_points(shown, given)
    for depth in range(1, DEEPEST + 1):
        left = [MOST_SEARCHES]

        def limited(goal: Goal, shown: Relation, given: Given, left: list[int] = left) -> Proof | None:
            left[0] -= 1
            return search(goal, shown, given) if left[0] >= 0 else None

        if (found := _in_cases(goal, shown, given, points, limited, depth)) is not None:
            return found
    return None


def find_by_factor_signs(goal: Goal, shown: Relation, given: Given, search: Search) -> Proof | None:
    """A proof of a product with functions in it, in cases in each of which every factor has a sign; None where none was
    found. So (tanh x - tanh y) (x - y) >= 0 by the sign of x - y."""
    if shown.operator in ("==", "!=") or any(r.margin.has(sp.Sum, sp.Indexed, sp.Derivative) for r in (shown, *given)):
        return None
    if shown.margin.has(sp.Abs, sp.sign) or len(_factors(shown.margin)[1]) < 2:
        return None
    points, (_, odd) = sample_points(shown, given), _factors(shown.margin)
    plain = [sp.Add(*(term for term in sp.Add.make_args(factor) if not term.has(sp.Function))) for factor in odd]
    turned = [of for of in dict.fromkeys(plain) if of.free_symbols and not of.is_Symbol]

    def find(case: Relation) -> Proof | None:
        near = [point for point in points if holds_at(case, point)]
        return _by_factors(goal, shown, (*given, case), near, search)

    for of in (*turned[:2], *_candidates(shown, given)):
        if (proof := by_sign(of, find)) is not None:
            return proof
    return None


def _fails_somewhere(pointwise: Goal) -> bool:
    """Whether a point is near at hand at which what is given holds and what is shown does not."""
    try:
        exact = Exact(goal_text(pointwise))
        return any(exact.breaks(point) for point in proposals(pointwise.evaluated(), 1, True))
    except (CertificateError, ClaimError):  # the checker reads no such goal
        return False


def _in_cases(goal: Goal, shown: Relation, given: Given, points: list[dict[sp.Symbol, float]], search: Search,
              depth: int) -> Proof | None:
    def find(case: Relation) -> Proof | None:
        here, near = (*given, case), [point for point in points if holds_at(case, point)]
        return (_by_factors(goal, shown, here, near, search) or search(goal, shown, here)
                or (_in_cases(goal, shown, here, near, search, depth - 1) if depth > 1 else None))

    for of in _candidates(shown, given):
        if (proof := by_sign(of, find)) is not None:
            return proof
    return None


def _candidates(shown: Relation, given: Given) -> list[sp.Expr]:
    """Expressions to tell the signs of, each once."""
    known = _of_known_sign(shown, given)
    unknown = [s for s in sorted(shown.margin.free_symbols, key=str) if s not in known]
    factors = [f for r in (shown, *given) for f in _factors(r.margin)[1] if len(_factors(r.margin)[1]) > 1]
    polynomials = [f for f in factors if f.is_polynomial(*f.free_symbols) and not f.is_Symbol]
    candidates = [*[f for f in factors if f.is_Symbol], *polynomials, *unknown]
    if _is_quadratic(shown.margin, unknown, given):
        candidates = [of for of in candidates if of.free_symbols <= known]
    tried: list[sp.Expr] = []
    for of in candidates:
        told = [r.margin for r in given if r.operator not in ("==", "!=")] + tried
        if of not in known and not any(0 in (sp.expand(t - of), sp.expand(t + of)) for t in told):
            tried.append(of)
    return tried[:MOST_SPLITS]


def _of_known_sign(shown: Relation, given: Given) -> set[sp.Expr]:
    """Symbols that are positive or negative by what is given, or as they are."""
    return {s for r in (shown, *given) for s in r.margin.free_symbols if s.is_nonnegative or s.is_nonpositive} | {
        s for r in given if r.operator != "!=" for s in r.margin.free_symbols
        if not sp.cancel(r.margin / s).free_symbols}


def _is_quadratic(margin: sp.Expr, unknown: list[sp.Symbol], given: Given) -> bool:
    """Whether a margin is a quadratic form in symbols of which nothing is known: their signs matter to none, and where
    it is nowhere negative it is a sum of squares."""
    if not unknown or any(not r.margin.free_symbols.isdisjoint(unknown) for r in given):
        return False
    return bool(margin.is_polynomial(*unknown)) and sp.Poly(margin, *unknown).total_degree() <= 2


def _factors(margin: sp.Expr) -> tuple[sp.Expr, list[sp.Expr]]:
    """The number and the factors of odd power of a margin; those of even power have no sign to show."""
    number, odd = sp.S.One, []
    for factor in sp.Mul.make_args(sp.factor(margin)):
        base, power = factor.as_base_exp()
        if factor.is_number:
            number *= factor
        elif power.is_Integer and power % 2:
            odd.append(base)
        elif not power.is_Integer:
            odd.append(factor)
    return number, odd


def _by_factors(goal: Goal, shown: Relation, given: Given, points: list[dict[sp.Symbol, float]], search: Search,
                ) -> Proof | None:
    """A margin that is a product, from the sign of each of its factors."""
    number, odd = _factors(shown.margin)
    if len(odd) < 2 or not points:
        return None
    lemmas: list[tuple[Relation, Proof]] = []
    for factor in odd:
        values = [v for point in points if (v := value_at(factor, point)) is not None]
        sign = 1 if all(v > -NEAR_ZERO for v in values) else -1 if all(v < NEAR_ZERO for v in values) else 0
        if not sign:
            return None
        strict = shown.strict and (greater if sign > 0 else less)
        lemma = strict(factor, 0) if strict else OF_SIGN[sign](factor, 0)
        proof = search(goal, lemma, (*given, *(known for known, _ in lemmas)))
        if proof is None:
            return None
        lemmas.append((lemma, proof))
    last = find_combination(goal, shown, (*given, *(known for known, _ in lemmas)))
    last = last or _product(shown, number, [known for known, _ in lemmas], len(given))
    return None if last is None else after(lemmas, last)


def _product(shown: Relation, number: sp.Expr, signs: list[Relation], first: int) -> Proof | None:
    """The margin as the product of what is known of its factors, which are assumed from a place on; None where it has
    factors of even power, which have no sign."""
    product = abs(number) * sp.Mul(*(known.margin for known in signs))
    if not number.is_Rational or sp.expand(product - shown.margin) != 0:
        return None
    factors = [{"assume": first + place} for place in range(len(signs))]
    return {"rule": "combination", "terms": [{"coefficient": str(abs(number)), "factors": factors}]}

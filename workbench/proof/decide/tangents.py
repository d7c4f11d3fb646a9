"""Decide a bound that an exponential meets, or nearly meets, at one place: by its tangent there.

exp(a) >= exp(q) (1 + a - q) for every q; floating point says for which q the margin is least. What is shown is first
brought over one denominator, of known sign. Logarithms are compared by that of the quotient of their arguments.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice, permutations, product
from typing import Any

import numpy as np
import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, equal, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.derive import Side, Size
from workbench.proof.text import text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
MOST_EXPONENTS = 3
DIGITS = (0, 1, 4)  # after the point, of the places where tangents are taken
PLACES = np.concatenate([-np.geomspace(50, 1e-3, 1_500), [0.0], np.geomspace(1e-3, 50, 1_500)])


def find_by_tangents(goal: Goal, shown: Relation, given: Given) -> Proof | None:
    """A proof of an inequality from tangents of its exponentials, or of its logarithms; None if none is found."""
    margin = shown.margin
    if shown.operator in ("==", "!=") or margin.has(sp.Sum, sp.Indexed, Size, Side):
        return None
    if margin.has(sp.log):
        return _of_logarithms(goal, shown, given)
    arguments = sorted({e.exp for e in margin.atoms(sp.exp) if e.exp.free_symbols}, key=sp.default_sort_key)
    found = _at_each_other(goal, shown, given, arguments[:MOST_EXPONENTS])
    if found is not None or not 0 < len(arguments) <= 2:
        return found
    numerator, denominator = sp.fraction(sp.together(margin))
    for places, turn in product(_least(margin, arguments, given), (1, -1)):
        facts = tuple(turn * (a - q) for a, q in zip(arguments, places, strict=True))
        near = replace(goal, facts=(*goal.facts, *facts))
        found = find_combination(near, shown, given, quick=True)
        if found is None and not denominator.is_number:
            lemma = at_least(sp.expand(numerator), 0)
            first = find_combination(near, lemma, given, quick=True)
            if first is not None and (rest := find_combination(goal, shown, (*given, lemma))) is not None:
                return after([(lemma, first)], rest)
        if found is not None:
            return found
    return _by_halves(goal, shown, given, arguments)


def _by_halves(goal: Goal, shown: Relation, given: Given, arguments: list[sp.Expr]) -> Proof | None:
    """A proof from tangents of exp(a/2), whose square exp(a) is: squares of an argument are no match for others."""
    for places in islice(_least(shown.margin, arguments, given), len(DIGITS)):
        facts = tuple((a - q) / 2 for a, q in zip(arguments, places, strict=True))
        for turn in (1, -1):
            near = replace(goal, facts=(*goal.facts, *(turn * fact for fact in facts)))
            found = find_combination(near, shown, given)
            if found is not None:
                return found
    return None


def _at_each_other(goal: Goal, shown: Relation, given: Given, arguments: list[sp.Expr]) -> Proof | None:
    """A proof from tangents at one of the exponents, b: exp(a) >= exp(b) (1 + a - b) of every other one, and of 0."""
    for b in arguments:
        at_b, steps = sp.exp(b), list[tuple[Relation, Proof]]()
        for a in (sp.S.Zero, *(a for a in arguments if a != b)):
            tangent = [{"fact": "exp_positive", "of": text(b)}, {"fact": "exp_tangent", "of": text(a - b)}]
            terms: list[dict[str, Any]] = [{"coefficient": "1", "factors": tangent}]
            if a != 0:
                terms.append({"coefficient": "1", "factors": [{"fact": "exp_sum", "of": text(b), "and": text(a - b)}]})
            steps.append((at_least(sp.exp(a), at_b * (1 + a - b)), {"rule": "combination", "terms": terms}))
        found = find_combination(replace(goal, facts=()), shown, (*given, *(lemma for lemma, _ in steps)))
        if found is not None:
            return after(steps, found)
    return None


def _least(margin: sp.Expr, arguments: list[sp.Expr], given: Given) -> Iterator[list[sp.Rational]]:
    """What the arguments are where the margin is least, each other symbol being 1, to some digits."""
    for symbol in sorted(margin.free_symbols, key=lambda s: (s.is_positive is True, str(s))):
        one = dict.fromkeys(margin.free_symbols - {symbol}, sp.S.One)
        kept = [r.margin for r in given if r.operator != "!=" and r.margin.free_symbols == {symbol}]

        def values(places: np.ndarray, of: sp.Symbol = symbol, bounds: Any = kept, at: Any = one) -> np.ndarray:
            with np.errstate(all="ignore"):
                found = _on(of, margin.xreplace(at))(places) + 0 * places
                for bound in bounds:
                    found = np.where(_on(of, bound)(places) < 0, np.inf, found)
            return np.where(np.isfinite(found), found, np.inf)

        coarse = int(np.argmin(values(PLACES)))
        if not np.isfinite(values(PLACES[coarse:coarse + 1])).all():
            continue
        finer = np.linspace(PLACES[max(coarse - 1, 0)], PLACES[min(coarse + 1, len(PLACES) - 1)], 4_001)
        least = one | {symbol: sp.Float(float(finer[np.argmin(values(finer))]))}
        at = [a.xreplace(least) for a in arguments]
        if not all(value.is_real and value.is_finite for value in at):  # an argument may have a pole there
            continue
        for digits in DIGITS:
            yield [_shortened(float(value), digits) for value in at]


def _on(symbol: sp.Symbol, expr: sp.Expr) -> Callable[[np.ndarray], np.ndarray]:
    if expr.has(sp.zoo, sp.nan):  # where the others are 1 it is defined nowhere
        return lambda places: np.full_like(places, np.nan)
    return sp.lambdify(symbol, expr, "numpy")


def _shortened(value: float, digits: int) -> sp.Rational:
    """The number with so many digits after the point: the nearest where there is none, else the next towards zero."""
    scale = 10**digits
    found = Fraction(round(value) if not digits else int(value * scale), scale)
    return sp.Rational(found.numerator, found.denominator)


def _of_logarithms(goal: Goal, shown: Relation, given: Given) -> Proof | None:
    """exp(-m) >= 1 - m for a margin m, where exp(log a) is a; log a - log b = log(a/b) <= a/b - 1 for logarithms that
    stand in what is shown."""
    scales = {abs(c) for term in sp.Add.make_args(sp.expand(shown.margin, log=False))
              for c, rest in [term.as_coeff_Mul()] if isinstance(rest, sp.log)}
    if len(scales) == 1 and (scale := scales.pop()).is_Rational:
        turned = -sp.expand(shown.margin / scale, log=False)
        found = find_combination(replace(goal, facts=(*goal.facts, turned)), shown, given)
        if found is not None:
            return found
    inside = sorted({log.args[0] for log in shown.margin.atoms(sp.log)}, key=sp.default_sort_key)[:3]
    for a, b in permutations(inside, 2):
        found = _from_quotients(goal, shown, given, [(a, b)])
        if found is not None:
            return found
    moving = [a for a in inside if a.free_symbols]
    for places in _least(shown.margin, moving, given) if moving else ():
        if all(place > 0 for place in places):
            found = _from_quotients(goal, shown, given, list(zip(moving, places, strict=True)), both=True)
            if found is not None:
                return found
    return None


def _from_quotients(goal: Goal, shown: Relation, given: Given, pairs: list[tuple[sp.Expr, sp.Expr]],
                    both: bool = False) -> Proof | None:
    """A proof from 1 - b/a <= log(a/b) <= a/b - 1 of pairs (a, b); the lower bound only if both are asked for."""
    steps: list[tuple[Relation, Proof]] = []
    for a, b in pairs:
        for positive in (greater(a, 0), greater(b, 0)):
            known = (*given, *(lemma for lemma, _ in steps))
            first = find_combination(goal, positive, known) if positive.margin.free_symbols else None
            if first is not None:
                steps.append((positive, first))
        quotient = sp.log(a / b, evaluate=False)
        steps += [(equal(quotient, sp.log(a) - sp.log(b)), _single("log_product", b, a / b)),
                  (at_least(a / b - 1 - quotient, 0), _single("log_tangent", a / b))]
        if both:
            steps += [(equal(sp.log(b / a, evaluate=False), sp.log(b) - sp.log(a)), _single("log_product", a, b / a)),
                      (at_least(b / a - 1 - sp.log(b / a, evaluate=False), 0), _single("log_tangent", b / a))]
    found = find_combination(goal, shown, (*given, *(lemma for lemma, _ in steps)))
    return None if found is None else after(steps, found)


def _single(fact: str, one: sp.Expr, other: sp.Expr | None = None) -> Proof:
    factor = {"fact": fact, "of": text(one)} | ({} if other is None else {"and": text(other)})
    return {"rule": "combination", "terms": [{"coefficient": "-1" if other is not None else "1", "factors": [factor]}]}

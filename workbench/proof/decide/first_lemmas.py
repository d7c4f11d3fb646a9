"""What is shown before a search begins: that what a relation divides by, or takes a root or logarithm of, has its sign.

The checker sees the sign of a denominator that is assumed, or whose terms all have one. Of others it wants a lemma:
1 + y > 0 where y >= x >= 0, x**2 - x + 1 > 0. Likewise x**2 + y**2 > 0 where it is assumed not to be zero.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, at_least, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.laurent import goal_atoms, positive_by_terms
from workbench.proof.decide.squares import find_squares
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.text import assumptions, text

Lemma = tuple[Relation, dict[str, Any]]
Given = tuple[Relation, ...]
OTHERS = (sp.Sum, sp.Indexed, sp.Abs, sp.sign, sp.Max, sp.Min, sp.Derivative, sp.core.function.AppliedUndef)


def first_lemmas(goal: Goal, shown: Relation, given: Given) -> list[Lemma]:
    """Lemmas with their proofs, each from what is given and the lemmas before it."""
    found: list[Lemma] = []
    for place, relation in enumerate(given):
        squares = _squares_in(relation.margin) if relation.operator == "!=" else None
        if squares is not None:
            proof = _positive_if_not_zero(squares, place, len(given) + len(found))
            found.append((greater(relation.margin, 0), proof))
    found += _sizes_below(shown, given, len(given) + len(found))
    found += _factors_below(shown, (*given, *(lemma for lemma, _ in found)))
    found += _cosines_below(goal, shown, (*given, *(lemma for lemma, _ in found)))
    return found + definedness(goal, shown, (*given, *(lemma for lemma, _ in found)))


def definedness(goal: Goal, shown: Relation, given: Given) -> list[Lemma]:
    """The signs that a relation needs to be defined and that the checker does not see without a lemma."""
    return _shown(goal, _partial(shown), given)


def definedness_of_goal(goal: Goal) -> list[Lemma]:
    """The same of all that a goal shows, before its cases are looked at, and of the rates of its flow: that an inertia
    m (2 + cos(q)) is positive."""
    rates = (Relation(rate, "==", sp.S.Zero) for rate in goal.flow.values())
    return _shown(goal, list(dict.fromkeys(wanted for one in (*rates, *goal.show) for wanted in _partial(one))),
                  assumptions(goal))


def _shown(goal: Goal, wanted_signs: list[Relation], given: Given) -> list[Lemma]:
    found: list[Lemma] = []
    for wanted in wanted_signs:
        known = (*given, *(lemma for lemma, _ in found))
        if not seen_at_once(wanted, known):
            lemma = _signed(goal, wanted, known)
            found += [] if lemma is None else [lemma]
    return found


def roots_below(goal: Goal, shown: Relation, given: Given) -> list[Lemma]:
    """Of every root that a relation divides by how small it may be: sqrt(4 + x**2) >= 2, by its constant term."""
    found: list[Lemma] = []
    powers = {power for side in (shown.left, shown.right) for power in side.atoms(sp.Pow)
              if power.exp.is_Rational and power.exp < 0 and not power.exp.is_Integer and not power.base.has(*OTHERS)}
    for power in sorted(powers, key=sp.default_sort_key):
        least = sp.sqrt(sp.expand(power.base).as_coeff_Add()[0])
        lemma = at_least(sp.sqrt(power.base), least)
        if least.is_Rational and least > 0 and power.base.free_symbols:
            known = (*given, *(other for other, _ in found))
            proof = find_combination(goal, lemma, known, quick=True) or find_squares(goal, lemma, known)
            found += [] if proof is None else [(lemma, proof)]
    return found


def _sizes_below(shown: Relation, given: Given, last: int) -> list[Lemma]:
    """abs(v) > 0 for every size that a relation divides by, where v is assumed to have a sign or not to be zero.

    Were abs(v) <= 0, then v**2 + abs(v) (-abs(v)) + (abs(v)**2 - v**2) = 0 > 0.
    """
    bases = [power.base for side in (shown.left, shown.right) for power in side.atoms(sp.Pow)
             if power.exp.is_Rational and power.exp < 0]
    sizes = set().union(*(base.atoms(sp.Abs) for base in bases)) if bases else set()
    found: list[Lemma] = []
    for size in sorted(sizes, key=sp.default_sort_key):
        inner = size.args[0]
        known = [place for place, r in enumerate(given) if r.operator in ("!=", "<", ">") and not inner.has(*OTHERS)
                 and not r.margin.has(*OTHERS) and (vanishes(r.margin - inner) or vanishes(r.margin + inner))]
        if not known:
            continue
        place = known[0]
        square = [{"square_of": place}] if given[place].operator == "!=" else [{"assume": place}, {"assume": place}]
        factors: list[list[dict[str, Any]]] = [
            square, [{"fact": "abs_nonnegative", "of": text(inner)}, {"assume": last + len(found)}],
            [{"fact": "abs_square", "of": text(inner)}]]
        found.append((greater(size, 0), {"rule": "contradiction", "terms": [
            {"coefficient": "1", "factors": each} for each in factors]}))
    return found


def _factors_below(shown: Relation, given: Given) -> list[Lemma]:
    """p > 0 and q > 0 where c p q > 0 is assumed and p + q > 0 is plain, of what a relation needs to be defined: for
    x**2 < b**2, b > 0 that are b - x and b + x.

    Were p <= 0, then p q + (p + q) (-p) + p**2 = 0 > 0.
    """
    parts = {sp.expand(factor.as_base_exp()[0]) for wanted in _partial(shown) if not seen_at_once(wanted, given)
             for factor in sp.Mul.make_args(sp.factor(wanted.left)) if factor.free_symbols}
    found: list[Lemma] = []
    for place, relation in enumerate(given) if parts else ():
        margin = relation.margin
        if not relation.strict or margin.has(*OTHERS) or not margin.is_polynomial(*margin.free_symbols):
            continue
        number, powers = sp.factor_list(margin)
        if len(powers) != 2 or any(power != 1 for _, power in powers):
            continue
        (first, _), (second, _) = powers
        for turn in (1, -1):
            one, two = turn * first, turn * second * sp.sign(number)
            whole = sp.expand(one + two)
            if not parts & {one, -one, two, -two} or not positive_by_terms(whole, goal_atoms(given)):
                continue
            for part in (one, two):
                factors: list[tuple[Any, list[dict[str, Any]]]] = [
                    (1 / abs(number), [{"assume": place}]),
                    (1, [{"positive": text(whole)}, {"assume": len(given) + len(found)}]),
                    (1, [{"square": text(part)}])]
                found.append((greater(part, 0), {"rule": "contradiction", "terms": [
                    {"coefficient": str(scale), "factors": each} for scale, each in factors]}))
            break
    return found


def _cosines_below(goal: Goal, shown: Relation, given: Given) -> list[Lemma]:
    """cos(v) > 0 for every tan(v) that a relation holds, where nothing that is given says so."""
    found: list[Lemma] = []
    for tangent in sorted(shown.left.atoms(sp.tan) | shown.right.atoms(sp.tan), key=sp.default_sort_key):
        cosine = sp.cos(tangent.args[0], evaluate=False)  # sympy knows that of arctan as a root
        if not any(vanishes(r.margin - cosine) or vanishes(r.margin + cosine) for r in given):
            lemma = greater(cosine, 0)
            proof = find_combination(goal, lemma, (*given, *(other for other, _ in found)))
            found += [] if proof is None else [(lemma, proof)]
    return found


def _partial(shown: Relation) -> list[Relation]:
    """What must hold for a relation to be defined; of a denominator that it is positive."""
    found: list[Relation] = []
    for side in (shown.left, shown.right):
        for power in sorted(side.atoms(sp.Pow), key=sp.default_sort_key):
            if power.exp.is_Rational and power.exp < 0:
                base = power.base
                while isinstance(base, sp.Pow) and base.exp == sp.S.Half:  # a root is positive where what is below is
                    base = base.base
                found.append(greater(base, 0))
            elif power.exp.is_Rational and not power.exp.is_Integer:
                found.append(at_least(power.base, 0))
        found += [greater(log.args[0], 0) for log in sorted(side.atoms(sp.log), key=sp.default_sort_key)]
    positive = {r.left for r in found if r.strict}  # what is positive need not be shown to be not negative first
    found = [r for r in dict.fromkeys(found) if r.left.free_symbols and not r.left.has(*OTHERS)
             and (r.strict or r.left not in positive)]
    return sorted(found, key=lambda r: int(r.left.count_ops()))


def seen_at_once(wanted: Relation, given: Given) -> bool:
    """Whether the checker sees it without a lemma, or sees at least that a denominator is not zero."""
    if any(r.operator != "==" and (vanishes(r.margin - wanted.left) or vanishes(r.margin + wanted.left))
           for r in given):
        return True
    try:
        atoms, base = goal_atoms(given), sp.factor(wanted.left)
        return all(positive_by_terms(part, atoms) or positive_by_terms(-part, atoms)
                   or any(r.operator not in ("==", ">=", "<=") and vanishes(sp.cancel(r.margin / part) ** 2 - 1)
                          for r in given)
                   for part in (factor.as_base_exp()[0] for factor in sp.Mul.make_args(base)) if part.free_symbols)
    except ClaimError:  # functions: the checker sees the signs of all but the circle's, which have none
        return not wanted.left.has(sp.sin, sp.cos)


def _signed(goal: Goal, wanted: Relation, given: Given) -> Lemma | None:
    """What is wanted, or of a denominator that it is negative, with a proof; None where there is none."""
    left = _over_positive(wanted.left, given)
    for turn in (1, -1) if wanted.operator == ">" else (1,):
        lemma = Relation(sp.expand(turn * left), wanted.operator, sp.S.Zero)
        proof = find_combination(goal, lemma, given, quick=True) or find_squares(goal, lemma, given)
        if proof is not None:
            return lemma, proof
    return None


def _over_positive(left: sp.Expr, given: Given) -> sp.Expr:
    """The numerator of what has a positive denominator, by which the checker sees its sign: of 1 - e**2/b**2 that is
    b**2 - e**2. What has none stays as it is."""
    above, below = sp.fraction(sp.together(left))
    try:
        return above if below.free_symbols and positive_by_terms(sp.expand(below), goal_atoms(given)) else left
    except ClaimError:  # functions stand in it
        return left


def _squares_in(margin: sp.Expr) -> list[tuple[sp.Expr, sp.Expr]] | None:
    """(number, root) with margin the sum of number * root**2, every number positive, or None."""
    found = []
    for term in sp.Add.make_args(margin):
        number, powers = term.as_coeff_Mul()
        if not number.is_Rational or number < 0 or any(
                not base.is_Symbol or not power.is_Integer or power < 0 or power % 2
                for base, power in powers.as_powers_dict().items() if base != 1):
            return None
        found.append((number, sp.Mul(*(base ** (power / 2) for base, power in powers.as_powers_dict().items()))))
    return found


def _positive_if_not_zero(squares: list[tuple[sp.Expr, sp.Expr]], place: int, last: int) -> dict[str, Any]:
    """A proof of v > 0 for a sum v of squares that is not zero: were v <= 0, then v**2 + v (-v) = 0 > 0."""
    terms: list[dict[str, Any]] = [{"coefficient": "1", "factors": [{"square_of": place}]}]
    for number, root in squares:
        factors: list[dict[str, Any]] = [{"assume": last}, *([] if root == 1 else [{"square": text(root)}])]
        terms.append({"coefficient": str(number), "factors": factors})
    return {"rule": "contradiction", "terms": terms}

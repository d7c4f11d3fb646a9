"""Inequalities of fractions over inertias a + b cos(q), and over lengths sqrt(x**2 + y**2): those of the numerators."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Operator, Relation
from workbench.proof.decide.cuts import after
from workbench.proof.decide.first_lemmas import definedness
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Prove = Callable[[Goal, Relation, Given], Proof | None]


def find_over_denominator(goal: Goal, shown: Relation, given: Given, prove: Prove) -> Proof | None:
    """A proof that a fraction's numerator is as it should be, its denominator a product of what is known to be
    positive; None where there is no such denominator, or no proof."""
    margin = expand_derivatives(shown.margin, goal.flow)
    if shown.operator == "!=" or margin.has(sp.Sum, sp.Indexed):
        return None
    lengths = _lengths(margin)
    fraction = sp.together(margin.xreplace({power: lengths[sp.sqrt(power.base)] ** (2 * power.exp)
                                            for power in margin.atoms(sp.Pow) if _is_root(power)
                                            and sp.sqrt(power.base) in lengths}))
    numerator, denominator = sp.fraction(fraction)
    if not denominator.has(sp.sin, sp.cos, *lengths.values()):
        return None
    first = definedness(goal, Relation(sp.together(margin), "==", sp.S.Zero), given)
    known = (*given, *(lemma for lemma, _ in first))
    number, factors = sp.factor_terms(denominator).as_coeff_Mul()
    multiplier = _positive_factors(factors, known, {mark: root.base for root, mark in lengths.items()})
    if multiplier is None or not number > 0:
        return None
    rest, terms = sp.expand(numerator / number), list[dict[str, Any]]()
    if lengths and not rest.is_polynomial(*lengths.values()):
        return None  # a length within a function
    for root, mark in lengths.items():  # to the checker the square of a root is no expression below it yet
        cofactor, rest = sp.div(rest, mark**2 - root.base, mark)
        if cofactor != 0:
            said = text(cofactor)
            for each, other in lengths.items():
                said = said.replace(other.name, f"sqrt({text(each.base)})")
            terms.append({"coefficient": "1", "factors": [
                {"fact": "sqrt_square", "of": text(root.base)}, {"any": said}]})
    plain = sp.expand(rest.xreplace({mark: root for root, mark in lengths.items()}))
    operator: Operator = "==" if shown.operator == "==" else ">" if shown.strict else ">="
    lemma = Relation(plain, operator, sp.S.Zero)
    proof = prove(goal, lemma, known)
    if proof is None:
        return None
    return after([*first, (lemma, proof)], {"rule": "combination", "multiplier": multiplier, "terms": [
        {"coefficient": "1", "factors": [{"assume": len(known)}]}, *terms]})


def _lengths(margin: sp.Expr) -> dict[sp.Pow, sp.Symbol]:
    """The roots that a fraction divides by, of sums, with symbols that stand for them."""
    below = {power.base for power in margin.atoms(sp.Pow) if _is_root(power) and power.exp < 0 and power.base.is_Add}
    return {sp.sqrt(base): sp.Symbol(f"length {number}", positive=True)
            for number, base in enumerate(sorted(below, key=sp.default_sort_key))}


def _is_root(power: sp.Pow) -> bool:
    return bool(power.exp.is_Rational) and power.exp.q == 2


def _positive_factors(product: sp.Expr, known: Given, insides: dict[sp.Expr, sp.Expr]) -> list[dict[str, Any]] | None:
    """The factors of a product as the checker sees that each is positive; None where it does not. insides: what is
    below the roots for which symbols stand."""
    found: list[dict[str, Any]] = []
    for base, power in (factor.as_base_exp() for factor in sp.Mul.make_args(product)):
        inside = insides.get(base)
        places = [place for place, r in enumerate(known) if r.strict and vanishes(r.margin - (inside or base))]
        if not power.is_Integer or not power > 0 or not (places or base.is_positive):
            return None
        how = ({"fact": "sqrt_positive", "of": text(inside)} if inside is not None else
               {"assume": places[0]} if places else {"positive": text(base)})
        found += [how] * int(power)
    return found

"""Identities that need what roots of numbers are, as sqrt(2)**2 == 2 and sqrt(2)*sqrt(3) == sqrt(6): to the checker
such a root is a symbol.

A root whose product with some of the others is a rational number is the others' product times a number: a lemma says
so, with which it is replaced. Products of what is left are independent over the rational numbers, so that an identity
holds where nothing is left once their squares are numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import isqrt, prod
from typing import Any

from workbench.proof.checker import CertificateError, Context, Poly, Ratio, constant, margin, read_goal

Proof = dict[str, Any]
MOST_ROOTS = 5  # multiplied with each other


@dataclass(frozen=True)
class Dependent:
    """A root that is a number times the product of others: root * below == top * product, both rational numbers."""

    atom: str
    others: tuple[str, ...]
    below: Fraction
    top: Fraction


def with_root_squares(record: dict[str, Any], proofs: list[Proof]) -> list[Proof]:
    """The proofs of a certificate's goal, those by identity alone as ones by the squares of numbers' roots where the
    checker would see two sides that differ."""
    return [_by_squares(record, place) or proof if proof == {"rule": "identity"} else proof
            for place, proof in enumerate(proofs)]


def _by_squares(record: dict[str, Any], place: int) -> Proof | None:
    """A proof that an equality holds: its numerator is a sum of multiples of root**2 - number."""
    try:
        context, _ = read_goal(record)
        value, operator = margin(context, record["show"][place])
    except CertificateError:  # a rate of what has none everywhere: not for an identity to show
        return None
    roots = {atom: number for atom, (kind, of) in context.functions.items()
             if kind == "sqrt" and (number := _number(of)) is not None and number > 0}
    if operator != "==" or value.is_zero() or not roots:
        return None
    ((below, scale),) = value.den.items() if len(value.den) == 1 else (((("", 1),), Fraction(0)),)
    if scale <= 0 or any(atom not in roots for atom, _ in below):
        return None
    rest, terms = dict(value.num), list[dict[str, Any]]()
    used: list[Dependent] = []
    for root in _dependent(roots):
        rest, multiple = _replaced(rest, root)
        if multiple:
            terms.append({"coefficient": str(Fraction(1) / (scale * root.below)), "factors": [
                {"assume": len(record.get("assume", [])) + len(used)}, {"any": polynomial_text(context, multiple)}]})
            used.append(root)
    for atom, number in roots.items():
        cofactor: Poly = {}
        while found := next(((m, c) for m, c in rest.items() if dict(m).get(atom, 0) >= 2), None):
            monomial, coefficient = found
            lower = _times(monomial, atom, -2)
            cofactor[lower] = cofactor.get(lower, Fraction(0)) + coefficient
            del rest[monomial]
            rest[lower] = rest.get(lower, Fraction(0)) + coefficient * number
        if cofactor:
            terms.append({"coefficient": str(Fraction(1) / scale), "factors": [
                {"fact": "sqrt_square", "of": str(number)}, {"any": polynomial_text(context, cofactor)}]})
    if any(rest.values()):
        return None
    positive = [{"fact": "sqrt_positive", "of": str(roots[atom])} for atom, power in below for _ in range(power)]
    proof: Proof = {"rule": "combination", "multiplier": positive, "terms": terms}
    for root in reversed(used):
        proof = {"rule": "cut", **_product_lemma(roots, root), "then": proof}
    return proof


def _dependent(roots: dict[str, Fraction]) -> list[Dependent]:
    """The roots that are products of those before them, times a number."""
    found, independent = list[Dependent](), list[str]()
    for atom, number in roots.items():
        for chosen in (c for size in range(1, MOST_ROOTS) for c in combinations(independent, size)):
            below = prod((roots[other] for other in chosen), start=Fraction(1))
            top = _root(number * below)
            if top is not None:
                found.append(Dependent(atom, chosen, below, top))
                break
        else:
            independent.append(atom)
    return found


def _root(value: Fraction) -> Fraction | None:
    up, down = isqrt(value.numerator), isqrt(value.denominator)
    return Fraction(up, down) if (up * up, down * down) == (value.numerator, value.denominator) else None


def _replaced(poly: Poly, root: Dependent) -> tuple[Poly, Poly]:
    """A polynomial with the root replaced, and the multiple of root * below - top * product by which it differs, times
    `below`; an even power is left to its square."""
    rest, cofactor = dict(poly), Poly()
    while found := next(((m, c) for m, c in rest.items() if dict(m).get(root.atom, 0) % 2), None):
        monomial, coefficient = found
        lower = _times(monomial, root.atom, -1)
        cofactor[lower] = cofactor.get(lower, Fraction(0)) + coefficient
        del rest[monomial]
        for other in root.others:
            lower = _times(lower, other, 1)
        rest[lower] = rest.get(lower, Fraction(0)) + coefficient * root.top / root.below
    return {m: c for m, c in rest.items() if c}, cofactor


def _product_lemma(roots: dict[str, Fraction], root: Dependent) -> Proof:
    """root * below == top * product, with its proof: times the sum of the two sides it says that squares are equal."""
    names = [f"sqrt({roots[other]})" for other in root.others]
    one, two = f"sqrt({roots[root.atom]})*({root.below})", "*".join([f"({root.top})", *names])
    terms: list[dict[str, Any]] = [{"coefficient": str(root.below**2), "factors": [
        {"fact": "sqrt_square", "of": str(roots[root.atom])}]}]
    for place, other in enumerate(root.others):  # each root's square in its turn, of those before it the numbers
        before = prod((roots[known] for known in root.others[:place]), start=Fraction(1))
        later = [{"any": f"{name}**2"} for name in names[place + 1:]]
        terms.append({"coefficient": str(-root.top**2 * before), "factors": [
            {"fact": "sqrt_square", "of": str(roots[other])}, *later]})
    return {"lemma": f"{one} == {two}", "proof": {
        "rule": "combination", "multiplier": [{"positive": f"{one} + {two}"}], "terms": terms}}


def _number(value: Ratio) -> Fraction | None:
    found = value.constant()
    return None if found is None else Fraction(found)


def _times(monomial: tuple[tuple[str, int], ...], atom: str, power: int) -> tuple[tuple[str, int], ...]:
    powers = dict(monomial)
    powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted((a, p) for a, p in powers.items() if p))


def polynomial_text(context: Context, poly: Poly) -> str:
    """A polynomial as the checker reads it."""
    def atom(name: str) -> str:
        if name not in context.functions:
            return name
        kind, of = context.functions[name]
        over, below = polynomial_text(context, of.num), polynomial_text(context, of.den)
        return f"{kind}({over})" if of.den == constant(1) else f"{kind}(({over})/({below}))"

    return " + ".join("*".join([f"({c})", *(f"{atom(a)}**{p}" for a, p in m)]) for m, c in sorted(poly.items())) or "0"

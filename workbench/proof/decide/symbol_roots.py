"""Identities that need what a root of an expression is squared, as p/sqrt(p) == sqrt(p): to the checker it is a symbol,
while sympy makes one power of it without a word."""

from __future__ import annotations

from typing import Any

from workbench.proof.checker import CertificateError, Monomial, Poly, constant, margin, read_goal
from workbench.proof.decide.number_roots import polynomial_text

Proof = dict[str, Any]
MOST_STEPS = 2000


def with_squares_of_roots(record: dict[str, Any], proofs: list[Proof]) -> list[Proof]:
    """The proofs of a certificate's goal, those by identity alone as ones by the squares of roots where the checker
    would see two sides that differ."""
    return [_by_squares(record, place) or proof if proof == {"rule": "identity"} else proof
            for place, proof in enumerate(proofs)]


def _by_squares(record: dict[str, Any], place: int) -> Proof | None:
    """A proof that both sides are equal: the numerator of their difference is a sum of multiples of root**2 - inner."""
    try:
        context, _ = read_goal(record)
        value, _ = margin(context, record["show"][place])
        inner = {atom: of.num for atom, (kind, of) in context.functions.items()
                 if kind == "sqrt" and of.den == constant(1) and of.constant() is None}
        if value.is_zero() or not inner:
            return None
        cofactors = _cofactors(value.num, inner)
    except CertificateError:  # a rate of what has none everywhere: not for an identity to show
        return None
    if cofactors is None:
        return None
    terms = [{"coefficient": "1", "factors": [{"fact": "sqrt_square", "of": polynomial_text(context, inner[atom])},
                                              {"any": polynomial_text(context, cofactor)}]}
             for atom, cofactor in cofactors.items()]
    below = [] if value.den == constant(1) else [{"positive": polynomial_text(context, value.den)}]
    return {"rule": "combination", "multiplier": below, "terms": terms}


def _cofactors(value: Poly, inner: dict[str, Poly]) -> dict[str, Poly] | None:
    """By which polynomial each root**2 - inner is multiplied so that their sum is the value; None where none is."""
    rest, found = dict(value), dict[str, Poly]()
    for _ in range(MOST_STEPS):
        square = next(((m, atom) for m in rest for atom, power in m if atom in inner and power >= 2), None)
        if square is None:
            break
        monomial, atom = square
        coefficient, lower = rest.pop(monomial), _times(monomial, ((atom, -2),))
        cofactor = found.setdefault(atom, {})
        cofactor[lower] = cofactor.get(lower, 0) + coefficient
        for of, number in inner[atom].items():
            product = _times(lower, of)
            rest[product] = rest.get(product, 0) + coefficient * number
    return None if any(rest.values()) else found


def _times(one: Monomial, two: Monomial) -> Monomial:
    powers = dict(one)
    for atom, power in two:
        powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted((a, p) for a, p in powers.items() if p))

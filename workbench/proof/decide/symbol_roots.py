"""Relations that need what a root of an expression is squared, as p/sqrt(p) == sqrt(p): to the checker it is a symbol,
while sympy makes one power of it without a word."""

from __future__ import annotations

from typing import Any

from workbench.proof.checker import CertificateError, Poly, constant, margin, read_goal, times_monomial
from workbench.proof.decide.number_roots import polynomial_text

Proof = dict[str, Any]
MOST_STEPS = 2000


def with_squares_of_roots(record: dict[str, Any], usual: list[str], proofs: list[Proof],
                          before: int = 0) -> list[Proof]:
    """The proofs of what sympy makes of a certificate's relations, `usual`, made ones of the relations as they are
    typed: by the squares of the roots by which both differ. Those of which that is not so as they are.

    before: how many lemmas stand in front of the proofs.
    """
    at = len(record.get("assume", [])) + before
    return [_by_squares(record, place, text, proof, at) or proof
            for place, (text, proof) in enumerate(zip(usual, proofs, strict=True))]


def _by_squares(record: dict[str, Any], place: int, usual: str, proof: Proof, at: int) -> Proof | None:
    """First the relation as sympy has it, which is assumption number `at` then, unless it is an identity."""
    try:
        context, _ = read_goal(record)
        (typed, operator), (plain, _) = margin(context, record["show"][place]), margin(context, usual)
        apart = typed - plain
        inner = {atom: of.num for atom, (kind, of) in context.functions.items()
                 if kind == "sqrt" and of.den == constant(1) and of.constant() is None}
        if apart.is_zero() or not inner or operator == "!=" or (cofactors := _cofactors(apart.num, inner)) is None:
            return None
    except CertificateError:  # a rate of what has none everywhere: not for an identity to show
        return None
    below = [] if apart.den == constant(1) else [{"positive": polynomial_text(context, apart.den)}]
    terms = [{"coefficient": "1", "factors": [{"fact": "sqrt_square", "of": polynomial_text(context, inner[atom])},
                                              {"any": polynomial_text(context, cofactor)}]}
             for atom, cofactor in cofactors.items()]
    if proof == {"rule": "identity"}:
        return {"rule": "combination", "multiplier": below, "terms": terms}
    terms.append({"coefficient": "1", "factors": [{"assume": at}, *below]})
    return {"rule": "cut", "lemma": usual, "proof": proof,
            "then": {"rule": "combination", "multiplier": below, "terms": terms}}


def _cofactors(value: Poly, inner: dict[str, Poly]) -> dict[str, Poly] | None:
    """By which polynomial each root**2 - inner is multiplied so that their sum is the value; None where none is."""
    rest, found = dict(value), dict[str, Poly]()
    for _ in range(MOST_STEPS):
        square = next(((m, atom) for m in rest for atom, power in m if atom in inner and power >= 2), None)
        if square is None:
            break
        monomial, atom = square
        coefficient, lower = rest.pop(monomial), times_monomial(monomial, ((atom, -2),))
        cofactor = found.setdefault(atom, {})
        cofactor[lower] = cofactor.get(lower, 0) + coefficient
        for of, number in inner[atom].items():
            product = times_monomial(lower, of)
            rest[product] = rest.get(product, 0) + coefficient * number
    return None if any(rest.values()) else found

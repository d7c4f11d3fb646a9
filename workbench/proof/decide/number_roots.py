"""Identities that need the square of a root of a number, as sqrt(2)**2 == 2: to the checker such a root is a symbol."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from workbench.proof.checker import CertificateError, Context, Poly, Ratio, constant, margin, read_goal

Proof = dict[str, Any]


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
    for atom, number in roots.items():
        cofactor: Poly = {}
        while found := next(((m, c) for m, c in rest.items() if dict(m).get(atom, 0) >= 2), None):
            monomial, coefficient = found
            lower = _times(monomial, atom, -2)
            cofactor[lower] = cofactor.get(lower, Fraction(0)) + coefficient
            del rest[monomial]
            rest[lower] = rest.get(lower, Fraction(0)) + coefficient * number
        if cofactor:
            terms.append({"coefficient": str(1 / scale), "factors": [
                {"fact": "sqrt_square", "of": str(number)}, {"any": _text(context, cofactor)}]})
    if any(rest.values()):
        return None
    positive = [{"fact": "sqrt_positive", "of": str(roots[atom])} for atom, power in below for _ in range(power)]
    return {"rule": "combination", "multiplier": positive, "terms": terms}


def _number(value: Ratio) -> Fraction | None:
    return value.num.get((), Fraction(0)) if value.den == constant(1) and set(value.num) <= {()} else None


def _times(monomial: tuple[tuple[str, int], ...], atom: str, power: int) -> tuple[tuple[str, int], ...]:
    powers = dict(monomial)
    powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted((a, p) for a, p in powers.items() if p))


def _text(context: Context, poly: Poly) -> str:
    """A polynomial as the checker reads it."""
    def atom(name: str) -> str:
        if name not in context.functions:
            return name
        kind, of = context.functions[name]
        over, below = _text(context, of.num), _text(context, of.den)
        return f"{kind}({over})" if of.den == constant(1) else f"{kind}(({over})/({below}))"

    return " + ".join("*".join([f"({c})", *(f"{atom(a)}**{p}" for a, p in m)]) for m, c in sorted(poly.items())) or "0"

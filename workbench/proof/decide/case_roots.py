"""Roots of an expression whose sign is known in a case: where x > 0, sqrt(abs(x)) is sqrt(x).

There sympy makes one power of x*sqrt(x), and the checker keeps both factors. What the two differ by is a multiple of
sqrt(x)**2 - x, which the checker is told.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.claim import Relation, at_least
from workbench.proof.derive import Size
from workbench.proof.text import text

Proof = dict[str, Any]
_ROOT = sp.Symbol("root_in_case_", positive=True)


def has_root_of_size(relations: tuple[Relation, ...]) -> bool:
    """Whether a root of an absolute value stands in one of the relations."""
    return any(_is_root(power) and isinstance(power.base, Size)
               for r in relations for power in r.margin.atoms(sp.Pow))


def not_negative(argument: sp.Expr, place: int) -> tuple[Relation, Proof]:
    """Where an argument is zero it is not negative, which its root asks for; place: of `argument == 0` among what is
    given."""
    term = {"coefficient": "1", "factors": [{"assume": place}]}
    return at_least(argument, 0), {"rule": "combination", "terms": [term]}


def with_root(proof: Proof, kept: sp.Expr, settled: sp.Expr, argument: sp.Expr) -> Proof:
    """The proof of a case in which an argument is positive, with the multiple of its root's square that it leaves out.

    kept: the margin in which the argument stands as a symbol of its own below roots, see `apart`; settled: the margin
    as sympy makes it.
    """
    if proof["rule"] == "cut":
        return proof | {"then": with_root(proof["then"], kept, settled, argument)}
    if proof["rule"] not in ("identity", "combination"):
        return proof
    cofactor = _cofactor(kept - settled.replace(lambda e: _is_root(e) and e.base == argument,
                                                lambda e: _ROOT**(2 * e.exp)), argument)
    if cofactor == 0:
        return proof
    multiplier = proof.get("multiplier", [])
    any_ = text(cofactor).replace(_ROOT.name, f"sqrt({text(argument)})")
    term = {"coefficient": "1", "factors": [
        *multiplier, {"fact": "sqrt_square", "of": text(argument)}, {"any": any_}]}
    return {**proof, "rule": "combination", "terms": [*proof.get("terms", []), term]}


def apart(margin: sp.Expr, argument: sp.Expr) -> sp.Expr:
    """A margin with a symbol in the place of the root of the argument's absolute value."""
    return margin.replace(lambda e: _is_root(e) and e.base == Size(argument), lambda e: _ROOT**(2 * e.exp))


def _cofactor(difference: sp.Expr, argument: sp.Expr) -> sp.Expr:
    """The difference over root**2 - argument, where it is a multiple of that; else 0."""
    found = sp.cancel(sp.together(difference) / (_ROOT**2 - argument))
    return found if sp.denom(found).subs(_ROOT, sp.sqrt(argument)) != 0 else sp.S.Zero


def _is_root(expr: sp.Basic) -> bool:
    return isinstance(expr, sp.Pow) and expr.exp.is_Rational and not expr.exp.is_Integer

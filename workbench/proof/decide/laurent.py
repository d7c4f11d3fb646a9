"""Expressions as Laurent polynomials over atoms: symbols, logarithms, exponentials, and 1/s for positive s."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from operator import add as plus
from operator import sub

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D, Relation
from workbench.proof.decide.atoms import Atoms, flatten
from workbench.proof.derive import SUM
from workbench.proof.text import text

Exponents = tuple[int, ...]
Laurent = dict[Exponents, Fraction]


def to_laurent(flat: sp.Expr, atoms: Atoms) -> Laurent:
    """A flattened expression as a Laurent polynomial; a positive polynomial below becomes an inverse atom.

    Raises ClaimError when a denominator is not a product of symbols and of polynomials assumed positive.
    """
    if _has_nothing_below(flat) or (
            _has_monomials_below_only(flat) and all(margin.is_Add for margin, _ in atoms.strict)):
        return reduce_inverses(_expand(flat, atoms), atoms)
    numerator, denominator = as_fraction(flat)
    rest = sp.Integer(1)
    for margin, position in atoms.strict:
        while denominator.has(*margin.free_symbols):
            quotient = sp.cancel(denominator / margin)
            if not quotient.is_polynomial(*quotient.free_symbols):
                break
            denominator, rest = quotient, rest * _inverse_atom(margin, position, atoms)
    constant, factors = sp.factor_list(denominator)
    for factor, power in factors:
        if factor.is_Symbol:
            rest = rest * factor ** (-power)
        elif positive_by_terms(factor, atoms):
            rest = rest * _inverse_of_positive(factor, atoms) ** power
        else:
            raise ClaimError(f"the denominator {factor} is not assumed positive: state its sign in the goal")
    return reduce_inverses(_expand(sp.expand(numerator / constant) * rest, atoms), atoms)


@lru_cache(maxsize=512)
def as_fraction(flat: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Numerator and denominator of a rational function, without common factors."""
    numerator, denominator = sp.fraction(sp.cancel(sp.together(flat)))
    return numerator, denominator


def _has_nothing_below(flat: sp.Expr) -> bool:
    return all(power.exp.is_nonnegative for power in flat.atoms(sp.Pow))


def _has_monomials_below_only(flat: sp.Expr) -> bool:
    return all(power.base.is_Symbol or power.exp.is_nonnegative for power in flat.atoms(sp.Pow))


def _inverse_atom(margin: sp.Expr, position: int, atoms: Atoms) -> sp.Symbol:
    """The atom 1/margin of an assumption's positive margin."""
    for symbol, known in atoms.inverses.items():
        if known == margin:
            return symbol
    symbol = sp.Dummy(f"z{len(atoms.inverses)}", positive=True)
    atoms.inverses[symbol] = margin
    atoms.positive[symbol] = ({"inverse": position}, {"assume": position})
    return symbol


def positive_by_terms(polynomial: sp.Expr, atoms: Atoms) -> bool:
    """Whether every term of a polynomial is non-negative and one is positive, as `checker.py` sees it at once."""
    strict = False
    for exponents, coefficient in _expand(polynomial, atoms).items():
        powers = [(g, n) for g, n in zip(atoms.generators, exponents, strict=False) if n]
        known = {*atoms.positive, *atoms.nonnegative}
        if coefficient < 0 or any(n % 2 and g not in known for g, n in powers):
            return False
        strict |= all(g in atoms.positive for g, _ in powers)
    return strict


def _inverse_of_positive(polynomial: sp.Expr, atoms: Atoms) -> sp.Symbol:
    """The atom 1/polynomial for a polynomial that is positive by its terms."""
    for symbol, known in atoms.inverses.items():
        if known == polynomial:
            return symbol
    plain = atoms.stated(polynomial)
    symbol = sp.Dummy(f"z{len(atoms.inverses)}", positive=True)
    atoms.inverses[symbol] = polynomial
    atoms.positive[symbol] = ({"positive": text(1 / plain)}, {"positive": text(plain)})
    return symbol


def _expand(expr: sp.Expr, atoms: Atoms) -> Laurent:
    result: Laurent = {}
    for term in sp.Add.make_args(sp.expand(expr)):
        coefficient, powers = term.as_coeff_Mul()
        if not coefficient.is_Rational:  # nan, of a case in which the term has no value
            raise ClaimError(f"{term} is no number: it cannot be decided here")
        exponents: dict[int, int] = {}
        for base, power in powers.as_powers_dict().items():
            if base == 1:
                continue
            if not base.is_Symbol or not power.is_Integer:
                raise ClaimError(f"{base}**{power} is not polynomial: it cannot be decided here")
            exponents[atoms.index(base)] = int(power)
        key = tuple(exponents.get(i, 0) for i in range(len(atoms.generators)))
        value = Fraction(int(coefficient.p), int(coefficient.q))
        result = add(result, {key: value})
    return result


def reduce_inverses(poly: Laurent, atoms: Atoms) -> Laurent:
    """Normal form modulo z s = 1: no monomial keeps z together with the leading monomial of s."""
    total = dict(poly)
    for symbol, margin in atoms.inverses.items():
        terms, place = _inverted(symbol, margin, atoms), atoms.index(symbol)
        if not any(len(e) > place and e[place] >= 1 for e in total):
            continue
        z, size = atoms.index(symbol), len(atoms.generators)  # now that the margin's symbols have their places
        # Invertible generators count last: k^-2 z k^2 would escape the rule otherwise. Graded, so that it ends.
        lead = max(terms, key=lambda e: (sum(
            n for n, g in zip(e, atoms.generators, strict=False) if g not in atoms.positive), sum(e), e))
        places = [(i, n) for i, n in enumerate(lead) if n]
        open_keys = list(total)
        while open_keys:
            exponents = open_keys.pop()
            wide = _pad(exponents, size)
            if exponents not in total or wide[z] < 1 or any(wide[i] < n for i, n in places):
                continue
            # z lead = (1 - z (s - lead)) / lead_value
            coefficient = total.pop(exponents) / terms[lead]
            base = _minus(wide, lead)
            lowered = tuple(n - (i == z) for i, n in enumerate(base))
            for e, c in (((), None), *terms.items()):
                if e == lead:
                    continue
                key = trim(lowered) if c is None else trim(_plus(base, e))
                _accumulate(total, key, coefficient if c is None else -coefficient * c)
                open_keys.append(key)
    return total


def _inverted(symbol: sp.Symbol, margin: sp.Expr, atoms: Atoms) -> Laurent:
    """The polynomial that an inverse atom inverts."""
    if symbol not in atoms.expanded:
        atoms.expanded[symbol] = _expand(margin, atoms)
    return atoms.expanded[symbol]


def unreduced(poly: Laurent, atoms: Atoms) -> set[Exponents]:
    """Monomials that the normal form hides: every monomial times z s, term by term, since z s = 1."""
    hidden: set[Exponents] = set()
    for symbol, margin in atoms.inverses.items():
        z, terms = atoms.index(symbol), _inverted(symbol, margin, atoms)
        for exponents in poly:
            with_z = exponents if len(exponents) > z and exponents[z] else _plus(exponents, (0,) * z + (1,))
            hidden |= {trim(_plus(with_z, e)) for e in terms}
    return hidden


def _pad(exponents: Exponents, length: int) -> Exponents:
    return exponents if len(exponents) == length else exponents + (0,) * (length - len(exponents))


def _minus(a: Exponents, b: Exponents) -> Exponents:
    n = max(len(a), len(b))
    return tuple(map(sub, _pad(a, n), _pad(b, n)))


def _plus(a: Exponents, b: Exponents) -> Exponents:
    n = max(len(a), len(b))
    return tuple(map(plus, _pad(a, n), _pad(b, n)))


def trim(exponents: Exponents) -> Exponents:
    """Without trailing zeros, so that the same monomial has one key however many generators there are."""
    end = len(exponents)
    while end and exponents[end - 1] == 0:
        end -= 1
    return exponents[:end]


def add(a: Laurent, b: Laurent) -> Laurent:
    """The sum a + b."""
    total = dict(a)
    for exponents, coefficient in b.items():
        _accumulate(total, exponents, coefficient)
    return total


def _accumulate(total: Laurent, exponents: Exponents, coefficient: Fraction) -> None:
    key = trim(exponents)
    value = total.get(key, Fraction(0)) + coefficient
    if value:
        total[key] = value
    else:
        total.pop(key, None)


def multiply(a: Laurent, b: Laurent) -> Laurent:
    """a * b, not reduced."""
    total: Laurent = {}
    for e1, c1 in a.items():
        for e2, c2 in b.items():
            _accumulate(total, _plus(e1, e2), c1 * c2)
    return total


def shift(poly: Laurent, by: Exponents) -> Laurent:
    """poly times a monomial."""
    return {trim(_plus(e, by)): c for e, c in poly.items()}


def ratio_of(a: Exponents, b: Exponents) -> Exponents:
    """The exponents of monomial a / monomial b."""
    return trim(_minus(a, b))


def goal_atoms(relations: tuple[Relation, ...]) -> Atoms:
    """Atoms of a goal whose assumptions stand at the given positions: which symbols and margins are signed."""
    atoms = Atoms()
    for position, relation in enumerate(relations):
        if relation.operator in ("==", "!="):
            continue
        margin = relation.margin
        if margin.is_Symbol:
            if relation.strict:
                atoms.positive[margin] = ({"assume": position}, {"inverse": position})
            else:
                atoms.nonnegative[margin] = {"assume": position}
        elif relation.strict and margin.is_polynomial(*margin.free_symbols) and not margin.has(sp.Sum, sp.Indexed):
            atoms.strict.append((margin, position))
        elif relation.strict and isinstance(margin, (sp.sin, sp.cos)) and not margin.args[0].has(
                sp.exp, sp.log, D) and (atom := flatten(margin, atoms, {})).is_Symbol:
            atoms.positive[atom] = ({"assume": position}, {"inverse": position})
    atoms.index(SUM)
    return atoms

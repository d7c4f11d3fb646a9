"""Monomials as factors of a certificate, written out when they are chosen, as few of thousands of candidates are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

import sympy as sp

from workbench.proof.decide.atoms import Atoms, Item
from workbench.proof.decide.facts import Known
from workbench.proof.decide.laurent import Exponents, Laurent
from workbench.proof.derive import SUM
from workbench.proof.text import text


@dataclass(frozen=True)
class Unwritten:
    """A factor item {kind: text of an expression} before the expression is built; label tells it from others."""

    kind: str
    label: str
    make: Callable[[], sp.Expr] = field(compare=False)

    def __str__(self) -> str:
        return f"{self.kind} {self.label}"


Factor = Item | Unwritten


@dataclass(frozen=True)
class Candidate:
    """A product of known sign: its factors, its value, and whether it is > 0, >= 0 or == 0."""

    items: tuple[Factor, ...]
    value: Laurent
    sign: str


def candidate(known: Known) -> Candidate:
    """What is known, as a candidate."""
    return Candidate(known.items, known.value, known.sign)


def written(items: tuple[Factor, ...]) -> list[Item]:
    """The factors as certificates have them."""
    return [{item.kind: text(item.make())} if isinstance(item, Unwritten) else item for item in items]


def any_monomial(exponents: Exponents, atoms: Atoms) -> Unwritten:
    """A monomial beside something that is zero."""
    return Unwritten("any", str(exponents), lambda: expression(exponents, atoms))


def binomial_square(p: Exponents, q: Exponents, ratio: Fraction, over_neurons: bool, atoms: Atoms) -> Unwritten:
    """(p + ratio q)^2, or the sum of such squares."""

    def root() -> sp.Expr:
        first, second = expression(p, atoms), expression(q, atoms)
        weight = sp.Rational(ratio.numerator, ratio.denominator)
        if second.has(sp.exp):  # sympy would make one exponential of two
            return sp.Add(first, sp.Mul(weight, second, evaluate=False), evaluate=False)
        return first + weight * second

    return Unwritten("sum_of_squares" if over_neurons else "square", f"{p} {q} {ratio}", root)


def monomial(exponents: Exponents, atoms: Atoms) -> tuple[Factor, ...] | None:
    """Factor items of a monomial whose sign is known to be >= 0, else None."""
    items: list[Factor] = []
    for place, (generator, count) in enumerate(zip(atoms.generators, exponents, strict=False)):
        if count == 0:
            continue
        if generator in atoms.positive:
            item = atoms.positive[generator][0 if count > 0 else 1]
            if item is None:
                return None
            items += [item] * abs(count)
        elif generator in atoms.nonnegative and count > 0:
            items += [atoms.nonnegative[generator]] * count
        elif count % 2 == 0 and count > 0 and generator not in atoms.indexed and generator != SUM:
            items.append(_square(place, count // 2, atoms))
        else:
            return None
    return tuple(items)


def _square(place: int, count: int, atoms: Atoms) -> Unwritten:
    return Unwritten("square", f"{place} {count}", lambda: power(atoms.generators[place], count, atoms))


def power(generator: sp.Symbol, count: int, atoms: Atoms) -> sp.Expr:
    """A power of what a generator stands for; sympy must not turn the square of a root or of exp into others."""
    meaning = atoms.meanings().get(generator, generator)
    return meaning if count == 1 else sp.Pow(meaning, count, evaluate=meaning.is_Symbol)


def expression(exponents: Exponents, atoms: Atoms) -> sp.Expr:
    """A monomial in what its generators stand for."""
    powers = [power(g, p, atoms) for g, p in zip(atoms.generators, exponents, strict=False) if p]
    plain = all(one.is_Symbol or (one.args[:1] and one.args[0].is_Symbol) for one in powers)
    return sp.Mul(*powers, evaluate=plain or len(powers) < 2)

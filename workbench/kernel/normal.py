"""The checker's rational functions over atoms as Coq text: what hypotheses and goals look like inside of a proof."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from workbench.kernel.syntax import Letters, NotExportedError
from workbench.proof.checker import (
    SUM,
    TOTAL,
    Context,
    Monomial,
    Number,
    Poly,
    Ratio,
    atoms_of,
    constant,
    number,
    symbol,
    symbols_of,
)


def number_text(value: Number) -> str:
    """A rational number."""
    if value.denominator == 1:
        return str(value.numerator) if value >= 0 else f"({value.numerator})"
    return f"({value.numerator} / {value.denominator})"


@dataclass(frozen=True)
class Normal:
    """Writes values of one context in the letters of one instant."""

    context: Context
    letters: Letters

    def moves(self, atom: str) -> bool:
        """Whether a function's value changes in time."""
        return bool(symbols_of(self.context, symbol(atom)) & self.letters.moving)

    def indexed(self, value: Ratio) -> bool:
        """Whether a value is one of each index; a sum over the index is a number."""
        functions = self.context.functions
        return any(atom in self.letters.indexed or (
            atom in functions and functions[atom][0] != TOTAL and self.indexed(functions[atom][1]))
            for atom in atoms_of(value))

    def name(self, atom: str) -> str:
        """The bare name of a function's value: a number after the letter a, and the instant where it is not t."""
        instant = self.letters.instant
        return f"a{atom.partition('#')[2]}{'' if instant == 't' or not self.moves(atom) else '_' + instant}"

    def atom(self, atom: str) -> str:
        """An atom: a symbol, or the value of a function."""
        if atom in self.context.functions:
            return f"({self.name(atom)} i)" if self.indexed(symbol(atom)) else self.name(atom)
        if atom == SUM:
            raise NotExportedError("a sum where the rule knows none")
        return self.letters.symbol(atom)

    def power(self, atom: str, power: int) -> str:
        """A power of an atom."""
        return self.atom(atom) if power == 1 else f"{self.atom(atom)} ^ {power}"

    def monomial(self, monomial: Monomial, coefficient: Number) -> str:
        """A term of a polynomial: the coefficient, unless it is one, then the powers."""
        parts = [number_text(coefficient)] if coefficient != 1 or not monomial else []
        return " * ".join(parts + [self.power(atom, power) for atom, power in monomial])

    def poly(self, poly: Poly) -> str:
        """A polynomial."""
        return "(" + " + ".join(self.monomial(m, poly[m]) for m in sorted(poly)) + ")" if poly else "0"

    def ratio(self, value: Ratio) -> str:
        """A rational function without sums."""
        over = self.poly(value.num)
        return over if value.den == constant(1) else f"({over} / {self.poly(value.den)})"

    def split(self, value: Ratio) -> tuple[Ratio, Ratio | None]:
        """What stands outside of the sum over the index, and its term, None where there is no sum."""
        if SUM not in atoms_of(value):
            return value, None
        inside = {tuple(f for f in m if f[0] != SUM): c for m, c in value.num.items() if (SUM, 1) in m}
        outside = Ratio({m: c for m, c in value.num.items() if (SUM, 1) not in m}, value.den)
        if self.indexed(outside):
            raise NotExportedError("a sum that is not told apart from what stands beside it")
        return outside, Ratio(inside, value.den)

    def value(self, value: Ratio) -> str:
        """A value, with its sum over the index where it has one."""
        outside, inside = self.split(value)
        if inside is None:
            return self.ratio(outside)
        return f"({self.ratio(outside)} + bigsum n (fun i => {self.ratio(inside)}))"


def joined(outside: Ratio, inside: Ratio | None) -> Ratio:
    """The value of a part outside of the sum and the sum's term."""
    return outside if inside is None else outside + inside * symbol(SUM)


def is_number(value: Ratio) -> Fraction | None:
    """The number that a value is, None where it is none."""
    found = value.constant()
    return None if found is None else Fraction(found)


ZERO = number(0)

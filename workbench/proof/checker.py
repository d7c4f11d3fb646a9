"""Re-check certificates with exact arithmetic alone. Standard library only; knows nothing of who made them.

A certificate states a goal: for all real values of its symbols, the relations in `assume` imply those in
`show`. Expressions are Python syntax over + - * / **, log, exp, tanh, sin, cos, tan, arctan, abs, sign, sqrt, Max, Min,
Sum(...) (over any number n of indexed symbols, also none, formally) and D(...) (derivative along `flow`, symbols with
rates).
`proved` carries a proof, `refuted`/`violated`/`gap` a point (or functions of time) where the goal fails.

D holds symbols without a rate constant; of `inputs`, which may vary without a known rate, it is not taken. Only the
rule `nonincreasing`, paths and models follow the flow through time: `always` holds at every instant from time zero on,
`initial` names values at time zero, and `assume` and `show` speak of one later instant.

What must be believed: this file, and the facts named in `fact`: log x <= x - 1 (x > 0), exp x >= 1 + x, exp x > 0;
sin and cos on the unit circle, cos x >= 1 - x**2/2, sin x <= x (x >= 0); what `ARCTAN` says of arctan x; how sin, cos
and exp of a sum and log of a product come from those of the parts; abs(x)**2 = x**2, abs(x) >= 0; sqrt(x)**2 = x,
sqrt(x) >= 0 (x >= 0), sqrt(x) > 0 (x > 0); a function whose derivative is never positive does not increase. tan, tanh,
Max and Min are read as what they stand for: tan x = sin x/cos x, tanh x = (exp 2x - 1)/(exp 2x + 1),
Max(a, b) = (a + b + abs(a - b))/2, Min(a, b) = (a + b - abs(a - b))/2.
"""

from __future__ import annotations

import ast
import hashlib
import json
import math
import re
import sys
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import Any

MOST_TERMS, MOST_RATES = 16, 8  # of the sums at a point; of what always holds, at the first instant
SUM = "Sum()"  # the formal sum over the index: a product SUM * term means the sum of the terms
TOTAL = "total"  # the kind of an atom that is the sum of a term, a number like any other
OPERATORS = ("<=", ">=", "==", "!=", "<", ">")
FUNCTIONS = ("log", "exp", "tanh", "sin", "cos", "tan", "arctan", "abs", "sign", "sqrt")
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")  # no atom of this file looks like that
EXPRESSION = re.compile(r"[A-Za-z0-9_ +*/(),-]*")
OTHER_NUMBER = re.compile(r"(?<![A-Za-z0-9_])[0-9]+[A-Za-z_]")  # 0x10 and 1_0 are numbers to Python
RATIONAL = re.compile(r"-?[0-9]+(/[0-9]+)?")
DIGEST = re.compile(r"[0-9a-f]{64}")
EQUATION = re.compile(r"[A-Za-z0-9][A-Za-z0-9._+-]*")
# More is refused, not computed.
MOST_WORK, MOST_PRODUCTS, MOST_BITS, MOST_TEXT, MOST_DEPTH = 2_000_000, 20_000, 20_000, 100_000, 100
MOST_OF_PARTS = 5 * MOST_WORK  # of all certificates of a whole theorem together
MOST_KEPT, LONG_TEXT = 2048, 10_000  # syntax trees that are kept, and from which length on none is
LARGEST_EXPONENT, LARGEST, PRECISION = 10_000, 64 * 2**20, Fraction(1, 10**30)  # of exp; of files; of enclosures

Number = int | Fraction  # whole numbers are reckoned with faster; of two of them "/" is a float, so `quotient` divides
Monomial = tuple[tuple[str, int], ...]
Poly = dict[Monomial, Number]  # never changed once it is made: ratios share them
Sign = tuple["Ratio", str]  # a value and what is known of it: > 0, >= 0, == 0 or != 0


class CertificateError(Exception):
    """The certificate does not establish its verdict; says why."""


class Work:
    """What checking one certificate has cost: products of terms, by their length, and looks at terms."""

    spent, depth, counts = 0, 0, False


def spend(units: int) -> None:
    """Count work; CertificateError where a certificate costs more than any that is honest."""
    if Work.counts:
        Work.spent += units
        if Work.spent > MOST_WORK:
            raise CertificateError(f"takes more than {MOST_WORK} steps of work: state it in smaller steps")


def bits_of(poly: Poly) -> int:
    """The length of the longest coefficient; CertificateError where it is longer than any that is honest."""
    longest = 0
    for c in poly.values():
        length = c.bit_length() + 1 if type(c) is int else c.numerator.bit_length() + c.denominator.bit_length()
        longest = max(longest, length)
    if longest > MOST_BITS:
        raise CertificateError(f"a number has more than {MOST_BITS} bits")
    return longest


# --- polynomials and rational functions over atoms --------------------------------------------------------


def plain(value: Number) -> Number:
    """The same number, as an int where it is whole."""
    return value.numerator if value.denominator == 1 else value


def quotient(a: Number, b: Number) -> Number:
    """a / b, exactly."""
    return plain(a) if b == 1 else plain(Fraction(a, b))


def constant(value: Number) -> Poly:
    """A constant polynomial; zero is the empty one."""
    return {(): plain(value)} if value else {}


ONE: Poly = constant(1)


def add(a: Poly, b: Poly, scale: Number = 1) -> Poly:
    """a + scale * b."""
    spend(len(a) + len(b))
    total = dict(a)
    for monomial, coefficient in b.items():
        more = coefficient if scale == 1 else scale * coefficient
        value = total[monomial] + more if monomial in total else more
        if value:
            total[monomial] = value
        else:
            total.pop(monomial, None)
    return total


@lru_cache(maxsize=8192)
def times_monomial(one: Monomial, two: Monomial) -> Monomial:
    """Product of two monomials; powers that vanish are dropped."""
    if not one or not two:
        return one or two
    powers = dict(one)
    for atom, power in two:
        powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted((a, n) for a, n in powers.items() if n))


def multiply(a: Poly, b: Poly) -> Poly:
    """The product a * b."""
    if len(a) * len(b) > MOST_PRODUCTS:
        raise CertificateError("an expression is too large to be expanded")
    if ONE in (a, b):
        spend(len(a) * len(b))
        return b if a == ONE else a
    spend(len(a) * len(b) * (1 + (bits_of(a) + bits_of(b)) // 256))
    if len(a) == 1:
        a, b = b, a
    if len(b) == 1:  # no two products have the same monomial
        ((m2, c2),) = b.items()
        return {times_monomial(m1, m2) if m2 else m1: plain(c1 * c2) for m1, c1 in a.items()}
    (a, below_a), (b, below_b) = whole_multiple(a), whole_multiple(b)
    total: Poly = {}
    for m1, c1 in a.items():
        for m2, c2 in b.items():
            monomial, value = times_monomial(m1, m2), c1 * c2
            total[monomial] = total[monomial] + value if monomial in total else value
    below = below_a * below_b
    return {m: quotient(c, below) for m, c in total.items() if c}


def whole_multiple(poly: Poly) -> tuple[Poly, int]:
    """A multiple with whole coefficients and how many times it is taken: products of whole numbers are quick. Where
    that would be a long number it is the polynomial itself, once."""
    below = math.lcm(*[c.denominator for c in poly.values()])
    if below == 1 or below.bit_length() > 1000:
        return poly, 1
    return {m: c.numerator * (below // c.denominator) for m, c in poly.items()}, below


def degrees(poly: Poly) -> dict[str, int]:
    """The highest power of each atom."""
    highest: dict[str, int] = {}
    for monomial in poly:
        for atom, power in monomial:
            if power > highest.get(atom, 0):
                highest[atom] = power
    return highest


def is_multiple(monomial: Monomial, below: Monomial) -> bool:
    """Whether a monomial is a multiple of the other one."""
    powers = dict(monomial)
    return all(powers.get(x, 0) >= n for x, n in below)


def _power_of_term(term: Poly, power: int) -> Poly:
    """The power, from 0 to 64, of a polynomial of one term."""
    ((monomial, coefficient),) = term.items()
    if power == 0 or term == ONE:
        return ONE
    spend(power * (1 + power * bits_of(term) // 256))
    found = {tuple([(atom, n * power) for atom, n in monomial]): coefficient**power}
    bits_of(found)
    return found


def divide_exactly(a: Poly, b: Poly) -> Poly | None:
    """a / b when b divides a, else None."""
    if not b:
        return None
    spend(1 + (len(a) + len(b)) // 4)
    if len(b) == 1:
        ((below, coefficient),) = b.items()
        if not all(is_multiple(monomial, below) for monomial in a):
            return None
        under = tuple([(x, -n) for x, n in below])
        return {times_monomial(m, under): quotient(c, coefficient) for m, c in a.items()}
    highest = degrees(a)
    if a and any(power > highest.get(atom, 0) for atom, power in degrees(b).items()):
        return None  # degrees of factors add up
    atoms = sorted(highest)

    def order(monomial: Monomial) -> tuple[int, ...]:
        powers = dict(monomial)
        return tuple([powers.get(x, 0) for x in atoms])

    lead = max(b, key=order)
    over = tuple([(x, -n) for x, n in lead])
    found: Poly = {}
    rest, orders = a, {monomial: order(monomial) for monomial in a}
    while rest:
        spend(len(rest) * (1 + len(atoms) // 4))
        top = max(rest, key=orders.__getitem__)
        step = times_monomial(top, over)
        if any(n < 0 for _, n in step):
            return None
        found[step] = quotient(rest[top], b[lead])
        rest = add(rest, multiply({step: found[step]}, b), -1)
        for monomial in rest.keys() - orders.keys():
            orders[monomial] = order(monomial)
    return found


class Ratio:
    """A rational function: numerator and non-zero denominator polynomial over atoms. It is never changed.

    A denominator that is 1 is the object ONE, so that polynomials are told apart at a glance.
    """

    __slots__ = ("den", "num")

    def __init__(self, num: Poly, den: Poly = ONE) -> None:
        spend(4 + len(num) + len(den))
        self.num, self.den = num, ONE if den == ONE else den
        for monomial in num:
            for atom, power in monomial:
                if atom == SUM and power > 1:
                    raise CertificateError("a product of two sums")
        if self.den is ONE:
            return
        if not den:
            raise CertificateError("division by zero")
        if any(atom == SUM for m in den for atom, _ in m):
            raise CertificateError("division by a sum")
        if len(den) > 1:
            whole = divide_exactly(num, den)
            if whole is not None:
                self.num, self.den = whole, ONE
            return
        (monomial, coefficient), = den.items()  # a single term below: cancel it as far as it goes
        if not monomial:
            self.num, self.den = {m: quotient(c, coefficient) for m, c in num.items()}, ONE
            return
        powers = [dict(m) for m in num]
        below = tuple([(x, -shared) for x, n in monomial if (shared := min([n, *[p.get(x, 0) for p in powers]]))])
        self.num = {times_monomial(m, below): quotient(c, coefficient) for m, c in num.items()}
        rest = times_monomial(monomial, below)
        self.den = {rest: 1} if rest else ONE

    @classmethod
    def normal(cls, num: Poly, den: Poly = ONE) -> Ratio:
        """One of which it is known that nothing can be cancelled, and that no product of two sums stands in it."""
        spend(4 + len(num) + len(den))
        made: Ratio = object.__new__(cls)
        made.num, made.den = num, den
        return made

    def __add__(self, other: Ratio) -> Ratio:
        if self.den is ONE and other.den is ONE:
            return Ratio.normal(add(self.num, other.num))
        if self.den == other.den:
            return Ratio(add(self.num, other.num), self.den)
        return Ratio(add(multiply(self.num, other.den), multiply(other.num, self.den)),
                     multiply(self.den, other.den))

    def __sub__(self, other: Ratio) -> Ratio:
        if self.den is ONE and other.den is ONE:
            return Ratio.normal(add(self.num, other.num, -1))
        return self + -other

    def __mul__(self, other: Ratio) -> Ratio:
        if self.den is ONE and other.den is ONE:
            if has_open_sum(self) and has_open_sum(other):
                raise CertificateError("a product of two sums")
            return Ratio.normal(multiply(self.num, other.num))
        return Ratio(multiply(self.num, other.num), multiply(self.den, other.den))

    def __neg__(self) -> Ratio:
        return Ratio.normal({m: -c for m, c in self.num.items()}, self.den)

    def inverse(self) -> Ratio:
        """One over it; CertificateError for zero."""
        return Ratio(self.den, self.num)

    def is_zero(self) -> bool:
        """Whether it is zero as a rational function, hence wherever it is defined."""
        return not self.num

    def constant(self) -> Number | None:
        """The number that it is; None where it is none."""
        if self.den is not ONE or len(self.num) > 1:
            return None
        return 0 if not self.num else self.num.get(())


def sum_of(parts: Iterable[Ratio]) -> Ratio:
    """What several add up to, in their order."""
    total, waiting = Poly(), iter(parts)
    for part in waiting:
        if part.den is not ONE:
            return sum(waiting, Ratio.normal(total) + part)
        spend(1 + len(part.num))
        for monomial, coefficient in part.num.items():
            value = total[monomial] + coefficient if monomial in total else coefficient
            if value:
                total[monomial] = value
            else:
                del total[monomial]
    return Ratio.normal(total)


def number(value: Number) -> Ratio:
    """A rational number as a Ratio."""
    return Ratio.normal(constant(value))


def symbol(name: str) -> Ratio:
    """An atom as a Ratio."""
    return Ratio.normal({((name, 1),): 1})


def same(a: Ratio, b: Ratio) -> bool:
    """Whether two rational functions are equal."""
    spend(1 + len(a.num) // 4)
    return a.num == b.num if a.den == b.den else (a - b).is_zero()


def has_open_sum(value: Ratio) -> bool:
    """Whether a sum stands in a value as a factor, not as an atom of its own."""
    for monomial in value.num:  # noqa: SIM110 - asked of every product, and twice as quick as any(...)
        if (SUM, 1) in monomial:
            return True
    return False


def atoms_of(value: Ratio) -> set[str]:
    """The atoms in numerator and denominator."""
    spend(1 + len(value.num) // 4)
    return {atom for m in (*value.num, *value.den) for atom, _ in m}


# --- expressions ------------------------------------------------------------------------------------------


def parse(text: str) -> ast.expr:
    """The syntax tree of an expression; nothing is evaluated."""
    if len(text) > MOST_TEXT:
        raise CertificateError(f"an expression is longer than {MOST_TEXT} characters")
    spend(1 + len(text) // 4)
    return _tree(text) if len(text) < LONG_TEXT else _tree.__wrapped__(text)


@lru_cache(maxsize=MOST_KEPT)  # so that what is known of a tree is known of the text; long ones would fill the memory
def _tree(text: str) -> ast.expr:
    if not EXPRESSION.fullmatch(text) or OTHER_NUMBER.search(text):
        raise CertificateError(f"'{text[:80]}' is not an expression of the certificate language")
    try:
        return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise CertificateError(f"cannot read '{text[:80]}'") from None


def _term_of(node: ast.expr) -> Poly | None:
    """The value of a product of symbols, powers of them and numbers, which is not zero, over a number; None for other
    expressions."""
    if isinstance(node, ast.Name):
        return {((node.id, 1),): 1}
    if isinstance(node, ast.Constant):
        return {(): node.value} if type(node.value) is int and node.value else None
    if not isinstance(node, ast.BinOp) or (one := _term_of(node.left)) is None or (
            two := _term_of(node.right)) is None:
        return None
    ((m1, c1),), ((m2, c2),) = one.items(), two.items()
    if isinstance(node.op, ast.Mult):
        return {times_monomial(m1, m2): plain(c1 * c2)}
    if isinstance(node.op, ast.Div) and not m2:
        return {m1: quotient(c1, c2)}
    if isinstance(node.op, ast.Pow) and isinstance(node.left, ast.Name) and not m2 and type(c2) is int and c2 <= 64:
        return {((node.left.id, c2),): 1}
    return None


class Context:
    """Reads expressions of one goal into Ratios; log and exp of an argument become atoms."""

    plain = True  # a name is a symbol; not so of what reads some names otherwise

    def __init__(self, flow: dict[str, str], indexed: list[str], inputs: list[str] | None = None) -> None:
        self.functions: dict[str, tuple[str, Ratio]] = {}
        self.indexed, self.rates, self.inputs = set(indexed), flow, set(inputs or [])
        self.flow: dict[str, Ratio] = {}
        self.values: dict[str, Ratio] = {}
        self.places: dict[str, list[tuple[ast.expr, str]]] = {}  # where texts may be undefined
        self.parts: dict[ast.expr, Ratio] = {}  # of syntax trees; a later reading has the same atoms
        if any(calls(rate, "D") for rate in flow.values()):
            raise CertificateError("a rate is given by a derivative")
        for name, rate in flow.items():
            self.flow[name] = self.term(rate) if name in self.indexed else self.read(rate)

    def read(self, text: str) -> Ratio:
        """The value of an expression in which indexed symbols stand only inside Sum(...)."""
        if text not in self.values:
            tree = parse(text)
            if self.indexed:
                self._require_bound(tree, text)
            self.values[text] = self.node(tree)
        return self.values[text]

    def term(self, text: str) -> Ratio:
        """The value of an expression of one index, as it stands inside Sum(...)."""
        return self._of_one_index(self.node(parse(text)))

    def _of_one_index(self, value: Ratio) -> Ratio:
        """The same value with its sums closed; refused with one inside a function: there no index is told apart."""
        value = self.closed(value)
        if any(SUM in symbols_of(self, symbol(atom)) and self.kind(atom) != TOTAL for atom in atoms_of(value)):
            raise CertificateError("a sum inside a sum")
        return value

    def kind(self, atom: str) -> str:
        """Which function an atom is, "" for a symbol."""
        return self.functions[atom][0] if atom in self.functions else ""

    def is_free(self, value: Ratio) -> bool:
        """Whether a value has an index that no sum binds, as a term of a sum has."""
        return any(self._has_index(atom) for m in (*value.num, *value.den) if (SUM, 1) not in m for atom, _ in m)

    def _has_index(self, atom: str) -> bool:
        return atom in self.indexed or (atom in self.functions and self.kind(atom) != TOTAL
                                        and self.is_free(self.functions[atom][1]))

    def closed(self, value: Ratio) -> Ratio:
        """The same value with every sum a number of its own (an atom), not a factor: so sums may be multiplied.

        Of a polynomial there is one for each monomial of the index, so that equal values are equal polynomials.
        """
        if not has_open_sum(value):
            return value
        spend(len(value.num))
        outside: Poly = {}
        inside: Poly = {}
        shared = not any(self._has_index(atom) for m in value.den for atom, _ in m)
        for monomial, coefficient in value.num.items():
            if (SUM, 1) not in monomial:
                outside[monomial] = outside.get(monomial, 0) + coefficient
                continue
            rest = tuple(f for f in monomial if f[0] != SUM)
            if shared:
                own = tuple(f for f in rest if self._has_index(f[0]))
                rest = tuple(f for f in rest if f not in own)
                product = times_monomial(rest, ((self._total(Ratio.normal({own: 1})), 1),))
                outside[product] = outside.get(product, 0) + coefficient
            else:
                inside[rest] = coefficient
        whole = Ratio({m: c for m, c in outside.items() if c}, value.den)
        return whole + symbol(self._total(Ratio(inside, value.den))) if inside else whole

    def _total(self, term: Ratio) -> str:
        """The atom of the sum of a term over the index."""
        for atom, (kind, known) in self.functions.items():
            if kind == TOTAL and same(known, term):
                return atom
        (monomial, _), = self._new(TOTAL, term).num.items()
        return monomial[0][0]

    def total_of(self, term: Ratio, count: Ratio | None = None) -> Ratio:
        """The sum of a term that was derived or replaced; of one term where `count` is 1."""
        if has_open_sum(term):  # whose index is whose is not told apart
            raise CertificateError("a sum inside a sum")
        return self.closed(term * (count or symbol(SUM)))

    def product(self, a: Ratio, b: Ratio) -> Ratio:
        """a * b, each a whole expression: a sum that meets another sum, or a free index, is closed before."""
        sums = has_open_sum(a), has_open_sum(b)
        if all(sums) or (sums[0] and self.is_free(b)) or (sums[1] and self.is_free(a)):
            return self.closed(a) * self.closed(b)
        return a * b

    def _require_bound(self, tree: ast.AST, text: str) -> None:
        if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name) and tree.func.id == "Sum":
            return
        if isinstance(tree, ast.Name) and tree.id in self.indexed:
            raise CertificateError(f"indexed symbol '{tree.id}' outside a sum in '{text}'")
        for child in ast.iter_child_nodes(tree):
            self._require_bound(child, text)

    def node(self, node: ast.expr) -> Ratio:
        """The value of a syntax tree."""
        if node in self.parts:  # atoms that were made first are found first: a later reading has the same
            return self.parts[node]
        term = _term_of(node) if self.plain else None
        if term is not None:
            spend(1 + bits_of(term) // 256)
            value = Ratio.normal(term)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
            value = self._sum(node)
        else:
            value = self._value(node)
        self.parts[node] = value
        return value

    def _sum(self, node: ast.expr) -> Ratio:
        parts: list[tuple[ast.expr, bool]] = []
        while isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
            parts.append((node.right, isinstance(node.op, ast.Sub)))
            node = node.left
        return sum_of([self.node(node), *[-self.node(part) if minus else self.node(part)
                                          for part, minus in reversed(parts)]])

    def _value(self, node: ast.expr) -> Ratio:
        match node:
            case ast.Name(id=name):
                value = symbol(name)
            case ast.Constant(value=int(whole)) if not isinstance(whole, bool):
                value = number(whole)
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                value = -self.node(inner)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                value = self.product(self.node(left), self.node(right))
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                value = self.power(self.closed(self.node(left)), self.node(right))
            case ast.BinOp(left=left, op=ast.Div(), right=right):
                value = self.node(left)
                value = self.product(value, self.closed(self.node(right)).inverse())
            case ast.Call(func=ast.Name(id="Max" | "Min" as name), args=[first, *others], keywords=[]) if others:
                value = self.node(first)
                for other in others:
                    value = self._extreme(value, self.node(other), 1 if name == "Max" else -1)
            case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]):
                value = self.call(name, self.node(inner))
            case _:
                raise CertificateError(f"'{ast.unparse(node)}' is not an expression of the certificate language")
        return value

    @staticmethod
    def power(base: Ratio, exponent: Ratio) -> Ratio:
        """base**exponent for a whole number."""
        value = exponent.constant()
        if value is None or value.denominator != 1 or not -64 <= value <= 64:
            raise CertificateError("powers must be whole numbers up to 64")
        result, factors = number(1), abs(int(value))
        if len(base.num) == 1 == len(base.den) and not has_open_sum(base):  # a term: its powers are multiplied
            spend(factors)
            result = Ratio.normal(_power_of_term(base.num, factors), _power_of_term(base.den, factors))
        else:
            for _ in range(factors):
                result = result * base
                bits_of(result.num)
        return result if value >= 0 else result.inverse()

    def call(self, name: str, argument: Ratio) -> Ratio:
        """Sum, D or one of the functions of an argument."""
        if name == "Sum":
            return self._of_one_index(argument) * symbol(SUM)
        if name == "D":
            if unknown := symbols_of(self, argument) & self.inputs:
                raise CertificateError(f"a derivative of the input {min(unknown)} is not taken: its rate is not known")
            if not symbols_of(self, argument) & self.flow.keys():
                raise CertificateError("a derivative of what has no rate: state that its rate is 0 if it is constant")
            return self.derivative(argument, self.flow)
        if name not in FUNCTIONS:
            raise CertificateError(f"unknown function '{name}'")
        if name == "abs":  # of a sum: of a number, its total
            argument = self.closed(argument)
        elif name != "sqrt" and any(atom == SUM or self.kind(atom) == TOTAL for atom in atoms_of(argument)):
            raise CertificateError(f"{name} of a sum")
        if name == "log":
            return self._log(argument)
        if name == "exp":
            return self._exp(argument)
        if name == "tanh":
            double = self._exp(number(2) * argument)
            return (double + number(-1)) * (double + number(1)).inverse()
        if name == "tan":
            return self.call("sin", argument) * self.call("cos", argument).inverse()
        if (value := argument.constant()) is not None and (rational := self._of_number(name, value)) is not None:
            return number(rational)
        for atom, (kind, known) in list(self.functions.items()):
            if kind == name and self.closed(known - argument).is_zero():
                return symbol(atom)
            if kind == name != "sqrt" and same(known, -argument):  # abs and cos are even, others odd
                return symbol(atom) if name in ("abs", "cos") else -symbol(atom)
        return self._new(name, argument)

    @staticmethod
    def _of_number(name: str, value: Number) -> Number | None:
        """abs, sign, sqrt, sin, cos or arctan of a number, None where that is irrational."""
        if name in ("sin", "cos", "arctan"):
            return None if value else int(name == "cos")
        if name != "sqrt":
            return max(value, -value) if name == "abs" else (value > 0) - (value < 0)
        if value < 0:
            raise CertificateError("sqrt of a negative number")
        up, down = math.isqrt(value.numerator), math.isqrt(value.denominator)
        return Fraction(up, down) if (up * up, down * down) == (value.numerator, value.denominator) else None

    def _extreme(self, a: Ratio, b: Ratio, direction: int) -> Ratio:
        """The larger (direction 1) or smaller (-1) of two values."""
        return (a + b + number(direction) * self.call("abs", a - b)) * number(Fraction(1, 2))

    def _log(self, argument: Ratio) -> Ratio:
        if same(argument, number(1)):
            return number(0)
        if (value := argument.constant()) is not None and value <= 0:
            raise CertificateError("log of a number that is not positive")
        for atom, (kind, known) in self.functions.items():
            if kind == "log" and same(known, argument):
                return symbol(atom)
            if kind == "log" and same(known * argument, number(1)):
                return -symbol(atom)
        return self._new("log", argument)

    def _exp(self, argument: Ratio) -> Ratio:
        factor = number(1)
        if len(argument.den) == 1:
            (below, _), = argument.den.items()
            for monomial, coefficient in list(argument.num.items()):
                term = times_monomial(monomial, tuple((x, -n) for x, n in below))
                atom, power = term[0] if len(term) == 1 else ("", 0)
                kind, inner = self.functions.get(atom, ("", argument))
                if kind == "log" and power == 1 and coefficient.denominator == 1:  # exp(x + c log A) = exp(x) A**c
                    factor = factor * self.power(inner, number(coefficient))
                    argument = argument + -symbol(atom) * number(coefficient)
                elif not term and len(argument.num) > 1:  # exp(x + q) = exp(x) exp(q)
                    factor = factor * self._exp(number(coefficient))
                    argument = argument + -number(coefficient)
        if argument.is_zero():
            return factor
        for atom, (kind, known) in self.functions.items():
            if kind == "exp" and same(known, argument):
                return factor * symbol(atom)
            if kind == "exp" and same(known, -argument):
                return factor * symbol(atom).inverse()
        return factor * self._new("exp", argument)

    def _new(self, kind: str, argument: Ratio) -> Ratio:
        atom = f"{kind}#{len(self.functions)}"
        self.functions[atom] = (kind, argument)
        return symbol(atom)

    def derivative(self, value: Ratio, flow: dict[str, Ratio]) -> Ratio:
        """Total derivative along a flow; symbols without a rate are constant."""
        free = self.is_free(value)
        if value.den is ONE:
            return self._poly_derivative(value.num, flow, free)
        d_num, d_den = self._poly_derivative(value.num, flow, free), self._poly_derivative(value.den, flow, free)
        below = Ratio(value.den).inverse()
        return d_num * below + -(Ratio(value.num) * d_den * below * below)

    def _poly_derivative(self, poly: Poly, flow: dict[str, Ratio], free: bool) -> Ratio:
        parts: list[Ratio] = []
        rates: dict[str, Ratio] = {}
        for monomial, coefficient in poly.items():
            spend(1 + len(monomial))
            for atom, power in monomial:
                if atom not in rates:
                    rates[atom] = self._rate(atom, flow)
                if not (rate := rates[atom]).is_zero():
                    rest = times_monomial(monomial, ((atom, -1),))
                    if free or (SUM, 1) in rest:
                        rate = self.closed(rate)
                    parts.append(Ratio.normal({rest: coefficient * power}) * rate)
        return sum_of(parts)

    def _rate(self, atom: str, flow: dict[str, Ratio]) -> Ratio:
        if atom in self.functions:
            kind, argument = self.functions[atom]
            inner = self.derivative(argument, flow)
            if kind == TOTAL:
                return self.total_of(inner)
            if kind in ("sin", "cos"):
                return inner * self.call("cos", argument) if kind == "sin" else -inner * self.call("sin", argument)
            if kind == "arctan":
                return inner * (number(1) + argument * argument).inverse()
            if kind not in ("log", "exp") and not inner.is_zero():
                raise CertificateError(f"a derivative of {kind} is not taken: it is none everywhere")
            return inner * argument.inverse() if kind == "log" else inner * symbol(atom)
        return flow.get(atom, number(0))

    def partial_operations(self, text: str) -> list[tuple[ast.expr, str]]:
        """Where an expression or relation may be undefined; with D, every rate must be defined too."""
        if text not in self.places:
            rates = self.rates.values() if calls(text, "D") else ()
            self.places[text] = [place for part in (text, *rates) for place in partial_operations(part)]
        return self.places[text]

    def moving(self) -> set[str]:
        """Symbols that may change along the flow."""
        return self.inputs | {name for name, rate in self.flow.items() if not rate.is_zero()}


# --- signs -------------------------------------------------------------------------------------------------


class Signs:
    """What assumptions say of signs: polynomials known positive or not zero, atoms known positive or not negative."""

    def __init__(self, context: Context, margins: list[Sign], closed: list[Sign]) -> None:
        self.context = context
        self.single = {(m[0][0], op) for r, op in closed if r.den is ONE and len(r.num) == 1
                       for m, c in r.num.items() if c > 0 and len(m) == 1 and m[0][1] == 1}
        self.atoms: set[str] = set()
        self.weak: set[str] = set()
        found: set[str] = set()  # the functions that are positive: every exp, and sqrt of what is positive
        for atom, (kind, argument) in context.functions.items():  # functions inside others come first
            if kind == "sqrt":
                self._take(found)
            if kind == "exp" or (kind == "sqrt" and (
                    any(op == ">" and same(argument, known) for known, op in margins)
                    or all(self.positive_by_terms(part) for part in (argument.num, argument.den)))):
                found.add(atom)
        self._take(found)
        known = [(r.num, op) for r, op in closed if r.den is ONE and op in (">", "!=") and r.num.keys() != ONE.keys()]
        functions = [symbol(atom).num for atom in found]
        self.positive = [num for num, op in known if op == ">"] + functions
        self.nonzero = [num for num, _ in known] + functions

    def _take(self, functions: set[str]) -> None:
        """Which atoms are positive and not negative, with these functions."""
        self.atoms = {atom for atom, op in self.single if op == ">"} | functions
        self.weak = self.atoms | {atom for atom, op in self.single if op == ">="} | {SUM}
        self.weak |= {a for a, (kind, _) in self.context.functions.items() if kind in ("abs", "sqrt")}
        self.weak |= {a for a, (kind, term) in self.context.functions.items()
                      if kind == TOTAL and term.den is ONE and self._not_negative(term.num)}

    def _not_negative(self, poly: Poly) -> bool:
        return all(c > 0 and all(n % 2 == 0 or a in self.weak for a, n in m) for m, c in poly.items())

    def positive_by_terms(self, poly: Poly, weakly: bool = False) -> bool:
        """Whether no term is negative and, unless weakly, one is positive."""
        return self._not_negative(poly) and (weakly or any(all(a in self.atoms for a, _ in m) for m in poly))


class Relations:
    """Assumptions in force, as (margin, operator) with margin > 0, >= 0, == 0 or != 0.

    Each is read where the earlier ones hold. `always` holds at every instant along the flow, `initial` names
    the values of the flow's symbols at time zero; both serve the rule `nonincreasing` only.
    """

    def __init__(self, context: Context, texts: list[str]) -> None:
        self.context = context
        self.margins: list[Sign] = []
        self.closed_margins: list[Sign] = []
        self.signs: tuple[tuple[int, int], Signs] | None = None
        self.always: list[str] = []
        self.initial: dict[str, Ratio] = {}
        self.assume(texts)

    def assume(self, texts: list[str]) -> None:
        """Add relations, each read where the earlier ones hold."""
        for text in texts:
            self.require_defined(text)
            self.margins.append(margin(self.context, text))

    def with_margins(self, margins: list[Sign]) -> Relations:
        """The same surroundings with other assumptions."""
        other = Relations(self.context, [])
        other.margins, other.always, other.initial = margins, self.always, self.initial
        return other

    def free_of(self, names: set[str]) -> Relations:
        """The same list with every assumption about these symbols emptied, so that positions stay."""
        empty = (number(0), ">=")
        kept = [empty if symbols_of(self.context, value) & names else (value, op) for value, op in self.margins]
        return self.with_margins(kept)

    def sign_known(self, poly: Poly, nonzero_only: bool = False) -> bool:
        """Whether a polynomial is a product of margins known positive (or only non-zero), or obviously so."""
        if poly.keys() == ONE.keys():
            return poly[()] > 0 or nonzero_only
        signs = self._signs()
        factors = signs.nonzero if nonzero_only else signs.positive
        for order in (factors, factors[::-1]) if factors[1:] else (factors,):  # x*y by x leaves y, of no known sign
            rest, before = poly, None
            while rest != before and rest.keys() != ONE.keys():
                before = rest
                for factor in order:
                    rest = divide_exactly(rest, factor) or rest
            if (rest[()] > 0 or nonzero_only) if rest.keys() == ONE.keys() else signs.positive_by_terms(rest):
                return True
        return False

    def _closed_margins(self) -> list[Sign]:
        more = self.margins[len(self.closed_margins):]  # assumptions are only ever added
        self.closed_margins += [(self.context.closed(value), op) for value, op in more]
        return self.closed_margins

    def _signs(self) -> Signs:
        """What the assumptions say, looked at once for as long as there are no more of them, and no more functions."""
        closed = self._closed_margins()
        stand = len(closed), len(self.context.functions)
        if self.signs is None or self.signs[0] != stand:
            spend(sum(stand))
            self.signs = stand, Signs(self.context, self.margins, closed)
        return self.signs[1]

    def nonnegative_known(self, value: Ratio) -> bool:
        """Whether a value is an assumption's margin, or positive, or a sum of terms that are not negative."""
        value = self.context.closed(value)
        if any(op in (">", ">=") and same(value, known) for known, op in self._closed_margins()):
            return True
        return self.sign_known(value.den) and (
            self.sign_known(value.num) or self._signs().positive_by_terms(value.num, weakly=True))

    def sign_known_value(self, value: Ratio, nonzero_only: bool = False) -> bool:
        """The same for a rational function, where it is defined."""
        value = self.context.closed(value)
        return self.sign_known(value.num, nonzero_only) and self.sign_known(value.den, nonzero_only)

    def fits(self, value: Ratio, wanted: str) -> bool:
        """Whether a value is known to be non-zero, positive or non-negative."""
        return (self.nonnegative_known(value) if wanted == "non-negative"
                else self.sign_known_value(value, wanted == "non-zero"))

    def require_defined(self, text: str) -> None:
        """Every denominator in `text` is non-zero, every argument of log positive, of sqrt non-negative, always."""
        for part, wanted in self.context.partial_operations(text):
            if not (wanted == "non-negative" and self.squares(part)) and not self.fits(self.context.node(part), wanted):
                raise CertificateError(f"not shown {wanted}: {ast.unparse(part)}")

    def squares(self, node: ast.expr) -> bool:
        """Whether an expression is written as a sum, over an index too, of even powers and of what is not negative."""
        match node:
            case ast.BinOp(op=ast.Pow(), right=ast.Constant(value=int(power))):
                return power % 2 == 0
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return self.squares(left) and self.squares(right)
            case ast.Call(func=ast.Name(id="Sum"), args=[inner]):
                return self.squares(inner)
        return self.fits(self.context.node(node), "non-negative")

    def require_defined_value(self, value: Ratio) -> None:
        """The same for a value that is no text."""
        if not self.sign_known(value.den, True):
            raise CertificateError("a denominator is not shown non-zero")
        for atom in atoms_of(value) & self.context.functions.keys():
            kind, argument = self.context.functions[atom]
            self.require_defined_value(argument)
            if kind == "log" and not self.sign_known_value(argument):
                raise CertificateError("an argument of log is not shown positive")
            if kind == "sqrt" and not self.nonnegative_known(argument):
                raise CertificateError("an argument of sqrt is not shown non-negative")


def sides_of(text: str) -> list[ast.expr]:
    """The syntax tree of an expression, or those of both sides of a relation."""
    return [parse(side) for side in (split_relation(text)[::2] if has_relation(text) else (text,))]


def nodes(text: str) -> list[ast.AST]:
    """All nodes of an expression, or of both sides of a relation."""
    return [node for side in sides_of(text) for node in walk(side)]


def walk(tree: ast.expr) -> list[ast.AST]:
    """What `ast.walk` finds, but the signs of operations."""
    found: list[ast.AST] = [tree]
    for node in found:  # which grows
        if isinstance(node, ast.BinOp):
            found += (node.left, node.right)
        elif not isinstance(node, (ast.Name, ast.Constant)):
            found += ast.iter_child_nodes(node)
    return found


def calls(text: str, name: str) -> bool:
    """Whether an expression or relation calls a function."""
    return any(name in _looked_at(side)[0] for side in sides_of(text))


def partial_operations(text: str) -> list[tuple[ast.expr, str]]:
    """Denominators and arguments of log and sqrt with the sign they need for the expression to be defined."""
    return [place for side in sides_of(text) for place in _looked_at(side)[1]]


@lru_cache(maxsize=MOST_KEPT)
def _looked_at(tree: ast.expr) -> tuple[set[str], list[tuple[ast.expr, str]]]:
    """The functions that an expression calls, and its partial operations."""
    called: set[str] = set()
    places: list[tuple[ast.expr, str]] = []
    for node in walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            called.add(node.func.id)
        elif not isinstance(node, ast.BinOp):
            continue
        match node:
            case ast.BinOp(op=ast.Div(), right=below):
                places.append((below, "non-zero"))
            case ast.BinOp(left=below, op=ast.Pow(), right=n) if not isinstance(n, ast.Constant):
                places.append((below, "non-zero"))
            case ast.Call(func=ast.Name(id="tan"), args=[inner]):
                places.append((ast.Call(ast.Name("cos"), [inner], []), "non-zero"))
            case ast.Call(func=ast.Name(id="log"), args=[inner]):
                places.append((inner, "positive"))
            case ast.Call(func=ast.Name(id="sqrt"), args=[inner]):
                places.append((inner, "non-negative"))
    return called, places


def symbols_of(context: Context, value: Ratio) -> set[str]:
    """The symbols a value mentions, inside functions too."""
    found = atoms_of(value)
    while inside := set().union(*(atoms_of(context.functions[a][1]) for a in found & context.functions.keys())) - found:
        found |= inside
    if any(context.kind(atom) == TOTAL for atom in found):
        found.add(SUM)
    return found - context.functions.keys()


def has_relation(text: str) -> bool:
    """Whether the text is a relation rather than an expression."""
    return any(f" {operator} " in text for operator in OPERATORS)


def split_relation(text: str) -> tuple[str, str, str]:
    """(left, operator, right) of 'left <= right' and the like."""
    found = [operator for operator in OPERATORS if f" {operator} " in text]
    if len(found) != 1 or text.count(f" {found[0]} ") != 1:
        raise CertificateError(f"'{text}' is no single relation")
    left, _, right = text.partition(f" {found[0]} ")
    return left, found[0], right


def margin(context: Context, text: str) -> Sign:
    """A relation as (value, operator): value > 0, >= 0, == 0 or != 0."""
    left, operator, right = split_relation(text)
    a, b = context.read(left), context.read(right)
    if operator in ("<=", "<"):
        return b - a, operator.replace("<", ">")
    return a - b, operator


# --- proofs ------------------------------------------------------------------------------------------------


def prove(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """Raise CertificateError unless `proof` shows value > 0, >= 0 or == 0 under the relations given."""
    rules = {"identity": _identity, "combination": _combination, "cut": _cut, "cases": _cases,
             "contradiction": _contradiction, "monotone": _monotone, "nonincreasing": _nonincreasing}
    if proof.get("rule") not in rules:
        raise CertificateError(f"unknown rule '{str(proof.get('rule'))[:40]}'")
    if Work.depth >= MOST_DEPTH:
        raise CertificateError(f"a proof in more than {MOST_DEPTH} proofs")
    Work.depth += 1
    try:
        rules[proof["rule"]](value, operator, given, proof)
    finally:
        Work.depth -= 1


def _identity(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    if not given.context.closed(value).is_zero() or operator not in ("==", ">="):
        raise CertificateError("the two sides differ")


def _cut(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """First the lemma, then the goal with the lemma as one more assumption."""
    given.require_defined(proof["lemma"])
    lemma = margin(given.context, proof["lemma"])
    prove(*lemma, given, proof["proof"])
    prove(value, operator, given.with_margins([*given.margins, lemma]), proof["then"])


def _contradiction(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """What is to be shown may be assumed not to hold: with that the assumptions add up to 0 > 0."""
    direction, opposite = NEGATED[operator]
    _combination(number(0), ">", given.with_margins([*given.margins, (number(direction) * value, opposite)]), proof)


NEGATED = {">": (-1, ">="), ">=": (-1, ">"), "==": (1, "!="), "!=": (1, "==")}
CASES = {("nonnegative", "nonpositive"): ((1, ">=", None), (-1, ">=", None)),
         ("negative", "positive", "zero"): ((-1, ">", -1), (1, ">", 1), (1, "==", 0))}


def _cases(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """One proof for each sign of an expression; its abs, and its sign where no case leaves it open, are then known."""
    context, names = given.context, tuple(sorted(proof.keys() - {"rule", "of"}))
    if names not in CASES:
        raise CertificateError(f"{', '.join(names)} are not all the cases")
    given.require_defined(proof["of"])
    inspected = context.closed(context.read(proof["of"]))
    for name, (direction, relation, sign) in zip(names, CASES[names], strict=True):
        size = number(direction) * inspected
        known: dict[str, Ratio] = {}
        for atom, (kind, argument) in context.functions.items():
            turned = same(argument, -inspected)
            if kind == "abs" and (turned or same(argument, inspected)):
                known[atom] = size
            elif kind == "sign" and sign is not None and (turned or same(argument, inspected)):
                known[atom] = number(-sign if turned else sign)
        case = [(substitute(context, margin, known), op) for margin, op in given.margins]
        prove(substitute(context, value, known), operator, given.with_margins([*case, (size, relation)]), proof[name])


def _monotone(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """value(x) >= value(start) where value is defined from start to x and does not fall on the way there.

    For x >= start (`from`) d value/dx >= 0 is shown between them, for x <= start (`to`) d value/dx <= 0.
    """
    context, name = given.context, read_name(proof["variable"])
    if operator not in (">", ">="):
        raise CertificateError("a value that does not decrease is at least that at the start, no more")
    if (upwards := "from" in proof) == ("to" in proof):
        raise CertificateError("a start is named with 'from' or with 'to'")
    start = context.read(proof["from" if upwards else "to"])
    step = symbol(name) + -start if upwards else start + -symbol(name)
    if not any(same(known, step) and op in (">=", ">") for known, op in given.margins):
        raise CertificateError(f"{name} {'>=' if upwards else '<='} the start is not among the assumptions")
    if name in symbols_of(context, start):
        raise CertificateError("the start depends on the variable")
    elsewhere = given.free_of({name})  # what is assumed of x itself need not hold between start and x,
    away = symbol(name) if upwards else -symbol(name)  # but that x lies below a bound, or above one where it falls
    bounded = [(known, op) for known, op in given.margins
               if op in (">=", ">") and name not in symbols_of(context, known + away)]
    between = elsewhere.with_margins([*elsewhere.margins, (step, ">="), *bounded])
    between.initial = {}  # there x is no value that the flow takes
    for step in proof.get("between", []):  # what holds on the way, that a denominator is positive, say
        between.require_defined(step["lemma"])
        lemma = margin(context, step["lemma"])
        prove(*lemma, between, step["proof"])
        between = between.with_margins([*between.margins, lemma])
    between.require_defined_value(value)
    prove(context.derivative(value, {name: number(1 if upwards else -1)}), ">=", between, proof["derivative"])
    prove(substitute(context, value, {name: start}), operator, elsewhere, proof["at_start"])


def _nonincreasing(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """A function of the flow whose derivative is never positive is at most what it was at time zero."""
    context = given.context
    if not given.initial or set(given.initial) != set(context.flow):
        raise CertificateError("the goal names no initial values for its flow")
    # Assumptions of the final instant say nothing of earlier ones: only those of constants are kept.
    along = given.free_of(context.moving())
    along.assume(given.always)
    for text in (*context.rates.values(), proof["function"]):
        along.require_defined(text)
    function = context.read(proof["function"])
    if symbols_of(context, function) & context.inputs:
        raise CertificateError("the function mentions an input, whose rate is not known")
    prove(-context.derivative(function, context.flow), ">=", along, proof["decrease"])
    drop = substitute(context, function, given.initial) + -function
    prove(value, operator, given.with_margins([*given.margins, (drop, ">=")]), proof["then"])


def _argument(given: Relations, text: str, wanted: str | None = None) -> Ratio:
    """What a factor is about, read on its own, shown to be defined and of the sign wanted."""
    given.require_defined(text)
    value = given.context.read(text)
    if wanted is not None and not given.fits(value, wanted):
        raise CertificateError(f"not shown {wanted}: {text}")
    return value


def _factor(given: Relations, item: dict[str, Any]) -> Sign:
    """(value, sign) of a factor of a combination; sign is '>', '>=', '==' (zero) or 'any'."""
    context = given.context
    match item:
        case {"assume": int(i)}:
            return given.margins[i]
        case {"positive": str(text)}:
            return _argument(given, text, "positive"), ">"
        case {"inverse": int(i)} if given.margins[i][1] == ">":
            return context.closed(given.margins[i][0]).inverse(), ">"
        case {"square_of": int(i)} if given.margins[i][1] == "!=":
            return context.product(given.margins[i][0], given.margins[i][0]), ">"
        case {"square": str(text)}:
            root = _argument(given, text)
            return context.product(root, root), ">="
        case {"sum_of_squares": str(text)}:
            given.require_defined(text)
            value = context.term(text)
            return value * value * symbol(SUM), ">="
        case {"any": str(text)}:
            return _argument(given, text), "any"
        case {"fact": "log_tangent", "of": str(text)}:
            inner = _argument(given, text, "positive")
            return inner + number(-1) + -context.call("log", inner), ">="
        case {"fact": "exp_tangent", "of": str(text)}:
            inner = _argument(given, text)
            return context.call("exp", inner) + number(-1) + -inner, ">="
        case {"fact": "exp_positive", "of": str(text)}:
            return context.call("exp", _argument(given, text)), ">"
        case {"fact": "circle", "of": str(text)}:
            sine, cosine = (context.call(name, _argument(given, text)) for name in ("sin", "cos"))
            return sine * sine + cosine * cosine + number(-1), "=="
        case {"fact": "cosine_parabola", "of": str(text)}:
            inner = _argument(given, text)
            return context.call("cos", inner) + number(-1) + inner * inner * number(Fraction(1, 2)), ">="
        case {"fact": "sine_tangent", "of": str(text)}:
            inner = _argument(given, text, "non-negative")
            return inner + -context.call("sin", inner), ">="
        case {"fact": str(fact), "of": str(text)} if fact in ARCTAN:
            say, sign, wanted = ARCTAN[fact]
            inner = _argument(given, text, wanted)
            return say(context, inner, context.call("arctan", inner)), sign
        case {"fact": "sine_sum" | "cosine_sum" | "exp_sum" | "log_product" as fact, "of": str(one), "and": str(two)}:
            a, b = (_argument(given, text, "positive" if fact == "log_product" else None) for text in (one, two))
            return _addition(context, fact, a, b), "=="
        case {"fact": "enclosure", "of": str(text)}:
            value = context.read(text)
            if symbols_of(context, value) or bounds(context, value)[0] < 0:  # bounds of a sum are those of one neuron
                raise CertificateError(f"not a number that is enclosed above zero: {text}")
            return value, ">="
        case {"fact": "abs_square", "of": str(text)}:
            size, inner = context.call("abs", _argument(given, text)), context.closed(context.read(text))
            return size * size + -(inner * inner), "=="
        case {"fact": "abs_nonnegative", "of": str(text)}:
            return context.call("abs", _argument(given, text)), ">="
        case {"fact": "sqrt_square", "of": str(text)}:
            root = context.call("sqrt", _argument(given, text, "non-negative"))
            return root * root + -context.read(text), "=="
        case {"fact": "sqrt_nonnegative" | "sqrt_positive" as fact, "of": str(text)}:
            wanted, sign = ("positive", ">") if fact == "sqrt_positive" else ("non-negative", ">=")
            return context.call("sqrt", _argument(given, text, wanted)), sign
    raise CertificateError(f"unknown factor {item}")


# What is known of a = arctan x, the angle between -2 arctan 1 and 2 arctan 1 whose tangent is x: the value, its sign,
# and what is wanted of x. From 0 up to x arctan rises at rates between 1/(1 + x**2) and 1.
ARCTAN: dict[str, tuple[Callable[[Context, Ratio, Ratio], Ratio], str, str | None]] = {
    "arctan_sine": (lambda c, x, a: c.call("sin", a) + -(x * c.call("cos", a)), "==", None),
    "arctan_cosine": (lambda c, x, a: c.call("cos", a), ">", None),
    "arctan_limit": (lambda c, x, a: number(2) * c.call("arctan", number(1)) + -a, ">", None),
    "arctan_tangent": (lambda c, x, a: x + -a, ">=", "non-negative"),
    "arctan_sector": (lambda c, x, a: a * (x + -a), ">=", None),
    "arctan_slope": (lambda c, x, a: x * (a * (number(1) + x * x) + -x), ">=", None)}


def _addition(context: Context, fact: str, a: Ratio, b: Ratio) -> Ratio:
    """What is 0 by the addition theorem of a function."""
    match fact:
        case "log_product":
            return context.call("log", a * b) + -context.call("log", a) + -context.call("log", b)
        case "exp_sum":
            return context.call("exp", a + b) + -(context.call("exp", a) * context.call("exp", b))
    (sin_a, cos_a), (sin_b, cos_b) = ((context.call("sin", x), context.call("cos", x)) for x in (a, b))
    if fact == "sine_sum":
        return context.call("sin", a + b) + -(sin_a * cos_b) + -(cos_a * sin_b)
    return context.call("cos", a + b) + -(cos_a * cos_b) + sin_a * sin_b


def _combination(value: Ratio, operator: str, given: Relations, proof: dict[str, Any]) -> None:
    """multiplier * value = sum of coefficient * product of factors, all of known sign."""
    context, scale = given.context, number(1)
    for item in proof.get("multiplier", []):
        factor, sign = _factor(given, item)
        if sign != ">":
            raise CertificateError("the multiplier is not strictly positive")
        scale = context.product(scale, factor)
    products, strict = list[Ratio](), False
    for term in proof["terms"]:
        coefficient = read_rational(term["coefficient"])
        product = number(coefficient)
        signs: set[str] = set()
        for item in term["factors"]:
            factor, sign = _factor(given, item)
            product, signs = context.product(product, factor), signs | {sign}
        if "==" not in signs and (coefficient < 0 or not signs <= {">", ">="}):
            raise CertificateError(f"a term may be negative: {str(term)[:200]}")
        strict |= coefficient > 0 and signs <= {">"}
        products.append(product)
    if operator == "==" and not (proof["terms"] == [] or all(
            any(_factor(given, f)[1] == "==" for f in t["factors"]) for t in proof["terms"])):
        raise CertificateError("an equality needs equalities")
    if operator == ">" and not strict:
        raise CertificateError("no strictly positive term")
    if operator not in (">", ">=", "==") or not context.closed(
            context.product(scale, value) - sum_of(products)).is_zero():
        raise CertificateError("the combination does not add up to the goal")


def substitute(context: Context, value: Ratio, point: dict[str, Ratio], done: dict[str, Ratio] | None = None) -> Ratio:
    """The value with symbols replaced, inside functions too; `done` are the functions that are replaced already."""
    known = dict(point) if done is None else done

    def replaced(atom: str) -> Ratio | None:
        """What stands for an atom, None where it stays."""
        if atom not in known and atom in context.functions:
            kind, argument = context.functions[atom]
            inner = substitute(context, argument, point, known)
            if kind == TOTAL:
                known[atom] = context.total_of(inner, known.get(SUM))
            else:
                if SUM in symbols_of(context, inner) and (
                        SUM not in (before := symbols_of(context, argument)) and before & context.indexed):
                    raise CertificateError("a sum inside a sum")
                known[atom] = context.call(kind, inner)
        return known.get(atom)

    def term(monomial: Monomial, coefficient: Number) -> Ratio:
        spend(1 + len(monomial))
        stay: list[tuple[str, int]] = []
        factors: list[Ratio] = []
        for atom, power in monomial:
            value = replaced(atom)
            if value is None:
                stay.append((atom, power))
            else:
                factors.append(context.power(value, number(power)))
        product = Ratio.normal({tuple(stay): coefficient})
        for factor in factors:
            product = product * factor
        return product

    def poly(p: Poly) -> Ratio:
        return sum_of([term(monomial, coefficient) for monomial, coefficient in p.items()])

    return poly(value.num) if value.den is ONE else poly(value.num) * poly(value.den).inverse()


# --- values at a point: rational intervals -----------------------------------------------------------------

Bounds = dict[str, tuple[Fraction, Fraction]]


def exp_bounds(x: Fraction) -> tuple[Fraction, Fraction]:
    """Rational bounds of exp(x)."""
    if x < 0:
        low, high = exp_bounds(-x)
        return 1 / high, 1 / low
    if x > LARGEST_EXPONENT:
        raise CertificateError("exp of a number that is too large to be computed")
    if (ends := _short(x)) != (x, x):
        return exp_bounds(ends[0])[0], exp_bounds(ends[1])[1]
    halvings = 0
    while x > Fraction(1, 2):
        x, halvings = x / 2, halvings + 1
    total, term, k = Fraction(1), Fraction(1), 0
    while term > PRECISION:
        k += 1
        term = term * x / k
        total += term
    low, high = total, total + term  # the tail is below the last term for x <= 1/2
    for _ in range(halvings):
        low, high = _round(low * low, -1), _round(high * high, 1)
    return low, high


def log_bounds(x: Fraction) -> tuple[Fraction, Fraction]:
    """Rational bounds of log(x), x > 0, by 2 atanh((x-1)/(x+1)) after scaling by powers of 2."""
    if x <= 0:
        raise CertificateError("log of a number that is not positive")
    doublings = x.numerator.bit_length() - x.denominator.bit_length()
    x = x / 2**doublings if doublings >= 0 else x * 2**-doublings
    while x > Fraction(3, 2):
        x, doublings = x / 2, doublings + 1
    while x < Fraction(3, 4):
        x, doublings = x * 2, doublings - 1
    (low, _), (_, high) = (_atanh_bounds((y - 1) / (y + 1)) for y in _short(x))
    if doublings:
        two_low, two_high = _atanh_bounds(Fraction(1, 3))
        low += doublings * (two_low if doublings > 0 else two_high)
        high += doublings * (two_high if doublings > 0 else two_low)
    return 2 * low, 2 * high


def _short(x: Fraction) -> tuple[Fraction, Fraction]:
    """Bounds of x in few digits below its point; x itself where it has few."""
    if x.numerator.bit_length() + x.denominator.bit_length() <= 600:
        return x, x
    whole = x.numerator * 10**60 // x.denominator
    return Fraction(whole, 10**60), Fraction(whole + 1, 10**60)


def _atanh_bounds(z: Fraction, turn: int = 1) -> tuple[Fraction, Fraction]:
    """Rational bounds of atanh(z), or of arctan(z) where every other term is turned (-1), for abs(z) < 1."""
    total, power, k = Fraction(0), z, 0
    while abs(power) > PRECISION:
        total, power, k = total + power / (2 * k + 1), power * z * z * turn, k + 1
    slack = abs(power) / (1 - z * z)
    return total - slack, total + slack


def arctan_bounds(x: Fraction) -> tuple[Fraction, Fraction]:
    """Rational bounds of arctan(x): of x > 1/2 by arctan 1/2 + arctan((2 x - 1)/(x + 2)), whose product is below 1."""
    if x < 0:
        low, high = arctan_bounds(-x)
        return -high, -low
    if x > Fraction(1, 2):
        (low, high), (more, most) = (arctan_bounds(part) for part in (Fraction(1, 2), (2 * x - 1) / (x + 2)))
        return low + more, high + most
    (low, _), (_, high) = (_atanh_bounds(y, -1) for y in _short(x))
    return low, high


def _round(x: Fraction, direction: int) -> Fraction:
    """x rounded outwards to a few dozen significant digits, to keep fractions short."""
    scale = 10**40
    while abs(x) * scale < 10**30 and x:
        scale *= 10**10
    whole = x.numerator * scale // x.denominator
    return Fraction(whole + (direction > 0), scale)


def sqrt_bounds(x: Fraction) -> tuple[Fraction, Fraction]:
    """Rational bounds of sqrt(x), x >= 0; both are exact for the square of a rational number."""
    if x < 0:
        raise CertificateError("sqrt of a negative number")
    scale = 10**40 * x.denominator
    low = math.isqrt(x.numerator * scale * scale // x.denominator)
    exact = low * low * x.denominator == x.numerator * scale * scale
    return Fraction(low, scale), Fraction(low if exact else low + 1, scale)


def circle_bounds(kind: str, x: Fraction, y: Fraction) -> tuple[Fraction, Fraction]:
    """Rational bounds of sin or cos between x and y: of its series at x, and no slope is beyond 1."""
    start = Fraction(math.floor(x * 10**40), 10**40)
    if abs(start) > 32 or y - start > 1:
        return Fraction(-1), Fraction(1)
    total, term, k = Fraction(0), start if kind == "sin" else Fraction(1), int(kind == "sin")
    while k <= abs(start) or abs(term) > PRECISION:  # from there on terms fall, and their signs alternate
        total, term, k = total + term, -term * start * start / ((k + 1) * (k + 2)), k + 2
    slack = abs(term) + y - start
    return max(_round(total - slack, -1), Fraction(-1)), min(_round(total + slack, 1), Fraction(1))


def bounds(context: Context, value: Ratio, known: Bounds | None = None) -> tuple[Fraction, Fraction]:
    """Rational bounds of a value (n = 1 for sums); `known` are symbols and functions that are bounded already."""
    if (exact := value.constant()) is not None:
        return Fraction(exact), Fraction(exact)
    known = {} if known is None else known

    def atom_bounds(atom: str) -> tuple[Fraction, Fraction]:
        if atom not in known:
            if atom not in context.functions:
                raise CertificateError(f"symbol '{atom}' has no value at the point")
            kind, argument = context.functions[atom]
            x, y = bounds(context, argument, known)
            if kind == "abs":
                known[atom] = (Fraction(0) if x <= 0 <= y else min(abs(x), abs(y))), max(abs(x), abs(y))
            elif kind == "sign":
                known[atom] = Fraction((x > 0) - (x < 0)), Fraction((y > 0) - (y < 0))
            elif kind in ("sin", "cos"):
                known[atom] = circle_bounds(kind, x, y)
            elif kind == TOTAL:
                known[atom] = x, y
            else:
                function = {"log": log_bounds, "exp": exp_bounds, "sqrt": sqrt_bounds, "arctan": arctan_bounds}[kind]
                known[atom] = function(x)[0], function(y)[1]
                spend(100 + sum(bits_of(constant(end)) for end in known[atom]) // 16)
        return known[atom]

    def poly(p: Poly) -> tuple[Fraction, Fraction]:
        low = high = Fraction(0)
        for monomial, coefficient in p.items():
            a, b = coefficient, coefficient
            for atom, power in monomial:
                if atom == SUM:
                    continue
                inner = atom_bounds(atom)
                spend(power)
                for _ in range(power):
                    corners = [p * q for p in (a, b) for q in inner]
                    a, b = min(corners), max(corners)
                    spend((bits_of(constant(a)) + bits_of(constant(b))) // 256)
            low, high = low + a, high + b
        return low, high

    (a, b), (c, d) = poly(value.num), poly(value.den)
    if c <= 0 <= d:
        raise CertificateError("a denominator is zero at the point")
    corners = [p / q for p in (a, b) for q in (c, d)]
    return min(corners), max(corners)


Terms = list[dict[str, Ratio]]  # the indexed symbols' values in each term of the sums


def at(context: Context, value: Ratio, point: dict[str, Ratio], terms: Terms | None) -> Ratio:
    """The value at a point, with every formal sum added up over the terms; without them a sum has one term."""
    if terms is None:
        return substitute(context, value, point)
    known = dict(point)
    for atom in atoms_of(value) & context.functions.keys():
        kind, argument = context.functions[atom]
        if kind == TOTAL:
            known[atom] = at(context, argument * symbol(SUM), point, terms)
        elif SUM in symbols_of(context, argument):
            known[atom] = context.call(kind, at(context, argument, point, terms))
    inside = {tuple(f for f in m if f[0] != SUM): c for m, c in value.num.items() if (SUM, 1) in m}
    outside = Ratio({m: c for m, c in value.num.items() if (SUM, 1) not in m}, value.den)
    if any(found & context.indexed and SUM not in found
           for found in (symbols_of(context, symbol(atom)) for atom in atoms_of(outside))):
        raise CertificateError("a sum is not told apart from what stands beside it")
    total = substitute(context, outside, known)
    for row in terms if inside else ():
        total = total + substitute(context, Ratio(inside, value.den), known | row)
    return total


def require_defined_at(context: Context, text: str, point: dict[str, Ratio], terms: Terms | None = None,
                       between: Bounds | None = None) -> None:
    """CertificateError unless an expression or relation is defined at a point, in every term of its sums."""
    for part, wanted in context.partial_operations(text):
        value = context.closed(context.node(part))
        if terms is None or not context.is_free(value):
            places = [at(context, value, point, terms)]
        else:  # in a sum: in each of its terms, where other sums are the numbers that they are
            totals = {atom: at(context, symbol(atom), point, terms) for atom in atoms_of(value)
                      if context.kind(atom) == TOTAL}
            places = [substitute(context, value, point | totals | row) for row in terms]
        for here in places:
            low, high = bounds(context, here, dict(between or {}))
            if not (low > 0 or (wanted == "non-zero" and high < 0) or (wanted == "non-negative" and low == 0)):
                raise CertificateError(f"undefined at the point: {ast.unparse(part)}")


def holds(context: Context, text: str, point: dict[str, Ratio], terms: Terms | None = None,
          between: Bounds | None = None) -> bool:
    """Whether a relation holds at a point, or wherever symbols lie between bounds; an error where that is not told."""
    require_defined_at(context, text, point, terms, between)
    value, operator = margin(context, text)
    low, high = bounds(context, at(context, value, point, terms), dict(between or {}))
    verdict = {">": (low > 0, high <= 0), ">=": (low >= 0, high < 0),
               "==": (low == high == 0, low > 0 or high < 0), "!=": (low > 0 or high < 0, low == high == 0)}
    true, false = verdict[operator]
    if not (true or false):
        raise CertificateError(f"the enclosure at the point is too wide to decide: {text}")
    return true


# --- certificates ------------------------------------------------------------------------------------------


def read_goal(goal: dict[str, Any]) -> tuple[Context, Relations]:
    """The goal's context and its assumptions; every part must have the expected shape."""
    lists, maps = ("assume", "show", "always", "indexed", "inputs"), ("flow", "initial")
    if not goal.keys() <= {*lists, *maps, "eventually"}:
        raise CertificateError(f"a goal has no {', '.join(sorted(goal.keys() - {*lists, *maps, 'eventually'}))}")
    values = [goal.get(key, []) for key in lists] + [list(goal.get(key, {}).values()) for key in maps]
    if not all(isinstance(value, list) and all(isinstance(text, str) for text in value) for value in values):
        raise CertificateError("the parts of a goal are lists and maps of texts")
    for name in (*goal.get("indexed", []), *goal.get("inputs", []), *goal.get("flow", {}), *goal.get("initial", {})):
        read_name(name)
    context = Context(goal.get("flow", {}), goal.get("indexed", []), goal.get("inputs", []))
    if context.inputs & context.flow.keys():
        raise CertificateError("an input has no rate")
    given = Relations(context, goal.get("assume", []))
    given.always = goal.get("always", [])
    for name, text in goal.get("initial", {}).items():
        given.require_defined(text)
        given.initial[name] = context.read(text)
        if name not in context.flow or calls(text, "D") or symbols_of(context, given.initial[name]) & context.moving():
            raise CertificateError("initial values are constants, of symbols with a rate")
    return context, given


def check_proved(goal: dict[str, Any], certificate: dict[str, Any]) -> None:
    """A proof of every relation in `show`, and a point that meets all assumptions (nothing from nothing)."""
    if goal.get("eventually"):
        raise CertificateError("a claim of some later time is proved by naming that time")
    context, given = read_goal(goal)
    _check_example(goal, context, given, certificate)
    if not goal["show"] or len(goal["show"]) != len(certificate["proofs"]):
        raise CertificateError("one proof is needed for every relation shown")
    for text, proof in zip(goal["show"], certificate["proofs"], strict=True):
        _require_shown_defined(text, given, proof)
        prove(*margin(context, text), given, proof)
    sides = [sides_of(text) for text in goal["show"] if margin(context, text)[0].is_zero()]  # others are no texts alike
    if len(sides) == len(goal["show"]) and all(ast.dump(left) == ast.dump(right) for left, right in sides):
        raise CertificateError("trivial: both sides of every relation shown are the same text")


def _require_shown_defined(text: str, given: Relations, proof: dict[str, Any]) -> None:
    """CertificateError unless a relation is defined where the assumptions hold, with them the lemmas that its proof
    shows first: log y is, where y >= x > 0, once y > 0 is shown."""
    while True:
        try:
            given.require_defined(text)
            return
        except CertificateError:
            if proof.get("rule") != "cut":
                raise
        given = given.with_margins([*given.margins, margin(given.context, proof["lemma"])])
        proof = proof["then"]


def _check_example(goal: dict[str, Any], context: Context, given: Relations, certificate: dict[str, Any]) -> None:
    """An instant of a motion that meets all that is assumed, so that nothing is proved from nothing.

    Where the goal names initial values, the point is time zero and meets them, or a path leads to it from them.
    """
    point = read_point(certificate["example"])
    between = _require_met(context, goal, point, certificate, "example")
    for rate in context.rates.values():
        require_defined_at(context, rate, point, None, between)
    if "path" in certificate:
        _check_reached(context, given, point, certificate)
        return
    for name, value in given.initial.items():
        if not same(point[name], start_at(context, value, point, None)):
            raise CertificateError(f"the example is no instant of a motion: {name} is not where it starts, and no path "
                                   "leads there")
    lasting = given.always if given.initial else []
    if lasting and all(bounds(context, substitute(context, rate, point)) == (0, 0) for rate in context.flow.values()):
        return  # the motion rests there
    for text in lasting:
        if _leaves_at_once(context, *margin(context, text), point):
            raise CertificateError(f"the example's motion breaks at once what always holds: {text}")


def _leaves_at_once(context: Context, value: Ratio, operator: str, point: dict[str, Ratio]) -> bool:
    """Whether a relation that holds at a point fails right after it, by the first of its rates that is not zero; also
    where so many are zero that it is not told. An input may turn the motion back."""
    rate = value
    for order in range(MOST_RATES if operator in (">=", "==") else 0):
        if symbols_of(context, rate) & context.inputs:
            return False
        low, high = bounds(context, substitute(context, rate, point))
        if (low, high) != (0, 0):
            return order > 0 and (high < 0 or (operator == "==" and low > 0))
        try:
            below, rate = rate, context.derivative(rate, context.flow)
        except CertificateError:  # of a size or a sign
            return False
        if rate.is_zero() or (rate.den == below.den == ONE and divide_exactly(rate.num, below.num) is not None):
            return False  # a rate that is a multiple of the value: what is zero stays zero
    return operator in (">=", "==")


def _require_met(context: Context, goal: dict[str, Any], point: dict[str, Ratio], certificate: dict[str, Any],
                 what: str, terms: Terms | None = None) -> Bounds:
    """CertificateError unless all assumptions hold at a point. `roots` are symbols, left out of the point from here on,
    that lie between two numbers at which an equality assumed has opposite signs: somewhere between them it holds."""
    texts, roots = [*goal.get("assume", []), *goal.get("always", [])], certificate.get("roots", [])
    if roots and (goal.keys() - {"assume", "show", "flow"} or certificate.keys() & {"terms", "path"}
                  or certificate.get("verdict") == "violated"):
        raise CertificateError("roots are taken of goals of one instant, without sums, inputs and stated values")
    between = roots_of(certificate)
    for name, (low, high) in between.items():
        if not low <= point.pop(name).num.get((), Fraction(0)) <= high:
            raise CertificateError(f"the value given for the root {name} does not lie where it does")
    for root, (name, ends) in zip(roots, between.items(), strict=True):
        value, operator = margin(context, root["equality"])
        curve = substitute(context, value, point)
        sides = [substitute(context, curve, {name: number(end)}).num.get((), Fraction(0)) for end in ends]
        if operator != "==" or curve.den != ONE or atoms_of(curve) != {name} or (
                ends[0] >= ends[1] or sides[0] * sides[1] >= 0):
            raise CertificateError(f"no polynomial that changes its sign between the two numbers: {root['equality']}")
        require_defined_at(context, root["equality"], point, None, between)
        texts.remove(root["equality"])
    for text in texts:
        if not holds(context, text, point, terms, between):
            raise CertificateError(f"the {what} breaks the assumption {text}")
    return between


def roots_of(certificate: dict[str, Any]) -> Bounds:
    """The symbols that are roots, and the two numbers between which each lies."""
    return {read_name(root["of"]): (read_rational(root["from"]), read_rational(root["to"]))
            for root in certificate.get("roots", [])}


def start_at(context: Context, value: Ratio, point: dict[str, Ratio], terms: Terms | None) -> Ratio:
    """An initial value at a point; without terms a sum has one."""
    return at(context, value, point if terms is not None else point | {SUM: number(1)}, terms)


def check_false(goal: dict[str, Any], certificate: dict[str, Any]) -> None:
    """A point, or functions of time, where every assumption holds and a relation in `show` does not."""
    if "functions" in certificate:
        _check_model(goal, certificate)
        return
    if goal.get("eventually"):
        raise CertificateError("a point says nothing of later times")
    context, given = read_goal(goal)
    point = read_point(certificate["point"])
    terms = read_terms(certificate["terms"], context, point) if "terms" in certificate else None
    between = _require_met(context, goal, point, certificate, "point", terms)
    if "path" in certificate:
        if terms is not None:
            raise CertificateError("a path leads to no point at which sums have several terms")
        _check_reached(context, given, point, certificate)
    else:  # a point alone can only be the first of all instants
        for text in given.always:
            if symbols_of(context, margin(context, text)[0]) & (context.moving() - context.inputs):
                raise CertificateError(f"no path says that a motion from the point on keeps what always holds: {text}")
        for name, value in given.initial.items():
            here = terms if terms is not None and name in context.indexed else [point]
            if not all(same(values[name], start_at(context, value, point, terms)) for values in here):
                raise CertificateError(f"nothing says that the flow reaches the point: {name} is not where it starts")
    outcomes = [holds(context, text, point, terms, between) for text in goal["show"]]  # each must be defined
    if all(outcomes):
        raise CertificateError("the goal holds at the point")


def _check_reached(context: Context, given: Relations, point: dict[str, Ratio], certificate: dict[str, Any]) -> None:
    """Functions of time obey the flow from its initial values, keep what always holds for ever, and meet the point."""
    time, duration = read_name(certificate["time"]), read_rational(certificate["duration"])
    path = {name: context.read(text) for name, text in certificate["path"].items()}
    named = {n.id for text in (*context.rates.values(), *given.always) for n in nodes(text) if isinstance(n, ast.Name)}
    if context.indexed & context.moving() or time in named | point.keys() or duration < 0:
        raise CertificateError("a point is reached by a flow of numbers, no vectors, in a time of its own name")
    moving, inputs = context.moving(), context.inputs
    if not moving - inputs <= path.keys() <= moving or any(symbols_of(context, f) - {time} for f in path.values()):
        raise CertificateError("the path must give all that moves, and nothing but inputs beside, as functions of time")
    later, line = Relations(context, [f"{time} >= 0"]), point | path | {SUM: number(1)}  # of sums with one term
    for text in (*certificate["path"].values(), *context.rates.values(), *given.always):
        for part, wanted in context.partial_operations(text):
            if not later.fits(substitute(context, context.node(part), line), wanted):
                raise CertificateError(f"not shown defined at all times: {ast.unparse(part)}")
    if not all(same(substitute(context, f, {time: number(duration)}), point[name]) for name, f in path.items()):
        raise CertificateError("the path does not meet the point after that time")
    for name in context.flow:  # without an initial value it may start anywhere
        rate = context.derivative(line[name], {time: number(1)})
        start = substitute(context, line[name], {time: number(0)})
        if not same(rate, substitute(context, context.flow[name], line)) or (
                name in given.initial and not same(start, start_at(context, given.initial[name], point, None))):
            raise CertificateError(f"the path does not obey the flow from its initial values: {name}")
    for text, proof in zip(given.always, certificate["always"], strict=True):
        value, operator = margin(context, text)
        prove(substitute(context, value, line), operator, later, proof)


def _check_model(goal: dict[str, Any], certificate: dict[str, Any]) -> None:
    """Functions of t for the flow's symbols, each rate being a free symbol: what is assumed always holds for
    all t >= 0, and the relation shown fails for all t >= 0."""
    context, given = read_goal(goal)
    time, point = read_name(goal["eventually"]), read_point(certificate["point"])
    rates = {name: rate for name, rate in goal["flow"].items() if name != time}
    functions = {name: context.read(text) for name, text in certificate["functions"].items()}
    if goal["flow"].get(time) != "1" or functions.keys() != rates.keys() or len(goal["show"]) != 1:
        raise CertificateError("the model must give every moving symbol as a function of time")
    if len({time, *rates, *rates.values()}) != 1 + 2 * len(rates) or not set(rates.values()) <= context.inputs:
        raise CertificateError("the model needs flows whose rates are inputs, each its own")
    if point.keys() & {time, *rates, *rates.values()} or context.indexed:
        raise CertificateError("the point names constants only")
    later = Relations(context, [f"{time} >= 0"])
    values = {name: substitute(context, value, point) for name, value in functions.items()}
    if any(symbols_of(context, value) - {time} for value in values.values()):
        raise CertificateError("a function of the model mentions more than time and the constants of the point")
    values |= {rate: context.derivative(values[name], {time: number(1)}) for name, rate in rates.items()}

    def along(value: Ratio) -> Ratio:
        value = substitute(context, substitute(context, value, values), point)
        later.require_defined_value(value)
        return value

    for text in (*certificate["functions"].values(), *goal["always"], goal["show"][0]):
        for part, wanted in context.partial_operations(text):
            if not later.fits(along(context.node(part)), wanted):
                raise CertificateError(f"not shown defined at all times: {ast.unparse(part)}")
    for name, value in given.initial.items():
        start = substitute(context, values.get(name, symbol(name)), {time: number(0)})
        if not same(substitute(context, value, point), start):
            raise CertificateError(f"the model does not start at the initial value of {name}")
    _require_met(context, {"assume": goal.get("assume", [])}, point, {}, "model")
    for text, proof in zip(goal["always"], certificate["always"], strict=True):
        value, operator = margin(context, text)
        prove(along(value), operator, later, proof)
    value, operator = margin(context, goal["show"][0])
    prove(-along(value), {">=": ">", ">": ">="}[operator], later, certificate["fails"])


def read_name(name: Any) -> str:
    """The name of a symbol, which no atom of this file can be mistaken for."""
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise CertificateError(f"{name!r} is not the name of a symbol")
    return name


def read_rational(text: Any) -> Fraction:
    """A rational number 'p/q'."""
    if not isinstance(text, str) or not RATIONAL.fullmatch(text):
        raise CertificateError(f"{str(text)[:80]!r} is not a rational number 'p/q'")
    return Fraction(text)


def read_terms(terms: list[dict[str, Any]], context: Context, point: dict[str, Ratio]) -> Terms:
    """The values of all indexed symbols, and of no others, in each term of the sums; none is an empty sum."""
    found = [read_point(term) for term in terms]
    if len(found) > MOST_TERMS or any(row.keys() != context.indexed for row in found) or point.keys() & context.indexed:
        raise CertificateError(f"the terms of the sums give all indexed symbols and nothing else, at most {MOST_TERMS}")
    return found


def read_point(point: dict[str, Any]) -> dict[str, Ratio]:
    """Rational values 'p/q' of symbols."""
    return {read_name(name): number(read_rational(text)) for name, text in point.items()}


ACCEPTED: set[str] = set()  # what files this process has checked itself, by digest: theorems are composed of them
CHECKS = {"proved": check_proved, "refuted": check_false, "violated": check_false, "gap": check_false}
UNDECIDED = ("assumed", "undecided")  # verdicts without a certificate


def check(certificate: dict[str, Any]) -> None:
    """Raise CertificateError unless the certificate establishes its verdict, and so do all that it is composed of."""
    whole = "composition" in certificate
    if not whole or digest_of({k: v for k, v in certificate.items() if k != "composition"}) not in ACCEPTED:
        _check_alone(certificate)
    if whole:
        try:
            _check_composition(certificate, certificate["composition"])
        except (KeyError, TypeError, ValueError, IndexError, AttributeError, RecursionError) as trouble:
            raise CertificateError(f"malformed: {type(trouble).__name__} {str(trouble)[:200]}") from None
        finally:
            Work.counts = False


def _check_alone(certificate: dict[str, Any]) -> None:
    Work.spent, Work.depth, Work.counts = 0, 0, True
    try:
        verdict, goal = certificate["verdict"], certificate["goal"]
        if certificate.get("version") not in (1, 2) or verdict not in CHECKS:
            raise CertificateError(f"version {certificate.get('version')}, {verdict}: not for this checker")
        if certificate["version"] == 2 or "goal_digest" in certificate:
            _require_digest(certificate)
        CHECKS[verdict](goal, certificate)
        for name in ("correction", "repair"):
            if name in certificate:
                check_proved(certificate[name]["goal"], certificate[name])
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, ArithmeticError, RecursionError,
            MemoryError) as trouble:
        raise CertificateError(f"malformed: {type(trouble).__name__} {str(trouble)[:200]}") from None
    finally:
        Work.counts = False


# --- a whole theorem ---------------------------------------------------------------------------------------


def _check_composition(theorem: dict[str, Any], parts: dict[str, Any]) -> None:
    """The certificates of all that a proof uses, and which of their assumptions they show for each other.

    `certificates` holds them by the numbers of their claims, `cited` the claims without one and the hypotheses that
    they name, both by the digests of their goals. A link says that an assumption of one is a relation that a premise
    of it shows; `assumes` is what no link shows. In one file a name is one quantity. What is proved: what every
    certificate assumes beyond its links, with what always holds, rates and initial values, implies what it shows.
    """
    if parts.keys() != {"certificates", "cited", "links", "assumes"}:
        raise CertificateError("a composition has certificates, cited, links and assumes")
    paper, _, top = theorem["claim"].partition(":")
    whole, spent = {**parts["certificates"], top: theorem}, 0
    if top in parts["certificates"] or theorem["verdict"] != "proved":
        raise CertificateError("a whole theorem is proved, and is no part of itself")
    for name, part in parts["certificates"].items():
        if part.get("claim") != f"{paper}:{name}" or part["verdict"] != "proved" or "composition" in part:
            raise CertificateError(f"{name[:80]} is no proof of the claim of that number")
        if digest_of(part) not in ACCEPTED:
            _check_alone(part)
            spent += Work.spent
        if spent > MOST_OF_PARTS:
            raise CertificateError(f"all parts together take more than {MOST_OF_PARTS} steps of work")
    Work.spent, Work.counts = 0, True  # of how they hang together
    uses = {name: part.get("premises", {}) for name, part in whole.items()} | parts["cited"]
    if whole.keys() & parts["cited"].keys():
        raise CertificateError("a claim is cited and proved")
    digests, below = {name: _require_digest(part) for name, part in whole.items()}, {name: set[str]() for name in whole}
    for name, premises in uses.items():
        for premise, digest in premises.items():
            if premise not in uses or digest != digests.get(premise):
                raise CertificateError(f"{name[:80]} uses {premise[:80]}, which is not there, or of another goal")
    _require_tree(top, uses)
    open_ones = {name: dict.fromkeys(range(len(part["goal"].get("assume", [])))) for name, part in whole.items()}
    for link in parts["links"]:
        name, place, premise = link["of"], link["assume"], link["by"]
        one, other = whole[name]["goal"], whole[premise]["goal"]
        text = one["assume"][place]
        names = {node.id for node in nodes(text) if isinstance(node, ast.Name)}
        if premise not in uses[name] or place not in open_ones[name] or text != other["show"][link["show"]] or calls(
                text, "D") or names & {*one.get("indexed", [])} != names & {*other.get("indexed", [])}:
            raise CertificateError(f"{name}: what it assumes is not shown by {premise}: {text[:80]}")
        del open_ones[name][place]
        below[name].add(premise)
    for name in whole:
        _require_one_motion([whole[part]["goal"] for part in sorted(_reached(name, below))])
    if parts["assumes"] != {name: [whole[name]["goal"]["assume"][i] for i in open_ones[name]] for name in whole}:
        raise CertificateError("what it assumes is not what its links leave open")


def _require_tree(top: str, uses: dict[str, dict[str, Any]]) -> None:
    """CertificateError unless all is used by what stands at the top, directly or not, and nothing by itself."""
    free = {name for name, premises in uses.items() if not premises}
    while more := {name for name, premises in uses.items() if name not in free and premises.keys() <= free}:
        spend(len(uses))
        free |= more
    if free != uses.keys() or _reached(top, {name: set(premises) for name, premises in uses.items()}) != uses.keys():
        raise CertificateError("it uses itself through its premises, or holds what it does not use")


def _reached(top: str, below: dict[str, set[str]]) -> set[str]:
    """What lies below a name, directly or not, and itself."""
    reached, waiting = {top}, [top]
    while waiting:
        new = below[waiting.pop()] - reached
        spend(1 + len(new))
        reached |= new
        waiting += new
    return reached


def _require_one_motion(goals: list[dict[str, Any]]) -> None:
    """CertificateError where a symbol moves in one of these goals otherwise than in another: no motion obeys both."""
    known: dict[tuple[str, str], str] = {}
    inputs: set[str] = set()
    for goal in goals:
        flow, free = goal.get("flow", {}), goal.get("inputs", [])
        texts = [*goal.get("assume", []), *goal["show"], *goal.get("always", []), *flow.values()]
        if flow or free:  # else it is of one instant, whatever moves
            names = {node.id for text in texts for node in nodes(text) if isinstance(node, ast.Name)} - {*free}
            moves = {("rate", name): flow.get(name, "0") for name in names | flow.keys()}
            moves |= {("start", name): start for name, start in goal.get("initial", {}).items()}
            for place, text in moves.items():
                if known.setdefault(place, text) != text:
                    raise CertificateError(f"linked certificates have different rates or initial values of {place[1]}")
            inputs.update(free)
    if moved := sorted(name for name in inputs if known.get(("rate", name)) == "0"):
        raise CertificateError(f"{moved[0]} is an input of one of two linked certificates and constant in the other")


# --- which claim a certificate is for ----------------------------------------------------------------------


def digest_of(stated: dict[str, Any]) -> str:
    """The sha256 of a statement's canonical JSON: keys sorted, no spaces, ASCII."""
    text = json.dumps(stated, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def goal_digest(certificate: dict[str, Any]) -> str:
    """The digest of claim, verdict and goal; of a violated condition its numbers too, and a correction's goal."""
    stated = {name: certificate[name] for name in ("claim", "verdict", "goal")}
    if stated["verdict"] == "violated":
        stated["point"] = certificate["point"]
    stated |= {name: certificate[name]["goal"] for name in ("correction", "repair") if name in certificate}
    return digest_of(stated)


def _require_digest(certificate: dict[str, Any]) -> str:
    """The digest that a certificate names; CertificateError where it is not that of its goal."""
    if "goal_digest" not in certificate:
        raise CertificateError("names no goal_digest: it is bound to no claim")
    if certificate["goal_digest"] != goal_digest(certificate):
        raise CertificateError("its goal_digest is not that of its claim, verdict and goal")
    return str(certificate["goal_digest"])


MANIFEST, THEOREMS = "manifest.json", "theorems"
LONGEST_NAME = 200  # of a claim, which names a file
Row = tuple[Path, str, "str | None"]
File = tuple[Path, "Manifest | None"]


def check_folder(folder: Path, checked: Callable[[list[File]], list[Row]] | None = None) -> list[Row]:
    """(file, verdict, reason it is invalid or None) for every certificate below a folder.

    A manifest.json beside them says of which paper they are, which claims that paper states, and for each its verdict,
    the digest of its goal and that of its certificate. What is missing, extra, swapped or renamed is invalid, and so is
    a certificate without a manifest: whatever it proves, nobody says of which claim. checked: who calls `check_file`
    for each file, as several processes may.
    """
    results: list[Row] = []
    manifests = {path.parent: path for path in sorted(folder.rglob(MANIFEST))}
    stated: dict[Path, Manifest] = {}
    for place, path in manifests.items():
        try:
            stated[place] = read_manifest(path)
        except CertificateError as trouble:
            results.append((path, "?", str(trouble)))
            continue
        for name, entry in stated[place].claims.items():
            if entry["certificate"] is not None and not (place / f"{name}.json").is_file():
                results.append((place / f"{name}.json", entry["verdict"], f"{MANIFEST} names it, and it is missing"))
        if all(entry["certificate"] is None for entry in stated[place].claims.values()):
            results.append((path, "?", "names no certificate"))
    files = [(path, stated.get(path.parent)) for path in sorted(folder.rglob("*.json")) if path.name != MANIFEST]
    results += checked(files) if checked else [check_file(*file) for file in files]
    for place, theorems in stated.items():
        if place.name == THEOREMS and place.parent in stated:
            results += _other_parts(place, theorems, stated[place.parent])
    circular = _circular({path for path, _, reason in results if reason is None})
    return [(path, verdict, reason or ("uses itself through its premises" if path in circular else None))
            for path, verdict, reason in results]


def _other_parts(place: Path, theorems: Manifest, paper: Manifest) -> list[Row]:
    """A row for every whole theorem that is composed of others than the certificates of its paper."""
    rows: list[Row] = []
    for name, entry in theorems.claims.items():
        path = place / f"{name}.json"
        try:
            parts = exact_json(_text(path))["composition"]
            found = {part: certificate["goal_digest"] for part, certificate in parts["certificates"].items()}
            found |= {name: entry["goal_digest"]} | dict.fromkeys(parts["cited"])
            if theorems.paper == paper.paper and all(
                    (paper.claims[part]["verdict"], paper.claims[part]["goal_digest"]) == (
                        "proved" if digest else "assumed", digest) for part, digest in found.items()):
                continue
        except (CertificateError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OSError):
            pass  # what it lacks
        rows.append((path, "proved", f"is not composed of the claims that the {MANIFEST} of its paper names"))
    return rows


def _circular(paths: set[Path]) -> set[Path]:
    """The certificates, of those that hold, that are premises of themselves, directly or not."""
    below = {path: {path.parent / f"{name}.json" for name in exact_json(_text(path)).get("premises", {})} & paths
             for path in paths}
    while leaves := {path for path, others in below.items() if not others}:  # what uses nothing is no part of a circle
        below = {path: others - leaves for path, others in below.items() if path not in leaves}
    above = {path: {other for other, others in below.items() if path in others} for path in below}
    while roots := {path for path, others in above.items() if not others}:  # nor what nothing uses
        above = {path: others - roots for path, others in above.items() if path not in roots}
    return set(above)


def check_file(path: Path, manifest: Manifest | None = None, digest: str | None = None) -> Row:
    """The same for one file, held against its manifest or the digest of its claim's goal; without both it is invalid,
    whatever it proves."""
    verdict = "?"
    try:
        text = _text(path)
        certificate = exact_json(text)
        if not isinstance(certificate, dict):
            raise CertificateError("is no certificate")
        verdict = str(certificate.get("verdict"))[:20]
        if manifest is not None:
            _require_named(certificate, hashlib.sha256(text.encode()).hexdigest(), path, manifest)
        elif digest is not None and _require_digest(certificate) != digest:
            raise CertificateError("is of another goal than the one whose digest is given")
        check(certificate)
        ACCEPTED.add(digest_of(certificate))
        if manifest is None and digest is None:
            raise CertificateError(f"holds, bound to no claim: no readable {MANIFEST} stands beside it")
    except (CertificateError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OSError) as trouble:
        return path, verdict, str(trouble)
    return path, verdict, None


def _require_named(certificate: dict[str, Any], digest: str, path: Path, manifest: Manifest) -> None:
    """CertificateError unless a certificate is the one that the manifest states under its file's name."""
    name, whole = path.stem, "composition" in certificate
    if whole != (path.parent.name == THEOREMS):  # elsewhere a composition's own parts would stand for the manifest's
        raise CertificateError(f"a whole theorem's certificate, and no other, lies in the folder {THEOREMS}")
    entry = manifest.claims.get(name)
    if entry is None or entry["certificate"] is None:
        raise CertificateError(f"{MANIFEST} names no such certificate")
    if certificate.get("claim") != f"{manifest.paper}:{name}":
        raise CertificateError(f"the certificate of {str(certificate.get('claim'))[:80]} under another claim's name")
    if certificate.get("verdict") != entry["verdict"] or _require_digest(certificate) != entry["goal_digest"]:
        raise CertificateError(f"is of another goal or verdict than {MANIFEST} states for this claim")
    if entry["certificate"] != digest:
        raise CertificateError(f"{MANIFEST} names another content for it")
    for premise, stated in certificate.get("premises", {}).items() if not whole else ():
        if premise not in manifest.claims:
            raise CertificateError(f"uses {str(premise)[:80]}, which {MANIFEST} does not name")
        if stated != manifest.claims[premise]["goal_digest"]:
            raise CertificateError(f"uses {premise} as it does not stand in {MANIFEST}: another goal or verdict")


class Manifest:
    """What a paper's claims are: verdict, goal_digest and certificate (its sha256) of each, by its number."""

    def __init__(self, paper: str, claims: dict[str, dict[str, Any]]) -> None:
        self.paper, self.claims = paper, claims


def read_manifest(path: Path) -> Manifest:
    """A manifest read and found whole; CertificateError where it is not."""
    try:
        found = exact_json(_text(path))
        if found["version"] != 2:
            raise CertificateError(f"version {str(found['version'])[:20]} binds no certificate to its claim's goal: "
                                   "run 'workbench prove' (of gains 'workbench gains') again")
        paper, claims = found["paper"], found["claims"]
        if found.keys() != {"version", "paper", "claims"} or not isinstance(paper, str) or not claims:
            raise CertificateError("is no manifest of certificates")
        for name, entry in claims.items():
            whole = entry.keys() == {"verdict", "goal_digest", "certificate"} and (
                DIGEST.fullmatch(entry["goal_digest"]) and DIGEST.fullmatch(entry["certificate"])
                if entry["verdict"] in CHECKS else
                entry["verdict"] in UNDECIDED and entry["goal_digest"] is None and entry["certificate"] is None)
            if not whole or not EQUATION.fullmatch(name) or len(name) > LONGEST_NAME:
                raise CertificateError(f"claim {name[:80]}: verdict, goal_digest and certificate do not go together")
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError, OSError):
        raise CertificateError("is no manifest of certificates") from None
    return Manifest(paper, claims)


def exact_json(text: str) -> Any:
    """JSON in which no key stands twice and every number is finite and whole."""
    return json.loads(text, object_pairs_hook=_unique, parse_constant=_no_number, parse_float=_no_number)


def _no_number(text: str) -> Any:
    raise CertificateError(f"the number {text[:40]} is not exact: certificates have whole numbers, and texts 'p/q'")


def _text(path: Path) -> str:
    """A regular file's text; a pipe would keep its reader waiting, and a device may never end."""
    if not path.is_file():
        raise CertificateError("is no regular file")
    with path.open(encoding="utf-8") as stream:
        text = stream.read(LARGEST + 1)
    if len(text) > LARGEST:
        raise CertificateError(f"is longer than {LARGEST} characters")
    return text


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object; one that names a key twice would read differently to different readers."""
    if len(dict(pairs)) != len(pairs):
        raise CertificateError("a key stands twice in one object")
    return dict(pairs)


def main() -> int:
    """Check what the command line names; 0 when all certificates hold, 1 when not, 2 when there is none."""
    place, *option = sys.argv[1:] or ["."]
    if option and not (len(option) == 2 and option[0] == "--claim-digest" and Path(place).is_file()):
        sys.stderr.write("usage: checker.py FOLDER | checker.py FILE --claim-digest SHA256\n")
        return 2
    path = Path(place)
    results = [check_file(path, None, option[1] if option else None)] if path.is_file() else check_folder(path)
    for path, verdict, reason in results:
        line = f"{'ok     ' if reason is None else 'INVALID'} {verdict:9s} {path}{': ' + reason if reason else ''}"
        # A stranger's file says what it is: nothing in it may steer the terminal.
        sys.stdout.write("".join(c if c.isprintable() else " " for c in line) + "\n")
    return 2 if not results else int(any(reason for _, _, reason in results))


if __name__ == "__main__":
    sys.exit(main())

"""What certificates can say without loss, and what is said of a goal that says more."""

from __future__ import annotations

import keyword
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.typed import evaluated

# What sympy may know of a symbol: by more it would simplify a goal into one that holds for fewer values than stated.
SYMBOLS = [sp.Symbol("x", **known).assumptions0 for known in ({}, {"real": True}, {"positive": True},
                                                              {"nonnegative": True})]
BASES = [sp.IndexedBase("x", **known).assumptions0 for known in ({}, {"real": True})]
FUNCTIONS = (sp.log, sp.exp, sp.tanh, sp.sin, sp.cos, sp.tan, sp.atan, sp.Abs, sp.sign, sp.Max, sp.Min)
LANGUAGE = ("Sum", "D", "log", "exp", "tanh", "sin", "cos", "tan", "arctan", "abs", "sign", "sqrt", "Max", "Min")
NO_NUMBERS = frozenset((sp.I, sp.zoo, sp.nan, sp.oo, -sp.oo))
CLOCK = "t"  # the name of time in plants, laws and papers
LARGEST_POWER, LARGEST_NUMBER = 64, 10**300  # of the checker; of floating point, in which points are sought


class D(sp.Function):
    """Derivative along the goal's flow, left unevaluated so that decider and checker derive it on their own."""

    nargs = 1


@dataclass(frozen=True)
class Parts:
    """What an expression has that goals ask about: its symbols by their names, ranges of its sums, and derivatives."""

    symbols: tuple[tuple[str, sp.Expr], ...]
    ranges: tuple[sp.Tuple, ...]
    derivatives: tuple[D, ...]


NOTHING = Parts((), (), ())


class Language:
    """All expressions of one goal go through one of these; ClaimError for what a certificate cannot state exactly.

    Certificates know symbols by name only and print W[j] as W, so two symbols must not share a name, and an
    index may stand only where its sum binds it. A sum runs over every number of neurons, from 1 to a symbol.
    """

    def __init__(self, flow: Mapping[sp.Expr, sp.Expr], inputs: Sequence[sp.Symbol]) -> None:
        self.names: dict[str, sp.Expr] = {}
        self.limits: sp.Tuple | None = None
        self.flow, self.inputs = flow, set(inputs)

    def check(self, expr: sp.Expr, index: sp.Symbol | None = None) -> None:
        """Raise ClaimError unless certificates can state the expression exactly, and it has a real value."""
        parts = _with_value(expr, index)
        for derivative in parts.derivatives:
            self._check_derivative(derivative)
        for limits in parts.ranges:
            if (self.limits or limits) != limits:
                raise ClaimError(f"{expr}: all sums of a goal need the same one index and range, none in another")
            self.limits = limits
        for name, owner in parts.symbols:
            self._name(name, owner)

    def check_rate(self, rate: sp.Expr, index: sp.Symbol | None = None) -> None:
        """The same for a rate, which is no derivative itself."""
        if derivatives_in(rate):
            raise ClaimError(f"the rate {rate} is given by a derivative: write the rate of each symbol out")
        self.check(rate, index)

    def check_whole(self) -> None:
        """Raise ClaimError when the index of the sums, or the number of their terms, stands elsewhere as a number."""
        for symbol in () if self.limits is None else (self.limits[0], self.limits[2]):
            if str(symbol) in self.names:
                raise ClaimError(f"'{symbol}' is the index of the goal's sums or the number of their terms, and stands "
                                 "elsewhere too: the sums hold for every number of terms, so give it another name")

    def _check_derivative(self, expr: D) -> None:
        """What D is taken of moves, and all that moves in it has a known rate."""
        inside = _carried_symbols(expr.args[0], self.flow)
        if unknown := sorted(inside & self.inputs, key=str):
            raise ClaimError(f"D({expr.args[0]}) needs the rate of the input {unknown[0]}: give it one in the flow")
        if not inside & set(self.flow):
            raise ClaimError(f"D({expr.args[0]}) is taken of what does not move: give a rate to one of its symbols in "
                             "the flow, 0 where it is meant to be constant")

    def _name(self, name: str, owner: sp.Expr) -> None:
        if self.names.get(name) is owner:
            return
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) or keyword.iskeyword(name) or name in LANGUAGE:
            if name in LANGUAGE or keyword.iskeyword(name):
                whose = "a function" if name in LANGUAGE else "one of Python's own words"
                raise ClaimError(f"symbol '{name}': is {whose}, which no symbol of a claim may be called: name it "
                                 f"otherwise, such as '{name}_0'")
            raise ClaimError(f"symbol '{name}': certificates need names of letters, digits and underscores, the first "
                             "no digit: name it otherwise")
        if self.names.setdefault(name, owner) != owner:
            raise ClaimError(f"two different symbols are named '{name}' (other assumptions, or one of them indexed): "
                             "certificates could not tell them apart; give each its own name")
        if owner.assumptions0 not in (BASES if isinstance(owner, sp.IndexedBase) else SYMBOLS):
            raise ClaimError(f"symbol '{name}': sympy knows more of it than its certificate would say; make it real, "
                             "positive or nonnegative (indexed: real) and state the rest as an assumption")


def table_of(given: object, part: str) -> dict[sp.Expr, sp.Expr]:
    """A part of a goal as a table of expressions; ClaimError for what is none."""
    if not isinstance(given, Mapping) or not all(isinstance(s, sp.Expr) for s in given):
        what = "names no symbols" if isinstance(given, Mapping) else "is no table"
        raise ClaimError(f"the part '{part}' of a goal {what}: write {{x: rate}}, no text")
    try:
        return {s: sp.sympify(value, strict=True) for s, value in given.items()}
    except sp.SympifyError:
        raise ClaimError(f"the part '{part}' of a goal has what is no expression: write {{x: -x}}") from None


def require_clock(moving: Sequence[sp.Expr], followed: Sequence[sp.Expr]) -> None:
    """ClaimError where what is followed along a flow changes with the time t, which is none of what moves."""
    names = set(map(str, moving))
    if names and CLOCK not in names and any(CLOCK in names_in(expr) for expr in followed):
        raise ClaimError(f"the time {CLOCK} stands in what is followed along the flow, which gives it no rate: add "
                         f"{CLOCK}: 1 to the flow, or call it otherwise where it is a constant")


def require_kept_signs(flow: Mapping[sp.Expr, sp.Expr], initial: Mapping[sp.Expr, sp.Expr]) -> None:
    """ClaimError where what moves from given initial values is declared with a sign that its rate need not keep: what
    is to be shown of the motion would be assumed of it."""
    for symbol, rate in flow.items() if initial else ():
        if symbol.is_nonnegative and rate != 0 and not (rate.is_number and rate.is_positive):
            declared = "positive" if symbol.is_positive else "nonnegative"
            raise ClaimError(f"{symbol} moves from given initial values and is declared {declared}, which a motion "
                             "need not stay: declare it real, and state its sign in assume or always where it is known")


# A paper's V, its rates and its errors stand in most of its goals: what is looked at once is known by its value.
@lru_cache(maxsize=8192)
def _with_value(expr: sp.Expr, index: sp.Symbol | None) -> Parts:
    """The parts of an expression that certificates can state exactly and that has a real value; ClaimError else."""
    known = not _has_no_number(expr)
    # Part by part, so that what is evaluated then has a value in every part.
    parts = _stated(expr, index) if known else NOTHING
    if not known or (expr.args and _has_no_number(evaluated(expr))):
        raise ClaimError(f"'{expr}' has no real value: it divides by zero, or takes the root or logarithm of a "
                         "negative number")
    return parts


@lru_cache(maxsize=16384)
def _stated(expr: sp.Expr, index: sp.Symbol | None) -> Parts:
    if isinstance(expr, (sp.Symbol, sp.Indexed)):
        return _of_symbol(expr, index)
    if isinstance(expr, sp.Sum):
        return _of_sum(expr, index)
    if isinstance(expr, sp.Pow) and expr.base != sp.E:
        return _of_power(expr, index)
    if isinstance(expr, (sp.Add, sp.Mul, sp.Pow, D, *FUNCTIONS)):
        parts = [_stated(part, index) for part in (expr.args[1:] if isinstance(expr, sp.Pow) else expr.args)]
        if isinstance(expr, sp.log) and evaluated(expr.args[0]).is_nonpositive:
            raise ClaimError(f"'{expr}' has no real value: the logarithm of what is never positive")
        return _joined([Parts((), (), (expr,)), *parts] if isinstance(expr, D) else parts)
    _require_number(expr)
    return NOTHING


def _joined(parts: Sequence[Parts]) -> Parts:
    if len(parts) == 1:
        return parts[0]
    return Parts(*(tuple(dict.fromkeys(one for part in parts for one in getattr(part, name)))
                   for name in ("symbols", "ranges", "derivatives")))


def _of_symbol(expr: sp.Symbol | sp.Indexed, index: sp.Symbol | None) -> Parts:
    if isinstance(expr, sp.Symbol):
        if expr == index:
            raise ClaimError(f"the index {index} stands as a number in a sum: use it as an index only")
        return Parts(((str(expr), expr),), (), ())
    if index is None or expr.indices != (index,):
        raise ClaimError(f"{expr} stands where no sum binds its index: sum over it, with one index")
    return Parts(((str(expr.base.label), expr.base),), (), ())


def _of_power(expr: sp.Pow, index: sp.Symbol | None) -> Parts:
    power = evaluated(expr.exp)
    # x/x is no exponent: that it has no value at 0 would be forgotten with it.
    if expr.exp.free_symbols or not sp.Mul(power, 2).is_Integer:
        raise ClaimError(f"'{expr}' has no meaning in certificates: only whole and half powers have")
    if abs(power) > LARGEST_POWER:
        raise ClaimError(f"the power {power} is too large: certificates have powers up to {LARGEST_POWER}")
    parts = _stated(expr.base, index)
    if power < 0 and evaluated(expr.base).is_zero:
        raise ClaimError(f"'{expr}' has no value: it divides by zero")
    if power.q == 2 and evaluated(expr.base).is_negative:
        raise ClaimError(f"'{expr}' has no real value: the root of what is negative")
    return parts


def _of_sum(expr: sp.Sum, index: sp.Symbol | None) -> Parts:
    limits = expr.limits[0]
    if len(expr.limits) != 1 or len(limits) != 3 or limits[1] != 1 or not isinstance(limits[2], sp.Symbol):
        raise ClaimError(f"'{expr}': a sum runs from 1 to a symbol, as in Sum(W[j], (j, 1, n)), for every number "
                         "of terms; write a sum of so many terms out: W_1 + W_2 + W_3")
    if index is not None:
        raise ClaimError(f"{expr}: all sums of a goal need the same one index and range, none in another")
    return _joined([Parts((), (limits,), ()), _stated(expr.function, limits[0])])


def _require_number(expr: sp.Expr) -> None:
    if isinstance(expr, sp.Float):
        raise ClaimError(f"the number {expr} is not exact: write it as sympy.Rational or Fraction")
    if isinstance(expr, sp.Rational):
        if max(abs(expr.p), expr.q) > LARGEST_NUMBER:
            raise ClaimError("a number has more than 300 digits: choose other units or smaller powers")
    elif isinstance(expr, (sp.cosh, sp.sinh)):
        raise ClaimError(f"'{expr}' is no function of certificates: write {expr.func.__name__} of "
                         "workbench.proof.claim, which is made of exp")
    elif expr not in (sp.E, sp.pi):
        raise ClaimError(f"'{expr}' has no meaning in certificates: state the claim with + - * / **, "
                         f"{', '.join(LANGUAGE[2:])}")


@lru_cache(maxsize=4096)
def derivatives_in(expr: sp.Expr) -> tuple[D, ...]:
    """The derivatives that stand in an expression."""
    return tuple(expr.atoms(D)) if expr.has(D) else ()


@lru_cache(maxsize=4096)
def has_unstated(expr: sp.Expr) -> bool:
    """Whether a function stands in an expression that certificates cannot state."""
    return any(not isinstance(part, (*FUNCTIONS, D))
               for part in expr.atoms(sp.Function, sp.Max, sp.Min, sp.Piecewise))


@lru_cache(maxsize=8192)
def symbols_in(expr: sp.Expr) -> frozenset[sp.Expr]:
    """The free symbols of an expression, indexed ones with their index; without the index and the range of sums."""
    parts = expr.atoms(sp.Indexed, sp.Sum)  # in one walk through the expression, which is all the cost
    indexed = {part for part in parts if isinstance(part, sp.Indexed)}
    sums = parts - indexed
    hidden = {s for i in indexed for s in i.free_symbols}
    hidden |= {s for total in sums for s in total.bound_symbols}
    hidden |= {s for total in sums for limit in total.limits for e in limit[1:] for s in e.free_symbols}
    return frozenset({s for s in expr.free_symbols if s not in hidden and not isinstance(s, sp.IndexedBase)} | indexed)


@lru_cache(maxsize=4096)
def names_in(expr: sp.Expr) -> frozenset[str]:
    """The names of an expression's free symbols."""
    return frozenset(map(str, expr.free_symbols))


def _has_no_number(expr: sp.Basic) -> bool:
    """Whether one of NO_NUMBERS stands in an expression; `has` would walk through it once for each."""
    waiting = [expr]
    while waiting:
        part = waiting.pop()
        if not part.args and part in NO_NUMBERS:
            return True
        waiting += part.args
    return False


def _carried_symbols(expr: sp.Expr, flow: Mapping[sp.Expr, sp.Expr]) -> set[sp.Expr]:
    """The symbols, indexed or not, of which the rates are needed to derive the expression."""
    if isinstance(expr, D):  # of a rate, those that the rate mentions
        inner = _carried_symbols(expr.args[0], flow)
        return inner.union(*(_plain_symbols(flow[s]) for s in inner if s in flow))
    if isinstance(expr, (sp.Symbol, sp.Indexed)):
        return {expr}
    parts = expr.args[:1] if isinstance(expr, sp.Sum) else expr.args
    return set().union(*(_carried_symbols(part, flow) for part in parts))


def _plain_symbols(expr: sp.Expr) -> set[sp.Expr]:
    return _carried_symbols(expr, {})


def saturation(value: Any, low: Any, high: Any) -> sp.Expr:
    """sat(value, low, high): value, cut off at low and high (low <= high)."""
    return sp.Min(sp.Max(value, low), high)


def cosh(value: Any) -> sp.Expr:
    """The hyperbolic cosine, written by exp as certificates have it."""
    return (sp.exp(value) + sp.exp(-value)) / 2


def sinh(value: Any) -> sp.Expr:
    """The hyperbolic sine, written by exp as certificates have it."""
    return (sp.exp(value) - sp.exp(-value)) / 2


def name_of(symbol: sp.Expr) -> str:
    """The name under which a symbol or an indexed symbol stands in certificates."""
    label = symbol.base.label if isinstance(symbol, sp.Indexed) else symbol
    return label.name if type(label) is sp.Symbol else str(label)  # sympy's printer takes long to say the same

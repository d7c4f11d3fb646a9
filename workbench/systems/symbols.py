"""What plants, laws and metrics ask of their symbols and expressions; every refusal is one line with its remedy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np
import sympy as sp

from workbench.compile.cases import completed
from workbench.compile.parts import free_symbols
from workbench.model.law import period, time

Limits = tuple[float, float]
# What every expression may use, and no plant or law may call its own.
CLOCK = (time, period)
NO_NUMBERS = {sp.nan, sp.zoo, sp.oo, -sp.oo}


def expression(value: Any, where: str) -> sp.Expr:
    """A real scalar expression without NaN, infinities and imaginary numbers; ValueError naming `where`."""
    if isinstance(value, float | int) and not (isinstance(value, bool) or is_finite(value)):
        raise ValueError(f"{where} is {written(value)}: give a finite number or an expression")
    try:
        found = sp.sympify(value, strict=True)
    except sp.SympifyError:
        raise ValueError(f"{where} is {written(value)}, no expression: give one of sympy, or a number") from None
    if not isinstance(found, sp.Expr) or found.is_Matrix:
        raise ValueError(f"{where} is a {type(found).__name__}, no scalar: give one expression each")
    parts = _distinct_parts(found)
    if any(_is_open(part) for part in parts):
        found = found.replace(_is_open, lambda cases: _complete(cases, where))
        parts = _distinct_parts(found)
    if parts & NO_NUMBERS:
        raise ValueError(f"{where} holds {found}, which is no number: correct the expression")
    if sp.I in parts or found.is_extended_real is False:
        raise ValueError(f"{where} is not real: {found}: state real dynamics, a complex state as two real ones")
    return found


def _distinct_parts(expr: sp.Basic) -> set[sp.Basic]:
    """All that an expression is made of, each once: a law's terms share most of theirs, which a walk over the tree
    would see thousands of times."""
    seen, left = {expr}, [expr]
    while left:
        new = set(left.pop().args) - seen
        seen |= new
        left += new
    return seen


def _is_open(expr: sp.Basic) -> bool:
    """Whether cases end without one that always holds."""
    return isinstance(expr, sp.Piecewise) and expr.args[-1].cond != sp.true


def _complete(cases: sp.Piecewise, where: str) -> sp.Expr:
    """Cases of which one always holds; ValueError naming `where` for cases that leave something open."""
    found = completed(cases)
    if found is None:
        raise ValueError(f"{where}: {cases} says nothing of what is left: end it with (value, True)")
    return found


def plain(value: Any) -> Any:
    """The float of a number that sympy holds exactly, such as pi/4; anything else as it is."""
    if isinstance(value, sp.Expr) and value.is_number and value.is_extended_real:
        return float(value)
    return value


def is_finite(value: Any) -> bool:
    """Whether a value is one finite real number that a float can hold."""
    if isinstance(value, bool) or not isinstance(value, int | float | np.number):
        return False
    try:
        return math.isfinite(value)
    except (OverflowError, TypeError):  # an int of hundreds of digits; a complex number
        return False


def written(value: Any) -> str:
    """A value in a message, as Python writes it; one with an int of thousands of digits by its type, for it refuses."""
    try:
        return repr(value)
    except ValueError:
        return f"a {type(value).__name__} of thousands of digits"


def several(values: Any, where: str, of: type | None = None, write: str = "") -> tuple[Any, ...]:
    """What was given as a list or tuple; ValueError naming `where` for a single one, for a table or set, which says no
    order, and for what is not `of` a kind.

    write: how one of them is written.
    """
    single = isinstance(values, str | sp.Basic) and not isinstance(values, sp.MatrixBase)
    if single or not isinstance(values, Iterable | sp.MatrixBase):
        raise ValueError(f"{where} is {values}, no list: write ({write or values},)")
    if isinstance(values, Mapping | set | frozenset) and values:
        kind = "table" if isinstance(values, Mapping) else "set"
        raise ValueError(f"{where} is a {kind}, and of several their order counts: write "
                         f"({write or ', '.join(map(str, values))},)")
    found = tuple(values)
    for value in found:
        if of is not None and not isinstance(value, of):
            raise ValueError(f"{where}: {value} is no {of.__name__}: write {write}")
    return found


def named_values(values: Any, where: str, symbols: Iterable[sp.Symbol] = ()) -> dict[Any, Any]:
    """A table whose keys may be symbols or their names, which become the symbols; ValueError for what is no table."""
    if not isinstance(values, Mapping):
        raise ValueError(f"{where} is {values}, no table: write {{symbol: value}}")
    by_name = {str(symbol): symbol for symbol in symbols}
    return {by_name.get(key, key) if isinstance(key, str) else key: value for key, value in values.items()}


def in_order_of(symbols: Sequence[sp.Symbol], values: Any, where: str) -> Any:
    """What a table says of each symbol, in their order; ValueError where it leaves one out or names another one. What
    is no table as it is."""
    if not isinstance(values, Mapping) or not values:
        return values
    named = named_values(values, where, symbols)
    for name in named:
        if name not in symbols:
            raise ValueError(f"{where}: '{name}' is none of {', '.join(map(str, symbols))}: leave it out")
    for symbol in symbols:
        if symbol not in named:
            raise ValueError(f"{where}: nothing is given for '{symbol}': give one for each of "
                             f"{', '.join(map(str, symbols))}")
    return tuple(named[symbol] for symbol in symbols)


def symbols_of(values: Any, where: str) -> tuple[sp.Symbol, ...]:
    """Real symbols; ValueError naming `where`."""
    found = several(values, where)
    for value in found:
        if not isinstance(value, sp.Symbol):
            raise ValueError(f"{where}: {value!r} is no symbol: write sympy.Symbol('x', real=True)")
        if value.is_extended_real is not True:
            raise ValueError(f"{where}: symbol '{value}' is not known to be real: declare it with real=True or "
                             "positive=True")
    return found


def require_distinct(groups: Mapping[str, Iterable[sp.Symbol]], where: str) -> None:
    """ValueError where a name stands for two things, or is the clock's."""
    taken: dict[str, str] = {str(symbol): "time or sampling period" for symbol in CLOCK}
    for kind, symbols in groups.items():
        for symbol in symbols:
            other = taken.setdefault(str(symbol), kind)
            if other != kind or list(map(str, symbols)).count(str(symbol)) > 1:
                what = f"{other} and {kind}" if other != kind else f"{kind}, twice"
                raise ValueError(f"{where}: '{symbol}' is a name of {what}: give each a name of its own")


def require_known(expressions: Mapping[str, sp.Expr], known: Iterable[sp.Symbol], where: str,
                  remedy: str = "make it a state, an input, a disturbance or a parameter",
                  clock: Iterable[sp.Symbol] = (time,)) -> None:
    """ValueError for the first symbol without a value; a near name, or the same with other assumptions, is told.

    clock: what else there is: time, and for a law the sampling period.
    """
    allowed = set(known) | set(clock)
    names = {str(symbol): symbol for symbol in allowed}
    for what, expr in expressions.items():
        for symbol in sorted(free_symbols(expr) - allowed, key=str):
            name = str(symbol)
            if symbol == period:
                hint = "is the sampling period, which a law alone has: make it a parameter"
            elif name in names:
                hint = "has other assumptions than the declared symbol of that name: use the same object"
            else:
                close = get_close_matches(name, names, n=1)
                hint = f"is not declared: did you mean '{close[0]}'?" if close else f"is not declared: {remedy}"
            raise ValueError(f"{where}: {what} uses '{name}', which {hint}")


def interval(limits: Any, where: str) -> Limits:
    """(lower, upper), None or infinite where there is none; ValueError where reversed or no numbers."""
    try:
        low, high = limits
        low, high = -math.inf if low is None else float(low), math.inf if high is None else float(high)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{where} = {written(limits)} is no pair of numbers: write (lower, upper)") from None
    if math.isnan(low) or math.isnan(high):
        raise ValueError(f"{where} holds NaN: write (lower, upper)")
    if low >= high:
        raise ValueError(f"{where}: the lower limit {low:g} is not below the upper limit {high:g}: exchange them")
    return low, high

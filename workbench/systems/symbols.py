"""What plants, laws and metrics ask of their symbols and expressions; every refusal is one line with its remedy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Any

import sympy as sp

from workbench.model.law import period, time

# What every expression may use, and no plant or law may call its own.
CLOCK = (time, period)


def expression(value: Any, where: str) -> sp.Expr:
    """A real scalar expression without NaN, infinities and imaginary numbers; ValueError naming `where`."""
    if isinstance(value, float | int) and not math.isfinite(value):
        raise ValueError(f"{where} is {value}: give a finite number or an expression")
    try:
        found = sp.sympify(value, strict=True)
    except sp.SympifyError:
        raise ValueError(f"{where} is {value!r}, no expression: give one of sympy, or a number") from None
    if not isinstance(found, sp.Expr):
        raise ValueError(f"{where} is a {type(found).__name__}, no scalar: give one expression each")
    if found.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
        raise ValueError(f"{where} holds {found}, which is no number: correct the expression")
    if found.has(sp.I) or found.is_extended_real is False:
        raise ValueError(f"{where} is not real: {found}: state real dynamics, a complex state as two real ones")
    return found


def symbols_of(values: Iterable[Any], where: str) -> tuple[sp.Symbol, ...]:
    """Real symbols, each with a name of its own; ValueError naming `where`."""
    found = tuple(values)
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


def require_known(expressions: Mapping[str, sp.Expr], known: Iterable[sp.Symbol], where: str) -> None:
    """ValueError for the first symbol without a value; a near name, or the same with other assumptions, is told."""
    allowed = set(known) | set(CLOCK)
    names = {str(symbol): symbol for symbol in allowed}
    for what, expr in expressions.items():
        for symbol in sorted(expr.free_symbols - allowed, key=str):
            name = str(symbol)
            if name in names:
                hint = "has other assumptions than the declared symbol of that name: use the same object"
            else:
                close = get_close_matches(name, names, n=1)
                hint = f"is not declared: did you mean '{close[0]}'?" if close else (
                    "is not declared: make it a state, an input, a disturbance or a parameter")
            raise ValueError(f"{where}: {what} uses '{name}', which {hint}")


def interval(limits: Any, where: str) -> tuple[float, float]:
    """(lower, upper), infinities allowed; ValueError where reversed or no numbers."""
    try:
        low, high = (float(value) for value in limits)
    except (TypeError, ValueError):
        raise ValueError(f"{where} = {limits!r} is no pair of numbers: write (lower, upper)") from None
    if math.isnan(low) or math.isnan(high):
        raise ValueError(f"{where} holds NaN: write (lower, upper)")
    if low >= high:
        raise ValueError(f"{where}: the lower limit {low:g} is not below the upper limit {high:g}: exchange them")
    return low, high

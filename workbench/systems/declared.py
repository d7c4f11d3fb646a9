"""What symbols declare of their values: sympy simplifies by it, |h| to h, so that a run has to keep it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import sympy as sp

from workbench.systems.symbols import Limits

ROUNDING = 1e-9  # up to here a state on the wrong side of zero is one at zero
KINDS: Mapping[str, Callable[[float], bool]] = {
    "positive": lambda value: value > 0, "negative": lambda value: value < 0,
    "nonnegative": lambda value: value >= 0, "nonpositive": lambda value: value <= 0,
    "nonzero": lambda value: value != 0, "integer": lambda value: value == int(value)}


def contradicted(symbol: sp.Symbol, value: float) -> str:
    """What the symbol is declared that a finite number is not, as "positive"; empty where it may have it."""
    return next((kind for kind, holds in KINDS.items() if getattr(symbol, f"is_{kind}") and not holds(value)), "")


def _sides(symbols: Iterable[sp.Symbol]) -> list[tuple[sp.Symbol, int]]:
    return [(s, 1 if s.is_nonnegative else -1) for s in symbols if s.is_nonnegative or s.is_nonpositive]


def sign_margins(symbols: Iterable[sp.Symbol]) -> tuple[sp.Expr, ...]:
    """An expression a symbol with a sign, positive as long as its value has that sign or is zero."""
    return tuple(ROUNDING + side * symbol for symbol, side in _sides(symbols))


def signs_told(symbols: Iterable[sp.Symbol]) -> list[str]:
    """The same in words."""
    return [f"{symbol} {'>' if side > 0 else '<'}= 0, as its symbol is declared" for symbol, side in _sides(symbols)]


def require_signs_kept(limits: Mapping[sp.Symbol, Limits], inputs: Iterable[sp.Symbol], where: str) -> None:
    """ValueError for an input with a sign that its limits do not keep."""
    for symbol, side in _sides(inputs):
        low, high = limits.get(symbol, (-sp.oo, sp.oo))
        if low < 0 if side > 0 else high > 0:
            raise ValueError(f"{where}: input '{symbol}' is declared {'positive' if side > 0 else 'negative'} or zero, "
                             "which its limits do not keep: give input_limits that do, or declare it with real=True")


def require_no_whole(symbols: Iterable[sp.Symbol], where: str) -> None:
    """ValueError for a symbol that is declared to be whole, of what moves."""
    for symbol in symbols:
        if symbol.is_integer:
            raise ValueError(f"{where}: '{symbol}' is declared integer, and nothing keeps it whole: declare it with "
                             "real=True")


def require_outputs_signed(outputs: Mapping[sp.Symbol, sp.Expr], where: str) -> None:
    """ValueError for an output with a sign that its expression is not known to have."""
    for symbol, value in outputs.items():
        for kind in ("nonnegative", "nonpositive"):
            if getattr(symbol, f"is_{kind}") and not getattr(value, f"is_{kind}"):
                raise ValueError(f"{where}: output '{symbol}' is declared to be {kind}, and {value} is not known to "
                                 "be: declare it with real=True, or what it is made of with the sign")

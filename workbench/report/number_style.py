"""Numbers as a reader would write them, and all numbers of one example in the same way: decimals, or fractions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Literal

# exact: decimals where they are short, else fractions; fraction: no decimals; decimal: no fractions.
Style = Literal["exact", "fraction", "decimal"]
LONGEST_FRACTION = 6  # digits above or below a fraction bar, beyond which a reader is given a decimal
_INDICES = re.compile(r"_\{([^{}]*)\}")
_WORD, _UPRIGHT = re.compile(r"(?<![\\A-Za-z])[A-Za-z]{2,}"), r"\\mathrm{\g<0>}"
_FRACTION = re.compile(r"\\frac\{(\d+)\}\{(\d+)\}")


def style_of(values: Iterable[Fraction]) -> Style:
    """How all of these can be written alike: exactly as decimals, else exactly as fractions, else rounded."""
    broken = [value for value in values if value.denominator != 1]
    if all(_decimal(value) is not None for value in broken):
        return "decimal"
    return "fraction" if all(map(_short, broken)) else "decimal"


def value_latex(value: Fraction, style: Style = "exact") -> str:
    """A number as a reader would write it: whole, decimal where that is short and exact, a fraction, or with an
    'about' in front where its digits are too many, or where it is no decimal and shall be one."""
    decimal = None if style == "fraction" and value.denominator != 1 and _short(value) else _decimal(value)
    if decimal is not None:
        return decimal
    if style != "decimal" and _short(value):
        return rf"{'-' if value < 0 else ''}\frac{{{abs(value.numerator)}}}{{{value.denominator}}}"
    return rf"\approx {_scientific(f'{float(value):.4g}')}"


def told_apart(values: Mapping[str, Fraction], style: Style = "exact") -> dict[str, str]:
    """Numbers by their names as `value_latex` writes them, rounded ones so far that what differs looks so."""
    found = {name: value_latex(value, style) for name, value in values.items()}
    for digits in (7, 10, 15):
        same = [name for name, text in found.items() if r"\approx" in text
                and any(found[other] == text and values[other] != values[name] for other in values)]
        found |= {name: rf"\approx {_scientific(f'{float(values[name]):.{digits}g}')}" for name in same}
    return found


def alike(latex: str) -> str:
    """A formula whose fractions of numbers are decimals where all of them can be, exactly."""
    values = [Fraction(int(above), int(below)) for above, below in _FRACTION.findall(latex) if int(below)]
    if not values or any(_decimal(value) is None for value in values):
        return latex
    return _FRACTION.sub(lambda found: value_latex(Fraction(int(found[1]), int(found[2]))), latex)


def _short(value: Fraction) -> bool:
    return max(len(str(abs(value.numerator))), len(str(value.denominator))) <= LONGEST_FRACTION


def _decimal(value: Fraction) -> str | None:
    """A whole number or a decimal with few digits, exactly; else None."""
    if value.denominator == 1 and abs(value) < 10**6:
        return str(value.numerator)
    digits = f"{float(value):.6g}" if abs(value) < 10**30 else ""
    if not digits or Fraction(digits) != value:
        return None
    telling = digits.partition("e")[0].lstrip("-").replace(".", "").lstrip("0")
    short = len(telling) <= 4 or value.denominator > 1000
    return _scientific(digits) if short else None


def _scientific(digits: str) -> str:
    mantissa, e, exponent = digits.partition("e")
    if not e:
        return digits
    power = rf"10^{{{int(exponent)}}}"
    return power if mantissa == "1" else rf"{mantissa} \times {power}"


def upright(latex: str) -> str:
    """A formula with the words among its indices upright: T_{min} is no product."""
    return _INDICES.sub(lambda found: f"_{{{_WORD.sub(_UPRIGHT, found[1])}}}", latex)

"""Numbers as a reader wants them: sensible digits, a true minus sign, never a NaN."""

from __future__ import annotations

import math
import re

NOTHING = "—"
_EQUAL_TO = re.compile(r"(?<== )(-?\d+(?:\.\d+)?)(?:e([+-]\d+))?(?![\w.])")
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
THIN_SPACE = "\u202f"


def number(value: float | None, digits: int = 3) -> str:
    """A number with `digits` significant digits; a dash for None and whatever is not finite.

    Tiny and huge numbers are written with a power of ten; integers are written out.
    """
    if value is None or not math.isfinite(value):
        return NOTHING
    if value == 0:
        return "0"
    if isinstance(value, int):
        return grouped(str(value))
    rounded = float(f"{value:.{digits - 1}e}")
    exponent = math.floor(math.log10(abs(rounded)))
    if not -4 <= exponent < 7:
        return _scientific(f"{rounded / 10.0**exponent:.{digits - 1}f}", exponent)
    return grouped(f"{rounded:.{max(0, digits - 1 - exponent)}f}")


def counted(count: int, what: str) -> str:
    """A number of things that are named by one word: 1 run, 16 runs."""
    return f"{count} {what}{'' if count == 1 else 's'}"


def exact(value: float) -> str:
    """A number that somebody wrote down, with the digits it has."""
    if not math.isfinite(value):
        return NOTHING if math.isnan(value) else "∞" if value > 0 else "−∞"
    mantissa, e, exponent = f"{value:.12g}".partition("e")
    return _scientific(mantissa, int(exponent)) if e else grouped(mantissa)


def fixed(value: float | None, decimals: int) -> str:
    """A number with so many decimals; a dash for None and whatever is not finite."""
    if value is None or not math.isfinite(value):
        return NOTHING
    text = f"{value:.{decimals}f}"
    return grouped(text.removeprefix("-") if float(text) == 0 else text)


def grouped(text: str) -> str:
    """Digits of a number in groups of three before the point, with a true minus sign."""
    sign, digits = ("−", text[1:]) if text.startswith("-") else ("", text)
    whole, point, rest = digits.partition(".")
    if len(whole) > 4:
        whole = f"{int(whole):,}".replace(",", THIN_SPACE)
    return sign + whole + point + rest


def length(value_m: float | None, digits: int = 3) -> str:
    """A length in m with its unit, in mm below 1 m, with a power of ten below a micrometre."""
    if value_m is None or not math.isfinite(value_m):
        return NOTHING
    return f"{number(value_m, digits)} m" if abs(value_m) >= 1 else f"{number(value_m * 1e3, digits)} mm"


def typeset(text: str) -> str:
    """A message with the numbers behind its signs of equality as a page has them: `v = -1.5e+06` is v = −1.5 × 10⁶."""
    return _EQUAL_TO.sub(lambda n: _scientific(n[1], int(n[2])) if n[2] else grouped(n[1]), text)


def _scientific(mantissa: str, exponent: int) -> str:
    power = str(exponent).translate(_SUPERSCRIPT)
    return f"{mantissa.replace('-', '−')}{THIN_SPACE}×{THIN_SPACE}10{power}"


def unit_text(unit: str) -> str:
    """A unit as it is printed: `m/s^2` is m/s², `kg m^-3` is kg m⁻³."""
    return re.sub(r"\^(-?\d+)", lambda power: power[1].translate(_SUPERSCRIPT), unit)

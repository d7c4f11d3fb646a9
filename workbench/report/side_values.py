"""The values of both sides of a line as a reader would write them: exact where they are short, else rounded."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from workbench.proof.checker import ONE, Context, Ratio
from workbench.report.number_style import Style, value_latex

LARGEST = 99  # above and below the bar of the numbers in a closed form
Enclosed = tuple[Fraction, Fraction]


def closed_form(context: Context, value: Ratio, style: Style) -> str | None:
    """A number times one exponential or logarithm of a number as LaTeX; None for anything else, or where it is long."""
    if value.den is not ONE or len(value.num) != 1:
        return None
    ((monomial, coefficient),) = value.num.items()
    if len(monomial) != 1:
        return None
    ((atom, power),) = monomial
    kind, argument = context.functions.get(atom, ("", value))
    inside = argument.constant()
    if kind not in ("exp", "log") or inside is None or (kind == "log" and power != 1):
        return None
    of, times_of = Fraction(inside) * (power if kind == "exp" else 1), abs(Fraction(coefficient))
    if max(abs(of.numerator), of.denominator, times_of.numerator, times_of.denominator) > LARGEST:
        return None
    written, times = value_latex(of, style), value_latex(times_of, style)
    if r"\approx" in written + times:
        return None
    function = rf"e^{{{written}}}" if kind == "exp" else rf"\ln\left({written}\right)"
    sign = "-" if coefficient < 0 else ""
    return f"{sign}{function}" if times == "1" else f"{sign}{times} {function}"


def shown_values(found: list[Enclosed] | None, style: Style, closed: Sequence[str | None] = ()) -> tuple[
        str | None, str | None]:
    """Both sides at the point: exact where they are rational and short or told in closed form, else rounded so far that
    they differ."""
    if found is None:
        return None, None
    numbers = [(low + high) / 2 for low, high in found]
    exact = [low == high for low, high in found]
    for digits in (6, 10, 15):
        left, right = (value_latex(n, style) if is_exact else rounded(n, digits)
                       for n, is_exact in zip(numbers, exact, strict=True))
        if left.removeprefix(r"\approx ") != right.removeprefix(r"\approx ") or numbers[0] == numbers[1]:
            break
        if r"\approx" in left:
            exact = [False, False]
    told = [form if form and r"\approx" in text else text
            for text, form in zip((left, right), closed or (None, None), strict=True)]
    return told[0], told[1]


def rounded(value: Fraction, digits: int) -> str:
    """A number to so many digits, with an 'about' in front."""
    mantissa, e, exponent = f"{float(value):.{digits}g}".partition("e")
    return rf"\approx {mantissa}" + (rf" \times 10^{{{int(exponent)}}}" if e else "")

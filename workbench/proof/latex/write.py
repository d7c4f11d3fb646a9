"""Expressions and relations as LaTeX, such that reading it gives them back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE

from workbench.proof.latex.letters import latex_name


def latex(expr: sp.Expr, letters: Mapping[str, str] | None = None) -> str:
    """LaTeX of an expression; accents and indices come from names such as a_tilde_1, a derivative along the flow is
    d/dt.

    letters: LaTeX of names, by default that of the expression's own.
    """
    return str(_Printer(letters_of([expr]) if letters is None else letters).doprint(expr))


def letters_of(exprs: Iterable[sp.Expr]) -> dict[str, str]:
    """LaTeX for the name of each symbol in some expressions, no two alike."""
    names = {name for expr in exprs for name in _names(expr)}
    found: dict[str, str] = {}
    for name in sorted(names):
        typed = latex_name(name)
        found[name] = rf"\mathrm{{{name.replace('_', ' ')}}}" if typed in found.values() else typed
    return found


def _names(expr: sp.Expr) -> set[str]:
    bases = {str(found.base.label) for found in expr.atoms(sp.Indexed)}
    hidden = {str(symbol) for found in expr.atoms(sp.Indexed) for symbol in found.base.free_symbols - {found.base}}
    return bases | {str(s) for s in expr.atoms(sp.Symbol) if str(s) not in hidden - bases}


def _parts(expr: sp.Expr, kind: type[sp.Expr]) -> tuple[sp.Expr, ...]:
    """The terms of a sum, or factors of a product, those of sums or products within it among them."""
    return tuple(part for arg in expr.args for part in (_parts(arg, kind) if isinstance(arg, kind) else (arg,)))


def _in_one_row(product: sp.Mul) -> sp.Expr:
    """A product of products as one product, its numbers gathered in front."""
    parts = _parts(product, sp.Mul)
    number = sp.prod(part for part in parts if part.is_Rational)
    others = [part for part in parts if not part.is_Rational]
    return sp.Mul(*([] if number == 1 and others else [number]), *others, evaluate=False)


class _Printer(LatexPrinter):
    """sympy's own LaTeX, with letters by their names and brackets wherever a reader could be in doubt."""

    printmethod = "_workbench_latex"  # sympy classes would print themselves otherwise

    def __init__(self, letters: Mapping[str, str]) -> None:
        super().__init__({"fold_func_brackets": False, "ln_notation": True})
        self.letters = letters

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        return self.letters.get(str(expr)) or latex_name(str(expr))

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        name = str(expr.base.label)
        letter = self.letters.get(name) or latex_name(name)
        index = ",".join(str(self._print(index)) for index in expr.indices)
        stem, mark = (letter[:-4], "^{*}") if letter.endswith("^{*}") else (letter, "")
        if stem.endswith("}") and "_{" in stem:
            return f"{stem[:-1]},{index}}}{mark}"
        return f"{stem}_{{{index}}}{mark}"

    def _helper_print_standard_power(self, expr: sp.Pow, template: str) -> str:
        """A power of what has a mark above it is written with brackets: TeX takes no second exponent."""
        if isinstance(expr.base, sp.Indexed) and "^" in (base := str(self._print(expr.base))):
            return template % (rf"\left({base}\right)", self._print(expr.exp))
        return str(super()._helper_print_standard_power(expr, template))

    def _as_ordered_terms(self, expr: sp.Expr, order: str | None = None) -> list[sp.Expr]:
        """A sum begins with a term that has no minus before it, where there is one."""
        terms = list(super()._as_ordered_terms(expr, order))
        first = next((i for i, term in enumerate(terms) if not term.could_extract_minus_sign()), 0)
        return [terms[first], *terms[:first], *terms[first + 1:]]

    def _print_Mul(self, expr: sp.Expr) -> str:
        """A product as typed in one row: sympy loses a minus that a product within it begins with; or a fraction."""
        return str(super()._print_Mul(_in_one_row(expr) if isinstance(expr, sp.Mul) else expr))

    def _print_Add(self, expr: sp.Add, order: str | None = None) -> str:
        terms = tuple(_in_one_row(term) if isinstance(term, sp.Mul) else term for term in _parts(expr, sp.Add))
        return str(super()._print_Add(sp.Add(*terms, evaluate=False), order))

    def _print_D(self, expr: sp.Expr, exp: str | None = None) -> str:
        inner = rf"\frac{{d}}{{dt}}\left[{self._print(expr.args[0])}\right]"
        return inner if exp is None else rf"\left({inner}\right)^{{{exp}}}"

    def _print_ExpBase(self, expr: sp.Expr, exp: str | None = None) -> str:
        if "e" in self.letters.values():
            return self._applied(r"\exp", expr, exp)
        inner = f"e^{{{self._print(expr.args[0])}}}"
        return inner if exp is None else rf"\left({inner}\right)^{{{exp}}}"

    _print_exp = _print_ExpBase

    def _print_Exp1(self, expr: sp.Expr, exp: str | None = None) -> str:
        return r"\exp\left(1\right)" if exp is None else rf"\left(\exp\left(1\right)\right)^{{{exp}}}"

    def _print_sign(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\operatorname{sgn}", expr, exp)

    def _print_log(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\ln", expr, exp)

    def _print_tanh(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\tanh", expr, exp)

    def _print_sin(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\sin", expr, exp)

    def _print_cos(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\cos", expr, exp)

    def _print_tan(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\tan", expr, exp)

    def _print_atan(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\arctan", expr, exp)

    def _print_Max(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\max", expr, exp)

    def _print_Min(self, expr: sp.Expr, exp: str | None = None) -> str:
        return self._applied(r"\min", expr, exp)

    def _applied(self, name: str, expr: sp.Expr, exp: str | None) -> str:
        arguments = ", ".join(str(self._print(part)) for part in sorted(expr.args, key=sp.default_sort_key))
        call = rf"{name}\left({arguments}\right)"
        return call if exp is None else rf"\left({call}\right)^{{{exp}}}"

    def _print_Abs(self, expr: sp.Expr, exp: str | None = None) -> str:
        inner = rf"\left|{self._print(expr.args[0])}\right|"
        return inner if exp is None else f"{inner}^{{{exp}}}"

    def _print_Sum(self, expr: sp.Sum) -> str:
        index, first, last = expr.limits[0]
        body = self.parenthesize(expr.function, PRECEDENCE["Mul"])
        return rf"\sum_{{{self._print(index)}={self._print(first)}}}^{{{self._print(last)}}} {body}"

    def _needs_mul_brackets(self, expr: Any, first: bool = False, last: bool = False) -> bool:
        """Whether a factor takes brackets: what would swallow the factors behind it does, in any place."""
        if expr.func.__name__ == "D" or isinstance(expr, sp.Sum):
            return True
        return bool(super()._needs_mul_brackets(expr, first, last))

    def parenthesize(self, item: Any, level: int, is_neg: bool = False, strict: bool = False) -> str:
        """An operand, in brackets where it binds less than what it stands in."""
        text = super().parenthesize(item, level, is_neg, strict)
        swallows = isinstance(item, sp.Sum) or item.func.__name__ == "D"
        if swallows and level > PRECEDENCE["Add"] and not text.startswith((r"\left(", "(")):
            return rf"\left({text}\right)"
        return str(text)

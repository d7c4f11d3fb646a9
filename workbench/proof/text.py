"""Goals as text in the certificate language, which `checker.py` reads on its own."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, name_of

NAMES = {"log": "log", "exp": "exp", "D": "D", "tanh": "tanh", "Abs": "abs", "Size": "abs", "sign": "sign",
         "Side": "sign", "Summed": "Sum", "Max": "Max", "Min": "Min"}


class _Printer(StrPrinter):
    """Python syntax over + - * / **, the functions of certificates, Sum and D."""

    printmethod = "_certificate_text"  # sympy classes would print themselves otherwise

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        return name_of(expr)

    def _print_Sum(self, expr: sp.Sum) -> str:
        return f"Sum({self._print(expr.function)})"

    def _print_Function(self, expr: sp.Function) -> str:
        name = expr.func.__name__
        if name not in NAMES:
            known = ", ".join(dict.fromkeys(NAMES.values()))
            raise ClaimError(f"'{name}' has no meaning in certificates: state the claim with {known}")
        arguments = sorted(map(self._print, expr.args)) if name in ("Max", "Min") else map(self._print, expr.args)
        return f"{NAMES[name]}({', '.join(arguments)})"

    _print_Max = _print_Min = _print_Abs = _print_Function

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        if expr.exp.is_Rational and expr.exp.q == 2:
            root = f"sqrt({self._print(expr.base)})"
            return root if expr.exp.p == 1 else f"1/{root}" if expr.exp.p == -1 else f"{root}**({expr.exp.p})"
        return str(super()._print_Pow(expr, rational))

    def _print_Exp1(self, expr: sp.Expr) -> str:
        return "exp(1)"


_printer = _Printer({"order": "lex"})


def text(expr: sp.Expr) -> str:
    """An expression in the certificate language."""
    return str(_printer.doprint(expr))


def relation_text(relation: Relation) -> str:
    """A relation in the certificate language."""
    return f"{text(relation.left)} {relation.operator} {text(relation.right)}"


def assumptions(goal: Goal) -> tuple[Relation, ...]:
    """The goal's assumptions in the order of its certificate: signs of symbols first, then as stated."""
    return (*goal.signs(), *goal.assume)


def goal_text(goal: Goal) -> dict[str, Any]:
    """The goal as it stands in a certificate."""
    record: dict[str, Any] = {
        "assume": [relation_text(r) for r in assumptions(goal)],
        "show": [relation_text(r) for r in goal.show],
    }
    indexed = sorted({name_of(s) for s in goal.symbols() if isinstance(s, sp.Indexed)})
    if indexed:
        record["indexed"] = indexed
    if goal.flow:
        record["flow"] = {name_of(s): text(rate) for s, rate in goal.flow.items()}
    if goal.always:
        record["always"] = [relation_text(r) for r in goal.always]
    if goal.initial:
        record["initial"] = {name_of(s): text(value) for s, value in goal.initial.items()}
    if goal.eventually is not None:
        record["eventually"] = name_of(goal.eventually)
    return record

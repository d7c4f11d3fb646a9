"""Goals as text in the certificate language, which `checker.py` reads on its own."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, name_of

KNOWN_FUNCTIONS = ("log", "exp", "D")


class _Printer(StrPrinter):
    """Python syntax over + - * / **, log, exp, Sum and D."""

    printmethod = "_certificate_text"  # sympy classes would print themselves otherwise

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        return name_of(expr)

    def _print_Sum(self, expr: sp.Sum) -> str:
        return f"Sum({self._print(expr.function)})"

    def _print_Function(self, expr: sp.Function) -> str:
        name = expr.func.__name__
        if name not in KNOWN_FUNCTIONS:
            raise ClaimError(f"'{name}' has no meaning in certificates: state the claim with log and exp")
        return f"{name}({self._print(expr.args[0])})"

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

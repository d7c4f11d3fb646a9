"""Cases of which one always holds, without which compiled code has no number to give."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.errors import CompileError


def completed(cases: sp.Piecewise) -> sp.Piecewise | None:
    """The same cases, the last of which holds otherwise; None where they leave something open."""
    if sp.Or(*(one.cond for one in cases.args)) != sp.true:
        return None
    return sp.Piecewise(*cases.args[:-1], (cases.args[-1].expr, True))


def numbers_of(exprs: Sequence[sp.Expr]) -> list[sp.Expr]:
    """The expressions with their cases completed; CompileError for cases that leave something open, and for what is
    not carried out."""
    return [_number(expr) for expr in exprs]


def _number(expr: sp.Expr) -> sp.Expr:
    if expr.has(sp.Derivative, sp.Integral):
        raise CompileError(f"{expr}: derivatives and integrals cannot be compiled: carry them out")
    if not expr.has(sp.Piecewise):
        return expr
    return expr.replace(lambda e: isinstance(e, sp.Piecewise) and e.args[-1].cond != sp.true, _required)


def _required(cases: sp.Piecewise) -> sp.Piecewise:
    found = completed(cases)
    if found is None:
        raise CompileError(f"{cases} says nothing of what is left: end it with (value, True)")
    return found

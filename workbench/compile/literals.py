"""Numbers as they stand in generated code."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from workbench.errors import CompileError

LARGEST = 2**64  # of whole numbers that compiled code knows


def require_short(exprs: Iterable[sp.Expr]) -> None:
    """CompileError where an expression has a whole number, or a fraction of such, that compiled code cannot hold, or
    what is no real number."""
    for expr in exprs:
        if expr.has(sp.I, sp.nan, sp.zoo):
            raise CompileError(f"{str(expr)[:80]} is no real number: correct the expression")
        for number in expr.atoms(sp.Rational):
            if max(abs(int(number.p)), int(number.q)) >= LARGEST:
                raise CompileError("a whole number, or one in a fraction, is beyond 64 bits: state it as a float")

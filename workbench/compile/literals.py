"""Numbers as they stand in generated code."""

from __future__ import annotations

import math
from collections.abc import Iterable

import sympy as sp

from workbench.errors import CompileError

LARGEST = 2**64  # of whole numbers that compiled code knows
# Of numbers that a variable is raised to: beyond it a float is 0 or infinite for all but arguments next to 1, of which
# solvers that MPC uses may come to no end.
LARGEST_POWER = 10_000


def require_short(exprs: Iterable[sp.Expr]) -> None:
    """CompileError where an expression has a whole number, or a fraction of such, that compiled code cannot hold, a
    power beyond LARGEST_POWER, a number that no float holds, or what is no real number."""
    for expr in exprs:
        if expr.has(sp.I, sp.nan, sp.zoo):
            raise CompileError(f"{str(expr)[:80]} is no real number: correct the expression")
        for number in expr.atoms(sp.Rational):
            if max(abs(int(number.p)), int(number.q)) >= LARGEST:
                raise CompileError("a whole number, or one in a fraction, is beyond 64 bits: state it as a float")
        for number in expr.atoms(sp.Float):
            if not math.isfinite(float(number)) or (number != 0) != (float(number) != 0):
                raise CompileError(f"{str(number)[:80]} is a number that no float holds: correct it")
        for power in expr.atoms(sp.Pow):
            if power.exp.is_number and abs(power.exp) > LARGEST_POWER and not power.base.is_number:
                raise CompileError(f"{str(power)[:80]} has an exponent beyond {LARGEST_POWER}: correct it")

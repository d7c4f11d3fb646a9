"""Numbers as they stand in generated code."""

from __future__ import annotations

import math
from collections.abc import Iterable

import sympy as sp

from workbench.compile.parts import parts
from workbench.errors import CompileError

LARGEST = 2**64  # of whole numbers that compiled code knows
# Of numbers that a variable is raised to: beyond it a float is 0 or infinite for all but arguments next to 1, of which
# solvers that MPC uses may come to no end.
LARGEST_POWER = 10_000


def require_short(exprs: Iterable[sp.Expr]) -> None:
    """CompileError where an expression has a whole number, or a fraction of such, that compiled code cannot hold, a
    power beyond LARGEST_POWER, a number that no float holds, or what is no real number."""
    for expr in exprs:
        found = parts(expr)
        if not {sp.I, sp.nan, sp.zoo}.isdisjoint(found):
            raise CompileError(f"{str(expr)[:80]} is no real number: correct the expression")
        for part in found:
            if isinstance(part, sp.Rational) and max(abs(int(part.p)), int(part.q)) >= LARGEST:
                raise CompileError("a whole number, or one in a fraction, is beyond 64 bits: state it as a float")
            if isinstance(part, sp.Float) and (not math.isfinite(float(part)) or (part != 0) != (float(part) != 0)):
                raise CompileError(f"{str(part)[:80]} is a number that no float holds: correct it")
        for part in found:  # whose exponents are numbers that it holds
            if (isinstance(part, sp.Pow) and part.exp.is_number and abs(part.exp) > LARGEST_POWER
                    and not part.base.is_number):
                raise CompileError(f"{str(part)[:80]} has an exponent beyond {LARGEST_POWER}: correct it")

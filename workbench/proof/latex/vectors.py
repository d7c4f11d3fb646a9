"""Vectors as indexed symbols: what a product of a row and a column, a norm, a trace and a sum stand for."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.proof.latex.error import LatexError


def is_vector(expr: sp.Expr) -> bool:
    """Whether an expression has an index that no sum binds."""
    if isinstance(expr, sp.Sum) or not expr.has(sp.Indexed):
        return False
    return isinstance(expr, sp.Indexed) or any(is_vector(part) for part in expr.args if isinstance(part, sp.Expr))


def summed(summand: sp.Expr, limits: sp.Tuple | None, position: int) -> sp.Expr:
    """The sum of an indexed expression over the limits of the goal; LatexError when there are none that fit."""
    if limits is None:
        raise LatexError("a product of vectors, but the goal has no sum: write the sum with its limits", position)
    indices = {index for found in summand.atoms(sp.Indexed) for index in found.indices}
    if indices != {limits[0]}:
        raise LatexError(f"the vectors' index is {', '.join(sorted(map(str, indices)))}, but the goal sums over "
                         f"{limits[0]}: correct the notation", position)
    return sp.Sum(summand, limits)


def multiplied(factors: Sequence[tuple[sp.Expr, bool]], limits: sp.Tuple | None, position: int,
               columns: bool = False) -> sp.Expr:
    """The product of factors, each with whether it is transposed: a row and the columns after it make a sum.

    columns: whether all vectors are columns, so that a row takes one of them; else all but the last are diagonal.
    """
    outside: list[sp.Expr] = []
    row: list[sp.Expr] | None = None

    def close() -> None:
        if row is not None and len(row) == 1:
            raise LatexError("a transposed vector stands without a vector after it: correct the line", position)
        if row is not None and len(row) > 2 and columns:
            raise LatexError("a row and two columns side by side: put brackets around the product that is a number",
                             position)
        if row is not None:
            outside.append(summed(sp.Mul(*row), limits, position))

    for value, transposed in factors:
        if transposed:
            if not is_vector(value):
                raise LatexError(f"{value} is transposed, but is no vector: give the whole product in the notation, or "
                                 "an indexed symbol", position)
            close()
            row = [value]
        elif row is not None and is_vector(value):
            row.append(value)
        else:
            outside.append(value)
    close()
    if columns and sum(map(is_vector, outside)) > 1:
        raise LatexError("two columns side by side: write one of them as a row, or a sum over their index", position)
    return sp.Mul(*outside)


NORMS = ("||", "||_2", "||_1")


def norm(bars: str, value: sp.Expr, limits: sp.Tuple | None, position: int) -> sp.Expr:
    """A norm of a vector: the Euclidean one, or with the index 1 the sum of its components' sizes."""
    if bars not in NORMS:
        raise LatexError(f"the norm '{bars}' has no meaning in goals: give the piece in the notation", position)
    if not is_vector(value):
        raise LatexError(f"the norm of {value}, which is no vector: give the norm in the notation, or an indexed "
                         "symbol", position)
    return summed(sp.Abs(value), limits, position) if bars == "||_1" else sp.sqrt(summed(value**2, limits, position))


def trace(value: sp.Expr, limits: sp.Tuple | None, position: int, columns: bool = False) -> sp.Expr:
    """The trace of a diagonal matrix, whose entries are an indexed symbol; columns: whether there are no matrices."""
    if columns or not is_vector(value):
        raise LatexError(f"the trace of {value}, which is no matrix: give the trace in the notation, or an indexed "
                         "symbol", position)
    return summed(value, limits, position)

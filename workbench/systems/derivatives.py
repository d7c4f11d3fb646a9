"""Derivatives of a plant's expressions at a point, refused where the expression has none there."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import sympy as sp
from numpy.typing import NDArray


def smooth_at(derivative: sp.Expr, point: Mapping[sp.Basic, sp.Expr]) -> sp.Expr:
    """A derivative with the point put in; ValueError where a sign, a step or a border of cases leaves none there.

    point: values of some or all of the symbols.
    """
    if derivative.has(sp.Derivative, sp.Subs):
        names = sorted({one.expr.func.__name__ for one in derivative.atoms(sp.Derivative)} or {"an expression"})
        raise ValueError(f"{names[0]} has no derivative: state the plant without it")
    jumps = {one: sp.Dummy() for one in derivative.atoms(sp.sign, sp.Heaviside, sp.DiracDelta)
             if one.args[0].xreplace(point).is_zero}
    borders = {one: sp.Dummy() for one in derivative.atoms(sp.Piecewise)
               if any((side.lhs - side.rhs).xreplace(point).is_zero for _, when in one.args
                      for side in when.atoms(sp.core.relational.Relational))}
    kinks = {**jumps, **borders}
    here = derivative.xreplace(kinks).xreplace(point)
    if here.free_symbols & set(kinks.values()):
        raise ValueError(f"has a kink at that point, in {derivative}: linearise it elsewhere")
    return here


def jacobian_at(exprs: Sequence[sp.Expr], by: Sequence[sp.Symbol],
                point: Mapping[sp.Basic, sp.Expr]) -> NDArray[np.float64]:
    """The derivatives of expressions by symbols at a point that has a value for every symbol, a row an expression.

    Raises ValueError naming the derivative that does not exist or is not finite there.
    """
    found = np.zeros((len(exprs), len(by)))
    for i, expr in enumerate(exprs):
        for j, symbol in enumerate(by):
            derivative = sp.diff(expr, symbol)
            if derivative.is_zero:  # most are, and the others take long
                continue
            where = f"the derivative of {expr} by {symbol}"
            try:
                value = complex(sp.N(smooth_at(derivative, point), 17))
            except ValueError as trouble:
                raise ValueError(f"{where}: {trouble}") from None
            except TypeError:
                raise ValueError(f"{where} has no value at that point: linearise it elsewhere") from None
            if value.imag or not math.isfinite(value.real):
                raise ValueError(f"{where} is no finite number at that point: linearise it elsewhere")
            found[i, j] = value.real
    return found

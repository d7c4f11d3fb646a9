"""Goals of a form that several claims have."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, greater


def both(one: sp.Expr, other: sp.Expr) -> tuple[Relation, Relation]:
    """Equality as two inequalities, for a proof by cases that touch."""
    return at_most(one, other), at_least(one, other)


def integrated(rates: dict[sp.Expr, sp.Expr], bound: Relation, always: tuple[Relation, ...] = (),
               constant: tuple[sp.Expr, ...] = (), start: dict[sp.Expr, sp.Expr] | None = None,
               decreasing: sp.Expr | None = None) -> Goal:
    """`bound` at every time for integrals that start at zero (or at `start`), since its margin does not decrease."""
    begin = dict.fromkeys(rates, sp.S.Zero) | (start or {}) | {c: c for c in constant}
    signs = tuple(greater(c, 0) for c in constant if c.is_positive)
    return Goal((bound,), signs, rates | dict.fromkeys(constant, sp.S.Zero), always, begin,
                decreasing=-bound.margin if decreasing is None else decreasing,
                inputs=tuple(sorted({s for rate in rates.values() for s in rate.free_symbols} - {*rates, *constant}, key=str)))


i_axis, J_i, y_i = sp.symbols("i J y", real=True)  # the iteration, an integral of it, a value of it


def along_iterations(shown: Relation, always: tuple[Relation, ...], model: dict[sp.Symbol, sp.Expr],
                     constants: dict[sp.Symbol, sp.Expr]) -> Goal:
    """`shown` from some iteration on; the iteration i runs as a real number, and `model` shall break the claim."""
    rates = {x: sp.Symbol(f"w_{x}", real=True) for x in model}
    first = {x: sp.Symbol(f"{x}_0", real=True) for x in model}
    at_first = {first[x]: value.xreplace({i_axis: sp.S.Zero} | constants) for x, value in model.items()}
    return Goal((shown,), (), {i_axis: sp.Integer(1), **rates}, always, {i_axis: sp.S.Zero, **first}, eventually=i_axis,
                model=model | constants | at_first, inputs=tuple(rates.values()))

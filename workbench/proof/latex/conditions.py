"""What must hold for a printed piece to be a number, and whether the expression that is read still says so."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

import sympy as sp

from workbench.proof.latex.error import LatexError


@dataclass(frozen=True)
class Condition:
    """What must hold for a printed piece to be a number: a denominator is not 0, a root's or logarithm's argument not
    negative."""

    kind: Literal["denominator", "root", "logarithm"]
    argument: sp.Expr
    position: int


def conditions_of(meaning: sp.Expr, position: int) -> Iterator[Condition]:
    """What must hold for the formula that a letter stands for to be a number."""
    for found in meaning.atoms(sp.Pow, sp.log):
        if isinstance(found, sp.log):
            yield Condition("logarithm", found.args[0], position)
            continue
        if found.exp.is_negative:
            yield Condition("denominator", found.base, position)
        if not found.exp.is_Integer:
            yield Condition("root", found.base, position)


def require_kept(conditions: Iterable[Condition], side: sp.Expr) -> None:
    """Raise LatexError for a denominator, root or logarithm that has gone in the expression read: with it the places
    where the line says nothing would be lost."""
    powers = side.atoms(sp.Pow)
    below = {factor for p in powers if p.exp.is_negative for factor in _factors(p.base)}
    roots = _rooted(powers)
    logarithms = {found.args[0] for found in side.atoms(sp.log)}
    for condition in conditions:
        argument = condition.argument
        if condition.kind == "denominator":
            kept = argument.is_nonzero or _factors(argument) <= below
        elif condition.kind == "root":
            own = _rooted(sp.sqrt(argument).atoms(sp.Pow))  # sqrt(4 x) has become 2 sqrt(x)
            kept = argument.is_nonnegative or (bool(own) and own <= roots)
        else:
            kept = argument.is_positive or argument in logarithms
        if not kept:
            raise LatexError(f"the {condition.kind} of {argument} cancels: write the line without it",
                             condition.position)


def _rooted(powers: set[sp.Pow]) -> set[sp.Expr]:
    return {p.base for p in powers if not p.exp.is_Integer}


def _factors(expr: sp.Expr) -> set[sp.Expr]:
    """The factors of a denominator, without numbers and powers, that are not known to differ from 0."""
    bases = {factor.base if isinstance(factor, sp.Pow) else factor for factor in sp.Mul.make_args(expr)}
    return {base for base in bases if not base.is_nonzero}

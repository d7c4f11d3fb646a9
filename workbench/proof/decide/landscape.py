"""A goal as functions of floating-point numbers, one neuron under each sum: where is an exact look worth while?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.proof.claim import Goal, Relation, name_of
from workbench.proof.decide.once import once_per_goal
from workbench.proof.decide.tape import Tape
from workbench.proof.derive import expand_derivatives

Numbers = NDArray[np.float64]

ROUNDING = 1e-12
TINY = 1e-300


def plain(goal: Goal, expr: sp.Expr) -> sp.Expr:
    """The expression at one neuron: derivatives carried out, sums replaced by their term, W[j] by a symbol."""
    single = expand_derivatives(expr, goal.flow).replace(sp.Sum, lambda term, *_: term)
    return single.xreplace({w: sp.Symbol(name_of(w), real=True) for w in single.atoms(sp.Indexed)})


class Landscape:
    """Relative margins of a goal's relations: each margin over the sum of its terms' absolute values."""

    def __init__(self, goal: Goal) -> None:
        self.symbols = [sp.Symbol(name_of(s), real=True) if isinstance(s, sp.Indexed) else s for s in goal.symbols()]
        self.given = [_signed(goal, r) for r in (*goal.signs(), *goal.assume, *goal.always)]
        self.shown = [_signed(goal, r) for r in goal.show]
        self.start = [(s, plain(goal, value)) for s, value in goal.initial.items()]
        relations = (*goal.assume, *goal.always, *goal.show)
        # What stands under D must be defined too, though its derivative may be where it is not.
        under = {plain(goal, log.args[0]) for r in relations for log in r.left.atoms(sp.log) | r.right.atoms(sp.log)}
        self.domain = [(">", argument) for argument in sorted(under, key=sp.default_sort_key)]
        every = (*self.domain, *self.given, *self.shown)
        self._all = Tape(self.symbols, [margin for _, margin in every], sizes=True)

    def operators(self) -> list[tuple[str, bool]]:
        """The relations' operators in the order of `margins`, and whether they are shown rather than assumed."""
        every = [(operator, False) for operator, _ in (*self.domain, *self.given)]
        return every + [(operator, True) for operator, _ in self.shown]

    def margins(self, columns: Sequence[Numbers]) -> tuple[Numbers, Numbers]:
        """All margins and the sums of their terms' sizes, each of shape (points, relations)."""
        count = len(columns[0]) if columns else 1
        with np.errstate(all="ignore"):
            values = [np.broadcast_to(np.asarray(v, dtype=float), (count,)) for v in self._all(*columns)]
        return np.stack(values[::2], axis=1), np.stack(values[1::2], axis=1)

    def look(self, columns: Sequence[Numbers]) -> tuple[Numbers, Numbers]:
        """(violation, excess) for each point: how far assumptions are from holding (0: they hold), and by how much
        the relation that fails most fails; an excess that is not positive says that all hold, rounding allowed for.
        Undefined counts as infinitely violated."""
        count = len(columns[0]) if columns else 1
        with np.errstate(all="ignore"):
            values = [np.broadcast_to(np.asarray(v, dtype=float), (count,)) for v in self._all(*columns)]
            margins = [m / (s + TINY) for m, s in zip(values[::2], values[1::2], strict=True)]
        undefined = ~np.isfinite(values).all(axis=0)
        own = len(self.domain) + len(self.given)
        violation = np.zeros(count)
        with np.errstate(all="ignore"):
            for (operator, _), margin in zip((*self.domain, *self.given), margins[:own], strict=True):
                violation += _violated(operator, margin)
        failures = [_failed(operator, margin) for (operator, _), margin in zip(self.shown, margins[own:], strict=True)]
        excess = np.max(failures, axis=0)
        violation[undefined], excess[undefined] = np.inf, -np.inf
        return violation, excess


@once_per_goal
def landscape_of(goal: Goal) -> Landscape:
    """The goal's landscape."""
    return Landscape(goal)


def _signed(goal: Goal, relation: Relation) -> tuple[str, sp.Expr]:
    operator = {"<=": ">=", "<": ">"}.get(relation.operator, relation.operator)
    return operator, plain(goal, relation.margin)


def _violated(operator: str, margin: Numbers) -> Numbers:
    if operator == "==":
        short: Numbers = np.abs(margin)
    elif operator == "!=":
        short = np.where(margin == 0, 2 * ROUNDING, 0.0)
    else:
        short = np.maximum(-margin, 0.0) + (np.where(margin == 0, 2 * ROUNDING, 0.0) if operator == ">" else 0.0)
    return np.where(short <= ROUNDING, 0.0, short)


def _failed(operator: str, margin: Numbers) -> Numbers:
    """A failure beyond rounding is positive; where equality is a failure, what may be equality is too."""
    if operator in (">", "!="):
        return (-margin if operator == ">" else -np.abs(margin)) + ROUNDING
    return (-margin if operator == ">=" else np.abs(margin)) - ROUNDING

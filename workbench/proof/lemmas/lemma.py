"""A lemma as it is used: whose it is, what it asks to be shown, and what follows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation

Flow = Mapping[sp.Expr, sp.Expr]


@dataclass(frozen=True)
class Hypothesis:
    """What a lemma asks: `name` is a word that tells it apart, `title` says it, `goal` is what is decided."""

    name: str
    title: str
    goal: Goal


@dataclass(frozen=True)
class Lemma:
    """A lemma of the literature applied to a system: its source, its hypotheses as goals, its conclusion as LaTeX.

    The hypotheses are decided, the conclusion is taken from the literature. `taken` says in words what the source asks
    besides, of which nothing is decided.
    """

    source: str
    hypotheses: tuple[Hypothesis, ...]
    conclusion: str
    taken: str = "Solutions exist as long as they stay bounded."


def goal_of(shown: Relation, flow: Flow, assume: Sequence[Relation] = (),
            inputs: Sequence[sp.Symbol | sp.Indexed] = ()) -> Goal:
    """A hypothesis that is one relation, along a flow."""
    return Goal((shown,), assume=tuple(assume), flow=dict(flow), inputs=tuple(inputs))


def require_moving(name: str, flow: Flow, *values: sp.Expr) -> None:
    """Raise ClaimError where nothing of what a lemma speaks of moves along the flow: it would hold of a constant."""
    for value in values:
        if not value.free_symbols & {symbol for moving in flow for symbol in moving.free_symbols}:
            raise ClaimError(f"{name}: {value} has no symbol that the flow moves: give the rates of its symbols")


def require_constant(name: str, flow: Flow, inputs: Sequence[sp.Symbol | sp.Indexed], *values: sp.Expr) -> None:
    """Raise ClaimError where a number that a lemma takes as constant has a symbol that may move."""
    moving = {symbol for one in (*flow, *inputs) for symbol in one.free_symbols}
    for value in map(sp.Add, values):
        if found := sorted(map(str, value.free_symbols & moving)):
            raise ClaimError(f"{name}: {value} is to be constant, and {', '.join(found)} moves: give a bound of it")


def square_norm(state: Sequence[sp.Expr]) -> sp.Expr:
    """x'x of a state."""
    return sp.Add(*(x**2 for x in state))

"""A lemma as it is used: whose it is, what it asks to be shown, and what follows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.lemmas.requirements import Flow
from workbench.proof.text import relation_text

EXIST = "Solutions exist at all later times."


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
    besides, and what is assumed at all times, of which nothing is decided.
    """

    source: str
    hypotheses: tuple[Hypothesis, ...]
    conclusion: str
    taken: str


def taken(words: str, assume: Sequence[Relation]) -> str:
    """What a lemma takes for given, in words; the conclusion is of motions that keep the assumptions."""
    held = ", ".join(map(relation_text, assume))
    return f"{words} At all times {held} is taken to hold." if held else words


def goal_of(shown: Relation, flow: Flow, assume: Sequence[Relation] = (),
            inputs: Sequence[sp.Symbol | sp.Indexed] = ()) -> Goal:
    """A hypothesis that is one relation, along a flow."""
    return Goal((shown,), assume=tuple(assume), flow=dict(flow), inputs=tuple(inputs))


def square_norm(state: Sequence[sp.Expr]) -> sp.Expr:
    """x'x of a state."""
    return sp.Add(*(x**2 for x in state))


def exact(*values: Any) -> tuple[sp.Expr, ...]:
    """Expressions of what is given, whole numbers and fractions among it."""
    return tuple(sp.sympify(value, strict=True) for value in values)

"""Relations and goals that several claims share."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater


def within(value: sp.Expr, bound: sp.Expr) -> tuple[Relation, ...]:
    """|value| <= bound."""
    return at_most(value, bound), at_least(value, -bound)


def small_hidden(*hidden: sp.Expr) -> tuple[Relation, ...]:
    """Hidden outputs whose squares sum to 1 at most and are not all 0, as Gaussians (16), (29) do: a counterexample stays
    among those."""
    return tuple(relation for h in hidden for relation in (at_most(over_neurons(h**2), 1), greater(over_neurons(h**2), 0)))


def with_gain(*gains: sp.Expr) -> tuple[Relation, ...]:
    """The roots of a network's gains are not all 0: a counterexample keeps the gain that the paper calls positive."""
    return tuple(greater(over_neurons(g**2), 0) for g in gains)


def moves_alike(estimate: sp.Expr, truth: sp.Expr, constant_truth: bool = False) -> Goal:
    """The rate of estimate - truth against the rate of the estimate."""
    rates = sp.symbols(f"{estimate}_rate {truth}_rate", real=True)
    flow = {estimate: rates[0], truth: sp.Integer(0) if constant_truth else rates[1]}
    return Goal((equal(D(estimate - truth), D(estimate)),), flow=flow)

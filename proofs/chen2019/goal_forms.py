"""Goals of a form that several claims have."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, greater, name_of
from workbench.proof.derive import expand_derivatives
from workbench.trains.multi_particle import over_cars


def both(one: sp.Expr, other: sp.Expr) -> tuple[Relation, Relation]:
    """Equality as two inequalities, for a proof by cases that touch."""
    return at_most(one, other), at_least(one, other)


def carried(relations: tuple[Relation, ...], flow: dict[sp.Expr, sp.Expr]) -> tuple[Relation, ...]:
    """What another claim shows of rates along a flow, with the rates put in: for goals whose flow is another."""
    return tuple(Relation(expand_derivatives(r.left, flow), r.operator, expand_derivatives(r.right, flow))
                 for r in relations)


def integrated(rates: dict[sp.Expr, sp.Expr], bound: Relation, always: tuple[Relation, ...] = (),
               constant: tuple[sp.Expr, ...] = (), start: dict[sp.Expr, sp.Expr] | None = None,
               decreasing: sp.Expr | None = None) -> Goal:
    """`bound` at every time for integrals that start at zero (or at `start`), since its margin does not decrease.

    What `rates` mention without a rate of its own varies in time, save what is `constant`.
    """
    begin = dict.fromkeys(rates, sp.S.Zero) | (start or {}) | {c: c for c in constant}
    signs = tuple(greater(c, 0) for c in constant if c.is_positive)
    flow = rates | dict.fromkeys(constant, sp.S.Zero)
    return Goal((bound,), signs, flow, always, begin, decreasing=-bound.margin if decreasing is None else decreasing,
                inputs=varying(flow))


def varying(flow: dict[sp.Expr, sp.Expr]) -> tuple[sp.Symbol | sp.Indexed, ...]:
    """The symbols that the rates of `flow` mention and that have no rate, those with a value a car among them."""
    found: set[sp.Symbol | sp.Indexed] = set()
    for rate in flow.values():
        of_cars = {x for indexed in rate.atoms(sp.Indexed) for x in (indexed.base.label, *indexed.indices)}
        limits = {x for total in rate.atoms(sp.Sum) for limit in total.limits for part in limit for x in part.free_symbols}
        found |= (rate.atoms(sp.Symbol) - of_cars - limits | rate.atoms(sp.Indexed)) - flow.keys()
    return tuple(sorted(found, key=str))


i_axis = sp.Symbol("i", real=True)  # the iteration


def along_iterations(shown: Relation, always: tuple[Relation, ...], model: dict[sp.Symbol, sp.Expr],
                     constants: dict[sp.Symbol, sp.Expr]) -> Goal:
    """`shown` from some iteration on; the iteration i runs as a real number, and `model` shall break the claim."""
    rates = {x: sp.Symbol(f"w_{x}", real=True) for x in model}
    first = {x: sp.Symbol(f"{x}_0", real=True) for x in model}
    at_first = {first[x]: value.xreplace({i_axis: sp.S.Zero} | constants) for x, value in model.items()}
    return Goal((shown,), (), {i_axis: sp.Integer(1), **rates}, always, {i_axis: sp.S.Zero, **first}, eventually=i_axis,
                model=model | constants | at_first, inputs=tuple(rates.values()))


class Integrals:
    """Integrals over time from zero as states: linear in the integrand, so one state for each product that it holds.

    What is in `constants` stands before the integral.
    """

    def __init__(self, constants: tuple[sp.Expr, ...]) -> None:
        self.constants, self.rates = set(constants), dict[sp.Expr, sp.Expr]()

    def of(self, integrand: sp.Expr) -> sp.Expr:
        """The integral of a number that moves."""
        return self._sum(integrand, lambda product: product)

    def over_cars(self, summand: sp.Expr) -> sp.Expr:
        """The integral of a sum over the cars."""
        return self._sum(summand, over_cars)

    def _sum(self, integrand: sp.Expr, summed: Callable[[sp.Expr], sp.Expr]) -> sp.Expr:
        total = sp.S.Zero
        for term in sp.Add.make_args(sp.expand(integrand)):
            factors = sp.Mul.make_args(term)
            before = sp.Mul(*(x for x in factors if x.free_symbols <= self.constants))
            product = sp.Mul(*(x for x in factors if not x.free_symbols <= self.constants))
            state = sp.Symbol("I_" + "_".join(_named(x) for x in sp.Mul.make_args(product)), real=True)
            self.rates[state] = summed(product)
            total += before * state
        return total


def _named(factor: sp.Expr) -> str:
    base, exponent = factor.as_base_exp()
    return name_of(base) if exponent == 1 else f"{name_of(base)}{exponent}"

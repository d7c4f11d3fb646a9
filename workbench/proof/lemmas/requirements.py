"""What a lemma's theorem asks of how a system is stated: ClaimError, with the remedy, where it is stated otherwise."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import CLOCK, D, Relation
from workbench.proof.text import relation_text

Flow = Mapping[sp.Expr, sp.Expr]
Inputs = Sequence[sp.Symbol | sp.Indexed]

BOUNDED_IN_TIME = (sp.sin, sp.cos, sp.tanh, sp.atan)


def moving_symbols(flow: Flow) -> set[sp.Expr]:
    """The symbols whose rate is not zero."""
    return {symbol for one, rate in flow.items() if rate != 0 for symbol in one.free_symbols}


def rates_of(flow: Flow) -> tuple[sp.Expr, ...]:
    """The rates, numbers among them, as expressions."""
    return tuple(map(sp.Add, flow.values()))


def clock_of(flow: Flow) -> set[sp.Expr]:
    """The symbol of time, where the flow says that it runs."""
    return {one for one, rate in flow.items() if str(one) == CLOCK and rate == 1}


def require_system(name: str, flow: Flow, assume: Sequence[Relation] = (), inputs: Inputs = ()) -> None:
    """Refuse what no lemma allows: a sign of what moves that is declared, and so would be known at all times unsaid; an
    assumption of a rate; one that may hold on a surface alone, where a rate jumps: there solutions have other rates."""
    moving = moving_symbols(flow)
    for one in flow:
        if one in moving and one.is_nonnegative and not (one in clock_of(flow) and not one.is_positive):
            raise ClaimError(f"{name}: {one} moves and is declared {'positive' if one.is_positive else 'nonnegative'}, "
                             "which says something of its start and nothing of later times: declare it real; what the "
                             "lemma allows to hold at all times is stated in assume")
    jumps = jumps_of(rates_of(flow), moving | set(inputs))
    for relation in assume:
        if relation.left.has(D) or relation.right.has(D):
            raise ClaimError(f"{name}: the assumption {relation_text(relation)} is of a rate: the flow gives the rates")
        if jumps and not relation.strict and _symbols(relation) & moving:
            raise ClaimError(f"{name}: a rate jumps with {jumps[0]}, and {relation_text(relation)} may hold on the "
                             "surface of the jump alone: assume strict relations, or a rate that is continuous")


def require_moving(name: str, flow: Flow, *values: sp.Expr) -> None:
    """Refuse what does not move along the flow: a lemma would hold of a constant."""
    for value in values:
        if not value.free_symbols & {symbol for moving in flow for symbol in moving.free_symbols}:
            raise ClaimError(f"{name}: {value} has no symbol that the flow moves: give the rates of its symbols")


def require_constant(name: str, flow: Flow, inputs: Inputs, *values: sp.Expr) -> None:
    """Refuse a number that a lemma takes as constant and that has a symbol which may move."""
    moving = {symbol for one in (*flow, *inputs) for symbol in one.free_symbols}
    for value in map(sp.Add, values):
        if found := sorted(map(str, value.free_symbols & moving)):
            raise ClaimError(f"{name}: {value} is to be constant, and {', '.join(found)} moves: give a bound of it")


def require_own_symbol(name: str, level: sp.Symbol, values: Iterable[sp.Expr], assume: Sequence[Relation]) -> None:
    """Refuse a level that stands for V(0) and for something else too: V(0) may be any number that V takes."""
    if not isinstance(level, sp.Symbol):
        raise ClaimError(f"{name}: the level {level} stands for V(0), so it is a symbol of its own")
    sides = [side for relation in assume for side in (relation.left, relation.right)]
    if any(value.has(level) for value in (*values, *sides)):
        raise ClaimError(f"{name}: the level {level} stands for V(0), which may be any number, and is a symbol of the "
                         "system or of what is assumed as well: use a symbol of its own")


def require_of_no_state(name: str, flow: Flow, assume: Sequence[Relation], delayed: Iterable[sp.Expr] = ()) -> None:
    """Refuse an assumption of what the flow moves: of a state nothing is known but at the start."""
    moving = moving_symbols(flow) | set(delayed)
    for relation in assume:
        if found := sorted(map(str, _symbols(relation) & moving)):
            raise ClaimError(f"{name}: {relation_text(relation)} is assumed at all times, and {found[0]} is of the "
                             "state, of which nothing is known but at the start: assume of inputs and constants alone")


def require_closed(name: str, assume: Sequence[Relation], inputs: Inputs) -> None:
    """Refuse inputs of which a bound is given that they may come as close to as they like and never take: what holds
    for each of their values need not hold in the limit."""
    for one in inputs:
        if one.is_positive:
            raise ClaimError(f"{name}: the input {one} is declared positive, and may come as close to 0 as it likes: "
                             "declare it real or nonnegative, and assume a bound of it with <= or >=")
    for relation in assume:
        if relation.operator in ("<", ">", "!=") and (found := sorted(map(str, _symbols(relation) & set(inputs)))):
            raise ClaimError(f"{name}: {relation_text(relation)} lets the input {found[0]} come as close to the bound "
                             "as it likes: assume it with <= or >=")


def require_continuous_rates(name: str, flow: Flow, inputs: Inputs = ()) -> None:
    """Refuse rates that jump: the theorem is of rates that are continuous."""
    if jumps := jumps_of(rates_of(flow), moving_symbols(flow) | set(inputs)):
        raise ClaimError(f"{name}: a rate jumps with {jumps[0]}, and the theorem is of rates that are continuous: use "
                         "a continuous function in its place")


def require_whole_state(name: str, flow: Flow, state: Sequence[sp.Expr]) -> None:
    """Refuse a state that is not all that the flow moves, time apart: the rest might grow without a bound."""
    if missing := sorted(map(str, set(flow) - set(state) - clock_of(flow))):
        raise ClaimError(f"{name}: the flow moves {', '.join(missing)} too: the state is all that moves but the time")
    if other := [one for one in state if one not in flow or one in clock_of(flow)]:
        raise ClaimError(f"{name}: {other[0]} is no symbol of the state that the flow moves: write V and the flow in "
                         "the states themselves")


def require_bounded_in_time(name: str, flow: Flow) -> None:
    """Refuse rates that the time may make as large as it likes: the theorem asks a bound at all times alike."""
    for clock in clock_of(flow):
        for rate in rates_of(flow):
            parts = rate.atoms(*BOUNDED_IN_TIME)
            rest = rate.xreplace({part: sp.Dummy(real=True) for part in parts})
            if rest.has(clock) or any(part.has(clock) for expr in partial_of(rate) for part in (expr, *expr.args)):
                raise ClaimError(f"{name}: the rate {rate} changes with the time {clock}, and no bound of it at all "
                                 "times is seen: put an input in the place of what changes, and assume its bounds")


def require_bounded_inputs(name: str, flow: Flow, assume: Sequence[Relation], inputs: Inputs) -> None:
    """Refuse an input of which no bound is assumed, d**2 <= c or abs(d) <= c with a constant c: the theorem asks rates
    that are bounded at all times alike, which a bound that moves, as by the time, need not be."""
    varying = moving_symbols(flow) | set(inputs)

    def bounds(relation: Relation, one: sp.Expr) -> bool:
        left, right = (relation.left, relation.right) if relation.operator in ("<=", "<") else (
            relation.right, relation.left)
        return relation.operator in ("<=", "<", ">=", ">") and left in (one**2, sp.Abs(one)) and not (
            right.free_symbols & varying or CLOCK in map(str, right.free_symbols))

    for one in inputs:
        if not any(bounds(relation, one) for relation in assume):
            raise ClaimError(f"{name}: no bound of the input {one} is assumed, and the theorem asks rates that are "
                             f"bounded at all times alike: add at_most({one}**2, c) with a constant c to assume")


def require_delayed(name: str, V: sp.Expr, past: Mapping[sp.Expr, sp.Symbol], flow: Flow) -> None:
    """Refuse symbols that are no values of the state one delay ago: of which more is known than that they are real, one
    for two states, one that moves by a rate or is in V; and a V that is of more than the state and constants."""
    delayed = tuple(past.values())
    if len(set(delayed)) != len(delayed):
        raise ClaimError(f"{name}: two states have one delayed value: give each its own symbol")
    for one in delayed:
        if one in flow:
            raise ClaimError(f"{name}: {one} has a rate of its own and is no delayed value: give it another symbol")
        if one.is_nonnegative or not isinstance(one, sp.Symbol):
            raise ClaimError(f"{name}: the delayed value {one} has a sign that is not known of the state: declare the "
                             "symbol real")
    require_constant(name, {one: rate for one, rate in flow.items() if one not in past}, delayed, V)


def jumps_of(values: Iterable[sp.Expr], moving: set[sp.Expr]) -> list[sp.Expr]:
    """The signs, of what moves, at which values jump."""
    return [part for value in values for part in sorted(value.atoms(sp.sign), key=str) if part.free_symbols & moving]


def _symbols(relation: Relation) -> set[sp.Expr]:
    return set(relation.left.free_symbols | relation.right.free_symbols)


def partial_of(expr: sp.Expr) -> set[sp.Expr]:
    """The parts of an expression that are not defined for every real number: quotients, roots, logarithms, tangents."""
    return {part for part in expr.atoms(sp.Pow, sp.log, sp.tan)
            if not (isinstance(part, sp.Pow) and (part.base == sp.E or (part.exp.is_Integer and part.exp > 0)))}

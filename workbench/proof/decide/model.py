"""Break a claim of "from some time on" by functions of time that meet every assumption and never do as shown."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from typing import Any

import numpy as np
import sympy as sp

from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal, Relation, Verdict, at_least, equal, name_of
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.landscape import Landscape, Numbers
from workbench.proof.decide.proposals import proposals
from workbench.proof.decide.sampling import TIDY, tidy_fraction, within_sign
from workbench.proof.decide.tape import Tape
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import text

NEGATED = {"<=": ">", "<": ">=", ">=": "<", ">": "<="}
TIMES = np.array([0.0, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0, 7.0, 10.0])  # exp(-2 t) still counts at the last
BATCHES, BATCH, LOOKS = 6, 300, 10
SHARES = (0.0, 0.3, 0.6, 1.0)  # of the proposed model that is drawn anew

Functions = dict[sp.Expr, sp.Expr]


def find_model(goal: Goal, record: dict[str, Any], verdict: Verdict, seed: int = 1) -> dict[str, Any] | None:
    """A certificate made of the model that the goal proposes, or of one near it; None when none is found.

    record: the goal as its certificate states it.
    """
    if goal.eventually is None:
        return None
    models = _models(goal, seed)
    return next((found for model in models if (found := _certificate(goal, record, verdict, model)) is not None), None)


def _models(goal: Goal, seed: int) -> Iterator[Functions]:
    """The proposed model, then states of rest, then others that numbers on a grid of times do not rule out."""
    if goal.model:
        yield goal.model
    if set(goal.flow.values()) - {sp.Integer(1)} <= set(goal.inputs):
        yield from _states_of_rest(goal, seed)
        yield from _drawn_models(goal, np.random.default_rng(seed))


def _states_of_rest(goal: Goal, seed: int) -> Iterator[Functions]:
    """Models in which nothing moves."""
    time = goal.eventually
    resting = {goal.flow[s]: sp.Integer(0) for s in goal.flow if s != time}

    def rest(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(_carried(goal, r).subs(resting) for r in relations)

    start = tuple(equal(s, value) for s, value in goal.initial.items() if s != time)
    at_rest = Goal(rest(goal.show), (*rest(goal.assume), *rest(goal.always), *start, at_least(time, 0)))
    for point in islice(proposals(at_rest, seed, break_shown=True), LOOKS):
        values = {s: Fraction(point.get(name_of(s), 1)) for s in goal.symbols() if s not in (time, *resting)}
        yield {s: sp.Rational(v.numerator, v.denominator) for s, v in values.items()}


def _certificate(goal: Goal, record: dict[str, Any], verdict: Verdict, model: Functions) -> dict[str, Any] | None:
    time = goal.eventually
    moving = [s for s in goal.flow if s != time]
    if not set(moving) <= model.keys() or len(goal.show) != 1 or goal.show[0].operator not in NEGATED:
        return None
    constants = {s: v for s, v in model.items() if s not in moving}
    values = {s: model[s] for s in moving}
    values |= {goal.flow[s]: sp.diff(model[s], time) for s in moving}
    later = (at_least(time, 0),)

    def along(relation: Relation) -> Relation:
        return _carried(goal, relation).subs(values).subs(constants)

    def proof(relation: Relation) -> dict[str, Any] | None:
        if relation.operator in ("==", "<=", ">=") and find_identity(Goal((relation,)), relation):
            return {"rule": "identity"}
        return find_combination(Goal((relation,)), relation, later)

    shown = along(goal.show[0])
    fails = proof(Relation(shown.left, NEGATED[shown.operator], shown.right))  # type: ignore[arg-type]
    if fails is None:
        return None
    always: list[dict[str, Any]] = []
    for relation in goal.always:
        holds = proof(along(relation))
        if holds is None:
            return None
        always.append(holds)
    certificate = {"version": 1, "verdict": verdict, "goal": record,
                   "functions": {name_of(s): text(model[s]) for s in moving},
                   "point": {name_of(s): str(v) for s, v in constants.items()}, "always": always, "fails": fails}
    try:
        check(certificate)
    except CertificateError:
        return None
    return certificate


def _carried(goal: Goal, relation: Relation) -> Relation:
    """The relation with its derivatives carried out along the goal's flow."""
    left, right = (expand_derivatives(side, goal.flow) for side in (relation.left, relation.right))
    return Relation(left, relation.operator, right)


def _drawn_models(goal: Goal, rng: np.random.Generator) -> Iterator[Functions]:
    """Constants, and a + b shape(t) for what moves, drawn at random; parts of the proposed model are kept."""
    time = goal.eventually
    assert time is not None
    shapes = (sp.Integer(0), sp.exp(-time), time, sp.exp(-2 * time), 1 / (1 + time))
    landscape = Landscape(goal)
    moving = [s for s in goal.flow if s != time]
    rates = [goal.flow[s] for s in moving]
    constants = [s for s in landscape.symbols if s not in (*moving, *rates, time)]
    looked = 0
    for _ in range(BATCHES):
        anew = rng.choice(SHARES, BATCH)
        parts = {s: _shares(goal.model.get(s), shapes, time, anew, rng) for s in moving}
        fixed = {s: _values(s, goal.model.get(s), anew, rng) for s in constants}
        for s, start in goal.initial.items():  # a constant that is an initial value follows the function
            if start in fixed and s in parts:
                fixed[start] = np.array([sp.N(f.xreplace({time: sp.Integer(0)})) for f in parts[s]], dtype=float)
        columns = {time: np.tile(TIMES, BATCH)}
        columns |= {s: np.repeat(values, len(TIMES)) for s, values in fixed.items()}
        for s, rate in zip(moving, rates, strict=True):
            columns[s], columns[rate] = _on_grid(parts[s], time)
        violation, excess = (v.reshape(BATCH, len(TIMES)) for v in landscape.look(
            [columns[s] for s in landscape.symbols]))
        for row in np.flatnonzero((violation == 0).all(axis=1) & (excess > 0).all(axis=1)):
            looked += 1
            if looked > LOOKS:
                return
            exact = {s: tidy_fraction(float(values[row])) for s, values in fixed.items()}
            yield {s: parts[s][row] for s in moving} | {
                s: sp.Rational(v.numerator, v.denominator) for s, v in exact.items()}


def _shares(proposed: sp.Expr | None, shapes: tuple[sp.Expr, ...], time: sp.Symbol, anew: Numbers,
            rng: np.random.Generator) -> list[sp.Expr]:
    """A function of time for each trial."""
    tidy = [sp.Rational(value) for value in TIDY]
    drawn = []
    for share in anew:
        start, size, shape = (int(rng.integers(0, n)) for n in (len(tidy), len(tidy), len(shapes)))
        keep = proposed is not None and rng.random() >= share
        drawn.append(proposed if keep else tidy[start] + tidy[size] * shapes[shape])
    return drawn


def _values(symbol: sp.Symbol, proposed: sp.Expr | None, anew: Numbers, rng: np.random.Generator) -> Numbers:
    """A value of a constant for each trial."""
    drawn = within_sign(symbol, rng.choice(TIDY, len(anew)))
    return drawn if proposed is None else np.where(rng.random(len(anew)) < anew, drawn, float(proposed))


def _on_grid(functions: list[sp.Expr], time: sp.Symbol) -> tuple[Numbers, Numbers]:
    """Values and rates of functions on the grid of times, one function after the other."""
    known: dict[sp.Expr, tuple[Numbers, Numbers]] = {}
    for function in functions:
        if function not in known:
            pair = Tape((time,), (function, sp.diff(function, time)))(TIMES)
            values, rates = (np.broadcast_to(np.asarray(v, dtype=float), TIMES.shape) for v in pair)
            known[function] = values, rates
    return (np.concatenate([known[f][0] for f in functions]), np.concatenate([known[f][1] for f in functions]))

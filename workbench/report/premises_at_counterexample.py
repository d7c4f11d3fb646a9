"""Whether a counterexample of one line keeps another one that fails: then the first does not fail by the second."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

from workbench.proof.checker import (
    SUM,
    Bounds,
    CertificateError,
    Context,
    Ratio,
    bounds,
    calls,
    holds,
    margin,
    nodes,
    number,
    parse,
    read_point,
    roots_of,
    split_relation,
    substitute,
)

Certificate = Mapping[str, Any]
FREE = 4  # letters that the counterexample leaves free, up to which several values are tried for each by itself


@dataclass(frozen=True)
class Other:
    """A line that fails; obeyed: whether it is no false calculation, but may hold of one system and not of another."""

    certificate: Certificate
    obeyed: bool


@dataclass(frozen=True)
class _World:
    """What a counterexample gives: values of letters, rates, letters that vary with no known rate, the terms of sums,
    numbers between which roots lie; of a motion functions of time for letters and their rates; chosen: letters whose
    values were left free."""

    point: Mapping[str, str]
    flow: Mapping[str, str]
    inputs: Sequence[str]
    indexed: Sequence[str]
    terms: Sequence[Mapping[str, str]]
    between: Bounds
    motion: Mapping[str, ast.expr]
    time: str
    chosen: frozenset[str] = frozenset()

    def given(self) -> set[str]:
        """The letters that have a value here."""
        return {*self.point, *self.motion, *(name for row in self.terms for name in row), self.time}


def kept_and_broken(certificate: Certificate, others: Mapping[str, Other]) -> tuple[list[str], list[str]]:
    """Of other lines that fail those that the counterexample of a certificate keeps, and those that it breaks, by their
    names; of the rest it says nothing.

    Kept is a line of which all that is assumed and shown holds there, evaluated exactly. A letter that the
    counterexample does not name may have any value only in what some systems obey, and where nothing says that it
    moves: it may be another name of what moves there. What is kept is kept together, with one value of each letter. Of
    later times and of values at time zero nothing is said.
    """
    kept: list[str] = []
    broken: list[str] = []
    world = _world_of(certificate)
    for name, other in others.items() if world else ():
        goal = other.certificate.get("goal")
        if goal is None or world is None or goal.get("initial") or goal.get("eventually"):
            continue
        free = sorted(_names(goal, world) - world.given())
        moving = {*free, *world.chosen} & goal.get("flow", {}).keys()
        if moving or (free and not other.obeyed):
            continue
        positive = {text.removesuffix(" > 0") for text in goal.get("assume", [])}
        for values in _values(free, other.certificate.get("point", {}), positive):
            there = replace(world, point={**world.point, **values}, chosen=world.chosen | {*free})
            holding = _holds(there, goal)
            if holding:
                world = there
                kept.append(name)
                break
            if holding is False and not free:
                broken.append(name)
    return kept, broken


def _world_of(certificate: Certificate) -> _World | None:
    if "point" not in certificate or certificate.get("verdict") == "proved":
        return None
    goal = certificate["goal"]
    motion = {name: parse(text) for name, text in certificate.get("functions", {}).items()}
    rates = {rate: ast.Call(ast.Name("D"), [motion[name]], []) for name, rate in goal.get("flow", {}).items()
             if name in motion}
    return _World(certificate["point"], {} if motion else goal.get("flow", {}), goal.get("inputs", []),
                  goal.get("indexed", []), certificate.get("terms", []), roots_of(dict(certificate)),
                  {**rates, **motion}, goal.get("eventually") or "")


def _names(goal: Certificate, world: _World) -> set[str]:
    """The letters on which it depends whether a goal holds at an instant."""
    relations = [*_assumed(goal), *goal["show"]]
    texts = [side for text in relations for side in split_relation(text)[::2]]
    if any(calls(text, "D") for text in relations):
        texts += [rate for name, rate in goal.get("flow", {}).items() if name not in {*world.flow, *world.motion} and
                  not (world.motion and name in world.point)]
    called = {id(node.func) for text in texts for node in nodes(text) if isinstance(node, ast.Call)}
    return {node.id for text in texts for node in nodes(text) if isinstance(node, ast.Name) and id(node) not in called}


def _assumed(goal: Certificate) -> list[str]:
    return [*goal.get("assume", []), *goal.get("always", [])]


def _values(free: Sequence[str], own: Mapping[str, str], positive: set[str]) -> Iterator[dict[str, str]]:
    """Values for letters that are left free: 0 or 1 for all, those that break the other line, all but those
    that are positive or one of them changed, and where the letters are few each of these for each letter."""
    yield dict.fromkeys(free, "0")
    if not free:
        return
    yield dict.fromkeys(free, "1")
    breaking = {name: own.get(name, "0") for name in free}
    yield {name: breaking[name] if name in positive else "0" for name in free}
    yield from ({**breaking, name: value} for name in free for value in ("0", "1"))
    if len(free) <= FREE:
        for values in product(*(dict.fromkeys(("0", "1", value)) for value in breaking.values())):
            yield dict(zip(free, values, strict=True))


def _holds(world: _World, goal: Certificate) -> bool | None:
    """Whether all that a goal assumes and shows holds; None where that is not told. What breaks an assumption of it
    says nothing of the line."""
    try:
        if world.motion:
            told = partial(_throughout, world)
        else:
            context, point, terms = _at_once(world, goal)
            told = partial(holds, context, point=point, terms=terms, between=world.between)
        if not all(told(text) for text in _assumed(goal)):
            return None
        return {told(text) for text in goal["show"]} == {True}
    except CertificateError:
        return None


def _at_once(world: _World, goal: Certificate) -> tuple[Context, dict[str, Ratio], list[dict[str, Ratio]] | None]:
    """How a goal is read at a point: a letter has the rate of the counterexample, else that of the goal, else none."""
    flow = {**goal.get("flow", {}), **world.flow}
    indexed = sorted({*world.indexed, *goal.get("indexed", [])})
    resting = dict.fromkeys(sorted({*world.point} - {*flow, *world.inputs}), "0")
    context = Context({**resting, **flow}, indexed, [name for name in world.inputs if name not in flow])
    values = {name: value for name, value in read_point(dict(world.point)).items() if name not in world.between}
    if not world.terms:
        return context, {**values, SUM: number(1)}, None
    in_terms = {name: value for name, value in values.items() if name in indexed}
    return (context, {name: value for name, value in values.items() if name not in indexed},
            [{**in_terms, **read_point(dict(row))} for row in world.terms])


def _throughout(world: _World, text: str) -> bool:
    """Whether a relation holds along a motion at all times: decided where time drops out of it."""
    left, operator, right = split_relation(text)
    # Trees that are read once are kept by the checker: what is put in goes into copies.
    sides = [_Motion(world.motion).visit(deepcopy(parse(side))) for side in (left, right)]
    used = {node.id for side in sides for node in ast.walk(side) if isinstance(node, ast.Name)} & world.point.keys()
    context = Context({world.time: "1", **dict.fromkeys(sorted(used), "0")}, [])
    value, sign = margin(context, f"{ast.unparse(sides[0])} {operator} {ast.unparse(sides[1])}")
    value = substitute(context, value, {**read_point({name: world.point[name] for name in used}), SUM: number(1)})
    low, high = bounds(context, value, {})
    if sign in (">", ">=") and low <= 0 <= high and low != high:
        raise CertificateError("too wide to decide")
    return {">": low > 0, ">=": low >= 0, "==": low == high == 0, "!=": low > 0 or high < 0}[sign]


class _Motion(ast.NodeTransformer):
    """Puts functions of time in the place of letters."""

    def __init__(self, motion: Mapping[str, ast.expr]) -> None:
        self.motion = motion

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return deepcopy(self.motion[node.id]) if node.id in self.motion else node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        func, args = node.func, [self.visit(arg) for arg in node.args]
        rate = isinstance(func, ast.Name) and func.id == "D" and not any(
            isinstance(one, ast.Name) for one in ast.walk(args[0]))
        return ast.Constant(0) if rate else ast.Call(func, args, [])

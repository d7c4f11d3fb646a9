"""What claims take of others beyond what those show: a premise's own assumptions, which who uses it does not state.

What holds by what a letter means is no assumption: that an integral of squares is not negative, that the least of some
numbers is at most each of them."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from typing import Any

from workbench.proof.checker import NAME, nodes
from workbench.proof.latex.letters import latex_name
from workbench.proof.premises import ordered
from workbench.proof.verdict import Decision

Goal = Mapping[str, Any]
RATES = "rates are as in"
STARTS = "initial values are as in"
_SIGN = re.compile(rf"({NAME.pattern}) >= 0")
_SMALLER = re.compile(rf"({NAME.pattern}) <= ({NAME.pattern})")
_SQUARES = re.compile(r"(?:Sum\()?\w+\*\*2\)?(?: \+ (?:Sum\()?\w+\*\*2\)?)*")


def besides(decisions: Sequence[Decision]) -> dict[str, tuple[str, ...]]:
    """By the id of each proved claim what it takes of its premises and does not assume itself, as `x >= 1 (3)`.

    A premise is taken where an assumption reads as a relation that it shows. Of what it assumes only that counts whose
    symbols all stand in the claim too: others name quantities of its own. Of a rate the flow counts as well; what
    holds by definition does not. Every premise of a claim is among the decisions.
    """
    by_id = {d.claim.id: d for d in decisions}
    found: dict[str, tuple[str, ...]] = {}
    shown: dict[str, set[str]] = {}  # by the id of a claim what its premises show
    squares: dict[str, set[str]] = {}  # and what is the integral of a square there or in what they use
    meant = {paper: _by_definition([d for d in decisions if d.claim.paper == paper])
             for paper in {d.claim.paper for d in decisions}}
    for name in ordered([d.claim for d in decisions]):
        taken: dict[str, None] = {}
        claim = by_id[name].claim
        shown[name] = {text for premise in claim.premises for text in _goal(by_id[premise]).get("show", [])}
        squares[name] = _squares(_goal(by_id[name])).union(*(squares[premise] for premise in claim.premises))
        for premise in claim.premises:
            taken |= dict.fromkeys(_taken(_goal(by_id[name]), by_id[premise], shown, found[premise]))
        known = {f"{letter} >= 0" for letter in squares[name]} | meant[claim.paper]
        found[name] = tuple(text for text in taken if text.rpartition(" (")[0] not in known)
    return {name: taken for name, taken in found.items() if taken}


def _squares(goal: Goal) -> set[str]:
    """What starts at zero and has a square as its rate, so that it is not negative."""
    return {name for name, rate in goal.get("flow", {}).items()
            if _SQUARES.fullmatch(rate) and goal.get("initial", {}).get(name) == "0"}


def _by_definition(decisions: Sequence[Decision]) -> set[str]:
    """Of what premises of a paper assume the relations that hold by what its lines call their letters: that a minimum
    is at most each of what it is taken of, and that a letter is not negative where this is shown from its definition.
    """
    own = [d for d in decisions if d.claim.origin != "ours" and d.verdict == "proved"]
    printed = [_bare(d.claim.printed) for d in own]
    assumed = {text for d in decisions for text in _goal(d).get("assume", [])}
    return {text for text in assumed if ((found := _SIGN.fullmatch(text)) and any(
                text in _goal(d).get("show", []) and _defines(_goal(d), found[1]) for d in own))
            or ((found := _SMALLER.fullmatch(text)) and _is_least(found[1], found[2], printed))}


def _defines(goal: Goal, letter: str) -> bool:
    """Whether a goal assumes what a letter is and beside that signs alone."""
    given = goal.get("assume", [])
    return any(text.startswith(f"{letter} == ") for text in given) and all(
        text.startswith(f"{letter} == ") or text.endswith(" > 0") for text in given)


def _is_least(small: str, other: str, printed: Sequence[str]) -> bool:
    least = re.compile(rf"(?<![A-Za-z\\_]){re.escape(_bare(latex_name(small)))}:?=\\min[({{\\]*([^)}}]*)")
    return any(_bare(latex_name(other)) in found[1].split(",") for line in printed for found in least.finditer(line))


def _bare(latex: str) -> str:
    return re.sub(r"[{}\s]|\\left|\\right", "", latex)


def _goal(decision: Decision) -> Goal:
    return (decision.certificate or {}).get("goal", {}) if decision.verdict == "proved" else {}


def _taken(goal: Goal, premise: Decision, shown: Mapping[str, set[str]], before: tuple[str, ...]) -> list[str]:
    """What is taken of one premise; before: what that takes of the claims that it uses itself."""
    other = _goal(premise)
    used = [text for text in goal.get("assume", []) if text in other.get("show", [])]
    if not used:  # a condition is shown at the stated numbers alone, and is one wherever else it is used
        pinned = other.get("show", []) if premise.claim.kind == "condition" else ()
        return [f"{text} ({premise.claim.equation})" for text in goal.get("assume", [])
                if any(_is_at_numbers(text, one) for one in pinned)]
    own = [text for text in goal["assume"] if text not in used]
    stated = {*own, *goal.get("always", [])}
    letters = _moved(goal, {name for text in (*stated, *goal["show"]) for name in _names(text)})
    where = f"({premise.claim.equation})"
    found = [f"{text} {where}" for text in (*other["assume"], *other.get("always", []))
             if text not in stated | shown[premise.claim.id] and _names(text) <= letters]
    found += [one for one in before if one.startswith((RATES, STARTS)) or (
        (text := one.rpartition(" (")[0]) not in stated and _names(text) <= letters)]
    moving = _moved(other, {name for text in used for name in _names(text)}) if other.get("initial") else set()
    if any(goal.get("flow", {}).get(name, "0") != other.get("flow", {}).get(name, "0")
           for text in used for name in _derived(text, other)) or _differ(goal, other, "flow", moving):
        found.append(f"{RATES} {where}")
    if _differ(goal, other, "initial", moving):
        found.append(f"{STARTS} {where}")
    return found


def _differ(goal: Goal, other: Goal, part: str, names: set[str]) -> bool:
    """Whether both goals say something else of a name; one that says nothing of how it moves means the same motion."""
    own, said = goal.get(part, {}), other.get(part, {})
    return any(own[name] != said[name] for name in names & {*own} & {*said})


def _is_at_numbers(text: str, pinned: str) -> bool:
    """Whether one relation is another with numbers in the place of letters."""
    values: dict[str, str] = {}

    def same(node: ast.AST, other: ast.AST) -> bool:
        if isinstance(node, ast.Name) and not isinstance(other, ast.Name):
            return values.setdefault(node.id, ast.dump(other)) == ast.dump(other)
        parts, others = [*ast.iter_child_nodes(node)], [*ast.iter_child_nodes(other)]
        return type(node) is type(other) and len(parts) == len(others) and all(map(same, parts, others)) and (
            bool(parts) or ast.dump(node) == ast.dump(other))

    return same(ast.parse(text), ast.parse(pinned)) and bool(values)


def _moved(goal: Goal, letters: set[str]) -> set[str]:
    """The letters, and those of the rates by which a claim says that they move."""
    flow = goal.get("flow", {})
    while more := {name for letter in letters & {*flow} for name in _names(flow[letter])} - letters:
        letters = letters | more
    return letters


def _derived(text: str, goal: Goal) -> set[str]:
    """The letters of which a relation takes the rates, those of a rate that is derived among them."""
    deepest = max((_depth(node) for node in nodes(text)), default=0)
    found = _names(text) if deepest else set()
    for _ in range(deepest - 1):
        found = found | {name for letter in found for name in _names(goal.get("flow", {}).get(letter, "0"))}
    return found


def _depth(node: ast.AST) -> int:
    """How many derivatives of each other an expression is at most."""
    own = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "D"
    return own + max((_depth(part) for part in ast.iter_child_nodes(node)), default=0)


def _names(text: str) -> set[str]:
    return {node.id for node in nodes(text) if isinstance(node, ast.Name)} - {
        node.func.id for node in nodes(text) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}

"""What claims take of others beyond what those show: a premise's own assumptions, which who uses it does not state."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

from workbench.proof.checker import calls, nodes
from workbench.proof.premises import ordered
from workbench.proof.verdict import Decision

Goal = Mapping[str, Any]
RATES = "rates are as in"


def besides(decisions: Sequence[Decision]) -> dict[str, tuple[str, ...]]:
    """By the id of each proved claim what it takes of its premises and does not assume itself, as `x >= 1 (3)`.

    A premise is taken where an assumption reads as a relation that it shows. Of what it assumes only that counts whose
    symbols all stand in the claim too: others name quantities of its own. Of a rate the flow counts as well. Every
    premise of a claim is among the decisions.
    """
    by_id = {d.claim.id: d for d in decisions}
    found: dict[str, tuple[str, ...]] = {}
    shown: dict[str, set[str]] = {}  # by the id of a claim what its premises show
    for name in ordered([d.claim for d in decisions]):
        taken: dict[str, None] = {}
        premises = by_id[name].claim.premises
        shown[name] = {text for premise in premises for text in _goal(by_id[premise]).get("show", [])}
        for premise in premises:
            taken |= dict.fromkeys(_taken(_goal(by_id[name]), by_id[premise], shown, found[premise]))
        found[name] = tuple(taken)
    return {name: taken for name, taken in found.items() if taken}


def _goal(decision: Decision) -> Goal:
    return (decision.certificate or {}).get("goal", {}) if decision.verdict == "proved" else {}


def _taken(goal: Goal, premise: Decision, shown: Mapping[str, set[str]], before: tuple[str, ...]) -> list[str]:
    """What is taken of one premise; before: what that takes of the claims that it uses itself."""
    other = _goal(premise)
    used = [text for text in goal.get("assume", []) if text in other.get("show", [])]
    if not used:
        return []
    own = [text for text in goal["assume"] if text not in used]
    letters = {name for text in (*own, *goal["show"]) for name in _names(text)}
    stated = {*own, *goal.get("always", [])}
    where = f"({premise.claim.equation})"
    found = [f"{text} {where}" for text in (*other["assume"], *other.get("always", []))
             if text not in stated | shown[premise.claim.id] and _names(text) <= letters]
    found += [one for one in before if one.startswith(RATES) or (
        (text := one.rpartition(" (")[0]) not in stated and _names(text) <= letters)]
    rates = [text for text in used if calls(text, "D")]
    if any(goal.get("flow", {}).get(name, "0") != other.get("flow", {}).get(name, "0")
           for text in rates for name in _names(text)):
        found.append(f"{RATES} {where}")
    return found


def _names(text: str) -> set[str]:
    return {node.id for node in nodes(text) if isinstance(node, ast.Name)} - {
        node.func.id for node in nodes(text) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}

"""Certificates of whole theorems: the proof of each headline that stands, with the proofs of all that it uses."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from workbench.proof.checker import NAME, calls
from workbench.proof.fate import judged
from workbench.proof.verdict import Decision, Stated

Certificate = Mapping[str, Any]


def whole_theorems(decisions: Sequence[Decision]) -> list[str]:
    """The ids of the claims that prove the headlines that stand: the claim itself, or its mended form.

    decisions: those of a paper, as `judged` leaves them.
    """
    by_id = {d.claim.id: d for d in decisions}
    found = []
    for d in decisions:
        if d.fate is None or not d.fate.word.startswith("stands"):
            continue
        found.append(d.claim.id if d.verdict == "proved" else
                     next(name for name in d.fate.by if by_id[name].claim.mends == d.claim.id))
    return list(dict.fromkeys(found))


def recorded_theorems(claims: Iterable[Stated]) -> list[str]:
    """The same from what is on record, without deciding anything."""
    return whole_theorems(judged([Decision(claim, claim.recorded, "", None, 0.0) for claim in claims]))


def composed(theorem: str, claims: Mapping[str, Stated], certificates: Mapping[str, Certificate]) -> dict[str, Any]:
    """The certificate of a theorem with those of all claims of its paper that its proof uses, directly or not.

    claims: by id; certificates: by equation, as they are written. An assumption that reads as what a premise shows is
    linked to it, unless it speaks of a rate.
    """
    cited: dict[str, dict[str, str | None]] = {}
    parts: dict[str, Certificate] = {}
    waiting = [theorem]
    while waiting:
        claim = claims[waiting.pop()]
        names = [name for name in claim.premises if claims[name].paper == claim.paper]
        waiting += [name for name in names if claims[name].equation not in {**parts, **cited}]
        if claim.equation in certificates:
            parts[claim.equation] = certificates[claim.equation]
        else:
            numbers = [claims[name].equation for name in names]
            cited[claim.equation] = {name: certificates.get(name, {}).get("goal_digest") for name in numbers}
    top = claims[theorem].equation
    links = [link for name in sorted(parts) for link in _links(name, parts)]
    linked = {(link["of"], link["assume"]) for link in links}
    assumes = {name: [text for i, text in enumerate(part["goal"].get("assume", [])) if (name, i) not in linked]
               for name, part in parts.items()}
    return {**parts[top], "composition": {
        "certificates": {name: part for name, part in parts.items() if name != top}, "cited": cited, "links": links,
        "assumes": assumes}}


def _links(name: str, parts: Mapping[str, Certificate]) -> list[dict[str, Any]]:
    goal, found = parts[name]["goal"], []
    for i, text in enumerate(goal.get("assume", [])):
        for premise in sorted(parts[name].get("premises", {})):
            other = parts[premise]["goal"] if premise in parts else {}
            if text in other.get("show", []) and not calls(text, "D") and _indexed(text, goal) == _indexed(text, other):
                found.append({"of": name, "assume": i, "by": premise, "show": other["show"].index(text)})
                break
    return found


def _indexed(text: str, goal: Certificate) -> set[str]:
    return set(NAME.findall(text)) & set(goal.get("indexed", []))

"""Decide an obligation: a statement that follows from others, whatever is known of whether they can hold together.

A claim is proved only beside an instant at which all its assumptions hold. An obligation is true as well where they
exclude each other, or hold at points only that are hard to name. So its certificate may state what it follows from by
propositional logic: that fewer assumptions imply what is shown, or that some of them and its opposite exclude another.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, cast

import sympy as sp

from workbench.proof.checker import CertificateError, check, split_relation
from workbench.proof.claim import OPPOSITE, Goal, Operator, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.engine import Certificate, not_shown, proofs_of
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.method import method_of
from workbench.proof.decide.number_roots import with_root_squares
from workbench.proof.decide.reduced import reduced
from workbench.proof.decide.refute import descended_counterexample, examples, find_counterexample, quick_examples
from workbench.proof.decide.square_roots import with_roots_of_squares
from workbench.proof.decide.turned import PLACES, contradictory, exclusion_of, find_carried, find_turned, renumbered
from workbench.proof.obligation import goals_of
from workbench.proof.text import assumptions, goal_text

Proof = dict[str, Any]
MANY_TERMS = 60  # of all that is assumed and shown


@dataclass(frozen=True)
class Outcome:
    """proved, refuted or undecided, why, and the certificates: one for each goal, or that of the one that fails."""

    verdict: str
    method: str
    certificates: tuple[Certificate, ...] = ()


def decide_obligation(obligation: dict[str, Any]) -> Outcome:
    """The outcome of an obligation as `goals_of` reads it; raises ClaimError where it is none."""
    certificates: list[Certificate] = []
    methods: list[str] = []
    for goal in goals_of(obligation):
        outcome = _decided(goal)
        if outcome.verdict != "proved":
            return outcome
        certificates += outcome.certificates
        methods.append(outcome.method)
    return Outcome("proved", ", ".join(dict.fromkeys(methods)), tuple(certificates))


def belongs(obligation: dict[str, Any], verdict: str, certificates: Sequence[Certificate]) -> bool:
    """Whether certificates, each of which the checker accepts, establish the verdict on an obligation."""
    goals = goals_of(obligation)
    if any(c["verdict"] != verdict for c in certificates):
        return False
    if verdict == "refuted":
        return len(certificates) == 1 and certificates[0]["goal"] in map(goal_text, goals)
    return len(goals) == len(certificates) and all(
        c["goal"].keys() <= {"assume", "show", "indexed"} and _excluded(c["goal"]) <= _excluded(record)
        and _indexed(c["goal"]) == _names(c["goal"]) & _indexed(record)
        for record, c in zip(map(goal_text, goals), certificates, strict=True))


def _indexed(record: dict[str, Any]) -> set[str]:
    return set(record.get("indexed", []))


def _names(record: dict[str, Any]) -> set[str]:
    return {name for text in (*record["assume"], *record["show"]) for name in re.findall(r"[A-Za-z_]\w*", text)}


def _excluded(record: dict[str, Any]) -> set[str]:
    """The relations that a goal of one relation shown says not to hold all together."""
    (shown,) = record["show"]
    left, operator, right = split_relation(shown)
    return {*record["assume"], f"{left} {OPPOSITE[cast('Operator', operator)]} {right}"}


def _decided(goal: Goal) -> Outcome:
    """The outcome for one goal that shows one relation."""
    broken = find_counterexample(goal, "refuted", quick=True)
    if broken is None and (certificate := _at_once(goal)) is not None:
        return Outcome("proved", method_of(certificate["proofs"]), (certificate,))
    broken = broken or descended_counterexample(goal, "refuted")
    if broken is not None:
        return Outcome("refuted", "counterexample", (broken,))
    missing = ""
    for functions in (True, False):  # what sympy makes of Max, Min and abs the checker may have to be shown
        proof, missing = _proof(goal, functions)
        if proof is None:
            break
        certificate = _certified(goal, proof)
        if certificate is not None:
            return Outcome("proved", method_of([proof]), (certificate,))
    broken = find_counterexample(goal, "refuted")
    if broken is not None:
        return Outcome("refuted", "counterexample", (broken,))
    return Outcome("undecided", not_shown(goal, missing))


def _at_once(goal: Goal) -> Certificate | None:
    """A certificate of what the least of all searches proves, in less time than any other takes to begin."""
    usual = goal.evaluated()
    shown, given = usual.show[0], assumptions(usual)
    same = not shown.strict and shown.operator != "!=" and find_identity(usual, shown)
    proof = {"rule": "identity"} if same else find_combination(usual, shown, given, quick=True)
    return None if proof is None else _certified(goal, proof)


def _proof(goal: Goal, functions: bool = True) -> tuple[Proof | None, str]:
    """A proof of a goal's one relation, not yet checked, or None and what is missing; the cheapest search first.

    Among many terms linear programs grow faster than semidefinite ones. functions: as `Goal.evaluated` takes them.
    """
    usual = goal.evaluated(functions)
    if (found := find_carried(goal) or _reduced_proof(goal)) is not None:
        return found, ""
    if sum(len(sp.Add.make_args(sp.expand(r.margin))) for r in usual.relations()) > MANY_TERMS:
        shown, given = usual.show[0], assumptions(usual)
        found = find_combination(usual, shown, given, quick=True) or find_turned(goal, stated=True)
        if found is not None:
            return found, ""
    proofs = proofs_of(usual)
    if not isinstance(proofs, str):
        return proofs[0], "a proof was found, and no point at which all that it uses holds"
    return find_turned(goal), proofs


def _reduced_proof(goal: Goal) -> Proof | None:
    """A proof of what is shown less multiples of equalities, as one of the goal as it is stated."""
    lower = reduced(goal)
    if lower is None:
        return None
    proofs = proofs_of(lower.goal.evaluated())
    found = find_turned(lower.goal) if isinstance(proofs, str) else proofs[0]
    terms = None if found is None else contradictory(found, len(assumptions(lower.goal)), lower.goal.show[0])
    stated = None if terms is None else lower.terms_as_stated(terms)
    return None if stated is None else {"rule": "contradiction", "terms": stated}


def _certified(goal: Goal, proof: Proof) -> Certificate | None:
    """A certificate that the checker accepts, of the goal or of what it follows from."""
    as_stated = (goal, proof)
    quick = ((quick_examples, form) for form in (as_stated, *_forms(*as_stated)))
    for look, (stated, shown_by) in (*quick, (examples, as_stated)):
        record = goal_text(stated)
        proofs = with_roots_of_squares(stated, stated.evaluated(), with_root_squares(record, [shown_by]))
        for example in look(stated):
            certificate: Certificate = {"version": 1, "verdict": "proved", "goal": record, **example,
                                        "proofs": proofs}
            try:
                check(certificate)
            except CertificateError:
                continue
            return certificate
    return None


def _forms(goal: Goal, proof: Proof) -> Iterator[tuple[Goal, Proof]]:
    """What the goal follows from, with its proof: of what a proof takes together, all but one exclude that one.

    First with what the proof names alone, then with all that is assumed.
    """
    whole = exclusion_of(goal)
    last = len(whole.relations) - 1
    terms = contradictory(proof, last, goal.show[0])
    if terms is None:  # the assumptions alone may exclude each other
        alone = find_combination(goal.evaluated(), greater(0, 0), assumptions(goal.evaluated()), quick=True)
        if alone is None:
            return
        terms = alone["terms"]
    named = sorted({item[key] for term in terms for item in term["factors"] for key in PLACES if key in item})
    for kept in (named, list(range(last + 1))):
        for turned in reversed(kept):
            form, order = whole.without(turned, kept)
            new = {old: place for place, old in enumerate(order)}
            yield form, {"rule": "contradiction", "terms": renumbered(terms, new)}

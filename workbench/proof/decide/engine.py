"""Decide a claim: try to prove it, else to break it; a verdict counts only with a certificate that checks."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import FAILED, Claim, D, Decision, Goal, Relation, Verdict, at_least, latex, name_of
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.refute import find_counterexample, find_example, value_at
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import assumptions, goal_text, relation_text, text

Certificate = dict[str, Any]


def decide(claim: Claim) -> Decision:
    """The verdict on one claim, with its certificate; tainting is added by `decide_all`."""
    started = time.perf_counter()
    if claim.build is None:
        return Decision(claim, "assumed", claim.axiom or "", None, time.perf_counter() - started)
    goal = _goal(claim)
    decision = _decide_statement(claim, goal) if claim.at is None else _decide_condition(claim, goal)
    return replace(decision, seconds=time.perf_counter() - started)


def _goal(claim: Claim) -> Goal:
    """The claim's goal; what is wrong with it is said with the claim's id."""
    assert claim.build is not None
    try:
        goal: object = claim.build()
    except ClaimError as trouble:
        raise ClaimError(f"claim {claim.id}: {trouble}") from None
    except Exception as trouble:
        what = " ".join(f"{type(trouble).__name__}: {trouble}".split())
        raise ClaimError(f"claim {claim.id}: its goal cannot be made: {what}") from trouble
    if not isinstance(goal, Goal):
        raise ClaimError(f"claim {claim.id}: its function returns no Goal: end it with 'return Goal(...)'")
    return goal


def _decide_statement(claim: Claim, goal: Goal) -> Decision:
    proof = prove_goal(goal)
    if proof is not None:
        certificate, method = proof
        return Decision(claim, "proved", method, "exact", 0.0, {"claim": claim.id, **certificate})
    verdict: Verdict = "gap" if claim.kind in ("implication", "limit") else "refuted"
    certificate_or_none = find_counterexample(goal, verdict)
    if certificate_or_none is None:
        return Decision(claim, "undecided", "identity, combination and point search found nothing", None, 0.0)
    certificate = {"claim": claim.id, **certificate_or_none}
    point = certificate.get("functions", {}) | certificate["point"]
    correction = None
    if claim.correction is not None:
        repaired = prove_goal(claim.correction())
        if repaired is None:
            raise ClaimError(f"claim {claim.id}: its correction could not be proved: state a true one")
        certificate["correction"] = {k: v for k, v in repaired[0].items() if k not in ("version", "verdict")}
        correction = claim.corrected_statement or claim.correction().show[0].latex()
        check(certificate)
    return Decision(claim, verdict, "counterexample", "exact", 0.0, certificate, point, correction,
                    None if goal.eventually else value_at(goal, certificate["point"]))


def _decide_condition(claim: Claim, goal: Goal) -> Decision:
    """A condition at stated parameters: the values decide, exactly."""
    stated = {name_of(s): str(v) for s, v in (claim.at or {}).items()}
    record = goal_text(goal)
    try:
        falsified: Certificate = {"claim": claim.id, "version": 1, "verdict": "violated", "goal": record,
                                  "point": stated}
        check(falsified)
    except CertificateError as trouble:
        if "the goal holds" not in str(trouble):
            raise ClaimError(f"claim {claim.id}: the stated parameters do not fit the goal: {trouble}") from None
        proof = prove_goal(pinned(goal, claim.at or {}))
        if proof is None:
            return Decision(claim, "undecided", "holds at the stated values, but no proof was found", None, 0.0)
        return Decision(claim, "proved", f"exact evaluation at the stated values; {proof[1]}", "exact", 0.0,
                        {"claim": claim.id, **proof[0]}, computed=value_at(goal, stated))
    correction = None
    if claim.repair is not None:
        repaired = prove_goal(pinned(goal, claim.repair))
        if repaired is None:
            raise ClaimError(f"claim {claim.id}: its repair could not be proved: give values that meet it")
        falsified["repair"] = {k: v for k, v in repaired[0].items() if k not in ("version", "verdict")}
        correction = ",\\ ".join(f"{latex(s)} = {_fraction(v)}" for s, v in claim.repair.items())
        check(falsified)
    return Decision(claim, "violated", "exact evaluation at the stated values", "exact", 0.0, falsified, stated,
                    correction, value_at(goal, stated))


def pinned(goal: Goal, values: dict[Any, Fraction]) -> Goal:
    """The goal with symbols replaced by values; assumptions that become plain facts stay, to be checked."""
    if goal.initial or goal.eventually is not None:
        raise ClaimError("stated values decide a condition of one instant: it has no initial values or later times")
    for s, v in values.items():
        if (s.is_positive and v <= 0) or (s.is_nonnegative and v < 0):
            raise ClaimError(f"{s} = {v} contradicts the sign of its symbol")
    exact = {s: sp.Rational(v.numerator, v.denominator) for s, v in values.items()}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        # Derivatives first: D of a symbol that has become a number would be zero.
        carried = (Relation(expand_derivatives(r.left, goal.flow), r.operator, expand_derivatives(r.right, goal.flow))
                   for r in relations)
        return tuple(r.subs(exact) for r in carried)

    return replace(goal, show=put(goal.show), assume=put(goal.assume), always=put(goal.always), flow={},
                   lemmas=put(goal.lemmas), facts=tuple(f.xreplace(exact) for f in goal.facts))


def prove_goal(goal: Goal) -> tuple[Certificate, str] | None:
    """A checked certificate of verdict `proved` and the method that found it, or None."""
    if goal.eventually is not None:
        return None
    proofs, methods = [], []
    for shown in goal.show:
        found = _prove_relation(goal, shown)
        if found is None:
            return None
        proofs.append(found[0])
        methods.append(found[1])
    example = find_example(goal)
    if example is None:
        return None
    certificate: Certificate = {"version": 1, "verdict": "proved", "goal": goal_text(goal), "example": example,
                                "proofs": proofs}
    try:
        check(certificate)
    except CertificateError:
        return None
    return certificate, ", ".join(dict.fromkeys(methods))


def _prove_relation(goal: Goal, shown: Relation) -> tuple[dict[str, Any], str] | None:
    if shown.operator in ("==", ">=", "<=") and find_identity(goal, shown):
        return {"rule": "identity"}, "identity"
    if goal.decreasing is not None:
        return _by_decrease(goal, shown)
    given = assumptions(goal)
    steps: list[tuple[Relation, dict[str, Any]]] = []
    for lemma in (*goal.lemmas, *_signs_of_logs((shown, *given))):
        known = tuple(r for r, _ in steps)
        # Only what shares a symbol with the lemma is offered, so that side lemmas stay cheap; positions stay.
        near = tuple(r if lemma.margin.free_symbols & r.margin.free_symbols else _EMPTY for r in (*given, *known))
        proof = find_combination(goal, lemma, near)
        if proof is not None:
            steps.append((lemma, proof))
    final = find_combination(goal, shown, (*given, *(r for r, _ in steps)))
    if final is None:
        return None
    method = "lemmas and combination" if steps else "combination"
    for lemma, proof in reversed(steps):
        final = {"rule": "cut", "lemma": relation_text(lemma), "proof": proof, "then": final}
    return final, method


def _signs_of_logs(relations: tuple[Relation, ...]) -> list[Relation]:
    """log A >= 0 for every logarithm in the relations: worth trying as a lemma."""
    logs = sorted({log for r in relations for log in r.margin.atoms(sp.log)}, key=sp.default_sort_key)
    return [at_least(log, 0) for log in logs if relations[0].margin != log]


def _by_decrease(goal: Goal, shown: Relation) -> tuple[dict[str, Any], str] | None:
    """A bound from a function that does not increase along the flow."""
    function = sp.Add(goal.decreasing)
    # As the checker will see it: assumptions of the moving symbols emptied, those that always hold appended.
    moving = {s for s, rate in goal.flow.items() if rate != 0}
    moving |= {s for rate in goal.flow.values() for s in rate.free_symbols} - set(goal.flow)
    given = assumptions(goal)
    kept = tuple(_EMPTY if r.margin.free_symbols & moving else r for r in given)
    decrease = find_combination(goal, at_least(-D(function), 0), (*kept, *goal.always))
    start = function.xreplace(goal.initial)
    final = find_combination(goal, shown, (*given, at_least(start, function)))
    if decrease is None or final is None:
        return None
    return {"rule": "nonincreasing", "function": text(function), "decrease": decrease, "then": final}, (
        "a function that does not increase, and combination")


_EMPTY = at_least(0, 0)


def _fraction(value: Fraction) -> str:
    return str(value.numerator) if value.denominator == 1 else rf"\frac{{{value.numerator}}}{{{value.denominator}}}"


def decide_all(claims: list[Claim], on_progress: Callable[[int], None] = lambda done: None) -> list[Decision]:
    """Decide claims and carry failures along the premises; on_progress(claims decided) after each.

    Raises ClaimError for ids used twice and for a premise that is no claim.
    """
    by_id = {claim.id: claim for claim in claims}
    if len(by_id) != len(claims):
        twice = sorted({c.id for c in claims if sum(d.id == c.id for d in claims) > 1})
        raise ClaimError(f"claim ids used twice: {', '.join(twice)}: give each claim its own id")
    for claim in claims:
        for premise in claim.premises:
            if premise not in by_id:
                raise ClaimError(f"claim {claim.id}: premise '{premise}' is no claim: state it or correct the id")
    for claim in claims:
        if claim.id in _closure(claim, by_id):
            raise ClaimError(f"claim {claim.id}: rests on itself through its premises: break the circle")
    decisions: dict[str, Decision] = {}
    for claim in claims:
        decisions[claim.id] = decide(claim)
        on_progress(len(decisions))
    return [replace(d, tainted_by=_taint(d.claim, by_id, decisions)) for d in decisions.values()]


def _taint(claim: Claim, by_id: dict[str, Claim], decisions: dict[str, Decision]) -> tuple[str, ...]:
    below = _closure(claim, by_id)
    return tuple(c for c in by_id if c in below and decisions[c].verdict in FAILED)


def _closure(claim: Claim, by_id: dict[str, Claim]) -> set[str]:
    """The ids of all claims it rests on, directly or not."""
    seen: set[str] = set()
    open_ids = list(claim.premises)
    while open_ids:
        current = open_ids.pop()
        if current not in seen:
            seen.add(current)
            open_ids += by_id[current].premises
    return seen

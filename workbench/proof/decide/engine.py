"""Decide a claim: try to prove it, else to break it; a verdict counts only with a certificate that checks."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from workbench.errors import ClaimError
from workbench.proof.building import built
from workbench.proof.checker import CertificateError, check, roots_of
from workbench.proof.claim import Claim, Decision, Goal, Verdict, latex, name_of
from workbench.proof.decide.cuts import after
from workbench.proof.decide.first_lemmas import definedness_of_goal
from workbench.proof.decide.method import method_of
from workbench.proof.decide.nearest import smallest_margin
from workbench.proof.decide.number_roots import with_root_squares
from workbench.proof.decide.refute import examples, find_counterexample, shown_point, value_at
from workbench.proof.decide.search import prove_relation
from workbench.proof.decide.square_roots import with_roots_of_squares
from workbench.proof.decide.symbol_roots import with_squares_of_roots
from workbench.proof.decide.undefined import undefined_somewhere
from workbench.proof.decide.weaker_signs import with_weaker_signs
from workbench.proof.fate import judged
from workbench.proof.latex.goal import goal_latex
from workbench.proof.latex.match import match_claim
from workbench.proof.names import in_key_order, names_in
from workbench.proof.pinned import pinned
from workbench.proof.premises import premises_problem
from workbench.proof.text import goal_text, relation_text

Certificate = dict[str, Any]
LONGEST_LINE = 160  # of a relation in a sentence


def decide(claim: Claim) -> Decision:
    """The verdict on one claim, with its certificate; tainting is added by `decide_all`."""
    started = time.perf_counter()
    if claim.build is None:
        verdict: Verdict = "undecided" if claim.axiom is None else "assumed"
        return Decision(claim, verdict, claim.axiom or claim.unstated or "", None, time.perf_counter() - started)
    goal = built(claim, claim.build)
    decision = _decide_statement(claim, goal) if claim.at is None else _decide_condition(claim, goal)
    return with_match(claim, replace(decision, seconds=time.perf_counter() - started))


def with_match(claim: Claim, decision: Decision) -> Decision:
    """The decision with the goal as a reader sees it, what its letters stand for, and whether a machine finds it in the
    printed line."""
    if claim.build is None:
        return decision
    goal = built(claim, claim.build)
    named = names_in(decision.certificate)
    return replace(decision, match="parsed" if match_claim(claim, goal).parsed else None, goal=goal_latex(goal),
                   letters={name: text for name, text in claim.letters.items() if {name, f"{name}_dot"} & named})


def _decide_statement(claim: Claim, goal: Goal) -> Decision:
    verdict = verdict_of_failure(claim)
    certificate_or_none = find_counterexample(goal, verdict, quick=True)  # a search of a proof would be in vain
    proof: Certificate | str = ""
    if certificate_or_none is None:
        proof = undefined_somewhere(goal) or attempted_proof(goal)
    if not isinstance(proof, str):
        return shown_by(claim, goal, {"claim": claim.id, **proof})
    certificate_or_none = certificate_or_none or find_counterexample(goal, verdict)
    if certificate_or_none is None:
        return Decision(claim, "undecided", not_shown(goal, proof), None, 0.0)
    certificate = {"claim": claim.id, **certificate_or_none}
    if claim.correction is not None:
        repaired = prove_goal(built(claim, claim.correction, "correction"))
        if repaired is None:
            raise ClaimError(f"claim {claim.id}: its correction could not be proved: state a true one")
        certificate["correction"] = {k: v for k, v in repaired.items() if k not in ("version", "verdict")}
        check(certificate)
    return shown_by(claim, goal, certificate)


def _decide_condition(claim: Claim, goal: Goal) -> Decision:
    """A condition at stated parameters: the values decide, exactly."""
    falsified: Certificate = {"claim": claim.id, "version": 1, "verdict": "violated", "goal": goal_text(goal),
                              "point": _stated_values(claim)}
    try:
        check(falsified)
    except CertificateError as trouble:
        if "the goal holds" not in str(trouble):
            raise ClaimError(f"claim {claim.id}: the stated parameters do not fit the goal: {trouble}") from None
        proof = attempted_proof(pinned(goal, claim.at or {}))
        if isinstance(proof, str):
            return Decision(claim, "undecided", f"holds at the stated values, but {proof}", None, 0.0)
        return shown_by(claim, goal, {"claim": claim.id, **proof})
    if claim.repair is not None:
        repaired = prove_goal(pinned(goal, claim.repair))
        if repaired is None:
            raise ClaimError(f"claim {claim.id}: its repair could not be proved: give values that meet it")
        falsified["repair"] = {k: v for k, v in repaired.items() if k not in ("version", "verdict")}
        check(falsified)
    return shown_by(claim, goal, falsified)


def verdict_of_failure(claim: Claim) -> Verdict:
    """What a claim is called that does not hold."""
    if claim.at is not None:
        return "violated"
    return "gap" if claim.kind in ("implication", "limit") and not claim.closed_loop else "refuted"


def shown_by(claim: Claim, goal: Goal, certificate: Certificate) -> Decision:
    """The decision on a claim that a certificate of it shows, which the checker has accepted."""
    certificate = in_key_order(certificate)  # a found one is told in the same order as one that was kept
    verdict: Verdict = certificate["verdict"]
    at_values = "exact evaluation at the stated values"
    if verdict == "proved":
        method = method_of(certificate["proofs"])
        if claim.at is None:
            return Decision(claim, verdict, method, "exact", 0.0, certificate)
        return Decision(claim, verdict, f"{at_values}; {method}", "exact", 0.0, certificate,
                        computed=value_at(goal, _stated_values(claim)))
    point, correction = _in_order(shown_point(certificate), goal), None
    if claim.at is None and claim.correction is not None:
        nearest = built(claim, claim.correction, "correction")
        correction = claim.corrected_statement or nearest.show[0].latex()
    if claim.at is not None and claim.repair is not None:
        correction = ",\\ ".join(f"{latex(s)} = {_fraction(v)}" for s, v in claim.repair.items())
    computed = None if goal.eventually else value_at(
        goal, certificate["point"], certificate.get("terms"), roots_of(certificate))
    return Decision(claim, verdict, "counterexample" if claim.at is None else at_values, "exact", 0.0, certificate,
                    point, correction, computed)


def _in_order(point: dict[str, str], goal: Goal) -> dict[str, str]:
    """Values as they are shown: first of what moves, as the goal states it, the others by name."""
    moving = [name_of(s) for s in goal.flow]
    rest = sorted(point.keys() - set(moving))
    return {name: point[name] for name in (*moving, *rest) if name in point}


def _stated_values(claim: Claim) -> dict[str, str]:
    return {name_of(s): str(v) for s, v in (claim.at or {}).items()}


def prove_goal(goal: Goal) -> Certificate | None:
    """A checked certificate of verdict `proved`, or None."""
    found = attempted_proof(goal)
    return None if isinstance(found, str) else found


def attempted_proof(goal: Goal) -> Certificate | str:
    """A checked certificate of verdict `proved`, or what was not shown."""
    if goal.eventually is not None:
        return "a claim of some later time is proved by naming that time"
    record, missing = goal_text(goal), ""
    for functions in (True, False):  # what sympy makes of Max, Min and abs the checker may have to be shown
        usual = goal.evaluated(functions)
        found = proofs_of(usual)
        if isinstance(found, str):
            return missing or found
        shown = goal_text(usual)["show"]
        certificate, missing = _accepted(goal, record, with_roots_of_squares(
            goal, usual, with_squares_of_roots(record, shown, with_root_squares(record, found))))
        # Of the goal as it is typed too: what sympy cancels must have a value all the same.
        for one in (usual, goal) if certificate is None and "not shown" in missing else ():
            first = definedness_of_goal(one) if certificate is None else []
            more = proofs_of(replace(usual, assume=(*usual.assume, *(lemma for lemma, _ in first)))) if first else ""
            if not isinstance(more, str):
                certificate, missing = _accepted(goal, record, [
                    after(first, proof) for proof in with_squares_of_roots(record, shown, more, len(first))])
        if certificate is None and "add up" in missing and (weaker := with_weaker_signs(usual)) is not None:
            more = proofs_of(weaker)
            if not isinstance(more, str):
                certificate, missing = _accepted(goal, record, more)
        if certificate is not None:
            return certificate
    return missing


def _accepted(goal: Goal, record: dict[str, Any], proofs: list[dict[str, Any]]) -> tuple[Certificate | None, str]:
    """The certificate with an example at which the checker accepts it, else what is missing."""
    missing = "no instant was found at which all assumptions hold: they may contradict each other"
    for example in examples(goal):
        certificate: Certificate = {"version": 1, "verdict": "proved", "goal": record, **example, "proofs": proofs}
        try:
            check(certificate)
        except CertificateError as trouble:
            missing = f"a proof was found that the checker does not accept: {trouble}"
            if "example" not in str(trouble):
                break
        else:
            return certificate, ""
    return None, missing


def proofs_of(goal: Goal) -> list[dict[str, Any]] | str:
    """A proof of each relation that the goal shows, not yet checked; or what was not shown."""
    proofs = []
    for place, shown in enumerate(goal.show):
        found = prove_relation(goal, shown)
        if found is None:
            of = f" (relation {place + 1} of {len(goal.show)})" if len(goal.show) > 1 else ""
            return f"not shown{of}: {_shortened(relation_text(shown))}"
        proofs.append(found)
    return proofs


def not_shown(goal: Goal, missing: str) -> str:
    """Why a goal is undecided: what is missing, and what came nearest to a decision."""
    if missing.startswith(("a proof", "undefined")) or goal.eventually is not None:
        return missing
    return f"{missing}; {smallest_margin(goal)}"


def _shortened(line: str) -> str:
    return line if len(line) <= LONGEST_LINE else f"{line[:LONGEST_LINE]}..."


def _fraction(value: Fraction) -> str:
    if value.denominator == 1:
        return str(value.numerator)
    return rf"{'-' if value < 0 else ''}\frac{{{abs(value.numerator)}}}{{{value.denominator}}}"


def decide_all(claims: list[Claim], on_progress: Callable[[int], None] = lambda done: None) -> list[Decision]:
    """Decide claims and carry failures along the paper's chains; on_progress(claims decided) after each.

    Raises ClaimError for ids used twice and for a premise that is no claim.
    """
    problem = premises_problem(claims)
    if problem is not None:
        raise ClaimError(problem[1])
    decisions = []
    for claim in claims:
        decisions.append(decide(claim))
        on_progress(len(decisions))
    return judged(decisions)

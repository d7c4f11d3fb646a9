"""The digest of a claim's goal, made from the claim alone: what a certificate must be of."""

from __future__ import annotations

from typing import Any

from workbench.errors import WorkbenchError
from workbench.proof.building import built
from workbench.proof.checker import digest_of
from workbench.proof.claim import Claim, Goal, Verdict, name_of
from workbench.proof.pinned import pinned
from workbench.proof.text import goal_text


def stated_digest(claim: Claim, verdict: Verdict) -> str | None:
    """The goal digest that a certificate of the claim with this verdict must have; None where it has no certificate.

    Raises ClaimError where the claim's goal cannot be made.
    """
    if claim.build is None or verdict not in ("proved", "refuted", "violated", "gap"):
        return None
    goal = built(claim, claim.build)
    return digest_of({"claim": claim.id, "verdict": verdict, **_parts(claim, goal, verdict)})


def _parts(claim: Claim, goal: Goal, verdict: Verdict) -> dict[str, Any]:
    """What beside name and verdict a certificate of the claim states, as the deciders state it."""
    if verdict == "proved":
        return {"goal": goal_text(goal if claim.at is None else pinned(goal, claim.at))}
    parts: dict[str, Any] = {"goal": goal_text(goal)}
    if verdict == "violated":
        parts["point"] = {name_of(s): str(value) for s, value in (claim.at or {}).items()}
        if claim.repair is not None:
            parts["repair"] = goal_text(pinned(goal, claim.repair))
    elif claim.correction is not None:
        parts["correction"] = goal_text(built(claim, claim.correction, "correction"))
    return parts


def is_of(certificate_digest: str, claim: Claim, verdict: Verdict) -> bool:
    """Whether a goal digest is the one of this claim; not so where the claim's goal cannot be made."""
    try:
        return stated_digest(claim, verdict) == certificate_digest
    except WorkbenchError:
        return False

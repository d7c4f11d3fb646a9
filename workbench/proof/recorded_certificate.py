"""Certificates that lie with a paper: where a search would end, the checker says in less time whether it has."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from workbench.files.folders import certificates_folder
from workbench.files.regular import contents
from workbench.proof.building import built
from workbench.proof.checker import CertificateError, check, exact_json, goal_digest
from workbench.proof.claim import Claim, Decision
from workbench.proof.claim_digest import is_of
from workbench.proof.decide.engine import shown_by, verdict_of_failure, with_match

Certificate = dict[str, Any]
# What deciders state; what the writing of a certificate adds is left out, and so is whatever else a file may say.
PARTS = ("claim", "version", "verdict", "goal", "example", "proofs", "point", "terms", "always", "path", "time",
         "duration", "functions", "fails", "correction", "repair")


def recorded_certificate(path: Path, claim: Claim) -> Certificate | None:
    """What lies where the certificate of a claim of this paper's folder or proof file is written; None where that is
    none. Nothing of it is believed yet."""
    try:
        found = exact_json(contents(certificates_folder(path, claim.paper) / f"{claim.equation}.json").decode())
    except (OSError, ValueError, RecursionError, CertificateError):
        return None
    return {name: found[name] for name in PARTS if name in found} | {"version": 1} if isinstance(found, dict) else None


def decided_by(claim: Claim, certificate: Certificate) -> Decision | None:
    """The decision that a certificate shows; None unless the checker accepts it and it is of this claim's goal, with
    the verdict that a search would come to."""
    started = time.perf_counter()
    if claim.build is None:
        return None
    try:
        if certificate["verdict"] not in ("proved", verdict_of_failure(claim)) or not is_of(
                goal_digest(certificate), claim, certificate["verdict"]):
            return None
        check(certificate)
    except (CertificateError, KeyError, TypeError, ValueError, AttributeError, RecursionError):
        return None
    decision = shown_by(claim, built(claim, claim.build), certificate)
    return with_match(claim, replace(decision, seconds=time.perf_counter() - started))

"""What is done to a proof file where its claims are decided: in this process, or in one of several others."""

from __future__ import annotations

from dataclasses import fields, replace
from functools import cache
from pathlib import Path
from typing import Any, Literal

from workbench.errors import InputError, OutOfTime, WorkbenchError
from workbench.files.time_limit import at_most_seconds, out_of_time
from workbench.proof.cache import DecisionCache, decision_cache
from workbench.proof.checker import CertificateError, check, goal_digest
from workbench.proof.claim import Claim
from workbench.proof.claim_digest import is_of
from workbench.proof.decide.engine import decide, with_match
from workbench.proof.dependencies import watch
from workbench.proof.fingerprint import fingerprint
from workbench.proof.loading import ProofFile
from workbench.proof.messages import Decided, Listing
from workbench.proof.paper import papers_in
from workbench.proof.recorded_certificate import decided_by, recorded_certificate
from workbench.proof.verdict import Decision, Stated

How = Literal["cache", "certificate", "search"]
Certificate = dict[str, Any]


class Worker:
    """Lists and decides the claims of proof files, each file imported once."""

    def __init__(self, cached: DecisionCache | None, limit: float | None = None) -> None:
        watch()
        self.limit = limit
        # Deciders that were changed while this process imported them are nobody's: nothing is kept of them.
        self.cached = cached if cached is None or decision_cache() == cached else None
        self.files: dict[Path, ProofFile] = {}

    def listing(self, path: Path) -> Listing:
        """What the file states; raises InputError when it cannot be imported."""
        papers = papers_in(self._file(path))
        return Listing(len(papers), tuple(_stated(c) for paper in papers for c in paper.claims), self._reads(path))

    def decided(self, path: Path, claim_id: str) -> Decided:
        """One claim of the file decided, or why it states nothing that could be.

        Raises InputError when the file cannot be imported.
        """
        claim = next(c for paper in papers_in(self._file(path)) for c in paper.claims if c.id == claim_id)
        recorded = recorded_certificate(path, claim) if self.cached else None
        try:
            with self._file(path).at_home(), at_most_seconds(self.limit):
                decision, how = self._decision(claim, recorded)
        except OutOfTime:
            return self._without_verdict(path, claim, out_of_time(self.limit), None)
        except WorkbenchError as trouble:
            named = "" if claim_id in str(trouble) else f"claim {claim_id}: "
            return self._without_verdict(path, claim, "misstated", str(InputError(path, "", f"{named}{trouble}")))
        except Exception as trouble:
            what = " ".join(f"{type(trouble).__name__}: {trouble}".split())
            fails = InputError(path, "", f"claim {claim_id}: the deciders fail on it ({what}): "
                                         "state it in another form, in smaller steps if it is long")
            return self._without_verdict(path, claim, "misstated", str(fails))
        return Decided(replace(decision, claim=_stated(claim)), how != "cache", self._reads(path),
                       certified=how == "certificate")

    def _without_verdict(self, path: Path, claim: Claim, method: str, misstated: str | None) -> Decided:
        return Decided(Decision(_stated(claim), "undecided", method, None, 0.0), True, self._reads(path), misstated,
                       lasting=False)

    def _decision(self, claim: Claim, recorded: Certificate | None) -> tuple[Decision, How]:
        # Each goal is made once, although the fingerprint needs it too.
        claim = replace(claim, build=cache(claim.build) if claim.build else None,
                        correction=cache(claim.correction) if claim.correction else None)
        key = fingerprint(claim) if self.cached and claim.build else None
        if self.cached is None or key is None:
            return decide(claim), "search"
        found = self.cached.claim(key)
        if found is not None and _holds(found, claim):
            return with_match(claim, found), "cache"
        shown = None if recorded is None else decided_by(claim, recorded)
        decision = shown or decide(claim)
        self.cached.keep_claim(key, replace(decision, claim=_stated(claim)))
        return decision, "search" if shown is None else "certificate"

    def _file(self, path: Path) -> ProofFile:
        if path not in self.files:
            self.files[path] = ProofFile(path)
        return self.files[path]

    def _reads(self, path: Path) -> frozenset[str]:
        return self._file(path).reads(self.cached.folder) if self.cached else frozenset()


def _holds(decision: Decision, claim: Claim) -> bool:
    """Whether a decision from the cache is of that claim and its goal, and carries what its verdict must carry."""
    certificate = decision.certificate
    if certificate is None:
        return decision.verdict == "undecided"
    try:
        check(certificate)
        return certificate["verdict"] == decision.verdict and is_of(goal_digest(certificate), claim, decision.verdict)
    except (CertificateError, KeyError, TypeError):
        return False


def _stated(claim: Claim) -> Stated:
    return Stated(**{f.name: getattr(claim, f.name) for f in fields(Stated)})

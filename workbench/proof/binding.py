"""Whether the certificates in a folder are of the claims of their paper."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from workbench.errors import WorkbenchError
from workbench.files.text import read_text
from workbench.proof.checker import MANIFEST, THEOREMS, CertificateError, Row, read_manifest
from workbench.proof.claim import Claim
from workbench.proof.claim_digest import stated_digest
from workbench.proof.loading import ProofFile
from workbench.proof.paper import papers_in
from workbench.proof.whole_theorem import recorded_theorems


def check_claims(place: Path, path: Path) -> tuple[list[Row], int]:
    """Hold the manifest in a folder of certificates against the claims of its paper: a row for whatever differs, and
    how many certificates are of the goals of their claims. Raises InputError where the paper cannot be imported."""
    file = ProofFile(path)
    try:
        manifest = read_manifest(place / MANIFEST)
    except CertificateError as trouble:
        unread = f"{trouble} (the claims of {path} need one)" if (place / MANIFEST).exists() else (
            f"is missing: run 'workbench prove {path} --write'")
        return [(place / MANIFEST, "?", unread)], 0
    claims = {claim.equation: claim for paper in papers_in(file) if paper.name == manifest.paper
              for claim in paper.claims}
    rows: list[Row] = [(place / f"{name}.json", str(entry["verdict"]), f"{path} states no such claim")
                       for name, entry in manifest.claims.items() if name not in claims]
    bound = 0
    with file.at_home():
        for name, claim in claims.items():
            entry = manifest.claims.get(name)
            reason = _difference(claim, entry) or _other_premises(claim, place / f"{name}.json")
            if reason is not None:
                rows.append((place / f"{name}.json", str(entry["verdict"]) if entry else "?", reason))
            bound += entry is not None and reason is None and entry["certificate"] is not None
    found, count = _whole_theorems(place / THEOREMS, claims)
    return rows + found, bound + count


def _whole_theorems(place: Path, claims: Mapping[str, Claim]) -> tuple[list[Row], int]:
    """A row for every theorem of a paper, by its claims, that stands on record and has no certificate as a whole, for
    every one that does not, and for what cites other hypotheses than its claim; and how many are as they should be."""
    own = {claim.id for claim in claims.values()}
    if any(name not in own for claim in claims.values() for name in (*claim.premises, *claim.chain)):
        return [], 0  # what another paper shows is not at hand here
    stated = {place / f"{name.partition(':')[2]}.json" for name in recorded_theorems(claims.values())}
    written = {path for path in place.glob("*.json") if path.name != MANIFEST}
    missing = "the theorem stands, and its certificate as a whole is missing: run 'workbench prove --write' again"
    rows: list[Row] = [(path, "?", missing) for path in sorted(stated - written)]
    rows += [(path, "proved", "no headline statement stands by it") for path in sorted(written - stated)]
    for path in sorted(stated & written):
        try:
            cited = json.loads(read_text(path, "JSON"))["composition"]["cited"]
        except (ValueError, KeyError, TypeError, RecursionError, WorkbenchError):
            continue  # said where the certificate itself is checked
        rows += [(path, "proved", f"cites {other} with other hypotheses than the paper")
                 for other, hypotheses in cited.items() if other not in claims
                 or set(hypotheses) != {one.partition(":")[2] for one in claims[other].premises}]
    return rows, len((stated & written) - {path for path, *_ in rows})


def _other_premises(claim: Claim, path: Path) -> str | None:
    """What a certificate that proves the claim uses other than the claim states; None where they agree."""
    if claim.recorded != "proved":
        return None
    own = [name for paper, _, name in (one.partition(":") for one in claim.premises) if paper == claim.paper]
    try:
        stated = json.loads(read_text(path, "JSON")).get("premises", {})
    except (ValueError, AttributeError, RecursionError, WorkbenchError):
        return None  # said where the certificate itself is checked
    return None if sorted(stated) == sorted(own) else (
        f"uses the premises {', '.join(sorted(stated)) or 'none'}, the claim {', '.join(sorted(own)) or 'none'}")


def _difference(claim: Claim, entry: dict[str, Any] | None) -> str | None:
    """What a manifest says other than the claim; None where they agree."""
    if entry is None:
        return f"{MANIFEST} does not name this claim of the paper: run 'workbench prove' again"
    if entry["verdict"] != claim.recorded:
        return f"the paper records {claim.recorded!r}, {MANIFEST} says {entry['verdict']!r}"
    try:
        stated = stated_digest(claim, claim.recorded)
    except WorkbenchError as trouble:
        return f"the claim's goal cannot be made: {trouble}"
    return None if stated == entry["goal_digest"] else "is of another goal than the one that the paper's claim states"

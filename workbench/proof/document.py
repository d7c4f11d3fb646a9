"""Decisions as the stable JSON document, and certificates as files."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.proof.verdict import VERDICTS, Decision


def certificate_path(decision: Decision, folder: Path) -> Path:
    """Where a decision's certificate stands below a folder: <paper>/<equation>.json."""
    return folder / decision.claim.paper / f"{decision.claim.equation}.json"


def certificate_text(decision: Decision) -> str:
    """The certificate as readable text with fixed bytes."""
    return json.dumps(decision.certificate, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def write_certificates(decisions: Sequence[Decision], folder: Path, whole_papers: bool = True) -> None:
    """Write every certificate below a folder, and drop those that are no longer made: of these claims, and where
    the decisions are of whole papers, of claims that these no longer state.

    Raises InputError where nothing can be written.
    """
    wanted = {certificate_path(d, folder): certificate_text(d) for d in decisions if d.certificate}
    found = {certificate_path(d, folder) for d in decisions}
    if whole_papers:
        found |= {path for paper in {d.claim.paper for d in decisions} for path in (folder / paper).glob("*.json")}
    try:
        for stale in found - wanted.keys():
            stale.unlink(missing_ok=True)
        for path, text in wanted.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                path.write_text(text, encoding="utf-8")
    except OSError as trouble:
        raise InputError(trouble.filename or folder, "", f"cannot be written ({trouble.strerror}): name another folder "
                                                         "by --certificates") from None


def claims_document(decisions: Sequence[Decision], folder: Path) -> dict[str, Any]:
    """The document of `workbench prove --json`; other programs read it."""
    rows = []
    for d in decisions:
        claim = d.claim
        rows.append({
            "id": claim.id, "paper": claim.paper, "equation": claim.equation, "kind": claim.kind,
            "statement": claim.statement, "verdict": d.verdict, "method": d.method, "scope": claim.scope,
            "certificate": str(certificate_path(d, folder)) if d.certificate else None,
            "counterexample": d.counterexample, "correction": d.correction,
            "premises": list(claim.premises), "tainted_by": list(d.tainted_by), "trust": d.trust,
            "seconds": round(d.seconds, 3), "title": claim.title, "note": claim.note,
            "recorded": claim.recorded, "computed": d.computed,
        })
    return {"version": 1, "claims": rows,
            "summary": {v: sum(d.verdict == v for d in decisions) for v in VERDICTS}}

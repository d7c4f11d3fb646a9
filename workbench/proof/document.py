"""Decisions as the stable JSON document, and certificates as files."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.errors import InputError
from workbench.files.cache_folder import write_whole
from workbench.proof.verdict import VERDICTS, Decision, Stated, is_equation

if TYPE_CHECKING:
    from workbench.proof.prove import Proof

CERTIFICATES = "certificates"


MANIFEST = "manifest.json"


@dataclass(frozen=True)
class Places:
    """Where certificates lie: <below>/<paper>/<equation>.json, or of papers named in `own` in that folder."""

    below: Path
    own: Mapping[str, Path] = field(default_factory=dict)

    def folder(self, paper: str) -> Path:
        """The folder of a paper's certificates."""
        return self.own.get(paper, self.below / paper)

    def path(self, claim: Stated) -> Path:
        """Where a claim's certificate stands."""
        return self.folder(claim.paper) / f"{claim.equation}.json"


def places(proof: Proof, chosen: Path | None) -> Places:
    """Below the folder that is chosen, else in the papers' own folders, of a single proof file beside it."""
    if chosen is not None:
        return Places(chosen)
    return Places(Path(CERTIFICATES), {
        paper: path / CERTIFICATES if path.is_dir() else path.parent / CERTIFICATES / paper
        for paper, path in proof.papers.items()})


def certificate_text(decision: Decision) -> str:
    """The certificate as readable text with fixed bytes."""
    return json.dumps(decision.certificate, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def write_certificates(decisions: Sequence[Decision], where: Places, whole_papers: bool = True) -> None:
    """Write every certificate into the folder of its paper, with a manifest that names them and their digests.

    What the manifest of an earlier call names is dropped where it is no longer made: of these claims, and where the
    decisions are of whole papers, of claims that these no longer state. No other file is ever deleted.
    Raises InputError where nothing can be written.
    """
    for paper in dict.fromkeys(d.claim.paper for d in decisions):
        own = [d for d in decisions if d.claim.paper == paper]
        written = {d.claim.equation: certificate_text(d) for d in own if d.certificate}
        write_folder(where.folder(paper), paper, written, None if whole_papers else {d.claim.equation for d in own})


def write_folder(folder: Path, paper: str, written: Mapping[str, str], decided: Collection[str] | None) -> None:
    """Write certificates by their equations into a folder, and its manifest; decided: the equations of which an older
    file may be dropped, None for all that the manifest names. Raises InputError where nothing can be written."""
    try:
        named = _manifest(folder, paper)
        stale = {name for name in named if name not in written and (decided is None or name in decided)}
        for name in stale:
            (folder / f"{name}.json").unlink(missing_ok=True)
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in written.items():
            path = folder / f"{name}.json"
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                write_whole(path, text)
        kept = {name: digest for name, digest in named.items() if name not in stale}
        kept |= {name: hashlib.sha256(text.encode()).hexdigest() for name, text in written.items()}
        manifest = {"version": 1, "paper": paper, "certificates": dict(sorted(kept.items()))}
        text = json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
        path = folder / MANIFEST
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            write_whole(path, text)
    except (OSError, UnicodeDecodeError) as trouble:
        why = getattr(trouble, "strerror", None) or str(trouble)
        raise InputError(getattr(trouble, "filename", None) or folder, "", f"cannot be written ({why}): name another "
                         "folder by --certificates") from None


def _manifest(folder: Path, paper: str) -> dict[str, str]:
    """What the manifest in a folder names, by equation; nothing where there is none that is this paper's."""
    try:
        found = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        if found["version"] == 1 and found["paper"] == paper:
            return {name: digest for name, digest in found["certificates"].items()
                    if is_equation(name) and isinstance(digest, str)}
    except (FileNotFoundError, NotADirectoryError, ValueError, KeyError, TypeError, AttributeError):
        pass
    return {}


def claims_document(decisions: Sequence[Decision], where: Places) -> dict[str, Any]:
    """The document of `workbench prove --json`; other programs read it."""
    rows = []
    for d in decisions:
        claim = d.claim
        rows.append({
            "id": claim.id, "paper": claim.paper, "equation": claim.equation, "kind": claim.kind,
            "statement": claim.statement, "verdict": d.verdict, "method": d.method, "scope": claim.scope,
            "certificate": str(where.path(claim)) if d.certificate else None,
            "counterexample": d.counterexample, "correction": d.correction,
            "premises": list(claim.premises), "tainted_by": list(d.tainted_by), "trust": d.trust,
            "seconds": round(d.seconds, 3), "title": claim.title, "note": claim.note,
            "recorded": claim.recorded, "computed": d.computed,
        })
    return {"version": 1, "claims": rows,
            "summary": {v: sum(d.verdict == v for d in decisions) for v in VERDICTS}}

"""Decisions as the stable JSON document, and certificates as files."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES, certificates_folder
from workbench.files.outputs import check_outputs
from workbench.files.own_files import MANIFEST, read_manifest, replace_files, sha256
from workbench.files.writing import require_inside
from workbench.proof.checker import THEOREMS, goal_digest
from workbench.proof.document_format import ClaimRow, ClaimsDocument, PaperSums
from workbench.proof.verdict import FATES, ORIGINS, VERDICTS, Decision, Stated, Verdict, is_equation, is_paper_name
from workbench.proof.whole_theorem import composed, whole_theorems

if TYPE_CHECKING:
    from workbench.proof.prove import Proof

ANOTHER_FOLDER = "name another folder by --certificates"


@dataclass(frozen=True)
class Places:
    """Where certificates lie: <below>/<paper>/<equation>.json, or of papers named in `own` in that folder.

    roots: of these the paper's own folder, which nothing is written outside of.
    """

    below: Path
    own: Mapping[str, Path] = field(default_factory=dict)
    roots: Mapping[str, Path] = field(default_factory=dict)

    def folder(self, paper: str) -> Path:
        """The folder of a paper's certificates."""
        return self.own.get(paper, self.below / paper)

    def root(self, paper: str) -> Path:
        """The folder that was asked for, in which that of the certificates lies."""
        return self.roots.get(paper, self.below)

    def path(self, claim: Stated) -> Path:
        """Where a claim's certificate stands."""
        return self.folder(claim.paper) / f"{claim.equation}.json"


def places(proof: Proof, chosen: Path | None) -> Places:
    """Below the folder that is chosen, else in the papers' own folders, of a single proof file beside it."""
    if chosen is not None:
        return Places(chosen)
    own = {paper: certificates_folder(path, paper) for paper, path in proof.papers.items()}
    return Places(Path(CERTIFICATES), own,
                  {paper: path if path.is_dir() else path.parent for paper, path in proof.papers.items()})


def check_places(papers: Iterable[Path], chosen: Path | None, others: Mapping[str, Path | None]) -> None:
    """InputError unless the certificates of folders and proof files can go where `places` puts them, and no other
    output, by its option, lies among them."""
    check_outputs({}, folders={"--certificates": None if chosen is None else (chosen, ())})
    roots = dict.fromkeys(path if path.is_dir() else path.parent for path in papers)
    for root in [chosen] if chosen is not None else roots:
        folder = root if chosen is not None else root / CERTIFICATES
        require_inside(folder, root, ANOTHER_FOLDER)
        if folder.exists() and not folder.is_dir():
            raise InputError(folder, "", f"is a file, where certificates go: {ANOTHER_FOLDER}")
        for option, other in others.items():
            above = None if other is None else Path(os.path.realpath(other.parent))
            if above is not None and above.is_relative_to(os.path.realpath(folder)) and (
                    chosen is None or above != Path(os.path.realpath(folder))):
                raise InputError(other or "", option, f"lies among the certificates in {folder}: name another place")


def bound(certificate: Mapping[str, Any]) -> dict[str, Any]:
    """A certificate with the digest of its claim's goal."""
    return {**certificate, "version": 2, "goal_digest": goal_digest(dict(certificate))}


def certificate_text(certificate: Mapping[str, Any]) -> str:
    """The same as readable text with fixed bytes."""
    return json.dumps(bound(certificate), indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def write_certificates(decisions: Sequence[Decision], where: Places, whole_papers: bool = True) -> None:
    """Write every certificate into the folder of its paper, with a manifest of all claims that were decided; of whole
    papers also the certificates of whole theorems, into a folder in it.

    What the manifest of an earlier call names is dropped where it is no longer made: of these claims, and where the
    decisions are of whole papers, of claims that these no longer state. No other file is ever deleted.
    Raises InputError where nothing can be written.
    """
    for paper in dict.fromkeys(d.claim.paper for d in decisions):
        own = [d for d in decisions if d.claim.paper == paper]
        _, kept = _named(where.folder(paper), paper)
        digests = {name: entry.get("goal_digest") for name, entry in kept.items()} | goal_digests(own)
        rows = {d.claim.equation: (d.verdict, with_premises(d, digests)) for d in own}
        write_folder(where.folder(paper), where.root(paper), paper, rows, whole_papers)
        if whole_papers and (theorems := whole_theorems(own)):
            claims = {d.claim.id: d.claim for d in decisions}
            written = {name: bound(found) for name, (_, found) in rows.items() if found}
            composed_rows: dict[str, tuple[Verdict, Mapping[str, Any]]] = {
                claims[name].equation: ("proved", composed(name, claims, written)) for name in theorems}
            write_folder(where.folder(paper) / THEOREMS, where.root(paper), paper, composed_rows, True)


def goal_digests(decisions: Iterable[Decision]) -> dict[str, str | None]:
    """By equation the digest of what each decision is for; None for one without a certificate."""
    return {d.claim.equation: goal_digest(dict(d.certificate)) if d.certificate else None for d in decisions}


def with_premises(decision: Decision, digests: Mapping[str, str | None]) -> Mapping[str, Any] | None:
    """The certificate as it is written: where it proves, with what the claims of this paper that it uses state.

    digests: as of `goal_digests`. A premise of another paper stands in the claim alone.
    """
    claim, certificate = decision.claim, decision.certificate
    names = [name for paper, _, name in (one.partition(":") for one in claim.premises) if paper == claim.paper]
    if certificate is None or decision.verdict != "proved" or not names:
        return certificate
    return {**certificate, "premises": {name: digests.get(name) for name in names}}


def write_folder(folder: Path, within: Path, paper: str, rows: Mapping[str, tuple[Verdict, Mapping[str, Any] | None]],
                 whole: bool) -> None:
    """Write the certificates of claims, by their equations, into a folder, and its manifest: for every claim its
    verdict, the digest of its goal and that of its certificate, null where it has none.

    within: the folder that was asked for, which no link may lead out of; whole: whether claims that the manifest names
    and that are not among these are dropped. Raises InputError where nothing can be written, or a file of someone
    else's is in the way.
    """
    for name in rows:
        if not is_paper_name(paper) or not is_equation(name):
            raise InputError(folder, f"{paper}:{name}", "cannot name a certificate: use letters, digits and '_' for "
                             "the paper, and '.', '+', '-' too for the claim")
    before, kept = _named(folder, paper)
    written = {name: certificate_text(found) for name, (_, found) in rows.items() if found}
    entries = {} if whole else dict(kept)
    entries |= {name: {"verdict": verdict, "goal_digest": goal_digest(dict(found)) if found else None,
                       "certificate": sha256(written[name]) if found else None}
                for name, (verdict, found) in rows.items()}
    stale = {name for name in before if name not in written and (whole or name in rows)}
    manifest = {"version": 2, "paper": paper, "claims": dict(sorted(entries.items()))}
    replace_files(folder, within, json.dumps(manifest, indent=1, ensure_ascii=False) + "\n",
                  {f"{name}.json": text for name, text in written.items()},
                  {f"{name}.json": digest for name, digest in before.items()},
                  {f"{name}.json": before[name] for name in stale},
                  lambda name, data: _claim_of(data) == f"{paper}:{name.removesuffix('.json')}", ANOTHER_FOLDER)


def _named(folder: Path, paper: str) -> tuple[dict[str, str], dict[str, Any]]:
    """Digests of the certificates that the manifest in a folder names, by equation, and its entries of claims.

    One of version 1 names certificates alone. InputError where it is not this paper's.
    """
    found = read_manifest(folder, ANOTHER_FOLDER)
    if found is None:
        return {}, {}
    listed = found.get("claims") if found.get("version") == 2 else (
        found.get("certificates") if found.get("version") == 1 else None)
    if not isinstance(listed, dict):
        raise InputError(folder / MANIFEST, "", f"is no manifest of certificates: move it away, or {ANOTHER_FOLDER}")
    if found.get("paper") != paper:
        raise InputError(folder / MANIFEST, "", f"names the certificates of {str(found.get('paper'))[:60]!r}, not of "
                         f"{paper!r}: remove that folder, or {ANOTHER_FOLDER}")
    entries = {name: entry for name, entry in listed.items() if is_equation(name) and isinstance(entry, dict)}
    digests = {name: entry.get("certificate") if isinstance(entry, dict) else entry for name, entry in listed.items()}
    return ({name: digest for name, digest in digests.items() if is_equation(name) and isinstance(digest, str)},
            entries)


def _claim_of(data: bytes) -> str | None:
    """The claim that a certificate is for, None where the bytes are no certificate."""
    try:
        found = json.loads(data)
    except (ValueError, RecursionError):
        return None
    return found.get("claim") if isinstance(found, dict) and "verdict" in found else None


def claims_document(decisions: Sequence[Decision], where: Places) -> ClaimsDocument:
    """The document of `workbench prove --json`; other programs read it.

    `summary` counts all verdicts, `totals` those of the paper's lines (printed and implied) and of our own questions
    apart, `proved_under` how many of the proved ones are so only under claims that are not shown, `fates` what becomes
    of the headline statements, `papers` each paper's rows.
    """
    rows: list[ClaimRow] = []
    for d in decisions:
        claim = d.claim
        rows.append({
            "id": claim.id, "paper": claim.paper, "equation": claim.equation, "kind": claim.kind,
            "statement": claim.printed, "verdict": d.verdict, "method": d.method, "scope": claim.scope,
            "certificate": str(where.path(claim)) if d.certificate else None,
            "counterexample": d.counterexample, "correction": d.correction,
            "premises": list(claim.premises), "tainted_by": list(d.tainted_by),
            "proved_under": list(d.proved_under), "besides": list(d.besides), "trust": d.trust,
            "seconds": round(d.seconds, 3), "title": claim.title, "note": claim.note,
            "recorded": claim.recorded, "computed": d.computed, "origin": claim.origin, "match": d.matched,
            "goal": d.goal,
            "reading": claim.reading, "glyph": d.other_reading,
            "glyph_claim": claim.glyph, "severity": claim.severity, "rests_on": list(claim.chain),
            "mends": claim.mends, "section": claim.section,
            "goal_digest": goal_digest(d.certificate) if d.certificate else None,
            "fate": d.fate.word if d.fate else None,
            "fate_why": d.fate.why if d.fate else None, "fate_by": list(d.fate.by) if d.fate else [],
        })
    return {"version": 2, "claims": rows, "summary": _counts(decisions),
            "proved_under": {"paper": _under([d for d in decisions if d.claim.origin != "ours"]),
                             "ours": _under([d for d in decisions if d.claim.origin == "ours"])},
            "totals": {"paper": _counts([d for d in decisions if d.claim.origin != "ours"]),
                       "ours": _counts([d for d in decisions if d.claim.origin == "ours"])},
            "fates": {word: sum(d.fate is not None and d.fate.word == word for d in decisions) for word in FATES},
            "papers": {paper: _paper([d for d in decisions if d.claim.paper == paper])
                       for paper in dict.fromkeys(d.claim.paper for d in decisions)}}


def _paper(decisions: Sequence[Decision]) -> PaperSums:
    """The sums of one paper."""
    formulas = [d for d in decisions if d.claim.origin == "printed" and d.certificate and d.matched != "words"]
    return {"rows": {origin: _counts([d for d in decisions if d.claim.origin == origin]) for origin in ORIGINS},
            "formulas": len(formulas), "parsed": sum(d.matched == "parsed" for d in formulas),
            "theorems": [{"equation": d.claim.equation, "title": d.claim.title, "fate": d.fate.word,
                          "why": d.fate.why} for d in decisions if d.fate]}


def _under(decisions: Sequence[Decision]) -> int:
    return sum(bool(d.proved_under) for d in decisions)


def _counts(decisions: Sequence[Decision]) -> dict[Verdict, int]:
    return {v: sum(d.verdict == v for d in decisions) for v in VERDICTS}

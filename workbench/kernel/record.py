"""Which of a paper's own certificates stand in a folder of exports that coqc was run on."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES
from workbench.files.own_files import sha256
from workbench.kernel.coqc import Checked, missing, version
from workbench.kernel.export import export_folder
from workbench.proof.kernel_record import read_record, recorded_version


def exported_texts(paper: Path) -> dict[str, str]:
    """By claim the sha256 of the Coq file that a paper's certificate gives now; InputError where it has none."""
    folder = paper / CERTIFICATES
    if not folder.is_dir():
        raise InputError(paper, "--record", "is no paper's folder with certificates: run 'workbench prove --write'")
    return {one.claim: sha256(one.text) for one in export_folder(folder) if one.text is not None}


def accepted_goals(rows: Iterable[Checked], texts: Mapping[str, str],
                   noted: Collection[tuple[str, str]] = ()) -> dict[str, str]:
    """By equation the goal's digest of every certificate of the paper that was accepted, now or before: a file that is
    another one than its certificate gives now says nothing of it.

    noted: as `noted_before` says; of claims of which no row tells it stays noted.
    """
    rows = list(rows)
    told = {row.claim for row in rows}
    accepted = {claim.partition(":")[2]: digest for claim, digest in noted if claim not in told}
    return accepted | {row.claim.partition(":")[2]: row.goal_digest for row in rows
                       if row.outcome in ("accepted", "noted") and row.text and texts.get(row.claim) == row.text}


def noted_before(paper: Path, texts: Mapping[str, str]) -> set[tuple[str, str]]:
    """(claim, goal digest) of what a paper's record has, of this version of Coq; texts: as `exported_texts` says."""
    record = read_record(paper)
    if not record or missing() is not None or recorded_version(paper) != version():
        return set()
    return {(claim, record[equation]) for claim in texts if (equation := claim.partition(":")[2]) in record}

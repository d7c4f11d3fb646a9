"""Which of a paper's own certificates stand in a folder of exports that coqc was run on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES
from workbench.files.own_files import sha256
from workbench.kernel.coqc import Checked
from workbench.kernel.export import export_folder


def exported_texts(paper: Path) -> dict[str, str]:
    """By claim the sha256 of the Coq file that a paper's certificate gives now; InputError where it has none."""
    folder = paper / CERTIFICATES
    if not folder.is_dir():
        raise InputError(paper, "--record", "is no paper's folder with certificates: run 'workbench prove --write'")
    return {one.claim: sha256(one.text) for one in export_folder(folder) if one.text is not None}


def accepted_goals(rows: Iterable[Checked], texts: Mapping[str, str]) -> dict[str, str]:
    """By equation the goal's digest of every certificate of the paper that was accepted: a file that is another one
    than its certificate gives now says nothing of it."""
    return {row.claim.partition(":")[2]: row.goal_digest for row in rows
            if row.outcome == "accepted" and row.text and texts.get(row.claim) == row.text}

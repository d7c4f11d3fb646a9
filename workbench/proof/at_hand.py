"""Which papers state the claims that the certificates in a folder are of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES, papers_in
from workbench.proof.checker import MANIFEST, CertificateError, Manifest, read_manifest
from workbench.proof.loading import ProofFile
from workbench.proof.selection import files_of, states_claims, targets


def papers_at_hand(folder: Path, named: Sequence[Path] = ()) -> dict[Path, Path]:
    """By each folder of certificates the paper's folder, or the proof file, that states its claims.

    The papers that are the folder, lie in it or have it as theirs are found by themselves; `named` are others, whose
    certificates lie anywhere below the folder. Raises InputError for one that is named and has none there.
    """
    here = folder.resolve()
    places = {place for place in (here, here.parent, *papers_in(here)) if states_claims(place)}
    found = {place / CERTIFICATES: place for place in sorted(places) if (place / CERTIFICATES).is_relative_to(here)}
    manifests = _manifests(folder)
    for path in files_of(targets([str(p) for p in named])) if named else ():
        names = _names(path)
        found |= {place: path for place, manifest in manifests.items() if manifest.paper in names and
                  not (place.parent in manifests and manifests[place.parent].paper == manifest.paper)}
        if not set(names) & {manifest.paper for manifest in manifests.values()}:
            raise InputError(path, "", f"is of no paper whose certificates lie in {folder}: name theirs")
    return found


def _manifests(folder: Path) -> dict[Path, Manifest]:
    found: dict[Path, Manifest] = {}
    for path in sorted(folder.rglob(MANIFEST)):
        try:
            found[path.parent.resolve()] = read_manifest(path)
        except CertificateError:  # said where the certificates themselves are checked
            continue
    return found


def _names(path: Path) -> list[str]:
    """Of the papers that a file states, which is imported for it."""
    from workbench.proof import paper  # noqa: PLC0415 - needs sympy, and folders are found by their names

    return [one.name for one in paper.papers_in(ProofFile(path))]

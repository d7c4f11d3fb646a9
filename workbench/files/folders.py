"""Where a paper's folder lies, and what a folder's modules hold."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

from workbench.errors import InputError
from workbench.files.modules import has_module, module_in

PAPER_FILE, CLAIMS_FOLDER, STUDY_FILE, PAPERS_FOLDER = "paper.py", "claims", "study.toml", "proofs"
CERTIFICATES = "certificates"
MOST_ENTRIES = 100_000

T = TypeVar("T")


def is_folder(path: Path) -> bool:
    """Whether a path names a folder; not so where it cannot be a path, as where it is too long."""
    try:
        return path.is_dir()
    except OSError:
        return False


def is_paper(folder: Path) -> bool:
    """Whether a folder is a paper's: it has a paper.py, claims, or a study."""
    return is_folder(folder) and ((folder / PAPER_FILE).is_file() or (folder / STUDY_FILE).is_file()
                                or any((folder / CLAIMS_FOLDER).glob("*.py")))


def require_few(folder: Path) -> None:
    """InputError for a folder with more than MOST_ENTRIES files and folders in it and below it, such as a whole disk,
    before anybody looks through all of them."""
    count = 0
    for _, folders, files in os.walk(folder):
        count += len(folders) + len(files)
        if count > MOST_ENTRIES:
            raise InputError(folder, "", f"holds more than {MOST_ENTRIES} files and folders: name the folder of a "
                             "paper, or of its certificates")


def certificates_folder(path: Path, paper: str) -> Path:
    """Where the certificates of a paper's folder or proof file are written unless another place is asked for."""
    return path / CERTIFICATES if path.is_dir() else path.parent / CERTIFICATES / paper


def papers_in(folder: Path) -> list[Path]:
    """The paper folders that lie in a folder, by name."""
    return sorted(path for path in folder.iterdir() if is_paper(path)) if folder.is_dir() else []


def paper_named(name: str, near: Path) -> Path | None:
    """The paper folder of that name, seen from a folder: itself, one beside it, or one in a `proofs` folder of it, of
    a folder above it, or of the current one; None where there is none."""
    here = near.resolve()
    if here.name == name and is_paper(here):
        return here
    places = [here.parent, *(place / PAPERS_FOLDER for place in (here, *here.parents)), Path.cwd() / PAPERS_FOLDER]
    found = (place / name for place in places)
    return next((folder for folder in found if is_paper(folder) and not _strange(folder, here)), None)


def papers_near(near: Path) -> list[Path]:
    """All paper folders that `paper_named` would find from a folder, each name once."""
    here = near.resolve()
    places = [here.parent, *(place / PAPERS_FOLDER for place in (here, *here.parents)), Path.cwd() / PAPERS_FOLDER]
    found = {path.name: path for place in reversed(places) for path in papers_in(place) if not _strange(path, here)}
    if is_paper(here):
        found[here.name] = here
    return [found[name] for name in sorted(found)]


def _strange(folder: Path, near: Path) -> bool:
    """Whether a folder that was found, and not named, belongs to somebody else than this user, the system or whoever
    owns the place from where it was looked for: its modules would be run, and anybody may lay folders into `/tmp`."""
    return hasattr(os, "geteuid") and owner(folder) not in (os.geteuid(), 0, owner(near))


def owner(path: Path) -> int:
    """The number of the user to whom a file or folder belongs."""
    return path.stat().st_uid


def held_in(folder: Path, module: str, kind: type[T]) -> dict[str, T]:
    """Everything of a kind that a module of a folder has at its top level, or in a dictionary, tuple or list there.

    By its `id` where it has one, else by its name or key; empty where there is no such module. Raises InputError where
    the module cannot be imported.
    """
    if not has_module(folder, module):
        return {}
    found: dict[str, T] = {}
    for name, value in vars(module_in(folder, module)).items():
        for key, one in _named(name, value):
            if isinstance(one, kind):
                found.setdefault(str(getattr(one, "id", key)), one)
    return found


def _named(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        yield from ((str(key), one) for key, one in value.items())
    elif isinstance(value, tuple | list):
        yield from ((name, one) for one in value)
    else:
        yield name, value

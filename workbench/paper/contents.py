"""What a paper's folder has, for a list of papers; nothing is run or proved."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

from workbench.files.folders import CLAIMS_FOLDER, PAPER_FILE, STUDY_FILE
from workbench.files.modules import has_module
from workbench.files.text import read_text


@dataclass(frozen=True)
class Contents:
    """A paper's name, its folder, which parts it has, how many certificates, those of its gains too; title: its
    study's, empty without one."""

    name: str
    folder: Path
    title: str
    parts: tuple[str, ...]
    certificates: int


def contents_of(folder: Path) -> Contents:
    """What a folder has; InputError where its study.toml cannot be read."""
    study = folder / STUDY_FILE
    title = ""
    if study.is_file():
        try:
            title = str(tomllib.loads(read_text(study, "TOML")).get("title", ""))
        except ValueError:
            title = "(study.toml is not valid TOML)"
    has = {"claims": (folder / PAPER_FILE).is_file() or (folder / CLAIMS_FOLDER).is_dir()}
    has |= {part: has_module(folder, part) for part in ("plant", "laws")}
    has |= {"study": study.is_file(), "gains": has_module(folder, "gains"),
            "contest": has_module(folder, "contest") or (folder / "contest.toml").is_file()}
    certificates = sum(path.name != "manifest.json" for path in (folder / "certificates").rglob("*.json"))
    return Contents(folder.name, folder, title, tuple(part for part, there in has.items() if there), certificates)

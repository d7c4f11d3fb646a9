"""A paper's folder to start from: claims that are decided and a law that runs, from the first minute."""

from __future__ import annotations

import keyword
import sys
from pathlib import Path, PurePath
from string import Template

from workbench.errors import InputError
from workbench.files.regular import contents
from workbench.files.writing import write_tree

TEMPLATE = Path(__file__).parent / "template"
# What a new paper is about -> the folder that it starts from.
TEMPLATES = {"train": TEMPLATE, "plant": Path(__file__).parent / "template_plant"}
ANOTHER = "name it with letters, digits and underscores, as in doe2026"
LONGEST_NAME = 100


def template_files(template: Path = TEMPLATE) -> list[PurePath]:
    """The files of a new paper, below its folder."""
    found = (path.relative_to(template) for path in template.rglob("*") if path.suffix in (".py", ".toml"))
    return sorted(PurePath(path) for path in found)


def write_new_paper(name: str, directory: Path, about: str = "train") -> Path:
    """Write the commented folder <name> with claims, a law and a study; the path of the folder.

    about: "train" for a law of a train on a line, "plant" for a plant of one's own.

    Raises InputError for a name that cannot be a module's, where something of that name stands already, and for what
    cannot be written; then what was written before is removed again.
    """
    folder = new_folder(name, directory)
    template = TEMPLATES[about]
    texts = {place: contents(template / place).decode() for place in template_files(template)}
    write_tree(folder, {place: Template(text).substitute(name=name).encode() for place, text in texts.items()},
               "name another --out")
    return folder


def new_folder(name: str, directory: Path) -> Path:
    """Where a new paper's folder goes, which is not made yet; InputError for a name or place that cannot be one's."""
    if not (name.isidentifier() and name.isascii()) or keyword.iskeyword(name) or len(name) > LONGEST_NAME:
        raise InputError("new-paper", name, f"is no name of a Python module: {ANOTHER}")
    if name.startswith("_") or name in sys.stdlib_module_names or name in ("sympy", "workbench"):
        raise InputError("new-paper", name, f"would hide another module, or be hidden: {ANOTHER}")
    if name in ("nan", "inf"):
        raise InputError("new-paper", name, f"stands for a number that is none, in tables too: {ANOTHER}")
    folder = directory / name
    if folder.exists() or folder.is_symlink():
        raise InputError(folder, "", "exists already: name another paper, or move it away first")
    return folder

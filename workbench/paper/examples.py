"""The papers, lines, trains and contests that come with the workbench, written into a folder."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePath

import workbench
from workbench.errors import InputError
from workbench.files.folders import PAPERS_FOLDER
from workbench.files.outputs import check_outputs
from workbench.files.regular import contents
from workbench.files.writing import write_tree

SHARED_FOLDER = "benchmarks"
SCRIPTS, NOT_SHARED = (".py", ".c"), "peers"  # in it: what measures the workbench itself


@dataclass(frozen=True)
class Example:
    """A file that comes with the workbench: where it lies, and where it goes below the reader's folder."""

    source: Path
    place: PurePath


def examples_root() -> Path:
    """Where the examples lie: inside the package as it was installed, else in the checkout that it runs from.

    Raises InputError where neither has them.
    """
    package = Path(workbench.__file__).resolve().parent
    for root in (package / "examples", package.parent):
        if (root / PAPERS_FOLDER).is_dir() and (root / SHARED_FOLDER).is_dir():
            return root
    raise InputError(package, "", "has no examples beside it: install the workbench from its wheel, or from a clone")


def examples(root: Path) -> list[Example]:
    """Every file of the papers, and the data that they share, by place; caches and scripts of our own are left out."""
    found = []
    for folder in (PAPERS_FOLDER, SHARED_FOLDER):
        for path in sorted((root / folder).rglob("*")):
            place = path.relative_to(root)
            script = folder == SHARED_FOLDER and (path.suffix in SCRIPTS or NOT_SHARED in place.parts)
            cached = any(part.startswith(("__pycache__", ".")) for part in place.parts)
            if path.is_file() and not script and not cached:
                found.append(Example(path, PurePath(place)))
    return found


def write_examples(directory: Path) -> Iterator[str]:
    """Write every example below a new or empty folder, and say what is there; lines for the reader.

    Where a file cannot be written, those written before are removed again. Raises InputError for a folder that is not
    empty, and for what cannot be written.
    """
    found = examples(examples_root())
    check_outputs({}, folders={"DIRECTORY": (directory, ())})
    if directory.is_dir() and any(directory.iterdir()):
        raise InputError(directory, "", "is not empty: name a new or an empty folder")
    write_tree(directory, {example.place: contents(example.source) for example in found}, "name another folder")
    for folder in (PAPERS_FOLDER, SHARED_FOLDER):
        inside = dict.fromkeys(example.place.parts[1] for example in found if example.place.parts[0] == folder)
        yield f"{directory / folder}: {', '.join(inside)}"
    yield f"{len(found)} files. To go on: cd {directory}; workbench list; workbench prove {PAPERS_FOLDER}"

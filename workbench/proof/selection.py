"""Which claims are asked for: papers, folders of them, and single claims as in PAPER::24."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path

from workbench.errors import InputError
from workbench.files.folders import CLAIMS_FOLDER, PAPER_FILE, is_folder, is_paper, paper_named, papers_in, papers_near
from workbench.files.modules import python_files
from workbench.proof.verdict import Stated

NO_PAPER = "states no Paper: create one with workbench.proof.paper.Paper"


@dataclass(frozen=True)
class Target:
    """What one argument names: papers, each a folder or a single proof file, and which of their claims; all of them
    where there is no pattern."""

    path: Path
    files: tuple[Path, ...]
    pattern: str | None = None

    def inputs(self) -> list[Path]:
        """The Python files that may be read for it: of a folder all, of a single file those beside it too."""
        return [file for path in self.files
                for file in (python_files(path) if path.is_dir() else sorted(path.parent.glob("*.py")))]


def targets(arguments: Sequence[str | Path], none_is_fine: bool = False) -> list[Target]:
    """What the arguments name: a paper's folder, a proof file, or a folder of such.

    Raises InputError when a path has no proof file, unless that is fine.
    """
    found = [_target(str(argument)) for argument in arguments]
    if not none_is_fine and not any(target.files for target in found):
        raise InputError(found[0].path if found else "proofs", "", "holds no proof file: name a paper's folder or "
                         "a .py file")
    return [target for target in found if target.files] if none_is_fine else found


def states_claims(folder: Path) -> bool:
    """Whether a paper's folder has anything to decide: a paper.py, or files in claims."""
    return (folder / PAPER_FILE).is_file() or any((folder / CLAIMS_FOLDER).glob("*.py"))


def _target(argument: str) -> Target:
    name, separator, pattern = argument.partition("::")
    if not name:
        raise InputError("", argument, "names no paper: name a paper's folder, a proof file, or '.' for where you are")
    path = Path(name)
    if path.name == PAPER_FILE and is_paper(path.parent):
        path = path.parent
    files: tuple[Path, ...]
    if is_paper(path):
        files = (path,) if states_claims(path) else ()
    elif is_folder(path):
        single = [p for p in path.glob("*.py") if not p.name.startswith("_")]
        files = tuple(sorted([*single, *(p for p in papers_in(path) if states_claims(p))]))
    elif path.suffix == ".py" and _is_file(path):
        files = (path,)
    else:
        near = paper_named(name, Path.cwd()) if name.isidentifier() else None
        if near is None:
            if path.is_symlink() or _is_there(path):
                raise InputError(path, "", "is neither a paper's folder nor a regular .py file: name one of these")
            raise InputError(path, "", f"no such paper: {_meant(path)}name a paper's folder, a proof file, or a folder "
                             "of them")
        path, files = near, (near,)
    return Target(path, files, pattern if separator else None)


def _meant(path: Path) -> str:
    """A question after the paper or proof file of a name like this one, where there is one."""
    beside = sorted(p.name for p in path.parent.glob("*.py")) if is_folder(path.parent) else []
    folders = [p.name for p in papers_near(path.parent if is_folder(path.parent) else Path.cwd())]
    near = get_close_matches(path.name, [*folders, *beside], n=1)
    return f"did you mean '{near[0]}'? Else " if near else ""


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # no name that could be
        return False


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:
        return False


def files_of(found: Sequence[Target]) -> list[Path]:
    """The proof files of all targets, each once, in the order in which they are named."""
    return list({file.resolve(): file for target in reversed(found) for file in reversed(target.files)}.values())[::-1]


def chosen(found: Sequence[Target], stated: Mapping[Path, Sequence[Stated]]) -> set[str]:
    """The ids of the claims that the targets ask for.

    Raises InputError, with ids like it, for a pattern that no claim has.
    """
    by_file = {file.resolve(): claims for file, claims in stated.items()}
    ids: set[str] = set()
    for target in found:
        claims = [claim for file in target.files for claim in by_file[file.resolve()]]
        matching = {claim.id for claim in claims if _matches(claim, target.pattern)}
        if target.pattern is not None and not matching:
            names = [claim.equation for claim in claims]
            near = get_close_matches(target.pattern, names, n=5, cutoff=0.5) or names[:5]
            raise InputError(f"{target.path}::{target.pattern}", "",
                             f"no such claim: name one of its {len(names)}, such as {', '.join(near)}")
        ids |= matching
    return ids


def _matches(claim: Stated, pattern: str | None) -> bool:
    return pattern is None or pattern in (claim.equation, claim.id) or any(
        fnmatchcase(name, pattern) for name in (claim.equation, claim.id))

"""Which claims are asked for: proof files, folders of them, and single claims as in chen2019.py::24."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path

from workbench.errors import InputError
from workbench.proof.verdict import Stated

NO_PAPER = "states no Paper: create one with workbench.proof.paper.Paper"


@dataclass(frozen=True)
class Target:
    """What one argument names: proof files, and which of their claims; all of them where there is no pattern."""

    path: Path
    files: tuple[Path, ...]
    pattern: str | None = None


def targets(arguments: Sequence[str | Path]) -> list[Target]:
    """What the arguments name; a folder stands for all .py files in it.

    Raises InputError when a path has no proof file.
    """
    found = [_target(str(argument)) for argument in arguments]
    if not any(target.files for target in found):
        raise InputError(found[0].path if found else "proofs", "", "holds no proof file: name a .py file")
    return found


def _target(argument: str) -> Target:
    name, separator, pattern = argument.partition("::")
    path = Path(name)
    if path.is_dir():
        files = tuple(sorted(p for p in path.glob("*.py") if not p.name.startswith("_")))
    elif path.suffix == ".py" and path.is_file():
        files = (path,)
    else:
        raise InputError(path, "", "no such proof file: name a .py file or a folder of them")
    return Target(path, files, pattern if separator else None)


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

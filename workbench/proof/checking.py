"""Certificates and claims of a folder checked in several processes, a paper in each: what `check_folder` and
`check_claims` find, in the same order."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from workbench.proof.checker import THEOREMS, File, Row, check_file, check_folder
from workbench.tasks.executor import named
from workbench.tasks.handing_out import results_of
from workbench.tasks.processes import start_method

BINDING = "workbench.proof.binding"  # what workers need; this process does without sympy
WORTH_PROCESSES = 100  # certificates; fewer are checked sooner than another process has started

Part = tuple[str, Any]


def check_all(folder: Path, papers: Mapping[Path, Path], workers: int,
              on_progress: Callable[[int, int], None] = lambda done, total: None) -> tuple[list[Row], int]:
    """The rows of `check_folder`, those of `check_claims` for each folder of certificates and its paper, and how many
    certificates are of their claims; on_progress(done, total) counts certificates. Raises InputError where a paper
    cannot be imported."""
    claims = {place: (place, path) for place, path in papers.items()}
    found: dict[Part, Any] = {}

    def checked(files: list[File]) -> list[Row]:
        """A paper's files stay together, because its theorems are composed of its other certificates."""
        groups: dict[Path, list[File]] = {}
        for file in files:
            groups.setdefault(_paper_of(file[0]), []).append(file)
        tasks: list[Part] = [("files", place) for place in groups] + [("claims", place) for place in claims]
        tasks.sort(key=lambda part: -len(groups.get(part[1], ())))
        several = workers > 1 and len(files) >= WORTH_PROCESSES
        if several and named() is None:
            start_method(BINDING)
        left, done = Counter(place for _, place in tasks), 0

        def told(_: int, part: Part, __: Any) -> None:
            """A folder's certificates are done once they are held against their claims, too."""
            nonlocal done
            left[part[1]] -= 1
            if not left[part[1]] and part[1] in groups:
                done += len(groups[part[1]])
                on_progress(done, len(files))

        found.update(results_of(_part, {"files": groups, "claims": claims}, tasks, workers if several else 1, told))
        by_path = {row[0]: row for place in groups for row in found["files", place]}
        return [by_path[path] for path, _ in files]

    rows = check_folder(folder, checked)
    for place in claims:
        more, _ = found["claims", place]
        rows = rows + more
    return rows, sum(found["claims", place][1] for place in claims)


def _paper_of(path: Path) -> Path:
    """The folder of certificates that a file is of; whole theorems lie in one below it."""
    return path.parent.parent if path.parent.name == THEOREMS else path.parent


def _part(given: Mapping[str, Mapping[Path, Any]], part: Part) -> Any:
    what, place = part
    if what == "files":
        return [check_file(*file) for file in given[what][place]]
    from workbench.proof.binding import check_claims  # noqa: PLC0415 - needs sympy, which certificates do not

    return check_claims(*given[what][place])

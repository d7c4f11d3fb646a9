"""The contract of a paper's gains.py: what is looked at and searched, and which runs show what found gains do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from workbench.files.folders import held_in, is_paper
from workbench.gains.result import GainReport
from workbench.gains.stated import Stated
from workbench.paper.loading import Loaded

Row = dict[str, float | str | None]


@dataclass(frozen=True)
class Task:
    """One run: of which gains (`stated`, or a found set's name), in which setting, with which keys of the file changed.

    setting: in words what else decides the run; values: what its paper's runner needs beside the changes.
    """

    gains: str
    setting: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class GainSearch:
    """report(stated): conditions, certificates and found gains of a file's numbers; tasks(report): the runs, each
    setting first with the stated gains, then with those found for it; run(loaded, task): the numbers of one, in SI
    units, and why it ended early if it did."""

    report: Callable[[Stated], GainReport]
    tasks: Callable[[GainReport], list[Task]]
    run: Callable[[Loaded, Task], tuple[Row, str | None]]


def gain_search_of(loaded: Loaded) -> GainSearch | None:
    """How a paper's gains are looked at; None where its folder has no gains.py that says so."""
    found = held_in(loaded.folder, "gains", GainSearch) if is_paper(loaded.folder) else {}
    return next(iter(found.values()), None)


def same_for_all(report: GainReport, setting: str) -> list[Task]:
    """The stated gains, then every found set, in one setting."""
    return [Task("stated", setting), *(Task(s.name, setting, s.changes) for s in report.found)]


def changes_of(report: GainReport, name: str) -> Mapping[str, Any]:
    """The keys of the file that a found set changes."""
    return next(s.changes for s in report.found if s.name == name)

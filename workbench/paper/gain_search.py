"""The contract of a paper's gains.py: what is looked at and searched, and which runs show what found gains do.

Of a front (`gain_front.py`): which gains are searched for what their runs cost against what is proved of them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from workbench.files.folders import held_in, is_paper
from workbench.gains.held_loop import SampledLoop
from workbench.gains.result import GainReport
from workbench.gains.stated import Stated
from workbench.model.tuning import Range
from workbench.paper.loading import Loaded
from workbench.paper.study import varied

Row = dict[str, float | str | None]
Values = Mapping[str, float]
Numbers = dict[str, float | None]
# The numbers of a run, and why it ended early if it did.
Ended = tuple[Row, str | None]
# What the runs of a study left, by case.
Runs = Mapping[Hashable, Any]


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
class FrontSetting:
    """Sampling, delay and lag for which a front is searched.

    loop(stated, gains): the loop of which the bound is proved; run(loaded, gains): the numbers of its run in SI, `cost`
    among them, which is what is minimised; None for what a failed run does not have.
    """

    id: str
    title: str
    loop: Callable[[Stated, Mapping[str, Fraction]], SampledLoop]
    run: Callable[[Loaded, Values], Numbers]


@dataclass(frozen=True)
class FrontSearch:
    """What is searched: the ranges of gains, the stated ones, and in which settings.

    bounded: in words what the bound is of; unit: its unit; weights: how many compromises between cost and bound are
    searched for, with `evaluations` each; points: how many are kept of a front at most.
    """

    paper: str
    ranges: Mapping[str, Range]
    stated: Callable[[Stated], Mapping[str, float]]
    bounded: str
    unit: str
    settings: tuple[FrontSetting, ...]
    weights: int = 5
    evaluations: int = 60
    points: int = 5
    seed: int = 1


def _never(loaded: Loaded, task: Task, runs: Runs) -> None:
    return None


@dataclass(frozen=True)
class GainSearch:
    """report(stated): conditions, certificates and found gains of a file's numbers; tasks(report): the runs, each
    setting first with the stated gains, then with those found for it; run(loaded, task): the numbers of one, in SI
    units, and why it ended early if it did. had(loaded, task, runs): the same where a study has run it already, in its
    own `runs` by case, else None. front: what cost against proved bound is searched for, if anything. only_full:
    whether the runs that `had` does not know are so long that a short report leaves them out."""

    report: Callable[[Stated], GainReport]
    tasks: Callable[[GainReport], list[Task]]
    run: Callable[[Loaded, Task], Ended]
    front: FrontSearch | None = None
    had: Callable[[Loaded, Task, Runs], Ended | None] = _never
    only_full: bool = False


@dataclass(frozen=True)
class OwnRuns:
    """Found gains in the runs of a paper's study: what `run` and `had` of its GainSearch are.

    case(study, task): which of the study's runs shows them, as stated; make(study, case): that run; row(study, run):
    its numbers, and why it ended early. study: with the task's changes. A run with the values of one that the study
    has made is not made again.
    """

    case: Callable[[Any, Task], Any]
    make: Callable[[Any, Any], Any]
    row: Callable[[Any, Any], Ended]

    def run(self, loaded: Loaded, task: Task) -> Ended:
        """The task's run; ValueError for a change of no value that the study states."""
        changed = varied(loaded.study, task.changes, task.gains)
        return self.row(changed, self.make(changed, self.case(changed, task)))

    def had(self, loaded: Loaded, task: Task, runs: Runs) -> Ended | None:
        """The same from the study's own runs, as stated or under one of its changes; None where none has its values."""
        study: Any = loaded.study
        number = study.number_of(task.changes)
        case = None if number is None else replace(self.case(study, task), change=number)
        return self.row(study.changed(number), runs[case]) if case in runs else None


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

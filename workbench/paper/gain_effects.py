"""Found gains in their paper's own simulation, beside the stated ones, with the same metrics."""

from __future__ import annotations

import math
from dataclasses import dataclass

from workbench.errors import InputError, WorkbenchError
from workbench.gains.result import GainReport
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Row, Runs, Task, gain_search_of
from workbench.paper.loading import Loaded
from workbench.paper.study import Progress
from workbench.tasks.handing_out import places, run_tasks

NONE_YET: Runs = {}


@dataclass(frozen=True)
class Effect:
    """What a run gave: SI units; None for a number that a failed run does not have, which `failed` explains."""

    gains: str
    setting: str
    numbers: Row
    failed: str | None


def gains_of(loaded: Loaded) -> GainReport:
    """Conditions, certificates and found gains of a paper; InputError naming file and key, or that it has none."""
    search = gain_search_of(loaded)
    if search is None:
        raise InputError(loaded.folder, "gains.py", "is missing, or holds no GainSearch: the folder of a paper says "
                         "there what is searched")
    try:
        return search.report(Stated(loaded.path, loaded.data))
    except WorkbenchError:
        raise
    except Exception as trouble:  # a file may be well formed and still leave nothing to search
        what = " ".join(f"{type(trouble).__name__}: {trouble}".split())
        raise InputError(loaded.path, "", f"the search of gains fails on its numbers ({what}): take those of the "
                                          "paper's own file as a model") from trouble


def effects(loaded: Loaded, report: GainReport, workers: int | None = None,
            on_progress: Progress = lambda done, total, what: None, runs: Runs = NONE_YET) -> tuple[Effect, ...]:
    """Every found set of gains beside the stated ones, in the order of the paper's tasks.

    runs: of the paper's study, where it was run: what is among them is not run again.
    """
    search = gain_search_of(loaded)
    tasks = search.tasks(report) if search else []
    had = {number: search.had(loaded, task, runs) for number, task in enumerate(tasks)} if search and runs else {}
    found = {number: _effect(tasks[number], *ended) for number, ended in had.items() if ended is not None}

    def record(result: tuple[int, Effect]) -> None:
        found[result[0]] = result[1]
        on_progress(len(found), len(tasks), result[1].gains)

    left = [(number, task) for number, task in enumerate(tasks) if number not in found]
    run_tasks(_run, loaded, left, places(workers), record)
    return tuple(found[number] for number in range(len(tasks)))


def _run(loaded: Loaded, numbered: tuple[int, Task]) -> tuple[int, Effect]:
    number, task = numbered
    search = gain_search_of(loaded)
    assert search is not None
    return number, _effect(task, *search.run(loaded, task))


def _effect(task: Task, numbers: Row, failed: str | None) -> Effect:
    finite: Row = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in numbers.items()}
    return Effect(task.gains, task.setting, finite, failed)

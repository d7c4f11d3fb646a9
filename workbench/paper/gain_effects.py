"""Found gains in their paper's own simulation, beside the stated ones, with the same metrics."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from numbers import Real
from pathlib import Path

from workbench.errors import InputError, WorkbenchError
from workbench.gains.result import GainReport, Quantity
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Row, Runs, Task, gain_search_of
from workbench.paper.loading import Loaded
from workbench.paper.study import Progress
from workbench.tasks.handing_out import places, run_tasks

NONE_YET: Runs = {}
# What names a file in an error, as no plant's name does.
FILES = (".py", ".toml", ".csv", ".json")


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
        report = search.report(Stated(loaded.path, loaded.data))
    except InputError as trouble:
        if Path(trouble.where).suffix in FILES:
            raise
        key = ": ".join(part for part in (trouble.where, trouble.key) if part)  # of a plant, which knows no file
        raise InputError(loaded.folder / "gains.py", key, trouble.problem) from None
    except WorkbenchError as trouble:  # of a solver, which knows no file
        raise InputError(loaded.folder / "gains.py", "", str(trouble)) from trouble
    except Exception as trouble:  # a file may be well formed and still leave nothing to search
        what = " ".join(f"{type(trouble).__name__}: {trouble}".split())
        raise InputError(loaded.path, "", f"the search of gains fails on its numbers ({what}): take those of the "
                                          "paper's own file as a model") from trouble
    quantities = tuple(_plain(loaded, one) for one in report.quantities)
    conditions = tuple(replace(one, met=bool(one.met)) for one in report.conditions)
    return replace(report, quantities=quantities, conditions=conditions)


def _plain(loaded: Loaded, quantity: Quantity) -> Quantity:
    """The same with floats: a folder's own module may give numbers of sympy or numpy. InputError for what is none."""

    def number(key: str) -> float:
        value = getattr(quantity, key)
        try:
            found = float(value)
        except (TypeError, ValueError):
            found = math.nan
        if not math.isfinite(found):
            raise InputError(loaded.folder / "gains.py", f"{quantity.name}: {key}", f"{str(value)[:60]} is no finite "
                             "number: give one")
        return found

    return replace(quantity, proved=number("proved"), papers=None if quantity.papers is None else number("papers"),
                   check=None if quantity.check is None else number("check"))


def effects(loaded: Loaded, report: GainReport, workers: int | None = None,
            on_progress: Progress = lambda done, total, what: None, runs: Runs = NONE_YET, full: bool = True
            ) -> tuple[Effect, ...]:
    """Every found set of gains beside the stated ones, in the order of the paper's tasks.

    runs: of the paper's study, where it was run: what is among them is not run again. full: False leaves out what is
    not among them, where the paper's search is `only_full`.
    """
    search = gain_search_of(loaded)
    tasks = search.tasks(report) if search else []
    had = {number: search.had(loaded, task, runs) for number, task in enumerate(tasks)} if search and runs else {}
    found = {number: _effect(tasks[number], *ended) for number, ended in had.items() if ended is not None}

    def record(result: tuple[int, Effect]) -> None:
        found[result[0]] = result[1]
        on_progress(len(found), len(tasks), result[1].gains)

    left = [(number, task) for number, task in enumerate(tasks) if number not in found]
    if full or search is None or not search.only_full:
        run_tasks(_run, loaded, left, places(workers), record)
    return tuple(effect for _, effect in sorted(found.items()))


def left_out(loaded: Loaded, report: GainReport, done: Sequence[Effect]) -> Mapping[str, int]:
    """Of each setting how many of the paper's runs are not among those that were done."""
    search = gain_search_of(loaded)
    lacking = Counter(task.setting for task in (search.tasks(report) if search else ()))
    lacking.subtract(effect.setting for effect in done)
    return lacking


def _run(loaded: Loaded, numbered: tuple[int, Task]) -> tuple[int, Effect]:
    number, task = numbered
    search = gain_search_of(loaded)
    assert search is not None
    return number, _effect(task, *search.run(loaded, task))


def _effect(task: Task, numbers: Row, failed: str | None) -> Effect:
    plain = {k: float(v) if isinstance(v, Real) else v for k, v in numbers.items()}
    finite: Row = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in plain.items()}
    return Effect(task.gains, task.setting, finite, failed)

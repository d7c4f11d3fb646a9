"""The stages of a study: runs of one kind after those of another, with one count of progress over all of them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.paper.study import Progress
from workbench.simulate.process_pool import results_of


@dataclass(frozen=True)
class Stage:
    """Independent runs: function(shared, task) -> result for every task, in worker processes.

    function: of a module's top level, since workers import it; shared, tasks, results: what can be sent to a process;
    tasks: hashable and each there once; title(task, result): what was run, in words, for the progress; work(task): how
    long a run takes, in any unit: the longest is begun first, so that no process is left alone with one at the end.
    A stage of one task runs in this process with nothing beside it, as measuring times wants it.
    """

    function: Callable[[Any, Any], Any]
    shared: Any
    tasks: Sequence[Hashable]
    title: Callable[[Any, Any], str]
    work: Callable[[Any], float] | None = None


def run_stages(stages: Sequence[Stage], workers: int, on_progress: Progress) -> tuple[Mapping[Any, Any], ...]:
    """Task -> result for each stage, in the order of its tasks; a stage begins when the one before has ended.

    on_progress(finished, in all, title) counts over all stages. Raises WorkbenchError when a worker process dies; an
    exception of a stage's function is raised here: a run that fails says so in its result instead.

    A study's run is then:

        runs, drawn = run_stages((Stage(run_case, study, cases(study), title), pair_stage(DRIVERS, study)), workers,
                                 on_progress)
    """
    before, total = 0, sum(len(stage.tasks) for stage in stages)
    results: list[Mapping[Any, Any]] = []
    for stage in stages:
        results.append(_run_stage(stage, workers, on_progress, before, total))
        before += len(stage.tasks)
    return tuple(results)


def _run_stage(stage: Stage, workers: int, on_progress: Progress, before: int, total: int) -> Mapping[Any, Any]:
    work = stage.work
    tasks = sorted(stage.tasks, key=work, reverse=True) if work else stage.tasks
    found = results_of(stage.function, stage.shared, tasks, workers,
                       lambda done, task, result: on_progress(before + done, total, stage.title(task, result)))
    return {task: found[task] for task in stage.tasks}

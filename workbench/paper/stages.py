"""The stages of a study: runs of several kinds in one pool of processes, with one count of progress over all."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.paper.study import Progress
from workbench.tasks.handing_out import results_of

_Task = tuple[int, Any]  # number of the stage, and its task


@dataclass(frozen=True)
class Stage:
    """Independent runs: function(shared, task) -> result for every task, in worker processes.

    function: of a module's top level, since workers import it; shared, tasks, results: what can be sent to a process;
    tasks: hashable and each there once; title(task, result): what was run, in words, for the progress; work(task): how
    long a run takes, in any unit: the longest is begun first, so that no process is left alone with one at the end.
    A stage of one task runs in this process after all others, with nothing beside it, as measuring times wants it.
    """

    function: Callable[[Any, Any], Any]
    shared: Any
    tasks: Sequence[Hashable]
    title: Callable[[Any, Any], str]
    work: Callable[[Any], float] | None = None


def run_stages(stages: Sequence[Stage], workers: int, on_progress: Progress) -> tuple[Mapping[Any, Any], ...]:
    """Task -> result for each stage, in the order of its tasks.

    All stages share one pool of processes, in their order, so that modules are imported and kernels loaded once and no
    process waits for the end of a stage; stages of one task follow. on_progress(finished, in all, title) counts over
    all stages. Raises WorkbenchError when a worker process dies; an exception of a stage's function is raised here: a
    run that fails says so in its result instead.

    A study's run is then:

        runs, drawn = run_stages((Stage(run_case, study, cases(study), title), pair_stage(DRIVERS, study)), workers,
                                 on_progress)
    """
    pooled = [number for number, stage in enumerate(stages) if len(stage.tasks) > 1]
    alone = [number for number, stage in enumerate(stages) if len(stage.tasks) == 1]
    total = sum(len(stage.tasks) for stage in stages)

    def tell(before: int) -> Callable[[int, _Task, Any], None]:
        return lambda done, task, result: on_progress(before + done, total, stages[task[0]].title(task[1], result))

    shared = [(stage.function, stage.shared) for stage in stages]
    found = results_of(_run, shared, [task for number in pooled for task in _in_order(number, stages[number])], workers,
                       tell(0))
    for number in alone:
        found |= results_of(_run, shared, _in_order(number, stages[number]), 1, tell(len(found)))
    return tuple({task: found[number, task] for task in stage.tasks} for number, stage in enumerate(stages))


def _in_order(number: int, stage: Stage) -> list[_Task]:
    tasks = sorted(stage.tasks, key=stage.work, reverse=True) if stage.work else stage.tasks
    return [(number, task) for task in tasks]


def _run(shared: Sequence[tuple[Callable[[Any, Any], Any], Any]], task: _Task) -> Any:
    function, of_stage = shared[task[0]]
    return function(of_stage, task[1])

"""The stages of a study: runs of several kinds in one pool of processes, with one count of progress over all."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.paper.study import Progress
from workbench.tasks.handing_out import results_of

_Task = tuple[int, tuple[Any, ...]]  # number of the stage, and its tasks that one process runs together


@dataclass(frozen=True)
class Together:
    """How a process makes several runs of a stage at once: with the results of each alone, in less time.

    run(shared, tasks) -> their results, in their order; groups(shared, tasks): the tasks, each in one of some groups
    that are worth it.
    """

    run: Callable[[Any, Sequence[Any]], Sequence[Any]]
    groups: Callable[[Any, Sequence[Any]], Sequence[Sequence[Any]]]


@dataclass(frozen=True)
class Stage:
    """Independent runs: function(shared, task) -> result for every task, in worker processes.

    function: of a module's top level, since workers import it; shared, tasks, results: what can be sent to a process;
    tasks: hashable and each there once; title(task, result): what was run, in words, for the progress; work(task): how
    long a run takes, in any unit: the longest is begun first, so that no process is left alone with one at the end.
    together: how several are run at once, where they can be.
    A stage of one task runs in this process after all others, with nothing beside it, as measuring times wants it.
    """

    function: Callable[[Any, Any], Any]
    shared: Any
    tasks: Sequence[Hashable]
    title: Callable[[Any, Any], str]
    work: Callable[[Any], float] | None = None
    together: Together | None = None

    def handed_out(self) -> list[tuple[Any, ...]]:
        """The tasks as processes get them: the longest first, alone or in groups."""
        if self.together is None:
            tasks = sorted(self.tasks, key=self.work, reverse=True) if self.work else self.tasks
            return [(task,) for task in tasks]
        groups = [tuple(group) for group in self.together.groups(self.shared, self.tasks)]
        work = self.work
        return sorted(groups, key=lambda group: sum(map(work, group)), reverse=True) if work else groups


def run_stages(stages: Sequence[Stage], workers: int, on_progress: Progress) -> tuple[Mapping[Any, Any], ...]:
    """Task -> result for each stage, in the order of its tasks.

    All stages share one pool of processes, so that modules are imported and kernels loaded once and no process waits
    for the end of a stage. It begins with a task of each, so that what one stage compiles is made beside what another
    does, and goes on in their order; stages of one task follow. on_progress(finished, in all, title) counts over all
    stages. Raises WorkbenchError when a worker process dies; an exception of a stage's function is raised here: a run
    that fails says so in its result instead.

    A study's run is then:

        runs, drawn = run_stages((Stage(run_case, study, cases(study), title), pair_stage(DRIVERS, study)), workers,
                                 on_progress)
    """
    pooled = [number for number, stage in enumerate(stages) if len(stage.tasks) > 1]
    alone = [number for number, stage in enumerate(stages) if len(stage.tasks) == 1]
    total, found = sum(len(stage.tasks) for stage in stages), dict[tuple[int, Any], Any]()

    def keep(_: int, of: _Task, results: Sequence[Any]) -> None:
        for task, result in zip(of[1], results, strict=True):
            found[of[0], task] = result
            on_progress(len(found), total, stages[of[0]].title(task, result))

    shared = [(stage.function, stage.shared, stage.together) for stage in stages]
    handed = [[(number, tasks) for tasks in stages[number].handed_out()] for number in pooled]
    first, rest = [of_stage[0] for of_stage in handed], [task for of_stage in handed for task in of_stage[1:]]
    results_of(_run, shared, [*first, *rest], workers, keep)
    for number in alone:
        results_of(_run, shared, [(number, tuple(stages[number].tasks))], 1, keep)
    return tuple({task: found[number, task] for task in stage.tasks} for number, stage in enumerate(stages))


def _run(shared: Sequence[tuple[Callable[[Any, Any], Any], Any, Together | None]], of: _Task) -> Sequence[Any]:
    function, of_stage, together = shared[of[0]]
    if together is not None and len(of[1]) > 1:
        return together.run(of_stage, of[1])
    return [function(of_stage, task) for task in of[1]]

"""Hand tasks out: to the executor that the command has named, else to this process or others of this machine."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence, Sized
from typing import Any, TypeVar

from workbench.tasks.executor import Executor, ThisProcess, named
from workbench.tasks.processes import LocalProcesses, cores

T = TypeVar("T")
K = TypeVar("K", bound=Hashable)
R = TypeVar("R")


def places(workers: int | None = None) -> int:
    """How many tasks are run at once: as many as the named executor has places for, else as asked, or one a core."""
    executor = named()
    return executor.workers if executor else workers or cores()


def run_tasks(function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T], workers: int,
              record: Callable[[R], None]) -> None:
    """Call record(function(shared, task)) for every task, in the order in which they finish.

    With one worker, or one task, they run here, else on the named executor, or in processes of this machine. tasks: a
    sequence, or what makes them as they are needed. Raises as `Executor.run`.
    """
    most = min(workers, len(tasks)) if isinstance(tasks, Sized) else workers
    executor: Executor | None = named()
    if executor is None or (isinstance(tasks, Sized) and len(tasks) <= 1):
        executor = LocalProcesses(most) if most > 1 else ThisProcess()
    executor.run(function, shared, tasks, record)


def results_of(function: Callable[[Any, K], R], shared: Any, tasks: Sequence[K], workers: int,
               on_result: Callable[[int, K, R], None]) -> dict[K, R]:
    """Task -> function(shared, task), in the order of the tasks; they are run as by `run_tasks`, and raise alike.

    on_result(finished, task, result) is called after each, in the order in which they finish.
    """
    found: dict[K, R] = {}

    def record(done: tuple[int, R]) -> None:
        number, result = done
        found[tasks[number]] = result
        on_result(len(found), tasks[number], result)

    run_tasks(_numbered, (function, shared), list(enumerate(tasks)), workers, record)
    return {task: found[task] for task in tasks}


def _numbered(given: tuple[Callable[[Any, K], R], Any], task: tuple[int, K]) -> tuple[int, R]:
    """A task comes back by its number: on its way to another machine its paths may become others."""
    function, shared = given
    return task[0], function(shared, task[1])

"""The contract by which work is handed out: independent tasks, run wherever an executor has places for them.

Three keep it: `ThisProcess`, `processes.LocalProcesses` and `cluster.DaskCluster`. Every verb hands its tasks to
`handing_out`. A command that names an executor makes it that of all it runs (`on`), as joblib's `parallel_config` does,
so that nothing between the command and its tasks passes it on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, Protocol, TypeVar

T = TypeVar("T")
R = TypeVar("R")


class Executor(Protocol):
    """Runs independent tasks.

    function: of a module's top level, which is sent by its name; shared, tasks, results: records that can be sent to a
    process. Tasks are taken from their iterable as places for them become free, never all at once.
    """

    @property
    def workers(self) -> int:
        """How many tasks are run at once."""

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """Call record(function(shared, task)) in this process for every task, in the order in which they finish.

        Tasks of a place that is lost are run at another. An exception of `function` is raised here. When anything
        interrupts, what has finished is recorded before the interruption goes on, and no task is left running. Raises
        WorkbenchError where tasks can no longer be run.
        """


class ThisProcess:
    """Tasks one after the other, here."""

    workers = 1

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """As `Executor.run`."""
        for task in tasks:
            record(function(shared, task))


_named: ContextVar[Executor | None] = ContextVar("executor", default=None)


def named() -> Executor | None:
    """The executor that a command has named; None where it has named none."""
    return _named.get()


@contextmanager
def on(executor: Executor) -> Iterator[None]:
    """Run what is run in this block on an executor."""
    token = _named.set(executor)
    try:
        yield
    finally:
        _named.reset(token)

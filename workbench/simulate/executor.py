"""Where tasks are run: in this process, in others of this machine, or wherever an executor of a cluster sends them.

Every verb hands its tasks to `process_pool.run_tasks`. A command that names a cluster makes it the executor of all that
it runs (`on`), as joblib's `parallel_config` does, so that nothing between the command and its tasks passes it on.
"""

from __future__ import annotations

import platform
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Protocol, TypeVar

T = TypeVar("T")
R = TypeVar("R")


class Executor(Protocol):
    """Runs independent tasks at other places.

    function: of a module's top level, which is sent by its name; shared, tasks, results: what can be sent to a process.
    Tasks are taken from their iterable as places for them become free, never all at once.
    """

    @property
    def workers(self) -> int:
        """How many tasks are run at once."""

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """Call record(function(shared, task)) in this process for every task, in the order in which they finish.

        An exception of `function` is raised here. When anything interrupts, what has finished is recorded before the
        interruption goes on, and no task is left running. Raises WorkbenchError where tasks can no longer be run.
        """


# Rows have the same bytes where these are the same.
ALIKE = ("casadi", "numba", "numpy", "scipy", "sympy")


def versions() -> dict[str, str]:
    """What numbers depend on beside the code; an empty one where a package is not there."""
    return {"python": platform.python_version(), **{name: _version(name) for name in ALIKE}}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


_current: ContextVar[Executor | None] = ContextVar("executor", default=None)


def current() -> Executor | None:
    """The executor that a command has named, None where it has named none: processes of this machine."""
    return _current.get()


@contextmanager
def on(executor: Executor) -> Iterator[None]:
    """Run what is run in this block on an executor."""
    token = _current.set(executor)
    try:
        yield
    finally:
        _current.reset(token)

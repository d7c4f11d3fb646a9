"""Who lists and decides claims: this process alone, several others, or the executor that the command has named."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from workbench.errors import WorkbenchError
from workbench.files.modules import package_of
from workbench.proof.cache import DecisionCache
from workbench.proof.messages import Decided, Listing
from workbench.tasks.executor import named
from workbench.tasks.handing_out import results_of
from workbench.tasks.processes import (
    follow_parent,
    interruption_held,
    script_left_out,
    server_alive,
    single_threaded,
    start_method,
)

if TYPE_CHECKING:
    from workbench.proof.worker import Worker

WORKER = "workbench.proof.worker"  # what workers import; this process does without sympy and the deciders
WARM_AT_ONCE = 4  # workers that are started before it is known how many claims there are

Task = tuple[Path, str]
T = TypeVar("T")


class WorkerPool(Protocol):
    """Does the same for one worker and for several; raises the error of the first file or claim that has one."""

    def listings(self, paths: Sequence[Path]) -> list[Listing]:
        """What the files state, in their order."""

    def decided(self, tasks: Sequence[Task], on_progress: Callable[[int], None]) -> list[Decided]:
        """The claims decided, in the order of the tasks; on_progress(how many) after each."""


@contextmanager
def worker_pool(jobs: int, cached: DecisionCache | None, limit: float | None = None) -> Iterator[WorkerPool]:
    """As many workers as that; they are gone when the block is left, at once when it is left by an exception.

    limit: of the seconds of processor time for each claim. A named executor's processes know no cache of this machine.
    Raises WorkbenchError when one of them dies.
    """
    if named() is not None:
        yield _Elsewhere(limit)
        return
    with single_threaded():
        if jobs == 1:
            yield _Alone(cached, limit)
            return
        others = set(multiprocessing.active_children())
        pool = ProcessPoolExecutor(jobs, start_method(WORKER), _start, (dict(os.environ), cached, limit))
        try:
            yield _Several(pool, jobs)
        except BaseException as trouble:
            # Every decision that was finished is in the cache, so nothing is lost with a worker.
            for process in set(multiprocessing.active_children()) - others:
                process.kill()
            if isinstance(trouble, BrokenProcessPool):
                raise WorkbenchError("a worker process died (out of memory, or killed): run again with fewer, as "
                                     "with --workers 1; what was decided is kept") from None
            raise
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


class _Alone:
    def __init__(self, cached: DecisionCache | None, limit: float | None) -> None:
        self.worker = _worker(cached, limit)

    def listings(self, paths: Sequence[Path]) -> list[Listing]:
        return [self.worker.listing(path) for path in paths]

    def decided(self, tasks: Sequence[Task], on_progress: Callable[[int], None]) -> list[Decided]:
        done = []
        for task in tasks:
            done.append(self.worker.decided(*task))
            on_progress(len(done))
        return done


class _Several:
    def __init__(self, pool: ProcessPoolExecutor, jobs: int) -> None:
        self.pool, self.jobs = pool, jobs

    def listings(self, paths: Sequence[Path]) -> list[Listing]:
        # Workers without a file of their own import one that others list: they will need it to decide its claims.
        at_once = max(len(paths), min(self.jobs, WARM_AT_ONCE))
        with interruption_held(), server_alive(), script_left_out():
            futures = [self.pool.submit(_listing, paths[i % len(paths)]) for i in range(at_once)]
        return _in_order(futures[: len(paths)], lambda done: None)

    def decided(self, tasks: Sequence[Task], on_progress: Callable[[int], None]) -> list[Decided]:
        with interruption_held(), server_alive(), script_left_out():
            futures = [self.pool.submit(_decided, task) for task in tasks]
        return _in_order(futures, on_progress)


class _Elsewhere:
    """What the named executor's processes list and decide."""

    def __init__(self, limit: float | None) -> None:
        self.limit = limit

    def listings(self, paths: Sequence[Path]) -> list[Listing]:
        for path in paths:  # so that it is sent
            package_of(path if path.is_dir() else path.parent)
        found = results_of(_listed_there, self.limit, list(paths), 1, lambda *_: None)
        return [_unless_trouble(found[path]) for path in paths]

    def decided(self, tasks: Sequence[Task], on_progress: Callable[[int], None]) -> list[Decided]:
        found = results_of(_decided_there, self.limit, list(tasks), 1, lambda done, *_: on_progress(done))
        return [_unless_trouble(found[task]) for task in tasks]


def _unless_trouble(found: Any) -> Any:
    """The result; an exception is raised here, so that the first in order counts and not the first in time."""
    if isinstance(found, Exception):
        raise found
    return found


def _listed_there(limit: float | None, path: Path) -> Listing | Exception:
    try:
        return _worker_there(limit).listing(path)
    except WorkbenchError as trouble:
        return trouble


def _decided_there(limit: float | None, task: Task) -> Decided | Exception:
    try:
        return _worker_there(limit).decided(*task)
    except WorkbenchError as trouble:
        return trouble


@cache
def _worker_there(limit: float | None) -> Worker:
    return _worker(None, limit)


def _in_order(futures: list[Future[T]], on_progress: Callable[[int], None]) -> list[T]:
    """The results; of several errors the first in this order, however the work was spread."""
    place = {future: i for i, future in enumerate(futures)}
    needed = len(futures)
    for done, future in enumerate(as_completed(futures), 1):
        if not future.cancelled() and future.exception() is not None:
            needed = min(needed, place[future])
            for later in futures[needed + 1:]:
                later.cancel()
        if needed < len(futures) and all(f.done() for f in futures[:needed]):
            break
        on_progress(done)
    return [future.result() for future in futures]


def _worker(cached: DecisionCache | None, limit: float | None) -> Worker:
    from workbench.proof.worker import Worker  # noqa: PLC0415 - only those who decide need sympy and the deciders

    return Worker(cached, limit)


_here: list[Any] = []


def _start(environment: Mapping[str, str], cached: DecisionCache | None, limit: float | None) -> None:
    follow_parent(environment)
    _here[:] = [_worker(cached, limit)]


def _listing(path: Path) -> Any:
    return _here[0].listing(path)


def _decided(task: Task) -> Any:
    return _here[0].decided(*task)

"""Run many independent tasks in worker processes; what is finished is never lost to an interruption."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Hashable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from typing import Any, TypeVar

from workbench.errors import WorkbenchError
from workbench.files.modules import KnownFolders

THREAD_LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS",
                 "VECLIB_MAXIMUM_THREADS")

T = TypeVar("T")
K = TypeVar("K", bound=Hashable)
R = TypeVar("R")


def cores() -> int:
    """Processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_tasks(function: Callable[[Any, T], R], shared: Any, tasks: Sequence[T], workers: int,
              record: Callable[[R], None]) -> None:
    """Call record(function(shared, task)) for every task, in the order in which they finish.

    With one worker the tasks run here, else in spawned processes that use one thread each. When anything
    interrupts, the tasks already started are finished and recorded before the interruption goes on.
    Raises WorkbenchError when a worker process dies; an exception of `function` is raised here.
    """
    if workers == 1 or len(tasks) <= 1:
        for task in tasks:
            record(function(shared, task))
        return
    context = multiprocessing.get_context("spawn")
    waiting = iter(tasks)
    unrecorded: set[Future[R]] = set()
    with single_threaded(), ProcessPoolExecutor(workers, context, _start,
                                                      (KnownFolders(), function, shared)) as pool:
        def submit(count: int) -> None:
            unrecorded.update(pool.submit(_work, task) for task in islice(waiting, count))

        try:
            # Few tasks are handed out at a time, so that an interruption waits for few.
            submit(workers + 1)
            while unrecorded:
                finished, _ = wait(unrecorded, return_when=FIRST_COMPLETED)
                submit(len(finished))
                for future in finished:
                    record(future.result())
                    unrecorded.discard(future)
        except BrokenProcessPool:
            raise WorkbenchError("a worker process died (out of memory, or killed): run again with fewer "
                                 "workers, and resume") from None
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            for future in unrecorded:
                if not future.cancelled() and future.exception() is None:
                    record(future.result())
            raise


def results_of(function: Callable[[Any, K], R], shared: Any, tasks: Sequence[K], workers: int,
               on_result: Callable[[int, K, R], None]) -> dict[K, R]:
    """Task -> function(shared, task), in the order of the tasks; they are run as by `run_tasks`, and raise alike.

    on_result(finished, task, result) is called after each, in the order in which they finish.
    """
    found: dict[K, R] = {}

    def record(done: tuple[K, R]) -> None:
        task, result = done
        found[task] = result
        on_result(len(found), task, result)

    run_tasks(_with_task, (function, shared), tasks, workers, record)
    return {task: found[task] for task in tasks}


def _with_task(given: tuple[Callable[[Any, K], R], Any], task: K) -> tuple[K, R]:
    function, shared = given
    return task, function(shared, task)


@contextmanager
def single_threaded() -> Iterator[None]:
    """Workers inherit the environment: libraries read it on import, before any initializer runs."""
    before = {name: os.environ.get(name) for name in THREAD_LIMITS}
    os.environ.update(dict.fromkeys(THREAD_LIMITS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


_job: list[Any] = []


def _start(known: KnownFolders, function: Callable[..., Any], shared: Any) -> None:
    """known: first, since what follows may be of a module in a user's folder."""
    follow_parent()
    _job[:] = [function, shared]


def follow_parent() -> None:
    """For a worker: an interruption is the parent's to handle, and a parent that was killed takes it along."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_leave_with_parent, daemon=True).start()


def _leave_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _work(task: Any) -> Any:
    function, shared = _job
    return function(shared, task)

"""Processes of this machine as an executor; what is finished is never lost to an interruption."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from itertools import chain, islice
from multiprocessing import forkserver
from multiprocessing.context import BaseContext
from typing import Any, TypeVar

from workbench.errors import WorkbenchError
from workbench.files.cache_folder import note
from workbench.files.memory_limit import require_files
from workbench.files.modules import KnownFolders
from workbench.files.paper_code import mistakes_told
from workbench.tasks import server
from workbench.tasks.room_for_calls import with_room_for_calls
from workbench.tasks.sent import job_bytes, job_of
from workbench.tasks.threads import THREAD_LIMITS

# Rooms that hand tasks out and run none.
WITHOUT_TASKS = ("cli", "api", "report")
# Processes that may die in the course of a job; how long tasks that have begun may take after an interruption.
MOST_LOSSES, GRACE_S = 5, 5.0

SCRIPT = b"__main__"  # where pickle says that something is defined there

T = TypeVar("T")
R = TypeVar("R")


def cores() -> int:
    """Processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True)
class LocalProcesses:
    """Processes of this machine that use one thread each. Tasks of a process that dies are run again."""

    workers: int

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """As `Executor.run`; raises WorkbenchError when processes die again and again, and as `job_bytes`."""
        waiting, unrecorded = iter(tasks), list[T]()
        for _ in range(MOST_LOSSES):
            again, unrecorded = unrecorded, []
            try:
                self._run(function, shared, chain(again, waiting), record, unrecorded)
            except BrokenProcessPool:
                note(f"a worker process died: its tasks and those of the others, {len(unrecorded)}, are run again")
                continue
            return
        raise WorkbenchError("worker processes die again and again (out of memory, or killed): run again with fewer "
                             "workers, and resume")

    def _run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterator[T], record: Callable[[R], None],
             unrecorded: list[T]) -> None:
        """unrecorded: is left with the tasks that were handed out and not recorded, where processes die."""
        job = job_bytes((function, shared))
        context = start_method()
        others, running = set(multiprocessing.active_children()), dict[Future[R], T]()
        with single_threaded(), ProcessPoolExecutor(self.workers, context, _start,
                                                    (dict(os.environ), KnownFolders(), job)) as pool:
            def submit(count: int) -> None:
                for task in islice(tasks, count):
                    unrecorded.append(task)
                    with interruption_held(), server_alive(), script_left_out(unless=SCRIPT in job):
                        running[pool.submit(_work, task)] = task

            def taken(future: Future[R]) -> None:
                result = future.result()
                unrecorded.remove(running.pop(future))
                record(result)

            try:
                # Few tasks are handed out at a time, so that an interruption waits for few.
                submit(self.workers + 1)
                while running:
                    finished, _ = wait(running, return_when=FIRST_COMPLETED)
                    submit(len(finished))
                    for future in finished:
                        taken(future)
            except BrokenProcessPool:
                raise
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                # Who has not begun never will: to wait for those, too, is to wait to the end.
                wait([future for future in running if not future.cancel()], timeout=GRACE_S)
                for process in set(multiprocessing.active_children()) - others:
                    process.terminate()
                for future in list(running):
                    if future.done() and not future.cancelled() and future.exception() is None:
                        taken(future)
                raise


def start_method(*needed: str) -> BaseContext:
    """How processes are started: from a server that has imported what they need, where the system has such servers.

    needed: modules beside those of this package that this process has imported. The first call of a process decides
    what its server imports; what else a worker needs it imports itself, as all workers of other systems do. Raises
    WorkbenchError where too few open files are allowed.
    """
    require_files()
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    found = multiprocessing.get_context("forkserver")
    own = {name for name in sys.modules if name.startswith("workbench.") and name.split(".")[1] not in WITHOUT_TASKS}
    found.set_forkserver_preload([server.__name__])
    # A module is not looked for in the current folder, whose files are the user's.
    with (single_threaded(PYTHONSAFEPATH="1", **server.told(sorted(own.union(needed)))), interruption_held()):
        forkserver.ensure_running()
    _wait_for_server(found)
    return found


@contextmanager
def server_alive() -> Iterator[None]:
    """WorkbenchError where the server that processes come from has died; Python's own error says nothing of it."""
    try:
        yield
    except (EOFError, ConnectionError):
        raise WorkbenchError("the process that starts the workers has died (out of memory, or killed): run again, with "
                             "--resume where the command has it; what was finished is kept") from None


@cache
def _wait_for_server(context: BaseContext) -> None:
    """Wait until the server has imported what it shall, by its first process: here, where an interruption ends the
    waiting, for others are started while interruptions are held back."""
    process = context.Process(target=os.getpid, daemon=True)  # type: ignore[attr-defined]
    try:
        with server_alive(), script_left_out():
            process.start()
        process.join()
    except BaseException:
        # It would see that it is alone only after all its imports; the standard library has no public way to end it.
        number = getattr(getattr(forkserver, "_forkserver", None), "_forkserver_pid", None)
        if number is not None:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        raise


@contextmanager
def single_threaded(**others: str) -> Iterator[None]:
    """Workers inherit the environment: libraries read it on import, before any initializer runs."""
    wanted = dict.fromkeys(THREAD_LIMITS, "1") | others
    before = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@contextmanager
def interruption_held() -> Iterator[None]:
    """Hold Ctrl-C back while processes are started, in them too: it is for this process to end them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def script_left_out(unless: bool = False) -> Iterator[None]:
    """Processes that are started meanwhile do not import the script that this one runs: where it calls the package
    without a guard, each of them would do so again, and die of it.

    unless: what they shall do is defined in the script.
    """
    if unless:
        yield
        return
    main = sys.modules["__main__"].__dict__
    kept: dict[str, Any] = {name: main.pop(name) for name in ("__file__", "__spec__") if name in main}
    main["__spec__"] = None  # what multiprocessing finds the script by
    try:
        yield
    finally:
        main.update(kept)


_job: list[Any] = []


def _start(environment: Mapping[str, str], known: KnownFolders, job: bytes) -> None:
    """known: before the job, which may hold what is of a module in a user's folder."""
    follow_parent(environment)
    _job[:] = job_of(job)


def follow_parent(environment: Mapping[str, str]) -> None:
    """For a worker: an interruption is the parent's to handle, and a parent that was killed takes it along.

    environment: the parent's, which may have changed since it started the server that this process comes from.
    """
    os.environ.clear()
    os.environ.update(environment)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.stdout = sys.stderr  # standard output is for the command's answer alone
    threading.Thread(target=_leave_with_parent, daemon=True).start()


def _leave_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _work(task: Any) -> Any:
    function, shared = _job
    with mistakes_told():
        return with_room_for_calls(function, shared, task)

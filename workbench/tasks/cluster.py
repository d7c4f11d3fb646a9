"""A Dask cluster as an executor: `--dask ADDRESS`, or `--dask local` for a scheduler and a worker in this process.

A worker needs Python and the packages, not the workbench nor any paper: both are uploaded once, as an archive whose
package unpacks it there. What the scheduler is told are functions of the standard library and bytes: the name of what
is in the archive, a job (a function's name and what its tasks share), a task.
"""

from __future__ import annotations

import asyncio
import logging
import operator
import pkgutil
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from workbench.errors import InputError, WorkbenchError
from workbench.files.modules import KnownFolders
from workbench.files.upload import archive, scratch_folder, temporary_archive
from workbench.tasks.children import LOST
from workbench.tasks.processes import cores
from workbench.tasks.sent import answer_of, packed
from workbench.tasks.serving import ERROR, job_head

LOCAL = "local"
# How long is waited for a scheduler to answer, for a first worker or another one, and for everything to close.
ANSWER_S, WORKER_S, CLOSE_S = 8, 60, 5
LOOK_S = 1.0
# So many tasks are handed out for each that is run, so that no worker waits for the next one.
AHEAD = 2
GONE = (CancelledError, asyncio.CancelledError, TimeoutError, OSError)

T = TypeVar("T")
R = TypeVar("R")


@contextmanager
def cluster(address: str, workers: int | None = None) -> Iterator[DaskCluster]:
    """The cluster of that address while the block lasts; `local` is started, with so many workers, and ended.

    Raises WorkbenchError where Dask is not installed, nobody answers, or there is no worker.
    """
    try:
        import dask  # noqa: PLC0415 - an extra, which others do without
        from distributed import LocalCluster  # noqa: PLC0415 - as above
    except ImportError:
        raise InputError("", "--dask", "Dask is not installed: pip install 'workbench[dask]'") from None
    _quieten()
    settings = {"distributed.comm.timeouts.connect": f"{ANSWER_S} s", "distributed.comm.retry.count": 0,
                "distributed.worker.daemon": True}
    with dask.config.set(settings):
        if address != LOCAL:
            with _client(address, address) as client:
                yield DaskCluster(client)
            return
        # The tasks themselves run in processes of the worker's, which is why it may live here.
        with scratch_folder() as folder:
            own = LocalCluster(n_workers=1, threads_per_worker=workers or cores(), processes=False, memory_limit=0,
                               dashboard_address=None, local_directory=str(folder), silence_logs=logging.CRITICAL + 1)
            try:
                with _client(own, LOCAL) as client:
                    yield DaskCluster(client)
            finally:
                _within(CLOSE_S, lambda: own.close(timeout=CLOSE_S))


def _quieten() -> None:
    """What loggers say of lost workers is said here, in a line."""
    for name in ("tornado", "asyncio", *logging.root.manager.loggerDict):
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


@contextmanager
def _client(where: Any, name: str) -> Iterator[Any]:
    """A connection to a scheduler; closed at the end of the block, however that goes."""
    client = _connected(where, name)
    try:
        try:
            client.wait_for_workers(1, timeout=WORKER_S)
        except TimeoutError:
            raise _no_worker() from None
        yield client
    finally:
        _within(CLOSE_S, lambda: client.close(timeout=CLOSE_S))


def _connected(where: Any, name: str) -> Any:
    """A client of the scheduler at an address; InputError where none answers there, or something else does, which Dask
    takes for a scheduler with whatever follows."""
    from distributed import Client  # noqa: PLC0415 - as above

    found: list[Any] = []
    trouble = _within(ANSWER_S + CLOSE_S, lambda: found.append(Client(where, timeout=ANSWER_S)))
    if found:
        return found[0]
    why = "it is silent" if trouble is None else " ".join(str(trouble).split()) or type(trouble).__name__
    raise InputError("", "--dask", f"no scheduler answers at '{name}' ({why}): check the address, as tcp://host:8786, "
                     "and that it runs")


def _within(seconds: float, action: Callable[[], Any]) -> Exception | None:
    """Do something, and wait so long for it: what others do not answer must not hold this process. What it raised."""
    trouble: list[Exception] = []

    def quietly() -> None:
        try:
            action()
        except Exception as found:
            trouble.append(found)

    thread = threading.Thread(target=quietly, daemon=True)
    thread.start()
    thread.join(seconds)
    return trouble[0] if trouble else None


def _no_worker() -> WorkbenchError:
    return WorkbenchError(f"--dask: the scheduler has had no worker for {WORKER_S} s: start some, as with 'dask worker "
                          "ADDRESS', and go on where the command can")


class DaskCluster:
    """The workers of a client, as an `Executor`."""

    def __init__(self, client: Any) -> None:
        self._client = client
        self._uploaded = ""

    @property
    def workers(self) -> int:
        """Threads of all workers, of which each runs one task at a time, in a process of its own."""
        try:
            return max(1, sum(self._client.nthreads().values()))
        except GONE as trouble:
            raise _gone(trouble) from None

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """As `Executor.run`; raises WorkbenchError where the scheduler is lost, and where no worker is left."""
        waiting, running = iter(tasks), set[Any]()
        try:
            work, job, roots = self._sent(function, shared)

            def submit(count: int) -> None:
                for task in islice(waiting, count):
                    running.add(self._client.submit(operator.call, work, job, packed(task, roots), pure=False))

            submit(AHEAD * self.workers)
            while running:
                finished = self._finished(running)
                submit(len(finished))
                for future in finished:
                    running.discard(future)
                    record(_result(future.result()))
        except GONE as trouble:
            if isinstance(trouble, OSError) and self._client.status == "running":
                raise  # of the task, or of what records it
            raise _gone(trouble) from None
        except BaseException:
            self._give_up(running, record)
            raise

    def _sent(self, function: Callable[..., Any], shared: Any) -> tuple[Any, Any, frozenset[Path]]:
        """What every task of a job needs, at the workers: what runs it, the job, and the paths that were uploaded."""
        from distributed.diagnostics.plugin import UploadFile  # noqa: PLC0415 - as above

        made = archive({"children": Path(__file__).with_name("children.py")})
        if made.name != self._uploaded:
            with temporary_archive(made) as path:
                self._client.register_plugin(UploadFile(str(path)), name=made.name)
            self._uploaded = made.name
        work = self._client.submit(pkgutil.resolve_name, f"{made.name}.children:work")
        # A task like any other: it is made again where the worker that keeps it is lost.
        job = self._client.submit(bytes, job_head() + packed((KnownFolders(), function, shared), made.roots))
        return work, job, made.roots

    def _finished(self, running: set[Any]) -> set[Any]:
        """Those of some futures that have ended, at least one. Raises WorkbenchError where there is no worker left."""
        from distributed import wait  # noqa: PLC0415 - as above

        seen = time.monotonic()
        while True:
            try:
                found: set[Any] = wait(running, timeout=LOOK_S, return_when="FIRST_COMPLETED").done
                return found
            except TimeoutError:
                if self._client.status != "running":
                    continue  # it tries to reach the scheduler again, and gives up after ANSWER_S
                if self._client.nthreads():
                    seen = time.monotonic()
                elif time.monotonic() - seen > WORKER_S:
                    raise _no_worker() from None

    def _give_up(self, running: set[Any], record: Callable[[Any], None]) -> None:
        """Record what has finished and cancel the rest, which ends the processes that run it."""
        done = {future for future in running if future.status == "finished"}
        with suppress(*GONE):
            self._client.cancel(list(running - done))
            for said in self._client.gather(list(done), errors="skip"):
                if said != LOST and not said.startswith(ERROR):
                    record(_result(said))


def _result(said: bytes) -> Any:
    """What a task has answered, or its exception."""
    if said == LOST:
        raise WorkbenchError("the processes of a worker die again and again (out of memory, or killed): give them more "
                             "memory, and go on where the command can")
    found = answer_of(said[1:])
    if said.startswith(ERROR):
        raise found
    return found


def _gone(trouble: BaseException) -> WorkbenchError:
    return WorkbenchError(f"--dask: the scheduler is gone ({type(trouble).__name__}): start it again; what was "
                          "finished is kept where the command keeps it")

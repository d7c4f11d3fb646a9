"""A Dask cluster as an executor: `--dask ADDRESS`, or `--dask local` for a scheduler and workers of this machine.

A worker needs Python and the packages, not the workbench nor any paper: both are uploaded once, as an archive whose
package (`upload_start.py`) unpacks it there. Tasks name a function of a module and carry plain records; a path below
what was uploaded becomes the path of its copy.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from itertools import islice
from typing import Any, TypeVar

from workbench.errors import WorkbenchError
from workbench.files.modules import KnownFolders
from workbench.files.upload import archive, packed, temporary_archive
from workbench.simulate.executor import versions
from workbench.simulate.process_pool import cores, single_threaded

LOCAL = "local"
CONNECT_S = 30
# So many tasks are handed out for each that is run, so that no worker waits for the next one.
AHEAD = 2

T = TypeVar("T")
R = TypeVar("R")


@contextmanager
def cluster(address: str, workers: int | None = None) -> Iterator[Cluster]:
    """The cluster of that address while the block lasts; `local` is started, with so many workers, and ended.

    Raises WorkbenchError where Dask is not installed, nobody answers, there is no worker, or one has other versions.
    """
    try:
        from distributed import Client, LocalCluster  # noqa: PLC0415 - an extra, which others do without
    except ImportError:
        raise WorkbenchError("--dask needs Dask: pip install 'workbench[dask]'") from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what it says of lost workers is said here
    own = None
    try:
        if address == LOCAL:
            with single_threaded():
                own = LocalCluster(n_workers=workers or cores(), threads_per_worker=1, dashboard_address=None,
                                   silence_logs=logging.CRITICAL)
        try:
            client = Client(address if own is None else own, timeout=CONNECT_S, set_as_default=False)
        except (OSError, ValueError, TimeoutError) as trouble:
            raise WorkbenchError(f"--dask: no scheduler answers at {address} ({trouble}): check the address, as "
                                 "tcp://host:8786") from None
        with client:
            try:
                client.wait_for_workers(1, timeout=CONNECT_S)
            except TimeoutError:
                raise WorkbenchError(f"--dask: the scheduler at {address} has no worker: start some, as with 'dask "
                                     "worker'") from None
            yield Cluster(client)
    finally:
        if own is not None:
            own.close()


class Cluster:
    """The workers of a client, as an `Executor`."""

    def __init__(self, client: Any) -> None:
        self._client = client
        self._uploaded = ""

    @property
    def workers(self) -> int:
        """Threads of all workers, of which each runs one task at a time."""
        return sum(self._client.nthreads().values())

    def run(self, function: Callable[[Any, T], R], shared: Any, tasks: Iterable[T],
            record: Callable[[R], None]) -> None:
        """As `Executor.run`; tasks of a worker that is lost are run by others."""
        from distributed import wait  # noqa: PLC0415 - as above
        from distributed.client import FutureCancelledError  # noqa: PLC0415 - as above
        from distributed.scheduler import KilledWorker  # noqa: PLC0415 - as above

        waiting, running = iter(tasks), set[Any]()
        try:
            upload = self._upload()
            job = self._client.submit(bytes, packed((KnownFolders(), function, shared), upload.root), pure=True)

            def submit(count: int) -> None:
                running.update(self._client.submit(_work, upload.name, job, packed(task, upload.root), pure=False)
                               for task in islice(waiting, count))

            submit(AHEAD * self.workers)
            while running:
                finished = wait(running, return_when="FIRST_COMPLETED").done
                submit(len(finished))
                for future in finished:
                    result = future.result()
                    running.discard(future)
                    record(result)
        except KilledWorker:
            raise WorkbenchError("worker processes of the cluster die again and again (out of memory, or killed): give "
                                 "them more memory, and resume") from None
        except (FutureCancelledError, CancelledError, asyncio.CancelledError, TimeoutError, OSError) as trouble:
            raise WorkbenchError(f"the Dask cluster is gone ({type(trouble).__name__}): start it again, and "
                                 "resume") from None
        except BaseException:
            for future in running:
                if future.status == "finished":
                    record(future.result())
                else:
                    future.cancel()
            raise

    def _upload(self) -> Any:
        """The workbench and all that this process has read, on every worker, those that come later too."""
        from distributed.diagnostics.plugin import UploadFile  # noqa: PLC0415 - as above

        made = archive()
        if made.name != self._uploaded:
            with temporary_archive(made) as path:
                # Of workers alone: a scheduler may live in this process, which has the workbench already.
                self._client.register_plugin(UploadFile(str(path)), name=made.name)
            for address, found in self._client.run(versions).items():
                if found != versions():
                    raise WorkbenchError(f"--dask: worker {address} has {found}, but this process {versions()}: the "
                                         "same versions make the same numbers")
            self._uploaded = made.name
        return made


_jobs: dict[int, Any] = {}


def _work(upload: str, job: bytes, task: bytes) -> Any:
    """In a worker: one task of a job."""
    from workbench.files.upload import alone, unpacked  # noqa: PLC0415 - of the uploaded copy

    with alone():
        key = hash(job)
        if key not in _jobs:
            _jobs.clear()
            _jobs[key] = unpacked(job, upload)
        _, function, shared = _jobs[key]
        return function(shared, unpacked(task, upload))

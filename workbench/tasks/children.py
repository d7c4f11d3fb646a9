"""In a Dask worker: a process of its own for each task that runs at once, because a thread of the worker's can neither
be limited in time nor stopped, and to keep what the worker has imported apart from what was uploaded.

Standard library only, and imported from the archive (`files/upload.py`): the worker need not have the workbench.
"""

import os
import subprocess
import sys
import threading
from multiprocessing import Pipe
from typing import Any

# How often it is looked whether the answer is still wanted, and how many processes may die of one task.
LOOK_S, MOST_LOSSES = 0.25, 3
LOST, UNWANTED = b"lost", b"unwanted"
ENDED = ("closing", "closed", "failed")
SINGLE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS",
                        "VECLIB_MAXIMUM_THREADS"), "1")
START = "import sys; sys.path.insert(0, sys.argv[1]); from workbench.tasks.serving import serve; serve(*sys.argv[2:])"

_idle: list[Any] = []
_idle_lock = threading.Lock()


class Child:
    """A process that answers one task after another; it leaves when its end of the pipe is closed, or idle."""

    def __init__(self) -> None:
        upload = sys.modules[__package__]
        self.connection, theirs = Pipe()
        place = str(theirs.fileno())
        self.process = subprocess.Popen(
            [sys.executable, "-c", START, str(upload.CODE), place, str(upload.TREE)], stdin=subprocess.DEVNULL,
            pass_fds=(theirs.fileno(),), env=os.environ | SINGLE, process_group=0)
        theirs.close()
        self.job = b""

    def answer(self, job: bytes, task: bytes) -> bytes:
        """What it says to a task of a job; EOFError or OSError where it died, UNWANTED where nobody waits."""
        self.connection.send_bytes(b"" if job == self.job else job)
        self.connection.send_bytes(task)
        self.job = job
        while not self.connection.poll(LOOK_S):
            if not _wanted():
                return UNWANTED
        return self.connection.recv_bytes()

    def end(self) -> None:
        """Kill it, whatever it is doing."""
        self.process.kill()
        self.process.wait()
        self.connection.close()


def work(job: bytes, task: bytes) -> bytes:
    """The answer to one task of a job, as `serving` packs it; or LOST, where process after process dies of it."""
    for _ in range(MOST_LOSSES):
        child = _taken()
        said = b""
        try:
            said = child.answer(job, task)
        except (EOFError, OSError):
            continue
        finally:
            if said in (b"", UNWANTED):
                child.end()
        if said != UNWANTED:
            with _idle_lock:
                _idle.append(child)
        return said
    return LOST


def _taken() -> Child:
    with _idle_lock:
        while _idle:
            child: Child = _idle.pop()
            if child.process.poll() is None:
                return child
            child.end()
    return Child()


def _wanted() -> bool:
    """Whether somebody still waits for the task that this thread of a worker runs."""
    from distributed import get_worker  # noqa: PLC0415 - a worker has it, whoever reads this need not

    worker = get_worker()
    task = worker.state.tasks.get(worker.get_current_task())
    return task is not None and task.state != "cancelled" and worker.status.name not in ENDED

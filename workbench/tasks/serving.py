"""A process of a Dask worker that runs tasks (`children.Child` starts it): from the uploaded copy of this package."""

from __future__ import annotations

import json
import os
import signal
import threading
import traceback
from multiprocessing.connection import Connection
from pathlib import Path
from queue import Empty, Queue
from typing import Any

from workbench.errors import WorkbenchError
from workbench.files.paper_code import mistakes_told
from workbench.tasks.sent import answered, received
from workbench.tasks.versions import versions

IDLE_S = 5.0  # a process that nobody asks for so long leaves
RESULT, ERROR = b"r", b"e"


def job_head() -> bytes:
    """What a job begins with: the versions with which it wants to be run."""
    return json.dumps(versions()).encode() + b"\n"


def serve(number: str, tree: str) -> None:
    """Answer tasks that come through a pipe until it is closed; tree: where the sender's folders were unpacked."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    connection, asked = Connection(int(number)), Queue[tuple[bytes, bytes]]()
    threading.Thread(target=_listen, args=(connection, asked), daemon=True).start()
    place = Path(tree)
    function: Any = None
    shared: Any = None
    while True:
        try:
            packed_job, task = asked.get(timeout=IDLE_S)
        except Empty:
            return
        try:
            if packed_job:
                function, shared = _opened(packed_job, place)
            with mistakes_told():
                said = RESULT + answered(function(shared, received(task, place)), place)
        except BaseException as trouble:
            said = ERROR + _told(trouble, place)
        connection.send_bytes(said)


def _listen(connection: Connection, asked: Queue[tuple[bytes, bytes]]) -> None:
    """Pass on what is asked; end the process with the worker, whatever it is doing."""
    try:
        while True:
            asked.put((connection.recv_bytes(), connection.recv_bytes()))
    except (EOFError, OSError):
        os._exit(1)


def _opened(packed_job: bytes, place: Path) -> tuple[Any, Any]:
    head, _, packed = packed_job.partition(b"\n")
    wanted, here = json.loads(head), versions()
    if wanted != here:
        apart = ", ".join(f"{name} {here[name] or 'missing'} and not {wanted[name]}" for name in wanted
                          if wanted[name] != here.get(name))
        raise WorkbenchError(f"--dask: a worker on {os.uname().nodename} has {apart}: install the same versions there, "
                             "which make the same numbers")
    _, function, shared = received(packed, place)
    return function, shared


def _told(trouble: BaseException, place: Path) -> bytes:
    """An exception for whoever handed out the task, in words where it cannot be sent."""
    if not isinstance(trouble, WorkbenchError):
        trouble.add_note(f"In a worker process:\n{traceback.format_exc()}")
    try:
        said = answered(trouble, place)
        received(said, place)
    except Exception:
        said = answered(RuntimeError(f"{type(trouble).__name__}: {trouble}"), place)
    return said

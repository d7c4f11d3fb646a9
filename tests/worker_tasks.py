"""Tasks for worker processes: in a file of their own, because every process that is started imports it anew."""

import os
import signal
from pathlib import Path


def end_the_process(folder: str, task: int) -> int:
    """Of each task the first process that has it is killed."""
    mark = Path(folder) / str(task)
    if task in (2, 5) and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def square_from(offset: int, task: int) -> int:
    return offset + task * task

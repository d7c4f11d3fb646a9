"""What the server imports that processes of this machine come from; importing this module does it.

The standard library's own way leaves a server that has lost its parent importing to the end, which takes seconds, on a
busy machine a minute: only then does it see that it is alone.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module

from workbench.tasks.collection import imports_left_out

# Variables of the server's environment, with modules apart by commas, and the number of the process that starts it.
MODULES, PARENT = "WORKBENCH_SERVER_MODULES", "WORKBENCH_SERVER_PARENT"
EVERY_S = 0.25


def told(modules: list[str]) -> dict[str, str]:
    """What this process tells its server by the environment."""
    return {MODULES: ",".join(modules), PARENT: str(os.getpid())}


@contextmanager
def parent_watched(parent: int) -> Iterator[None]:
    """End this process once it is no child of `parent` while the block runs; after it no thread is left, since a
    process that is forked has none of them."""
    done = threading.Event()

    def watch() -> None:
        while not done.wait(EVERY_S):
            if os.getppid() != parent:
                os._exit(1)

    thread = threading.Thread(target=watch, daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


def import_told() -> None:
    """Import what the environment names, if it does; what cannot be imported here a worker will tell of."""
    if MODULES in os.environ:
        with parent_watched(int(os.environ[PARENT])), imports_left_out():
            for name in os.environ[MODULES].split(","):
                with suppress(ImportError):
                    import_module(name)


import_told()

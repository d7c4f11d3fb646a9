"""The command line in a process that is forked from this one, which has imported everything: as a new one, at once."""

from __future__ import annotations

import gc
import importlib
import os
import pkgutil
import sys
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path

import workbench
from workbench.cli.app import main


def import_everything() -> None:
    """So that no process pays for it."""
    for module in pkgutil.walk_packages(workbench.__path__, "workbench."):
        if ".template" not in module.name and not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    gc.collect()
    gc.freeze()  # so that a fork's collector need not touch, and so copy, what was imported


def forked(
    arguments: list[str],
    folder: Path,
    said: Path,
    environment: Mapping[str, str] | None = None,
    first: Callable[[], None] = lambda: None,
) -> int:
    """The number of a process, the first of a session of its own, that runs the command line in a folder.

    said: what it says goes there; first: is called in it before all else. It ends with 99 after an exception.
    """
    number = os.fork()
    if number:
        return number
    code = 99
    try:
        os.setsid()
        first()
        os.environ.update(environment or {})
        stream = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        for own, there in ((0, os.open(os.devnull, os.O_RDONLY)), (1, stream), (2, stream)):
            os.dup2(there, own)
        sys.stdout, sys.stderr = (
            os.fdopen(own, "w", encoding="utf-8", errors="backslashreplace", closefd=False) for own in (1, 2)
        )
        os.chdir(folder)
        sys.argv = ["workbench", *arguments]
        try:
            main()
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

"""What a paper's own code raises where it is called: told with its file and line, wherever that was."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workbench.errors import FROM_OUTSIDE, InputError, WorkbenchError
from workbench.files.mistakes import mistake
from workbench.files.text import is_source

PACKAGE = str(Path(__file__).parents[1])


@contextmanager
def mistakes_told() -> Iterator[None]:
    """Whatever a paper's own code raises in this block, to end the process too, becomes an InputError that names its
    file and line; what the workbench raises stays what it is."""
    try:
        yield
    except (WorkbenchError, *FROM_OUTSIDE):
        raise
    except BaseException as trouble:
        file = _raised_in(trouble)
        if file is None:
            raise
        raise InputError(file, "", mistake(trouble, file)) from trouble


def _raised_in(trouble: BaseException) -> str | None:
    """The file of a paper whose code has raised, or has called a library that has; None where the workbench did."""
    files = [frame.f_code.co_filename for frame, _ in traceback.walk_tb(trouble.__traceback__)]
    ours = [file for file in files if is_source(file) or file.startswith(PACKAGE)]
    return ours[-1] if ours and is_source(ours[-1]) else None

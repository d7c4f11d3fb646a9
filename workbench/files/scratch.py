"""A private folder for what another library writes, gone again when it has been read."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workbench.errors import InputError


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """An empty folder of this user's own (0700); InputError where none can be made."""
    try:
        made = tempfile.TemporaryDirectory(prefix="workbench-")
    except OSError as trouble:
        raise InputError(tempfile.gettempdir(), "", f"cannot hold a temporary folder ({trouble.strerror}): free space "
                         "there, or name another in TMPDIR") from None
    with made as name:
        yield Path(name)

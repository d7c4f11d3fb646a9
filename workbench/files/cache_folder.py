"""Where what was computed once is kept: compiled kernels and decided claims."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import platformdirs

CACHE_VARIABLE = "WORKBENCH_CACHE"


def cache_folder(kind: str) -> Path | None:
    """The folder of one kind of cached files in $WORKBENCH_CACHE or the user's cache; None where none is writable."""
    chosen = os.environ.get(CACHE_VARIABLE) or platformdirs.user_cache_dir("workbench")
    return writable(Path(chosen) / kind)


def writable(folder: Path) -> Path | None:
    """The folder, made where it is missing; None when nothing can be written there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return None


def write_whole(path: Path, text: str) -> None:
    """Write a file aside and rename it, so that no process ever reads half of it."""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, suffix=".tmp", delete=False) as stream:
        aside = Path(stream.name)
        try:
            stream.write(text)
            stream.close()
            aside.replace(path)
        except BaseException:
            aside.unlink(missing_ok=True)
            raise

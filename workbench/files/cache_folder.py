"""Where what was computed once is kept: compiled kernels and decided claims.

Both are believed when they are found again, so their folder must be one that no other user can write. Whoever can
write above it can put another folder in its place: that one then belongs to them, and so do the files in it, of which
readers ask that they are this user's.
"""

from __future__ import annotations

import atexit
import os
import shutil
import stat
import sys
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

import platformdirs

from workbench.errors import printable
from workbench.files.regular import belongs_to_us, contents
from workbench.files.writing import write_whole

CACHE_VARIABLE = "WORKBENCH_CACHE"
# What a process without a private folder made for itself; the processes that it starts use it too.
FRESH_VARIABLE = "WORKBENCH_FRESH_FOLDER"
# Stands in every folder of ours, as https://bford.info/cachedir has it: what has none is someone else's.
TAG, TAG_TEXT = "CACHEDIR.TAG", ("Signature: 8a477f597d28d172789f06886806bc55\n"
                                 "# What the workbench computed; this folder may be removed.\n")


def cache_folder(kind: str) -> Path | None:
    """The folder of one kind of cached files in $WORKBENCH_CACHE or the user's cache; None where none is private and
    writable."""
    chosen = os.environ.get(CACHE_VARIABLE) or platformdirs.user_cache_dir("workbench")
    return private(Path(chosen) / kind)


def temporary_folder(kind: str) -> Path | None:
    """The same in the system's temporary folder, under this user's number; where someone else has taken that name, a
    fresh folder for as long as this process runs. None where none can be written."""
    user = str(os.geteuid()) if hasattr(os, "geteuid") else "user"
    found = private(Path(tempfile.gettempdir()) / f"workbench-{kind}-{user}")
    if found is not None:
        return found
    given = os.environ.get(FRESH_VARIABLE)
    return (private(Path(given) / kind) if given else None) or _fresh(kind)


def private(folder: Path) -> Path | None:
    """The folder, made where it is missing and closed to others; None, with a note, where it is another user's or holds
    anything but what the workbench put there, and None when nothing can be written there."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        if not folder.exists() and not folder.is_symlink():
            folder.mkdir(mode=0o700, exist_ok=True)
        problem = _problem(folder) or _not_tagged(folder)
        if problem is not None:
            note(f"{folder} {problem}: it is not used")
            return None
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except (OSError, ValueError):
        return None


def keep(path: Path, text: str) -> None:
    """Write a file into a cache; a full disk costs time, not the result."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, text)


def drop(path: Path) -> None:
    """Remove a file or folder from a cache; what cannot be removed stays."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


@cache
def note(text: str) -> None:
    """Say something on stderr, once in this process, that costs time and no result."""
    sys.stderr.write(f"workbench: note: {printable(text)}\n")


def _problem(folder: Path) -> str | None:
    """Why what lies in a folder may be another user's."""
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode):
        return "is a link or a file, no folder"
    return None if belongs_to_us(status) else "belongs to another user"


def _not_tagged(folder: Path) -> str | None:
    """Why a folder may hold what is not ours; an empty one is made ours, and closed to others."""
    tag = folder / TAG
    if not tag.is_file():
        # Another process may be writing the tag.
        if any(not path.name.startswith(".workbench-") for path in folder.iterdir()) and not tag.is_file():
            return "holds files that are not the workbench's"
        write_whole(tag, TAG_TEXT)
    elif contents(tag, own=True) != TAG_TEXT.encode():
        return "holds files that are not the workbench's"
    if hasattr(os, "geteuid") and stat.S_IMODE(folder.stat().st_mode) & 0o077:
        folder.chmod(0o700)
    return None


@cache
def _fresh(kind: str) -> Path | None:
    try:
        made = tempfile.TemporaryDirectory(prefix=f"workbench-{kind}-")
        atexit.register(made.cleanup)
        os.environ[FRESH_VARIABLE] = made.name
        folder = Path(made.name) / kind
        folder.mkdir(mode=0o700)
        return folder
    except OSError:
        return None

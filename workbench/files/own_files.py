"""Files of ours in a folder that may hold others' files too: a manifest names ours, and nothing else is touched."""

from __future__ import annotations

import hashlib
import json
import stat
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.regular import contents
from workbench.files.writing import make_folder, remove_old, write_bytes

MANIFEST = "manifest.json"


def sha256(text: str) -> str:
    """The digest by which a manifest knows a file."""
    return hashlib.sha256(text.encode()).hexdigest()


def read_manifest(folder: Path, remedy: str) -> dict[str, Any] | None:
    """The manifest of a folder, None where there is none; InputError where something else has its name."""
    path = folder / MANIFEST
    if not _is_there(path):
        return None
    try:
        _require_regular(path, remedy)
        found = json.loads(contents(path))
    except InputError:
        raise
    except (OSError, ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise InputError(path, "", f"is no manifest of the workbench: move it away, or {remedy}")
    return found


def replace_files(folder: Path, within: Path, manifest: str, files: Mapping[str, str], before: Mapping[str, str],
                  stale: Mapping[str, str], is_ours: Callable[[str, bytes], bool], remedy: str) -> None:
    """Write a manifest and the files that it names, by name; drop stale ones.

    before: names and digests of the manifest that stands there. A file in the way that it does not name stays, and is
    InputError, unless `is_ours(name, bytes)`; a stale one is dropped only while it is what the manifest names.
    within: the folder that was asked for, which no link may lead out of.
    """
    _require_distinct(folder, files)
    make_folder(folder, within, remedy)
    for name, text in files.items():
        path = folder / name
        if not _is_there(path):
            continue
        _require_regular(path, remedy)
        if name not in before and not _holds(path, text) and not is_ours(name, _bytes(path, remedy)):
            raise InputError(path, "", f"is not a file that the workbench wrote: move it away, or {remedy}")
    for name, digest in stale.items():
        path = folder / name
        if _is_there(path) and stat.S_ISREG(path.lstat().st_mode) and _digest(path) == digest:
            remove_old(path)
    # The manifest first: what an interruption leaves is known as ours by the next call.
    for name, text in {MANIFEST: manifest, **files}.items():
        if not _holds(folder / name, text):
            write_bytes(folder / name, text.encode(), remedy)


def _is_there(path: Path) -> bool:
    return path.exists() or path.is_symlink()


def _require_regular(path: Path, remedy: str) -> None:
    if not stat.S_ISREG(path.lstat().st_mode):
        raise InputError(path, "", f"is a folder, a link or a pipe, where a file is written: move it away, or {remedy}")


def _require_distinct(folder: Path, files: Mapping[str, str]) -> None:
    """InputError where two names are one to a disk that does not tell capital letters from small ones."""
    seen: dict[str, str] = {}
    for name in (MANIFEST, *files):
        other = seen.setdefault(name.casefold(), name)
        if other != name:
            raise InputError(folder / name, "", f"and {other} are one file on many disks: rename one of them")


def _holds(path: Path, text: str) -> bool:
    try:
        return stat.S_ISREG(path.lstat().st_mode) and contents(path) == text.encode()
    except OSError:
        return False


def _bytes(path: Path, remedy: str) -> bytes:
    try:
        return contents(path)
    except OSError as trouble:
        raise InputError(path, "", f"cannot be read ({trouble.strerror}): move it away, or {remedy}") from None


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(contents(path)).hexdigest()
    except OSError:
        return ""

"""What decides: a digest of this package's proof sources and of the libraries they use."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterator
from functools import cache
from importlib import metadata
from pathlib import Path

from workbench.proof.dependencies import STARTED_NS, changed_since, known_sha256

SOURCES = Path(__file__).parent
LIBRARIES = ("sympy", "mpmath", "python-flint", "numpy", "scipy", "cvxpy", "clarabel", "scs", "osqp", "highspy", "lark")


def engine_digest(sources: Path = SOURCES) -> str | None:
    """sha256 over every file of the proof package, the versions of libraries and Python's minor version.

    None when a file has changed since this process started, because then nobody knows which version runs here.
    """
    total = hashlib.sha256()
    for path in sorted(_files(sources)):
        if changed_since(path, STARTED_NS):
            return None
        total.update(f"{path[len(str(sources)) + 1:].replace(os.sep, '/')} {known_sha256(path)}\n".encode())
    for name in LIBRARIES:
        total.update(f"{name} {_version(name)}\n".encode())
    python = f"{sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}"
    total.update(f"{python} {os.environ.get('SYMPY_GROUND_TYPES', '')}".encode())
    return total.hexdigest()


def _files(sources: Path) -> Iterator[str]:
    for folder, within, names in os.walk(sources):
        within[:] = [name for name in within if name != "__pycache__"]
        yield from (path for name in names if os.path.isfile(path := f"{folder}{os.sep}{name}"))  # noqa: PTH113


@cache  # what was imported stays what it is
def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "none"

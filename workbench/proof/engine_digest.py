"""What decides: a digest of this package's proof sources and of the libraries they use."""

from __future__ import annotations

import hashlib
import os
import sys
from importlib import metadata
from pathlib import Path

from workbench.files.regular import sha256_of
from workbench.proof.dependencies import STARTED_NS, changed_since

SOURCES = Path(__file__).parent
LIBRARIES = ("sympy", "mpmath", "python-flint", "numpy", "scipy", "cvxpy", "clarabel", "scs", "osqp", "highspy", "lark")


def engine_digest(sources: Path = SOURCES) -> str | None:
    """sha256 over every file of the proof package, the versions of libraries and Python's minor version.

    None when a file has changed since this process started, because then nobody knows which version runs here.
    """
    total = hashlib.sha256()
    for path in sorted(p for p in sources.rglob("*") if p.is_file() and "__pycache__" not in p.parts):
        if changed_since(path, STARTED_NS):
            return None
        body = sha256_of(path)
        total.update(f"{path.relative_to(sources).as_posix()} {body}\n".encode())
    for name in LIBRARIES:
        total.update(f"{name} {_version(name)}\n".encode())
    python = f"{sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}"
    total.update(f"{python} {os.environ.get('SYMPY_GROUND_TYPES', '')}".encode())
    return total.hexdigest()


def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "none"

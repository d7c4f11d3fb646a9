"""What the bytes of results depend on beside the code."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

# Rows have the same bytes where these are the same.
ALIKE = ("casadi", "numba", "numpy", "scipy", "sympy")


def versions() -> dict[str, str]:
    """What numbers depend on beside the code; empty for a package that is not there."""
    return {"python": platform.python_version(), **{name: _version(name) for name in ALIKE}}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""

"""What the bytes of results depend on beside the code."""

from __future__ import annotations

import platform
from importlib.metadata import version

# Rows have the same bytes where these are the same.
ALIKE = ("casadi", "numba", "numpy", "scipy", "sympy")


def versions() -> dict[str, str]:
    """What numbers depend on beside the code."""
    return {"python": platform.python_version(), **{name: version(name) for name in ALIKE}}

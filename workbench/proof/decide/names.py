"""Names for what a decider brings in."""

from __future__ import annotations

from collections.abc import Container
from itertools import count


def free_name(name: str, taken: Container[str]) -> str:
    """The name, with as many underscores behind it as it takes to be none of those taken."""
    return next(found for more in count() if (found := name + "_" * more) not in taken)

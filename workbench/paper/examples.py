"""The papers, lines, trains and contests that come with the workbench, written into a folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path


def write_examples(directory: Path) -> Iterator[str]:
    """Lines for the reader."""
    raise NotImplementedError
    yield ""

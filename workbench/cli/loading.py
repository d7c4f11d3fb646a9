"""A file or folder named at the command line, read once into a record that travels on."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from workbench.paper import loading
from workbench.paper.loading import CONTEST, Loaded

if TYPE_CHECKING:
    from workbench.paper.study import StudyKind


def load(path: Path) -> Loaded:
    """A scenario, a study, a contest, or a paper's folder; InputError naming file, key and remedy."""
    return loading.load(path, {CONTEST: _contest})


def _contest() -> StudyKind:
    from workbench.contest.study import KIND

    return KIND

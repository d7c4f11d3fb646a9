"""The error that every line which cannot be read ends in."""

from __future__ import annotations

from workbench.errors import WorkbenchError


class LatexError(WorkbenchError):
    """A line of LaTeX that cannot be read: names the place, counted in characters from 1, and the remedy."""

    def __init__(self, problem: str, position: int | None = None) -> None:
        self.problem = problem
        place = "" if position is None else f"at character {position + 1}: "
        super().__init__("".join(c if c.isprintable() else " " for c in place + problem))

"""How a run of mao2018's study went, as cells of tables and as words of sentences."""

from __future__ import annotations

from workbench.paper.cells import FORCES, Cell, Phrase, Scaled, cell_text

from .runs import RunResult


def summary(run: RunResult) -> Cell:
    """The largest error after the first event and what it settles to, or when it diverged."""
    return run.ended if run.failed else Phrase("{}, settles to {}", (Scaled(run.largest_m), Scaled(run.settled_m)))


def outcome(run: RunResult) -> str:
    """The same in a sentence's words."""
    return cell_text(run.ended) if run.failed else f"up to {length(run.largest_m)}, settling to {length(run.settled_m)}"


def length(metres: float) -> str:
    """An error as sentences have it."""
    return cell_text(Scaled(metres))


def force(newtons: float) -> str:
    """A force as sentences have it."""
    return cell_text(Scaled(newtons, FORCES))

"""Who tracks best under each condition at each period: the table that a contest's page begins with."""

from __future__ import annotations

from workbench.contest.by_period import TRACKING, at_each_period
from workbench.contest.tables import NAMED
from workbench.contest.told import COLUMNS, Told
from workbench.files.numbers import NOTHING
from workbench.paper.cells import Cell, Column, Phrase, Scaled
from workbench.paper.results import ResultTable


def best_trackers_table(told: Told) -> ResultTable | None:
    """A row a condition, a column a period, in a cell who is best by the position RMS (m) and what it reaches; None
    where all command alike often."""
    groups = list(at_each_period(told))
    if not groups:
        return None
    rows = [(stated.title, *(_best(own, name) for _, own in groups), float(told.runs(name)))
            for name, stated in told.contest.conditions.items() if told.runs(name)]
    return ResultTable(
        "Who tracks best", "from the runs", (
            "condition", *(f"a command every {1e3 * period:g} ms" for period, _ in groups),
            Column("draws", digits=None)), tuple(rows),
        f"By the {COLUMNS[TRACKING].title}, among those who command alike often; several stand in one place where they "
        "are not told apart. A trailing + marks the tuned parameters.")


def _best(own: Told, condition: str) -> Cell:
    best = own.best(condition, TRACKING)
    if not best:
        return "nobody arrives"
    known = [float(value.mean()) for value in own.ranked(condition, TRACKING) if value is not None]
    who = ", ".join(best) if len(best) <= NAMED else f"{len(best)} of {len(known)}"
    return Phrase(f"{who}: {{}}", (Scaled(min(known)),)) if known else NOTHING

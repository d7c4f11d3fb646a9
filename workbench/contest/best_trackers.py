"""Who tracks best under each condition at each period: the table that a contest's page begins with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.contest.by_period import TRACKING, at_each_period
from workbench.contest.tables import NAMED
from workbench.contest.told import COLUMNS, Told, label
from workbench.files.numbers import NOTHING
from workbench.paper.cells import LENGTHS, Cell, Column, Phrase, Quantity
from workbench.paper.results import ResultTable


def best_trackers_table(told: Told) -> ResultTable | None:
    """A row a condition, a column a period, in a cell who is best by the position RMS (m), the mean that each of them
    reaches and its interval; None where all command alike often."""
    groups = list(at_each_period(told))
    if not groups:
        return None
    rows = [(stated.title, *(_best(own, name) for _, own in groups), float(told.runs(name)))
            for name, stated in told.contest.conditions.items() if told.runs(name)]
    return ResultTable(
        "Who tracks best", "from the runs", (
            "condition", *(f"a command every {1e3 * period:g} ms" for period, _ in groups),
            Column("draws", digits=None)), tuple(rows),
        f"By the {COLUMNS[TRACKING].title}, among those who command alike often: means, in brackets their "
        f"{100 * told.contest.confidence:g} % intervals where there are draws enough. A tie: who stands in one place "
        "is not told apart. A trailing + marks the tuned parameters.")


def _best(own: Told, condition: str) -> Cell:
    winners, ranked = set(own.winners(condition, TRACKING)), own.ranked(condition, TRACKING)
    values = {entry.name: value for entry, value in zip(own.entries, ranked, strict=True) if value is not None}
    if not values:
        return "nobody arrives"
    best = [(label(group), values[group[0].name]) for group in own.alike if group[0].name in values
            and winners & {entry.name for entry in group}]
    if not best:
        return NOTHING
    best.sort(key=lambda one: float(one[1].mean()))
    if len(best) > NAMED:
        ends = (_length(float(value.mean())) for value in (best[0][1], best[-1][1]))
        return Phrase(f"tie of {len(best)} among {len(values)}: {{}} to {{}}", tuple(ends))
    told = [(name, *_with_interval(own, value)) for name, value in best]
    words = "; ".join(f"{name}: {shown}" for name, shown, _ in told)
    return Phrase(f"tie: {words}" if len(best) > 1 else words, tuple(part for *_, parts in told for part in parts))


def _with_interval(own: Told, values: NDArray[np.float64]) -> tuple[str, tuple[Quantity, ...]]:
    """A mean in the unit of its size and the ends of its interval in the same, and the words they stand in."""
    mean, found = _length(float(values.mean())), own.interval(values)
    if found is None:
        return "{}", (mean,)
    return "{} [{}, {}]", (mean, Quantity(found.low, si=mean.si), Quantity(found.high, si=mean.si))


def _length(value_m: float) -> Quantity:
    unit, si, _ = next((one for one in LENGTHS if abs(value_m) >= one[2]), LENGTHS[-1])
    return Quantity(value_m, unit, si)

"""Who tracks best under each condition and at what price, a sentence a condition: what a contest's page begins with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.contest.by_period import TRACKING, at_each_period
from workbench.contest.told import COLUMNS, Told
from workbench.files.numbers import length, number
from workbench.paper.cells import Quantity, cell_text
from workbench.proof.wording import listed

NAMED = 3  # so many that are not told apart are named, more are counted


def standings(told: Told) -> tuple[str, ...]:
    """A sentence a condition, by the position RMS, among those who command alike often."""
    groups = [(f"every {1e3 * period:g} ms ", own) for period, own in at_each_period(told)] or [("", told)]
    return tuple(f"{stated.title}: {'; '.join(when + _won(own, name) for when, own in groups)}."
                 for name, stated in told.contest.conditions.items() if told.runs(name))


def _won(told: Told, condition: str) -> str:
    """Who wins, by how much, what it takes, and who comes next."""
    ranked = told.ranked(condition, TRACKING)
    known = {i: value for i, value in enumerate(ranked) if value is not None}
    means = {i: float(value.mean()) for i, value in known.items()}
    if not means:
        return "nobody arrives"
    order = sorted(means, key=means.__getitem__)
    tied = told.best(condition, TRACKING)
    words = f"{_called(told, order[0])} wins" if len(tied) == 1 else (
        f"{listed(tied)} are not told apart" if len(tied) <= NAMED else f"{len(tied)} are not told apart")
    least = "" if len(tied) == 1 else f", the least being {_called(told, order[0])}'s"
    among = {name for label in tied for name in label.split(" = ")}
    behind = [i for i in order if told.entries[i].name not in among]
    following = f", then {_called(told, behind[0])} with {_measured(told, known[behind[0]])}" if behind else ""
    return (f"{words} with a {COLUMNS[TRACKING].title} of {_measured(told, known[order[0]])}{least}"
            f" ({_price(told, condition, order[0])}){following}")


def _measured(told: Told, values: NDArray[np.float64]) -> str:
    """The mean with its interval, where the draws are enough for one."""
    found = told.interval(values)
    mean = length(float(values.mean()))
    return mean if found is None else f"{mean} [{length(found.low)}, {length(found.high)}]"


def _called(told: Told, i: int) -> str:
    return next(" = ".join(entry.name for entry in group) for group in told.alike if told.entries[i] in group)


def _price(told: Told, condition: str, i: int) -> str:
    """Time a step, and energy where the run takes some."""
    steps = [match.step_us for match in told.of(condition, told.entries[i].name)]
    energy, column = told.values(condition, "energy_J")[i], COLUMNS["energy_J"]
    step = f"{number(float(np.median(steps)))} µs a step"
    return step if energy is None else f"{step}, {cell_text(Quantity(float(energy.mean()), column.unit, column.si))}"

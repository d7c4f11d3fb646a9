"""Who samples how often, said in every table that sets controllers of different periods beside each other."""

from __future__ import annotations

from dataclasses import replace

from workbench.contest.entrants import held_samples
from workbench.contest.record import Condition
from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.results import ResultTable
from workbench.trains.scenario import Scenario

PERIOD = Column("period", "ms", 1e-3, None)


def period_of(scenario: Scenario, name: str, condition: Condition | None = None) -> float:
    """Seconds between two commands of a controller, under a condition."""
    stated = scenario.controllers[name].period_s
    return (condition.period_s or stated if condition else stated) * held_samples(scenario, name)


def with_periods(table: ResultTable, scenario: Scenario, condition: Condition | None = None) -> ResultTable:
    """A table whose rows begin with entries, with their periods in the second column and in its title."""
    rows: list[tuple[Cell, ...]] = []
    found: set[float] = set()
    for name, *others in table.rows:
        own = dict.fromkeys(period_of(scenario, _controller(entry), condition) for entry in str(name).split(" = "))
        found.update(own)
        rows.append((name, next(iter(own)) if len(own) == 1 else
                     Phrase(" = ".join(["{}"] * len(own)), tuple(own)), *others))
    low, high = (f"{1e3 * end(found, default=0.0):g}" for end in (min, max))
    title = f"{table.title}; commands every {low if low == high else f'{low} to {high}'} ms"
    return replace(table, title=title, header=(table.header[0], PERIOD, *table.header[1:]), rows=tuple(rows))


def commands_every(scenario: Scenario) -> str:
    """How often who takes part commands, for a title."""
    found = [period_of(scenario, name) for name in scenario.controllers]
    low, high = (f"{1e3 * end(found, default=0.0):g}" for end in (min, max))
    return f"commands every {low if low == high else f'{low} to {high}'} ms"


def labelled(scenario: Scenario, entry: str) -> str:
    """An entry's name as curves are called: with its period where not all sample alike."""
    periods = {period_of(scenario, name) for name in scenario.controllers}
    return f"{entry}, {1e3 * period_of(scenario, _controller(entry)):g} ms" if len(periods) > 1 else entry


def _controller(entry: str) -> str:
    return entry.removesuffix("+")

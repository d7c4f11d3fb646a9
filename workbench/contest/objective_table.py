"""What tuning minimises, of the runs that count: in every condition, and in the worst of them."""

from __future__ import annotations

from collections.abc import Iterator

from workbench.contest.entrants import follows_curve
from workbench.contest.matches import Entry
from workbench.contest.sampling import with_periods
from workbench.contest.told import Told
from workbench.model.tuning import at_the_rail
from workbench.paper.cells import Cell
from workbench.paper.parameter_search import score
from workbench.paper.results import ResultTable


def objective_of(told: Told, entry: Entry, condition: str) -> float | None:
    """The mean over an entry's runs under a condition, a failed one at its price; None without an objective."""
    contest = told.contest
    goal = contest.tuning.objective if follows_curve(told.scenario, entry.controller) else contest.tuning.without_curve
    matches = told.of(condition, entry.name)
    if goal is None or not matches:
        return None
    units = at_the_rail(goal.units, contest.conditions[condition].acting(told.scenario) is not None)
    return sum(score(match.values, units, goal.failed) for match in matches) / len(matches)


def objective_table(told: Told) -> Iterator[ResultTable]:
    """A row per entry, a column per condition; none where nothing was tuned, or there is one condition alone."""
    contest = told.contest
    if len(contest.conditions) < 2 or not any(entry.tuned for entry in told.entries):
        return
    searched = {name for condition in contest.conditions for name in contest.tuned_in(condition)}
    counted = [contest.tuning.mode != "minimax" or name in searched for name in contest.conditions]
    rows: list[tuple[Cell, ...]] = []
    for entry in told.entries:
        found = [objective_of(told, entry, condition) for condition in contest.conditions]
        known = [value for value, counts in zip(found, counted, strict=True) if counts and value is not None]
        if known:
            rows.append((entry.name, *found, max(known)))
    goal, where = contest.tuning.objective, ", ".join(stated.title for name, stated in contest.conditions.items()
                                                      if name in searched)
    held = "" if searched.issuperset(contest.conditions) else "; others are held out"
    how = {"condition": "the mean in one condition", "per condition": "in each by itself",
           "minimax": "the worst of several"}[contest.tuning.mode]
    yield with_periods(ResultTable(
        "The objective by condition", "the runs that count", (
            "controller", *(stated.title for stated in contest.conditions.values()),
            "the worst" if all(counted) else "the worst that was tuned for"), tuple(rows),
        f"The mean of what tuning minimises, without intervals; a failed run costs {goal.failed:g} for each of its "
        f"parts. + was tuned for {how}: {where}{held}."), told.scenario)

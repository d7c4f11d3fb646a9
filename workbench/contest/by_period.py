"""Who wins among those who sample alike: a contest of several periods is as many contests, with the same runs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from workbench.contest.entrants import learns
from workbench.contest.sampling import period_of
from workbench.contest.tables import winners_table
from workbench.contest.told import COLUMNS, Told
from workbench.files.numbers import counted, number
from workbench.paper.results import ResultTable
from workbench.proof.wording import listed

TRACKING = "position_rms"


def at_each_period(told: Told) -> Iterator[tuple[float, Told]]:
    """(s, the matches of those who command so often), the shortest first; nothing where all sample alike.

    Entries are ranked among themselves, so that Holm's correction is over their own comparisons.
    """
    names: dict[float, list[str]] = {}
    for name in told.scenario.controllers:
        names.setdefault(period_of(told.scenario, name), []).append(name)
    for period, group in sorted(names.items()) if len(names) > 1 else ():
        scenario = told.scenario.model_copy(update={"controllers": {
            name: told.scenario.controllers[name] for name in group}})
        own = replace(told, scenario=scenario)
        taking_part = {entry.name for entry in own.entries}
        if len(taking_part) > 1:
            yield period, replace(own, matches=tuple(match for match in told.matches if match.entry in taking_part))


def period_tables(told: Told) -> Iterator[ResultTable]:
    """Who wins where, a table for each period."""
    for _, own in at_each_period(told):
        yield winners_table(own)


def period_findings(told: Told) -> Iterator[str]:
    """The best tracker of each period where tuning was, with its interval, and whom it is apart from."""
    condition = told.contest.tuning.condition
    if not told.runs(condition):  # not among those that are played
        return
    for period, own in at_each_period(told):
        ranked = own.ranked(condition, TRACKING)
        means = {i: float(value.mean()) for i, value in enumerate(ranked) if value is not None}
        if not means:
            continue
        order = sorted(means, key=means.__getitem__)
        tied = set(own.rankings[condition, TRACKING].winners)
        names = [entry.name for entry in own.entries]
        said = [f"{names[i]}, {_interval(own, i, condition)}," for i in order if i in tied]
        others = [i for i in order if i not in tied]
        first = "it" if len(said) == 1 else "the first"  # whom alone all others are compared with
        behind = f"nobody else is told apart from {first}"
        if others:
            behind = f"the next that is told apart from {first} is {names[others[0]]}, " + _interval(
                own, others[0], condition)
        learners = sum(learns(own.scenario, own.entries[i].controller) for i in means)
        words = f", {learners} of them judged on the last of several trips" if learners else ""
        where = f"{own.contest.conditions[condition].title}, {counted(own.runs(condition), 'draw')}"
        metric = COLUMNS[TRACKING].title
        has = "has" if len(said) == 1 else "have"
        yield (f"With a command every {1e3 * period:g} ms, {listed(said)} {has} the least {metric}; {behind} "
               f"({where}; {len(means)} arrive{words}).")


def _interval(told: Told, i: int, condition: str) -> str:
    values = told.values(condition, TRACKING)[i]
    assert values is not None
    found = told.interval(values)
    unit = COLUMNS[TRACKING].unit
    return f"{number(float(values.mean()))} {unit}" + (
        f" [{number(found.low)}, {number(found.high)}]" if found else "")

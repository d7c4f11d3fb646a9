"""What tuning found and how it got there: the objective's value, ranges that bind, and how the restarts agree."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.contest.entrants import follows_curve
from workbench.contest.sampling import with_periods
from workbench.contest.told import COLUMNS, Told
from workbench.files.numbers import counted, number
from workbench.model.tuning import SearchResult
from workbench.paper.cells import Cell, Phrase
from workbench.paper.parameter_search import binding
from workbench.paper.results import Curve, Plot, ResultTable


def searches(told: Told) -> Iterator[tuple[str, str, dict[str, float], SearchResult | None]]:
    """(controller, condition or "", what was found, how) of every search of those who take part."""
    tuning = told.contest.tuning
    names = [entry.controller for entry in told.entries if entry.tuned]
    for name in names:
        if name in tuning.found:
            yield name, "", tuning.found[name], tuning.results.get(name)
    for condition, found in tuning.found_in.items():
        for name in names:
            if name in found:
                yield name, condition, found[name], tuning.results_in.get(condition, {}).get(name)


def _worst_of(told: Told) -> str:
    """Of which conditions the worst is minimised."""
    contest = told.contest
    titles = ", ".join(contest.conditions[name].title for name in contest.tuned_in(""))
    return f" The worst is of the objective's means in {titles}." if contest.tuning.mode == "minimax" else ""


def _same_runs(told: Told) -> str:
    """Where nothing is drawn, the search met the very run that counts."""
    tuning = told.contest.tuning
    conditions = {name for condition in (told.contest.conditions if tuning.mode == "per condition" else [""])
                  for name in told.contest.tuned_in(condition)}
    exact = [stated.title for name, stated in told.contest.conditions.items() if name in conditions
             and not stated.random]
    return f" Nothing is drawn in {', '.join(exact)}, so that what counts there was tuned on that very run." if exact \
        else ""


def tuning_table(told: Told) -> Iterator[ResultTable]:
    """A row per search; none where nothing was tuned."""
    contest, rows = told.contest, list[tuple[Cell, ...]]()
    for name, condition, found, result in searches(told):
        ends = {key: binding(value, contest.tuning.ranges[name][key]) for key, value in found.items()}
        binds = ", ".join(f"{key} ({end})" for key, end in ends.items() if end) or "none"
        where = contest.conditions[condition].title if condition in contest.conditions else condition or _where(told)
        if result is None:
            rows.append((name, where, None, None, None, "not kept", binds))
            continue
        last = tuple(restart[-1][1] for restart in result.improvements)
        rows.append((name, where, result.stated_cost, result.cost, result.evaluations,
                     Phrase(", ".join("{}" for _ in last), last), binds))
    if rows:
        yield with_periods(ResultTable(
            "What tuning found", "the contest's file, as workbench tune wrote it", (
                "controller", "tuned in", "objective, as stated", "objective, tuned", "evaluations",
                "objective by restart", "ranges that bind"), tuple(rows),
            f"The objective on the draws of the search, which are none of the contest's; line, curve and gusts are the "
            f"same.{_worst_of(told)}{_same_runs(told)} A range binds where what was found lies within 1 % of its end, "
            "on the logarithmic scale on which it is searched: a wider one may do better. Restarts that end far "
            "apart say that the search has not come to rest."), told.scenario)


def _where(told: Told) -> str:
    contest = told.contest
    if contest.tuning.mode != "minimax":
        return contest.conditions[contest.tuning.condition].title
    return f"the worst of {len(contest.tuned_in(''))}"


def convergence_plot(told: Told) -> Iterator[Plot]:
    """How far above what was found the slowest restart still is, by evaluation; none where nothing was kept."""
    curves = []
    for name, condition, _, result in searches(told):
        if result is None or not result.cost > 0:
            continue
        count = result.evaluations // len(result.improvements)
        each = np.array([_best_so_far(restart, count) for restart in result.improvements]) / result.cost
        curves.append(Curve(f"{name}{f', {condition}' if condition else ''}", np.arange(1.0, count + 1),
                            each.max(axis=0)))
    if curves:
        yield Plot("Convergence of tuning", "the contest's file", "evaluation of a restart",
                   "objective of the slowest restart / of what was found", tuple(curves), log_y=True,
                   note="1 is the best of all restarts; the curves of each seed are in the contest's file")


def _best_so_far(improvements: tuple[tuple[int, float], ...], count: int) -> list[float]:
    numbers, costs = zip(*improvements, strict=True)
    return [costs[i - 1] for i in np.searchsorted(numbers, np.arange(1, count + 1), side="right").tolist()]


def tuning_findings(told: Told) -> Iterator[str]:
    """What tuning brought, a sentence for each who was tuned."""
    contest, names = told.contest, [entry.name for entry in told.entries]
    condition = contest.tuning.condition
    for entry in told.entries:
        if not entry.tuned or entry.controller not in names:
            continue
        metric, words = (("position_rms", "position RMS {} m → {} m") if follows_curve(told.scenario, entry.controller)
                         else ("energy_J", "energy {} kWh → {} kWh"))
        before, after = (told.values(condition, metric)[names.index(name)] for name in (entry.controller, entry.name))
        result = contest.result_for(entry.controller, condition)
        spent = f" ({counted(result.evaluations, 'evaluation')})" if result else ""
        if before is not None and after is not None:
            change = words.format(*(number(float(value.mean()) / COLUMNS[metric].si) for value in (before, after)))
            yield f"Tuning of {entry.controller}{spent}: {change} under {contest.conditions[condition].title}."

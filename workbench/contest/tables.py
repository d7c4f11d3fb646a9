"""The tables of a contest: every condition, who wins where, and what a control step costs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.contest.effort import mpc_table
from workbench.contest.entrants import follows_curve, held_samples, information
from workbench.contest.matches import METRICS, OF_CURVE, Entry, Match, entries, looks, of
from workbench.contest.record import Contest
from workbench.contest.sampling import with_periods
from workbench.files.numbers import number
from workbench.files.units import KWH_J
from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.comparison import STEP
from workbench.paper.results import ResultTable
from workbench.paper.statistics import Bootstrap, Ranking, mean_interval, rankings
from workbench.trains.scenario import Scenario

# Metrics of a match, SI.
COLUMNS = {"position_rms": Column("position RMS", "m"), "speed_rms": Column("speed RMS", "m/s"),
           "largest_position_error": Column("largest |position error|", "m"),
           "stopping_error": Column("|stopping error|", "m"), "energy_J": Column("energy", "kWh", KWH_J),
           "jerk_rms": Column("jerk RMS", "m/s³"), "jerk_p95": Column("jerk, 95th percentile", "m/s³"),
           "jerk_max": Column("largest jerk", "m/s³"), "comfort_rms": Column("comfort, ISO 2631 RMS", "m/s²"),
           "command_variation": Column("command variation", "m/s³"), "saturated_fraction": Column("saturated"),
           "band_share": Column("beyond the band"), "switchings_per_s": Column("traction/brake changes", "1/s"),
           "late_s": Column("still moving after the arrival time", "s"),
           "overspeed_mps": Column("beyond the speed limits", "m/s")}
# A run that ends farther from the end of the line has not made the trip: what it saves is no merit.
ARRIVED_M = 5.0
# Means that differ by a smaller share are one number in the tables: where nothing is drawn, an interval has no width.
ALIKE = 1e-3
# So many are named where nobody is alone the best.
NAMED = 4


@dataclass(frozen=True)
class Told:
    """A contest with its matches."""

    contest: Contest
    scenario: Scenario
    matches: tuple[Match, ...]
    lower_bound_j: float | None

    @property
    def entries(self) -> tuple[Entry, ...]:
        """Who takes part."""
        return entries(self.contest, self.scenario)

    @property
    def metrics(self) -> tuple[str, ...]:
        """METRICS, without what this line knows none of."""
        return tuple(name for name in METRICS if name != "overspeed_mps" or self.scenario.track.speed_limit)

    def judged(self, entry: Entry, metric: str) -> bool:
        """Whether a metric says anything about an entry: errors from the curve do not where none is followed."""
        return metric not in OF_CURVE or follows_curve(self.scenario, entry.controller)

    @property
    def how(self) -> Bootstrap:
        """How intervals are made."""
        return Bootstrap(self.contest.resamples, self.contest.seed, self.contest.confidence)

    def runs(self, condition: str) -> int:
        """How many runs every entry has under a condition."""
        return max((match.draw for match in self.matches if match.condition == condition), default=-1) + 1

    def values(self, condition: str, metric: str) -> list[NDArray[np.float64] | None]:
        """A metric by entry and draw; None for an entry with a failed run."""
        found = []
        for entry in self.entries:
            row = [match.values[metric] for match in of(self.matches, condition, entry.name)]
            found.append(None if None in row else np.array(row, dtype=float))
        return found

    def arrives(self, condition: str) -> list[bool]:
        """By entry: whether every run ends within ARRIVED_M of the end of the line."""
        return [value is not None and bool(value.max() <= ARRIVED_M)
                for value in self.values(condition, "stopping_error")]

    def ranked(self, condition: str, metric: str) -> list[NDArray[np.float64] | None]:
        """The values of those who can be ranked: their runs all arrive, and the metric says something about them."""
        return [value if arrived and self.judged(entry, metric) else None for entry, value, arrived in zip(
            self.entries, self.values(condition, metric), self.arrives(condition), strict=True)]

    @cached_property
    def rankings(self) -> dict[tuple[str, str], Ranking]:
        """(condition, metric) -> who is best, corrected for all of them together.

        With racing at the level of one of its looks, since a contest that may end early asks more than once.
        """
        return rankings({(condition, metric): self.ranked(condition, metric)
                         for condition in self.contest.conditions for metric in self.metrics},
                        look(self.contest), ALIKE)

    def winners(self, condition: str, metric: str) -> list[str]:
        """Names of the entries that are not worse than the best by more than chance, among those that arrive.

        Who is not judged by the metric is left out.
        """
        return [self.entries[i].name for i in sorted(self.rankings[condition, metric].winners)]

    def best(self, condition: str, metric: str) -> list[str]:
        """`winners` as tables call them: entries whose runs agree are one."""
        found = set(self.winners(condition, metric))
        return [label(group) for group in self.alike if found & {entry.name for entry in group}]

    @cached_property
    def alike(self) -> tuple[tuple[Entry, ...], ...]:
        """The entries, those together whose runs agree within ALIKE in every metric of every draw and condition."""
        groups: list[list[Entry]] = []
        rows = {entry.name: [list(match.values.values()) for match in self.matches if match.entry == entry.name]
                for entry in self.entries}
        for entry in self.entries:
            for group in groups:
                if _agree(rows[entry.name], rows[group[0].name]):
                    group.append(entry)
                    break
            else:
                groups.append([entry])
        return tuple(map(tuple, groups))


def label(group: Sequence[Entry]) -> str:
    """What entries that are told as one are called."""
    return " = ".join(entry.name for entry in group)


def _agree(one: list[list[float | None]], other: list[list[float | None]]) -> bool:
    """Whether all numbers are the same to a thousandth of the largest of their metric, and failed in the same runs."""
    a, b = np.array(one, dtype=float), np.array(other, dtype=float)
    if a.size == 0 or a.shape != b.shape or not np.array_equal(np.isnan(a), np.isnan(b)) or np.isnan(a).all():
        return False
    scale = np.nanmax(np.abs(a), axis=0, initial=0.0)
    return bool(np.all(np.isnan(a) | (np.abs(a - b) <= ALIKE * scale)))


def look(contest: Contest) -> Bootstrap:
    """How a ranking is decided: in a race at the level of one of its looks, so that all of them err no more."""
    return Bootstrap(contest.resamples, contest.seed, 1 - (1 - contest.confidence) / looks(contest))


def condition_table(told: Told, condition: str) -> ResultTable:
    """A row per entry: means with their intervals, failed runs."""
    stated = told.contest.conditions[condition]
    rows = []
    best = {metric: told.best(condition, metric) for metric in told.metrics}
    columns = {metric: told.values(condition, metric) for metric in told.metrics}
    numbers = {entry: i for i, entry in enumerate(told.entries)}
    for group in told.alike:
        entry, i = group[0], numbers[group[0]]
        matches = of(told.matches, condition, entry.name)
        failed = sum(match.failed is not None for match in matches)
        cells: list[Cell] = [label(group)]
        for metric in told.metrics:
            value = columns[metric][i]
            mark = " ●" if label(group) in best[metric] else "" if told.judged(entry, metric) else " (follows no curve)"
            cells.append(None if value is None else _interval(value, told.how, mark))
        rows.append((*cells, Phrase("{} of {}", (failed, len(matches)))))
    runs = told.runs(condition)
    noisy = stated.position_noise_m or stated.speed_noise_mps
    noise = " Noise is drawn anew at every sample, so that who samples more often has more to average." if noisy else ""
    return ResultTable(
        stated.title, f"{runs} run{'s' if runs > 1 else ''} each, the same draws for all",
        ("controller", *(COLUMNS[metric] for metric in told.metrics), "failed"), tuple(rows),
        f"Means, in brackets their {100 * told.contest.confidence:g} % bootstrap interval (BCa). ● the best, and every "
        "one whose paired difference from it may be chance, by Holm's correction over all metrics and conditions; = "
        f"joins those whose runs agree within {100 * ALIKE:g} % in all of them. A controller with a run that fails, or "
        f"that misses the end by more than {ARRIVED_M:g} m, is not ranked; nor is one by errors from a curve that it "
        "does not follow."
        + noise)


def _interval(values: NDArray[np.float64], how: Bootstrap, mark: str) -> Cell:
    found = mean_interval(values, how)
    if len(values) == 1:
        return Phrase(f"{{}}{mark}", (found.mean,)) if mark else found.mean
    return Phrase(f"{{}} [{{}}, {{}}]{mark}", (found.mean, found.low, found.high))


def winners_table(told: Told) -> ResultTable:
    """Who wins where: a row per condition, a column per metric."""
    rows = []
    for name, condition in told.contest.conditions.items():
        cells = []
        for metric in told.metrics:
            found = told.best(name, metric)
            cells.append("none arrives" if not found else found[0] if len(found) == 1 else
                         f"tie: {', '.join(found)}" if len(found) <= NAMED else f"tie of {len(found)}")
        rows.append((condition.title, *cells))
    return ResultTable(
        "Who wins where", "the tables below", ("condition", *(COLUMNS[metric].heading for metric in told.metrics)),
        tuple(rows),
        "A difference that may be chance, by Holm's correction over all metrics and conditions, or of less than a "
        "thousandth, is no win: then all that may be best are named or counted. Ranked are those "
        f"whose runs all end within {ARRIVED_M:g} m of the end of the line. A trailing + marks the tuned parameters.")


def contestants_table(told: Told) -> ResultTable:
    """What each controller knows, its period, what a step costs, what tuning found."""
    rows = []
    for entry in told.entries:
        spec = told.scenario.controllers[entry.controller]
        steps = [match.step_us for match in told.matches if match.entry == entry.name]
        parameters = told.contest.tuning.found.get(entry.controller, {}) if entry.tuned else {}
        cost = _objective(told, entry)
        rows.append((entry.name, spec.title or spec.law, information(told.scenario, entry.controller),
                     spec.period_s * held_samples(told.scenario, entry.controller),
                     float(np.median(steps)) * STEP.si, cost,
                     _parameters(parameters) if parameters else "by condition" if entry.tuned else "as stated"))
    return ResultTable("The contestants", "the contest's file", (
        "controller", "law", "is told", Column("period", "ms", 1e-3, None), STEP, "objective", "parameters"),
        tuple(rows),
        "Time a step: a compiled law in blocks with the plant, MPC call by call without it. Objective: what tuning "
        "minimises, on the draws of the search; of who has other parameters in each condition the least and the most.")


def _objective(told: Told, entry: Entry) -> Cell:
    found = [result for name in told.contest.conditions
             if (result := told.contest.result_for(entry.controller, name)) is not None]
    costs = [result.cost if entry.tuned else result.stated_cost for result in found]
    if not costs:
        return None
    return costs[0] if min(costs) == max(costs) else Phrase("{} to {}", (min(costs), max(costs)))


def _parameters(values: Mapping[str, float]) -> Cell:
    return Phrase(", ".join(f"{key} = {{}}" for key in values),
                  tuple(Quantity(value, digits=None) for value in values.values()))


def energy_table(told: Told) -> Iterator[ResultTable]:
    """Every entry's energy under the first condition against the certified lower bound of any run in that time."""
    if told.lower_bound_j is None:
        return
    condition = next(iter(told.contest.conditions))
    rows: list[tuple[Cell, ...]] = []
    for entry, energy, miss, late, arrived in zip(
            told.entries, told.values(condition, "energy_J"), told.values(condition, "stopping_error"),
            told.values(condition, "late_s"), told.arrives(condition), strict=True):
        if energy is None or miss is None or late is None:
            rows.append((entry.name, None, None, None, "fails"))
            continue
        above = float(energy.mean()) / told.lower_bound_j - 1
        rows.append((entry.name, float(energy.mean()), above if arrived else None, float(late.mean()),
                     "arrives" if arrived else Phrase("misses the end by {} m", (float(miss.max()),))))
    yield ResultTable(
        "Energy against the certified lower bound", f"condition: {told.contest.conditions[condition].title}",
        ("controller", COLUMNS["energy_J"], Column("above the bound", "%", 0.01), COLUMNS["late_s"], "the trip"),
        tuple(rows),
        f"No run of the nominal train over this line in the desired curve's time takes less than "
        f"{number(told.lower_bound_j / COLUMNS['energy_J'].si)} kWh of traction. Who tracks the curve pays for the "
        "curve; a run that takes longer than the curve is not held by the bound.")


def absent_table(told: Told) -> Iterator[ResultTable]:
    """Who does not take part, and why."""
    if told.contest.absent:
        yield ResultTable("Who does not take part", "the contest's file", ("law", "because"),
                          tuple(told.contest.absent.items()))


def all_tables(told: Told) -> Iterator[ResultTable]:
    """In the order of the page."""
    yield winners_table(told)
    yield contestants_table(told)
    yield from mpc_table(told.scenario, told.entries, told.matches)
    for condition in told.contest.conditions:
        yield with_periods(condition_table(told, condition), told.scenario, told.contest.conditions[condition])
    for table in energy_table(told):
        yield with_periods(table, told.scenario, next(iter(told.contest.conditions.values())))
    yield from absent_table(told)

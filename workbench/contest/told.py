"""A contest with its matches: who is compared by what, and who is best."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.contest.entrants import follows_curve
from workbench.contest.matches import METRICS, OF_CURVE, Entry, Match, entries, looks
from workbench.contest.record import FEWEST_DRAWS, Contest
from workbench.files.units import KWH_J
from workbench.paper.cells import Column
from workbench.paper.statistics import Bootstrap, Interval, Ranking, mean_interval, rankings
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
# A run that ends farther from the end of the line has not made the trip: what it saves is no merit. Nor is it one to
# come later and take less energy for it.
ARRIVED_M, LATE_S = 5.0, 1.0
# Means that differ by a smaller share are one number in the tables: where nothing is drawn, an interval has no width.
ALIKE = 1e-3


@dataclass(frozen=True)
class Told:
    """A contest with its matches."""

    contest: Contest
    scenario: Scenario
    matches: tuple[Match, ...]
    lower_bound_j: float | None

    @cached_property
    def entries(self) -> tuple[Entry, ...]:
        """Who takes part."""
        return entries(self.contest, self.scenario)

    @cached_property
    def _by_entry(self) -> dict[tuple[str, str], list[Match]]:
        """(condition, entry) -> matches: tables ask for them thousands of times, and there may be tens of thousands."""
        found: dict[tuple[str, str], list[Match]] = {}
        for match in self.matches:
            found.setdefault((match.condition, match.entry), []).append(match)
        return found

    def of(self, condition: str, entry: str) -> list[Match]:
        """The matches of one entry under one condition, by draw."""
        return self._by_entry.get((condition, entry), [])

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
            row = [match.values[metric] for match in self.of(condition, entry.name)]
            found.append(None if None in row else np.array(row, dtype=float))
        return found

    def arrives(self, condition: str) -> list[bool]:
        """By entry: whether every run ends within ARRIVED_M of the end of the line."""
        return [value is not None and bool(value.max() <= ARRIVED_M)
                for value in self.values(condition, "stopping_error")]

    def on_time(self, condition: str) -> list[bool]:
        """By entry: whether every run arrives, and stands LATE_S after the arrival time."""
        return [arrived and late is not None and bool(late.max() <= LATE_S) for arrived, late in zip(
            self.arrives(condition), self.values(condition, "late_s"), strict=True)]

    def ranked(self, condition: str, metric: str) -> list[NDArray[np.float64] | None]:
        """The values of those who can be ranked: their runs all arrive, for energy on time, and the metric says
        something about them."""
        able = self.on_time(condition) if metric == "energy_J" else self.arrives(condition)
        return [value if arrived and self.judged(entry, metric) else None for entry, value, arrived in zip(
            self.entries, self.values(condition, metric), able, strict=True)]

    @property
    def bounded(self) -> tuple[str, ...]:
        """The conditions in which the bound on the energy holds: the nominal train on the line as it is, all motors."""
        return tuple(name for name, stated in self.contest.conditions.items()
                     if self.lower_bound_j is not None and not (stated.random or stated.level or stated.failed_share))

    def interval(self, values: NDArray[np.float64]) -> Interval | None:
        """Of the mean; None for fewer draws than an interval can be made of, of which the mean alone is told."""
        return mean_interval(values, self.how) if len(values) >= FEWEST_DRAWS else None

    @property
    def fewest(self) -> int:
        """So many draws it takes to tell one condition's best apart in one metric: with fewer, all of one sign are no
        more than chance among so many comparisons."""
        comparisons = len(self.metrics) * len(self.contest.conditions)
        return math.ceil(1 + math.log2(comparisons / (1 - look(self.contest).confidence)))

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

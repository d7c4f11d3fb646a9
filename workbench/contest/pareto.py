"""What tracking costs: for every controller the best it can do in energy, and in comfort, for each error it allows.

For each weight CMA-ES minimises the weighted sum of both, scaled by what the two ends of the front come to. All that is
evaluated on the way, for any weight and either front, is pooled; what nothing else beats in both is driven again on the
contest's own draws, and is the front.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from workbench.contest.entrants import follows_curve
from workbench.contest.matches import match_values, run_match
from workbench.contest.record import Contest, Pareto
from workbench.contest.sampling import labelled, with_periods
from workbench.contest.told import ARRIVED_M, COLUMNS
from workbench.contest.tune import DRAWS_FROM
from workbench.errors import InputError
from workbench.model.tuning import Range, is_whole
from workbench.paper.cells import Cell, Phrase
from workbench.paper.parameter_search import search
from workbench.paper.results import Curve, Plot, ResultTable
from workbench.simulate.journal import REMEDY, Journal
from workbench.tasks.handing_out import results_of
from workbench.trains.scenario import Scenario, tunable, with_parameters

JOURNAL_NAME = "pareto.journal.jsonl"
TRACKING, AGAINST = "position_rms", ("energy_J", "comfort_rms")
# What a run costs that fails, misses the end or comes late, where 1 is the worse end of the front.
LOST = 100.0
# Of a range, on a logarithmic scale: how far to both sides of the best point so far a weight is searched.
NEAR = 0.2
END_ROUNDS = 3
Scale = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True)
class Point:
    """Parameters of a controller, and what their runs come to on the mean, SI."""

    parameters: dict[str, float]
    position_rms: float
    energy_J: float
    comfort_rms: float
    late_s: float


@dataclass(frozen=True)
class Front:
    """The points of one controller that none of its others beats both in tracking and in `against`, by tracking."""

    controller: str
    against: str
    points: tuple[Point, ...]
    evaluations: int


def who(contest: Contest, scenario: Scenario) -> list[str]:
    """Whose fronts are asked for; InputError for one that has no ranges, or follows no curve."""
    stated = _stated(contest)
    for name in stated.controllers:
        if name not in contest.tuning.ranges or name not in scenario.controllers:
            raise InputError("", "pareto.controllers", f"'{name}' is no controller with ranges: choose among "
                             f"{', '.join(contest.tuning.ranges)}")
        if not follows_curve(scenario, name):
            raise InputError("", "pareto.controllers", f"'{name}' follows no curve, so that it has no tracking error: "
                             "leave it out")
    return list(stated.controllers) or [name for name in contest.tuning.ranges if name in scenario.controllers
                                        and follows_curve(scenario, name)]


def _stated(contest: Contest) -> Pareto:
    if contest.pareto is None:
        raise InputError("", "pareto", "is missing: name its condition in this table")
    return contest.pareto


def driven(contest: Contest, scenario: Scenario, name: str, parameters: Mapping[str, float], first: int, seed: int
           ) -> Point | None:
    """The mean over draws from a first one on; None where one fails, misses the end or comes too late."""
    stated = _stated(contest)
    changed, condition = with_parameters(scenario, name, dict(parameters)), contest.conditions[stated.condition]
    rows = []
    for draw in range(first, first + (stated.draws if condition.random else 1)):
        values = match_values(run_match(changed, name, condition, draw, seed), changed)
        late, missed = values["late_s"], values["stopping_error"]
        if late is None or missed is None or late > stated.late_s or missed > ARRIVED_M:
            return None
        rows.append([values[key] for key in (TRACKING, *AGAINST, "late_s")])
    return Point(dict(parameters), *np.mean(np.array(rows, dtype=float), axis=0).tolist())


def fronts_of(contest: Contest, scenario: Scenario, name: str) -> tuple[Front, ...]:
    """Both fronts of a controller; all evaluations are shared. The same numbers give the same fronts, bit for bit."""
    stated, tuning = _stated(contest), contest.tuning
    seen: dict[tuple[float, ...], Point | None] = {}

    def point(parameters: Mapping[str, float]) -> Point | None:
        key = tuple(parameters.values())
        if key not in seen:
            seen[key] = driven(contest, scenario, name, parameters, DRAWS_FROM, tuning.seed)
        return seen[key]

    start = {key: tunable(scenario, name)[key] for key in tuning.ranges[name]}
    # The ends first, more thoroughly than the others, since between them the two are scaled.
    ends, inner = (0.0, 1.0) * END_ROUNDS, np.linspace(0.0, 1.0, stated.weights).tolist()[1:-1]
    for against in AGAINST:
        scale: Scale | None = None
        for number, weight in enumerate((*ends, *inner)):
            known = [one for one in seen.values() if one is not None]
            if number == len(ends):
                scale = _scale(efficient(known, against), against)
            cost = _cost(against, weight, scale)
            best = min(known, key=cost).parameters if known else start
            ranges = around(best, tuning.ranges[name]) if known else tuning.ranges[name]
            search(lambda values, cost=cost: cost(point(values)), best,  # type: ignore[misc]
                   ranges, stated.evaluations, tuning.seed, number)
    pooled = [one for one in seen.values() if one is not None]
    again: dict[tuple[float, ...], Point | None] = {}
    found = []
    for against in AGAINST:
        points = []
        for one in _spread(efficient(pooled, against), stated.weights):
            key = tuple(one.parameters.values())
            if key not in again:
                again[key] = driven(contest, scenario, name, one.parameters, 0, contest.seed)
            points.append(again[key])
        found.append(Front(name, against, efficient([one for one in points if one is not None], against), len(seen)))
    return tuple(found)


def _scale(front: Sequence[Point], against: str) -> Scale | None:
    """From where to where a front goes in both; None where there is none."""
    if not front:
        return None
    rows = np.array([[getattr(one, key) for key in (TRACKING, against)] for one in front])
    (low, other_low), (high, other_high) = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
    return (low, high), (other_low, other_high)


def around(best: Mapping[str, float], ranges: Mapping[str, Range]) -> dict[str, Range]:
    """The part of each range that lies near the best point so far: few evaluations improve it, and not the middle."""
    found: dict[str, Range] = {}
    for key, limits in ranges.items():
        low, high = limits
        share = (high / low) ** NEAR
        below, above = max(low, best[key] / share), min(high, best[key] * share)
        if is_whole(limits):
            below, above = math.floor(below), math.ceil(above)
            found[key] = (max(below, int(low)), min(max(above, below + 1), int(high)))
        else:
            found[key] = (below, above)
    return found


def _cost(against: str, weight: float, scale: Scale | None) -> Callable[[Point | None], float]:
    """The weighted sum, each from 0 to 1 between the ends of the front; before these are known, of logarithms."""
    def cost(point: Point | None) -> float:
        if point is None:
            return LOST
        parts = []
        for i, key in enumerate((TRACKING, against)):
            value = getattr(point, key)
            low, high = scale[i] if scale else (0.0, 0.0)
            parts.append((value - low) / (high - low) if high > low else math.log(max(value, 1e-300)))
        # So little of the other, that of two that are level the one that nothing beats is taken.
        share = min(max(weight, 1e-3), 1 - 1e-3)
        return (1 - share) * parts[0] + share * parts[1]

    return cost


def efficient(points: Sequence[Point], against: str) -> tuple[Point, ...]:
    """Those that no other beats in one without being worse in the other, by tracking; of equal ones the first."""
    found: list[Point] = []
    for one in sorted(points, key=lambda p: (p.position_rms, getattr(p, against))):
        if not found or getattr(one, against) < getattr(found[-1], against):
            found.append(one)
    return tuple(found)


def _spread(points: Sequence[Point], count: int) -> list[Point]:
    """At most so many, the ends among them, evenly by rank."""
    if len(points) <= count:
        return list(points)
    return [points[i] for i in sorted(set(np.linspace(0, len(points) - 1, count).round().astype(int).tolist()))]


def all_fronts(contest: Contest, scenario: Scenario, workers: int, on_progress: Callable[[int, int, str], None],
               folder: Path | None = None, resume: bool = False, digest: str = "") -> tuple[Front, ...]:
    """The fronts of all who are asked for, in parallel processes; folder: keeps finished ones, for `resume`."""
    if contest.pareto is None:
        return ()
    names = who(contest, scenario)
    found: dict[str, tuple[Front, ...]] = {}
    journal = Journal(folder / JOURNAL_NAME, {"fronts of": contest.name, "digest of values, line and code": digest},
                      resume) if folder else None
    try:
        found |= _finished_fronts(journal) if journal else {}

        def record(done: int, name: str, fronts: tuple[Front, ...]) -> None:
            if journal:
                journal.append({"controller": name, "fronts": [asdict(front) for front in fronts]})
            on_progress(kept + done, len(names), f"{name}: Pareto fronts")

        kept = len(found)
        on_progress(kept, len(names), "Pareto fronts")  # so that their rate is counted from here, not from the matches
        found |= results_of(_task, (contest, scenario), [name for name in names if name not in found], workers, record)
    finally:
        if journal:
            journal.close()
    return tuple(front for name in names for front in found[name])


def _task(shared: tuple[Contest, Scenario], name: str) -> tuple[Front, ...]:
    return fronts_of(*shared, name)


def _finished_fronts(journal: Journal) -> dict[str, tuple[Front, ...]]:
    read: TypeAdapter[Any] = TypeAdapter(tuple[Front, ...])
    try:
        return {line["controller"]: read.validate_python(line["fronts"]) for line in journal.records}
    except (ValidationError, KeyError):
        raise InputError(journal.path, "", f"holds a record that is no front: {REMEDY}") from None


def front_tables(contest: Contest, fronts: Sequence[Front]) -> Iterator[ResultTable]:
    """A table for each front, a row a point; none without fronts."""
    for against in AGAINST:
        rows: list[tuple[Cell, ...]] = [
            (front.controller, one.position_rms, one.energy_J, one.comfort_rms, one.late_s,
             Phrase(", ".join(f"{key} = {{}}" for key in one.parameters), tuple(one.parameters.values())))
            for front in fronts if front.against == against for one in front.points]
        if rows and contest.pareto:
            stated = contest.pareto
            draws = stated.draws if contest.conditions[stated.condition].random else 1
            yield with_periods(ResultTable(
                f"What tracking costs in {COLUMNS[against].title}", _source(contest), (
                    "controller", COLUMNS[TRACKING], COLUMNS["energy_J"], COLUMNS["comfort_rms"], COLUMNS["late_s"],
                    "parameters"), tuple(rows),
                f"Points of a controller that none of its others beats in both, from searches for {stated.weights} "
                f"weights of {stated.evaluations} evaluations each, driven again on the first "
                f"{f'{draws} of the' if draws > 1 else 'of the'} contest's own draws, without intervals. All stand at "
                f"most {stated.late_s:g} s after the arrival time, so that energies are those of equal arrival."),
                contest.world, contest.conditions[stated.condition])


def front_plots(contest: Contest, fronts: Sequence[Front]) -> Iterator[Plot]:
    """A figure for each front, a curve a controller."""
    for against in AGAINST:
        curves = tuple(Curve(labelled(contest.world, front.controller),
                             np.array([one.position_rms for one in front.points]),
                             np.array([getattr(one, against) for one in front.points]) / COLUMNS[against].si)
                       for front in fronts if front.against == against and front.points)
        if curves:
            yield Plot(f"Tracking against {COLUMNS[against].title}", _source(contest), "position RMS (m)",
                       f"{COLUMNS[against].title} ({COLUMNS[against].unit})", curves, log_x=True)


def _source(contest: Contest) -> str:
    return f"condition: {contest.conditions[_stated(contest).condition].title}"

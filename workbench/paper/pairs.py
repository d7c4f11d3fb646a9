"""Law and MPC on the same drawn trains: paired differences, and which of them are more than chance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.files.numbers import counted
from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.drivers import Drivers, entries
from workbench.paper.mpc_comparison import FOLLOWS_MPS, JERK
from workbench.paper.results import ResultTable
from workbench.paper.stages import Stage, Together
from workbench.paper.statistics import Bootstrap, Interval, holm, mean_interval, overtakes
from workbench.paper.study import varied
from workbench.paper.tuning_record import Pairs
from workbench.simulate.closed_loop import Factors

METRIC_NAMES = {"position_rms": ("position RMS", "m"), "speed_rms": ("speed RMS", "m/s"),
                "jerk_rms": ("jerk RMS", "m/s³"), "logged_jerk_rms": ("jerk RMS of the log", "m/s³")}
# So many draws of a controller are run at once, where they can be.
DRAWS_TOGETHER = 4
STATES = {False: "as stated", True: "tuned"}

# (place, controller, whether it is tuned) -> a row a draw
Drawn = Mapping[tuple[str, str, bool], Sequence[Mapping[str, Any]]]
Task = tuple[int, str, str, bool]


@dataclass(frozen=True)
class Pair:
    """A law and an MPC, both as stated or both tuned, over the draws in a place.

    differences: metric -> law less MPC with its interval over the draws in which both end, None where there are not
    two; means: metric -> of law and of MPC; failed: how many runs of law and of MPC failed; overtakes: metric -> the
    trial from which on a law that learns is ahead by more than chance, or None; told_apart: the metrics whose
    difference is more than chance, corrected for all metrics and places.
    """

    place: str
    law: str
    rival: str
    tuned: bool
    means: dict[str, tuple[float, float]]
    differences: dict[str, Interval | None]
    failed: tuple[int, int]
    overtakes: dict[str, int | None]
    told_apart: frozenset[str] = frozenset()

    @property
    def follow(self) -> tuple[bool, bool]:
        """Whether law and MPC follow the desired curve: no run fails, and the mean speed RMS is small enough."""
        speeds = self.means.get("speed_rms", (0.0, 0.0))
        return (not self.failed[0] and speeds[0] <= FOLLOWS_MPS, not self.failed[1] and speeds[1] <= FOLLOWS_MPS)

    def winner(self, metric: str) -> str | None:
        """Who has less of a metric by more than chance; one with a run that failed loses to one without.

        In jerk one that does not follow the desired curve loses to one that does.
        """
        difference = self.differences[metric]
        able = self.follow if metric in JERK else (not self.failed[0], not self.failed[1])
        if not all(able) or difference is None:
            return self.law if able[0] else self.rival if able[1] else None
        if metric not in self.told_apart:
            return None
        return self.law if difference.mean < 0 else self.rival


def factors_of(pairs: Pairs, draw: int) -> Factors:
    """Mass and resistance of a draw; of seed and number of the draw alone, so the same for all who drive."""
    generator = np.random.default_rng(np.random.SeedSequence(pairs.seed, spawn_key=(draw,)))
    mass, a, b, c = (1 + pairs.spread * generator.uniform(-1.0, 1.0, 4)).tolist()
    return Factors(mass=mass, davis_a=a, davis_b=b, davis_c=c)


def pair_tasks(drivers: Drivers, study: Any) -> list[Task]:
    """Every controller, as stated and as tuned, on every drawn train; nothing where the file states no pairs."""
    pairs: Pairs | None = study.pairs
    return [] if pairs is None else [
        (draw, place, name, tuned) for draw in range(pairs.draws) for place in pairs.places
        for name, tuned in entries(study, drivers)]


def pair_stage(drivers: Drivers, study: Any) -> Stage:
    """The runs of `pair_tasks` as a stage of the study; no task where the file states no pairs."""
    tasks = pair_tasks(drivers, study)
    shared = (drivers, varied(study, study.pairs.set, "pairs.set")) if tasks else None
    return Stage(_drive, shared, tasks, lambda task, _: f"drawn train {task[0] + 1}",
                 together=Together(_drive_together, _groups) if drivers.drive_together else None)


def _drive(shared: tuple[Drivers, Any], task: Task) -> Mapping[str, Any]:
    (drivers, study), (draw, place, name, tuned) = shared, task
    return drivers.drive(drivers.tuned(study, name) if tuned else study, name, place, factors_of(study.pairs, draw))


def _drive_together(shared: tuple[Drivers, Any], tasks: Sequence[Task]) -> Sequence[Mapping[str, Any]]:
    """The rows of tasks that differ in their draw alone."""
    (drivers, study), (_, place, name, tuned) = shared, tasks[0]
    assert drivers.drive_together is not None
    return drivers.drive_together(drivers.tuned(study, name) if tuned else study, name, place,
                                  [factors_of(study.pairs, draw) for draw, _, _, _ in tasks])


def _groups(shared: tuple[Drivers, Any], tasks: Sequence[Task]) -> list[list[Task]]:
    """So many draws of each controller."""
    found: dict[Task, list[Task]] = {}
    for draw, place, name, tuned in tasks:
        found.setdefault((draw // DRAWS_TOGETHER, place, name, tuned), []).append((draw, place, name, tuned))
    return list(found.values())


def compared_pairs(drivers: Drivers, study: Any, results: Mapping[Task, Mapping[str, Any]]) -> tuple[Pair, ...]:
    """Every law against every MPC in the same state of tuning, from the results of `pair_stage`."""
    return pairs_of(study, {(place, name, tuned): [results[draw, place, name, tuned]
                                                   for draw in range(study.pairs.draws)]
                            for place in study.pairs.places for name, tuned in entries(study, drivers)}
                    if results else {}, drivers.first_trial)


def pairs_of(study: Any, drawn: Drawn, first_trial: int = 1) -> tuple[Pair, ...]:
    """Every law against every MPC in the same state of tuning; first_trial: the number of a learner's first trial."""
    if not drawn:
        return ()
    stated = study.pairs
    of_runs = next((row for rows in drawn.values() for row in rows if row["failed"] is None), {})
    # What was tuned for, and jerk as it was where that is known.
    metrics = tuple("jerk_rms" if metric in JERK and "jerk_rms" in of_runs else metric
                    for metric in study.tuning.objective.units)
    how = Bootstrap(stated.resamples, stated.seed, stated.confidence)
    comparisons = len(metrics) * len({place for place, _, _ in drawn})
    how = how.for_comparisons(comparisons)
    found = []
    for place, law, tuned in drawn:
        for other, rival, state in drawn:
            if law.startswith("mpc") or not rival.startswith("mpc") or (other, state) != (place, tuned):
                continue
            ours, theirs = drawn[place, law, tuned], drawn[place, rival, tuned]
            ended = [(a, b) for a, b in zip(ours, theirs, strict=True) if a["failed"] is None and b["failed"] is None]
            failed = tuple(sum(row["failed"] is not None for row in rows) for rows in (ours, theirs))
            means: dict[str, tuple[float, float]] = {}
            differences: dict[str, Interval | None] = {}
            ahead: dict[str, int | None] = {}
            for metric in metrics:
                if len(ended) < 2:
                    differences[metric] = None
                    continue
                a, b = (np.array([pair[side][metric] for pair in ended]) for side in (0, 1))
                means[metric] = float(a.mean()), float(b.mean())
                differences[metric] = mean_interval(a - b, how)
                if metric in ended[0][0].get("trials", {}):
                    trials = np.array([ours["trials"][metric] for ours, _ in ended])
                    ahead[metric] = overtakes(trials, b, stated.resamples, stated.seed, stated.confidence,
                                              first_trial, comparisons)
            found.append(Pair(place, law, rival, tuned, means, differences, (failed[0], failed[1]), ahead))
    return _corrected(found, 1 - stated.confidence)


def _corrected(pairs: Sequence[Pair], level: float) -> tuple[Pair, ...]:
    """The pairs with what is more than chance, by Holm's correction over all metrics and places of law and rival."""
    families: dict[tuple[str, str, bool], list[tuple[int, str, float]]] = {}
    for number, pair in enumerate(pairs):
        for metric, found in pair.differences.items():
            if found is not None:
                families.setdefault((pair.law, pair.rival, pair.tuned), []).append((number, metric, found.p))
    told: dict[int, set[str]] = {}
    for rows in families.values():
        for (number, metric, _), chance in zip(rows, holm([p for _, _, p in rows]), strict=True):
            if chance <= level:
                told.setdefault(number, set()).add(metric)
    return tuple(replace(pair, told_apart=frozenset(told.get(number, ()))) for number, pair in enumerate(pairs))


def _cell(pair: Pair, metric: str, titles: Mapping[str, str], draws: int) -> Cell:
    difference, winner = pair.differences[metric], pair.winner(metric)
    verdict = "no win" if winner is None else titles[winner]
    failed = " and ".join(f"{titles[name]} fails in {count} of {draws}"
                          for name, count in zip((pair.law, pair.rival), pair.failed, strict=True) if count)
    if difference is None:
        return f"{failed}: {verdict}"
    if metric in JERK and not failed and not all(pair.follow):
        verdict += " (the other does not follow)" if any(pair.follow) else " (neither follows)"
    words = f"{{}} − {{}} = {{}} [{{}}, {{}}]{f'; {failed}' if failed else ''}: {verdict}"
    return Phrase(words, (*pair.means[metric], difference.mean, difference.low, difference.high))


def _ahead(pair: Pair) -> Cell:
    words = ", ".join("no" if trial is None else f"{METRIC_NAMES[metric][0]} {{}}"
                      for metric, trial in pair.overtakes.items())
    return Phrase(words, tuple(trial for trial in pair.overtakes.values() if trial is not None)) if words else None


def pair_table(study: Any, drivers: Drivers, pairs: Sequence[Pair]) -> Iterator[ResultTable]:
    """A row per place, law, MPC and state of tuning; nothing without pairs."""
    if not pairs:
        return
    stated, titles, places = study.pairs, drivers.titles, drivers.places(study)
    metrics = tuple(pairs[0].differences)
    learns = any(pair.overtakes for pair in pairs)
    rows = [(places[pair.place], titles[pair.law], titles[pair.rival], STATES[pair.tuned],
             *(_cell(pair, metric, titles, stated.draws) for metric in metrics),
             *((_ahead(pair),) if learns else ())) for pair in pairs]
    yield ResultTable(
        "Law less MPC on the same drawn trains", "comparison",
        ("run", "law", "MPC", "parameters", *(Column(*METRIC_NAMES[metric]) for metric in metrics),
         *(("trial from which on the law is ahead",) if learns else ())), tuple(rows),
        f"Means over {counted(stated.draws, 'train')} whose mass and resistance lie within ±{100 * stated.spread:g} % "
        "of what MPC knows, their difference with the "
        f"{100 * stated.confidence:g} % interval of a paired bootstrap (BCa), and who has less. A difference that may "
        "be chance, by Holm's correction over metrics and runs, is no win. A controller with runs that fail loses to "
        "one without, and the numbers are of the trains on which both arrive; "
        f"who errs by more than {FOLLOWS_MPS:g} m/s in speed RMS does not follow and wins nothing in jerk.")


def pair_findings(study: Any, drivers: Drivers, pairs: Sequence[Pair]) -> Iterator[str]:
    """Who wins with which, a sentence per place and law: as stated and as tuned."""
    places = drivers.places(study)
    for place, law in dict.fromkeys((pair.place, pair.law) for pair in pairs):
        parts = []
        for tuned in (False, True):
            of = [pair for pair in pairs if (pair.place, pair.law, pair.tuned) == (place, law, tuned)]
            for metric in of[0].differences if of else ():
                won = [drivers.titles[pair.rival] for pair in of if pair.winner(metric) == law]
                lost = [drivers.titles[pair.rival] for pair in of if pair.winner(metric) == pair.rival]
                open_ = [drivers.titles[pair.rival] for pair in of if pair.winner(metric) is None]
                words = [f"{verb} {' and '.join(names)}" for verb, names in (
                    ("beats", won), ("loses to", lost), ("is level with", open_)) if names]
                parts.append(f"{METRIC_NAMES[metric][0]} {STATES[tuned]}: {', '.join(words)}")
            if of and of[0].failed[0]:
                parts.append(f"{STATES[tuned]} it fails on {of[0].failed[0]} of them")
        yield (f"On {study.pairs.draws} drawn trains, {places[place]}, ±{100 * study.pairs.spread:g} %, "
               f"{drivers.titles[law]}: {'; '.join(parts)}.")

"""At which trip a law that learns overtakes the others, if it does."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from workbench.contest.entrants import follows_curve, learns
from workbench.contest.sampling import labelled
from workbench.contest.told import Told
from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.results import Curve, Plot, ResultTable
from workbench.paper.statistics import overtakes

# Of `Played.trials`: column, heading, metric of a whole run.
ERRORS = ((0, "position RMS", "position_rms", "m"), (1, "speed RMS", "speed_rms", "m/s"))


def learners(told: Told) -> list[str]:
    """Names of the entries that learn from trip to trip."""
    return [entry.name for entry in told.entries if learns(told.scenario, entry.controller)]


def _trials(told: Told, condition: str, name: str, column: int) -> NDArray[np.float64] | None:
    """(draws, trips) of a learner; None where a run failed."""
    matches = told.of(condition, name)
    if any(match.failed is not None for match in matches):
        return None
    return np.array([[trial[column] for trial in match.trials] for match in matches])


def mpc_rivals(told: Told) -> list[str]:
    """Names of the entries by MPC that follow the curve and do not learn."""
    return [entry.name for entry in told.entries
            if entry.controller.startswith("mpc") and follows_curve(told.scenario, entry.controller)
            and not learns(told.scenario, entry.controller)]


def learning_tables(told: Told) -> Iterator[ResultTable]:
    """One for each error: a row per learner and condition, a column per MPC."""
    rivals = mpc_rivals(told)
    if not learners(told) or not rivals:
        return
    names = [entry.name for entry in told.entries]
    for column, heading, metric, unit in ERRORS:
        rows: list[tuple[Cell, ...]] = []
        for learner in learners(told):
            for condition, stated in told.contest.conditions.items():
                trials = _trials(told, condition, learner, column)
                if trials is None:
                    rows.append((learner, stated.title, "a run fails", *(None for _ in rivals)))
                    continue
                values = dict(zip(names, told.values(condition, metric), strict=True))
                change = float(trials[:, 0].mean()), float(trials[:, -1].mean())
                rows.append((learner, stated.title, Phrase("{} → {}, {} trips", (*change, trials.shape[1])),
                             *(_cell(told, trials, values[rival]) for rival in rivals)))
        yield ResultTable(
            f"When learning overtakes MPC: {heading}", "the learners' trips",
            ("learner", "condition", Column("first → last trip", unit), *rivals), tuple(rows),
            "The trip from which on the learner is ahead by more than chance, all pairings of a learner corrected "
            "together; no: not within its trips, and how many times MPC's error its last trip has. All trips of a run "
            f"have the same train, line and disturbance.{_periods(told, (*learners(told), *rivals))}")


def _periods(told: Told, entries: tuple[str, ...]) -> str:
    """Who samples how often, where not all sample alike."""
    labels = [labelled(told.scenario, entry) for entry in entries]
    return f" They command every: {'; '.join(labels)}." if labels != list(entries) else ""


def _cell(told: Told, trials: NDArray[np.float64], rival: NDArray[np.float64] | None) -> Cell:
    if rival is None:
        return "MPC fails"
    contest = told.contest
    found = overtakes(trials, rival, contest.resamples, contest.seed, contest.confidence, comparisons=_pairings(told))
    if found is not None:
        return Phrase("trip {}", (found,))
    return Phrase("no, {}×", (float(trials[:, -1].mean() / rival[: len(trials)].mean()),))


def _pairings(told: Told) -> int:
    """How many questions are asked of one learner: each rival, condition and error."""
    return len(mpc_rivals(told)) * len(told.contest.conditions) * len(ERRORS)


def learning_findings(told: Told) -> Iterator[str]:
    """A sentence per learner: against how many MPCs and where it gets ahead."""
    rivals, names = mpc_rivals(told), [entry.name for entry in told.entries]
    for learner in learners(told):
        if not rivals:
            return
        for column, heading, metric, _ in ERRORS:
            trips, met, failed = [], 0, 0
            for condition in told.contest.conditions:
                trials = _trials(told, condition, learner, column)
                if trials is None:
                    failed += 1
                    continue
                values = dict(zip(names, told.values(condition, metric), strict=True))
                for rival in rivals:
                    value = values[rival]
                    if value is not None:
                        met += 1
                        trips.append(overtakes(trials, value, told.contest.resamples, told.contest.seed,
                                               told.contest.confidence, comparisons=_pairings(told)))
            ahead = sorted(trip for trip in trips if trip is not None)
            words = f"is ahead of an MPC in {len(ahead)} of {met} pairings" if ahead else (
                f"overtakes no MPC within its trips in any of {met} pairings")
            when = f", from trip {ahead[0]} to {ahead[-1]} on" if ahead else ""
            lost = f"; its runs fail in {failed} condition{'s' if failed > 1 else ''}" if failed else ""
            first = sum(trip == 1 for trip in ahead)
            known = f", in {first} of them before it has learned anything" if first else ""
            yield f"{learner} {words} of condition and MPC in {heading}{when}{known}{lost}."


def learning_plot(told: Told) -> Iterator[Plot]:
    """Learning curves of the first condition; the best and the worst MPC as level lines."""
    condition = next(iter(told.contest.conditions))
    curves = []
    for learner in learners(told):
        trials = _trials(told, condition, learner, 0)
        if trials is not None:
            curves.append(Curve(labelled(told.scenario, learner), np.arange(1.0, trials.shape[1] + 1),
                                trials.mean(axis=0)))
    names = [entry.name for entry in told.entries]
    values = dict(zip(names, told.values(condition, "position_rms"), strict=True))
    means = {name: float(value.mean()) for name in mpc_rivals(told) if (value := values[name]) is not None}
    if curves and means:
        last = max(float(curve.x[-1]) for curve in curves)
        for name in sorted({min(means, key=lambda n: means[n]), max(means, key=lambda n: means[n])}):
            curves.append(Curve(labelled(told.scenario, name), np.array([1.0, last]), np.full(2, means[name])))
    if curves:
        yield Plot("Learning from trip to trip", f"condition: {told.contest.conditions[condition].title}", "trip",
                   "position RMS (m)", tuple(curves), log_y=True)

"""A contest as a study: run, compared, told."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from workbench.contest.best_trackers import best_trackers_table
from workbench.contest.by_period import at_each_period, period_findings, period_tables
from workbench.contest.energy import best_run
from workbench.contest.entrants import check_entrants, check_names, entered, follows_curve, learns
from workbench.contest.journal import contest_digest, matches_journal, matches_of, world_digest
from workbench.contest.learning import learning_findings, learning_plot, learning_tables
from workbench.contest.matches import METRICS, Match, all_matches, overspeed, run_match
from workbench.contest.objective_table import objective_table
from workbench.contest.pareto import all_fronts, front_plots, front_tables, who
from workbench.contest.premises import premises_findings, premises_table, words_of
from workbench.contest.record import Contest
from workbench.contest.sampling import labelled
from workbench.contest.standings import standings
from workbench.contest.tables import all_tables
from workbench.contest.told import COLUMNS, Told
from workbench.contest.tune import tune_all
from workbench.contest.tuning_table import convergence_plot, tuning_findings, tuning_table
from workbench.errors import InputError
from workbench.files.numbers import counted, number
from workbench.files.units import KWH_J
from workbench.paper.parameter_search import Finished, Name, Tuned
from workbench.paper.results import Curve, Plot, StudyResult
from workbench.paper.study import Progress, StudyKind
from workbench.trains.scenario import Scenario, load_scenario, tunable

# Of a scenario's sensing what a contest states by condition.
DRAWN = ("position_noise_m", "speed_noise_mps", "measurement_delay_s", "command_delay_s")


def located(contest: Contest, path: Path) -> Contest:
    """The contest with its scenario, read; raises InputError where the scenario or a name in it is wrong."""
    scenario_path = path.parent / contest.scenario
    stated = load_scenario(scenario_path, f"check the path, 'scenario' in {path}")
    stated = _taking_part(contest, stated, path)
    for key in DRAWN if stated.sensing else ():
        if getattr(stated.sensing, key):
            raise InputError(scenario_path, f"sensing.{key}", "is a contest's to say, which draws noise and holds "
                             "delays to all periods: state it in the conditions")
    check_entrants(contest, stated, path, scenario_path)
    check_names(contest, stated, path)
    scenario = entered(contest, stated).in_folder(contest.folder)
    _delays_alike(contest, scenario, path)
    contest = contest.with_world(scenario)
    for name, ranges in contest.tuning.ranges.items():
        if name not in scenario.controllers:
            raise InputError(path, f"tuning.ranges.{name}", "is no controller of the scenario: choose one of "
                             f"{', '.join(scenario.controllers)}")
        if not follows_curve(scenario, name) and contest.tuning.without_curve is None:
            raise InputError(path, "tuning.without_curve", f"is missing: state what '{name}', which follows no curve, "
                             "is tuned for")
        for key in ranges:
            if key not in tunable(scenario, name):
                raise InputError(path, f"tuning.ranges.{name}.{key}", "is no parameter of this controller: choose "
                                 f"among {', '.join(tunable(scenario, name))}")
    if contest.pareto:
        try:
            who(contest, scenario)
        except InputError as trouble:
            raise trouble.within(path) from None
    for metric in contest.racing.metrics if contest.racing else ():
        if metric not in METRICS or (metric == "overspeed_mps" and not scenario.track.speed_limit):
            raise InputError(path, "racing.metrics", f"'{metric}' is none of this line's: choose among "
                             f"{', '.join(METRICS)}")
    return contest


def _taking_part(contest: Contest, scenario: Scenario, path: Path) -> Scenario:
    """The scenario with the controllers that the contest names; InputError for one that it has not."""
    for name in contest.controllers:
        if name not in scenario.controllers:
            raise InputError(path, "controllers", f"'{name}' is no controller of the scenario: choose among "
                             f"{', '.join(scenario.controllers)}")
    return scenario.model_copy(update={"controllers": {
        name: spec for name, spec in scenario.controllers.items() if name in (contest.controllers or (name,))}})


def undecided(told: Told) -> list[str]:
    """In a race the conditions in which, of those who sample alike, somebody is not told apart from the best.

    In a metric that decides; those whose runs agree are one.
    """
    race = told.contest.racing
    groups = [own for _, own in at_each_period(told)] or [told]
    return [name for name, condition in told.contest.conditions.items()
            if race and condition.random and any(len(own.best(name, metric)) > 1 for own in groups
                                                 for metric in race.metrics)]


def _delays_alike(contest: Contest, scenario: Scenario, path: Path) -> None:
    """Delays are whole samples, so that one which is none of a controller's would be rounded to its advantage or harm.

    Raises InputError for such a delay, and for a sampling that is no multiple of the plant's step.
    """
    for condition, stated in contest.conditions.items():
        step = scenario.simulation.plant_step_s
        if stated.period_s is not None and (round(stated.period_s / step) < 1 or
                                            abs(stated.period_s / step - round(stated.period_s / step)) > 1e-6):
            raise InputError(path, f"conditions.{condition}.period_s", f"{stated.period_s:g} is not a whole number of "
                             f"plant steps of {step:g} s: choose a multiple")
        try:
            if (actuator := stated.acting(scenario)) is not None:
                actuator.delay_steps(step)
        except ValueError as trouble:
            raise InputError(path, f"conditions.{condition}.actuator", str(trouble)) from None
        for key in ("measurement_delay_s", "command_delay_s"):
            delay = getattr(stated, key)
            for name, spec in scenario.controllers.items():
                period = stated.period_s or spec.period_s
                if abs(delay / period - round(delay / period)) > 1e-6:
                    raise InputError(path, f"conditions.{condition}.{key}", f"{delay:g} s is no whole number of the "
                                     f"{period:g} s at which '{name}' samples, so that not all would be delayed "
                                     "alike: choose a multiple of every period")


def run(contest: Contest, workers: int, on_progress: Progress) -> StudyResult:
    """All matches, their tables, figures and findings."""
    return _run(contest, workers, on_progress, (), lambda match: None, (None, False))


def run_kept(contest: Contest, workers: int, on_progress: Progress, folder: Path, resume: bool) -> StudyResult:
    """`run` with journals of matches and fronts in a folder; with `resume` what they hold is not run again."""
    with matches_journal(folder, contest, resume) as journal:
        return _run(contest, workers, on_progress, matches_of(journal), lambda match: journal.append(asdict(match)),
                    (folder, resume))


def _run(contest: Contest, workers: int, on_progress: Progress, played: Sequence[Match],
         keep: Callable[[Match], None], fronts_in: tuple[Path | None, bool]) -> StudyResult:
    scenario = contest.world
    matches = all_matches(contest, scenario, workers, on_progress, played, keep, lambda now: undecided(
        Told(contest, scenario, tuple(now), None)))
    fronts = all_fronts(contest, scenario, workers, on_progress, *fronts_in, digest=contest_digest(contest))
    best = best_run(scenario)
    told = Told(contest, scenario, matches, best.lower_bound_j if best else None)
    first: dict[str, str] = {}  # of an entry's failed runs under a condition the first; the findings say how many
    for match in matches:
        if match.failed is not None:
            first.setdefault(f"{match.entry}, {contest.conditions[match.condition].title}", match.failed)
    failures, words = tuple(first.items()), tuple(words_of(told))
    traded, plots = tuple(front_plots(contest, fronts)), tuple(_plots(told))
    return StudyResult(rows=tuple(_rows(told)),
                       tables=(*all_tables(told), *period_tables(told), *premises_table(told, words),
                               *objective_table(told), *tuning_table(told),
                               *front_tables(contest, fronts), *learning_tables(told)),
                       plots=(*traded, *plots, *learning_plot(told), *convergence_plot(told)),
                       findings=(*period_findings(told), *_findings(told), *premises_findings(told, words),
                                 *learning_findings(told)),
                       failures=failures, winners=best_trackers_table(told), standings=standings(told),
                       first_plot=0 if traded or plots else None)


def _rows(told: Told) -> Iterator[dict[str, Any]]:
    """A row per condition and entry; the keys of a comparison where they make sense."""
    for name in told.contest.conditions:
        for entry in told.entries:
            matches = told.of(name, entry.name)
            row: dict[str, Any] = {"controller": entry.name, "condition": name, "runs": len(matches)}
            for metric in METRICS:
                values = [match.values[metric] for match in matches if match.values[metric] is not None]
                row[metric] = float(np.mean(np.array(values, dtype=float))) if len(values) == len(matches) else None
            failed = [match.failed for match in matches if match.failed is not None]
            yield row | {"failed_runs": len(failed), "failed": failed[0] if failed else None,
                         "lower_bound_J": told.lower_bound_j if name in told.bounded else None}


def _plots(told: Told) -> Iterator[Plot]:
    """Position errors of all that finish the first condition and follow the curve, and errors by condition."""
    first = next(iter(told.contest.conditions))
    curves, speeds = [], []
    for name in told.scenario.controllers:
        if learns(told.scenario, name):
            continue
        done = run_match(told.scenario, name, told.contest.conditions[first], 0, told.contest.seed)
        if done.failed is None:
            time, error = done.column("t_s"), done.position_error
            keep = slice(None, None, max(1, len(time) // 1500))
            if follows_curve(told.scenario, name):
                curves.append(Curve(labelled(told.scenario, name), time[keep], error[keep]))
            else:
                speeds.append(Curve(labelled(told.scenario, name), time[keep], done.column("v_mps")[keep]))
    if curves:
        yield Plot("Position errors", f"condition: {told.contest.conditions[first].title}", "time (s)",
                   "position error (m)", tuple(curves))
    curve = told.scenario.desired_curve()
    time = np.linspace(0.0, curve.trip_time_s, 1000)
    yield Plot("The desired curve", "the scenario", "time (s)", "speed (m/s)",
               (Curve("desired", time, curve.at(time)[1]), *speeds))
    places = np.arange(len(told.contest.conditions), dtype=float)
    lines = []
    for i, entry in enumerate(told.entries):
        if not told.judged(entry, "position_rms"):
            continue
        means = [told.values(name, "position_rms")[i] for name in told.contest.conditions]
        able = [(place, float(value.mean())) for place, value in zip(places, means, strict=True) if value is not None]
        if able:
            lines.append(Curve(labelled(told.scenario, entry.name), np.array([x for x, _ in able]),
                               np.array([y for _, y in able])))
    if lines:
        names = ", ".join(f"{k} {condition.title}" for k, condition in enumerate(told.contest.conditions.values()))
        yield Plot("Position RMS by condition", "all runs", f"condition ({names})", "position RMS (m)", tuple(lines),
                   log_y=True)


def _findings(told: Told) -> Iterator[str]:
    """Plainly who wins where, from the tables."""
    groups = [(f"every {1e3 * period:g} ms ", own) for period, own in at_each_period(told)] or [("", told)]
    count = len(told.contest.conditions)
    for metric in told.metrics:
        said = []
        for when, own in groups:
            best = [own.best(condition, metric) for condition in told.contest.conditions]
            alone = Counter(found[0] for found in best if len(found) == 1)
            if alone:
                said.append(when + ", ".join(f"{name} in {n}" for name, n in alone.most_common()))
        of_all = counted(count, "condition")
        yield (f"{COLUMNS[metric].heading}, alone best of {of_all}: {'; '.join(said)}." if said else
               f"{COLUMNS[metric].heading}: no controller is alone best in any condition.")
    for name, stated in told.contest.conditions.items():
        failed = Counter(match.entry for match in told.matches if match.condition == name and match.failed)
        if failed:
            words = ", ".join(f"{entry} {n}" for entry, n in failed.most_common())
            runs = told.runs(name)
            yield f"Runs that fail, {stated.title}: {words}, of {runs} run{'s' if runs > 1 else ''} of each law."
    if told.lower_bound_j and told.bounded:
        first = told.bounded[0]
        energies = [(entry.name, value.mean()) for entry, value, arrived in zip(
            told.entries, told.values(first, "energy_J"), told.on_time(first), strict=True)
            if value is not None and arrived]
        if energies:
            name, least = min(energies, key=lambda pair: pair[1])
            yield (f"The least energy of any run of the nominal train in the same time is "
                   f"{number(told.lower_bound_j / KWH_J)} kWh; the least of the contestants who arrive on time, "
                   f"{name}, takes {number(least / KWH_J)} kWh, "
                   f"{number(100 * (least / told.lower_bound_j - 1))} % more.")
    yield from _without_curve(told)
    yield from _limits_of_the_curve(told)
    yield from tuning_findings(told)
    for group in told.alike:
        if len(group) > 1:
            yield f"{' and '.join(entry.name for entry in group)} agree in every run and metric: told as one row."


def _without_curve(told: Told) -> Iterator[str]:
    """What who follows no curve makes of its freedom: energy, stop and arrival over all conditions."""
    band = told.scenario.simulation.position_band_m
    for i, entry in enumerate(told.entries):
        if told.judged(entry, "position_rms"):
            continue
        within, ahead, counted = 0, 0, len(told.contest.conditions)
        for name in told.contest.conditions:
            energy, miss, arrived = (told.values(name, "energy_J"), told.values(name, "stopping_error")[i],
                                     told.on_time(name))
            within += miss is not None and bool(miss.max() <= band)
            others = [float(value.mean()) for other, value, comes in zip(told.entries, energy, arrived, strict=True)
                      if value is not None and comes and told.judged(other, "position_rms")]
            own = energy[i]
            ahead += own is not None and arrived[i] and all(float(own.mean()) < value for value in others)
        late = [value for name in told.contest.conditions if (value := told.values(name, "late_s")[i]) is not None]
        worst = f", at most {number(max(float(value.max()) for value in late))} s late" if late else ""
        yield (f"{entry.name}, which follows no curve, comes on time and takes less energy on average than all who "
               f"follow it and do so too in {ahead} of {counted} conditions; all its runs end within {band:g} m of "
               f"the stop in {within} of {counted}{worst}.")


def _limits_of_the_curve(told: Told) -> Iterator[str]:
    """Whether the desired curve itself keeps the line's speed limits."""
    curve = told.scenario.desired_curve()
    position, speed, _ = curve.at(np.linspace(0.0, curve.trip_time_s, 20_001))
    excess = overspeed(position, speed, told.scenario.track)
    if excess > 0:
        yield (f"The desired curve itself is up to {number(excess)} m/s faster than the line's speed limits, so who "
               "tracks it is too.")


def _tuned(contest: Contest, names: list[str], workers: int, on_progress: Progress,
           finished: Finished) -> dict[Name, Tuned]:
    return tune_all(contest, contest.world, names, workers, on_progress, finished)


KIND = StudyKind(Contest, run, located, _tuned, run_kept, depends=world_digest)

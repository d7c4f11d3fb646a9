"""A plant's study as a study: all controllers on the same plant, told as rows, a table, figures and findings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from workbench.errors import CompileError, InputError
from workbench.files.numbers import number, unit_text
from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.parameter_search import NONE_YET, Finished, Name, Restart, Tuned, score, search, search_all
from workbench.paper.plants.problem import LocatedPlantStudy, located
from workbench.paper.plants.record import PlantStudy
from workbench.paper.results import Curve, Plot, ResultTable, StudyResult, thinned
from workbench.paper.study import Progress, StudyKind
from workbench.simulate.plants.run import PlantRun
from workbench.simulate.plants.run import run as run_plant
from workbench.simulate.plants.step_length import shortest_time
from workbench.systems.setting import INSTANTS, Setting
from workbench.systems.signals import Constant, signals_at
from workbench.tasks.handing_out import results_of

SLIGHT = 0.01  # of what lies between the limits of a state: further beyond them a run does not keep them


def run(study: LocatedPlantStudy, workers: int, on_progress: Progress) -> StudyResult:
    """Every controller once, as stated and as tuned, with the plant as stated."""
    names = list(study.entrants())
    found = results_of(_run_task, study, names, workers, lambda done, name, _: on_progress(done, len(names), name))
    return told(study, list(found.values()))


def _run_task(study: LocatedPlantStudy, name: str) -> PlantRun:
    try:
        return run_plant(study.setting, study.entrants()[name], study.setting.parameters)
    except CompileError as trouble:
        raise InputError(study.file, f"controllers.{name}", str(trouble)) from None


def told(study: LocatedPlantStudy, runs: Sequence[PlantRun]) -> StudyResult:
    """Runs as a study's result."""
    plots = tuple(_plots(study.setting, runs))
    tracked = [number for number, plot in enumerate(plots) if plot.title in study.setting.tracks]
    return StudyResult(tuple(map(row_of, runs)), (comparison_table(study.setting, runs),), plots,
                       tuple(_findings(study.setting, runs)),
                       tuple((run.name, run.failed) for run in runs if run.failed),
                       winners=_winners(study.setting, runs), first_plot=next(iter(tracked), 0) if plots else None)


def row_of(run: PlantRun) -> dict[str, object]:
    """A run as plain data."""
    return {"controller": run.name, "period_s": run.period_s, **run.metrics, "step_us_median": run.step_us,
            "step_us_p99": run.step_us_p99, "fallbacks": run.fallbacks, "reached_s": run.reached_s,
            "failed": run.failed}


def comparison_table(setting: Setting, runs: Sequence[PlantRun]) -> ResultTable:
    """The controllers beside each other, a column a metric."""
    metrics = setting.every_metric
    header = (Column("controller"), Column("period", "ms", 1e-3, None),
              *(Column(m.title or m.id.replace("_", " "), unit_text(m.unit)) for m in metrics), Column("step", "µs"))
    rows = tuple((run.name, run.period_s, *(run.metrics[m.id] for m in metrics), run.step_us) for run in runs)
    return ResultTable("Controllers on the same plant", f"plant {setting.plant.id}", header, rows,
                       "A law's step is timed with the plant's integration, MPC's call by call without it.")


def _plots(setting: Setting, runs: Sequence[PlantRun]) -> Iterator[Plot]:
    plant = setting.plant
    whole = [run for run in runs if len(run.log)]
    for symbol in dict.fromkeys(s for s in (*plant.states, *plant.inputs)):
        curves = [thinned(run.name, run.column("t_s"), run.column(str(symbol))) for run in whole]
        channel = setting.tracks.get(str(symbol))
        if channel and whole:
            longest = max(whole, key=lambda run: run.reached_s)
            curves.insert(0, _desired(longest, channel))
        unit = unit_text(plant.units.get(symbol, ""))
        kind, acts = ("input", ", as it acts") if symbol in plant.inputs else ("state", "")
        if curves:
            yield Plot(f"{symbol}", f"{kind} of plant {plant.id}{acts}", "time (s)", f"{symbol} ({unit})" if unit else
                       f"{symbol}", tuple(curves))


def _desired(run: PlantRun, channel: str) -> Curve:
    return thinned("desired", run.column("t_s"), run.column(channel))


def _findings(setting: Setting, runs: Sequence[PlantRun]) -> Iterator[str]:
    """Who is best in each metric of tracking, and who failed; ties by the last digit shown are said as such."""
    kept = [run for run in runs if not _beyond(setting, run)]
    among = " within the plant's limits" if 0 < len(kept) < len(runs) else ""
    for output in setting.tracks:
        values = {run.name: value for run in (kept or runs)
                  if (value := run.metrics.get(f"{output}_error_rms")) is not None}
        if len(values) > 1:
            best = min(values.values())
            least = [name for name, value in values.items() if number(value) == number(best)]
            unit = next((unit_text(m.unit) for m in setting.every_metric if m.id == f"{output}_error_rms"), "")
            yield f"RMS error of {output}, least{among}: {' and '.join(least)}, {number(best)} {unit}".rstrip() + "."
    moving = any(not isinstance(setting.references[channel], Constant) for channel in setting.tracks.values())
    for run in runs:
        if run.ahead_s and moving:
            yield f"{run.name} is told the references {number(run.ahead_s)} s ahead; laws are told what they are."
        yield from _taken_for_zero(setting, run)
        if run.failed:
            yield f"{run.failed}."
        if beyond := _beyond(setting, run):
            yield f"{run.name} goes beyond the plant's limits: {', '.join(beyond)}."
        if run.fallbacks:
            yield (f"The solver of {run.name} gave nothing usable at {run.fallbacks} "
                   f"sample{'s' * (run.fallbacks > 1)}; its last plan went on there.")
        if run.step_us > run.period_s * 1e6:
            yield (f"A step of {run.name} took {number(run.step_us / 1e6)} s here, longer than its period of "
                   f"{number(run.period_s)} s: on this computer it would not keep up.")
        yield from _inaccurate(setting, run)


def _taken_for_zero(setting: Setting, run: PlantRun) -> Iterator[str]:
    """That a controller plans without a disturbance which is there all along: a feed's concentration, a load."""
    for name in run.at_zero:
        values = signals_at({name: setting.signals[name]}, np.linspace(0.0, setting.duration_s, INSTANTS))[name][0]
        least, most = float(values.min()), float(values.max())
        if least > 0 or most < 0:
            there = number(least) if least == most else f"{number(least)} to {number(most)}"
            unit = next((f" {unit_text(u)}" for d, u in setting.plant.units.items() if str(d) == name), "")
            yield (f"{run.name} plans with disturbance {name} at zero, where it is {there}{unit} all along: it would "
                   f"find it by observer = {{ {name} = ... }}, or what is known of it is a parameter.")


def _beyond(setting: Setting, run: PlantRun) -> list[str]:
    """The states by which a run goes beyond the plant's limits by more than a hair of what lies between them, in
    words."""
    found = []
    for state, limits in setting.plant.state_limits.items():
        excess = run.metrics.get(f"{state}_limit_excess") or 0.0
        ends = [end for end in limits if math.isfinite(end)]
        if excess > SLIGHT * (max(ends) - min(ends) if len(ends) > 1 else abs(ends[0]) if ends else math.inf):
            found.append(f"{state} by {number(excess)} {unit_text(setting.plant.units.get(state, ''))}".rstrip())
    return found


def _inaccurate(setting: Setting, run: PlantRun) -> Iterator[str]:
    """That a run's step was too long for its numbers to be right, though it came to an end."""
    found = shortest_time(setting, run) if setting.integrator == "rk4" and not setting.plant.updates else None
    if found is not None and found[0] < setting.step_s:
        yield (f"The numbers of {run.name} are not accurate: at t = {number(found[1])} s the plant has a time constant "
               f"of {number(found[0])} s, shorter than its integration step of {number(setting.step_s)} s. Give "
               f"plant_step_s = {_round_down(found[0] / 5):g} or less, or the integrator 'radau'.")


def _round_down(value: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is no more than a positive value."""
    exponent = math.floor(math.log10(value))
    return float(f"{max(d for d in (1, 2, 5) if d <= value / 10.0**exponent * (1 + 1e-12))}e{exponent}")


def _winners(setting: Setting, runs: Sequence[PlantRun]) -> ResultTable | None:
    """Who follows each reference most closely, and what it takes; None where nobody is compared."""
    units = {metric.id: unit_text(metric.unit) for metric in setting.every_metric}
    efforts = [f"{symbol}_rms" for symbol in setting.plant.inputs if f"{symbol}_rms" in units]
    rows: list[tuple[Cell, ...]] = []
    for output in setting.tracks:
        key = f"{output}_error_rms"
        ranked = sorted((run for run in runs if not run.failed and run.metrics.get(key) is not None),
                        key=lambda run: (bool(_beyond(setting, run)), abs(run.metrics[key] or 0.0)))
        if len(runs) < 2 or not ranked:
            continue
        best, *others = ranked
        failed = [f"{run.name} fails" for run in runs if run.failed]
        beyond = {run.name: " beyond the limits" if _beyond(setting, run) else "" for run in ranked}
        words = "; ".join([f"{run.name} {{}}{beyond[run.name]}" for run in others] + failed)
        rows.append((output, f"{best.name}{beyond[best.name]}", Quantity(best.metrics[key], units[key]),
                     Phrase(words, tuple(Quantity(run.metrics[key], units[key]) for run in others)) if words else None,
                     *(Quantity(best.metrics[effort], units[effort]) for effort in efforts), best.step_us))
    header: tuple[Column | str, ...] = (
        "output", "closest", "its RMS error", "the others",
        *(f"its RMS of {effort.removesuffix('_rms')}" for effort in efforts), Column("its step", "µs"))
    return ResultTable(
        "Who follows the reference most closely, and at what price", f"plant {setting.plant.id}", header, tuple(rows),
        "One run of each, of the plant as stated; 'workbench sweep' draws its uncertain values.") if rows else None


def tune(study: LocatedPlantStudy, names: list[str], workers: int, on_progress: Progress,
         finished: Finished = NONE_YET) -> dict[Name, Tuned]:
    """The best parameters found for each controller by one budget, optimiser and seed; InputError for wrong names."""
    budget = study.tuning
    assert budget is not None
    metrics = [metric.id for metric in study.setting.every_metric]
    for name in budget.objective:
        if name not in metrics:
            raise InputError(study.file, f"tuning.objective.{name}", f"is no metric: name one of {', '.join(metrics)}")
    for name in names:
        for key in budget.ranges[name].keys() - study.tunable(name).keys():
            raise InputError(study.file, f"tuning.ranges.{name}.{key}", "is nothing that this controller states: name "
                             f"one of {', '.join(study.tunable(name))}")
    return search_all(_restart, study, names, budget.restarts, workers, on_progress, finished)


def _restart(study: LocatedPlantStudy, name: str, restart: int) -> Restart:
    budget = study.tuning
    assert budget is not None

    def cost(values: dict[str, float]) -> float:
        found = run_plant(study.setting, study.entrant(name, values), study.setting.parameters)
        sizes = {key: None if value is None else abs(value) for key, value in found.metrics.items()}
        return score(sizes, budget.objective, budget.failed)

    return search(cost, study.tunable(name), budget.ranges[name], budget.runs // budget.restarts, budget.seed, restart)


KIND = StudyKind(PlantStudy, run, located, tune)

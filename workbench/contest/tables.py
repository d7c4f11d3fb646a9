"""The tables of a contest: every condition, who wins where, and what a control step costs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from workbench.contest.effort import mpc_table
from workbench.contest.entrants import held_samples, information
from workbench.contest.matches import Entry
from workbench.contest.record import FEWEST_DRAWS
from workbench.contest.sampling import commands_every, with_periods
from workbench.contest.told import ALIKE, ARRIVED_M, COLUMNS, LATE_S, Told, label
from workbench.files.numbers import counted, number
from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.comparison import STEP
from workbench.paper.results import ResultTable

# So many are named where nobody is alone the best.
NAMED = 4


def condition_table(told: Told, condition: str) -> ResultTable:
    """A row per entry: means with their intervals, failed runs."""
    stated = told.contest.conditions[condition]
    rows = []
    best = {metric: told.best(condition, metric) for metric in told.metrics}
    columns = {metric: told.values(condition, metric) for metric in told.metrics}
    numbers = {entry: i for i, entry in enumerate(told.entries)}
    for group in told.alike:
        entry, i = group[0], numbers[group[0]]
        matches = told.of(condition, entry.name)
        failed = sum(match.failed is not None for match in matches)
        cells: list[Cell] = [label(group)]
        for metric in told.metrics:
            value = columns[metric][i]
            mark = " ●" if label(group) in best[metric] else "" if told.judged(entry, metric) else " (follows no curve)"
            cells.append(None if value is None else _with_interval(told, value, mark))
        rows.append((*cells, Phrase("{} of {}", (failed, len(matches)))))
    runs = told.runs(condition)
    noisy = stated.position_noise_m or stated.speed_noise_mps
    noise = " Noise is drawn anew at every sample, so that who samples more often has more to average." if noisy else ""
    few = stated.random and runs < FEWEST_DRAWS
    fewer = f" Of fewer than {FEWEST_DRAWS} draws the mean alone is told." if few else ""
    step_ms = 1e3 * told.scenario.simulation.plant_step_s
    jumps = (" Without an actuator a command is a jump of the force, whose jerk is that of one plant step of "
             f"{step_ms:g} ms." if stated.acting(told.scenario) is None else "")
    return ResultTable(
        stated.title, f"{counted(runs, 'run')} each, the same draws for all",
        ("controller", *(COLUMNS[metric] for metric in told.metrics), "failed"), tuple(rows),
        f"Means, in brackets their {100 * told.contest.confidence:g} % bootstrap interval (BCa). ● the best, and every "
        "one whose paired difference from it may be chance, by Holm's correction over all metrics and conditions; = "
        f"joins those whose runs agree within {100 * ALIKE:g} % in all of them. A controller with a run that fails, or "
        f"that misses the end by more than {ARRIVED_M:g} m, is not ranked; nor is one by errors from a curve that it "
        f"does not follow, nor by energy where it still moves {LATE_S:g} s after the arrival time."
        + fewer + noise + jumps)


def _with_interval(told: Told, values: NDArray[np.float64], mark: str) -> Cell:
    found, mean = told.interval(values), float(values.mean())
    if found is None:
        return Phrase(f"{{}}{mark}", (mean,)) if mark else mean
    return Phrase(f"{{}} [{{}}, {{}}]{mark}", (mean, found.low, found.high))


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
    drawn = [told.runs(name) for name, stated in told.contest.conditions.items() if stated.random]
    few = (f" With fewer than {told.fewest} draws nobody can be told apart by so many comparisons."
           if drawn and min(drawn) < told.fewest else "")
    return ResultTable(
        f"Who wins where; {commands_every(told.scenario)}", "the tables below",
        ("condition", *(COLUMNS[metric].heading for metric in told.metrics)),
        tuple(rows),
        "A difference that may be chance, by Holm's correction over all metrics and conditions, or of less than a "
        "thousandth, is no win: then all that may be best are named or counted. Ranked are those "
        f"whose runs all end within {ARRIVED_M:g} m of the end of the line, by energy those of them who stand "
        f"{LATE_S:g} s after the arrival time. A trailing + marks the tuned parameters.{few}")


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
        "Time a step: of the controller alone, without the plant; a compiled law in blocks, MPC call by call. "
        "Objective: what tuning minimises, on the draws of the search; of who has other parameters in each condition "
        "the least and the most.")


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
    """Every entry's energy against the certified lower bound of any run in that time, under the first condition in
    which it holds; none without such a one."""
    if told.lower_bound_j is None or not told.bounded:
        return
    condition = told.bounded[0]
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
        f"{number(told.lower_bound_j / COLUMNS['energy_J'].si)} kWh of traction, gusts aside. Who tracks the curve "
        "pays for the curve; a run that takes longer than the curve is not held by the bound.")


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
        yield with_periods(table, told.scenario, told.contest.conditions[told.bounded[0]])
    yield from absent_table(told)

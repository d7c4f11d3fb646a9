"""What the common contest found, as a page of Markdown: of every condition that has been played to its end.

    workbench report benchmarks/common.toml --out DIR          # plays, tunes nothing; --resume goes on
    workbench report benchmarks/minimax.toml --out WORST
    python benchmarks/contest_summary.py DIR docs/contest.md [WORST]
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path

from pydantic import TypeAdapter

from workbench.cli.loading import load
from workbench.contest.best_trackers import best_trackers_table
from workbench.contest.by_period import TRACKING, at_each_period, period_findings
from workbench.contest.entrants import information
from workbench.contest.journal import JOURNAL_NAME, contest_digest
from workbench.contest.matches import Match, entries, rounds
from workbench.contest.objective_table import objective_table
from workbench.contest.pareto import JOURNAL_NAME as FRONTS_NAME
from workbench.contest.pareto import Front, front_tables
from workbench.contest.record import Contest
from workbench.contest.told import COLUMNS, Told
from workbench.contest.tuning_table import tuning_table
from workbench.files.numbers import number
from workbench.paper.results import ResultTable

CONTEST, MINIMAX = (Path(__file__).with_name(f"{name}.toml") for name in ("common", "minimax"))
SHOWN = ("position_rms", "speed_rms", "stopping_error", "energy_J", "jerk_rms", "comfort_rms", "switchings_per_s")


def rests_on(folder: Path, contest: Contest) -> Iterator[str]:
    """By which code a journal was played."""
    head = json.loads((folder / JOURNAL_NAME).read_text(encoding="utf-8").partition("\n")[0])
    played_by = "the code and with the values" if contest_digest(contest, "pareto") in head.values() else (
        "an earlier state of the code or with other values than those")
    yield f"- The matches were played by {played_by} that stood here when this page was written."


def records(path: Path) -> list[dict[str, object]]:
    """The lines of a journal without its head; none where there is no journal."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()[1:]] if path.exists() else []


def played(folder: Path, contest: Contest) -> Told:
    """The contest of the conditions of which a whole round is there: every match of as many draws as that takes."""
    read = TypeAdapter(Match)
    matches = [read.validate_python(record) for record in records(folder / JOURNAL_NAME)]
    names = {entry.name for entry in entries(contest, contest.world)}
    there = {(match.condition, match.draw, match.entry) for match in matches}
    draws = {condition: max((count for count in rounds(contest, condition)
                             if there.issuperset(product([condition], range(count), names))), default=0)
             for condition in contest.conditions}
    done = {condition: i for i, condition in enumerate(name for name, count in draws.items() if count)}
    whole = contest.model_copy(update={"conditions": {name: contest.conditions[name] for name in done}})
    kept = sorted((match for match in matches if match.draw < draws[match.condition] and match.entry in names),
                  key=lambda match: (done[match.condition], match.draw))
    return Told(whole.with_world(contest.world), contest.world, tuple(kept), None)


def table(headings: list[str], rows: list[list[str]]) -> Iterator[str]:
    """As Markdown."""
    for number_of, row in enumerate((headings, *rows)):
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"
        if number_of == 0:
            yield f"|{'---|' * len(headings)}"
    yield ""


def of_period(own: Told, condition: str) -> Iterator[str]:
    """Who samples alike under a condition, best tracker first: means with intervals, ● those that may be best."""
    names, rows = own.entries, []
    values = {metric: own.values(condition, metric) for metric in SHOWN}
    tracking = values["position_rms"]
    means = [float("inf") if value is None else float(value.mean()) for value in tracking]
    for i in sorted(range(len(names)), key=means.__getitem__):
        failed = sum(match.failed is not None for match in own.of(condition, names[i].name))
        cells = [names[i].name]
        for metric in SHOWN:
            value = values[metric][i]
            if value is None:
                cells.append("—")
                continue
            found, si = own.interval(value), COLUMNS[metric].si
            best = " ●" if names[i].name in own.winners(condition, metric) else ""
            between = f" [{number(found.low / si)}, {number(found.high / si)}]" if found else ""
            cells.append(f"{number(float(value.mean()) / si)}{between}{best}")
        rows.append([*cells, f"{failed} of {own.runs(condition)}"])
    yield from table(["controller", *(COLUMNS[metric].heading for metric in SHOWN), "failed"], rows)


def page(told: Told, contest: Contest, fronts: list[Front], folder: Path) -> Iterator[str]:
    """Its lines."""
    left = [stated.title for name, stated in contest.conditions.items() if name not in told.contest.conditions]
    yield from (
        "# The common contest, as it was played", "",
        "All controllers on one train and line, under the same actuator, draws, noise and failures; ranked among those "
        "who command equally often. A + marks parameters that were tuned, by the same budget for all.", "",
        "## Headline", "", *(f"- {words}" for words in period_findings(told)), "")
    groups, best = list(at_each_period(told)), best_trackers_table(told)
    if best is not None:
        yield from ("## The best tracker by condition", "", *shown(best))
    short = [stated.title for name, stated in told.contest.conditions.items() if 1 < told.runs(name) < contest.seeds
             and any(len(own.best(name, TRACKING)) > 1 for _, own in groups)]
    if short:
        yield from (f"More draws, up to {contest.seeds}, may part a tie and were not played: {'; '.join(short)}.", "")
    yield from (
        "## How it was played", "",
        "- Behind the actuator of `benchmarks/common_run.toml`, unless the condition says otherwise.",
        "- Where anything is drawn, draws are added until who tracks best is told apart at each period, or to the "
        "most.",
        f"- Intervals are {100 * told.contest.confidence:g} % BCa. ● is the best and all who are not told apart from "
        "it by Holm's correction over all metrics and conditions of those who sample alike.",
        "- Who learns shows the last of its trips, which all meet the same train, line and gusts; noise is drawn anew "
        "for each.",
        "- Every number is from the runs; `benchmarks/contest_summary.py` writes this page.")
    yield from rests_on(folder, contest)
    yield ""
    if left:
        yield from (f"Stated in the contest's file and not played here: {', '.join(left)}.", "")
    for period, own in groups:
        base = told.contest.tuning.condition
        yield from (f"## Commands every {1e3 * period:g} ms, {told.contest.conditions[base].title}", "")
        yield from of_period(own, base)
    yield from ("## What tuning found", "")
    for found in tuning_table(told):
        yield from shown(found)
    for found in front_tables(contest, fronts):
        yield from (f"## {found.title}", "", *shown(found))
    yield from ("## What they are told", "")
    yield from table(["controller", "is told"], [[name, information(told.scenario, name)]
                                                 for name in told.scenario.controllers])


def worst(told: Told) -> Iterator[str]:
    """The contest in which everyone is tuned for the worst of several conditions."""
    yield from (
        "## Tuned for the worst of several conditions", "",
        f"`benchmarks/minimax.toml`, a contest of its own with {told.contest.seeds} draws a condition: + is tuned "
        "for the worst of several conditions, _ten is the same controller with what the common contest found in one. "
        f"A search takes {told.contest.evaluations('')} evaluations of {told.contest.tuning.draws} run in "
        "each condition, and nothing is ranked: the table says what the objective comes to, and where it is worst.", "")
    for found in (*objective_table(told), *tuning_table(told)):
        yield from (f"### {found.title}", "", *shown(found))


def shown(found: ResultTable) -> Iterator[str]:
    """A table of the report; names break where a telephone needs it."""
    yield from table(list(found.headings), [[cell.replace("_", "_<wbr>") for cell in row] for row in found.text])
    if found.note:
        yield from (found.note, "")


def main() -> None:
    """Write the page."""
    folder, out, *others = map(Path, sys.argv[1:])
    contest, minimax = (load(path).record for path in (CONTEST, MINIMAX))
    assert isinstance(contest, Contest) and isinstance(minimax, Contest)
    read = TypeAdapter(tuple[Front, ...])
    fronts = [front for record in records(folder / FRONTS_NAME) for front in read.validate_python(record["fronts"])]
    lines = [*page(played(folder, contest), contest, fronts, folder),
             *(line for other in others for line in worst(played(other, minimax)))]
    out.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

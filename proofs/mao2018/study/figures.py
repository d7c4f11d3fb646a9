"""The figures of mao2018's study: Figures 1 and 2 of the paper, and what they do not show."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import grouped
from workbench.model.events import failure_rows
from workbench.paper.cells import cell_text
from workbench.paper.reproduced import STATED
from workbench.paper.results import Curve, Plot
from workbench.paper.trip_run import ERROR
from workbench.simulate.kernel_loop import term

from ..simulation.trip import failures_of
from .runs import START_S, MaoResults, RunResult

# The figures that show how runs settle begin here, and end where an error passes LOST_MM.
START_OVER_S, LOST_MM = 20.0, 100.0
TIME, SIZE = "time (s)", "|position error| (m)"


def _title(results: MaoResults) -> str:
    title = results.study.tunings[results.first_tuning].title
    return f"{title[0].upper()}{title[1:]}."


def _label(results: MaoResults, run: RunResult) -> str:
    signs = results.left(run)
    law = "corrected" if signs == "none" else f"{signs} as printed"
    return law + (f" ({cell_text(run.ended)})" if run.failed else "")


def _distance(results: MaoResults) -> Plot:
    curves = results.corrected(1, results.first_tuning).curves
    return Plot("Distance of the healthy train", "paper, Figure 1", TIME, "distance (km)",
                (curves["desired"].called("desired distance", 1e-3), curves["distance"].called("distance", 1e-3)),
                "The desired curve is assumed, since Figure 1 is not in the text; on this scale the two coincide.")


def _errors(results: MaoResults) -> Iterator[Plot]:
    """Every law of a case once the error of the start is over, in mm."""
    for number in results.numbers[1:]:
        curves, missing, case = [], [], results.study.cases[number - 1]
        for run in results.select(number=number, tuning=results.first_tuning, change=STATED, end_s=None).values():
            label, shown = _label(results, run), run.curves[ERROR].part(START_OVER_S, LOST_MM / 1e3)
            if shown:
                curves.append(shown.called(label, 1e3))
            else:
                missing.append(label)
        yield Plot(
            f"Position error in case {number}: {case.title}", f"paper, Figure 2 ({'abcd'[number - 2]})", TIME,
            "position error (mm)", tuple(curves),
            f"From {START_OVER_S:g} s on{_after(case.initial_position_m)}; runs that diverge later "
            f"end where they pass {LOST_MM:g} mm. {_title(results)}"
            + (f" Not shown: {'; '.join(missing)}." if missing else ""))


def _after(start_m: float) -> str:
    return f", when the error of {grouped(f'{start_m:g}')} m at the start is over" if start_m else ""


def _sizes(results: MaoResults) -> Iterator[Plot]:
    for name, tuning in results.study.tunings.items():
        curves = [run.curves[ERROR].size().called(f"case {run.case.number}") for run in results.all_corrected(name)]
        yield Plot(f"Size of the position error, all signs corrected, {tuning.title}", "not in the paper", TIME, SIZE,
                   tuple(curves), log_y=True)


def _starts(results: MaoResults) -> Plot:
    """The first seconds, in which laws as printed leave the desired curve."""
    curves = [run.curves["start"].size().called(f"case {run.case.number}, {_label(results, run)}")
              for run in results.stated(results.first_tuning)
              if run.case.mended in ((), results.wrong(run.case.number))]
    return Plot(f"The first {START_S:g} s, laws as printed and corrected", "not in the paper", TIME, SIZE,
                tuple(curves), f"{_title(results)} No motor has failed yet.", log_y=True)


def _failure(results: MaoResults) -> Plot:
    """What the failed motor of case 2 gives and what its estimates make of it."""
    estimates = [results.corrected(2, tuning).curves["failure"].called(f"estimated, {tuning}")
                 for tuning in results.study.tunings]
    x, parts = estimates[0].x, failure_rows(failures_of(results.study, results.study.cases[1]))
    true = [sum(term(time, parts, i) for i in range(len(parts)) if parts[i, 0] <= time < parts[i, 1]) for time in x]
    return Plot("The failed motor's force and its estimate", "not in the paper", TIME, "force (kN)",
                (Curve("printed: the motor's force (67)", x, np.array(true) / 1e3), *estimates),
                "Case 2, corrected. The estimates of a, b, c, ϑ and D take up what these leave.")


def _commands(results: MaoResults) -> Plot:
    mass_t = results.study.train.mass_t
    curves = [run.curves["command"].called(f"case {run.case.number}", mass_t / 1e3)
              for run in results.all_corrected(results.first_tuning) if not run.failed]
    return Plot("Commanded force, all signs corrected", "not in the paper", TIME, "force of all motors (MN)",
                tuple(curves), f"{_title(results)} The paper states no limit of force.")


PLOTS = (_distance, _errors, _starts, _sizes, _failure, _commands)

"""The figures of mao2018's study: Figures 1 and 2 of the paper, and what they do not show."""

from __future__ import annotations

import numpy as np

from workbench.model.events import failure_rows
from workbench.paper.results import Curve, Plot
from workbench.simulate.kernel_loop import term

from .numbers import failures_of
from .outcomes import Found, ended, left
from .runs import START_S, Obtained

# The figures that show how runs settle begin here, and end where an error passes LOST_MM.
START_OVER_S, LOST_MM = 20.0, 100.0
TIME = "time (s)"


def all_plots(found: Found) -> tuple[Plot, ...]:
    """Figure 1, Figure 2 (a) to (d), and the errors by size, the start, the failure's estimate, the command."""
    cases = range(2, len(found.study.cases) + 1)
    return (_distance(found), *(_errors(found, number) for number in cases), _starts(found),
            *(_sizes(found, tuning) for tuning in found.study.tunings), _failure(found), _commands(found))


def _named(curve: Curve, label: str) -> Curve:
    return Curve(label, curve.x, curve.y)


def _until(curve: Curve, last: int) -> Curve:
    return Curve(curve.label, curve.x[:max(1, last)], curve.y[:max(1, last)])


def _within(curve: Curve, most: float) -> Curve:
    """The curve up to where it first exceeds `most`."""
    beyond = np.abs(curve.y) > most
    return _until(curve, int(np.argmax(beyond))) if beyond.any() else curve


def _size(curve: Curve) -> Curve:
    """|y|, without the points where it is zero."""
    kept = curve.y != 0
    return Curve(curve.label, curve.x[kept], np.abs(curve.y[kept])) if kept.any() else curve


def _distance(found: Found) -> Plot:
    run = found.corrected(1, first_tuning(found))
    curves = [Curve(label, run.curves[name].x, run.curves[name].y / 1e3)
              for label, name in (("desired distance", "desired"), ("distance", "distance"))]
    return Plot("Distance of the healthy train", "paper, Figure 1", TIME, "distance (km)", tuple(curves),
                "The desired curve is assumed, since Figure 1 is not in the text; on this scale the two coincide.")


def _label(found: Found, run: Obtained) -> str:
    signs = left(run, found.wrong(run.asked.case))
    law = "corrected" if signs == "none" else f"{signs} as printed"
    return law + (f" ({ended(run)})" if run.failed else "")


def _errors(found: Found, number: int) -> Plot:
    """Every law of a case once the error of the start is over, in mm."""
    curves, missing = [], []
    for run in found.stated(first_tuning(found)):
        curve = run.curves["error"]
        after = curve.x >= START_OVER_S
        if run.asked.case == number and after.any():
            curves.append(_within(Curve(_label(found, run), curve.x[after], 1e3 * curve.y[after]), LOST_MM))
        elif run.asked.case == number:
            missing.append(_label(found, run))
    return Plot(
        f"Position error in case {number}: {found.study.cases[number - 1].title}",
        f"paper, Figure 2 ({'abcd'[number - 2]})", TIME, "position error (mm)", tuple(curves),
        f"From {START_OVER_S:g} s on, when the {found.study.cases[number - 1].initial_position_m:g} m of the start are "
        f"over; runs that diverge later end where they pass {LOST_MM:g} mm. {_tuning(found)}"
        + (f" Not shown: {'; '.join(missing)}." if missing else ""))


def first_tuning(found: Found) -> str:
    """The tuning that figures show, by name."""
    return next(iter(found.study.tunings))


def _tuning(found: Found) -> str:
    tuning = found.study.tunings[first_tuning(found)]
    return f"{tuning.title[0].upper()}{tuning.title[1:]}."


def _sizes(found: Found, tuning: str) -> Plot:
    curves = [_named(_size(found.corrected(number, tuning).curves["error"]), f"case {number}")
              for number in range(1, len(found.study.cases) + 1)]
    title = found.study.tunings[tuning].title
    return Plot(f"Size of the position error, all signs corrected, {title}", "not in the paper", TIME,
                "|position error| (m)", tuple(curves), log_y=True)


def _starts(found: Found) -> Plot:
    """The first seconds, in which laws as printed leave the desired curve."""
    curves = [_size(_named(run.curves["start"], f"case {run.asked.case}, {_label(found, run)}"))
              for run in found.stated(first_tuning(found))
              if not found.wrong(run.asked.case) or run.asked.mended in ((), found.wrong(run.asked.case))]
    return Plot(f"The first {START_S:g} s, laws as printed and corrected", "not in the paper", TIME,
                "|position error| (m)", tuple(curves), f"{_tuning(found)} No motor has failed yet.", log_y=True)


def _failure(found: Found) -> Plot:
    """What the failed motor gives and what its estimates make of it."""
    number = 2
    runs = [(tuning, found.corrected(number, tuning)) for tuning in found.study.tunings]
    x = runs[0][1].curves["failure"].x
    parts = failure_rows(failures_of(found.study, found.study.cases[number - 1]))
    true = [sum(term(time, parts, i) for i in range(len(parts)) if parts[i, 0] <= time < parts[i, 1]) for time in x]
    curves = [Curve("printed: the motor's force (67)", x, np.array(true) / 1e3)]
    curves += [_named(run.curves["failure"], f"estimated, {tuning}") for tuning, run in runs]
    return Plot("The failed motor's force and its estimate", "not in the paper", TIME, "force (kN)", tuple(curves),
                f"Case {number}, corrected. The estimates of a, b, c, ϑ and D take up what these leave.")


def _commands(found: Found) -> Plot:
    mass_t = found.study.train.mass_t
    curves = [Curve(f"case {number}", run.curves["command"].x, mass_t / 1e3 * run.curves["command"].y)
              for number in range(1, len(found.study.cases) + 1)
              for run in (found.corrected(number, first_tuning(found)),) if not run.failed]
    return Plot("Commanded force, all signs corrected", "not in the paper", TIME, "force of all motors (MN)",
                tuple(curves), f"{_tuning(found)} The paper states no limit of force.")

"""The figures of chen2019, the energy function along the iterations, and the cost of a sample."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from workbench.files.numbers import number
from workbench.paper.learning_comparison import trial_curve
from workbench.paper.results import Curve, Plot

from ..simulation.cars_trials import CarsRun
from ..simulation.formulas import allowed_change, cef_change
from .runs import ChenResults, grows_from, outcome

FIGURE_5 = "paper, Figure 5"
OWN_PLACE = "Every car counts its displacement from its own place at the start. The reference is assumed."
# Figures of a trip, of all cars: those of the paper for its first and its last iteration; title, axis, logged column,
# what one of the axis' unit is in the log's, which row of the reference is drawn with it, note.
PROFILES = ((1, 2), (("Displacement", "displacement (km)", "s_m", 1e-3, 0, OWN_PLACE),
                     ("Speed", "speed (m/s)", "v_mps", 1.0, 1, OWN_PLACE)))
ERRORS = ((3, 4), (("Position error", "s − s_r (m)", "position_error_m", 1.0, None, ""),
                   ("Speed error", "v − v_r (m/s)", "speed_error_mps", 1.0, None, "")))
INPUTS = ((6, 7), (("Inputs within their limits", "u (kN)", "u_n", 1e-3, None, ""),))
DIFFERENCE = ("Difference of the inputs", "Δu = u − μ (kN)", "difference_n", 1e-3, None, "The largest within every {:g} s.")
DIFFERENCES = ((8, 9), (DIFFERENCE,))
Drawn = tuple[str, str, str, float, int | None, str]


def _of_trip(results: ChenResults, run: CarsRun, trial: int, source: str, drawn: Drawn, of: str = "", ends: str = ""
             ) -> Plot:
    """One figure of a trip; of: which run it is, in the title; ends: what became of it, in the note."""
    title, label, column, scale, row, note = drawn
    values, every = scale * run.log(trial, column), results.study.sampling.log_every_s
    times = np.arange(len(values), dtype=float) * every
    curves = [Curve(f"car {car + 1}", times, values[:, car]) for car in range(values.shape[1])]
    if row is not None:
        curves.insert(0, Curve("desired", times, scale * results.study.reference.curve().at(times)[row]))
    return Plot(f"{title}, trial {trial}{of}", source, "t (s)", label, tuple(curves), note.format(every) + ends)


def _over_trips(shown: tuple[tuple[int, int], tuple[Drawn, ...]], results: ChenResults) -> Iterator[Plot]:
    """The paper's figures of the stated run's trips, of those that ran to their end."""
    figures, every = shown
    for place, trial in enumerate(results.study.trials.shown):
        if trial in results.stated.logs:
            yield from (_of_trip(results, results.stated, trial, f"paper, Figure {figures[min(place, 1)]}", drawn)
                        for drawn in every)


def _along_trials(results: ChenResults) -> Iterator[Plot]:
    """Largest errors against the iteration, as stated and by the other rules."""
    runs = [("as stated", results.stated), *((change.title, run) for change, run in results.group("rules"))]
    early = "; ".join(f"{name}: {outcome(run)}" for name, run in runs if run.failed)
    for name, of, source, label in (
            ("position error", "position_error", FIGURE_5, "largest |s − s_r| of all cars (m)"),
            ("speed error", "speed_error", FIGURE_5, "largest |v − v_r| of all cars (m/s)"),
            ("difference of the input", "difference", "not in the paper", "largest |u − μ| of all cars (N)")):
        yield Plot(f"Largest {name} against the iteration", source, "trial", label,
                   tuple(trial_curve(words, getattr(run, of), 1) for words, run in runs if len(run.totals)),
                   f"Curves that end early: {early}." if early else "", log_y=True)


def _growing_differences(results: ChenResults) -> Iterator[Plot]:
    """The difference between actual and unsaturated inputs where the rules let it grow."""
    for change, run in results.group("rules"):
        last = max(run.logs, default=0)
        if change.set.get("sampling.memory") == "same_sample" and last and grows_from(run.difference) is not None:
            yield _of_trip(results, run, last, "beside paper, Figure 9", DIFFERENCE, f": {change.title}",
                           f" It {outcome(run)}.")


def _energy(results: ChenResults) -> Iterator[Plot]:
    """How much the energy function falls from iteration to iteration, beside what (35) promises."""
    run = results.stated
    if len(run.totals):
        yield Plot("Decrease of the energy function", "claim 35", "trial i", "E(i−1) − E(i) at T",
                   (trial_curve("promised by (35) at least", -allowed_change(results.study, run), 1),
                    trial_curve("obtained", -cef_change(run), 1)),
                   "As stated. The proof is for continuous time; a sampled law may keep it or not.", log_y=True)


def _cost(results: ChenResults) -> Plot:
    """Time of a sample against the number of cars."""
    measured = results.measured.by_length
    cars, times = np.array(list(measured), dtype=float), 1e6 * np.array(list(measured.values()))
    return Plot("Time of a sample against the number of cars", "not in the paper", "cars", "time of a sample (µs)",
                (Curve("measured", cars, times),
                 Curve(f"{number(times[0] / cars[0])} µs a car", cars, cars * times[0] / cars[0])),
                "A straight line of slope 1 is linear growth.", log_y=True, log_x=True)


# The paper's figures first, in its order.
PLOTS = (partial(_over_trips, PROFILES), partial(_over_trips, ERRORS), _along_trials, partial(_over_trips, INPUTS),
         partial(_over_trips, DIFFERENCES), _growing_differences, _energy, _cost)

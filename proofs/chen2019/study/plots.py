"""The figures of chen2019, the energy function along the iterations, and the cost of a sample."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import number
from workbench.paper.learning_comparison import trial_curve
from workbench.paper.results import Curve, Plot

from ..simulation.cars_trials import CarsRun
from ..simulation.formulas import allowed_change, cef_change
from .runs import ChenResults, grows_from, outcome

# The paper's figures by what they show: for its first and its last iteration.
FIGURES = {"profile": (1, 2), "errors": (3, 4), "input": (6, 7), "difference": (8, 9)}
FIGURE_5 = "paper, Figure 5"


def _shown(results: ChenResults, kind: str) -> list[tuple[str, int]]:
    """The figures of a kind, and their trials, for those that ran to their end."""
    return [(f"paper, Figure {FIGURES[kind][min(place, 1)]}", trial)
            for place, trial in enumerate(results.study.trials.shown) if trial in results.stated.logs]


def _cars(results: ChenResults, trial: int, column: str, scale: float = 1.0, run: CarsRun | None = None
          ) -> tuple[Curve, ...]:
    values = scale * (run or results.stated).log(trial, column)
    times = np.arange(len(values), dtype=float) * results.study.sampling.log_every_s
    return tuple(Curve(f"car {car + 1}", times, values[:, car]) for car in range(values.shape[1]))


def _profiles(results: ChenResults) -> Iterator[Plot]:
    """Displacement and speed of all cars with the reference."""
    for figure, trial in _shown(results, "profile"):
        for column, scale, row, name, unit in (("s_m", 1e-3, 0, "displacement", "km"),
                                               ("v_mps", 1.0, 1, "speed", "m/s")):
            cars = _cars(results, trial, column, scale)
            wanted = results.study.reference.curve().at(cars[0].x)[row]
            yield Plot(f"{name.capitalize()}, trial {trial}", figure, "t (s)", f"{name} ({unit})",
                       (Curve("desired", cars[0].x, scale * wanted), *cars),
                       "Every car counts its displacement from its own place at the start. The reference is assumed.")


def _errors(results: ChenResults) -> Iterator[Plot]:
    """Errors of displacement and speed of all cars."""
    for figure, trial in _shown(results, "errors"):
        for name, column, label in (("Position error", "position_error_m", "s − s_r (m)"),
                                    ("Speed error", "speed_error_mps", "v − v_r (m/s)")):
            yield Plot(f"{name}, trial {trial}", figure, "t (s)", label, _cars(results, trial, column))


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


def _inputs(results: ChenResults) -> Iterator[Plot]:
    """The limited inputs of all cars."""
    for figure, trial in _shown(results, "input"):
        yield Plot(f"Inputs within their limits, trial {trial}", figure, "t (s)", "u (kN)",
                   _cars(results, trial, "u_n", 1e-3))


def _differences(results: ChenResults) -> Iterator[Plot]:
    """The difference between actual and unsaturated inputs of all cars, as stated and where the rules let it grow."""
    label, note = "Δu = u − μ (kN)", f"The largest within every {results.study.sampling.log_every_s:g} s."
    for figure, trial in _shown(results, "difference"):
        yield Plot(f"Difference of the inputs, trial {trial}", figure, "t (s)", label,
                   _cars(results, trial, "difference_n", 1e-3), note)
    for change, run in results.group("rules"):
        last = max(run.logs, default=0)
        if change.set.get("sampling.memory") == "same_sample" and last and grows_from(run.difference) is not None:
            yield Plot(f"Difference of the inputs, trial {last}: {change.title}", "beside paper, Figure 9", "t (s)",
                       label, _cars(results, last, "difference_n", 1e-3, run), f"{note} It {outcome(run)}.")


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
    cars = np.array(list(results.measured.sample_s), dtype=float)
    times = 1e6 * np.array(list(results.measured.sample_s.values()))
    return Plot("Time of a sample against the number of cars", "not in the paper", "cars", "time of a sample (µs)",
                (Curve("measured", cars, times),
                 Curve(f"{number(times[0] / cars[0])} µs a car", cars, cars * times[0] / cars[0])),
                "A straight line of slope 1 is linear growth.", log_y=True, log_x=True)


# The paper's figures first, in its order.
PLOTS = (_profiles, _errors, _along_trials, _inputs, _differences, _energy, _cost)

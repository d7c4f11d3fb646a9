"""The figures of chen2019, the energy function along the iterations, and the cost of a sample."""

from __future__ import annotations

import numpy as np

from workbench.files.numbers import number
from workbench.paper.results import Curve, Plot

from ..simulation.cars_trials import CarsRun
from .outcomes import Found, allowed_change, cef_change, difference, grows_from, outcome, position_error, speed_error
from .runs import STATED, title

# The paper's figures by what they show: for its first and its last iteration.
FIGURES = {"profile": (1, 2), "errors": (3, 4), "input": (6, 7), "difference": (8, 9)}
FIGURE_5 = "paper, Figure 5"


def all_plots(found: Found) -> tuple[Plot, ...]:
    """All figures, the paper's first and in its order."""
    return (*profiles(found), *errors(found), *along_trials(found), *inputs(found), *differences(found),
            *energy(found), cost(found))


def _shown(found: Found) -> list[tuple[int, int]]:
    """Place among the paper's two iterations, and trial, for those that ran to their end."""
    shown = enumerate(found.study.trials.shown)
    return [(min(place, 1), trial) for place, trial in shown if trial in found.stated.logs]


def _figure(kind: str, place: int) -> str:
    return f"paper, Figure {FIGURES[kind][place]}"


def _times(found: Found, rows: int) -> np.ndarray:
    return np.arange(rows) * found.study.sampling.log_every_s


def _cars(found: Found, trial: int, column: str, scale: float = 1.0, run: CarsRun | None = None) -> list[Curve]:
    values = scale * (run or found.stated).log(trial, column)
    return [Curve(f"car {car + 1}", _times(found, len(values)), values[:, car]) for car in range(values.shape[1])]


def profiles(found: Found) -> list[Plot]:
    """Displacement and speed of all cars with the reference."""
    plots = []
    for place, trial in _shown(found):
        times = _times(found, len(found.stated.log(trial, "s_m")))
        wanted = found.study.reference.curve().at(times)
        for column, scale, row, label in (("s_m", 1e-3, 0, "displacement (km)"), ("v_mps", 1.0, 1, "speed (m/s)")):
            plots.append(Plot(
                f"{label.split(' (')[0].capitalize()}, trial {trial}", _figure("profile", place), "t (s)", label,
                (Curve("desired", times, scale * wanted[row]), *_cars(found, trial, column, scale)),
                "Every car counts its displacement from its own place at the start. The reference is assumed."))
    return plots


def errors(found: Found) -> list[Plot]:
    """Errors of displacement and speed of all cars."""
    return [Plot(f"{name}, trial {trial}", _figure("errors", place), "t (s)", label,
                 tuple(_cars(found, trial, column)))
            for place, trial in _shown(found)
            for name, column, label in (("Position error", "position_error_m", "s − s_r (m)"),
                                        ("Speed error", "speed_error_mps", "v − v_r (m/s)"))]


def along_trials(found: Found) -> list[Plot]:
    """Largest errors against the iteration, as stated and by the other rules."""
    chosen = [STATED, *(i for i, change in enumerate(found.study.changes) if change.group == "rules")]
    plots = []
    for name, of, label in (("Largest position error", position_error, "largest |s − s_r| of all cars (m)"),
                            ("Largest speed error", speed_error, "largest |v − v_r| of all cars (m/s)"),
                            ("Largest difference of the input", difference, "largest |u − μ| of all cars (N)")):
        curves = []
        for i in chosen:
            run = found.runs[i]
            if len(run.totals):
                curves.append(Curve(title(found.study, i), np.arange(1.0, len(run.totals) + 1), of(run)))
        early = "; ".join(f"{title(found.study, i)}: {outcome(found.runs[i])}" for i in chosen if found.runs[i].failed)
        plots.append(Plot(
            f"{name} against the iteration", "not in the paper" if of is difference else FIGURE_5, "trial", label,
            tuple(curves), f"Curves that end early: {early}." if early else "", log_y=True))
    return plots


def inputs(found: Found) -> list[Plot]:
    """The limited inputs of all cars."""
    return [Plot(f"Inputs within their limits, trial {trial}", _figure("input", place), "t (s)", "u (kN)",
                 tuple(_cars(found, trial, "u_n", 1e-3))) for place, trial in _shown(found)]


def differences(found: Found) -> list[Plot]:
    """The difference between actual and unsaturated inputs of all cars, as stated and where the rules let it grow."""
    label, note = "Δu = u − μ (kN)", f"The largest within every {found.study.sampling.log_every_s:g} s."
    plots = [Plot(f"Difference of the inputs, trial {trial}", _figure("difference", place), "t (s)", label,
                  tuple(_cars(found, trial, "difference_n", 1e-3)), note) for place, trial in _shown(found)]
    for change, run in found.group("rules"):
        last = max(run.logs, default=0)
        if change.set.get("sampling.memory") == "same_sample" and last and grows_from(difference(run)) is not None:
            words = outcome(run)
            plots.append(Plot(
                f"Difference of the inputs, trial {last}: {change.title}", "beside paper, Figure 9", "t (s)", label,
                tuple(_cars(found, last, "difference_n", 1e-3, run)), f"{note} It {words}."))
    return plots


def energy(found: Found) -> list[Plot]:
    """How much the energy function falls from iteration to iteration, beside what (35) promises."""
    run: CarsRun = found.stated
    if not len(run.totals):
        return []
    trials = np.arange(1.0, len(run.totals) + 1)
    return [Plot(
        "Decrease of the energy function", "claim 35", "trial i", "E(i−1) − E(i) at T",
        (Curve("promised by (35) at least", trials, -allowed_change(found.study, run)),
         Curve("obtained", trials, -cef_change(run))),
        "As stated. The proof is for continuous time; a sampled law may keep it or not.", log_y=True)]


def cost(found: Found) -> Plot:
    """Time of a sample against the number of cars."""
    cars = np.array([float(p.cars) for p in found.cost])
    times = np.array([p.step_us for p in found.cost])
    return Plot("Time of a sample against the number of cars", "not in the paper", "cars", "time of a sample (µs)",
                (Curve("measured", cars, times),
                 Curve(f"{number(times[0] / cars[0])} µs a car", cars, cars * times[0] / cars[0])),
                "A straight line of slope 1 is linear growth.", log_y=True, log_x=True)

"""liu2020's Figures 3 to 18 from the runs, and its tables as curves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from workbench.paper.results import Curve, Plot
from workbench.paper.trip_run import ERROR

from ..laws import LAWS
from ..simulation.trip import desired_curve, line_table
from .runs import ALL_COLUMNS, BY_RATE, CORRECTED, PRINTED, RMS, LiuResults, RunResult, number_of
from .tables import QUANTITIES

TIME = "time (s)"
CASE_1, CASE_2 = (1, 2, 3, 4, 5), (5, 6, 7, 8, 9)
LABELS = {"s_tilde": "position estimation error s̃ (m)", "v_tilde": "speed estimation error ṽ (m/s)",
          ERROR: "position tracking error (m)", "speed": "speed tracking error (m/s)", "input_n": "input u (MN)"}
# Figures 5 to 12: what they show, and of which columns.
BY_COLUMN = ((5, "s_tilde", CASE_1), (6, "v_tilde", CASE_1), (7, "input_n", CASE_1), (8, "s_tilde", CASE_2),
             (9, "v_tilde", CASE_2), (10, ERROR, CASE_2), (11, "speed", CASE_2), (12, "input_n", CASE_2))
DRAWN_BY_COLUMN = (CORRECTED, BY_RATE, PRINTED, "liu2020.position_only_speed")
CONTROL_GAINS = (10, 11, 12)  # what they show depends on k_4 and k_5


def _of(run: RunResult, name: str, label: str) -> Curve:
    """A run's curve, of the input in MN."""
    return run.curves[name].called(label, 1e-6 if name == "input_n" else 1.0)


def _line(results: LiuResults) -> Plot:
    table, study = line_table(results.study), results.study
    position = np.repeat(np.append(table.position_m, study.line.length_m), 2)[1:-1] / 1e3
    force = np.repeat(table.specific_force, 2) * study.train.mass_kg / 1e3
    return Plot("Additional resistance along the line", "paper, Figure 3 and Table 1", "position (km)",
                "additional resistance (kN)", (Curve("", position, force),))


def _desired(results: LiuResults) -> Plot:
    curve = desired_curve(results.study)
    time = np.linspace(0.0, curve.trip_time_s, 5000)
    position, speed, _ = curve.at(time)
    return Plot("Desired trajectory", "paper, Figure 4", TIME, "speed (m/s), position (km)",
                (Curve("speed (m/s)", time, speed), Curve("position (km)", time, position / 1e3)),
                "Figure 4 and (62) to (68) are not in the text: this one starts, cruises at 350 km/h and stops.")


def _drawn(title: str, figure: int, law: str, label: str, curves: Iterable[Curve], note: str = "") -> Plot:
    """A figure of the paper over time under a law."""
    return Plot(title, f"paper, Figure {figure}; {LAWS[law].title}", TIME, label, tuple(curves), note)


def _by_column(results: LiuResults) -> Iterator[Plot]:
    alike = "Values 5 and 7, and 6, 8 and 9, have the same control gains and nearly coincide."
    for figure, name, columns in BY_COLUMN:
        for law in results.laws((CORRECTED, *((BY_RATE,) if name == "v_tilde" else ())), column=columns[0]):
            yield _drawn(f"{_words(name)}, Values {columns[0]} to {columns[-1]}", figure, law, LABELS[name],
                         (_of(results.table_3(column, law), name, f"Value {column}") for column in columns),
                         alike if figure in CONTROL_GAINS else "")


def _trajectory(results: LiuResults) -> Plot:
    study = results.study
    curves = results.table_4(study.runs.table_3_disturbance, CORRECTED).curves
    shown = [curves[key].called(f"{state}{what} ({unit})", factor)
             for state, end in (("desired ", "_desired"), ("", "")) for what, unit, key, factor in (
                 ("speed", "m/s", f"v{end}_mps", 1.0), ("position", "km", f"s{end}_m", 1e-3))]
    return _drawn(f"Position and speed, Value {study.table_4_column}", 13, CORRECTED, "speed (m/s), position (km)", shown)


def _by_disturbance(results: LiuResults) -> Iterator[Plot]:
    study = results.study
    for figure, name in enumerate(LABELS, start=14):
        yield _drawn(f"{_words(name)}, Value {study.table_4_column} under three disturbances", figure, CORRECTED,
                     LABELS[name], (_of(results.table_4(key, CORRECTED), name, push.title)
                                    for key, push in study.disturbances.items()))


def _words(name: str) -> str:
    return LABELS[name].rpartition(" (")[0].capitalize()


def _rms_by_column(results: LiuResults) -> Iterator[Plot]:
    for name in RMS:
        curves = [Curve("printed in Table 3", np.array(ALL_COLUMNS, dtype=float),
                        np.array(getattr(results.study.table_3, name)))]
        for law in results.laws(DRAWN_BY_COLUMN, disturbance=results.study.runs.table_3_disturbance):
            curves += _by_value(LAWS[law].title, [results.table_3(column, law) for column in ALL_COLUMNS], name)
        curves += _by_value("feedback alone as inferred", results.inferred(), name)
        yield Plot(f"RMS of {QUANTITIES[name].title} by column of Table 2", "paper, Table 3", "Value",
                   f"RMS {QUANTITIES[name].heading}", tuple(curves),
                   "" if name == "s_tilde_m" else "Of Value 10 Table 4 prints a tenth.", log_y=True)


def _by_value(label: str, runs: Sequence[RunResult], name: str) -> list[Curve]:
    """A curve over the columns whose runs did not fail; none when all did."""
    known = [(float(run.case.column), value) for run in runs if (value := number_of(run, name)) is not None]
    return [Curve(label, *map(np.array, zip(*known, strict=True)))] if known else []


PLOTS = (_line, _desired, _by_column, _trajectory, _by_disturbance, _rms_by_column)

"""liu2020's Figures 3 to 18 from the runs, and its tables as curves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from workbench.paper.results import Curve, Plot

from ..laws import LAWS
from .cases import ALL_COLUMNS, Found
from .runs import Outcome, desired_curve, line_table
from .tables import SIGNS, WITH_UNIT

TIME = "time (s)"
CORRECTED, BY_RATE = "liu2020.corrected", "liu2020.corrected_rate"
CASE_1, CASE_2 = (1, 2, 3, 4, 5), (5, 6, 7, 8, 9)
LABELS = {"s_tilde_m": "position estimation error s̃ (m)", "v_tilde_mps": "speed estimation error ṽ (m/s)",
          "position_m": "position tracking error (m)", "speed_mps": "speed tracking error (m/s)",
          "input_n": "input u (MN)"}
# Figures 5 to 12: what they show, and of which columns.
BY_COLUMN = ((5, "s_tilde_m", CASE_1), (6, "v_tilde_mps", CASE_1), (7, "input_n", CASE_1), (8, "s_tilde_m", CASE_2),
             (9, "v_tilde_mps", CASE_2), (10, "position_m", CASE_2), (11, "speed_mps", CASE_2), (12, "input_n", CASE_2))
CONTROL_GAINS = (10, 11, 12)  # what they show depends on k_4 and k_5


def all_plots(found: Found) -> tuple[Plot, ...]:
    """Every figure of the study; one of which all runs failed is left out."""
    plots = [_line(found), _desired(found)]
    for figure, name, columns in BY_COLUMN:
        plots.append(_by_column(found, figure, name, columns, CORRECTED))
        if name == "v_tilde_mps":
            plots.append(_by_column(found, figure, name, columns, BY_RATE))
    plots.append(_trajectory(found))
    plots += [_by_disturbance(found, figure, name) for figure, name in enumerate(LABELS, start=14)]
    plots += [_rms_by_column(found, name) for name in ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps")]
    return tuple(plot for plot in plots if plot.curves)


def _of(outcome: Outcome, name: str, label: str) -> tuple[Curve, ...]:
    """A run's curve up to where it is finite; none if there is nothing of it."""
    x, y = outcome.curves["t_s"], outcome.curves[name] * (1e-6 if name == "input_n" else 1.0)
    end = len(y) if np.isfinite(y).all() else int(np.argmin(np.isfinite(y)))
    return (Curve(label, x[:end], y[:end]),) if end else ()


def _line(found: Found) -> Plot:
    table, study = line_table(found.study), found.study
    position = np.repeat(np.append(table.position_m, study.line.length_m), 2)[1:-1] / 1e3
    force = np.repeat(table.specific_force, 2) * study.train.mass_kg / 1e3
    return Plot("Additional resistance along the line", "paper, Figure 3 and Table 1", "position (km)",
                "additional resistance (kN)", (Curve("", position, force),))


def _desired(found: Found) -> Plot:
    curve = desired_curve(found.study)
    time = np.linspace(0.0, curve.trip_time_s, 5000)
    position, speed, _ = curve.at(time)
    return Plot("Desired trajectory", "paper, Figure 4", TIME, "speed (m/s), position (km)",
                (Curve("speed (m/s)", time, speed), Curve("position (km)", time, position / 1e3)),
                "Figure 4 and (62) to (68) are not in the text: this one starts, cruises at 350 km/h and stops.")


def _by_column(found: Found, figure: int, name: str, columns: Sequence[int], law: str) -> Plot:
    curves = tuple(curve for column in columns
                   for curve in _of(found.table_3(column, law), name, f"Value {column}"))
    alike = "Values 5 and 7, and 6, 8 and 9, have the same control gains and nearly coincide."
    return Plot(f"{_words(name)}, Values {columns[0]} to {columns[-1]}", f"paper, Figure {figure}; {LAWS[law].title}",
                TIME, LABELS[name], curves, alike if figure in CONTROL_GAINS else "")


def _trajectory(found: Found) -> Plot:
    study = found.study
    outcome = found.table_4(study.runs.table_3_disturbance, CORRECTED)
    time = outcome.curves["t_s"]
    curves = [Curve("desired speed (m/s)", time, outcome.curves["v_desired_mps"]),
              Curve("desired position (km)", time, outcome.curves["s_desired_m"] / 1e3),
              Curve("speed (m/s)", time, outcome.curves["v_mps"]),
              Curve("position (km)", time, outcome.curves["s_m"] / 1e3)]
    finite = [curve for curve in curves if np.isfinite(curve.y).all()]
    return Plot(f"Position and speed, Value {study.table_4_column}", f"paper, Figure 13; {LAWS[CORRECTED].title}", TIME,
                "speed (m/s), position (km)", tuple(finite))


def _by_disturbance(found: Found, figure: int, name: str) -> Plot:
    study = found.study
    curves = tuple(curve for key, push in study.disturbances.items()
                   for curve in _of(found.table_4(key, CORRECTED), name, push.title))
    return Plot(f"{_words(name)}, Value {study.table_4_column} under three disturbances",
                f"paper, Figure {figure}; {LAWS[CORRECTED].title}", TIME, LABELS[name], curves)


def _words(name: str) -> str:
    return LABELS[name].rpartition(" (")[0].capitalize()


def _rms_by_column(found: Found, name: str) -> Plot:
    study = found.study
    curves = [Curve("printed in Table 3", np.array(ALL_COLUMNS, dtype=float), np.array(getattr(study.table_3, name)))]
    for law in (CORRECTED, BY_RATE, "liu2020.printed", "liu2020.position_only_speed"):
        curves += _by_value(LAWS[law].title, [found.table_3(column, law) for column in ALL_COLUMNS], name)
    curves += _by_value("feedback alone as inferred", found.inferred(), name)
    return Plot(f"RMS of {SIGNS[name]} by column of Table 2", "paper, Table 3", "Value", f"RMS {WITH_UNIT[name]}",
                tuple(curves), "" if name == "s_tilde_m" else "Of Value 10 Table 4 prints a tenth.", log_y=True)


def _by_value(label: str, outcomes: Sequence[Outcome], name: str) -> list[Curve]:
    """A curve over the columns whose runs did not fail; none when all did."""
    known = [(float(o.case.column), value) for o in outcomes if (value := o.numbers.get(name)) is not None]
    return [Curve(label, *map(np.array, zip(*known, strict=True)))] if known else []

"""A run of several cars for other programs: a block of the JSON document, and forces and couplers as CSV."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.files.writing import write_text
from workbench.optimal.cars.cars_steady import steady_state
from workbench.optimal.cars.multi_car import CarsRun


def cars_document(cars: CarsRun) -> dict[str, Any]:
    """The run of the cars as data, SI units; cruise: the steady state at its highest speed, null where none is."""
    return {
        "count": cars.train.cars, "motors": list(cars.train.motors), "rule": cars.rule, "energy_J": cars.energy_j,
        "peak_coupler_N": cars.peak_coupler_n.tolist(),
        "planned_peak_coupler_N": np.abs(cars.planned_coupler_n).max(axis=0).tolist(),
        "stretch_m": cars.stretch_m, "apart_m": cars.apart_m, "position_drift_m": cars.position_drift_m,
        "speed_drift_mps": cars.speed_drift_mps, "correction_N": cars.correction_n, "force_excess": cars.force_excess,
        "wheel_J": cars.works["wheel_j"], "resistance_J": cars.works["resistance_j"],
        "one_body_resistance_J": cars.one_body_j,
        "damper_J": cars.works["damper_j"], "stored_J": cars.stored_j, "balance_residual_J": cars.residual_j,
        "cruise": _cruise(cars),
    }


def _cruise(cars: CarsRun) -> dict[str, Any] | None:
    speed = float(cars.speed_mps.mean(axis=1).max())
    try:
        state = steady_state(cars.train, speed, rule=cars.rule)
    except InputError:  # more than the train can hold on the level: it was reached downhill
        return None
    return {"speed_mps": speed, "grade_permille": 0.0, "force_N": state.force_n.tolist(),
            "coupler_N": state.coupler_n.tolist(), "stretch_m": state.stretch_m.tolist()}


def write_cars_csv(path: Path, cars: CarsRun, every_s: float) -> None:
    """Rows about every_s apart: time, force of every car, pull of every coupler; InputError where it cannot be."""
    step = max(1, round(every_s / (cars.time_s[1] - cars.time_s[0])))
    kept = np.unique(np.append(np.arange(0, len(cars.time_s), step), len(cars.time_s) - 1))
    rows = np.column_stack((cars.time_s, cars.force_n, cars.coupler_n))[kept]
    count = cars.train.cars
    header = ["t_s", *(f"u{j}_N" for j in range(1, count + 1)), *(f"coupler{j}_N" for j in range(1, count))]
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(header)
    writer.writerows([f"{value:.9g}" for value in row] for row in rows.tolist())
    write_text(path, text.getvalue())

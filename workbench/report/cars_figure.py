"""What the cars of a train do along an energy-optimal run: forces of the cars, pull of the couplers."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from workbench.optimal.cars.multi_car import CarsRun
from workbench.report.svg import FAINT, INK, PALETTE, thin

# Beyond so many curves only the range of all of them is drawn.
MOST_CURVES = 6


def couplers_figure(cars: CarsRun, faint: str = FAINT) -> Figure:
    """Forces of the cars over time, and below them the pull of the couplers, simulated and for cars kept together."""
    figure = Figure(figsize=(9, 5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    count = cars.train.cars
    for axes, values, what in ((above, cars.force_n, "car"), (below, cars.coupler_n, "coupler")):
        if values.shape[1] <= MOST_CURVES:
            for j in range(values.shape[1]):
                axes.plot(*thin(cars.time_s, values[:, j] / 1e3), color=PALETTE[j % len(PALETTE)], linewidth=1.0,
                          label=f"{what} {j + 1}")
        else:
            for ends, name in ((values.max(axis=1), "highest"), (values.min(axis=1), "lowest")):
                axes.plot(*thin(cars.time_s, ends / 1e3), linewidth=1.0, label=f"{name} of {values.shape[1]} {what}s",
                          color=PALETTE[name == "lowest"])
        axes.axhline(0, color=faint, linewidth=0.6)
    largest = np.abs(cars.planned_coupler_n).max(axis=1) / 1e3
    below.plot(*thin(cars.time_s, largest), color=INK, linewidth=0.8, linestyle=":", label="largest, kept together")
    above.set(ylabel="force of a car (kN)", title=f"{count} cars: forces and couplers of the energy-optimal run")
    below.set(ylabel="pull of a coupler (kN)", xlabel="time (s)", xlim=(0, float(cars.time_s[-1])))
    for axes in (above, below):
        axes.legend(ncols=4, loc="upper right")
    return figure

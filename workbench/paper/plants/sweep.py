"""The Monte Carlo of a plant's study: the same drawn plants and noise for every controller, a row a run."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.files.numbers import unit_text
from workbench.files.writing import make_folder, write_text
from workbench.paper.cells import Column
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.paper.results import ResultTable
from workbench.paper.study import Progress
from workbench.simulate.plants.run import run as run_plant
from workbench.tasks.handing_out import places, results_of

CSV_NAME = "sweep.csv"
REMEDY = "name another --out"
Pair = tuple[int, str]


@dataclass(frozen=True)
class PlantSweep:
    """rows: one a run and controller, ordered by run, with the factors drawn, the metrics, and why it failed."""

    study: LocatedPlantStudy
    runs: int
    rows: tuple[dict[str, Any], ...]

    @property
    def csv(self) -> str:
        """The rows as CSV: floats by repr, so that they read back as the same numbers; None is an empty cell."""
        text = io.StringIO(newline="")
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.rows[0])
        for row in self.rows:
            writer.writerow(["" if v is None else repr(v) if isinstance(v, float) else v for v in row.values()])
        return text.getvalue()

    def table(self) -> ResultTable:
        """Mean of each metric over the runs that did not fail, and its value farthest from zero, of what is a smallest
        value the least; a row a controller."""
        metrics = self.study.setting.every_metric
        header = [Column("controller"), Column("failed runs", digits=None)]
        for metric in metrics:
            name = metric.title or metric.id.replace("_", " ")
            unit = unit_text(metric.unit)
            header += [Column(f"{name}, mean", unit),
                       Column(f"{name}, {'least' if metric.measure == 'smallest' else 'largest'}", unit)]
        rows = []
        for controller in dict.fromkeys(row["controller"] for row in self.rows):
            own = [row for row in self.rows if row["controller"] == controller]
            cells: list[Any] = [controller, float(sum(row["failed"] is not None for row in own))]
            for metric in metrics:
                values = [row[metric.id] for row in own if row[metric.id] is not None]
                worst = min if metric.measure == "smallest" else partial(max, key=abs)
                cells += [float(np.mean(values)), float(worst(values))] if values else [None, None]
            rows.append(tuple(cells))
        return ResultTable(f"Monte Carlo, {self.runs} runs", f"plant {self.study.the_plant.id}", tuple(header),
                           tuple(rows), "Every controller meets the same drawn plants; failed runs are left out of the "
                           "other columns.")


def sweep(study: LocatedPlantStudy, runs: int | None = None, seed: int | None = None,
          controllers: Sequence[str] | None = None, out: Path | None = None, workers: int | None = None,
          on_progress: Progress = lambda done, total, what: None) -> PlantSweep:
    """Run every controller on every drawn plant; with `out` sweep.csv is written there.

    Controllers believe the stated parameters. Rows depend on study, seed and run alone, whatever the workers. Raises
    InputError for names that are no controllers and a study that draws nothing.
    """
    names = list(dict.fromkeys(controllers or study.entrants()))
    for name in names:
        if name not in study.entrants():
            raise InputError(study.file, "controllers", f"'{name}' is no controller of this study: choose among "
                             f"{', '.join(study.entrants())}")
    stated = study.uncertainty
    runs = runs or (stated.runs if stated else 1)
    seed = seed if seed is not None else stated.seed if stated else 0
    study.drawn(0, seed)  # so that what is wrong with the draws is said before anything runs
    if out is not None:
        make_folder(out, out, REMEDY)
    for name in names:  # compiled once here, for all processes
        run_plant(_short(study, name), study.entrants()[name])
    pairs = [(run, name) for run in range(runs) for name in names]
    found = results_of(_row, (study, seed), pairs, places(workers),
                       lambda done, pair, _: on_progress(done, len(pairs), pair[1]))
    result = PlantSweep(study, runs, tuple(found.values()))
    if out is not None:
        write_text(out / CSV_NAME, result.csv, REMEDY)
    return result


def _short(study: LocatedPlantStudy, name: str) -> Any:
    return study.setting.varied(duration_s=study.entrants()[name].period_s, log_every_s=None)


def _row(shared: tuple[LocatedPlantStudy, int], pair: Pair) -> dict[str, Any]:
    (study, seed), (number, name) = shared, pair
    drawn = study.drawn(number, seed)
    factors = study.uncertainty.factors if study.uncertainty else ()
    found = run_plant(drawn, study.entrants()[name], study.setting.parameters)
    return {"run": number, "controller": name, **{f"drawn_{key}": drawn.parameters[key] for key in factors},
            **found.metrics, "failed": found.failed}

"""The Monte Carlo of a plant's study: the same drawn plants and noise for every controller, a row a run."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.files.modules import python_files
from workbench.files.numbers import unit_text
from workbench.files.regular import contents
from workbench.files.writing import make_folder, write_text
from workbench.paper.cells import Column
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.paper.results import ResultTable
from workbench.paper.study import Progress
from workbench.simulate.journal import code_digest
from workbench.simulate.parts import Made, run_missing
from workbench.simulate.plants.run import run as run_plant
from workbench.simulate.row_store import ChunkStore, Part, RowStore
from workbench.simulate.sweep_rows import Values
from workbench.tasks.versions import versions

CSV_NAME = "sweep.csv"
REMEDY = "name another --out"
# On which modules of the package a row depends.
SIMULATING = ("files/*.py", "model/*.py", "systems/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py",
              "simulate/plants/*.py", "paper/plants/*.py")


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
          on_progress: Progress = lambda done, total, what: None, resume: bool = False) -> PlantSweep:
    """Run every controller on every drawn plant; with `out` sweep.csv is written there.

    With `out` rows are kept as they are made (`row_store`), and `resume` goes on with them, also with more runs or
    other controllers. Controllers believe the stated parameters. Rows depend on study, seed and run alone, whatever the
    workers. Raises InputError for names that are no controllers, a study that draws nothing, and a folder of another.
    """
    entrants = study.entrants()
    names = list(dict.fromkeys(controllers or entrants))
    for name in names:
        if name not in entrants:
            raise InputError(study.file, "controllers", f"'{name}' is no controller of this study: choose among "
                             f"{', '.join(entrants)}")
    stated = study.uncertainty
    runs = runs or (stated.runs if stated else 1)
    seed = seed if seed is not None else stated.seed if stated else 0
    study.drawn(0, seed)  # so that what is wrong with the draws is said before anything runs
    columns = _columns(study)
    with _store(study, seed, out, resume, columns) as store:
        for name in names if store.lacks(names, runs) else ():  # compiled once here, for all processes
            run_plant(_short(study, name), entrants[name])
        run_missing(run_part, (study, seed), names, runs, store, workers,
                    lambda done: on_progress(done, runs * len(names), ""))
    kept = [store.rows(name, 0, runs) for name in names]
    result = PlantSweep(study, runs, tuple(dict(zip(columns, row, strict=True))
                                           for of_run in zip(*kept, strict=True) for row in of_run))
    if out is not None:
        write_text(out / CSV_NAME, result.csv, REMEDY)
    return result


def _store(study: LocatedPlantStudy, seed: int, out: Path | None, resume: bool, columns: dict[str, str]) -> RowStore:
    """Where the rows are kept: in the folder `out`, if there is one, which then names the study, its files and code."""
    if out is None:
        return RowStore()
    make_folder(out, out, REMEDY)
    unneeded: dict[str, Any] = dict.fromkeys(("title", "citation", "file", "folder", "joint_sensitivity"), True)
    values = study.model_dump(exclude=unneeded | {"uncertainty": {"runs", "seed"}})
    signals = [str(signal) for signal in (*study.setting.references.values(), *study.setting.disturbances.values())]
    digest = hashlib.sha256(code_digest(*SIMULATING))
    digest.update(json.dumps([values, signals], sort_keys=True, default=str).encode())
    for file in sorted(python_files(study.folder)):
        digest.update(contents(file))
    return ChunkStore(out, {"plant study": study.name, "seed": seed, "versions": versions(),
                            "digest of values, files and code": digest.hexdigest()[:20]}, resume, columns)


def _short(study: LocatedPlantStudy, name: str) -> Any:
    return study.setting.varied(duration_s=study.entrants()[name].period_s, log_every_s=None)


def _columns(study: LocatedPlantStudy) -> dict[str, str]:
    """Name of each column of the rows, and the type of its values."""
    factors = study.uncertainty.factors if study.uncertainty else ()
    return {"run": "int", "controller": "str", **{f"drawn_{key}": "float" for key in factors},
            **{metric.id: "float" for metric in study.setting.every_metric}, "failed": "str"}


def run_part(shared: tuple[LocatedPlantStudy, int], part: Part) -> Made:
    """The rows of some runs of a controller, and how many seconds they took."""
    study, seed = shared
    begun, entrant = time.perf_counter(), study.entrants()[part.controller]
    factors = study.uncertainty.factors if study.uncertainty else ()
    rows: list[Values] = []
    for number in range(part.first, part.end):
        drawn = study.drawn(number, seed)
        found = run_plant(drawn, entrant, study.setting.parameters)
        row = {"run": number, "controller": part.controller,
               **{f"drawn_{key}": float(drawn.parameters[key]) for key in factors}, **found.metrics,
               "failed": found.failed}
        rows.append(tuple(row[name] for name in _columns(study)))
    return part, time.perf_counter() - begun, rows

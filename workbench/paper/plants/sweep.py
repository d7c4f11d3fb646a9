"""The Monte Carlo of a plant's study: the same drawn plants and noise for every controller, a row a run."""

from __future__ import annotations

import hashlib
import json
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.files.known_names import one_of
from workbench.files.modules import python_files
from workbench.files.numbers import counted, unit_text
from workbench.files.regular import contents
from workbench.files.writing import make_folder, write_pieces
from workbench.paper.cells import Column
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.paper.results import ResultTable
from workbench.paper.study import Progress
from workbench.simulate.journal import code_digest
from workbench.simulate.parts import Made, run_missing
from workbench.simulate.plants.run import run as run_plant
from workbench.simulate.row_store import ChunkStore, Part, RowStore
from workbench.simulate.sweep_rows import Values, csv_pieces, in_order
from workbench.systems.metric import Metric
from workbench.tasks.versions import versions

CSV_NAME = "sweep.csv"
REMEDY = "name another --out"
WHOLE = 1e-6  # of a period: by so little a time may miss a whole number of them
# On which modules of the package a row depends.
SIMULATING = ("files/*.py", "model/*.py", "systems/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py",
              "simulate/plants/*.py", "paper/plants/*.py")


@dataclass
class MetricSums:
    """What the rows of one controller come to, added block by block in the order of the runs.

    places: of each metric in a row; failed: how many runs did; totals: how many values of a metric there are, their
    sum, and the one farthest from zero, or of what is a smallest value the least.
    """

    metrics: Sequence[Metric]
    places: dict[str, int]
    failed: int = 0
    totals: dict[str, tuple[int, float, float]] = field(default_factory=dict)

    def add(self, rows: Sequence[Values]) -> None:
        """Add rows of this controller."""
        self.failed += sum(row[self.places["failed"]] is not None for row in rows)
        for metric in self.metrics:
            place = self.places[metric.id]
            values = [float(value) for row in rows if (value := row[place]) is not None]
            if values:
                count, total, worst = self.totals.get(metric.id, (0, 0.0, values[0]))
                pick: Callable[..., float] = min if metric.measure == "smallest" else partial(max, key=abs)
                self.totals[metric.id] = count + len(values), total + float(np.sum(values)), pick([worst, *values])

    def cells(self) -> Iterator[float | None]:
        """The failed runs, then of each metric its mean and its worst value; None where there is no value."""
        yield float(self.failed)
        for metric in self.metrics:
            count, total, worst = self.totals.get(metric.id, (0, 0.0, None))
            yield from (total / count if count else None, worst)


@dataclass(frozen=True)
class PlantSweep:
    """A Monte Carlo of a plant that has been run. runs: of each controller; a row is a run of one, with the factors
    drawn, the metrics, and why it failed.

    Its rows are read where they are kept, a block at a time.
    """

    study: LocatedPlantStudy
    names: tuple[str, ...]
    runs: int
    store: RowStore

    def rows(self) -> Iterator[dict[str, Any]]:
        """All rows by the names of their columns, ordered by run, then controller."""
        for block in self.store.blocks(self.names, self.runs):
            for row in in_order(block):
                yield dict(zip(row_columns(self.study), row, strict=True))

    def csv(self, on_block: Callable[[list[list[Values]]], None] = lambda block: None) -> Iterator[bytes]:
        """The rows as CSV, in pieces. on_block: is called with the rows of each controller before they are a piece."""
        def blocks() -> Iterator[list[Values]]:
            for block in self.store.blocks(self.names, self.runs):
                on_block(block)
                yield in_order(block)

        return csv_pieces(blocks(), tuple(row_columns(self.study)))

    def write_csv(self, path: Path) -> ResultTable:
        """Write all rows, and return their table: mean of each metric over the runs that did not fail, and its value
        farthest from zero, of what is a smallest value the least; a row a controller."""
        metrics = self.study.setting.every_metric
        places = {name: place for place, name in enumerate(row_columns(self.study))}
        sums = [MetricSums(metrics, places) for _ in self.names]

        def add(block: list[list[Values]]) -> None:
            for one, rows in zip(sums, block, strict=True):
                one.add(rows)

        write_pieces(path, self.csv(add), REMEDY)
        header = [Column("controller"), Column("failed runs", digits=None)]
        for metric in metrics:
            name, unit = metric.title or metric.id.replace("_", " "), unit_text(metric.unit)
            header += [Column(f"{name}, mean", unit),
                       Column(f"{name}, {'least' if metric.measure == 'smallest' else 'largest'}", unit)]
        return ResultTable(f"Monte Carlo, {counted(self.runs, 'run')}",
                           f"plant {self.study.the_plant.id}", tuple(header),
                           tuple((name, *one.cells()) for name, one in zip(self.names, sums, strict=True)),
                           "Every controller meets the same drawn plants; failed runs are left out of the other "
                           "columns.")


def sweep(study: LocatedPlantStudy, runs: int | None = None, seed: int | None = None,
          controllers: Sequence[str] | None = None, out: Path | None = None, workers: int | None = None,
          on_progress: Progress = lambda done, total, what: None, resume: bool = False) -> PlantSweep:
    """Run every controller on every drawn plant.

    With `out` rows are kept there as they are made (`row_store`), and `resume` goes on with them, also with more runs
    or other controllers. Controllers believe the stated parameters. Rows depend on study, seed and run alone, whatever
    the workers. Raises InputError for names that are no controllers, a study that draws nothing, and a folder of
    another.
    """
    entrants = study.entrants()
    names = list(dict.fromkeys(controllers or entrants))
    for name in names:
        if name not in entrants:
            raise InputError(study.file, "controllers", f"'{name}' is no controller of this study: "
                             f"{one_of(name, entrants)}")
    stated = study.uncertainty
    runs = runs or (stated.runs if stated else 1)
    seed = seed if seed is not None else stated.seed if stated else 0
    study.drawn(0, seed)  # so that what is wrong with the draws is said before anything runs
    columns = row_columns(study)
    with _store(study, seed, out, resume, columns) as store:
        for name in names if store.lacks(names, runs) else ():  # compiled once here, for all processes
            run_plant(_short(study, name), entrants[name])
        run_missing(run_part, (study, seed), names, runs, store, workers,
                    lambda done: on_progress(done, runs * len(names), ""))
    return PlantSweep(study, tuple(names), runs, store)


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
    """The study's setting for as few periods as let delayed commands and measurements arrive, which a run demands."""
    setting, period = study.setting, study.entrants()[name].period_s
    latest = max((*setting.late_s.values(), *setting.delay_s.values()), default=0.0)
    return setting.varied(duration_s=max(1, math.ceil(latest / period - WHOLE)) * period, log_every_s=None)


def row_columns(study: LocatedPlantStudy) -> dict[str, str]:
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
        rows.append(tuple(row[name] for name in row_columns(study)))
    return part, time.perf_counter() - begun, rows

"""Monte Carlo: the same drawn trains and lines under every controller, wherever they are run, resumable."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.known_names import one_of
from workbench.files.writing import write_pieces
from workbench.model.desired_curve import CruiseSpeed
from workbench.simulate.closed_loop import check_controllers, prepared, simulate
from workbench.simulate.controllers import compiled
from workbench.simulate.draws import Draws, factors_of
from workbench.simulate.journal import code_digest, laws_digest
from workbench.simulate.metrics import measure
from workbench.simulate.parts import run_missing
from workbench.simulate.row_store import REMEDY, ChunkStore, Part, RowStore
from workbench.simulate.setting import Setting, setting_of
from workbench.simulate.stopping import Mean, UntilWidth, looks, metric_of
from workbench.simulate.sweep_rows import (
    BLOCK,
    Sums,
    SweepRow,
    SweepSummary,
    Values,
    csv_pieces,
    in_order,
    row_values,
    summarised,
    sweep_row,
)
from workbench.tasks.versions import versions
from workbench.trains.scenario import Scenario
from workbench.trains.track import CurveSection, GradeSection, Track

CSV_NAME = "sweep.csv"
# On which modules of the package a row depends.
SIMULATING = ("files/*.py", "model/*.py", "trains/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py")

Shared = tuple[Scenario, int, Draws]
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Options:
    """How a Monte Carlo is run; None stands for the scenario's seed, all its controllers, no folder, a process a core.

    until: draws end before `runs` where the intervals are narrow enough; resume: goes on with what `out` holds.
    """

    runs: int
    seed: int | None = None
    controllers: Sequence[str] | None = None
    out: Path | None = None
    resume: bool = False
    workers: int | None = None
    draws: Draws = "random"
    until: UntilWidth | None = None


@dataclass(frozen=True)
class MonteCarlo:
    """A Monte Carlo that has been run. runs: of each controller; means: of the metric by which it ended, by controller.

    Its rows are read where they are kept, a block at a time.
    """

    names: tuple[str, ...]
    runs: int
    means: dict[str, Mean]
    store: RowStore

    def rows(self) -> Iterator[SweepRow]:
        """All rows, ordered by run, then controller."""
        for block in self.store.blocks(self.names, self.runs):
            yield from map(sweep_row, in_order(block))

    def write_csv(self, path: Path) -> list[SweepSummary]:
        """Write all rows and return what they come to, without having them all in memory."""
        sums = [Sums(name) for name in self.names]

        def added() -> Iterator[list[Values]]:
            for block in self.store.blocks(self.names, self.runs):
                for one, rows in zip(sums, block, strict=True):
                    one.add(rows)
                yield in_order(block)

        write_pieces(path, csv_pieces(added()), REMEDY)
        return [one.summary() for one in sums]


_ready: dict[str, tuple[Shared, Callable[[Setting], Any], Setting]] = {}


def run_part(shared: Shared, part: Part) -> tuple[Part, float, list[Values]]:
    """The rows of some runs of a controller, and how many seconds they took."""
    scenario, seed, draws = shared
    begun = time.perf_counter()
    held = _ready.get(part.controller)
    if held is None or held[0] is not shared:
        held = _ready[part.controller] = shared, prepared(scenario, part.controller), setting_of(scenario)
    _, drive, nominal = held
    drawn = factors_of(scenario, part.first, part.runs, seed, draws)
    rows = [row_values(run, factors, measure(drive(setting_of(scenario, factors, nominal)), scenario))
            for run, factors in enumerate(drawn, part.first)]
    return part, time.perf_counter() - begun, rows


def sweep(scenario: Scenario, scenario_path: Path, runs: int, seed: int | None = None,
          controllers: Sequence[str] | None = None, out: Path | None = None, resume: bool = False,
          workers: int | None = None, on_progress: Progress = lambda done, total: None) -> list[SweepRow]:
    """Every (run, controller) of a Monte Carlo, ordered by run, then controller; with `out`, sweep.csv too.

    As `monte_carlo`, for as many runs as memory holds.
    """
    found = monte_carlo(scenario, scenario_path, Options(runs, seed, controllers, out, resume, workers), on_progress)
    if out is not None:
        found.write_csv(out / CSV_NAME)
    return list(found.rows())


def monte_carlo(scenario: Scenario, scenario_path: Path, asked: Options,
                on_progress: Progress = lambda done, total: None) -> MonteCarlo:
    """Run every controller on every drawn train in parallel processes.

    With `out` rows are kept there as they are made (`row_store`), and `resume` continues after a kill, also with more
    runs or other controllers. on_progress(finished, total) is called as runs finish. Rows depend on scenario, seed and
    draws alone; a controller that has a compiled form runs in it.
    Raises InputError for unusable options or a folder of another sweep, WorkbenchError when workers die.
    """
    check_controllers(scenario, scenario_path)
    names = chosen(scenario, scenario_path, asked.controllers)
    seed = scenario.uncertainty.seed if asked.seed is None else asked.seed
    for key, value, least in (("runs", asked.runs, 1), ("seed", seed, 0), ("workers", asked.workers, 1)):
        if value is not None and value < least:
            raise InputError(scenario_path, key, f"{value} is too few: give at least {least}")
    if asked.resume and asked.out is None:
        raise InputError(scenario_path, "resume", "needs the folder of the sweep to go on with: name it")
    if asked.until and asked.draws != "random":
        raise InputError(scenario_path, "until-width", f"needs draws by chance, not '{asked.draws}': the interval of a "
                         "mean says nothing of points that are spread evenly")
    settings = {"scenario": scenario.name, "seed": seed, "draws": asked.draws, "versions": versions(),
                "digest of values, line and code": inputs_digest(scenario)}
    scenario = compiled(scenario.model_copy(update={"controllers": {n: scenario.controllers[n] for n in names}}))
    store = ChunkStore(asked.out, settings, asked.resume) if asked.out is not None else RowStore()
    means = {name: Mean() for name in names} if asked.until else {}
    with store:
        reached = 0
        for look in looks(asked.runs, asked.until):
            _run_missing((scenario, seed, asked.draws), names, look, asked, store, on_progress)
            for name, mean in means.items():
                for first in range(reached, look, BLOCK):
                    rows = store.rows(name, first, min(first + BLOCK, look))
                    mean.add(metric_of(rows, asked.until) if asked.until else [])
            reached = look
            if asked.until and all(mean.width <= asked.until.width for mean in means.values()):
                break
    return MonteCarlo(tuple(names), reached, means, store)


def _run_missing(shared: Shared, names: Sequence[str], runs: int, asked: Options, store: RowStore,
                 on_progress: Progress) -> None:
    """Make the rows of the first runs that the store does not have."""
    if store.lacks(names, runs):
        _compile_kernels(shared[0])
    run_missing(run_part, shared, names, runs, store, asked.workers,
                lambda done: on_progress(done, asked.runs * len(names)))


def summarise(rows: Sequence[SweepRow], scenario: Scenario) -> list[SweepSummary]:
    """Each controller over all its runs, in the scenario's order; failed runs are counted and left out."""
    present = {row.controller for row in rows}
    return [summarised(name, [row for row in rows if row.controller == name])
            for name in scenario.controllers if name in present]


def inputs_digest(scenario: Scenario) -> str:
    """What the rows depend on: the scenario's values, its line, and the code that computes them."""
    data = scenario.model_dump(exclude={"printed_table", "printed_values", "variants", "tuning", "joint_sensitivity",
                                        "title", "citation"})
    text = json.dumps(data, sort_keys=True, default=str)
    return hashlib.sha256(code_digest(*SIMULATING) + laws_digest(scenario) + text.encode()).hexdigest()[:20]


def chosen(scenario: Scenario, path: Path, controllers: Sequence[str] | None) -> list[str]:
    """The controllers that were asked for, all unless any; InputError for one that the scenario does not have."""
    names = list(scenario.controllers) if controllers is None else list(dict.fromkeys(controllers))
    for name in names:
        if name not in scenario.controllers:
            raise InputError(path, "controllers", f"'{name}' is no controller of this scenario: "
                             f"{one_of(name, scenario.controllers)}")
    if not names:
        raise InputError(path, "controllers", "none chosen: name at least one")
    return names


def _compile_kernels(scenario: Scenario) -> None:
    """Run every controller a few seconds on a short line, so that workers find the kernels in the cache."""
    why = "convention: short"
    curve = CruiseSpeed(
        kind="cruise_speed", cruise_mps=1.0, acceleration_mps2=1.0, braking_mps2=1.0, ramp_s=0.5,
        source=dict.fromkeys(("kind", "cruise_mps", "acceleration_mps2", "braking_mps2", "ramp_s"), why),
    )
    line = Track(
        name="short", length_m=3.0, grade=(GradeSection(start_m=0.0, end_m=3.0, grade_permille=0.0),),
        curve=(CurveSection(start_m=0.0, end_m=3.0, radius_m=float("inf")),),
        source=dict.fromkeys(("name", "length_m", "grade", "curve"), why),
    )
    short = scenario.model_copy(update={"track": line, "reference": curve})
    for name in scenario.controllers:
        simulate(short, name)

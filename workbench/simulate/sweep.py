"""Monte Carlo: the same drawn trains and lines under every controller, in parallel, resumable."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
from pydantic import TypeAdapter, ValidationError

from workbench.errors import InputError
from workbench.files.writing import write_text
from workbench.model.desired_curve import CruiseSpeed
from workbench.simulate.closed_loop import Factors, check_controllers, simulate
from workbench.simulate.controllers import compiled
from workbench.simulate.journal import REMEDY, Journal, code_digest, laws_digest
from workbench.simulate.metrics import Metrics, measure
from workbench.simulate.process_pool import cores, run_tasks
from workbench.trains.scenario import Scenario
from workbench.trains.track import CurveSection, GradeSection, Track

CSV_NAME, JOURNAL_NAME = "sweep.csv", "sweep.journal.jsonl"
# On which modules of the package a row depends.
SIMULATING = ("files/*.py", "model/*.py", "trains/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py")
# Totals and means over a whole run: they say nothing when the run ended early.
WHOLE_RUN = ("position_rms", "speed_rms", "stopping_error", "energy_J", "jerk_rms", "jerk_p95",
             "jerk_max", "comfort_rms", "command_variation", "switchings", "overspeed_max",
             "saturated_fraction", "limit_violations")

Pair = tuple[int, str]
Progress = Callable[[int, int, "SweepRow"], None]


@dataclass(frozen=True)
class SweepRow:
    """One run of one controller: the drawn factors and the metrics that do not depend on the machine's speed.

    SI units as in `Metrics`. A failed run keeps its extrema up to the failure; what only makes sense for a
    whole run is None. counters: the controller's own counts, e.g. "qp=300;qp_failed=0".
    """

    run: int
    controller: str
    factors: Factors
    position_error_min: float | None
    position_error_max: float | None
    speed_error_min: float | None
    speed_error_max: float | None
    position_rms: float | None
    speed_rms: float | None
    stopping_error: float | None
    energy_J: float | None
    jerk_rms: float | None
    jerk_p95: float | None
    jerk_max: float | None
    comfort_rms: float | None
    command_variation: float | None
    switchings: float | None
    overspeed_max: float | None
    saturated_fraction: float | None
    limit_violations: int | None
    command_max: float | None
    command_min: float | None
    speed_min: float | None
    time_of_max_position_error: float | None
    counters: str
    failed: str | None


@dataclass(frozen=True)
class SweepSummary:
    """A controller over all runs: extrema and means over the runs that did not fail; None when all failed.

    position errors and mean_abs_stopping_error in m, speed errors in m/s.
    """

    controller: str
    runs: int
    failed: int
    position_error_min: float | None
    position_error_max: float | None
    speed_error_min: float | None
    speed_error_max: float | None
    mean_abs_stopping_error: float | None


def draw_factors(scenario: Scenario, run_index: int, seed: int | None = None) -> Factors:
    """The factors of one run, the same for every controller; the seed is the scenario's unless given.

    Each factor is drawn whether or not the scenario names it, so that naming one more changes no other.
    """
    uncertainty = scenario.uncertainty
    sequence = np.random.SeedSequence(uncertainty.seed if seed is None else seed, spawn_key=(run_index,))
    drawn = np.random.default_rng(sequence).uniform(-1.0, 1.0, len(fields(Factors)))
    spreads = dict.fromkeys(uncertainty.factors, uncertainty.spread) | {"odometer_scale": uncertainty.odometer_spread}
    return Factors(**{
        f.name: 1.0 + spreads[f.name] * float(x) if spreads.get(f.name) else 1.0
        for f, x in zip(fields(Factors), drawn, strict=True)
    })


def run_pair(shared: tuple[Scenario, int], pair: Pair) -> SweepRow:
    """The row of one (run, controller) of a (scenario, seed)."""
    (scenario, seed), (run, controller) = shared, pair
    factors = draw_factors(scenario, run, seed)
    return _row(run, factors, measure(simulate(scenario, controller, factors), scenario))


def _row(run: int, factors: Factors, metrics: Metrics) -> SweepRow:
    values = metrics.row()
    own = {f.name: values[f.name] for f in fields(SweepRow) if f.name in values}
    if metrics.failed is not None:
        own |= dict.fromkeys(WHOLE_RUN)
        if own["position_error_max"] is None:  # it failed before its first sample
            own["time_of_max_position_error"] = None
    own["counters"] = ";".join(f"{key}={count}" for key, count in sorted(metrics.counters.items()))
    return SweepRow(run=run, factors=factors, **own)  # type: ignore[arg-type]


def sweep(scenario: Scenario, scenario_path: Path, runs: int, seed: int, controllers: Sequence[str] | None = None,
          out: Path | None = None, resume: bool = False, workers: int | None = None,
          on_progress: Progress | None = None) -> list[SweepRow]:
    """Run every (run, controller) pair in parallel processes; rows ordered by run, then controller.

    With `out` the folder receives `sweep.csv` at the end, and a journal as pairs finish, from which `resume`
    continues after a kill, also with more runs or other controllers. on_progress(finished, total, row) is
    called after each pair. Rows depend on scenario and seed alone; a controller that has a compiled form runs in it.
    Workers are spawned: a script that calls this needs the usual `if __name__ == "__main__":`.
    Raises InputError for unusable options or a journal of another sweep, WorkbenchError when a worker dies.
    """
    check_controllers(scenario, scenario_path)
    names = _chosen(scenario, scenario_path, controllers)
    for key, value, least in (("runs", runs, 1), ("seed", seed, 0), ("workers", workers, 1)):
        if value is not None and value < least:
            raise InputError(scenario_path, key, f"{value} is too few: give at least {least}")
    if resume and out is None:
        raise InputError(scenario_path, "resume", "needs the folder of the sweep to go on with: name it")
    settings = {"scenario": scenario.name, "seed": seed,
                "digest of values, line and code": inputs_digest(scenario)}
    scenario = compiled(scenario.model_copy(update={"controllers": {n: scenario.controllers[n] for n in names}}))
    pairs = [(run, name) for run in range(runs) for name in names]
    journal = Journal(Path(out) / JOURNAL_NAME, settings, resume) if out is not None else None
    with journal or nullcontext():
        done = _journalled(journal) if journal else {}
        todo = [pair for pair in pairs if pair not in done]

        def record(row: SweepRow) -> None:
            if (row.run, row.controller) in done:
                return
            if journal:
                journal.append(asdict(row))
            done[row.run, row.controller] = row
            if on_progress:
                on_progress(len(done.keys() & set(pairs)), len(pairs), row)

        if todo:
            _compile_kernels(scenario)
            run_tasks(run_pair, (scenario, seed), todo, workers or cores(), record)
    rows = [done[pair] for pair in pairs]
    if out is not None:
        write_text(Path(out) / CSV_NAME, csv_text(rows), "name another --out")
    return rows


def summarise(rows: Sequence[SweepRow], scenario: Scenario) -> list[SweepSummary]:
    """Each controller over all its runs, in the scenario's order; failed runs are counted and left out."""
    present = {row.controller for row in rows}
    return [_summary(name, [row for row in rows if row.controller == name])
            for name in scenario.controllers if name in present]


def _summary(name: str, rows: list[SweepRow]) -> SweepSummary:
    whole = [row for row in rows if row.failed is None]

    def over(key: str, fold: Callable[[list[float]], float]) -> float | None:
        values = [value for row in whole if (value := getattr(row, key)) is not None]
        return fold(values) if values else None

    return SweepSummary(
        controller=name, runs=len(rows), failed=len(rows) - len(whole),
        position_error_min=over("position_error_min", min),
        position_error_max=over("position_error_max", max),
        speed_error_min=over("speed_error_min", min), speed_error_max=over("speed_error_max", max),
        mean_abs_stopping_error=over("stopping_error", lambda values: float(np.mean(np.abs(values)))),
    )


def csv_text(rows: Sequence[SweepRow]) -> str:
    """The rows as CSV; floats by repr, so that they read back as the same numbers; None is an empty cell."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    factors = [f.name for f in fields(Factors)]
    values = [f.name for f in fields(SweepRow) if f.name not in ("run", "controller", "factors")]
    writer.writerow(["run", "controller", *(f"factor_{name}" for name in factors), *values])
    for row in rows:
        cells = [row.run, row.controller, *(getattr(row.factors, n) for n in factors),
                 *(getattr(row, n) for n in values)]
        writer.writerow(["" if c is None else repr(c) if isinstance(c, float) else c for c in cells])
    return stream.getvalue()


def inputs_digest(scenario: Scenario) -> str:
    """What the rows depend on: the scenario's values, its line, and the code that computes them."""
    data = scenario.model_dump(exclude={"printed_table", "printed_values", "variants", "tuning", "joint_sensitivity",
                                        "title", "citation"})
    text = json.dumps(data, sort_keys=True, default=str)
    return hashlib.sha256(code_digest(*SIMULATING) + laws_digest(scenario) + text.encode()).hexdigest()[:20]


def _chosen(scenario: Scenario, path: Path, controllers: Sequence[str] | None) -> list[str]:
    names = list(scenario.controllers) if controllers is None else list(dict.fromkeys(controllers))
    for name in names:
        if name not in scenario.controllers:
            raise InputError(path, "controllers", f"'{name}' is no controller of this scenario: choose among "
                                                  f"{', '.join(scenario.controllers)}")
    if not names:
        raise InputError(path, "controllers", "none chosen: name at least one")
    return names


def _journalled(journal: Journal) -> dict[Pair, SweepRow]:
    read = TypeAdapter(SweepRow)
    try:
        rows = [read.validate_python(record) for record in journal.records]
    except ValidationError:
        raise InputError(journal.path, "", f"holds a record that is no row of a sweep: {REMEDY}") from None
    return {(row.run, row.controller): row for row in rows}


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

"""The joint sweep over assumed values: the range of a file's headline number, and which assumption decides it."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import InputError
from workbench.files.modules import python_files
from workbench.files.numbers import number
from workbench.files.regular import contents
from workbench.files.writing import write_text
from workbench.model.sensitivity import Sensitivity
from workbench.paper.cells import Phrase, Quantity
from workbench.paper.loading import Loaded, kind_of
from workbench.paper.results import ResultTable
from workbench.paper.sobol import Index, Indices, design, indices
from workbench.paper.study import StudyKind, varied, with_values
from workbench.paper.tuning_journal import SEARCHING
from workbench.simulate.closed_loop import simulate
from workbench.simulate.journal import REMEDY, Journal, code_digest
from workbench.simulate.metrics import measure
from workbench.tasks.handing_out import places, run_tasks
from workbench.trains.scenario import Scenario, Variant, changed_scenario

JOURNAL_NAME, CSV_NAME = "joint_sensitivity.journal.jsonl", "joint_sensitivity.csv"
Array = NDArray[np.float64]
Shared = tuple[Loaded, Sensitivity]
# (loaded, stated, values of the file) -> the number that is looked at.
Evaluate = Callable[[Shared, dict[str, Any]], float | None]


@dataclass(frozen=True)
class Found:
    """values: of the metric at every point, shape (samples (ranges + 2),); points: the values drawn, a row each."""

    stated: Sensitivity
    points: Array
    values: Array
    indices: Indices
    failed: int


def drawn(stated: Sensitivity) -> Array:
    """The values of the file at every point of the design, a column for each range."""
    unit = design(len(stated.ranges), stated.samples, stated.seed)
    columns = []
    for column, (key, (low, high)) in zip(unit.T, stated.ranges.items(), strict=True):
        columns.append(low * (high / low) ** column if key in stated.logarithmic else low + column * (high - low))
    return np.stack(columns, axis=1)


def sensitivity(loaded: Loaded, out: Path | None = None, resume: bool = False, workers: int | None = None,
                on_progress: Callable[[int, int], None] = lambda done, total: None,
                evaluate: Evaluate | None = None) -> Found:
    """Run the file at every point in parallel processes; the same numbers whatever their number.

    out: a folder for the points as CSV and for finished runs, with which `resume` goes on. Raises InputError for a file
    without a [joint_sensitivity] table, for keys and metrics that are none, and for a run that fails where it counts as
    nothing.
    """
    stated: Sensitivity | None = loaded.record.joint_sensitivity
    if stated is None:
        raise InputError(loaded.path, "joint_sensitivity", "is missing: name ranges, metric and samples in this table")
    if loaded.data.get("kind") == "contest":
        raise InputError(loaded.path, "joint_sensitivity", "is for scenarios and studies: state it in one of these")
    points = drawn(stated)
    shared, task = (loaded, stated), evaluate or _evaluate
    values: dict[int, float | None]
    with _journal(out, loaded, resume) if out else nullcontext() as journal:
        values = _read(journal, len(points)) if journal else {}

        def record_value(done: tuple[int, float | None]) -> None:
            if journal:
                journal.append({"point": done[0], "value": done[1]})
            values[done[0]] = done[1]
            on_progress(len(values), len(points))

        keys = list(stated.ranges)
        tasks = [(i, dict(zip(keys, points[i].tolist(), strict=True))) for i in range(len(points)) if i not in values]
        run_tasks(_one, (task, shared), tasks, places(workers), record_value)
    failed = sum(value is None for value in values.values())
    if failed and stated.failed is None:
        first = next(i for i in range(len(points)) if values[i] is None)
        raise InputError(loaded.path, "joint_sensitivity.failed", f"is missing: {failed} of {len(points)} runs fail, "
                         f"the first with {_words(keys, points[first])}: say what such a run counts as, or narrow the "
                         "ranges")
    found = np.array([stated.failed if values[i] is None else values[i] for i in range(len(points))], dtype=float)
    if out:
        write_text(out / CSV_NAME, _csv(keys, stated.metric, points, found), "name another --out")
    return Found(stated, points, found, indices(found, len(keys), stated.seed, stated.resamples), failed)


def _one(given: tuple[Evaluate, Shared], task: tuple[int, dict[str, Any]]) -> tuple[int, float | None]:
    (evaluate, shared), (i, values) = given, task
    return i, evaluate(shared, values)


def _evaluate(shared: Shared, values: dict[str, Any]) -> float | None:
    loaded, stated = shared
    kind = kind_of(loaded)
    if kind is None:
        return _of_scenario(loaded, stated, values)
    try:
        changed: Any = (varied if stated.case else with_values)(
            loaded.study, stated.set | values, "joint_sensitivity.ranges")
    except ValueError as trouble:
        raise InputError(loaded.path, "", str(trouble)) from None
    if stated.case:
        return _number(loaded.path, _one_run(loaded, kind, changed, stated.case), stated.metric)
    if kind.located:
        changed = kind.located(changed, loaded.path)
    rows = kind.run(changed, 1, lambda *_: None).rows
    chosen = [row for row in rows if all(row.get(key) == value for key, value in stated.row.items())]
    if len(chosen) != 1:
        raise InputError(loaded.path, "joint_sensitivity.row", f"fits {len(chosen)} rows of the study: name keys and "
                         "values that one row alone has")
    return _number(loaded.path, chosen[0], stated.metric)


def _one_run(loaded: Loaded, kind: StudyKind, changed: Any, case: dict[str, Any]) -> dict[str, Any]:
    if kind.run_one is None:
        raise InputError(loaded.path, "joint_sensitivity.case", "is for a paper's study that runs it again: name `row`")
    try:
        return kind.run_one(changed, case)
    except ValueError as trouble:
        raise InputError(loaded.path, "joint_sensitivity.case", str(trouble)) from None


def _of_scenario(loaded: Loaded, stated: Sensitivity, values: dict[str, Any]) -> float | None:
    scenario: Scenario = loaded.scenario
    if stated.controller not in scenario.controllers:
        raise InputError(loaded.path, "joint_sensitivity.controller", f"'{stated.controller}' is none: choose one of "
                         f"{', '.join(scenario.controllers)}")
    variant = Variant(title="sensitivity", set=stated.set | values)
    changed = changed_scenario(loaded.path, dict(loaded.data), variant, scenario).in_folder(scenario.folder)
    found = measure(simulate(changed, stated.controller), changed)
    row = found.row() | {"largest_position_error": found.largest_position_error}
    return None if found.failed is not None else _number(loaded.path, row, stated.metric)


def _number(path: Path, row: dict[str, Any], metric: str) -> float | None:
    if metric not in row:
        raise InputError(path, "joint_sensitivity.metric", f"'{metric}' is no number of a run: choose among "
                         f"{', '.join(key for key, value in row.items() if isinstance(value, float))}")
    value = row[metric]
    return None if value is None or not math.isfinite(value) else float(value)


def _journal(out: Path, loaded: Loaded, resume: bool) -> Journal:
    digest = hashlib.sha256(code_digest(*SEARCHING))
    digest.update(json.dumps(loaded.record.model_dump(), sort_keys=True, default=str).encode())
    for file in sorted(python_files(loaded.folder)):
        digest.update(contents(file))
    return Journal(out / JOURNAL_NAME, {"sensitivity of": loaded.record.name,
                                        "digest of values and code": digest.hexdigest()[:20]}, resume)


def _read(journal: Journal, count: int) -> dict[int, float | None]:
    found: dict[int, float | None] = {}
    for record in journal.records:
        point, value = record.get("point"), record.get("value", "")
        if not (isinstance(point, int) and 0 <= point < count and (value is None or isinstance(value, float))):
            raise InputError(journal.path, "", f"holds a record that is no point of this sweep: {REMEDY}")
        found[point] = value
    return found


def _csv(keys: Sequence[str], metric: str, points: Array, values: Array) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([*keys, metric])
    writer.writerows([*map(repr, row.tolist()), repr(float(value))] for row, value in zip(points, values, strict=True))
    return stream.getvalue()


def _words(keys: Sequence[str], point: Array) -> str:
    return ", ".join(f"{key} = {value:g}" for key, value in zip(keys, point, strict=True))


def sensitivity_table(found: Found) -> ResultTable:
    """A row per assumed value, that which decides most first."""
    stated, rows = found.stated, []
    if found.indices.first is not None and found.indices.total is not None:
        for (key, ends), first, total in zip(stated.ranges.items(), found.indices.first, found.indices.total,
                                             strict=True):
            rows.append((total.value, (key, *ends, _share(first), _share(total))))
    rows.sort(key=lambda row: -row[0])
    return ResultTable(
        f"Which assumption decides {stated.metric}", "sensitivity, not in the paper",
        ("assumed value", "from", "to", "alone (%)", "in all (%)"), tuple(row for _, row in rows),
        f"Sobol' indices from {len(found.values)} runs with all values drawn at once, in brackets their 95 % bootstrap "
        "intervals: the share of the variance that a value decides alone, and in all with what it does together "
        "with others.")


def _share(index: Index) -> Phrase:
    """An index in per cent, with its interval."""
    return Phrase("{} [{}, {}]", tuple(Quantity(part, si=0.01, decimals=0) for part in (index.value, index.low,
                                                                                       index.high)))


def sensitivity_lines(found: Found) -> Iterator[str]:
    """The range of the metric, and what decides it, a sentence each."""
    stated, count = found.stated, 2 * found.stated.samples  # A and B alone are drawn evenly
    values = found.values[:count]
    low, middle, high = np.quantile(values, [0.05, 0.5, 0.95])
    yield (f"{stated.metric}: {number(low)} to {number(high)} in nine of ten of {count} draws, {number(middle)} in the "
           f"middle, {number(values.min())} to {number(values.max())} in all.")
    if found.failed:
        yield f"{found.failed} of {len(found.values)} runs fail and count as {number(stated.failed or 0.0)}."
    if found.indices.total is None:
        yield "It does not vary: none of these values matters."
        return
    ranked = sorted(zip(stated.ranges, found.indices.total, strict=True), key=lambda pair: -pair[1].value)
    key, most = ranked[0]
    apart = len(ranked) == 1 or most.low > ranked[1][1].high
    rest = "" if apart else f"; its interval and that of {ranked[1][0]} overlap, so that neither is told to decide"
    yield f"{key} {'decides most of it' if apart else 'has the largest share'}: {number(100 * most.value)} %{rest}."

"""What `workbench tune` does: searches each controller's parameters within the same budget, and writes them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.outputs import check_rewritten
from workbench.files.text import read_text
from workbench.files.writing import write_text
from workbench.paper.loading import Loaded
from workbench.paper.scenario_tuning import tune_scenario
from workbench.simulate.process_pool import cores

BEGIN, END = "# --- found by workbench tune: begin ---", "# --- found by workbench tune: end ---"


def tune_run(loaded: Loaded, names: list[str], write: bool, workers: int | None,
             on_progress: Callable[[int, int, str], None], runs: int | None = None) -> Iterator[str]:
    """Lines for the reader; with `write` the found parameters replace those in the file.

    runs: of each controller, where not as many as the file states; what they find is not written.
    Raises InputError for a file without tuning and names without ranges.
    """
    path = loaded.path
    record: Any = loaded.record
    tune = loaded.kind.tune if loaded.kind else tune_scenario
    budget = getattr(record, "tuning", None)
    if tune is None or budget is None:
        raise InputError(path, "tuning", "is missing: state budget, objective and ranges in this table")
    chosen = list(dict.fromkeys(names)) or list(budget.ranges)
    for name in chosen:
        if name not in budget.ranges:
            raise InputError(path, f"tuning.ranges.{name}", "is missing: name a controller with ranges, or add them")
    if runs is not None:
        if write:
            raise InputError("", "--runs", "is for trying: what --write puts into the file was found with the budget "
                             "that stands in it; leave one of the two out")
        record = record.model_copy(update={"tuning": budget.model_copy(update={"runs": runs})})
    if write:
        check_rewritten(path)
        _before_found(path)
    try:
        found = tune(record, chosen, workers or cores(), on_progress)
    except InputError as trouble:
        raise trouble if str(trouble.where) else trouble.within(path) from None
    for name, (values, cost, stated) in found.items():
        words = ", ".join(f"{key} = {value:g}" for key, value in values.items())
        yield f"{name}: cost {stated:.4g} as stated, {cost:.4g} tuned: {words}"
    if write:
        tables = budget.found | {name: values for name, (values, _, _) in found.items()}
        _write(path, tables)
        yield f"written: {path}"


def _write(path: Path, tables: dict[str, dict[str, float]]) -> None:
    """Replace what stands between the markers at the end of the file; everything else stays as it is."""
    lines = [_before_found(path), "", BEGIN]
    for name, values in tables.items():
        lines += [f"[tuning.found.{name}]", *(f"{key} = {value!r}" for key, value in values.items()), ""]
    write_text(path.resolve(), "\n".join([*lines[:-1], END]) + "\n", "check its permissions")


def _before_found(path: Path) -> str:
    """What stands before the markers; InputError where something stands after them, which would be lost."""
    text = read_text(path, "TOML")
    if END in text and text.partition(END)[2].strip():
        raise InputError(path, END, "something stands after it: move it before the first marker")
    return text.partition(BEGIN)[0].rstrip()

"""What `workbench tune` does: searches each controller's parameters within the same budget, and writes them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from workbench.errors import InputError
from workbench.paper.loading import Loaded
from workbench.simulate.process_pool import cores

BEGIN, END = "# --- found by workbench tune: begin ---", "# --- found by workbench tune: end ---"


def tune_run(loaded: Loaded, names: list[str], write: bool, workers: int | None,
             on_progress: Callable[[int, int, str], None]) -> Iterator[str]:
    """Lines for the reader; with `write` the found parameters replace those in the file.

    Raises InputError for a study without tuning and names without ranges.
    """
    path, study = loaded.path, loaded.record
    tune, budget = loaded.kind.tune if loaded.kind else None, getattr(study, "tuning", None)
    if tune is None or budget is None:
        raise InputError(path, "tuning", "is missing: state budget, objective and ranges in this table")
    chosen = list(dict.fromkeys(names)) or list(budget.ranges)
    for name in chosen:
        if name not in budget.ranges:
            raise InputError(path, f"tuning.ranges.{name}", "is missing: name a controller with ranges, or add them")
    found = tune(study, chosen, workers or cores(), on_progress)
    for name, (values, cost, stated) in found.items():
        words = ", ".join(f"{key} = {value:g}" for key, value in values.items())
        yield f"{name}: cost {stated:.4g} as stated, {cost:.4g} tuned: {words}"
    if write:
        tables = budget.found | {name: values for name, (values, _, _) in found.items()}
        _write(path, tables)
        yield f"written: {path}"


def _write(path: Path, tables: dict[str, dict[str, float]]) -> None:
    """Replace what stands between the markers at the end of the file; everything else stays as it is."""
    text = path.read_text(encoding="utf-8")
    kept = text.partition(BEGIN)[0].rstrip()
    if END in text and text.partition(END)[2].strip():
        raise InputError(path, END, "something stands after it: move it before the first marker")
    lines = [kept, "", BEGIN]
    for name, values in tables.items():
        lines += [f"[tuning.found.{name}]", *(f"{key} = {value!r}" for key, value in values.items()), ""]
    path.write_text("\n".join([*lines[:-1], END]) + "\n", encoding="utf-8")

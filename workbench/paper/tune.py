"""What `workbench tune` does: searches each controller's parameters within the same budget, and writes them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.outputs import check_rewritten
from workbench.files.text import read_text
from workbench.files.writing import write_text
from workbench.model.tuning import BY_CONDITION, FOUND_KEYS, Range, SearchResult
from workbench.paper.loading import Loaded
from workbench.paper.parameter_search import NONE_YET, Name, Tuned, binding, words_of
from workbench.paper.scenario_tuning import tune_scenario
from workbench.paper.tuning_journal import kept_in, tuning_journal
from workbench.tasks.handing_out import places

BEGIN, END = "# --- found by workbench tune: begin ---", "# --- found by workbench tune: end ---"


def tune_run(loaded: Loaded, names: list[str], write: bool, workers: int | None,
             on_progress: Callable[[int, int, str], None], runs: int | None = None, out: Path | None = None,
             resume: bool = False) -> Iterator[str]:
    """Lines for the reader; with `write` the found parameters replace those in the file.

    runs: of each search, where not as many as the file states; what they find is not written. out: a folder that keeps
    finished restarts, with which `resume` goes on.
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
            raise InputError(path, f"tuning.ranges.{name}", "is missing: add ranges there, or name one of "
                             f"{', '.join(budget.ranges)}")
    if resume and out is None:
        raise InputError("", "--resume", "needs the folder of the restarts to go on with: name it with --out")
    if runs is not None:
        if write:
            raise InputError("", "--runs", "is for trying: what --write puts into the file was found with the budget "
                             "that stands in it; leave one of the two out")
        record = _with_tuning(record, budget, runs)
    if write:
        check_rewritten(path)
        _before_found(path)
    try:
        if out is None:
            found = tune(record, chosen, places(workers), on_progress, NONE_YET)
        else:
            with tuning_journal(out, loaded, record, resume) as journal:
                found = tune(record, chosen, places(workers), on_progress, kept_in(journal))
    except InputError as trouble:
        raise trouble if str(trouble.where) else trouble.within(path) from None
    for searched, tuned in found.items():
        ranges = budget.ranges[searched if isinstance(searched, str) else searched[1]]
        words = ", ".join(f"{key} = {value:g}{_binds(value, ranges[key])}" for key, value in tuned.values.items())
        yield f"{words_of(searched)}: cost {tuned.stated:.4g} as stated, {tuned.cost:.4g} tuned: {words}"
    yield from () if names else _left_as_stated(record, budget)
    if write:
        _write(path, budget, found)
        yield f"written: {path}"


def _left_as_stated(record: Any, budget: Any) -> Iterator[str]:
    """Who enters without ranges, and so as stated beside those that are tuned."""
    entered = getattr(record, "controllers", None)
    if isinstance(entered, Mapping) and (left := [name for name in entered if name not in budget.ranges]):
        yield f"not tuned, since tuning.ranges does not name them: {', '.join(left)}"


def _with_tuning(record: Any, budget: Any, runs: int) -> Any:
    return record.model_copy(update={"tuning": budget.model_copy(update={"runs": runs})})


def _binds(value: float, limits: Range) -> str:
    end = binding(value, limits)
    return f" (at the {end} end of its range)" if end else ""


def _write(path: Path, budget: Any, found: Mapping[Name, Tuned]) -> None:
    """Replace what stands between the markers at the end of the file; everything else stays as it is."""
    tables: dict[tuple[str, ...], dict[str, Any]] = {}
    for kind in FOUND_KEYS:
        for name, value in getattr(budget, kind, {}).items():
            if kind in BY_CONDITION:
                tables |= {(kind, name, controller): _plain(one) for controller, one in value.items()}
            else:
                tables[kind, name] = _plain(value)
    for searched, tuned in found.items():
        one = isinstance(searched, str)
        place = (searched,) if isinstance(searched, str) else searched
        tables["found" if one else BY_CONDITION[0], *place] = tuned.values
        tables["results" if one else BY_CONDITION[1], *place] = {
            "cost": tuned.cost, "stated_cost": tuned.stated, "evaluations": tuned.evaluations,
            "improvements": [[list(row) for row in restart] for restart in tuned.improvements]}
    lines = [_before_found(path), "", BEGIN]
    for part in sorted(tables, key=lambda part: FOUND_KEYS.index(part[0])):
        title = ".".join(json.dumps(name) if "." in name else name for name in part)
        lines += [f"[tuning.{title}]", *(f"{key} = {_toml(value)}" for key, value in tables[part].items()), ""]
    write_text(path.resolve(), "\n".join([*lines[:-1], END]) + "\n", "check its permissions")


def _plain(value: Any) -> dict[str, Any]:
    found: dict[str, Any] = value.model_dump() if isinstance(value, SearchResult) else dict(value)
    return found


def _toml(value: Any) -> str:
    """A number, or rows of them."""
    return f"[{', '.join(map(_toml, value))}]" if isinstance(value, list | tuple) else repr(value)


def _before_found(path: Path) -> str:
    """What stands before the markers; InputError where something stands after them, which would be lost."""
    text = read_text(path, "TOML")
    if END in text and text.partition(END)[2].strip():
        raise InputError(path, END, "something stands after it: move it before the first marker")
    return text.partition(BEGIN)[0].rstrip()

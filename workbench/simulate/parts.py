"""The runs of a Monte Carlo that its store does not have, handed out in parts that take about as long each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from workbench.simulate.row_store import Part, RowStore
from workbench.simulate.sweep_rows import BLOCK, Values
from workbench.tasks.handing_out import places, run_tasks

# A task takes about so long: less, and handing it out costs more than a share of it; more, and a kill costs more.
TASK_S = 0.5

Made = tuple[Part, float, list[Values]]
S = TypeVar("S")


def run_missing(run_part: Callable[[S, Part], Made], shared: S, names: Sequence[str], runs: int, store: RowStore,
                workers: int | None, on_progress: Callable[[int], None]) -> None:
    """Make the rows of the first runs of each controller that the store does not have, on the executor.

    run_part(shared, part): the part, how many seconds its rows took, the rows; on_progress(rows that are there).
    """
    gaps = {name: list(store.missing(name, runs)) for name in names}
    left = sum(part.runs for parts in gaps.values() for part in parts)
    done = runs * len(names) - left
    pace: dict[str, float] = {}  # seconds a run, as measured last

    def record(made: Made) -> None:
        nonlocal done
        part, seconds, rows = made
        store.add(part, rows)
        pace[part.controller] = seconds / part.runs
        done += part.runs
        on_progress(done)

    if left:
        at_once = min(places(workers), left)
        run_tasks(run_part, shared, _parts(gaps, pace, at_once), at_once, record)


def _parts(gaps: dict[str, list[Part]], pace: dict[str, float], workers: int) -> Iterator[Part]:
    """The gaps in parts of about TASK_S, the earliest runs first; none reaches over the end of a block."""
    ahead = {name: iter(parts) for name, parts in gaps.items()}
    now = {name: part for name, parts in ahead.items() if (part := next(parts, None)) is not None}
    while now:
        name = min(now, key=lambda name: now[name].first)
        gap = now[name]
        fair = -(-gap.runs // workers)  # so that no process is left with much at the end
        fitting = int(TASK_S / max(pace[name], 1e-9)) if name in pace else 1
        count = max(1, min(fitting, fair, gap.runs, BLOCK - gap.first % BLOCK))
        yield Part(name, gap.first, count)
        if count < gap.runs:
            now[name] = Part(name, gap.first + count, gap.runs - count)
        elif (following := next(ahead[name], None)) is not None:
            now[name] = following
        else:
            del now[name]

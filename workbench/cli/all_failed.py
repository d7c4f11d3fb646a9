"""How a command ends of whose runs not one came to its end: with a line that says so, and exit code 1."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import typer

from workbench.cli.console import err_console


def end_where_all_failed(runs: Iterable[Mapping[str, Any]]) -> None:
    """End with exit code 1 where there are runs and every one failed: a script must not take their table for a result.

    runs: rows with `controller` and `failed`, why it ended early; `failed_runs` of `runs` where a row stands for many.
    """
    count, first = 0, ""
    for row in runs:
        several = int(row.get("runs", 1))
        if row.get("failed") is None or row.get("failed_runs", several) < several:
            return
        count, first = count + several, first or f"{row.get('controller', 'run')}: {row['failed']}"
    if count:
        which = "the only run" if count == 1 else f"all {count} runs"
        err_console.print(f"workbench: {which} failed; first {first}; correct what that names, and run again",
                          style="red", soft_wrap=True, markup=False, highlight=False)
        raise typer.Exit(1)

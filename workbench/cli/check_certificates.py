"""`workbench check-certificates`: re-check what was proved."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.terminal import err_console, out_console
from workbench.errors import WorkbenchError
from workbench.proof.checker import check_folder

NAME = "check-certificates"


def command(folder: Annotated[Path, typer.Argument(help="Folder with certificates in it or below it")]) -> None:
    """Re-check certificates with checker.py alone; exit 0 when all hold, 1 when one does not."""
    results = check_folder(folder)
    if not results:
        raise WorkbenchError(f"{folder}: holds no certificate (*.json): run 'workbench prove' first")
    for path, verdict, reason in results:
        if reason is not None:
            err_console.print(f"[red]{path}: {verdict}: INVALID: {reason}[/red]", soft_wrap=True)
    wrong = sum(reason is not None for _, _, reason in results)
    out_console.print(f"{len(results) - wrong} of {len(results)} certificates hold")
    if wrong:
        raise typer.Exit(1)

"""`workbench examples`: the papers, lines and trains that come with the workbench, written into a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console


def command(directory: Annotated[Path, typer.Argument(metavar="FOLDER", help="A new or empty folder.")]) -> None:
    """Write the papers' folders, and the lines, trains and contests they share, into a folder of yours."""
    from workbench.paper.examples import write_examples

    for line in write_examples(directory):
        out_console.print(line, soft_wrap=True, highlight=False)

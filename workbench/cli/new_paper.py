"""`workbench new-paper`: a paper to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.terminal import out_console

NAME = "new-paper"


def command(name: Annotated[str, typer.Argument(help="The paper's name, as in doe2026")],
            directory: Annotated[Path, typer.Option(help="Where the file goes.")] = Path()) -> None:
    """Write a proof file to start from: it runs, and shows an example of each kind of claim."""
    from workbench.proof.new_paper import write_new_paper

    path = write_new_paper(name, directory)
    out_console.print(f"written: {path}", soft_wrap=True, markup=False, highlight=False)
    out_console.print(f"decide it: workbench prove {path}", soft_wrap=True, markup=False, highlight=False)

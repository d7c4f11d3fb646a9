"""`workbench list`: the papers found, and what each has."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.terminal import papers_table
from workbench.errors import InputError


def command(folder: Annotated[Path | None, typer.Argument(
        metavar="FOLDER", help="A folder of papers' folders; default: those found from here.")] = None) -> None:
    """The papers found, and what each of them has."""
    from workbench.files.folders import is_paper, papers_in, papers_near
    from workbench.files.text import nearly_called
    from workbench.paper.contents import contents_of

    if folder is not None and not folder.is_dir():
        raise InputError(folder, "", f"is no folder: name one with papers' folders in it{nearly_called(folder)}")
    found = papers_near(Path.cwd()) if folder is None else [folder] if is_paper(folder) else papers_in(folder)
    if not found:
        raise InputError(folder or Path.cwd(), "", "holds no paper: write examples with 'workbench examples FOLDER'")
    out_console.print(papers_table([contents_of(path) for path in found]))

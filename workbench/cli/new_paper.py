"""`workbench new-paper`: a paper to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.terminal import out_console

NAME = "new-paper"
VERBS = ("prove", "compare", "sweep --out FOLDER", "report --out FOLDER")


def command(name: Annotated[str, typer.Argument(help="The paper's name, as in doe2026")],
            directory: Annotated[Path, typer.Option(help="Where its folder goes.")] = Path(),
            plant: Annotated[bool, typer.Option("--plant", help="About a plant of your own, not a train.")] = False,
            ) -> None:
    """Write a paper's folder to start from: each kind of claim, a law, and a study that runs it beside PID and MPC."""
    from workbench.paper.new_paper import write_new_paper

    folder = write_new_paper(name, directory, "plant" if plant else "train")
    files = ", ".join(path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.*")))
    lines = f"written: {folder} ({files})", *(f"to go on: workbench {_with(verb, folder)}" for verb in VERBS)
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False)


def _with(verb: str, folder: Path) -> str:
    name, _, options = verb.partition(" ")
    return f"{name} {folder} {options}".strip()

"""`workbench new-paper`: a paper to start from."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.errors import InputError
from workbench.files.numbers import counted
from workbench.proof.verdict import in_number

VERBS = ("prove", "compare", "sweep --out FOLDER", "report --out FOLDER")


def command(name: Annotated[str, typer.Argument(metavar="NAME", help="The paper's name, as in doe2026.")],
            out: Annotated[Path, typer.Option(
                metavar="FOLDER", help="Where the paper's folder, which has its name, is made.")] = Path(),
            plant: Annotated[bool, typer.Option("--plant", help="About a plant of your own, not a train.")] = False,
            source: Annotated[Path | None, typer.Option(
                "--from", metavar="FILE", help="LaTeX or Markdown source of a paper: its numbered rows and letters as "
                "tables.")] = None,
            directory: Annotated[Path | None, typer.Option("--directory", hidden=True)] = None) -> None:
    """Write a paper's folder to start from: each kind of claim, a law, and a study that runs it beside PID and MPC."""
    from workbench.paper.new_paper import write_new_paper

    out = out if directory is None else directory  # as --out was called before
    if source is not None:
        if plant:
            raise InputError("", "--plant", "goes without --from, which writes claims alone: leave one of them out")
        _from_source(name, out, source)
        return
    folder = write_new_paper(name, out, "plant" if plant else "train")
    files = ", ".join(path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.*")))
    lines = f"written: {folder} ({files})", *(f"to go on: workbench {_with(verb, folder)}" for verb in VERBS)
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False)


def _from_source(name: str, out: Path, source: Path) -> None:
    from workbench.paper.source.folder import SYMBOLS, write_from_source

    found = write_from_source(name, out, source)
    counts = Counter(found.verdicts.values())
    lines = [f"written: {found.folder}, {counted(len(found.verdicts), 'row')}: "
             + ", ".join(f"{count} {in_number(verdict, count)}" for verdict, count in counts.items())]
    lines += [f"{name}:{row}  {verdict}" for row, verdict in found.verdicts.items() if row not in found.missing]
    lines += [f"{name}:{row}  not decided: {why}" for row, why in found.missing.items()]
    lines.append(f"to go on: fill in {found.folder / SYMBOLS}, then workbench prove {found.folder}")
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False)


def _with(verb: str, folder: Path) -> str:
    name, _, options = verb.partition(" ")
    return f"{name} {folder} {options}".strip()

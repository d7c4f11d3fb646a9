"""`workbench errata`: a paper's corrections as a document for its authors and editors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import err_console, out_console
from workbench.cli.options import Workers, path_of
from workbench.cli.terminal import progress


def command(paper: Annotated[str, typer.Argument(metavar="PAPER", help="A paper's folder, its name, or a proof file.")],
            out: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Where the files go; default: errata/PAPER in the current folder.")] = None,
            workers: Workers = None) -> None:
    """Write the corrections of a paper as errata.md, .tex, .html, .pdf and findings.json."""
    from workbench.files.outputs import check_outputs
    from workbench.proof.paper import collect_papers
    from workbench.proof.prove import prove
    from workbench.proof.selection import targets
    from workbench.report.errata.write import FILES, write_errata

    found = targets([path_of(paper)])
    check_outputs({}, folders={"--out": None if out is None else (out, ())})  # before anything is decided
    with progress() as show:
        proof = prove(found, workers, on_progress=lambda done, total: show("claims", done, total))
    for name, place in proof.papers.items():
        folder = Path("errata") / name if out is None else out if len(proof.papers) == 1 else out / name
        check_outputs({}, [file for target in found for file in target.inputs()], {"--out": (folder, FILES)})
        stated = next(p for p in collect_papers([place]) if p.name == name)
        own = [d for d in proof.decisions if d.claim.paper == name]
        written, missing = write_errata(own, stated.citation, folder, stated.at_hand)
        for path in written:
            out_console.print(str(path), soft_wrap=True, highlight=False)
        if missing:
            err_console.print(missing, soft_wrap=True, highlight=False)

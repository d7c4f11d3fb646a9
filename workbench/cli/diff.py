"""`workbench diff`: what changed between two documents of `workbench prove --json`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import JsonFile


def command(before: Annotated[Path, typer.Argument(metavar="A.json", help="The earlier document.")],
            after: Annotated[Path, typer.Argument(metavar="B.json", help="The later one.")],
            json: JsonFile = None) -> None:
    """What changed between two documents of `prove --json`; exit 0 when nothing did, 1 when something did."""
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.report.changes import changes, changes_document, read_claims

    old, new = read_claims(before), read_claims(after)
    check_outputs({"--json": json}, [before, after])
    found = changes(old, new)
    if json:
        write_json(json, changes_document(found))
    for change in found:
        out_console.print(change.sentence(), soft_wrap=True, highlight=False)
    out_console.print(f"{len(found)} of {len(old | new)} claims changed", highlight=False)
    if found:
        raise typer.Exit(1)

"""`workbench show`: one claim in full."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import JsonFile, path_of
from workbench.cli.terminal import claim_card, progress


def command(claim: Annotated[str, typer.Argument(metavar="ID", help="PAPER:EQUATION, as in doe2026:44, or "
                                                                    "FOLDER::EQUATION.")],
            json: JsonFile = None) -> None:
    """One claim with all that is known of it; patterns work too, as in 'doe2026:theorem*'."""
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.proof.document import claims_document, places
    from workbench.proof.prove import prove
    from workbench.proof.selection import targets
    from workbench.report.letters import with_letters

    paper, _, equation = claim.replace("::", ":").partition(":")
    found = targets([f"{path_of(paper)}::{equation or '*'}"])
    check_outputs({"--json": json}, [file for target in found for file in target.inputs()])
    with progress() as show:
        proof = prove(found, on_progress=lambda done, total: show("claims", done, total))
    document = with_letters(claims_document(proof.decisions, places(proof, None)), proof.decisions)
    for row in document["claims"]:
        if row["certificate"] and not Path(row["certificate"]).is_file():
            row["certificate"] = None
        out_console.print(claim_card(row))
    if json:
        write_json(json, document)

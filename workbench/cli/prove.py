"""`workbench prove`: decide every claim."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from workbench.cli.options import JsonFile
from workbench.cli.terminal import claim_card, claims_table, err_console, out_console, progress, verdict_lines

NAME = "prove"


def command(paths: Annotated[list[str] | None, typer.Argument(
                help="Papers' folders, a folder of them, proof files, and claims as in proofs/PAPER::24; "
                     "default: proofs")] = None,
            json: JsonFile = None,
            certificates: Annotated[Path | None, typer.Option(
                help="Where certificates go; default: 'certificates' in each paper's folder, or beside a proof "
                     "file.")] = None,
            jobs: Annotated[int | None, typer.Option(min=1, help="Processes; default: one a core.")] = None,
            cache: Annotated[bool, typer.Option(help="Take what has not changed from the cache.")] = True,
            limit: Annotated[float, typer.Option(
                min=0.1, help="Seconds of processor time for one claim; what takes longer stays undecided.")] = 60.0,
            ) -> None:
    """Decide every claim; exit 0 when each verdict is the recorded one, 1 when one differs, 2 on bad input.

    A claim that states nothing that could be decided is bad input; the others are decided all the same.
    """
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.proof.document import check_places, claims_document, places, write_certificates
    from workbench.proof.prove import prove as run_prove
    from workbench.proof.selection import targets

    found = targets(paths or ["proofs"])
    check_outputs({"--json": json}, [file for target in found for file in target.inputs()])
    check_places([file for target in found for file in target.files], certificates, {"--json": json})
    with progress() as show:
        proof = run_prove(found, jobs, cache, lambda done, total: show("claims", done, total), limit)
    single = any(target.pattern is not None for target in found)
    where = places(proof, certificates)
    write_certificates(proof.decisions, where, whole_papers=not single)
    document = claims_document(proof.decisions, where)
    if json:
        write_json(json, document)
    for table in map(claim_card, document["claims"]) if single else [claims_table(document)]:
        out_console.print(table)
    out_console.print(*verdict_lines(document), sep="\n")
    if not single:
        out_console.print(f"{len(proof.now)} decided now, {len(proof.decisions) - len(proof.now)} from the cache")
    differing = [d for d in proof.decisions if d.verdict != d.claim.recorded]
    for d in differing:
        err_console.print(f"[red]{d.claim.id}: decided {d.verdict}, but recorded {d.claim.recorded}[/red]")
    for trouble in proof.misstated.values():
        err_console.print(f"[red]misstated: {escape(trouble)}[/red]", soft_wrap=True)
    if proof.misstated:
        raise typer.Exit(2)
    if differing:
        raise typer.Exit(1)

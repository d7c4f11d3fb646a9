"""`workbench prove`: decide every claim."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from workbench.cli.console import err_console, out_console
from workbench.cli.options import LIMIT_S, Dask, JsonFile, Limit, Workers, on_cluster
from workbench.cli.second_opinion import Oracle, add_opinions, ask_oracle, print_opinions, require_oracle
from workbench.errors import InputError

if TYPE_CHECKING:
    from workbench.proof.document_format import ClaimsDocument
    from workbench.proof.oracle.opinion import Opinion
    from workbench.proof.prove import Proof



def command(paths: Annotated[list[str] | None, typer.Argument(
                metavar="PAPER", help="Papers' folders, a folder of them, proof files, and claims as in "
                "proofs/PAPER::24; default: proofs.")] = None,
            json: JsonFile = None,
            write: Annotated[bool, typer.Option(
                "--write", help="Also write the certificates into 'certificates' in each paper's folder, or beside a "
                                "proof file.")] = False,
            certificates: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Also write the certificates below this folder.")] = None,
            all_rows: Annotated[bool, typer.Option("--all", help="Also every row, a line each.")] = False,
            failed: Annotated[bool, typer.Option(
                "--failed", help="Every finding, slips and open readings too.")] = False,
            quiet: Annotated[bool, typer.Option(
                "--quiet", "-q", help="Say nothing but what differs from the record.")] = False,
            verbose: Annotated[bool, typer.Option(
                "--verbose", "-v", help="Each finding with its printed line and note.")] = False,
            workers: Workers = None, dask: Dask = None,
            jobs: Annotated[int | None, typer.Option("--jobs", min=1, hidden=True)] = None,
            cache: Annotated[bool, typer.Option(
                help="Take what has not changed from the cache, and do not search for what the certificates in the "
                     "paper's folder show, each checked again; --no-cache searches all anew.")] = True,
            limit: Limit = LIMIT_S,
            oracle: Annotated[Oracle | None, typer.Option(
                help="Also ask this solver about every verdict; none rests on its answer, and one that it contradicts "
                     "is told.")] = None,
            ) -> None:
    """Decide every claim; exit 0 when each verdict is the recorded one, 1 when one differs, 2 on bad input.

    First what does not stand, the fates of headline statements before all else, in sentences; counts last. Nothing is
    written unless --write, --certificates or --json asks for it. A claim that states nothing that could be decided is
    bad input; the others are decided all the same.
    """
    from workbench.proof.selection import targets

    if write and certificates is not None:
        raise InputError("", "--write", "and --certificates name two places: leave one out")
    found = targets(paths or ["proofs"])  # before what decides is imported: a mistake is said at once

    from workbench.cli.terminal import progress
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.proof.document import check_places, claims_document, places, write_certificates
    from workbench.proof.prove import prove as run_prove

    require_oracle(oracle)
    check_outputs({"--json": json}, [file for target in found for file in target.inputs()],
                  {"--certificates": (certificates, ()) if certificates else None})
    check_places([file for target in found for file in target.files], certificates, {"--json": json})
    with progress() as show, on_cluster(dask, workers):
        proof = run_prove(found, workers or jobs, cache, lambda done, total: show("claims", done, total), limit)
    if not proof.decisions and not proof.misstated:
        raise InputError(found[0].path, "claims", "states no claim: write one with paper.claim(...) in a file there")
    opinions = ask_oracle(oracle, proof.decisions)
    single = any(target.pattern is not None for target in found)
    where = places(proof, certificates)
    if write or certificates is not None:
        write_certificates(proof.decisions, where, whole_papers=not single)
    document = claims_document(proof.decisions, where)
    for row in document["claims"]:  # a certificate that nobody has written cannot be looked up
        if row["certificate"] and not Path(row["certificate"]).is_file():
            row["certificate"] = None
    add_opinions(document, oracle, opinions)
    if json:
        write_json(json, document)
    if not quiet:
        if single:
            _print_cards(proof, document)
        else:
            _print_all(proof, document, all_rows, failed, verbose)
        print_opinions(oracle, opinions, verbose)
    _end(proof, opinions)


def _print_cards(proof: Proof, document: ClaimsDocument) -> None:
    from workbench.cli.terminal import claim_card
    from workbench.cli.verdict_counts import verdict_lines

    for card in map(claim_card, document["claims"]):
        out_console.print(card)
    out_console.print(*verdict_lines(document), sep="\n")


def _print_all(proof: Proof, document: ClaimsDocument, all_rows: bool, failed: bool, verbose: bool) -> None:
    from workbench.cli.findings import print_findings, print_rows
    from workbench.cli.verdict_counts import verdict_lines

    if all_rows:
        print_rows(proof.decisions)
    print_findings(proof.decisions, failed, verbose)
    out_console.print(*verdict_lines(document), sep="\n")
    by_certificate = f" ({len(proof.certified)} by the certificates at hand, checked again)" if proof.certified else ""
    out_console.print(f"{len(proof.now)} decided now{by_certificate}, "
                      f"{len(proof.decisions) - len(proof.now)} from the cache")


def _end(proof: Proof, opinions: Mapping[str, Opinion]) -> None:
    """What differs from the record, what an oracle contradicts, and what could not be decided; the exit code says so
    too."""
    contradicted = {name: opinion.reason for name, opinion in opinions.items() if opinion.answer == "contradicted"}
    differing = [d for d in proof.decisions if d.verdict != d.claim.recorded]
    for d in differing:
        err_console.print(f"{d.claim.id}: decided {d.verdict}, but recorded {d.claim.recorded}", style="red",
                          soft_wrap=True)
    for name, why in contradicted.items():
        err_console.print(f"CONTRADICTED: {name}: {why}", style="red", soft_wrap=True, markup=False)
    for trouble in proof.misstated.values():
        err_console.print(f"misstated: {trouble}", style="red", soft_wrap=True)
    if proof.misstated:
        raise typer.Exit(2)
    if differing or contradicted:
        raise typer.Exit(1)

"""`workbench check-coq`: what Coq's kernel says of exported certificates."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import err_console, out_console
from workbench.cli.options import JsonFile, Workers, path_of
from workbench.cli.terminal import progress


def command(folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="What export-coq wrote.")],
            workers: Workers = None, json: JsonFile = None,
            record: Annotated[str | None, typer.Option(
                metavar="PAPER", help="Also note in this paper's folder which of its certificates the kernel has "
                                      "accepted (kernel.txt): their verdicts then say so.")] = None,
            only_new: Annotated[bool, typer.Option(
                "--only-new", help="With --record: leave out the goals that it has already, of the same version of "
                                   "Coq, and certificates of other papers.")] = False,
            seconds: Annotated[float, typer.Option(
                metavar="S", min=1, max=86_400, help="Seconds of processor time for one file.")] = 120) -> None:
    """Run coqc on every file that export-coq wrote; exit 0 when the kernel accepts all of them, 1 when it refuses one.

    What was not exported is listed with its reason and refuses nothing."""
    from workbench.errors import InputError
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.kernel.coqc import check_folder, cpu_seconds, version
    from workbench.kernel.record import accepted_goals, exported_texts, noted_before
    from workbench.proof.kernel_record import record_path, write_record

    paper = None if record is None else path_of(record)
    texts = {} if paper is None else exported_texts(paper)
    check_outputs({"--json": json, "--record": None if paper is None else record_path(paper)})
    if only_new and paper is None:
        raise InputError("", "--only-new", "goes with --record PAPER, whose record says what is not new")
    noted = set() if paper is None else noted_before(paper, texts)
    with progress() as show:
        rows = list(check_folder(folder, workers or os.cpu_count() or 1, seconds,
                                 lambda done, total: show("coqc", done, total), noted if only_new else (),
                                 texts if only_new else None))
    count = {name: sum(row.outcome == name for row in rows)
             for name in ("accepted", "noted", "refused", "not exported", "left out")}
    for row in rows:
        if row.reason:
            err_console.print(f"{row.claim}: {row.outcome}: {row.reason}", soft_wrap=True, markup=False)
    before = f", {count['noted']} noted before, {count['left out']} left out" if only_new else ""
    out_console.print(f"{count['accepted']} of {len(rows)} certificates accepted by Coq's kernel{before}, "
                      f"{count['refused']} refused, {count['not exported']} not exported; coqc took "
                      f"{cpu_seconds():.0f} s of processor time", soft_wrap=True)
    if json is not None:
        write_json(json, {"version": 1, "seconds": round(cpu_seconds(), 1), "certificates": [
            {"claim": row.claim, "outcome": row.outcome, "reason": row.reason, "goal_digest": row.goal_digest,
             "certificate": row.certificate} for row in rows]})
    if paper is not None:
        accepted = accepted_goals(rows, texts, noted)
        write_record(paper, version(), accepted)
        out_console.print(f"{len(accepted)} noted in {record_path(paper)}", soft_wrap=True, markup=False)
    if count["refused"]:
        raise typer.Exit(1)

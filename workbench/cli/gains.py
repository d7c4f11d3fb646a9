"""`workbench gains`: conditions of the stated gains, what is proved of them, gains that are proved to do better."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.options import Dask, JsonFile, PaperOrFile, Workers, load, on_cluster
from workbench.cli.study_tables import print_study
from workbench.cli.terminal import progress


def command(paper: PaperOrFile, json: JsonFile = None,
            certificates: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Also write the certificates below this folder.")] = None,
            write: Annotated[bool, typer.Option(
                "--write", help="Also write the certificates into the paper's own folder.")] = False,
            runs: Annotated[bool, typer.Option(help="Simulate the found gains beside the stated ones.")] = True,
            search: Annotated[bool, typer.Option(
                "--search", help="Search anew the gains whose runs cost least for what is proved of them, some minutes "
                "long; --write keeps them.")] = False,
            workers: Workers = None, dask: Dask = None) -> None:
    """Which conditions the stated gains meet, what can be proved of them, and gains that are proved to do better."""
    from workbench.files.folders import CERTIFICATES
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.gains.certificate import write_certificates
    from workbench.paper.gain_effects import effects, gains_of
    from workbench.paper.recorded_front import FRONT_FOLDER, searched_or_recorded, shown_fronts, write_front
    from workbench.proof.document import check_places
    from workbench.report.gains import gains_document, gains_result

    loaded = load(paper)
    check_outputs({"--json": json}, folders={"--certificates": (certificates, ()) if certificates else None})
    check_places([], certificates, {"--json": json})
    check_places([loaded.folder] if write else [], None, {"--json": json})
    with progress() as show, on_cluster(dask, workers):
        found = gains_of(loaded)
        front = searched_or_recorded(loaded, search, workers, lambda at, total, _: show("searches", at, total))
        if certificates:
            write_certificates(found.certificates, certificates / found.paper, certificates)
            write_certificates(front.certificates.values(), certificates / found.paper / FRONT_FOLDER, certificates)
        if write:
            write_certificates(found.certificates, loaded.folder / CERTIFICATES / "gains", loaded.folder)
            if search:
                write_front(loaded.folder, front)
        done = effects(loaded, found, workers, lambda at, total, _: show("runs", at, total)) if runs else ()
        fronts = shown_fronts(loaded, front, workers, lambda at, total, _: show("fronts", at, total)) if runs else ()
    if json:
        write_json(json, gains_document(found, done, fronts))
    print_study(gains_result(found, done, fronts))

"""`workbench schema`: what a file may hold, as JSON Schema."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.errors import InputError


def command(what: Annotated[str | None, typer.Argument(
                metavar="FORMAT", help="A format's name, or a paper's folder for the file of its own study; default: "
                                       "the names of all formats.")] = None,
            out: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Write FORMAT.json of every format, or of this one, into a folder.")] = None,
            ) -> None:
    """The JSON Schema of a file that the workbench reads or writes, made from the type that reads or writes it.

    Editors take it for TOML too: with `#:schema FOLDER/scenario.json` as its first line a file is checked and completed
    as it is typed (taplo, Even Better TOML).
    """
    from workbench.api.schemas import FORMATS, schema, schemas
    from workbench.files.json_output import write_json
    from workbench.files.outputs import STANDARD_OUTPUT
    from workbench.files.writing import make_folder

    if what is None and out is None:
        for one in FORMATS:
            out_console.print(f"{one.name:<22} {one.use:<6} {one.title}", soft_wrap=True, highlight=False)
        return
    found = {what: schema(what)} if what is not None else schemas()
    if out is None:
        write_json(STANDARD_OUTPUT, found[str(what)])
        return
    make_folder(out, out, "name another folder")
    for name, document in found.items():
        path = out / f"{Path(name).name.removesuffix('.toml')}.json"
        if path.is_dir():
            raise InputError(path, "--out", "is a folder: name another place")
        write_json(path, document)
        out_console.print(str(path), soft_wrap=True, highlight=False)

"""`workbench export-coq`: a paper's certificates as files for Coq."""

from __future__ import annotations

from collections import Counter
from os.path import realpath
from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import path_of


def command(paper: Annotated[str, typer.Argument(metavar="PAPER", help="A paper's folder, its name, or a folder of "
                                                                       "certificates.")],
            out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where the Coq files go.")]) -> None:
    """Write one Coq file a certificate, statement and proof, which check-coq runs.

    The statement is made from the goal, the proof from the certificate's steps; the library that they share is written
    too, and what has no Coq text is said, and why.
    """
    from workbench.errors import InputError, WorkbenchError
    from workbench.files.folders import require_few
    from workbench.files.outputs import check_outputs
    from workbench.files.writing import write_text
    from workbench.kernel.export import INDEX, export_folder, files_of

    place = path_of(paper)
    folder = place / "certificates" if (place / "certificates").is_dir() else place
    if Path(realpath(out)).is_relative_to(realpath(folder)) and folder != place:
        raise InputError(out, "--out", "holds certificates, for whose checker every JSON file there is one: name "
                         "another folder")
    require_few(folder)
    check_outputs({}, folders={"--out": (out, ())})  # before seconds are spent on proofs
    exported = list(export_folder(folder))
    if not exported:
        raise WorkbenchError(f"{folder}: holds no certificate (*.json): run 'workbench prove --write' first")
    files = files_of(exported)
    check_outputs({}, folders={"--out": (out, list(files))})
    for name, text in files.items():
        if name != INDEX:
            write_text(out / name, text)
    write_text(out / INDEX, files[INDEX])
    reasons = Counter(one.reason for one in exported if one.text is None)
    count = len(exported) - reasons.total()
    out_console.print(f"{count} of {len(exported)} certificates exported to {out}", soft_wrap=True)
    for reason, count in reasons.most_common():
        out_console.print(f"  {count} not exported: {reason}", soft_wrap=True, markup=False)

"""`workbench check-certificates`: re-check what was proved, and that it is what the paper's claims state."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from workbench.cli.console import err_console, out_console
from workbench.cli.options import Workers
from workbench.cli.terminal import progress
from workbench.errors import InputError, in_one_line

if TYPE_CHECKING:
    from workbench.proof.checker import Row


def command(folder: Annotated[Path, typer.Argument(
                metavar="FOLDER", help="A folder with certificates in it or below it, or one certificate's file.")],
            paper: Annotated[list[Path] | None, typer.Option(
                metavar="PAPER", help="A paper's folder or proof file whose claims the certificates must be of; may be "
                "repeated. Not needed for certificates in the paper's own folder.")] = None,
            claim_digest: Annotated[str | None, typer.Option(
                metavar="DIGEST", help="For one file: the goal digest of the claim that it must be of.")] = None,
            workers: Workers = None) -> None:
    """Re-check certificates with checker.py; exit 0 when all hold, 1 when one does not.

    They are held against their manifest and, where it is at hand, the paper whose claims they are of, whose own Python
    is run for that.
    """
    from workbench.files.text import nearly_called
    from workbench.proof.checker import check_file

    if folder.is_file():
        rows, bound = [check_file(folder, None, claim_digest)], "the digest given" if claim_digest else None
    elif claim_digest is not None:
        raise InputError("--claim-digest", "", f"is for one certificate's file, and {folder} is none: leave it out")
    else:
        rows, bound = _folder(folder, paper or [], workers)
    if not rows:
        there = "holds no certificate (*.json): run 'workbench prove --write' first"
        gone = f"no such folder or file: check the path{nearly_called(folder)}"
        raise InputError(folder, "", there if folder.exists() else gone)
    wrong = {path for path, _, reason in rows if reason is not None}
    for path, verdict, reason in rows:
        if reason is not None:
            err_console.print(f"{path}: {in_one_line(verdict)}: INVALID: {in_one_line(reason)}", style="red",
                              soft_wrap=True)
    files = {path for path, _, _ in rows}
    out_console.print(f"{len(files) - len(wrong)} of {len(files)} certificates hold; held against "
                      f"{bound or 'no claim'}", soft_wrap=True)
    if wrong:
        raise typer.Exit(1)


def _folder(folder: Path, named: list[Path], workers: int | None) -> tuple[list[Row], str]:
    """The rows of a folder, and what its certificates were held against."""
    from workbench.files.folders import require_few
    from workbench.proof.at_hand import papers_at_hand
    from workbench.proof.checking import check_all
    from workbench.tasks.handing_out import places

    require_few(folder)
    with progress() as show:
        rows, bound = check_all(folder, papers_at_hand(folder, named), places(workers),
                                lambda done, total: show("certificates", done, total))
    others = len({path for path, _, _ in rows}) - bound
    whole = f"the goals of their papers' claims: {bound}" if bound else ""
    alone = f"their manifest alone, for no claims are at hand: {others}" if others > 0 else ""
    return rows, ", ".join(part for part in (whole, alone) if part)

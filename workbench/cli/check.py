"""`workbench check`: decide a pasted line of LaTeX."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import LIMIT_S, JsonFile, Limit, path_of
from workbench.cli.terminal import answer_card

CONTEXT = {"ignore_unknown_options": True}  # a line may begin with a minus


def command(line: Annotated[str, typer.Argument(metavar="LATEX", help="The line, as in '\\dot V \\le 0'.")],
            symbols: Annotated[Path, typer.Option(
                metavar="FILE", help="TOML file with symbols, definitions, assumptions and flow, or the folder or name "
                "of a paper, whose Python is run.")],
            json: JsonFile = None, limit: Limit = LIMIT_S) -> None:
    """Decide a line of LaTeX; exit 0 when it is proved, 1 when it is not, 2 on bad input."""
    from workbench.errors import ClaimError, InputError
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.proof.latex.error import LatexError
    from workbench.proof.latex.question import answer
    from workbench.proof.latex.symbols import load_symbols

    symbols = path_of(str(symbols))
    check_outputs({"--json": json}, [symbols])
    letters = load_symbols(symbols)
    try:
        found = answer(line, letters, limit)
    except (ClaimError, LatexError) as trouble:  # of the line, or of the letters that it was read with
        raise InputError("", "", f"{trouble} (the line was read with the letters of {symbols})") from None
    if json:
        write_json(json, found.document())
    out_console.print(answer_card(found.document()))
    if found.decision.verdict != "proved":
        raise typer.Exit(1)

"""The command line: parses, calls, prints."""

from __future__ import annotations

import signal
import sys
import threading

import typer

from workbench.cli import (
    check,
    check_certificates,
    check_coq,
    compare,
    diff,
    errata,
    examples,
    export_coq,
    gains,
    listing,
    new_paper,
    prove,
    reference,
    report,
    schema,
    show,
    sweep,
    tune,
)
from workbench.cli.options import Version
from workbench.cli.terminal import err_console
from workbench.errors import WorkbenchError

app = typer.Typer(no_args_is_help=True, add_completion=True, pretty_exceptions_enable=False,
                  help="A control paper as one executable object: proof, simulation, comparison.")

INTERRUPTED = 130  # with which typer ends after Ctrl-C

for verb in (prove, show, diff, check, new_paper, check_certificates, compare, sweep, tune, report, reference, gains,
             listing, examples, schema, errata, export_coq, check_coq):
    app.command(verb.NAME, context_settings=getattr(verb, "CONTEXT", None))(verb.command)


@app.callback()
def options(version: Version = False) -> None:
    """What every verb understands."""


def main() -> None:
    """Run the command line; an error that is the caller's to mend is one line and exit code 2."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.default_int_handler)  # what is finished is kept, as after Ctrl-C
    try:
        app()
    except WorkbenchError as trouble:
        err_console.print(f"workbench: {trouble}", style="red", soft_wrap=True, highlight=False)
        sys.exit(2)
    except OSError as trouble:  # of what no room expects to fail, such as a terminal that is gone
        where = f"{trouble.filename}: " if trouble.filename else ""
        err_console.print(f"workbench: {where}{trouble.strerror or trouble}: check path, permissions and free space",
                          style="red", soft_wrap=True, highlight=False)
        sys.exit(2)
    except SystemExit as end:
        if end.code == INTERRUPTED:
            err_console.print("workbench: interrupted; what was finished is kept", style="yellow")
        raise

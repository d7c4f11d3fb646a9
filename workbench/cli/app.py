"""The command line: parses, calls, prints."""

from __future__ import annotations

import atexit
import errno
import inspect
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from difflib import get_close_matches
from functools import cache, wraps
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import typer
from typer.core import TyperGroup
from typer.exceptions import TyperException
from typer.main import get_command

from workbench.cli.console import err_console, out_console
from workbench.cli.help_words import Verb, in_own_words
from workbench.cli.option_mistakes import in_plain_words
from workbench.cli.options import Version
from workbench.cli.unused import import_unused_later
from workbench.errors import InputError, WorkbenchError, of_an_extra, printable
from workbench.files.memory_limit import MORE, MORE_FILES, is_of_memory, require_memory
from workbench.files.paper_code import mistakes_told
from workbench.files.streams import drop_output, output_kept
from workbench.tasks.collection import collect_later, end_without_search
from workbench.tasks.room_for_calls import with_room_for_calls
from workbench.tasks.threads import use_one_thread

INTERRUPTED = 130  # with which typer ends after Ctrl-C
NOBODY_READS = 141  # of a shell for a command that a closed pipe has ended
THREADS_S = 3.0  # for which threads that were left are waited for
LINKS = "Symlink loop"  # what pathlib says of them, before Python 3.13

# The verbs in the order in which the help lists them; each is a module of this room, by its own name or another.
VERBS = ("prove", "show", "diff", "check", "new-paper", "check-certificates", "compare", "sweep", "tune", "report",
         "reference", "gains", "list", "examples", "schema", "errata", "export-coq", "check-coq", "export-fmu")
MODULES = {"list": "listing"}


class Verbs(TyperGroup):
    """All verbs, each imported when it is asked for: a command waits for the options of no other."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Their names, as the help lists them."""
        del ctx
        return list(VERBS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The verb of that name; None where there is none."""
        del ctx
        return _verb(cmd_name) if cmd_name in VERBS else None

    def get_params(self, ctx: Any) -> list[Any]:
        """The options that come before a verb."""
        return in_own_words(super().get_params(ctx))


@cache
def _verb(name: str) -> Any:
    module = import_module(f"workbench.cli.{MODULES.get(name, name.replace('-', '_'))}")
    alone = typer.Typer(add_completion=False)
    paragraphs = (inspect.getdoc(module.command) or "").split("\n\n")
    said = "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)  # lines end where the terminal does
    settings = getattr(module, "CONTEXT", None)
    alone.command(name, cls=Verb, help=said, context_settings=settings)(_answering(module.command))
    return get_command(alone)


class _NobodyReadsError(Exception):
    """What a command says goes into a pipe whose reader has ended."""


def _answering(command: Callable[..., Any]) -> Callable[..., Any]:
    """The command, with standard output kept for its answer."""
    @wraps(command)
    def answering(*arguments: Any, **named: Any) -> Any:
        with output_kept():
            try:
                return command(*arguments, **named)
            except BrokenPipeError as trouble:
                raise _NobodyReadsError from trouble  # typer would end with 1, as if a verdict differed

    return answering


app = typer.Typer(cls=Verbs, no_args_is_help=True, add_completion=True, pretty_exceptions_enable=False,
                  help="A control paper as one executable object: proof, simulation, comparison. Begin with 'workbench "
                       "list' and one of the papers that it names, as in 'workbench prove PAPER'; without a clone "
                       "write them with 'workbench examples FOLDER' first.")


@app.callback()
def options(version: Version = False) -> None:
    """What every verb understands."""


def main() -> None:
    """Run the command line; an error that is the caller's to mend is one line and exit code 2."""
    use_one_thread()
    collect_later()
    end_without_search()
    import_unused_later()
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.default_int_handler)  # what is finished is kept, as after Ctrl-C
    threads = set(threading.enumerate())
    out_console.stderr = False  # whatever an earlier call in this process was asked for
    try:
        _require_folder()
        require_memory()
        with mistakes_told():
            code = with_room_for_calls(_command(), sys.argv[1:] or ["--help"], prog_name="workbench",
                                       standalone_mode=False) or 0
        sys.stdout.flush()
    except (_NobodyReadsError, BrokenPipeError):
        code = NOBODY_READS
        drop_output()
    except SystemExit as end:
        if not isinstance(end.__context__, BrokenPipeError):
            raise
        code = NOBODY_READS  # typer ends so where nobody reads its help
        drop_output()
    except WorkbenchError as trouble:
        code = _refused(str(trouble))
    except (ImportError, MemoryError) as trouble:
        left_out = of_an_extra(trouble) if isinstance(trouble, ImportError) else None
        if left_out is None and not is_of_memory(trouble):
            raise
        code = _refused(str(left_out) if left_out else f"no memory is left: ask for less, or {MORE}")
    except TyperException as trouble:  # of options and arguments
        context = getattr(trouble, "ctx", None)
        command = context.command_path if context else "workbench"
        message = in_plain_words(trouble.format_message().removesuffix("."))
        problem = f"{message}: {_verb_meant()}see '{command} --help'"
        code = _refused(str(InputError(command.removeprefix("workbench").strip(), "", problem)))
    except OSError as trouble:  # of what no room expects to fail, such as a terminal that is gone
        drop_output()
        where = str(trouble.filename or "")
        remedy = MORE_FILES if trouble.errno == errno.EMFILE else "check path, permissions and free space"
        code = _refused(str(InputError(where, "", f"{trouble.strerror or trouble}: {remedy}")))
    except RuntimeError as trouble:
        if not str(trouble).startswith(LINKS):
            raise
        code = _refused(f"{trouble}: the links lead around in a circle: name a file or folder that is there")
    if code == INTERRUPTED:
        err_console.print("workbench: interrupted; what was finished is kept", style="yellow")
    _end(code, threads)


def _end(code: int, before: set[threading.Thread]) -> NoReturn:
    """End this process with that exit code, whatever a paper's code has left running in it: Python would wait for ever
    for a thread that does not end."""
    until = time.monotonic() + THREADS_S
    for thread in threading.enumerate():
        if thread not in before and not thread.daemon:
            thread.join(max(0.0, until - time.monotonic()))
            if thread.is_alive():
                drop_output()
                atexit._run_exitfuncs()
                os._exit(code)
    sys.exit(code)


def _require_folder() -> None:
    try:
        Path.cwd()
    except OSError as trouble:
        raise InputError("", "", f"the folder you are in cannot be entered ({trouble.strerror}): change to another one"
                         ) from None


@cache
def _command() -> Any:
    """All verbs with their options, worked out once."""
    return get_command(app)


def _verb_meant() -> str:
    """The verb that was nearly typed, as a question; empty where the verb is one, or like none."""
    asked = next((word for word in sys.argv[1:] if not word.startswith("-")), "")
    close = get_close_matches(asked, VERBS, n=1) if asked not in VERBS else []
    return f"did you mean '{close[0]}'? Else " if close else ""


def _refused(line: str) -> int:
    with suppress(OSError):  # nobody can be told where this stream is full or gone, too
        err_console.print(f"workbench: {printable(line)}", style="red", soft_wrap=True)
    return 2

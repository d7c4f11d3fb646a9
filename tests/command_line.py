"""The command line, called in the tests' own process: the same main, arguments, streams and exit codes, but no start of
Python and its imports, which take seconds. Some tests start a process of its own all the same (`run_apart`).

To a call it is a machine of one core: what a verb would share out among processes, which cost seconds each to start,
is done here, unless the call says how many `--workers`."""

import contextlib
import io
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from scenarios import ROOT


@dataclass(frozen=True)
class Ended:
    """What a call left: as of a process that has ended."""

    returncode: int
    stdout: str
    stderr: str


def run(*arguments: object, folder: Path = ROOT) -> Ended:
    from workbench.cli.app import main

    out, err = io.StringIO(), io.StringIO()
    with (patch.object(sys, "argv", ["workbench", *map(str, arguments)]), contextlib.chdir(folder),
          patch.object(os, "sched_getaffinity", lambda _: {0}, create=True),
          contextlib.redirect_stdout(out), contextlib.redirect_stderr(err)):
        try:
            main()
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
    return Ended(code, out.getvalue(), err.getvalue())


def said(*arguments: object) -> str:
    """What `workbench reference` prints; its error is raised as the command line's own main would catch it."""
    from typer.testing import CliRunner

    from workbench.cli.app import app

    result = CliRunner().invoke(app, ["reference", *map(str, arguments)])
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert result.exit_code == 0, result.output
    return result.output


def run_apart(*arguments: object, folder: Path = ROOT) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-m", "workbench", *map(str, arguments)], cwd=folder,
                          capture_output=True, text=True, check=False, timeout=300)


def one_line(result: "Ended | subprocess.CompletedProcess[str]") -> str:
    """The single line of standard error of a call that ended with 2."""
    assert result.returncode == 2, result.stderr
    assert "Traceback" not in result.stderr
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    return lines[0]

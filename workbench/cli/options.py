"""Options and arguments that verbs share, and what they name."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from workbench import __version__
from workbench.cli.console import out_console
from workbench.errors import InputError
from workbench.files.folders import paper_named, papers_near
from workbench.files.outputs import STANDARD_OUTPUT

if TYPE_CHECKING:
    from workbench.paper.loading import Loaded


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"workbench {__version__}")
        raise typer.Exit


def _json_file(path: Path | None) -> Path | None:
    """The file, after standard output has been kept free for it where it is `-`."""
    if path == STANDARD_OUTPUT:
        out_console.stderr = True
    return path


JsonFile = Annotated[Path | None, typer.Option(
    "--json", metavar="FILE", callback=_json_file, allow_dash=True,
    help="Also write the result as JSON; - is standard output, and all else goes to standard error.")]


def _workers(count: int | None) -> int | None:
    """The number, where this machine could start so many; InputError otherwise."""
    most = max(64, 4 * (os.cpu_count() or 1))
    if count is not None and count > most:
        raise InputError("", "--workers", f"{count} processes are more than {most}, the most that are started here: "
                         "ask for fewer")
    return count


Workers = Annotated[int | None, typer.Option(
    metavar="N", min=1, callback=_workers, help="Processes; default: one a core.")]
LIMIT_S = 60.0
Limit = Annotated[float, typer.Option(
    metavar="S", min=0.1, help="Seconds of processor time for one claim; what takes longer stays undecided.")]
Dask = Annotated[str | None, typer.Option(
    "--dask", metavar="ADDRESS", help="Run on the Dask cluster whose scheduler is there; 'local' starts one here.")]
PaperOrFile = Annotated[str, typer.Argument(
    metavar="PAPER", help="A paper's folder, its name, or the TOML file of a scenario, study or contest.")]
Version = Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Say the version.")]


@contextmanager
def on_cluster(address: str | None, workers: int | None) -> Iterator[None]:
    """Run what is run in this block on a Dask cluster, where one is named."""
    if address is None:
        yield
        return
    from workbench.tasks.cluster import LOCAL, cluster
    from workbench.tasks.executor import on

    if workers is not None and address != LOCAL:
        raise InputError("", "--workers", "is of processes of this machine, but --dask names a cluster, which has its "
                         "own: leave it out")
    with cluster(address, workers) as found, on(found):
        yield


def path_of(argument: str) -> Path:
    """The file or folder that an argument names, or the folder of the paper whose name it is."""
    if not argument:
        raise InputError("", "PAPER", "is an empty name: name a paper's folder, or '.' for the folder you are in")
    path = Path(argument)
    try:
        if path.exists() or path.suffix or "/" in argument:
            return path
    except (OSError, ValueError) as trouble:
        raise InputError("", "", f"{argument[:60]!r} is no path ({trouble}): correct the name") from None
    found = paper_named(argument, Path.cwd())
    if found is None:
        names = [folder.name for folder in papers_near(Path.cwd())]
        near = get_close_matches(argument, names, n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"name one of {', '.join(names)}" if names else (
            "name its folder, or write examples with 'workbench examples FOLDER'")
        raise InputError("", argument, f"is no file, folder or paper here: {hint}")
    return found


def load(argument: str) -> Loaded:
    """The scenario, study, contest or paper that an argument names, read once."""
    from workbench.cli.loading import load as read

    return read(path_of(argument))

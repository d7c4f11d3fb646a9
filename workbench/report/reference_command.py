"""What `workbench reference` is asked: its arguments, what is wrong with them, and the files it reads.

What solves and writes is imported when all of it is in order, so that a mistake is said at once.
"""

from __future__ import annotations

from collections.abc import Iterator

from workbench.errors import InputError
from workbench.files.outputs import check_outputs, is_stream
from workbench.optimal.inputs.files import load_cars, load_line, load_vehicle
from workbench.report.reference_request import Request, certified_file, couplers_file, of_cars_file, table_file

FIGURES = (".svg", ".png", ".pdf")


def reference_run(asked: Request) -> Iterator[str]:
    """Lines for the reader as they come; raises InputError and InfeasibleRunError before anything is written."""
    _check_outputs(asked)
    if not 0 < asked.every_s < float("inf"):
        raise InputError("", "--every", f"{asked.every_s:g} s is no step of a table: give a positive number of seconds")
    line, notes = load_line(asked.track)
    vehicle, more = load_vehicle(asked.train)
    train = load_cars(asked.train)
    etcs = None
    if asked.etcs:
        from workbench.optimal.inputs.etcs_file import load_supervision  # noqa: PLC0415 - as said above

        etcs = load_supervision(asked.train, asked.track)
    if asked.figure and asked.figure.suffix.lower() not in FIGURES:
        raise InputError(asked.figure, "figure", f"end the name in one of {', '.join(FIGURES)}")
    for name, value in (("--dwell", asked.dwell_s), ("--from-speed", asked.start_mps), ("--to-speed", asked.end_mps)):
        if not 0 <= value < 1e5:
            raise InputError("", name, f"{value:g} is not usable: give 0 or more")
    from workbench.optimal.envelope import InfeasibleRunError  # noqa: PLC0415 - as said above
    from workbench.report.reference_answer import answered  # noqa: PLC0415 - as said above

    try:
        yield from answered(asked, line, vehicle, train, (*notes, *more), etcs)
    except InfeasibleRunError as trouble:
        raise InfeasibleRunError(f"{asked.track.name}, {asked.train.name}: {trouble}", trouble.least_time_s) from None


def _check_outputs(asked: Request) -> None:
    """Raises InputError where an output would be written over an input or over another output."""
    check_outputs({"--json": asked.json, "--figure": asked.figure})  # of which other names are made
    if asked.json and is_stream(asked.json) and not asked.csv:
        raise InputError("", "--csv", f"is missing: {asked.json} has no folder for a table beside it, name a file")
    inputs = [path for path in (asked.track, asked.train, asked.timetable) if path]
    table, figure = table_file(asked), asked.figure
    check_outputs({"--json": asked.json, "--csv": table, "cars of --csv": table and of_cars_file(table),
                   "certified run of --csv": certified_file(table),
                   "--figure": figure, "couplers of --figure": figure and couplers_file(figure),
                   "--certificate": asked.certificate}, inputs)

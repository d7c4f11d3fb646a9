"""Whether a bound's certificate is of a line, a train and times that are given."""

from __future__ import annotations

from workbench.errors import InputError
from workbench.files.units import KWH_J
from workbench.optimal.bound_document import digests, read_bound
from workbench.optimal.course import Course
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle
from workbench.report.reference_request import Request


def checked_bound(asked: Request, vehicle: Vehicle, run: Course, timetable: Timetable) -> str:
    """What a bound's certificate proves of this line, train and times; InputError where it proves nothing of them."""
    path = asked.check
    assert path is not None
    stated = digests(vehicle, timetable.on(run), timetable, asked.start_mps, asked.end_mps)
    proven = read_bound(path)
    for name, digest in stated.items():
        if proven.digests[name] != digest:
            raise InputError(path, f"digests.{name}", f"is not that of the {name} given: the bound is of another one")
    return f"{path}: proves {proven.bound_j / KWH_J:.6g} kWh for this line, train and times"

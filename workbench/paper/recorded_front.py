"""A front of gains as a paper's folder keeps it: written, read, and shown with every number computed anew.

front.toml holds gains alone; certificates/front holds what is proved of them. What is shown is run again, and every
certificate is held against the loop of its gains and checked again.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES
from workbench.files.text import read_text
from workbench.files.toml import load_record
from workbench.files.writing import write_text
from workbench.gains.certificate import write_certificates
from workbench.gains.dissipation import frozen_gain, proved_bound
from workbench.gains.held_loop import polytope
from workbench.gains.stated import Stated
from workbench.paper.gain_front import (
    STATED,
    Found,
    FrontRecord,
    RecordedFront,
    claim_of,
    exact,
    front_search_of,
    search_fronts,
)
from workbench.paper.gain_search import FrontSearch, Numbers
from workbench.paper.loading import Loaded
from workbench.paper.study import Progress
from workbench.tasks.handing_out import places, results_of

FRONT_FILE, FRONT_FOLDER = "front.toml", "front"


@dataclass(frozen=True)
class FrontPoint:
    """Gains, what their run gives, and what is proved of them.

    numbers: `cost` among them; bound: None where no certificate is found; frozen: below which no bound can be, by the
    vertices' frequency responses; None where one of them is not stable.
    """

    setting: str
    name: str
    gains: dict[str, float]
    numbers: Numbers
    bound: float | None
    frozen: float | None
    certificate: str

    @property
    def cost(self) -> float | None:
        """What the run costs; None where it fails."""
        return self.numbers.get("cost")


@dataclass(frozen=True)
class GainFront:
    """The points of a setting, the stated gains first, then what was found, by cost; evaluations: of the search."""

    title: str
    points: tuple[FrontPoint, ...]
    bounded: str
    unit: str
    evaluations: int


NO_FRONT = RecordedFront(FrontRecord(evaluations=0), {})


def searched_or_recorded(loaded: Loaded, anew: bool, workers: int | None = None,
                     on_progress: Progress = lambda done, total, what: None) -> RecordedFront:
    """What a search finds now, or what the folder keeps; InputError where a search is asked for and none is stated."""
    asked = front_search_of(loaded)
    if anew and asked is None:
        raise InputError(loaded.folder / "gains.py", "--search", "its GainSearch says nothing of a front: state one, "
                         "or leave --search out")
    if asked is None:
        return NO_FRONT
    return search_fronts(loaded, asked, workers, on_progress) if anew else recorded_fronts(loaded, asked)


def write_front(folder: Path, front: RecordedFront) -> None:
    """front.toml and certificates/front of a paper's folder; InputError where they cannot be written."""
    record = front.record
    lines = ["# Found by 'workbench gains --search --write'; other numbers are computed when they are shown.",
             f"version = {record.version}", f"evaluations = {record.evaluations}"]
    for setting, points in record.found.items():
        for point in points:
            gains = ", ".join(f"{name} = {value!r}" for name, value in point.gains.items())
            lines += ["", f"[[found.{setting}]]", f'name = "{point.name}"', f"gains = {{ {gains} }}"]
    write_text(folder / FRONT_FILE, "\n".join(lines) + "\n", "check its permissions")
    write_certificates(front.certificates.values(), folder / CERTIFICATES / FRONT_FOLDER, folder)


def recorded_fronts(loaded: Loaded, asked: FrontSearch) -> RecordedFront:
    """What stands in the folder's front.toml, and its certificates; nothing where it was never searched."""
    path = loaded.folder / FRONT_FILE
    if not path.is_file():
        return NO_FRONT
    record = load_record(path, FrontRecord)
    known = {setting.id for setting in asked.settings}
    for setting, points in record.found.items():
        if setting not in known:
            raise InputError(path, f"found.{setting}", f"is no setting: it is one of {', '.join(sorted(known))}")
        for point in points:
            if point.gains.keys() != asked.ranges.keys():
                raise InputError(path, f"found.{setting}.{point.name}", "its gains are not those that are searched: "
                                 "run 'workbench gains --search --write'")
    certificates = {}
    for one in asked.settings:
        for name in (STATED, *(p.name for p in record.found.get(one.id, ()))):
            claim = claim_of(asked, one, name)
            file = loaded.folder / CERTIFICATES / FRONT_FOLDER / f"{claim.partition(':')[2]}.json"
            if file.is_file():
                certificates[claim] = _read(file)
    return RecordedFront(record, certificates)


def _read(file: Path) -> dict[str, Any]:
    try:
        found = json.loads(read_text(file, "JSON"))
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise InputError(file, "", "is no certificate: run 'workbench gains --search --write'")
    return found


def shown_fronts(loaded: Loaded, front: RecordedFront, workers: int | None = None,
                 on_progress: Progress = lambda done, total, what: None) -> tuple[GainFront, ...]:
    """Every point run again and its certificate held against its loop and checked again, the stated gains first.

    None where nothing is searched. Raises SolverError for a certificate that is not one of its gains' loop.
    """
    asked, record = front_search_of(loaded), front.record
    if asked is None:
        return ()
    stated = dict(asked.stated(Stated(loaded.path, loaded.data)))
    tasks = [(s.id, p.name, tuple(p.gains.items())) for s in asked.settings
             for p in (Found(name=STATED, gains=stated), *record.found.get(s.id, ()))]
    done: dict[Any, FrontPoint] = results_of(
        _shown, (loaded, front.certificates), tasks, places(workers),
        lambda count, task, _: on_progress(count, len(tasks), f"{task[0]}, {task[1]}"))
    return tuple(GainFront(s.title, tuple(done[task] for task in tasks if task[0] == s.id), asked.bounded, asked.unit,
                           record.evaluations) for s in asked.settings)


def _shown(shared: tuple[Loaded, dict[str, dict[str, Any]]],
           task: tuple[str, str, tuple[tuple[str, float], ...]]) -> FrontPoint:
    loaded, certificates = shared
    asked = front_search_of(loaded)
    assert asked is not None
    return shown_point(loaded, asked, certificates, task[0], task[1], dict(task[2]))


def shown_point(loaded: Loaded, asked: FrontSearch, certificates: Mapping[str, dict[str, Any]], setting_id: str,
                name: str, gains: dict[str, float]) -> FrontPoint:
    """Gains run again, and the bound of their certificate, checked again; SolverError where it is wrong."""
    setting = next(s for s in asked.settings if s.id == setting_id)
    of = polytope(setting.loop(Stated(loaded.path, loaded.data), exact(gains)))
    claim = claim_of(asked, setting, name)
    frozen = frozen_gain(of)
    bound = None
    if claim in certificates:
        bound = proved_bound(certificates[claim], claim, of)
    return FrontPoint(setting.title, name, gains, setting.run(loaded, gains), bound,
                      frozen if math.isfinite(frozen) else None, claim if bound is not None else "")

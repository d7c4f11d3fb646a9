"""The contract of a study: a TOML record in; rows, tables, curves and findings out."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PrivateAttr, Strict, ValidationError

from workbench.files.toml import Name, Record, Text
from workbench.trains.scenario import known_version

if TYPE_CHECKING:
    from workbench.model.desired_curve import DesiredCurve
    from workbench.paper.tracking import Tracked

Array = NDArray[np.float64]
# (runs finished, runs in all, what was run last)
Progress = Callable[[int, int, str], None]


class Study(Record):
    """What every study's file begins with; each paper's study adds its own tables, every value with its source."""

    version: Annotated[int, BeforeValidator(known_version)]
    kind: Literal["study", "contest"]
    name: Name
    title: Text
    paper: Text
    citation: Text
    reproduction: Annotated[bool, Strict()] = False
    _folder: Path = PrivateAttr(default=Path())

    @property
    def folder(self) -> Path:
        """Where the file lies from which the study comes."""
        return self._folder

    def in_folder(self, folder: Path) -> Self:
        """The same study as if its file lay in a folder."""
        found = self.model_copy()
        found._folder = folder
        return found


S = TypeVar("S", bound=Study)


def with_values(study: S, values: Mapping[str, Any], where: str) -> S:
    """The study with other values at dotted keys; ValueError naming `where` for an unknown key or an unfit value."""
    data = study.model_dump(exclude_unset=True)
    for key, value in values.items():
        *parents, last = key.split(".")
        table: Any = data
        for parent in parents:
            table = table.get(parent) if isinstance(table, dict) else None
        if not isinstance(table, dict) or last not in table:
            raise ValueError(f"{where}: {key}: no such key: name a value that the study states")
        table[last] = value
    try:
        return type(study).model_validate(data).in_folder(study.folder)
    except ValidationError as trouble:
        first = trouble.errors()[0]
        raise ValueError(f"{where}: {'.'.join(map(str, first['loc']))}: {first['msg']}: correct it") from None


@dataclass(frozen=True)
class Curve:
    """One curve of a plot: x and y of the same length, in the units of the plot's labels.

    One whose label begins with `desired` or `printed` is drawn broad and faint, beneath the others.
    Raises ValueError for what is no curve: other lengths, no point, a value that is not finite.
    """

    label: str
    x: Array
    y: Array

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.y.shape or not self.x.size:
            raise ValueError(f"curve '{self.label}' has {self.x.shape} values of x and {self.y.shape} of y")
        if not (np.isfinite(self.x).all() and np.isfinite(self.y).all()):
            raise ValueError(f"curve '{self.label}' has values that are not finite: end it where its run failed")


@dataclass(frozen=True)
class Plot:
    """A figure of the paper, run again: what it shows, its axes with their units, its curves.

    source: the figure it stands for (`paper, Figure 5`) or what it adds.
    """

    title: str
    source: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    note: str = ""
    log_y: bool = False
    log_x: bool = False


@dataclass(frozen=True)
class ResultTable:
    """A table of results: its header and rows as text; printed and obtained values stand side by side in it."""

    title: str
    source: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.header) or {"nan", "inf", "-inf"} & set(row):
                raise ValueError(f"table '{self.title}': the row {row} does not fit its header, or has no number")


@dataclass(frozen=True)
class StudyResult:
    """What a study found.

    rows: one a run, with the keys of `workbench compare` where they make sense, and more; plain data, None for
    a number that a failed run does not have. findings: what a reader should know, a sentence each, every number
    in it taken from the runs. failures: (run, why) of runs that ended early.
    """

    rows: tuple[dict[str, Any], ...]
    tables: tuple[ResultTable, ...]
    plots: tuple[Plot, ...]
    findings: tuple[str, ...]
    failures: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        for row in self.rows:
            wrong = [key for key, value in row.items() if isinstance(value, float) and not math.isfinite(value)]
            if wrong:
                raise ValueError(f"row {row}: {wrong[0]} is not finite: say None for what a run does not have")


@dataclass(frozen=True)
class StudyKind:
    """What a paper's module offers: the record of its file, and run(study, workers, on_progress) -> StudyResult.

    workers: processes to use, at least one. A run that fails is told in the result and raises nothing.
    located(study, path): of studies that name other files, the study with them found from its own path.
    tune(study, names, workers, on_progress): of studies whose file has a [tuning] table, for each name the parameters
    that were found, their cost and that of the stated ones.
    run_kept(study, workers, on_progress, folder, resume): of studies that take long, `run` with what is finished kept
    in a folder, from which `resume` goes on; InputError where the folder is another's or cannot be written.
    track(study, curve): of papers with a main controller, how it follows a reference, its own where curve is None.
    """

    record: type[Study]
    run: Callable[[Any, int, Progress], StudyResult]
    located: Callable[[Any, Path], Any] | None = None
    tune: Callable[[Any, list[str], int, Progress], dict[str, tuple[dict[str, float], float, float]]] | None = None
    run_kept: Callable[[Any, int, Progress, Path, bool], StudyResult] | None = None
    track: Callable[[Any, DesiredCurve | None], Tracked] | None = None

"""The contract of a study: a TOML record in; rows, tables, curves and findings out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, TypeVar

from pydantic import BeforeValidator, PrivateAttr, Strict, ValidationError

from workbench.files.toml import FileRecord, Name, Text
from workbench.model.sensitivity import Sensitivity
from workbench.paper.only_full import Extra
from workbench.paper.results import StudyResult
from workbench.trains.scenario import known_version

if TYPE_CHECKING:
    from workbench.model.desired_curve import DesiredCurve
    from workbench.paper.parameter_search import Finished, Tuned
    from workbench.paper.parameter_search import Name as SearchedName
    from workbench.paper.tracked import Tracked

# (runs finished, runs in all, what was run last)
Progress = Callable[[int, int, str], None]


class Study(FileRecord):
    """What every study's file begins with; each paper's study adds its own tables, every value with its source."""

    version: Annotated[int, BeforeValidator(known_version)]
    kind: Literal["study", "contest", "plant"]
    name: Name
    title: Text
    paper: Text
    citation: Text
    reproduction: Annotated[bool, Strict()] = False
    joint_sensitivity: Sensitivity | None = None
    _short: bool = PrivateAttr(default=False)

    def shortened(self) -> Self:
        """The same study for a short report, which leaves out what the file marks `only_full`."""
        found = self.model_copy()
        found._short = True
        return found

    def leaves_out(self, part: Extra | None) -> bool:
        """Whether the runs that a table or row of the file asks for are left out."""
        return self._short and part is not None and part.only_full


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
        parts = (where, ".".join(map(str, first["loc"])), first["msg"].removeprefix("Value error, "), "correct it")
        raise ValueError(": ".join(filter(None, parts))) from None


def varied(study: S, values: Mapping[str, Any], where: str) -> S:
    """`with_values` for one run, without the changes that a study makes by itself: of no use where one is made."""
    bare = study.model_copy(update={"changes": ()} if hasattr(study, "changes") else {})
    return with_values(bare, values, where) if values else bare


@dataclass(frozen=True)
class StudyKind:
    """What a paper's module offers: the record of its file, and run(study, workers, on_progress) -> StudyResult.

    workers: processes to use, at least one. A run that fails is told in the result and raises nothing.
    located(study, path): of studies that name other files, the study with them found from its own path.
    tune(study, names, workers, on_progress, kept): of studies whose file has a [tuning] table, what was found for each
    name, or for each condition and name. depends(study): of studies that name other files, a digest of those.
    run_kept(study, workers, on_progress, folder, resume): of studies that take long, `run` with what is finished kept
    in a folder, from which `resume` goes on; InputError where the folder is another's or cannot be written.
    track(study, curve): of papers with a main controller, how it follows a reference, its own where curve is None.
    run_one(study, case): of papers run again, the row of the one run whose case has these fields, and of the others the
    values that they have by default; ValueError where that is none or several.
    """

    record: type[Study]
    run: Callable[[Any, int, Progress], StudyResult]
    located: Callable[[Any, Path], Any] | None = None
    tune: Callable[[Any, list[str], int, Progress, Finished], dict[SearchedName, Tuned]] | None = None
    run_kept: Callable[[Any, int, Progress, Path, bool], StudyResult] | None = None
    track: Callable[[Any, DesiredCurve | None], Tracked] | None = None
    depends: Callable[[Any], str] | None = None
    run_one: Callable[[Any, Mapping[str, Any]], dict[str, Any]] | None = None

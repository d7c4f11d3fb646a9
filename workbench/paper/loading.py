"""A scenario's or study's file, or the folder of a paper with its study: read once, into a record that travels on.

What knows the records is imported once a file has been read, so that what is wrong with a path is said at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.errors import InputError
from workbench.files.folders import STUDY_FILE, held_in, is_folder
from workbench.files.toml import read_toml, validate_record

if TYPE_CHECKING:
    from workbench.paper.study import Study, StudyKind
    from workbench.trains.scenario import Scenario

    Kinds = Mapping[str, Callable[[], StudyKind]]

PLANT, CONTEST = "plant", "contest"  # what `kind` says of files that need no code of their own


@dataclass(frozen=True)
class Loaded:
    """What a file states: the table as it was read, and the record that it makes.

    kind: how a study is run; None for a scenario, which states its controllers and needs no code of its own.
    """

    path: Path
    data: Mapping[str, Any]
    record: Scenario | Study
    kind: StudyKind | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        """What goes to a worker process: how a study is run stays here, since it may hold functions without a name."""
        return Loaded, (self.path, self.data, self.record)

    @property
    def scenario(self) -> Scenario:
        """The scenario; InputError for a study."""
        from workbench.paper.study import Study  # noqa: PLC0415 - as said above

        if isinstance(self.record, Study):
            raise InputError(self.path, "kind", "is a study, where a scenario is needed: name a scenario, or leave "
                             "`kind` out where the file is one")
        return self.record

    @property
    def study(self) -> Study:
        """The study; InputError for a scenario."""
        from workbench.trains.scenario import Scenario  # noqa: PLC0415 - as said above

        if isinstance(self.record, Scenario):
            raise InputError(self.path, "kind", "is a scenario, where a study is needed: name a study")
        return self.record

    @property
    def folder(self) -> Path:
        """Where the file lies."""
        return self.path.parent


def study_file(path: Path) -> Path:
    """The TOML file that a path names: itself, or the study of a paper's folder. Raises InputError without one."""
    if not is_folder(path):
        return path
    if not (path / STUDY_FILE).is_file():
        raise InputError(path, "", f"has no {STUDY_FILE}, which states the values of its runs: write one, or name a "
                         "TOML file")
    return path / STUDY_FILE


def load(path: Path, kinds: Kinds | None = None) -> Loaded:
    """Read a scenario, a study or a paper's folder; kinds: of files that are no paper's, by their `kind`.

    Raises InputError naming file, key and remedy.
    """
    path = study_file(path)
    data, others = read_toml(path), {PLANT: _plant_kind, **(kinds or {})}
    named = data.get("kind")
    if named is None:
        from workbench.trains.scenario import build_scenario  # noqa: PLC0415 - as said above

        return Loaded(path, data, build_scenario(path, data))
    if named not in ("study", *others):
        known = ", ".join(repr(kind) for kind in ("study", *others))
        raise InputError(path, "kind", f"{named!r} is not known: it is one of {known}, or left out for a scenario")
    kind = study_kind(path) if named == "study" else others[str(named)]()
    study = validate_record(data, kind.record, path).in_folder(path.parent)
    return Loaded(path, data, kind.located(study, path) if kind.located else study, kind)


def kind_of(loaded: Loaded) -> StudyKind | None:
    """How a paper's study is run, in a worker process too, where it is looked up beside the file; None for a scenario.
    """
    if loaded.kind is not None or loaded.data.get("kind") is None:
        return loaded.kind
    return _plant_kind() if loaded.data["kind"] == PLANT else study_kind(loaded.path)


def _plant_kind() -> StudyKind:
    from workbench.paper.plants.study import KIND  # noqa: PLC0415 - casadi, which other files do without

    return KIND


def study_kind(path: Path) -> StudyKind:
    """The record and the run of a study, from the `study` package beside its file; InputError where there is none."""
    from workbench.paper.study import StudyKind  # noqa: PLC0415 - as said above

    found = held_in(path.parent, "study", StudyKind)
    if not found:
        raise InputError(path, "kind", "is 'study', but no study/__init__.py lies beside this file with a StudyKind in "
                         "it: write one, or leave `kind` out for a scenario")
    return next(iter(found.values()))

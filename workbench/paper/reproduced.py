"""What studies that run a paper again share: what their files may state beside the paper's own, and runs by case."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Generic, Protocol, Self, TypeVar

from pydantic import model_validator

from workbench.files.toml import Record, SourcedRecord, Text
from workbench.paper.mpc_comparison import MpcData
from workbench.paper.only_full import MadeRuns, OnlyFull
from workbench.paper.study import Study, varied
from workbench.paper.tuning_record import Pairs, StudyTuning

# The number of the change that a run as stated is made under.
STATED = -1


class Change(Record):
    """A change of assumed values, to see how much they matter: dotted key -> value.

    only_full: its runs are made for a full report alone.
    """

    title: Text
    set: dict[str, Any]
    only_full: OnlyFull = False


class ColumnTable(SourcedRecord):
    """A table of a paper with one value a column: each of its own fields lists as many values as the others."""

    @model_validator(mode="after")
    def _as_long_as_each_other(self) -> Self:
        lengths = {key: len(getattr(self, key)) for key in type(self).model_fields if key != "source"}
        usual = max(lengths.values(), key=list(lengths.values()).count)
        for key, length in lengths.items():
            if length != usual:
                raise ValueError(f"{key} has {length} values, others {usual}: give one value a column in each")
        return self

    @property
    def columns(self) -> int:
        """How many columns the table has."""
        return next(len(getattr(self, key)) for key in type(self).model_fields if key != "source")


class ReproducedStudy(Study):
    """A paper's study beside MPC: its own tables, and changes of assumed values, MPC, tuning and pairs.

    A paper whose changes state more than a title and values has its own `changes`, of its own `Change`.
    """

    changes: tuple[Change, ...] = ()
    mpc: MpcData | None = None
    tuning: StudyTuning | None = None
    pairs: Pairs | None = None

    def check(self) -> None:
        """ValueError for values of the paper's own tables that do not fit together."""

    @model_validator(mode="after")
    def _parts_and_changes_fit(self) -> Self:
        self.check()
        for number in range(len(self.changes)):
            self.changed(number)
        return self

    def changed(self, number: int) -> Self:
        """The study that a run is made of: this one, or that of a change, by its number.

        ValueError naming the change for an unknown key or an unfit value.
        """
        if number == STATED:
            return self
        return varied(self, self.changes[number].set, f"changes: '{self.changes[number].title}'")

    def number_of(self, values: Mapping[str, Any]) -> int | None:
        """The number of the change with which a run has the same values as with these; None where it has none.

        Raises ValueError for an unknown key or an unfit value.
        """
        wanted = varied(self, values, "values")
        return next((number for number in (STATED, *range(len(self.changes)))
                     if varied(self.changed(number), {}, "") == wanted), None)

    def number_titled(self, title: str) -> int:
        """The number of the change with a title; StopIteration where none has it."""
        return next(number for number, change in enumerate(self.changes) if change.title == title)

    def change_title(self, number: int) -> str | None:
        """The title of a change, by its number; None for what is as stated."""
        return None if number == STATED else self.changes[number].title


def in_words(*parts: str | None) -> str:
    """What names a run, of those parts that say something: `law, column 3, twice the rate`."""
    return ", ".join(filter(None, parts))


class HasChange(Protocol):
    """What names a run: at least the number of the change that it is made under, STATED for none."""

    @property
    def change(self) -> int:
        """A number of the study's changes."""
        ...


@dataclass(frozen=True)
class RunCase:
    """A run of a study whose runs differ in its changes alone: as stated, or under the change of that number."""

    change: int = STATED


def _has(case: object, values: Mapping[str, object]) -> bool:
    return all(getattr(case, key) == value for key, value in values.items())


S = TypeVar("S", bound=ReproducedStudy)
C = TypeVar("C", bound=HasChange)
R = TypeVar("R")


def stated_and_changed(study: ReproducedStudy, stated: Iterable[Any] = (RunCase(),)) -> list[Any]:
    """The runs as stated, then all of them under each change of the file; stated: their cases, frozen dataclasses."""
    cases = list(stated)
    return [replace(case, change=number) for number in range(STATED, len(study.changes)) for case in cases]


@dataclass(frozen=True)
class Results(Generic[S, C, R]):
    """A study and its runs by case, as tables, figures and findings ask for them; `MadeRuns` where there are fewer."""

    study: S
    runs: Mapping[C, R]

    def fitting(self, fits: Callable[[C], bool]) -> dict[C, R]:
        """The runs whose cases fit; of a short report see `MadeRuns`."""
        if isinstance(self.runs, MadeRuns):
            return self.runs.fitting(fits)
        return {of: run for of, run in self.runs.items() if fits(of)}

    def select(self, **case: object) -> dict[C, R]:
        """The runs whose cases have these values."""
        return self.fitting(lambda of: _has(of, case))

    def under(self, which: Callable[[Any], bool], **case: object) -> list[tuple[Any, R]]:
        """Those of `select` under the study's changes for which that holds, each behind its change."""
        changes = self.study.changes
        found = self.fitting(lambda of: of.change != STATED and which(changes[of.change]) and _has(of, case))
        return [(changes[of.change], run) for of, run in found.items()]

    def with_values(self, **values: object) -> R | None:
        """The run under the change of exactly these values, dots as double underscores; None where there is none."""
        wanted = {key.replace("__", "."): value for key, value in values.items()}
        return next((run for _, run in self.under(lambda change: change.set == wanted)), None)

    def changing(self, *keys: str, **case: object) -> dict[C, R]:
        """Those of `select` under changes of exactly these keys; under any change where no key is named."""
        return self.fitting(lambda of: of.change != STATED and _has(of, case) and (
            not keys or self.study.changes[of.change].set.keys() == set(keys)))

    def changed_runs(self, *keys: str, **case: object) -> list[tuple[Any, R]]:
        """The runs of `changing`, each behind the study's change that it was made under."""
        return [(self.study.changes[of.change], run) for of, run in self.changing(*keys, **case).items()]

    def by_change(self, **case: object) -> list[tuple[str, dict[C, R]]]:
        """For each change its title and its runs among those of `select`, in the file's order: for a table of them."""
        runs = self.fitting(lambda of: of.change != STATED and _has(of, case))
        return [(change.title, {of: run for of, run in runs.items() if of.change == number})
                for number, change in enumerate(self.study.changes) if not self.study.leaves_out(change)]

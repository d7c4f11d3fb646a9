"""What a study's file marks `only_full`: runs beside the paper's own that a short report leaves out, and says so."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Protocol, TypeVar

from pydantic import Strict

from workbench.files.toml import SourcedRecord
from workbench.paper.findings import LackingError
from workbench.paper.results import Plot, ResultTable

C = TypeVar("C", bound=Hashable)
R = TypeVar("R")
Made = TypeVar("Made", bound=ResultTable | Plot)

# Of a table or row: whether it asks for runs that a report makes with --full alone.
OnlyFull = Annotated[bool, Strict()]


class ExtraTable(SourcedRecord):
    """A table of a study's file that asks for runs beside the paper's own: with `only_full` a full report's alone."""

    NO_VALUES: ClassVar[frozenset[str]] = SourcedRecord.NO_VALUES | {"only_full"}
    only_full: OnlyFull = False


class Extra(Protocol):
    """A table or row that may be marked."""

    @property
    def only_full(self) -> bool:
        """Whether its runs are a full report's alone."""
        ...


class MadeRuns(dict[C, R]):
    """Runs by case, of which a short report has left some out.

    left_out: the cases of these; whoever looks one up is told by LackingError. missed: those that were asked for among
    others; where strict that is LackingError too, as a sentence must not count what is not there.
    """

    def __init__(self, runs: Mapping[C, R], left_out: Iterable[C], strict: bool) -> None:
        super().__init__(runs)
        self.left_out, self.strict, self.missed = frozenset(left_out), strict, set[C]()

    def __missing__(self, case: C) -> R:
        if case in self.left_out:
            raise LackingError
        raise KeyError(case)

    def take_missed(self) -> int:
        """How many were missed since this was asked last."""
        count = len(self.missed)
        self.missed.clear()
        return count

    def fitting(self, fits: Callable[[C], bool]) -> dict[C, R]:
        """The runs whose cases fit, those that are there."""
        found, missed = {of: run for of, run in self.items() if fits(of)}, set(filter(fits, self.left_out))
        if missed and self.strict:
            raise LackingError
        self.missed |= missed
        return found


def each(makers: Iterable[Callable[[Any], Any]], results: Any) -> Iterator[Any]:
    """What makers give of the results, one or several each; what lacks runs says how many, or is left out itself."""
    runs = results.runs
    for maker in makers:
        try:
            made = maker(results)
            several: Iterable[ResultTable | Plot] = (made,) if isinstance(made, ResultTable | Plot) else made
            for one in several:
                missed = runs.take_missed() if isinstance(runs, MadeRuns) else 0
                if not missed or (one.rows if isinstance(one, ResultTable) else one.curves):
                    yield shortened(one, missed)
        except LackingError:
            pass
        if isinstance(runs, MadeRuns):
            runs.take_missed()


def shortened(made: Made, left_out: int) -> Made:
    """A table or figure whose note says that it lacks runs, and how to get them; as it is where none is left out."""
    if not left_out:
        return made
    words = f"Shortened: {left_out} run{'' if left_out == 1 else 's'} left out; all with --full."
    return replace(made, note=f"{made.note} {words}".strip())

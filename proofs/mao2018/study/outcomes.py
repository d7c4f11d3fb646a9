"""The runs of mao2018's study by what tables, figures and findings ask for, and how they say how a run went."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from workbench.paper.cells import FORCES, Cell, Phrase, Quantity, Scaled, cell_text

from ..simulation.trip import Signs, wrong_signs
from .record import MaoStudy
from .runs import RunCase, RunResult


@dataclass(frozen=True)
class Results:
    """A study with all its runs."""

    study: MaoStudy
    runs: Mapping[RunCase, RunResult]

    @property
    def numbers(self) -> range:
        """The cases, from 1."""
        return range(1, len(self.study.cases) + 1)

    @property
    def first_tuning(self) -> str:
        """The tuning that figures and the comparison show, by name."""
        return next(iter(self.study.tunings))

    def wrong(self, number: int) -> Signs:
        """The equations of a case's law whose printed sign is wrong."""
        return wrong_signs(self.study.cases[number - 1])

    def printed(self, number: int, tuning: str) -> RunResult:
        """The run of a case with the law as printed."""
        return self.runs[RunCase(number, tuning)]

    def corrected(self, number: int, tuning: str) -> RunResult:
        """The run of a case with all signs corrected; for the healthy law, which has none wrong, the only one."""
        return self.runs[RunCase(number, tuning, self.wrong(number))]

    def all_corrected(self, tuning: str) -> list[RunResult]:
        """Of every case the run with all signs corrected."""
        return [self.corrected(number, tuning) for number in self.numbers]

    def stated(self, tuning: str) -> list[RunResult]:
        """The runs of a tuning without any change, case by case."""
        return [run for of, run in self.runs.items()
                if of.tuning == tuning and not of.change and of.end_s is None]

    def sampled(self) -> list[RunResult]:
        """The runs that vary the sampling period and the damping."""
        return [run for of, run in self.runs.items() if of.end_s is not None]

    def changed(self, number: int) -> list[RunResult]:
        """The runs of the sensitivity's entry `number`, from 1."""
        return [run for of, run in self.runs.items() if of.change == number]

    def left(self, run: RunResult) -> str:
        """Which wrong signs a run still has."""
        return ", ".join(f"({sign})" for sign in self.wrong(run.case.number) if sign not in run.case.mended) or "none"


def ended(run: RunResult) -> Cell:
    """When a run diverged; nothing for one that came to its end."""
    end = run.row["end_s"]
    return Phrase("diverged at {} s", (Quantity(end, decimals=3 if end < 10 else 1),)) if run.failed else None


def summary(run: RunResult) -> Cell:
    """The largest error after the first event and what it settles to, or when it diverged."""
    return ended(run) if run.failed else Phrase("{}, settles to {}", (Scaled(run.largest_m), Scaled(run.settled_m)))


def outcome(run: RunResult) -> str:
    """The same in a sentence's words."""
    return cell_text(ended(run)) if run.failed else f"up to {length(run.largest_m)}, settling to {length(run.settled_m)}"


def length(metres: float) -> str:
    """An error as sentences have it."""
    return cell_text(Scaled(metres))


def force(newtons: float) -> str:
    """A force as sentences have it."""
    return cell_text(Scaled(newtons, FORCES))

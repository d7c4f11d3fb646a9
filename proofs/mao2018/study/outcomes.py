"""The runs of mao2018's study by what tables, figures and findings ask for."""

from __future__ import annotations

from dataclasses import dataclass

from ..laws import KINDS
from .record import MaoStudy
from .runs import Asked, Obtained, Signs


@dataclass(frozen=True)
class Found:
    """A study with all its runs."""

    study: MaoStudy
    runs: dict[Asked, Obtained]

    def wrong(self, case: int) -> Signs:
        """The equations of a case's law whose printed sign is wrong."""
        law = self.study.cases[case - 1].law
        return () if law == "healthy" else KINDS[law][-1]

    def printed(self, case: int, tuning: str) -> Obtained:
        """The run of a case with the law as printed."""
        return self.runs[Asked(case, tuning)]

    def corrected(self, case: int, tuning: str) -> Obtained:
        """The run of a case with all signs corrected; for the healthy law, which has none wrong, the only one."""
        return self.runs[Asked(case, tuning, self.wrong(case))]

    def stated(self, tuning: str) -> list[Obtained]:
        """The runs of a tuning without any change, case by case."""
        return [run for asked, run in self.runs.items()
                if asked.tuning == tuning and not asked.change and asked.end_s is None]

    def sampled(self) -> list[Obtained]:
        """The runs that vary the sampling period and the damping."""
        return [run for asked, run in self.runs.items() if asked.end_s is not None]

    def changed(self, number: int) -> list[Obtained]:
        """The runs of the sensitivity's entry `number`, from 1."""
        return [run for asked, run in self.runs.items() if asked.change == number]


def left(run: Obtained, wrong: Signs) -> str:
    """Which wrong signs a run still has."""
    return ", ".join(f"({sign})" for sign in wrong if sign not in run.asked.mended) or "none"


def length(metres: float) -> str:
    """An error with two digits and the unit that fits it."""
    unit, size = next(((unit, size) for unit, size in (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6)) if metres >= size),
                      ("nm", 1e-9))
    value = metres / size
    return f"{value:.0f} {unit}" if value >= 10 else f"{value:.2g} {unit}"


def kilonewtons(newtons: float) -> str:
    """A force in kN without decimals, in MN beyond 10,000 kN."""
    return f"{newtons / 1e3:.0f} kN" if abs(newtons) < 1e7 else f"{newtons / 1e6:.2g} MN"


def ended(run: Obtained) -> str:
    """When a run diverged, or a dash."""
    end = run.row["end_s"]
    return f"diverged at {end:.{3 if end < 10 else 1}f} s" if run.failed else "—"


def largest(run: Obtained) -> float:
    """The largest |position error| after the first event, else of the whole run: the start's error is given."""
    later = [stretch.largest_m for stretch in run.stretches[1:]]
    return max(later or [max(abs(run.row["position_error_min"]), abs(run.row["position_error_max"]))])


def settled(run: Obtained) -> float:
    """The largest of the errors that a run settles to before each event."""
    return max(stretch.settled_m for stretch in run.stretches)

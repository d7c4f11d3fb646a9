"""mao2018's cases driven by MPC: the same train, modes, disturbances and failed motor beside the paper's laws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.files.numbers import number
from workbench.mpc.controller import KINDS
from workbench.paper.drivers import MPC_NAMES, entries, tuning_words
from workbench.paper.mpc_comparison import HEADER, KINDS_BESIDE, best_words, cells, counters_words, error_plot
from workbench.paper.results import Plot, ResultTable

from .drivers import DRIVERS, LAW, row_of, run_case
from .outcomes import Found
from .record import MaoStudy

TUNED = ", tuned"
# (case, controller by its name in [tuning], whether it is tuned)
Task = tuple[int, str, bool]


@dataclass(frozen=True)
class Beside:
    """A run of a case (from 1): its row with the keys of a comparison, and what its controller counted."""

    case: int
    name: str
    tuned: bool
    row: dict[str, Any]
    counters: dict[str, int]

    @property
    def title(self) -> str:
        """As tables have it."""
        return DRIVERS.titles[self.name] + (TUNED if self.tuned else "")


def beside_tasks(study: MaoStudy) -> list[Task]:
    """MPC of every kind, and all that is tuned, in every case; none where the file states no MPC."""
    if not study.mpc:
        return []
    asked = [(name, False) for name in MPC_NAMES] + [entry for entry in entries(study, DRIVERS) if entry[1]]
    return [(case, name, tuned) for case in range(1, len(study.cases) + 1) for name, tuned in asked]


def run_one(study: MaoStudy, task: Task) -> Beside:
    """The run of a task."""
    case, name, tuned = task
    run = run_case(DRIVERS.tuned(study, name) if tuned else study, name, case)
    return Beside(case, name, tuned, row_of(study, run), run.counters)


def _rows(found: Found, others: Sequence[Beside], case: int, tuned: bool) -> list[tuple[str, dict[str, Any]]]:
    of_case = [(one.title, one.row) for one in others if one.case == case and one.tuned == tuned]
    if tuned:
        return of_case
    first = next(iter(found.study.tunings))
    printed, corrected = found.printed(case, first), found.corrected(case, first)
    ours = [("as printed", printed)] if found.wrong(case) else []
    ours.append((DRIVERS.titles[LAW] if found.wrong(case) else "the law", corrected))
    return [(name, one.row | {"curve": (one.curves["error"].x, one.curves["error"].y)}) for name, one in ours] + of_case


def beside_table(found: Found, others: Sequence[Beside]) -> Iterator[ResultTable]:
    """A row per case and controller; nothing where no MPC ran."""
    if not others or found.study.mpc is None:
        return
    rows = [(f"{case}, {found.study.cases[case - 1].title}", name, *cells(row))
            for case in range(1, len(found.study.cases) + 1) for tuned in (False, True)
            for name, row in _rows(found, others, case, tuned)]
    data = found.study.mpc
    yield ResultTable(
        "Beside MPC", "comparison", ("case", "controller", *HEADER), tuple(rows),
        f"{next(iter(found.study.tunings.values())).title}; MPC every {data.period_s:g} s, {data.horizon} samples "
        f"ahead, limits of {data.max_traction_mps2:g} m/s², the laws every "
        f"{next(iter(found.study.tunings.values())).period_s:g} s, without limits as in the paper. "
        f"MPC: {KINDS[KINDS_BESIDE[-1]].information}, that of mode (i) with all motors healthy; the laws: full state, "
        f"parameters unknown, times of the modes and frequencies of the failure known. MPC counted "
        f"{counters_words([one.counters for one in others])}."
        + (f" {tuning_words(found.study.tuning)} The tuning's runs are shorter than these and of some of the cases, "
           "see the file." if found.study.tuning else ""))


def beside_findings(found: Found, others: Sequence[Beside]) -> Iterator[str]:
    """Who is nearest where, a sentence a case for all as stated and one for all as tuned."""
    for case in range(1, len(found.study.cases) + 1) if others else ():
        for tuned, words in ((False, "as stated"), (True, "tuned")):
            rows = [(name.removesuffix(TUNED), row) for name, row in _rows(found, others, case, tuned)]
            if rows:
                yield (f"Beside MPC, case {case}, {words}: {best_words(rows, 'position_rms', 'position RMS')} m; "
                       f"{best_words(rows, 'speed_rms', 'speed RMS')} m/s; "
                       f"{best_words(rows, 'jerk_rms', 'jerk RMS')} m/s³.")
    steps = [one.row["step_us_median"] for one in others if one.name in MPC_NAMES]
    if steps:
        yield f"A step of MPC takes {number(min(steps))} to {number(max(steps))} µs here."


def beside_plots(found: Found, others: Sequence[Beside]) -> Iterator[Plot]:
    """Position errors over time in the first case of the tuning, stated and tuned."""
    if others and found.study.tuning is not None:
        case = int(found.study.tuning.places[0])
        rows = [row for tuned in (False, True) for row in _rows(found, others, case, tuned)]
        yield from error_plot(rows, f"case {case}")

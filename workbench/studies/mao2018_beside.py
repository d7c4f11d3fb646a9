"""mao2018's cases driven by MPC: the same train, modes, disturbances and failed motor beside the paper's laws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.controllers import mao2018_laws as laws
from workbench.metrics import measure_run
from workbench.mpc.controller import KINDS
from workbench.report.numbers import number
from workbench.studies.base import ResultTable
from workbench.studies.beside_mpc import HEADER, KINDS_BESIDE, best_words, cells, counters_words, known, run_beside
from workbench.studies.mao2018_found import Found
from workbench.studies.mao2018_numbers import setting_of
from workbench.studies.mao2018_record import MaoStudy

Task = tuple[int, str]


@dataclass(frozen=True)
class Beside:
    """MPC of a kind in a case (from 1): its row with the keys of a comparison, and what it counted."""

    case: int
    kind: str
    row: dict[str, Any]
    counters: dict[str, int]


def beside_tasks(study: MaoStudy) -> list[Task]:
    """Every kind in every case; none where the file states no MPC."""
    return [(case, kind) for case in range(1, len(study.cases) + 1) for kind in KINDS_BESIDE] if study.mpc else []


def run_one(study: MaoStudy, task: Task) -> Beside:
    """One run: MPC knows the healthy train in its first mode, and neither later modes nor failures."""
    number_of, kind = task
    case, tuning, data = study.cases[number_of - 1], next(iter(study.tunings.values())), study.mpc
    assert data is not None
    setting = setting_of(study, case, tuning)
    a, b, c = (float(value) for value in setting.changes[0, 1:4])
    nominal = known(data, setting.curve, setting.mass_kg, (a, b, c), setting.end_s)
    run = run_beside(nominal, kind, setting, laws.train)
    return Beside(number_of, kind, measure_run(run, setting.curve.length_m).row(), run.counters)


def _rows(found: Found, of_mpc: Sequence[Beside], case: int) -> list[tuple[str, dict[str, Any]]]:
    tuning = next(iter(found.study.tunings))
    printed, corrected = found.printed(case, tuning), found.corrected(case, tuning)
    ours = [("as printed", printed.row)] if found.wrong(case) else []
    ours.append(("signs corrected" if found.wrong(case) else "the law", corrected.row))
    return ours + [(KINDS[one.kind].title, one.row) for one in of_mpc if one.case == case]


def beside_table(found: Found, of_mpc: Sequence[Beside]) -> Iterator[ResultTable]:
    """A row per case and controller; nothing where no MPC ran."""
    if not of_mpc or found.study.mpc is None:
        return
    rows = [(f"{case}, {found.study.cases[case - 1].title}", name, *cells(row))
            for case in range(1, len(found.study.cases) + 1) for name, row in _rows(found, of_mpc, case)]
    data = found.study.mpc
    yield ResultTable(
        "Beside MPC", "comparison", ("case", "controller", *HEADER), tuple(rows),
        f"{next(iter(found.study.tunings.values())).title}; MPC every {data.period_s:g} s, {data.horizon} samples "
        f"ahead, limits of {data.max_traction_mps2:g} m/s², the laws without limits as in the paper. "
        f"MPC: {KINDS[KINDS_BESIDE[-1]].information}, that of mode (i) with all motors healthy; the laws: full state, "
        f"parameters unknown, times of the modes and frequencies of the failure known. MPC counted "
        f"{counters_words([one.counters for one in of_mpc])}.")


def beside_findings(found: Found, of_mpc: Sequence[Beside]) -> Iterator[str]:
    """Who is nearest where, a sentence a case."""
    for case in range(1, len(found.study.cases) + 1) if of_mpc else ():
        rows = _rows(found, of_mpc, case)
        yield (f"Beside MPC, case {case}: {best_words(rows, 'position_rms', 'position RMS')} m; "
               f"{best_words(rows, 'jerk_rms', 'jerk RMS')} m/s³.")
    steps = [one.row["step_us_median"] for one in of_mpc]
    if steps:
        yield f"A step of MPC takes {number(min(steps))} to {number(max(steps))} µs here."

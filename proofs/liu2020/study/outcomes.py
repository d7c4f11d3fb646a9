"""The runs of liu2020's study by what tables, figures and findings ask for, beside what the paper prints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from workbench.paper.cells import Column

from ..steady_run import Implied, implied
from .record import LiuStudy, Printed
from .runs import (
    ALL_COLUMNS,
    RunCase,
    RunResult,
    change_cases,
    divergence_case,
    table_3_case,
    table_4_case,
)

RMS = ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps")
ENERGY = "energy_both_J"
QUANTITIES = {"s_tilde_m": Column("s̃", "m"), "v_tilde_mps": Column("ṽ", "m/s"), "position_m": Column("s−s_d", "m"),
              "speed_mps": Column("v−v_d", "m/s"), "input_n": Column("u", "N")}


@dataclass(frozen=True)
class Results:
    """A study with all its runs."""

    study: LiuStudy
    runs: Mapping[RunCase, RunResult]

    def table_3(self, column: int, law: str) -> RunResult:
        """The run of a column of Table 3."""
        return self.runs[table_3_case(self.study, column, law)]

    def table_4(self, disturbance: str, law: str) -> RunResult:
        """The run of a column of Table 4."""
        return self.runs[table_4_case(self.study, disturbance, law)]

    def divergence(self, column: int, law: str, leak_rate_per_s: float) -> RunResult:
        """The run of a column under a leak rate."""
        return self.runs[divergence_case(self.study, column, law, leak_rate_per_s)]

    def change(self, number: int) -> list[RunResult]:
        """The runs of a change."""
        return [self.runs[case] for case in change_cases(self.study, number)]

    def inferred(self) -> list[RunResult]:
        """The runs of the changes under which the paper's numbers seem to have been computed."""
        return [result for number, change in enumerate(self.study.changes)
                if change.title in self.study.runs.inferred_changes for result in self.change(number)]

    def rms(self, column: int, law: str, name: str) -> float | None:
        """A number of a column's run of Table 3; None where it failed."""
        return self.table_3(column, law).numbers.get(name)

    def printed(self, table: Printed, column: int, name: str) -> float:
        """A value of Table 3 for its column, or of Table 4 for the disturbance that Table 3 is run with."""
        study = self.study
        disturbance = list(study.disturbances).index(study.runs.table_3_disturbance)
        return float(getattr(table, name)[column - 1 if table is study.table_3 else disturbance])

    def implied(self) -> dict[str, Implied]:
        """What every printed column implies, by where it is printed."""
        study = self.study
        where = [(study.table_3, "Table 3", column) for column in ALL_COLUMNS]
        where.append((study.table_4, "Table 4", study.table_4_column))
        return {f"{name}, Value {column}": implied(study, column, *(
            self.printed(table, column, key) for key in ("s_tilde_m", "v_tilde_mps", "position_m")))
            for table, name, column in where}

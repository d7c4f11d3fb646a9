"""liu2020's tables: Table 3 and Table 4 printed beside obtained, and what the stated and assumed values do."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.results import ResultTable
from workbench.paper.study_tables import printed_cells, printed_columns, sensitivity_table

from ..laws import LAWS
from ..steady_run import DAMPED, eigenvalues, largest_step_s
from .runs import (
    ALL_COLUMNS,
    BY_RATE,
    CORRECTED,
    RMS,
    SIGN_LAWS,
    TABLE_4_LAWS,
    TABLE_LAWS,
    LiuResults,
    number_of,
)

ENERGY = "energy_both_J"
QUANTITIES = {"s_tilde_m": Column("s̃", "m"), "v_tilde_mps": Column("ṽ", "m/s"), "position_m": Column("s−s_d", "m"),
              "speed_mps": Column("v−v_d", "m/s"), "input_n": Column("u", "N")}
RMS_NOTE = "RMS values; a dash: the run failed."
ENERGY_UNIT = 1e11


def _table_3(law: str, results: LiuResults) -> ResultTable:
    study, names = results.study, ("energy", *RMS)
    rows = [(column, *printed_cells((results.printed(study.table_3, column, name),
                                     results.rms(column, law, ENERGY if name == "energy" else name))
                                    for name in names)) for column in ALL_COLUMNS]
    return ResultTable(
        f"Table 3, {LAWS[law].title}", "paper, Table 3",
        ("Value", *printed_columns((Column("energy", "10¹¹", ENERGY_UNIT), *(QUANTITIES[name] for name in RMS)))),
        tuple(rows), f"{RMS_NOTE} Energy obtained: the integral of |u v| in J, braking counted as positive.")


def _table_4(results: LiuResults) -> ResultTable:
    study, rows = results.study, []
    laws = results.laws(TABLE_4_LAWS, column=study.table_4_column)
    for index, (key, push) in enumerate(study.disturbances.items()):
        runs = [results.table_4(key, law) for law in laws]
        for name in ("energy", *RMS):
            energy, printed = name == "energy", float(getattr(study.table_4, name)[index])
            numbers = [number_of(run, ENERGY if energy else name) for run in runs]
            rows.append((push.title, "energy (10¹¹ J)" if energy else QUANTITIES[name].heading,
                         Quantity(printed, si=ENERGY_UNIT if energy else 1.0, digits=None),
                         *(Quantity(number, si=ENERGY_UNIT) if energy else number for number in numbers)))
    return ResultTable(f"Table 4: Value {study.table_4_column} under three disturbances", "paper, Table 4",
                       ("disturbance", "of", "printed", *(LAWS[law].title for law in laws)), tuple(rows),
                       f"{RMS_NOTE} Table 4 prints them in 10⁻⁵; they stand here in m and m/s.", letters=True)


def _implied(results: LiuResults) -> ResultTable:
    return ResultTable(
        "What the printed errors imply", "from Tables 2, 3 and 4, no run",
        ("printed in", Column("a by s̃, ṽ", "m/s²"), Column("a by s−s_d", "m/s²"), "ratio", Column("step", "s")),
        tuple((where, i.by_estimates, i.by_position, i.ratio, i.step_s) for where, i in results.implied().items()),
        "For a steady acceleration a with feedback alone, (12) as printed gives a = −k₂s̃ − k₃ṽ and (31) gives s_d − s "
        "= aM/(χk₄k₅); Euler steps of T add aT/2 to k₁s̃. All is applied to RMS values, which is near where the gains "
        "are high, Values 4 to 10.")


def _inferred(results: LiuResults) -> ResultTable:
    study, rows = results.study, []
    for run in results.inferred():
        column, both = run.case.column, run.case.column == study.table_4_column
        for table, where in ((study.table_3, "Table 3"), *(((study.table_4, "Table 4"),) if both else ())):
            rows.append((f"{column}, {where}" if both else f"{column}", *printed_cells(
                ((results.printed(table, column, name), number_of(run, name)) for name in RMS), ratio=True)))
    return ResultTable(
        "Table 3 as its numbers imply it was computed", "paper, Table 3; inferred",
        ("Value", *printed_columns([QUANTITIES[name] for name in RMS], ratio=True)), tuple(rows),
        f"Feedback alone, k₃ṽ; {'; '.join(study.runs.inferred_changes)}. {RMS_NOTE}")


def _ranges(results: LiuResults) -> ResultTable:
    rows = []
    in_rows = ("s_tilde", "v_tilde", "position_error", "speed_error", "input_n")
    for figure, ((name, quantity), in_row) in enumerate(zip(QUANTITIES.items(), in_rows, strict=True), start=14):
        for key, push in results.study.disturbances.items():
            row = results.table_4(key, CORRECTED).row
            rows.append((f"Figure {figure}", quantity.heading, push.title,
                         *getattr(results.study.figure_ranges, name), *(row[f"{in_row}_{end}"] for end in ("min", "max"))))
    return ResultTable("Ranges of Figures 14 to 18", "paper, text to Figures 14 to 18",
                       ("figure", "shows", "disturbance", "printed from", "to", "obtained from", "to"), tuple(rows),
                       "Value 10, signs corrected. The rates of the reference follow from Figure 18's range; no other "
                       "value here was chosen by what is printed.", letters=True)


def _laws_by_column(results: LiuResults) -> ResultTable:
    rows: list[tuple[Cell, ...]] = []
    laws = results.laws(TABLE_LAWS, disturbance=results.study.runs.table_3_disturbance)
    for name in RMS:
        sign = QUANTITIES[name].title
        rows.append((sign, "printed in Table 3", *getattr(results.study.table_3, name)))
        rows += [(sign, LAWS[law].title, *(results.rms(column, law, name) for column in ALL_COLUMNS))
                 for law in laws]
    return ResultTable("RMS values of every law, Values 1 to 10", "paper, Table 3", ("error", "law", *map(
        str, ALL_COLUMNS)), tuple(rows), "In m and m/s. k₃ stands before ṽ, as (12) prints, unless said.", letters=True)


def _divergence(results: LiuResults) -> ResultTable:
    runs = results.study.runs
    rows = [(column, LAWS[law].title, *(run.ended or number_of(run, "position_m") for run in (
        results.divergence(column, law, rate) for rate in runs.divergence_leak_rates_per_s)))
            for column in runs.divergence_columns for law in SIGN_LAWS if results.study.changes]
    return ResultTable(
        "What the printed signs do", "claims 19.leakage, 21.leakage, 32.cancels, 35.leakage",
        ("Value", "law", *(f"{rate:g} 1/s" for rate in runs.divergence_leak_rates_per_s)), tuple(rows),
        f"Columns: leak rate Γσ = αβ of all four estimates; {runs.divergence_change}. Cells: RMS of s−s_d in m, or "
        f"when the run diverged.")


def _steps(results: LiuResults) -> ResultTable:
    study, step = results.study, Column("step", "s")
    roots = [[eigenvalues(study, column, damped) for damped in DAMPED] for column in ALL_COLUMNS]
    return ResultTable(
        "Eigenvalues of the observer, and the step beyond which Euler's rule diverges", "Table 2 in (12), (13)",
        ("Value", Column("k₃ṽ: eigenvalues", "1/s"), step, Column("k₃s̃′: eigenvalues", "1/s"), step),
        tuple((column, *(cell for own in both for cell in (_pair(own), largest_step_s(own))))
              for column, both in zip(ALL_COLUMNS, roots, strict=True)),
        f"Without networks and robust terms. The runs take {study.sampling.period_s:g} s.")


def _pair(roots: NDArray[np.complex128]) -> Cell:
    first, second = sorted(roots, key=lambda root: root.real)
    if abs(first.imag) > 0:
        return Phrase("{} ± {}i", (float(first.real), float(abs(first.imag))))
    return Phrase("{}, {}", (float(first.real), float(second.real)))


def _sensitivity(results: LiuResults) -> ResultTable:
    """The law as stated in all columns that changes run with it, then every change."""
    study = results.study
    columns = {column for change in study.changes if change.law is None for column in change.columns}
    stated = [results.table_3(column, study.runs.sensitivity_law)
              for column in sorted(columns | set(study.runs.sensitivity_columns))]
    entries = [("as stated", stated), *((title, list(runs.values()))
                                        for title, runs in results.by_change(leak_rate_per_s=None))]
    return sensitivity_table(
        "Sensitivity to what is assumed", ("law", "Value", *(QUANTITIES[name] for name in RMS),
                                          Column("energy", "10¹¹ J", ENERGY_UNIT)),
        [(title, [(LAWS[run.case.law].title, run.case.column, *(number_of(run, name) for name in (*RMS, ENERGY))) for run in runs])
         for title, runs in entries], RMS_NOTE)


TABLES = (partial(_table_3, CORRECTED), partial(_table_3, BY_RATE), _table_4, _implied, _inferred, _ranges,
          _laws_by_column, _divergence, _steps, _sensitivity)

"""liu2020's tables: Table 3 and Table 4 printed beside obtained, and what the stated and assumed values do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.files.numbers import exact, number
from workbench.paper.results import ResultTable

from ..laws import LAWS
from .cases import ALL_COLUMNS, SIGN_LAWS, TABLE_4_LAWS, TABLE_LAWS, Found
from .record import LiuStudy, Printed
from .runs import Outcome
from .steady import DAMPED, Implied, eigenvalues, implied, largest_step_s

RMS = ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps")
SIGNS = {"s_tilde_m": "s̃", "v_tilde_mps": "ṽ", "position_m": "s−s_d", "speed_mps": "v−v_d", "input_n": "u"}
UNITS = {"s_tilde_m": "m", "v_tilde_mps": "m/s", "position_m": "m", "speed_mps": "m/s", "input_n": "N"}
WITH_UNIT = {name: f"{sign} ({UNITS[name]})" for name, sign in SIGNS.items()}
ENERGY = "energy_both_J"
BOTH = tuple(text for name in RMS for text in (f"{WITH_UNIT[name]} printed", "obtained"))
RMS_NOTE = "RMS values; a dash: the run failed."


def all_tables(found: Found) -> tuple[ResultTable, ...]:
    """Every table of the study."""
    return (_table_3(found, "liu2020.corrected"), _table_3(found, "liu2020.corrected_rate"), _table_4(found),
            _implied(found), _inferred(found), _ranges(found), _laws_by_column(found), _divergence(found),
            _steps(found), _sensitivity(found))


def printed_at(study: LiuStudy, table: Printed, column: int, name: str) -> float:
    """A value of Table 3 for its column, or of Table 4 for the disturbance that Table 3 is run with."""
    index = column - 1 if table is study.table_3 else list(study.disturbances).index(study.runs.table_3_disturbance)
    return float(getattr(table, name)[index])


def _table_3(found: Found, law: str) -> ResultTable:
    rows = []
    for column in ALL_COLUMNS:
        outcome, printed = found.table_3(column, law), found.study.table_3
        cells = [exact(printed.energy[column - 1] / 1e11), _energy(outcome)]
        for name in RMS:
            cells += [exact(getattr(printed, name)[column - 1]), number(outcome.numbers.get(name))]
        rows.append((str(column), *cells))
    return ResultTable(
        f"Table 3, {LAWS[law].title}", "paper, Table 3",
        ("Value", "energy (10¹¹) printed", "obtained", *BOTH), tuple(rows),
        f"{RMS_NOTE} Energy obtained: the integral of |u v| in J, braking counted as positive.")


def _table_4(found: Found) -> ResultTable:
    rows = []
    for index, (key, push) in enumerate(found.study.disturbances.items()):
        outcomes = [found.table_4(key, law) for law in TABLE_4_LAWS]
        rows.append((push.title, "energy (10¹¹ J)", exact(found.study.table_4.energy[index] / 1e11),
                     *map(_energy, outcomes)))
        rows += [(push.title, WITH_UNIT[name], exact(getattr(found.study.table_4, name)[index]),
                  *(number(o.numbers.get(name)) for o in outcomes)) for name in RMS]
    return ResultTable(f"Table 4: Value {found.study.table_4_column} under three disturbances", "paper, Table 4",
                       ("disturbance", "of", "printed", *(LAWS[law].title for law in TABLE_4_LAWS)), tuple(rows),
                       f"{RMS_NOTE} Table 4 prints them in 10⁻⁵; they stand here in m and m/s.")


def _energy(outcome: Outcome) -> str:
    """Traction and braking in 10^11 J."""
    value = outcome.numbers.get(ENERGY)
    return number(None if value is None else value / 1e11)


def implied_columns(found: Found) -> list[tuple[str, Implied]]:
    """What every printed column implies, and where it is printed."""
    study = found.study
    printed = [(study.table_3, "Table 3", column) for column in ALL_COLUMNS]
    printed.append((study.table_4, "Table 4", study.table_4_column))
    return [(f"{name}, Value {column}", implied(study, column, *(printed_at(study, table, column, key) for key in (
        "s_tilde_m", "v_tilde_mps", "position_m")))) for table, name, column in printed]


def _implied(found: Found) -> ResultTable:
    rows = tuple((where, number(i.by_estimates), number(i.by_position), number(i.ratio), number(i.step_s))
                 for where, i in implied_columns(found))
    return ResultTable(
        "What the printed errors imply", "from Tables 2, 3 and 4, no run",
        ("printed in", "a by s̃, ṽ (m/s²)", "a by s−s_d (m/s²)", "ratio", "step (s)"), rows,
        "For a steady acceleration a with feedback alone, (12) as printed gives a = −k₂s̃ − k₃ṽ and (31) gives s_d − s "
        "= aM/(χk₄k₅); Euler steps of T add aT/2 to k₁s̃. All is applied to RMS values, which is near where the gains "
        "are high, Values 4 to 10.")


def _inferred(found: Found) -> ResultTable:
    study = found.study
    rows = []
    for outcome in found.inferred():
        column = outcome.case.column
        tables = [(study.table_3, f"{column}")]
        if column == study.table_4_column:
            tables = [(study.table_3, f"{column}, Table 3"), (study.table_4, f"{column}, Table 4")]
        for table, label in tables:
            cells: list[str] = []
            for name in RMS:
                value, printed = outcome.numbers.get(name), printed_at(study, table, column, name)
                cells += [number(printed), number(value), number(None if value is None else value / printed)]
            rows.append((label, *cells))
    header = (text for name in RMS for text in (f"{SIGNS[name]} printed", "obtained", "ratio"))
    return ResultTable(
        "Table 3 as its numbers imply it was computed", "paper, Table 3; inferred", ("Value", *header), tuple(rows),
        f"Feedback alone, k₃ṽ; {'; '.join(study.runs.inferred_changes)}. {RMS_NOTE} In m and m/s.")


def _ranges(found: Found) -> ResultTable:
    rows = []
    for figure, name in enumerate(SIGNS, start=14):
        printed = getattr(found.study.figure_ranges, name)
        for key, push in found.study.disturbances.items():
            numbers = found.table_4(key, "liu2020.corrected").numbers
            rows.append((f"Figure {figure}", WITH_UNIT[name], push.title, *map(number, printed),
                         number(numbers.get(f"{name}_min")), number(numbers.get(f"{name}_max"))))
    return ResultTable("Ranges of Figures 14 to 18", "paper, text to Figures 14 to 18",
                       ("figure", "shows", "disturbance", "printed from", "to", "obtained from", "to"), tuple(rows),
                       "Value 10, signs corrected. The rates of the reference follow from Figure 18's range; no other "
                       "value here was chosen by what is printed.")


def _laws_by_column(found: Found) -> ResultTable:
    rows: list[tuple[str, ...]] = []
    for name in RMS:
        rows.append((SIGNS[name], "printed in Table 3", *map(number, getattr(found.study.table_3, name))))
        rows += [(SIGNS[name], LAWS[law].title, *(
            number(found.table_3(column, law).numbers.get(name)) for column in ALL_COLUMNS)) for law in TABLE_LAWS]
    return ResultTable("RMS values of every law, Values 1 to 10", "paper, Table 3", ("error", "law", *map(
        str, ALL_COLUMNS)), tuple(rows), "In m and m/s. k₃ stands before ṽ, as (12) prints, unless said.")


def _divergence(found: Found) -> ResultTable:
    runs = found.study.runs
    rows = [(str(column), LAWS[law].title, *(_ended(found.divergence(column, law, rate))
                                             for rate in runs.divergence_leak_rates_per_s))
            for column in runs.divergence_columns for law in SIGN_LAWS if found.study.changes]
    return ResultTable(
        "What the printed signs do", "claims 19.leakage, 21.leakage, 32, 35",
        ("Value", "law", *(f"{rate:g} 1/s" for rate in runs.divergence_leak_rates_per_s)), tuple(rows),
        f"Columns: leak rate Γσ = αβ of all four estimates; {runs.divergence_change}. Cells: RMS of s−s_d in m, or "
        f"when the run diverged.")


def _ended(outcome: Outcome) -> str:
    return number(outcome.numbers["position_m"]) if outcome.failed is None else f"at {outcome.end_s:.0f} s"


def _steps(found: Found) -> ResultTable:
    rows = []
    for column in ALL_COLUMNS:
        cells = [str(column)]
        for damped in DAMPED:
            roots = eigenvalues(found.study, column, damped)
            cells += [_written(roots), number(largest_step_s(roots))]
        rows.append(tuple(cells))
    return ResultTable(
        "Eigenvalues of the observer, and the step beyond which Euler's rule diverges", "Table 2 in (12), (13)",
        ("Value", "k₃ṽ: eigenvalues (1/s)", "step (s)", "k₃s̃′: eigenvalues (1/s)", "step (s)"), tuple(rows),
        f"Without networks and robust terms. The runs take {found.study.sampling.period_s:g} s.")


def _written(roots: NDArray[np.complex128]) -> str:
    first, second = sorted(roots, key=lambda root: root.real)
    if abs(first.imag) > 0:
        return f"{number(first.real)} ± {number(abs(first.imag))}i"
    return f"{number(first.real)}, {number(second.real)}"


def _sensitivity(found: Found) -> ResultTable:
    study = found.study
    rows = [("as stated", *_measured(found.table_3(column, study.runs.sensitivity_law))) for column in _changed(found)]
    for place, change in enumerate(study.changes):
        rows += [(change.title, *_measured(outcome)) for outcome in found.change(place)]
    return ResultTable(
        "Sensitivity to what is assumed", "sensitivity",
        ("change", "law", "Value", *(WITH_UNIT[name] for name in RMS), "energy (10¹¹ J)"), tuple(rows), RMS_NOTE)


def _changed(found: Found) -> Sequence[int]:
    """The columns that the changes run with the law as stated."""
    study = found.study
    asked = {column for change in study.changes if change.law is None for column in change.columns}
    return sorted(asked | set(study.runs.sensitivity_columns))


def _measured(outcome: Outcome) -> list[str]:
    return [LAWS[outcome.case.law].title, str(outcome.case.column),
            *(number(outcome.numbers.get(name)) for name in RMS), _energy(outcome)]

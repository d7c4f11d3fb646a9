"""Which runs the study of liu2020 asks for, and where each of them is found again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..laws import LAWS
from .record import COLUMNS, LiuStudy
from .runs import Case, Outcome

ALL_COLUMNS = tuple(range(1, COLUMNS + 1))
# Laws that run through all columns of Table 2, those whose curves are drawn, and those of Table 4.
TABLE_LAWS = tuple(LAWS[f"liu2020.{name}"].id for name in (
    "corrected", "corrected_rate", "printed", "printed_rate", "feedback", "feedback_rate", "position_only_speed",
    "position_only"))
DRAWN_LAWS = ("liu2020.corrected", "liu2020.corrected_rate")
TABLE_4_LAWS = ("liu2020.corrected", "liu2020.corrected_rate", "liu2020.printed", "liu2020.feedback")
# Where the signs of (19), (21), (32) and (35) are wrong, one by one.
SIGN_LAWS = ("liu2020.printed", "liu2020.wrong_leakage", "liu2020.wrong_learning", "liu2020.corrected")


def table_3_case(study: LiuStudy, column: int, law: str) -> Case:
    """A column of Table 2 as Table 3 runs it."""
    return Case(column, law, study.runs.table_3_disturbance, drawn=law in DRAWN_LAWS)


def table_4_case(study: LiuStudy, disturbance: str, law: str) -> Case:
    """The column of Table 4 under one of its disturbances."""
    return Case(study.table_4_column, law, disturbance, drawn=law in DRAWN_LAWS)


def divergence_case(study: LiuStudy, column: int, law: str, leak_rate_per_s: float) -> Case:
    """A column under a leak rate, with the adaptation of `runs.divergence_change`."""
    number = [change.title for change in study.changes].index(study.runs.divergence_change)
    return Case(column, law, study.runs.table_3_disturbance, number, leak_rate_per_s=leak_rate_per_s)


def change_cases(study: LiuStudy, number: int) -> list[Case]:
    """The runs of a change of the assumed values."""
    change = study.changes[number]
    law = change.law or study.runs.sensitivity_law
    return [Case(column, law, study.runs.table_3_disturbance, number)
            for column in change.columns or study.runs.sensitivity_columns]


def cases(study: LiuStudy) -> list[Case]:
    """All runs, each once."""
    asked = [table_3_case(study, column, law) for law in TABLE_LAWS for column in ALL_COLUMNS]
    asked += [table_4_case(study, name, law) for law in TABLE_4_LAWS for name in study.disturbances]
    if study.changes:
        asked += [divergence_case(study, column, law, rate) for column in study.runs.divergence_columns
                  for law in SIGN_LAWS for rate in study.runs.divergence_leak_rates_per_s]
    asked += [case for number in range(len(study.changes)) for case in change_cases(study, number)]
    return list(dict.fromkeys(asked))


def title_of(study: LiuStudy, case: Case) -> str:
    """A run in words: law, column, and what is not as in Table 3."""
    words = [f"{case.law}, Value {case.column}"]
    if case.disturbance != study.runs.table_3_disturbance:
        words.append(study.disturbances[case.disturbance].title)
    if case.leak_rate_per_s is not None:
        words.append(f"leak rate {case.leak_rate_per_s:g} 1/s")
    if case.change >= 0:
        words.append(study.changes[case.change].title)
    return ", ".join(words)


@dataclass(frozen=True)
class Found:
    """The outcomes of all runs, by what was run."""

    study: LiuStudy
    outcomes: Mapping[Case, Outcome]

    def table_3(self, column: int, law: str) -> Outcome:
        """The run of a column of Table 3."""
        return self.outcomes[table_3_case(self.study, column, law)]

    def table_4(self, disturbance: str, law: str) -> Outcome:
        """The run of a column of Table 4."""
        return self.outcomes[table_4_case(self.study, disturbance, law)]

    def divergence(self, column: int, law: str, leak_rate_per_s: float) -> Outcome:
        """The run of a column under a leak rate."""
        return self.outcomes[divergence_case(self.study, column, law, leak_rate_per_s)]

    def change(self, number: int) -> list[Outcome]:
        """The runs of a change."""
        return [self.outcomes[case] for case in change_cases(self.study, number)]

    def inferred(self) -> list[Outcome]:
        """The runs of the changes under which the paper's numbers seem to have been computed."""
        return [outcome for number, change in enumerate(self.study.changes)
                if change.title in self.study.runs.inferred_changes for outcome in self.change(number)]

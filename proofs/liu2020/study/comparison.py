"""liu2020's trip under its laws and MPC alike: the same train, line and disturbances."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.paper.comparison import ComparedRun, Task, TripComparison
from workbench.paper.drivers import MPC_NAMES, MPC_TITLES, Drivers, keys_in
from workbench.paper.reproduced import STATED
from workbench.paper.trip_drive import TripDrive
from workbench.simulate.closed_loop import Run, Setting

from .. import plant
from ..laws import FEEDBACK_GAINS, LAWS
from ..simulation.trip import davis_newton, run_under, setting_of
from .record import LiuStudy
from .runs import COMPARED_LAWS, RunCase, left_out, run_cases

# What is held against MPC: the laws with their signs corrected, by speed and by the position alone.
LAW_NAMES = {law.rpartition(".")[2]: LAWS[law] for law in COMPARED_LAWS}
TOLD = {name: law.information for name, law in LAW_NAMES.items()}
ADAPTATION = ("gamma_f_per_s2", "alpha_1_per_s2", "gamma_v_n_per_m", "alpha_2_n_per_m", "kappa_1_mps", "kappa_2_mps")
FILTER = ("speed_filter_s",)


def places(study: LiuStudy) -> dict[str, str]:
    """The disturbances."""
    return {name: push.title for name, push in study.disturbances.items()}


def keys(study: LiuStudy, name: str) -> dict[str, str]:
    """The gains of Table 4's column, the adaptation's, and the filter of a law that differences positions."""
    gains = {key: f"gains.{key}.{study.table_4_column - 1}" for key in FEEDBACK_GAINS}
    return gains | keys_in("adaptation", ADAPTATION) | keys_in("sampling", FILTER if name == "position_only" else ())


def _law(study: LiuStudy, name: str, place: str, setting: Setting) -> Run:
    """A law with the gains of Table 4's column."""
    return run_under(LAW_NAMES[name], study, study.table_4_column, setting)


def _known(study: LiuStudy, _: Setting) -> tuple[float, tuple[float, float, float]]:
    """Mass and general resistance, chi among them, and neither slopes nor disturbances."""
    return study.train.mass_kg / study.train.chi, davis_newton(study.train)


def variants(study: LiuStudy, name: str) -> dict[str, LiuStudy]:
    """A law with the gains of Table 4's column and of the one before."""
    return {"": study} if name in MPC_NAMES else {
        value_words(column): study.model_copy(update={"table_4_column": column}) for column in study.compared_columns}


def value_words(column: int) -> str:
    """What follows a law's title with the gains of a column."""
    return f", Value {column}"


DRIVE = TripDrive(setting_of, _law, _known, plant.model())
# The last column of Table 2 with the signs corrected; the networks stay where the study puts them.
TRACK = DRIVE.tracking("corrected", lambda study: study.runs.table_3_disturbance)
DRIVERS = Drivers({name: law.title for name, law in LAW_NAMES.items()} | MPC_TITLES, places, keys, DRIVE.row, variants)


def drawn_runs(study: LiuStudy, runs: Sequence[ComparedRun]) -> tuple[list[ComparedRun], str]:
    """Those under Table 3's disturbance, of the laws as stated with the gains of Table 4's column alone."""
    chosen = [run for run in runs if run.task.place == study.runs.table_3_disturbance
              and run.task.variant in ("", value_words(study.table_4_column))]
    return chosen, study.disturbances[study.runs.table_3_disturbance].title


def own_cases(study: LiuStudy) -> dict[Task, RunCase]:
    """What the comparison need not run again: the study's own runs of the laws and columns that it compares."""
    names = {law.id: name for name, law in LAW_NAMES.items()}
    return {Task(case.disturbance, names[case.law], value_words(case.column)): case for case in run_cases(study)
            if case.law in COMPARED_LAWS and case.column in study.compared_columns
            and (case.change, case.leak_rate_per_s) == (STATED, None) and not left_out(study, case)}


COMPARISON = TripComparison(DRIVERS, "disturbance", lambda study: study.sampling.period_s, drawn_runs, TOLD,
                            own_cases=own_cases)

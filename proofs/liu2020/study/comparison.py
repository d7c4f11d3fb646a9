"""liu2020's trip under its laws and MPC alike: the same train, line and disturbances."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from workbench.mpc.controller import KINDS
from workbench.paper.comparison import ComparedRun, compared_row
from workbench.paper.drivers import MPC_NAMES, Drivers
from workbench.paper.mpc_comparison import known, run_mpc
from workbench.simulate.closed_loop import NOMINAL, Factors

from .. import plant
from ..laws import LAWS
from .record import FEEDBACK_GAINS, LiuStudy
from .scenario import davis_newton, run_under, setting_of

# What is held against MPC: the laws with their signs corrected, by speed and by the position alone.
LAW_NAMES = {"corrected": LAWS["liu2020.corrected"], "position_only": LAWS["liu2020.position_only"]}
TOLD = {name: law.information for name, law in LAW_NAMES.items()}
ADAPTATION = ("gamma_f_per_s2", "alpha_1_per_s2", "gamma_v_n_per_m", "alpha_2_n_per_m", "kappa_1_mps", "kappa_2_mps")


def places(study: LiuStudy) -> dict[str, str]:
    """The disturbances."""
    return {name: push.title for name, push in study.disturbances.items()}


def stated(study: LiuStudy, name: str) -> dict[str, float]:
    """The gains of Table 4's column, the adaptation's, and the filter of a law that differences positions."""
    values = {key: float(getattr(study.gains, key)[study.table_4_column - 1]) for key in FEEDBACK_GAINS}
    values |= {key: float(getattr(study.adaptation, key)) for key in ADAPTATION}
    return values | ({"speed_filter_s": study.sampling.speed_filter_s} if name == "position_only" else {})


def given(study: LiuStudy, name: str, values: Mapping[str, float]) -> LiuStudy:
    """The study with other gains in Table 4's column, adaptation or filter."""
    place = study.table_4_column - 1
    gains = {key: (*row[:place], values[key], *row[place + 1 :]) for key in FEEDBACK_GAINS if key in values
             for row in (getattr(study.gains, key),)}
    adaptation = {key: value for key, value in values.items() if key in ADAPTATION}
    sampling = {key: value for key, value in values.items() if key == "speed_filter_s"}
    return study.model_copy(update={"gains": study.gains.model_copy(update=gains),
                                    "adaptation": study.adaptation.model_copy(update=adaptation),
                                    "sampling": study.sampling.model_copy(update=sampling)})


def drive(study: LiuStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One trip under a disturbance, of a law with the gains of Table 4's column.

    MPC knows mass and general resistance, chi among them, and neither slopes nor disturbances; factors: by which the
    train's mass and general resistance differ from what controllers know.
    """
    setting = setting_of(study, place)
    a, b, c = (value * factor for value, factor in zip(
        setting.davis_n, (factors.davis_a, factors.davis_b, factors.davis_c), strict=True))
    setting = replace(setting, mass_kg=setting.mass_kg * factors.mass, davis_n=(a, b, c))
    if name in LAW_NAMES:
        run = run_under(LAW_NAMES[name], study, study.table_4_column, setting)
    else:
        assert study.mpc is not None
        nominal = known(study.mpc, setting.curve, study.train.mass_kg / study.train.chi, davis_newton(study.train),
                        setting.end_s)
        run = run_mpc(nominal, MPC_NAMES[name], setting, plant.model())
    return compared_row(run, study.line.length_m)


def variants(study: LiuStudy, name: str) -> dict[str, LiuStudy]:
    """A law with the gains of Table 4's column and of the one before."""
    columns = dict.fromkeys((study.table_4_column - 1 or 1, study.table_4_column))
    return {"": study} if name in MPC_NAMES else {
        value_words(column): study.model_copy(update={"table_4_column": column}) for column in columns}


def value_words(column: int) -> str:
    """What follows a law's title with the gains of a column."""
    return f", Value {column}"


DRIVERS = Drivers({name: law.title for name, law in LAW_NAMES.items()} | {
    name: KINDS[kind].title for name, kind in MPC_NAMES.items()}, places, stated, given, drive, variants)


def drawn_runs(study: LiuStudy, runs: Sequence[ComparedRun]) -> list[ComparedRun]:
    """Those under Table 3's disturbance, of the laws as stated with the gains of Table 4's column alone."""
    return [run for run in runs if run.task.place == study.runs.table_3_disturbance
            and run.task.variant in ("", value_words(study.table_4_column))]

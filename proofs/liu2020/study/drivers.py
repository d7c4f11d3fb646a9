"""liu2020's laws and MPC driven one by one: on drawn trains, and with one tuning budget."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from workbench.mpc.controller import KINDS
from workbench.paper.drivers import MPC_NAMES, Drivers
from workbench.paper.mpc_comparison import error_curve, known, run_beside
from workbench.simulate.closed_loop import NOMINAL, Factors, run_law
from workbench.simulate.metrics import measure_run

from ..laws import LAWS
from .record import FEEDBACK_GAINS, LiuStudy
from .runs import davis_newton, law_values, of_train, setting_of

# What stands beside MPC: the laws with their signs corrected, by speed and by the position alone.
LAW_NAMES = {"corrected": "liu2020.corrected", "position_only": "liu2020.position_only"}
ADAPTATION = ("gamma_f_per_s2", "alpha_1_per_s2", "gamma_v_n_per_m", "alpha_2_n_per_m", "kappa_1_mps", "kappa_2_mps")


def places(study: LiuStudy) -> tuple[str, ...]:
    """The disturbances."""
    return tuple(study.disturbances)


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


def drive_column(study: LiuStudy, controller: str, column: int | None, place: str, factors: Factors = NOMINAL,
                 ) -> tuple[dict[str, Any], dict[str, int]]:
    """A law with a column of gains, or an MPC's kind without one: its row and what it counted.

    MPC knows mass and general resistance, chi among them, and neither slopes nor disturbances; factors: by which the
    train's mass and general resistance differ from what controllers know.
    """
    setting, plant = setting_of(study, place), of_train.model()
    a, b, c = (value * factor for value, factor in zip(
        setting.davis_n, (factors.davis_a, factors.davis_b, factors.davis_c), strict=True))
    setting = replace(setting, mass_kg=setting.mass_kg * factors.mass, davis_n=(a, b, c))
    if column is not None:
        law = LAWS[controller]
        run = run_law(law, law_values(study, law, column), setting, study.sampling.period_s, "explicit", plant=plant)
    else:
        assert study.mpc is not None
        nominal = known(study.mpc, setting.curve, study.train.mass_kg / study.train.chi, davis_newton(study.train),
                        setting.end_s)
        run = run_beside(nominal, controller, setting, plant)
    return measure_run(run, study.line.length_m).row() | {"curve": error_curve(run)}, run.counters


def drive(study: LiuStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One trip under a disturbance."""
    if name in MPC_NAMES:
        return drive_column(study, MPC_NAMES[name], None, place, factors)[0]
    return drive_column(study, LAW_NAMES[name], study.table_4_column, place, factors)[0]


DRIVERS = Drivers({name: LAWS[law].title for name, law in LAW_NAMES.items()} | {
    name: KINDS[kind].title for name, kind in MPC_NAMES.items()}, places, stated, given, drive)

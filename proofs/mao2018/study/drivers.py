"""mao2018's laws and MPC driven one by one: on drawn trains, and with one tuning budget."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from workbench.mpc.controller import KINDS
from workbench.paper.drivers import MPC_NAMES, Drivers
from workbench.paper.mpc_comparison import error_curve, known, run_beside
from workbench.simulate.closed_loop import NOMINAL, Factors, Run, run_law
from workbench.simulate.metrics import measure_run

from .. import laws
from .numbers import setting_of, values_of
from .record import MaoStudy
from .runs import law_of

LAW = "law"
RATES = ("r_1_per_s", "r_2_per_s")
GAINS = ("gain", "gain_rho", "gain_rho_k", "gain_xi", "gain_lambda", "k_1", "k_2", "layer_mps")


def places(study: MaoStudy) -> tuple[str, ...]:
    """The cases, from 1."""
    return tuple(str(number) for number, _ in enumerate(study.cases, start=1))


def where(study: MaoStudy) -> dict[str, str]:
    """The cases in words."""
    return {str(number): f"case {number}, {case.title}" for number, case in enumerate(study.cases, start=1)}


def stated(study: MaoStudy, name: str) -> dict[str, float]:
    """What the laws of all cases share in the first tuning."""
    tuning = next(iter(study.tunings.values()))
    return {key: float(getattr(tuning, key)) for key in RATES} | {
        key: float(getattr(study.law, key)) for key in GAINS}


def given(study: MaoStudy, name: str, values: Mapping[str, float]) -> MaoStudy:
    """The study with other gains in its first tuning."""
    first, tuning = next(iter(study.tunings.items()))
    rates = {key: value for key, value in values.items() if key in RATES}
    others = {key: value for key, value in values.items() if key in GAINS}
    return study.model_copy(update={"tunings": study.tunings | {first: tuning.model_copy(update=rates)},
                                    "law": study.law.model_copy(update=others)})


def run_case(study: MaoStudy, name: str, case_number: int, factors: Factors = NOMINAL) -> Run:
    """A case under the law with its signs corrected or under MPC.

    MPC knows the healthy train in its first mode, and neither later modes nor failures; factors: by which the train's
    mass and resistance differ from what controllers know.
    """
    case, tuning = study.cases[case_number - 1], next(iter(study.tunings.values()))
    nominal = setting_of(study, case, tuning)
    changes = nominal.changes.copy()
    changes[:, 1:4] *= (factors.davis_a, factors.davis_b, factors.davis_c)
    setting = replace(nominal, mass_kg=nominal.mass_kg * factors.mass, changes=changes)
    if name == LAW:
        law = law_of(case, () if case.law == "healthy" else laws.KINDS[case.law][-1])
        return run_law(law, values_of(law, study, case, tuning), setting, tuning.period_s, study.law.estimates,
                       plant=laws.train)
    assert study.mpc is not None
    a, b, c = (float(value) for value in nominal.changes[0, 1:4])
    return run_beside(known(study.mpc, nominal.curve, nominal.mass_kg, (a, b, c), nominal.end_s), MPC_NAMES[name],
                      setting, laws.train)


def row_of(study: MaoStudy, run: Run) -> dict[str, Any]:
    """A run's row with the keys of a comparison, and its error over time."""
    return measure_run(run, float(study.reference.curve().length_m)).row() | {"curve": error_curve(run)}


def drive(study: MaoStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One run of a case."""
    return row_of(study, run_case(study, name, int(place), factors))


DRIVERS = Drivers({LAW: "signs corrected"} | {name: KINDS[kind].title for name, kind in MPC_NAMES.items()},
                  places, stated, given, drive)

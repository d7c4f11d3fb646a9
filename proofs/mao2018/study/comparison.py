"""mao2018's cases under law and MPC alike: the same train, modes, disturbances and failed motor."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.mpc.controller import KINDS
from workbench.paper.comparison import ComparedRun, Task, TripComparison
from workbench.paper.drivers import MPC_TITLES, Drivers, keys_in
from workbench.paper.trip_drive import TripDrive
from workbench.simulate.closed_loop import Run, Setting

from ..plant import train
from ..simulation.trip import law_of, run_under, setting_of, wrong_signs
from .record import MaoStudy
from .runs import MaoResults

LAW = "law"
RATES = ("r_1_per_s", "r_2_per_s")
GAINS = ("gain", "gain_rho", "gain_rho_k", "gain_xi", "gain_lambda", "k_1", "k_2", "layer_mps")


def places(study: MaoStudy) -> dict[str, str]:
    """The cases, from 1."""
    return {str(number): f"case {number}, {case.title}" for number, case in enumerate(study.cases, start=1)}


def keys(study: MaoStudy, name: str) -> dict[str, str]:
    """What the laws of all cases share in the first tuning."""
    return keys_in(f"tunings.{next(iter(study.tunings))}", RATES) | keys_in("law", GAINS)


def _setting(study: MaoStudy, place: str) -> Setting:
    return setting_of(study, study.cases[int(place) - 1], next(iter(study.tunings.values())))


def _law(study: MaoStudy, name: str, place: str, setting: Setting) -> Run:
    """The law of a case with its signs corrected, in the first tuning."""
    case, tuning = study.cases[int(place) - 1], next(iter(study.tunings.values()))
    return run_under(law_of(case, wrong_signs(case)), study, case, tuning, setting)


def _known(_: MaoStudy, setting: Setting) -> tuple[float, tuple[float, float, float]]:
    """The healthy train in its first mode, and neither later modes nor failures."""
    a, b, c = (float(value) for value in setting.changes[0, 1:4])
    return setting.mass_kg, (a, b, c)


def variants(study: MaoStudy, name: str) -> dict[str, MaoStudy]:
    """Of MPC as the file says; the law's stated runs are the study's own, see `with_own_runs`."""
    return {} if name == LAW else {"": study}


DRIVE = TripDrive(_setting, _law, _known, train)
TRACK = DRIVE.tracking(LAW, lambda study: "1")  # the healthy train
DRIVERS = Drivers({LAW: "signs corrected"} | MPC_TITLES, places, keys, DRIVE.row, variants)


def with_own_runs(results: MaoResults, others: Sequence[ComparedRun]) -> list[ComparedRun]:
    """The runs of the comparison with the study's own of its first tuning, case by case; none without others."""
    own = []
    for number in results.numbers if others else ():
        chosen = {"the law": results.corrected(number, results.first_tuning)}
        if results.wrong(number):
            chosen = {"as printed": results.printed(number, results.first_tuning),
                      DRIVERS.titles[LAW]: results.corrected(number, results.first_tuning)}
        own += [ComparedRun(Task(str(number), LAW), title, run.compared) for title, run in chosen.items()]
    return sorted((*own, *others), key=lambda run: (int(run.task.place), run.task.tuned))


def note(study: MaoStudy) -> str:
    """Who knows what."""
    return (f"The laws: {next(iter(study.tunings.values())).title}, full state, parameters unknown, times of the modes "
            f"and frequencies of the failure known. MPC: {KINDS['mpc.offset_free'].information}, that of mode (i) with "
            "all motors healthy.")


def drawn_runs(study: MaoStudy, runs: Sequence[ComparedRun]) -> tuple[list[ComparedRun], str]:
    """Those in the first case of the tuning."""
    case = study.tuning.places[0] if study.tuning else ""
    return [run for run in runs if run.task.place == case], f"case {case}"


COMPARISON = TripComparison(DRIVERS, "case", lambda study: next(iter(study.tunings.values())).period_s, drawn_runs,
                            note=note, with_own=with_own_runs)

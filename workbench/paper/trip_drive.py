"""How the laws of a paper and MPC drive its trip: one declaration for comparison, tuning and tracking."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.drivers import MPC_NAMES
from workbench.paper.mpc_comparison import differing, known, run_mpc
from workbench.paper.tracked import Tracked, of_run
from workbench.paper.trip_run import error_curve
from workbench.simulate.closed_loop import NOMINAL, Factors, Run, Setting
from workbench.simulate.metrics import measure_run
from workbench.trains.train import Plant

Track = Callable[[Any, DesiredCurve | None], Tracked]


@dataclass(frozen=True)
class TripDrive:
    """setting(study, place): what a run happens in; law(study, name, place, setting): a law's run in it.

    known(study, setting): mass (kg) and Davis coefficients (N, N s/m, N s^2/m^2) of the train as MPC knows it, beside
    the setting's curve and the limits that the file states.
    """

    setting: Callable[[Any, str], Setting]
    law: Callable[[Any, str, str, Setting], Run]
    known: Callable[[Any, Setting], tuple[float, tuple[float, float, float]]]
    plant: Plant

    def run(self, study: Any, name: str, place: str, factors: Factors = NOMINAL) -> Run:
        """The run of a controller on a train whose mass and resistance differ by factors from what controllers know."""
        nominal = self.setting(study, place)
        setting = differing(nominal, factors)
        if name not in MPC_NAMES:
            return self.law(study, name, place, setting)
        of_mpc = known(study.mpc, nominal.curve, *self.known(study, nominal), nominal.end_s)
        return run_mpc(of_mpc, MPC_NAMES[name], setting, self.plant)

    def row(self, study: Any, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
        """What `Drivers.drive` is: its metrics, what was counted, its position error over time."""
        run = self.run(study, name, place, factors)
        return measure_run(run, self.setting(study, place).curve.length_m).row() | {"curve": error_curve(run)}

    def tracking(self, name: str, place: Callable[[Any], str]) -> Track:
        """What `Reproduction.track` is: a law in a place, on a curve that is given until its end, or on the study's."""
        return partial(_track, self, name, place)


def _track(drive: TripDrive, name: str, place: Callable[[Any], str], study: Any, curve: DesiredCurve | None) -> Tracked:
    setting = drive.setting(study, place(study))
    if curve:
        setting = replace(setting, curve=curve, end_s=curve.trip_time_s)
    return of_run(study.paper, drive.law(study, name, place(study), setting), setting.curve)

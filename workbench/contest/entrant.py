"""What a contest needs of a law that does not fit a scenario's loop as it is: how it is run in a setting."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from workbench.errors import InputError
from workbench.simulate.closed_loop import Run, Setting
from workbench.simulate.metrics import measure_run
from workbench.trains.scenario import ControllerSpec, Scenario

Values = dict[str, float]


@dataclass(frozen=True)
class Played:
    """A run, of a law that learns its last trial, and of every finished trial the RMS of position (m) and speed (m/s).

    trials is empty for a law that does not learn from trial to trial.
    """

    run: Run
    trials: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class Entrant:
    """A law beside those of a scenario.

    parameters: all that a file must give, positive numbers; counts: those among them that are whole numbers; signed:
    those that need not be positive; predicts: it may be told of the actuator. play(scenario, spec, setting) runs it; a
    law that learns is told the noise of the setting's seed in its first trial and of the following seeds in the others.
    """

    title: str
    information: str
    parameters: tuple[str, ...]
    play: Callable[[Scenario, ControllerSpec, Setting], Played]
    counts: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()
    learns: bool = False
    predicts: bool = False

    def check(self, spec: ControllerSpec, where: str) -> None:
        """Raise InputError for parameters that are missing, unknown or unfit."""
        for key, given in (("initial", spec.initial), ("neurons", spec.neurons)):
            if given:
                raise InputError("", f"{where}.{key}", f"'{spec.law}' has none in a contest: remove it")
        if spec.predictor and not self.predicts:
            raise InputError("", f"{where}.predictor", f"'{spec.law}' runs by itself and has none: remove it")
        for key in self.parameters:
            if key not in spec.parameters:
                raise InputError("", f"{where}.parameters", f"'{key}' is missing: add it")
        for key, value in spec.parameters.items():
            if key not in self.parameters:
                raise InputError("", f"{where}.parameters", f"unknown '{key}': choose among "
                                 f"{', '.join(self.parameters)}")
            if key not in self.signed and not value > 0:
                raise InputError("", f"{where}.parameters.{key}", f"{value:g} must be positive: correct it")
            if key in self.counts and not (value == int(value) and value <= 1000):
                raise InputError("", f"{where}.parameters.{key}",
                                 f"{value:g} is no whole number up to 1000: correct it")


def trial_errors(run: Run, length_m: float) -> tuple[float, float] | None:
    """RMS of position (m) and speed (m/s) of a trial, None of one that failed."""
    found = measure_run(run, length_m)
    return None if run.failed or not math.isfinite(found.position_rms) else (found.position_rms, found.speed_rms)


def played_trials(numbers: Iterable[int], drive: Callable[[int, Setting], Run], setting: Setting, length_m: float
                  ) -> Played:
    """A law that learns, trial by trial: drive(number, setting) with each trial's own noise, see `Entrant`.

    The run is that of the last trial; one that fails ends them and says its number.
    """
    errors: list[tuple[float, float]] = []
    run: Run | None = None
    for later, number in enumerate(numbers):
        sensing = replace(setting.sensing, seed=setting.sensing.seed + later)
        run = drive(number, replace(setting, sensing=sensing))
        found = trial_errors(run, length_m)
        if found is None:
            return Played(replace(run, failed=f"trial {number}: {run.failed}"), tuple(errors))
        errors.append(found)
    assert run is not None, "there is at least one trial"
    return Played(run, tuple(errors))

"""What a run happens in: the train as it truly is, its line, its actuator, and what controllers are told."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from workbench.model.desired_curve import DesiredCurve
from workbench.model.events import failure_rows, mode_rows
from workbench.model.sensing import PERFECT, Instruments, Sensing
from workbench.simulate.ride import SpeedLimits
from workbench.trains.actuator import Actuator, Known
from workbench.trains.scenario import Scenario
from workbench.trains.track import ResistanceTable, resistance_table, speed_limits

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Factors:
    """How the true train and line differ from the nominal ones that controllers may know; 1 is nominal."""

    mass: float = 1.0
    davis_a: float = 1.0
    davis_b: float = 1.0
    davis_c: float = 1.0
    line_resistance: float = 1.0
    odometer_scale: float = 1.0


NOMINAL = Factors()


NO_ERRORS = Instruments()
# A line without grade, curve or tunnel.
LEVEL = ResistanceTable(np.zeros(1), np.zeros(1))
UNLIMITED = (np.inf, np.inf, np.inf)


@dataclass(frozen=True)
class Setting:
    """What a run happens in, in the units of its names.

    davis_n: the train's Davis coefficients in N, N s/m, N s^2/m^2; terms, failures, changes: rows of `push_rows`,
    `failure_rows` and `mode_rows`; limits: traction force (N), braking force (N), power (W). The nominal mass turns
    commands in m/s^2 into forces; the true one is mass_kg. plant_values: of a plant's parameters beyond these. known:
    the train as controllers know it, for a predictor; the nominal mass and these Davis coefficients unless given.
    """

    curve: DesiredCurve
    mass_kg: float
    nominal_mass_kg: float
    davis_n: tuple[float, float, float]
    plant_step_s: float
    end_s: float
    log_every_s: float
    position_band_m: float
    initial_position_m: float = 0.0
    limits: tuple[float, float, float] = UNLIMITED
    line: ResistanceTable = LEVEL
    terms: Array = field(default_factory=lambda: np.zeros((0, 7)))
    failures: Array = field(default_factory=lambda: np.zeros((0, 7)))
    changes: Array = field(default_factory=lambda: np.zeros((0, 5)))
    plant_values: tuple[float, ...] = ()
    sensing: Sensing = PERFECT
    actuator: Actuator | None = None
    known: Known | None = None
    speed_limits: SpeedLimits = field(default_factory=SpeedLimits)

    def plan(self, period_s: float) -> tuple[int, int, float, int]:
        """Steps in all, steps a sample, seconds a step, steps a row of the log."""
        step = self.plant_step_s
        return (round(self.end_s / step), round(period_s / step), step, max(1, round(self.log_every_s / step)))


def setting_of(scenario: Scenario, factors: Factors = NOMINAL, nominal: Setting | None = None) -> Setting:
    """What a scenario states of its runs, for a train and line that differ from the nominal ones by `factors`.

    nominal: the scenario's own setting, from which the curve and the line are taken where many others are made.
    """
    curve, train, simulation = (nominal.curve if nominal else scenario.desired_curve()), scenario.train, \
        scenario.simulation
    table = nominal.line if nominal else resistance_table(scenario.track, train.length_m)
    of_davis = (factors.davis_a, factors.davis_b, factors.davis_c)
    a, b, c = (value * factor for value, factor in zip(train.davis_newton, of_davis, strict=True))
    return Setting(
        curve=curve, mass_kg=train.mass_kg * factors.mass, nominal_mass_kg=train.mass_kg, davis_n=(a, b, c),
        plant_step_s=simulation.plant_step_s, end_s=curve.trip_time_s + simulation.dwell_s,
        log_every_s=simulation.log_every_s, position_band_m=simulation.position_band_m,
        initial_position_m=simulation.initial_position_m,
        limits=(train.max_traction_n, train.max_braking_n, train.max_power_w or np.inf),
        line=replace(table, specific_force=table.specific_force * factors.line_resistance),
        terms=scenario.disturbance.rows(), failures=failure_rows(scenario.failures),
        changes=mode_rows(scenario.modes, train.mass_kg, of_davis),
        speed_limits=nominal.speed_limits if nominal else SpeedLimits(*speed_limits(scenario.track)),
        actuator=scenario.actuator,
        sensing=(scenario.sensing or NO_ERRORS).sensing(factors.odometer_scale),
        known=Known(train.mass_kg, train.davis_newton),
    )

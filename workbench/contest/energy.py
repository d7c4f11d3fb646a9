"""The least energy of any run over the scenario's line in the same time: what contestants are held against."""

from __future__ import annotations

from typing import TYPE_CHECKING

from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.inputs.files import from_track
from workbench.optimal.inputs.line import course
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.scenario import Scenario

if TYPE_CHECKING:
    from workbench.optimal.reference import Reference

# Of the desired curve's highest speed: the bound holds for all runs that are no faster.
FASTEST = 1.2


def best_run(scenario: Scenario) -> Reference | None:
    """The energy-optimal run of the nominal train in the desired curve's time, at the wheel, nothing returned.

    None where the train cannot make it in that time.
    """
    from workbench.optimal.reference import find_reference  # noqa: PLC0415 - cvxpy, which no other match needs

    train, curve = scenario.train, scenario.desired_curve()
    top = float(curve.at(curve.breaks_s)[1].max()) * FASTEST
    vehicle = Vehicle(scenario.name, train.mass_kg, train.davis_newton,
                      ForceLimit(train.max_traction_n, train.max_power_w or float("inf")), ForceLimit(0.0),
                      train.max_braking_n, max_speed_mps=top,
                      length_m=train.length_m or 0.0)
    try:
        return find_reference(vehicle, _course(scenario, vehicle), curve.trip_time_s)
    except InfeasibleRunError:
        return None


def _course(scenario: Scenario, vehicle: Vehicle) -> Course:
    line, _ = from_track(scenario.track.model_copy(update={"speed_limit": (), "stops_m": None}))
    return course(line, vehicle)

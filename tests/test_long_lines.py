"""Lines far longer than any mesh is fine: what a train can do on them does not depend on the mesh."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError, _slope_in_parts, fastest
from workbench.optimal.force_limits import device_limits
from workbench.optimal.grid import graded_grid
from workbench.optimal.inputs.line import Line, course
from workbench.optimal.vehicle import ForceLimit, Vehicle


def meshed(line: Line, train: Vehicle) -> Course:
    whole = course(line, train)
    return whole.split(graded_grid(whole, 200).position_m[1:-1])


def vehicle(traction_n: float) -> Vehicle:
    return Vehicle("train", 2e5, (6e4, 800.0, 32.0), ForceLimit(traction_n), friction_brake_n=2.4e5)


@pytest.mark.parametrize("length_m", [5e3, 1e5, 2e7])
def test_a_level_line_of_any_length_is_driven_at_its_limit(length_m: float) -> None:
    line = Line("level", length_m, (0.0, length_m), ((0.0, 20.0),))
    train = vehicle(2e5)
    run = fastest(train, meshed(line, train))
    assert np.isclose(run.trip_time_s, length_m / 20.0, rtol=0.02 if length_m > 5e4 else 0.2)


def test_a_line_too_steep_is_refused_where_it_begins_to_be() -> None:
    line = Line("steep", 2e6, (0.0, 2e6), ((0.0, 20.0),), ((0.0, 0.0), (1e6, 80.0)))
    train = vehicle(1.2e5)
    with pytest.raises(InfeasibleRunError, match="cannot climb beyond 10"):
        fastest(train, meshed(line, train))


@pytest.mark.parametrize("length_m", [1e5, 4e5])
def test_a_cell_of_many_kilometres_is_driven_in_parts_of_metres(length_m: float) -> None:
    """On a climb of 100 kN traction leaves 40 kN: at 800 v + 32 v^2 = 40 kN all cells of any length end."""
    train = vehicle(2e5)
    numbers = np.array([train.inertia_kg, *train.davis_n, 0.0, np.inf, np.inf])
    slope = _slope_in_parts(10.0, 1e4, length_m, 1.0, np.full(2, 1e5), np.zeros(2), numbers, *device_limits(train))
    balance = (-800.0 + np.sqrt(800.0**2 + 4 * 32.0 * 4e4)) / (2 * 32.0)
    assert np.sqrt(2 * (10.0 + length_m * slope)) == pytest.approx(balance, rel=1e-6)

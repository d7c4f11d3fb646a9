"""jiao2025 in the contest: its trips by the equations of the paper, with plain numbers."""

import math
from dataclasses import replace

import numpy as np
import pytest

from workbench.contest.entrants import play
from workbench.contest.matches import with_parameters
from workbench.contest.record import Contest
from workbench.model.sensing import Sensing
from workbench.simulate.closed_loop import Setting, run_law, setting_of
from workbench.simulate.controllers import held_command
from workbench.trains.scenario import Scenario

SHORT_S = 40.0


@pytest.fixture(scope="module")
def scenario(contest: Contest) -> Scenario:
    """With few trips a run."""
    return with_parameters(contest.world, "jiao2025", {"trials": 3.0})


def short(scenario: Scenario) -> Setting:
    return replace(setting_of(scenario), end_s=SHORT_S, sensing=Sensing(seed=3))


def test_the_first_trip_is_that_of_a_constant_command(scenario: Scenario) -> None:
    spec = scenario.controllers["jiao2025"]
    setting = short(scenario)
    held = np.array([spec.parameters["unit_mps2"] * spec.parameters["first_input"]])
    empty = np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0))
    run = run_law(held_command, (held, *empty), setting, spec.period_s)
    position = math.sqrt(run.totals["position_error_square_sum"] / run.totals["samples"])
    assert play(scenario, "jiao2025", setting).trials[0][0] == pytest.approx(position, rel=1e-12)


def test_the_second_trip_moves_inputs_as_14_says(scenario: Scenario) -> None:
    """In trial 1 the estimate is still the first one, so that u(k,1) - u(k,0) = rho phi/(lambda + phi^2) e(k+1,0)."""
    of = with_parameters(scenario, "jiao2025", {"trials": 1.0})
    p = of.controllers["jiao2025"].parameters
    setting = replace(short(of), log_every_s=0.1)
    first = run_law(held_command, (np.array([p["unit_mps2"] * p["first_input"]]), np.zeros(0), np.zeros((0, 0)),
                                   np.zeros((0, 0))), setting, 0.1)
    error = setting.curve.at(first.column("t_s"))[1] - first.column("v_mps")
    gain = p["rho"] * p["first_estimate"] / (p["lamda"] + p["first_estimate"] ** 2)
    wanted = p["unit_mps2"] * (p["first_input"] + gain * error[1:])
    assert play(of, "jiao2025", setting).run.column("u_mps2")[:-1] == pytest.approx(wanted, rel=1e-9)

"""The bound that a tube needs, against trains that are drawn and pushed as far as they can be."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import PROOFS

from workbench.cli.loading import load
from workbench.contest.matches import play_match, with_parameters
from workbench.contest.premises import lacks, unknown_of
from workbench.errors import InputError
from workbench.model.desired_curve import start_cruise_stop
from workbench.mpc.controller import MpcController
from workbench.mpc.disturbance import Unknown, largest_bound, largest_disturbance, needed_bound
from workbench.mpc.preview import preview
from workbench.mpc.problem import Problem, Weights
from workbench.mpc.tube import tube
from workbench.trains.track import ResistanceTable

DAVIS = (0.3, 4e-3, 1.6e-4)
LINE = ResistanceTable(np.array([0.0, 500.0, 900.0, 905.0]), np.array([0.02, -0.05, 0.11, 0.0]))
PROBLEM = Problem(horizon=20, period_s=0.1, davis=DAVIS, lowest_command_mps2=-1.2, highest_command_mps2=1.0,
                  weights=Weights(25.0, 14.8, 4.34), band_m=0.2, terminal_speed_mps=25.0)
AHEAD = preview(PROBLEM, start_cruise_stop(2200.0, 25.0, 0.3, 0.5, 8.0), 110.0)
SHARE = st.floats(-1.0, 1.0)


@settings(max_examples=200, deadline=None)
@given(st.floats(0.0, 0.4), st.tuples(SHARE, SHARE, SHARE), st.tuples(SHARE, SHARE, SHARE, SHARE), st.booleans(),
       st.integers(0, len(AHEAD) - 2), st.floats(0.0, 1.0))
def test_no_train_within_the_spread_is_pushed_by_more(spread, factors, errors, failed, row, between):
    """w typed again from the two equations of motion, in newtons."""
    unknown = Unknown(LINE, spread, 0.03, 0.1, 0.05)
    largest = (0.2, 0.1, 0.15)
    bound = largest_disturbance(PROBLEM, AHEAD, unknown, *largest)
    mass = 2e5 * (1 + spread * factors[0])
    position = AHEAD[row, 0] + between * (AHEAD[row + 1, 0] - AHEAD[row, 0]) + largest[0] * errors[0]
    v = AHEAD[row, 1] + between * (AHEAD[row + 1, 1] - AHEAD[row, 1]) + largest[1] * errors[1]
    u = AHEAD[row, 3] + largest[2] * errors[2]
    resisted = DAVIS[0] + DAVIS[1] * v + DAVIS[2] * v * v
    force = 2e5 * (0.9 * u + 0.05 if failed else u)
    opposing = mass * (1 + spread * factors[2]) * float(LINE.at(np.array([position]))[0]) + mass * 0.03 * errors[3]
    true = (force - 2e5 * (1 + spread * factors[1]) * resisted - opposing) / mass
    assert abs(true - (u - resisted)) <= bound + 1e-12


def test_the_bound_is_reached_by_a_train_at_a_corner():
    """On the level the steepest stretch of the curve and the lightest or heaviest train of least or most resistance."""
    level = Unknown(ResistanceTable(np.zeros(1), np.zeros(1)), 0.1)
    u, v = AHEAD[:-1, 3], AHEAD[:-1, 1]
    resisted = DAVIS[0] + DAVIS[1] * v + DAVIS[2] * v**2
    reached = max(np.abs(u / m - f * resisted / m - u + resisted).max() for m in (0.9, 1.1) for f in (0.9, 1.1))
    assert largest_disturbance(PROBLEM, AHEAD, level) == pytest.approx(reached, rel=5e-3)
    assert largest_disturbance(PROBLEM, AHEAD, level) >= reached


def test_a_nominal_train_is_pushed_by_line_and_gusts_alone():
    assert largest_disturbance(PROBLEM, AHEAD, Unknown(LINE, gust_mps2=0.02)) == pytest.approx(0.13)
    assert needed_bound(PROBLEM, AHEAD, Unknown(LINE, gust_mps2=0.02)) == pytest.approx(0.13, rel=2e-3)


@pytest.mark.parametrize("spread", [0.0, 0.05, 0.1])
def test_a_needed_bound_covers_what_its_own_tube_lets_the_feedback_do(spread):
    unknown = Unknown(LINE, spread)
    bound = needed_bound(PROBLEM, AHEAD, unknown)
    around = tube(PROBLEM, AHEAD, bound, PROBLEM.band_m)
    again = largest_disturbance(PROBLEM, AHEAD, unknown, around.position_m, around.speed_mps, around.command_mps2)
    assert again <= bound <= 1.01 * again


def test_a_feedback_that_disturbs_another_train_by_more_than_it_helps_has_no_bound():
    assert needed_bound(PROBLEM, AHEAD, Unknown(LINE, 0.6)) == np.inf


def test_the_largest_bound_is_on_the_edge_of_the_premises():
    edge = largest_bound(PROBLEM, AHEAD)
    assert tube(PROBLEM, AHEAD, edge, PROBLEM.band_m).holds
    assert not tube(PROBLEM, AHEAD, edge * 1.002, PROBLEM.band_m).holds
    assert largest_bound(PROBLEM, AHEAD, start_m=0.3) == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("changes", [{"spread": 1.0}, {"spread": -0.1}, {"gust_mps2": np.inf}, {"failed_share": 1.0}])
def test_an_unknown_that_cannot_be_is_refused(changes):
    with pytest.raises(InputError, match="correct them"):
        Unknown(LINE, **changes)


def test_yang2021s_bound_covers_its_drawn_trains_and_they_stay_in_the_tube():
    """The stated bound of the shipped contest: its premises hold, and draws keep to the tube that follows."""
    contest = load(PROOFS / "yang2021" / "contest.toml").record
    scenario, condition = contest.world, contest.conditions["ten"]
    made = MpcController(scenario, scenario.controllers["mpc_tube"], "mpc_tube")
    around = made.tracker.around
    needed = needed_bound(made.problem, made.ahead, unknown_of(scenario, condition))
    assert lacks(scenario, condition, around, needed) == ""
    assert needed <= around.disturbance_mps2 <= largest_bound(made.problem, made.ahead)
    for draw in range(2):
        run = play_match(scenario, "mpc_tube", condition, draw, contest.seed).run
        assert run.counters["beyond_bound"] == run.counters["premises_failed"] == 0
        assert max(run.totals["position_error_max"], -run.totals["position_error_min"]) < around.position_m < 0.2
    small = with_parameters(scenario, "mpc_tube", {"disturbance_mps2": 0.06})
    tight = MpcController(small, small.controllers["mpc_tube"], "mpc_tube").tracker.around
    assert "the bound is too small" in lacks(small, condition, tight, needed)
    noisy = condition.model_copy(update={"speed_noise_mps": 0.01, "command_delay_s": 0.1})
    assert lacks(scenario, noisy, around, needed) == "noise is no part of it; delays are no part of it"

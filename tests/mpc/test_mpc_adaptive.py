"""Adaptive MPC learns the train that it drives from what it measures, and follows better for it."""

import numpy as np
import pytest
from contests import common

from workbench.contest.entrants import play
from workbench.contest.matches import _levelled
from workbench.errors import InputError
from workbench.mpc.adaptive import TrainEstimator
from workbench.mpc.controller import MpcController
from workbench.simulate.closed_loop import Factors, setting_of
from workbench.simulate.metrics import measure

DAVIS = (0.03, 4e-4, 4e-5)


def estimated(gain, davis, push, noise=0.0, seconds=300):
    """An estimator after so many equations of a train that starts, cruises and brakes again and again."""
    generator, of = np.random.default_rng(2), TrainEstimator(DAVIS, 0.995)
    for k in range(seconds):
        command, speed = 0.6 * np.sin(k / 9.0), 10 + 6 * np.sin(k / 40.0)
        speed_square = speed**2
        acceleration = gain * command - (davis[0] + davis[1] * speed + davis[2] * speed_square) + push(k)
        of.learn(acceleration + noise * generator.normal(), command, speed, speed_square)
    return of


def test_mass_is_found_without_noise_and_with_noise_and_grades():
    assert estimated(1 / 1.2, tuple(c / 1.2 for c in DAVIS), lambda k: 0.0).gain == pytest.approx(1 / 1.2, rel=0.02)
    with_grades = estimated(1 / 1.2, DAVIS, lambda k: 0.15 if 100 < k < 160 else 0.0, noise=0.03)
    assert with_grades.gain == pytest.approx(1 / 1.2, rel=0.05)


def test_a_nominal_train_stays_nominal_and_davis_never_becomes_negative():
    same = estimated(1.0, DAVIS, lambda k: 0.0)
    assert [same.gain, *same.davis, same.push] == pytest.approx([1.0, *DAVIS, 0.0], abs=1e-9)
    assert min(estimated(1.0, (0.0, 0.0, 0.0), lambda k: 0.2, noise=0.3).davis) >= 0.0


@pytest.mark.parametrize("forgetting", [0.5, 1.01, -1.0])
def test_a_forgetting_that_forgets_all_is_refused(forgetting):
    with pytest.raises(InputError, match=r"forgetting: .* is outside 0\.9 to 1"):
        TrainEstimator(DAVIS, forgetting)


def test_a_train_of_a_fifth_more_mass_is_followed_better_than_by_the_nominal_model():
    """On the level, where mass and resistance alone are unknown; the estimate is within 5 per cent of the true mass."""
    world = common().world
    spec = world.controllers["mpc_nonlinear"].model_copy(update={"predictor": False})
    adaptive = spec.model_copy(update={"law": "mpc.adaptive", "parameters": spec.parameters | {"forgetting": 0.995}})
    world = world.model_copy(update={"actuator": None, "track": _levelled(world),
                                     "controllers": {"nominal": spec, "adaptive": adaptive}})
    heavy = setting_of(world, Factors(mass=1.2))
    nominal, learned = (measure(play(world, name, heavy).run, world) for name in ("nominal", "adaptive"))
    assert learned.failed is None
    assert learned.position_rms < nominal.position_rms / 5
    assert learned.speed_rms < nominal.speed_rms / 2
    controller = MpcController(world, adaptive, "adaptive")
    assert controller.tracker.estimator.gain == 1.0, "it knows the nominal train alone when it starts"


def test_behind_an_actuator_that_it_is_told_of_a_heavier_train_is_followed_better_too():
    """It learns from what is measured and from the force that has come through lag and delay, not from its commands."""
    world = common().world
    spec = world.controllers["mpc_nonlinear"].model_copy(update={"predictor": True})
    adaptive = spec.model_copy(update={"law": "mpc.adaptive", "parameters": spec.parameters | {"forgetting": 0.995}})
    world = world.model_copy(update={"track": _levelled(world), "controllers": {"nominal": spec, "adaptive": adaptive}})
    assert world.actuator is not None and world.actuator.delay_s > 0 and world.actuator.lag_s > 0
    heavy = setting_of(world, Factors(mass=1.2))
    nominal, learned = (measure(play(world, name, heavy).run, world) for name in ("nominal", "adaptive"))
    assert learned.failed is None
    assert learned.position_rms < nominal.position_rms / 5
    assert learned.speed_rms < nominal.speed_rms / 2

"""chen2019 in a contest: one car of it against the law typed again, and what its memory has for a sample."""

import math
from dataclasses import replace

import numpy as np
import pytest

from proofs.chen2019 import contest as chen2019
from workbench.contest.entrants import play
from workbench.contest.matches import with_parameters
from workbench.contest.record import Contest
from workbench.model.sensing import Sensing
from workbench.simulate.closed_loop import setting_of


def test_one_car_without_learning_is_a_plain_backstepping_law(contest: Contest) -> None:
    """(9), (10), (12), (16) typed again; with next to no learning gains and mass bounds that meet."""
    name, mass, scenario = "chen2019", 5e4, contest.world
    still = {key: 1e-12 for key in scenario.controllers[name].parameters if key.startswith("gamma")}
    of = with_parameters(scenario, name, still | {"trials": 1.0, "m_low_kg": mass, "m_high_kg": mass})
    p = of.controllers[name].parameters
    setting = replace(setting_of(of), log_every_s=0.005, end_s=10.0, sensing=Sensing(seed=3))
    log = play(of, name, setting).run
    t, s, v, u = (log.column(key) for key in ("t_s", "s_m", "v_mps", "u_mps2"))
    x, xdot, xddot = setting.curve.at(t)
    lam1 = lam2 = accel = 0.0
    c1, c2, c3, T = p["c_1"], p["c_2"], p["c_3"], 0.005
    most = mass / of.train.mass_kg * np.array([-of.train.max_braking_n, of.train.max_traction_n])
    for k in range(len(t)):
        if k:
            accel += (1 - math.exp(-T / p["tau"])) * ((v[k] - v[k - 1]) / T - accel)
        alpha, alpha_dot = -c1 * (s[k] - x[k]), -c1 * (v[k] - xdot[k])
        z1 = s[k] - x[k] - lam1
        mu = -(c2 * (v[k] - xdot[k] - alpha) + accel - xddot[k] - alpha_dot + z1) / c3 + mass * accel
        assert u[k] == pytest.approx(mu / mass, rel=1e-6, abs=1e-6)
        lost = float(np.clip(mu, *most)) - mu
        lam1, lam2 = lam1 + T * (lam2 - c1 * lam1), lam2 + T * (c3 * lost - c2 * lam2)


def test_the_room_of_a_sample_is_what_its_source_says() -> None:
    assert chen2019.STEP.count(f"- {chen2019.ROOM}") == 1

"""lee2010: desired rates against finite differences, the recovery from upside down against the published example."""

import numpy as np
import pytest
import sympy as sp
from scenarios import PROOFS

from proofs.lee2010 import laws, plant
from workbench.paper.loading import load
from workbench.simulate.plants.run import run

AT_REST = [0.0] * 3
GIVEN = [*plant.quadrotor.states, *laws.x_d, *laws.v_d, *laws.a_d, *laws.j_d, *laws.GAINS, *laws.MODEL]
GAINS = [69.44, 24.304, 8.81, 2.54]
MODEL = [*plant.quadrotor.values().values()]


def rotation(of):
    """Rodrigues' formula for a rotation vector."""
    angle = np.linalg.norm(of)
    n = of / angle
    skew = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def test_the_desired_angular_velocity_is_how_the_desired_attitude_turns():
    """Both rates that the law feeds forward, by central differences along the plant under the law's own thrust."""
    wanted = sp.lambdify(GIVEN, [laws.R_d, laws.W_d, laws.W_d_rate, laws.thrust], cse=True)
    generator = np.random.default_rng(1)

    def along(state, reference, step):
        """State and desired motion a small step on, to second order in what they are made of."""
        def rates(y):
            thrust = wanted(*y[:18], *y[18:], *GAINS, *MODEL)[3]
            return np.concatenate([plant.quadrotor.rates_at(y[:18], [thrust, *torques]), y[21:30], AT_REST])
        y = np.concatenate([state, reference])
        middle = y + step / 2 * rates(y)
        return y + step * rates(middle)

    for _ in range(3):
        torques = generator.normal(size=3)
        state = np.concatenate([generator.normal(size=6), rotation(generator.normal(size=3)).ravel(),
                                generator.normal(size=3)])
        reference = generator.normal(size=12)
        step = 1e-4
        before, now, after = (wanted(*along(state, reference, one), *GAINS, *MODEL) for one in (-step, 0.0, step))
        skew = now[0].T @ (after[0] - before[0]) / (2 * step)
        assert now[1].ravel() == pytest.approx([skew[2, 1], skew[0, 2], skew[1, 0]], abs=1e-4)
        assert now[2].ravel() == pytest.approx(((after[1] - before[1]) / (2 * step)).ravel(), rel=1e-4, abs=1e-3)


def test_it_recovers_from_upside_down_as_the_published_example_does():
    """There the error function falls below one after about 0.88 s, from 1.995; at first the thrust is negative."""
    study = load(PROOFS / "lee2010").study
    found = run(study.setting, study.entrants()["geometric"], study.setting.parameters)
    states = np.column_stack([found.column(str(symbol)) for symbol in plant.quadrotor.states])
    attitudes = states[:, 6:15].reshape(-1, 3, 3)
    desired = sp.lambdify(GIVEN, laws.R_d, cse=True)
    psi = np.array([(3 - np.trace(desired(*state, *[0.0] * 12, *GAINS, *MODEL).T @ attitude)) / 2
                    for state, attitude in zip(states, attitudes, strict=True)])
    assert psi[0] == pytest.approx(1.995)
    # The start is known by psi alone, to three decimals; near half a turn errors grow as e^(3.1 t).
    assert found.column("t_s")[np.argmax(psi < 1)] == pytest.approx(0.88, abs=0.06)
    assert found.column("f")[0] < 0 < found.column("f")[-1]
    assert np.max(np.abs(states[-1, :3])) < 1e-3
    assert np.max(np.abs(attitudes[-1].T @ attitudes[-1] - np.eye(3))) < 1e-6

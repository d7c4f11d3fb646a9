"""The regulator behind every MPC's horizon: python-control's own to the bit, and optimal."""

import control
import numpy as np
import pytest

from workbench.mpc.lqr import dlqr


@pytest.mark.parametrize("together", [False, True])
@pytest.mark.parametrize(("states", "inputs"), [(2, 1), (3, 1), (12, 6)])
def test_gain_and_cost_are_python_controls_to_the_bit(states, inputs, together):
    draw = np.random.default_rng(states)
    for _ in range(10):
        A, B = draw.normal(size=(states, states)) / states, draw.normal(size=(states, inputs))
        whole = draw.normal(size=(states + inputs,) * 2)
        whole = whole @ whole.T  # so that the weights have a sense together
        Q, R, N = whole[:states, :states], whole[states:, states:], whole[:states, states:]
        weights = ((Q + Q.T) / 2, (R + R.T) / 2, *([N] if together else []))
        gain, cost = dlqr(A, B, *weights)
        expected, riccati, _ = control.dlqr(A, B, *weights)
        assert gain.tobytes() == np.asarray(expected).tobytes()
        assert cost.tobytes() == np.asarray(riccati).tobytes()
        # No other feedback costs less from any state: the cost of a nearby one is at least that of this one.
        for _ in range(3):
            other = gain + 1e-3 * draw.normal(size=gain.shape)
            closed, step = A - B @ other, np.vstack((np.eye(states), -other))
            rate = step.T @ np.block([[Q, N if together else 0 * N], [(N if together else 0 * N).T, R]]) @ step
            total = np.zeros_like(A)
            for _ in range(400):
                total = rate + closed.T @ total @ closed
            assert np.linalg.eigvalsh(total - cost).min() >= -1e-9 * np.abs(cost).max()


def test_a_system_that_cannot_be_steered_has_none():
    with pytest.raises((ValueError, np.linalg.LinAlgError)):
        dlqr(2.0 * np.eye(2), np.zeros((2, 1)), np.eye(2), np.eye(1))

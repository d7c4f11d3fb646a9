"""Functions above a table of speed and force: what a cone program may know of it, and how near they come."""

import numpy as np
import pytest
from hypothesis import given, settings
from optimal_instances import limits

from workbench.optimal.force_majorants import NEAR, majorants
from workbench.optimal.vehicle import ForceLimit

TOP_MPS = 40.0


def least(limit, speeds):
    """The least of all functions at speeds."""
    return np.min([a + b / speeds + c * speeds + d * speeds**2 for a, b, c, d in majorants(limit, TOP_MPS)], axis=0)


@settings(max_examples=10)  # of some 70 linear programs each
@given(limits(3e5))
def test_no_function_promises_less_than_the_train_has_and_none_binds_what_is_relaxed(limit):
    speeds = np.linspace(1.0, TOP_MPS, 300)
    force = np.array([limit.at(v) for v in speeds])
    if limit.table:
        assert (least(limit, speeds) >= 0.97 * force).all()  # between speeds at which it is held above
        bends = np.array([v for v, _ in limit.table if 1.0 <= v <= TOP_MPS])
        assert (least(limit, bends) >= np.array([limit.at(v) for v in bends]) * (1 - 1e-6)).all()
        assert all(beta >= 0 >= gamma for _, beta, gamma, _ in majorants(limit, TOP_MPS))
    else:
        assert majorants(limit, TOP_MPS) == ()


@pytest.mark.parametrize("table", [
    ((0.0, 2e5), (20.0, 1.6e5), (40.0, 0.6e5)),  # concave over the speed
    tuple((v, 3e6 / max(v, 15.0)) for v in (0.0, 15.0, *range(16, 41))),  # points of a power
    ((0.0, 1e5), (40.0, 2e5)),  # it rises
], ids=["concave", "power", "rising"])
def test_curves_without_dips_are_met_at_every_speed(table):
    limit, speeds = ForceLimit(3e5, table=table), np.linspace(1.0, TOP_MPS, 300)
    force = np.array([limit.at(v) for v in speeds])
    assert least(limit, speeds) == pytest.approx(force, rel=2 * NEAR + 1e-3)


def test_a_dip_is_filled_no_further_than_functions_of_the_three_terms_must():
    limit, speeds = ForceLimit(2e5, table=((0.0, 2e5), (10.0, 1e5), (15.0, 1e5), (20.0, 1.5e5), (40.0, 1e5))), (
        np.linspace(1.0, TOP_MPS, 300))
    above = least(limit, speeds) / np.array([limit.at(v) for v in speeds]) - 1
    hull = np.interp(speeds, [0.0, 20.0, 40.0], [2e5, 1.5e5, 1e5]) / np.array([limit.at(v) for v in speeds]) - 1
    assert above.max() < hull.max() / 2

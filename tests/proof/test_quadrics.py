"""Points of spheres and other quadrics are rational, exact, and found where a statement fails on them alone."""

import numpy as np
import pytest
import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal, less
from workbench.proof.decide.quadrics import on_quadrics
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.decide.sampling import tidy_fraction, trial_columns

a, b, c, d, w, x, y, z = sp.symbols("a b c d w x y z", real=True)
UNIT = equal(w**2 + x**2 + y**2 + z**2, 1)
SPHERES = {
    "a unit quaternion": ((UNIT,), 7),
    "a small sphere": ((equal(x**2 / 2 + y**2 + z**2, sp.Rational(1, 10000)),), 2),
    "a hyperbola that is turned": ((equal(x * y - y**2, 3),), 1),
    "two circles": ((equal(a**2 + b**2, 1), equal(c**2 + d**2, 4)), 2),
    "a circle, and what follows from it": ((equal(a**2 + b**2, 25), equal(c, a - 2 * b)), 2),
}


@pytest.mark.parametrize("name", SPHERES)
def test_points_that_are_drawn_meet_the_equalities_exactly(name):
    given, enough = SPHERES[name]
    goal = Goal((at_least(w + a + x, 0),), given)
    family = on_quadrics(goal)
    chosen = trial_columns(family.free, 60, np.random.default_rng(1))
    points = [family.exact({s: tidy_fraction(float(column[row])) for s, column in chosen.items()}) for row in range(60)]
    found = {tuple(sorted(point.items())) for point in points if point is not None}
    assert len(found) >= enough
    for point in found:
        values = {s: sp.Rational(v.numerator, v.denominator) for s in goal.symbols() for v in [dict(point)[str(s)]]}
        assert all(sp.expand(relation.margin.xreplace(values)) == 0 for relation in given)


@pytest.mark.parametrize("given", [
    (equal(x**2 + y**2, 3),),  # no rational point
    (equal(x**2 + y**2, -1),),
    (equal(x**3 + y**2, 1),),
    (equal(x**2 + y**2, sp.sqrt(2)),),
    (equal(sp.sin(x) ** 2 + y**2, 1),),
    (),
])
def test_where_no_quadric_with_rational_points_is_there_nothing_is_drawn(given):
    assert on_quadrics(Goal((at_least(x + y, 0),), given)) is None


@pytest.mark.parametrize("goal", [
    # The thrust of a quadrotor beside the error of its attitude, beyond a quarter turn.
    Goal((at_most(1 - (1 - 2 * x**2 - 2 * y**2) ** 2, 4 * w**2 * (x**2 + y**2 + z**2)),), (UNIT,)),
    Goal((less(w * x + y * z, sp.Rational(49, 100)),), (UNIT,)),
    Goal((at_least(a * c + b * d, sp.Rational(-99, 100)),), (equal(a**2 + b**2, 1), equal(c**2 + d**2, 1))),
])
def test_what_fails_on_a_sphere_is_refuted_before_a_proof_is_sought(goal):
    found = find_counterexample(goal, "refuted", quick=True)
    assert found is not None
    assert "roots" not in found

"""What a search of gains says holds: none are excluded that exist, and none are given that break a declared sign."""

import pytest
import sympy as sp

from workbench.errors import InputError
from workbench.gains.problem import Problem
from workbench.gains.search import Infeasible, search
from workbench.proof.claim import at_least, at_most

x, y, k = sp.symbols("x y k", real=True)
xp, kp = sp.symbols("x k", positive=True)
MOTZKIN = x**4 * y**2 + x**2 * y**4 - 3 * x**2 * y**2 + 1  # is not negative, and no sum of squares whatever is added


@pytest.mark.parametrize("problem", [
    Problem("a:shifted", (k,), {"lower": at_least(MOTZKIN + k, 0), "upper": at_most(k, 0)}),  # k = 0 does
    Problem("a:least", (k,), {"lower": at_least(MOTZKIN - k, 0)}, minimise=-k),
])
def test_that_no_sum_of_squares_is_found_excludes_no_gains(problem):
    with pytest.raises(Infeasible, match=r"no values of k make the conditions sums of squares \(others may") as caught:
        search(problem)
    assert caught.value.certificate is None


def test_of_quadratic_forms_it_does():
    with pytest.raises(Infeasible, match="no values of k meet the conditions, shown by an exact") as caught:
        search(Problem("a:forms", (k,), {"one": at_least(k * x**2, 2 * x**2), "two": at_most(k * y**2, y**2)}))
    assert caught.value.certificate is not None


@pytest.mark.parametrize(("problem", "said"), [
    # 2 does for every positive x
    (Problem("a:state", (k,), {"a": at_least(k * xp, xp), "b": at_least(k * xp, 2 * xp)}),
     "x: is declared with a sign"),
    (Problem("a:unknown", (kp,), {"a": at_least(-kp * x**2, x**2)}), "k: is declared positive and is -"),
    (Problem("a:twice", (k,), {"a": at_least(k * xp**2, x**2)}), "x: names two symbols"),
    (Problem("a:both", (k,), {"a": at_least(k * x**2, kp * y**2)}), "k: names two symbols"),
])
def test_declared_signs_are_told_apart_from_conditions(problem, said):
    with pytest.raises(InputError, match=said):
        search(problem)

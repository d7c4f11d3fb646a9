"""Polynomial Lyapunov functions and barriers: found for problems of the literature, none where there is none."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from workbench.errors import InputError, SolverError
from workbench.gains.lyapunov import barrier_function, lyapunov_function
from workbench.proof.checker import check
from workbench.proof.obligation import expression

PROBLEMS = Path(__file__).parents[2] / "benchmarks" / "gains_problems" / "problems.json"
x, y, z = sp.symbols("x y z", real=True)


def accepted(certified):
    for certificate in certified.certificates.values():
        check(certificate)
    return certified.function


def values(expr, points):
    return sp.lambdify((x, y, z), expr, "numpy")(*points) + 0 * points[0]


def test_the_demo_of_sostools_has_a_quadratic_function_that_falls_everywhere():
    flow = {x: -x**3 - x*z**2, y: -y - x**2*y, z: -z - 3*z/(z**2 + 1) + 3*x**2*z}
    V = accepted(lyapunov_function("doe2026:V", flow))
    points = np.random.default_rng(3).normal(size=(3, 2_000)) * 3
    assert (values(V, points) >= (points**2).sum(axis=0) / 2 - 1e-9).all()
    rate = sum(sp.diff(V, s) * f for s, f in flow.items())
    assert (values(rate, points) <= 1e-9).all()


def test_a_region_and_a_rate_are_kept():
    V = accepted(lyapunov_function("doe2026:V", {x: -x + x*y, y: -y}, rate=Fraction(1), within=[1 - x**2 - y**2]))
    points = np.random.default_rng(3).uniform(-0.7, 0.7, size=(3, 2_000))
    rate = sp.diff(V, x) * (-x + x*y) - sp.diff(V, y) * y
    assert (values(rate + V, points) <= 1e-9).all()


def test_a_barrier_stands_between_the_initial_and_the_unsafe_set():
    flow = {x: -2*y, y: x**2}
    start, danger = sp.Rational(4, 25) - (x + 1)**2 - y**2, sp.Rational(4, 25) - x**2 - (y + 1)**2
    B = accepted(barrier_function("doe2026:B", flow, [start], [danger], degree=1))
    points = np.random.default_rng(3).uniform(-2, 2, size=(3, 4_000))
    assert (values(B, points)[values(start, points) >= 0] <= 0).all()
    assert (values(B, points)[values(danger, points) >= 0] >= 1).all()
    rate = sum(sp.diff(B, s) * f for s, f in flow.items())
    assert (values(rate, points) <= 1e-9).all()


def test_coefficients_that_cancel_are_rounded_together():
    flow = {x: y*z/2 - x, y: -x*z - y, z: x*y/3 - z}  # a x^2 + b y^2 + c z^2 falls where a/2 + c/3 = b alone
    V = accepted(lyapunov_function("doe2026:V", flow, rate=Fraction(1)))
    a, b, c = (V.coeff(s, 2) for s in (x, y, z))
    assert a / 2 + c / 3 == b


def test_a_region_around_a_point_of_rest_leaves_no_constant_to_squares():
    inside = sp.Rational(1, 4) - x**2 - y**2
    V = accepted(lyapunov_function("doe2026:V", {x: -y - 3*x**2/2 - x**3/2, y: 3*x - y}, within=[inside]))
    points = np.random.default_rng(3).uniform(-0.35, 0.35, size=(3, 2_000))
    rate = sp.diff(V, x) * (-y - 3*x**2/2 - x**3/2) + sp.diff(V, y) * (3*x - y)
    assert (values(rate, points) <= 1e-9).all()


def test_nothing_is_found_where_there_is_nothing():
    with pytest.raises(SolverError, match="no function of this degree"):
        lyapunov_function("doe2026:V", {x: x})
    with pytest.raises(SolverError, match="no function of this degree"):  # the plant attracts, a quadratic V does not
        lyapunov_function("doe2026:V", {x: -x + x*y, y: -y})
    with pytest.raises(SolverError, match="no function of this degree"):  # the motion leads from one set to the other
        barrier_function("doe2026:B", {x: sp.Integer(1)}, [sp.Rational(1, 4) - x**2], [1 - (x - 3)**2])


@pytest.mark.parametrize(("changed", "named"), [
    ({"degree": 3}, "degree"), ({"flow": {x: -x + z}}, "z"), ({"flow": {x: -x / (1 - x**2)}}, "positive")])
def test_what_is_no_such_problem_is_said_in_a_line(changed, named):
    with pytest.raises(InputError, match=named):
        lyapunov_function("doe2026:V", **({"flow": {x: -x}} | changed))


def test_the_problems_of_the_benchmark_can_be_read_and_name_their_source():
    problems = json.loads(PROBLEMS.read_text(encoding="utf-8"))
    assert len(problems) >= 20
    assert len({problem["name"] for problem in problems}) == len(problems)
    for problem in problems:
        assert problem["source"]
        assert problem["peer"]
        for part in ("within", "initial", "unsafe"):
            for text in problem.get(part, []):
                assert {str(s) for s in expression(text).free_symbols} <= set(problem["rates"])
        if problem["kind"] == "feedback":
            assert len(problem["A"]) == len(problem["B"]) == len(problem["radius"])

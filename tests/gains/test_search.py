"""Searches against theory: norms, rates, minima; what is refused, and how tampering is found out."""

import copy
from fractions import Fraction

import cvxpy as cp
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.errors import InputError, SolverError
from workbench.gains.exact import rational, simplest, solve_exactly, squares_of
from workbench.gains.frequency import Linear, abscissa, h_infinity_norm, linear, margins
from workbench.gains.problem import Problem
from workbench.gains.search import Infeasible, largest, search
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import D, at_least, at_most, equal

x, y, w = sp.symbols("x y w", real=True)
p, q, r, gain = sp.symbols("p q r gain", real=True)
V = p * x**2 + 2 * q * x * y + r * y**2
OSCILLATOR = {x: y, y: -x - y}


def decay_problem(flow, rate):
    conditions = {"positive": at_least(V, x**2 + y**2), "decay": at_most(D(V), -2 * rational(Fraction(rate)) * V)}
    return Problem("test:decay", (p, q, r), conditions, flow)


def gain_problem(flow, output=x):
    conditions = {"storage": at_least(V, 0), "gain": at_most(D(V), gain * w**2 - output**2)}
    return Problem("test:gain", (p, q, r, gain), conditions, flow, minimise=gain)


# --- answers against theory ---------------------------------------------------------------------------------------


def test_the_certified_gain_is_the_h_infinity_norm():
    found = search(gain_problem({x: y, y: -x - y + w}))
    norm = h_infinity_norm(linear({x: y, y: -x - y + w}, [w], [x], {}))
    assert norm**2 <= float(found.objective) * (1 + 1e-6)
    assert float(found.objective) == pytest.approx(norm**2, rel=1e-3)
    assert norm == pytest.approx(2 / 3**0.5, rel=1e-6)  # 1/sqrt(1 - (1/2)^2) over the damping 1/2


@settings(max_examples=12)
@given(st.integers(1, 40), st.integers(1, 40))
def test_the_certified_gain_is_never_below_the_norm(stiffness, damping):
    flow = {x: y, y: -sp.Rational(stiffness, 10) * x - sp.Rational(damping, 10) * y + w}
    found = search(gain_problem(flow))
    assert float(found.objective) >= h_infinity_norm(linear(flow, [w], [x], {})) ** 2 * (1 - 1e-6)
    check(found.certificate)


def test_the_largest_decay_rate_is_that_of_the_slowest_pole():
    rate, found = largest(lambda a: decay_problem(OSCILLATOR, a), Fraction(0), Fraction(2))
    assert float(rate) == pytest.approx(-abscissa(linear(OSCILLATOR, [], [], {})), rel=5e-3)
    assert float(rate) <= 0.5
    check(found.certificate)


def test_a_polynomial_has_its_least_value_proved():
    found = search(Problem("test:least", (p,), {"bound": at_least(x**4 - 3 * x**2 + x, p)}, minimise=-p))
    true = min(np.polyval([1, 0, -3, 1, 0], np.linspace(-2, 2, 400_001)))
    assert float(found.values[p]) == pytest.approx(true, abs=2e-3)
    assert float(found.values[p]) <= true + 1e-9


def test_a_region_is_used():
    problem = Problem("test:region", (p,), {"bound": at_most(x**3 - x, p)}, where=(at_most(x**2, 1),), minimise=p)
    found = search(problem)
    assert float(found.values[p]) == pytest.approx(2 / 27**0.5, rel=1e-3)
    assert any("assume" in factor for term in found.certificate["proofs"][0]["terms"] for factor in term["factors"])


def test_scales_of_eight_decades_are_borne():
    flow = {x: 100000 * y, y: -x / 1000 - 10 * y + w}
    problem = gain_problem(flow)
    scaled = Problem(problem.id, problem.unknowns, problem.conditions, flow, minimise=gain, scales={
        y: Fraction(1, 10000), w: Fraction(1, 1000), gain: Fraction(10**6)})
    norm = h_infinity_norm(linear(flow, [w], [x], {}))
    assert float(search(scaled).objective) == pytest.approx(norm**2, rel=1e-2)


# --- what is refused ----------------------------------------------------------------------------------------------


def test_an_unstable_system_is_refused_with_an_exact_certificate_that_names_the_families():
    with pytest.raises(Infeasible, match=r"'decay' \(\d+%\), 'positive' \(\d+%\) contradict") as caught:
        search(decay_problem({x: y, y: -x + y / 10}, "1/10"))
    assert caught.value.certificate is not None
    check(caught.value.certificate)
    assert set(caught.value.shares) == {"decay", "positive"}


def test_a_family_that_has_no_part_in_the_contradiction_is_not_blamed():
    problem = decay_problem({x: y, y: -x + y / 10}, "1/10")
    more = Problem(problem.id, problem.unknowns, {**problem.conditions, "harmless": at_most(p, 10**6)}, problem.flow)
    with pytest.raises(Infeasible) as caught:
        search(more)
    assert "harmless" not in caught.value.shares


def test_a_refusal_can_be_checked_point_by_point():
    """The weights of the conditions at the listed points cancel every unknown: computed here by sympy alone."""
    with pytest.raises(Infeasible) as caught:
        search(decay_problem({x: y, y: -x + y / 10}, "1/10"))
    rate = sp.diff(V, x) * y + sp.diff(V, y) * (-x + y / 10)
    margins_of = {"positive": V - x**2 - y**2, "decay": -rate - V / 5}
    total = 0
    for entry in caught.value.certificate["points"]:
        at = {s: sum(sp.Rational(c) for c, e in zip(entry["point"], entry["basis"], strict=True) if e[i])
              for i, s in enumerate((x, y))}
        assert sp.Rational(entry["weight"]) > 0
        total += sp.Rational(entry["weight"]) * margins_of[entry["family"]].subs(at)
    assert sp.expand(total).is_Rational
    assert sp.expand(total) < 0


@pytest.mark.parametrize("status", ["optimal_inaccurate", "user_limit", "infeasible_inaccurate"])
def test_an_inaccurate_status_is_never_feasible(monkeypatch, status):
    monkeypatch.setattr(cp.Problem, "status", property(lambda self: status))
    with pytest.raises(SolverError, match=status):
        search(decay_problem(OSCILLATOR, "1/10"))


def test_an_optimal_status_with_wrong_numbers_is_found_out(monkeypatch):
    honest = cp.Problem.solve

    def spoiled(self, **options):
        honest(self, **options)
        for variable in self.variables():
            if variable.shape == (2, 2):
                variable.save_value(variable.value + 0.01)

    monkeypatch.setattr(cp.Problem, "solve", spoiled)
    with pytest.raises(SolverError, match="residual"):
        search(decay_problem(OSCILLATOR, "1/10"))


def test_a_refusal_with_a_wrong_dual_is_found_out(monkeypatch):
    honest = cp.Problem.solve

    def spoiled(self, **options):
        honest(self, **options)
        for constraint in self.constraints:
            if isinstance(constraint, cp.constraints.PSD):
                constraint.dual_variables[0].save_value(constraint.dual_value + np.array([[0.1, 0.0], [0.0, -0.05]]))

    monkeypatch.setattr(cp.Problem, "solve", spoiled)
    with pytest.raises(SolverError, match="dual leaves a residual"):
        search(decay_problem({x: y, y: -x + y / 10}, "1/10"))


MISTAKES = [
    ({"a": at_least(p * q * x**2, 0)}, (), "product or power"),
    ({"a": at_least(p * x**2 + sp.Float(0.5), 0)}, (), "exact numbers"),
    ({"a": at_least(p / x, 1)}, (), "no polynomial"),
    ({"a": at_least(sp.exp(x), p)}, (), "no polynomial"),
    ({"a": equal(p * x, 0)}, (), "at_most or at_least"),
    ({}, (), "there are none"),
    ({"a": at_least(p * x**2, 1), "b": at_most(x - x, 0)}, (), "b: says 0 >= 0 whatever the unknowns"),
    ({"a": at_least(x**2, p)}, (at_most(p * x, 1),), "mentions an unknown"),
    ({"a": at_least(p + sum(s**6 for s in sp.symbols("s_1:9")), 0)}, (), "Gram matrix|too many"),
]


@pytest.mark.parametrize(("conditions", "where", "match"), MISTAKES)
def test_what_is_no_such_problem_is_one_line_with_a_remedy(conditions, where, match):
    with pytest.raises(InputError, match=match) as caught:
        search(Problem("test:mistake", (p, q), conditions, where=where))
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("test:mistake: ")


def test_odd_terms_that_no_square_makes_are_named():
    with pytest.raises(SolverError, match=r"'?odd_one'?.* no square"):
        search(Problem("test:odd", (p,), {"fine": at_least(p * y**2, 0), "odd_one": at_least(x**3 + p * y**2, 0)}))


def test_an_objective_without_bound_is_said():
    with pytest.raises(SolverError, match="no least value"):
        search(Problem("test:unbounded", (p,), {"a": at_least(p * x**2, 0)}, minimise=-p))


# --- tampering ----------------------------------------------------------------------------------------------------


def tampered(certificate, change):
    broken = copy.deepcopy(certificate)
    change(broken)
    return broken


CHANGES = [
    lambda c: c["goal"].update(show=[c["goal"]["show"][0], c["goal"]["show"][1].replace("D(", "2*D(", 1)]),
    lambda c: c["goal"]["flow"].update(y="-x - y/2"),
    lambda c: c["proofs"][0]["terms"][0].update(coefficient="17/31"),
    lambda c: c["proofs"][1]["terms"].pop(),
    lambda c: c["proofs"].pop(),
]


@pytest.mark.parametrize("change", CHANGES)
def test_a_tampered_certificate_is_refused(change):
    found = search(decay_problem(OSCILLATOR, "1/4"))
    check(found.certificate)
    with pytest.raises(CertificateError):
        check(tampered(found.certificate, change))


# --- exact arithmetic ---------------------------------------------------------------------------------------------

numbers = st.fractions(min_value=-5, max_value=5, max_denominator=12)


@given(st.lists(st.lists(numbers, min_size=3, max_size=3), min_size=1, max_size=4))
def test_what_is_a_sum_of_squares_is_factored_exactly(rows):
    matrix = [[sum((row[i] * row[j] for row in rows), Fraction(0)) for j in range(3)] for i in range(3)]
    squares = squares_of(matrix)
    assert squares is not None
    assert all(pivot > 0 for pivot, _ in squares)
    assert [[sum((d * v[i] * v[j] for d, v in squares), Fraction(0)) for j in range(3)] for i in range(3)] == matrix


@given(st.lists(numbers, min_size=6, max_size=6))
def test_what_is_not_positive_semidefinite_has_no_squares(entries):
    a, b, c, d, e, f = entries
    matrix = [[a, b, c], [b, d, e], [c, e, f]]
    least = np.linalg.eigvalsh(np.array(matrix, dtype=float))[0]
    if abs(least) > 1e-9:
        assert (squares_of(matrix) is not None) == (least > 0)


@given(st.floats(min_value=1e-6, max_value=1e6), st.sampled_from([1e-1, 1e-4, 1e-9]))
def test_simple_rationals_are_near_and_simple(value, tolerance):
    found = simplest(value, tolerance)
    assert abs(float(found) - value) <= tolerance * value * (1 + 1e-6)
    assert simplest(-value, tolerance) == -found
    assert found.denominator <= 1 + 1 / (tolerance * value)


def test_equations_are_solved_exactly():
    matrix = [[Fraction(1), Fraction(2)], [Fraction(2), Fraction(4)]]
    assert solve_exactly(matrix, [Fraction(3), Fraction(6)]) == [Fraction(3), Fraction(0)]
    assert solve_exactly(matrix, [Fraction(3), Fraction(7)]) is None


def test_margins_of_an_integrator_with_a_lag():
    loop = Linear(np.array([[0.0, 1.0], [0.0, -1.0]]), np.array([[0.0], [1.0]]), np.array([[1.0, 0.0]]),
                  np.zeros((1, 1)))
    gain_margin, phase_margin, crossover = margins(loop)
    assert gain_margin == float("inf")
    assert crossover == pytest.approx(0.7861513, rel=1e-4)  # w^2 (1 + w^2) = 1
    assert phase_margin == pytest.approx(90 - np.degrees(np.arctan(crossover)), abs=1e-3)

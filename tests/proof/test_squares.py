"""Which inequalities the decider of sums of squares finds, that it finds no false one, and that it finds them alike."""

import json
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume as suppose
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.proof.checker import check
from workbench.proof.claim import Goal, at_least, at_most, differ, equal, greater, less
from workbench.proof.decide import conic
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.method import method_of
from workbench.proof.decide.refute import find_example
from workbench.proof.decide.rounding import simplest, weighted_squares
from workbench.proof.decide.squares import find_squares
from workbench.proof.text import assumptions, goal_text

x, y, z, u, v, w, b, c, d, s = sp.symbols("x y z u v w b c d s", real=True)
p, q, r, k, k1, k2 = sp.symbols("p q r k k1 k2", positive=True)
n, m = sp.symbols("n m", nonnegative=True)
R = sp.Rational
FEW = settings(max_examples=12)


def certificate(goal):
    """A checked certificate by sums of squares alone, or None when one relation is not found."""
    proofs = [find_squares(goal, shown, assumptions(goal)) for shown in goal.show]
    if None in proofs:
        return None
    found = {"version": 1, "verdict": "proved", "goal": goal_text(goal), "example": find_example(goal),
             "proofs": proofs}
    check(found)
    return found


def quadratic(matrix, state):
    return sp.expand((sp.Matrix(state).T * matrix * sp.Matrix(state))[0])


def decay(rows, lyapunov, rate):
    """x^T (A^T P + P A) x <= -rate x^T P x for all x."""
    A, P = sp.Matrix(rows), sp.Matrix(lyapunov)
    state = [x, y, z, u, v][:A.rows]
    return Goal((at_most(quadratic(A.T * P + P * A, state), -rate * quadratic(P, state)),))


UNCONSTRAINED = {
    "a square": Goal((at_least(x**2 + y**2, 2 * x * y),)),
    "Motzkin": Goal((at_least(x**4 * y**2 + x**2 * y**4 + 1, 3 * x**2 * y**2),)),
    "Robinson": Goal((at_least(x**6 + y**6 + 1 + 3 * x**2 * y**2,
                               x**4 * y**2 + x**4 + x**2 * y**4 + y**4 + x**2 + y**2),)),
    "Choi and Lam": Goal((at_least(x**2 * y**2 + y**2 * z**2 + z**2 * x**2 + 1, 4 * x * y * z),)),
    "means of three positive numbers": Goal((at_least(p**3 + q**3 + r**3, 3 * p * q * r),)),
    "means of four numbers": Goal((at_least(x**4 + y**4 + z**4 + w**4, 4 * x * y * z * w),)),
    "Schur": Goal((at_least(p * (p - q) * (p - r) + q * (q - p) * (q - r) + r * (r - p) * (r - q), 0),)),
    "Cauchy": Goal((at_most((x * u + y * v + z * w)**2, (x**2 + y**2 + z**2) * (u**2 + v**2 + w**2)),)),
    "touching in irrational points": Goal((at_least(sp.expand((x**2 + y - 11)**2 + (x + y**2 - 7)**2), 0),)),
    "nearly touching": Goal((greater(4 * x**2 - R(21, 10) * x**4 + x**6 / 3 + x * y - 4 * y**2 + 4 * y**4,
                                     -R(10317, 10000)),)),
    "a cubic of a non-negative number": Goal((at_least(n**3 + 4, 3 * n**2),)),
    "coefficients from tiny to huge": Goal((at_least(10**10 * x**2 + 19 * x * y + R(1, 10**8) * y**2, 0),)),
    "two terms at their maximum": Goal((at_most(-k1 * z**2 * x**2 + b * z * x - k2 * z**2 * x**4 + c * z * x**2,
                                                b**2 / (4 * k1) + c**2 / (4 * k2)),)),
    "a disturbance and Young": Goal((at_most(-k * z**2 - k1 * w**2 + k1 * w * s, -k * z**2 - k1 * w**2 / 2
                                             + k1 * s**2 / 2),)),
}
RATIONAL = {
    "one over more than one": Goal((at_most(1 / (1 + x**2), 1),)),
    "strictly below": Goal((less(x / (1 + x**2), R(3, 5)),)),
    "a denominator with complex roots": Goal((at_most(x / (1 + x**2 + x**4), R(3, 5)),)),
    "Nesbitt": Goal((at_least(p / (q + r) + q / (p + r) + r / (p + q), R(3, 2)),)),
    "four shares": Goal((at_least(p / (q + r + k) + q / (r + k + p) + r / (k + p + q) + k / (p + q + r), R(4, 3)),)),
    "a barrier": Goal((at_most(x * y / (p**2 - x**2) - k * x**2 / (p**2 - x**2)**2, y**2 / (4 * k)),),
                      (greater(p**2 - x**2, 0),)),
    "a denominator that is not zero": Goal((at_least(x**2 + 1 / x**2, 2),), (differ(x, 0),)),
    "a denominator that is negative": Goal((at_most(x + 1 / x, -2),), (greater(-x, 0),)),
}
CONSTRAINED = {
    "cubic on an interval": Goal((at_most(x**3, x),), (at_least(x * (1 - x), 0),)),
    "on a disc": Goal((at_most(3 * x + 4 * y, 5),), (at_most(x**2 + y**2, 1),)),
    "on a circle, strictly": Goal((less(x + y, R(3, 2)),), (equal(x**2 + y**2, 1),)),
    "cosine": Goal((at_least(1 - c, s**2 / 2),), (equal(s**2 + c**2, 1),)),
    "sector": Goal((at_most(-2 * x**2 - 2 * x * u - u**2 / 2 + 2 * u * y - 8 * y**2, 0),),
                   (at_least(u * (x - u), 0),)),
    "a matrix positive by its minors": Goal((at_least(p * x**2 + 2 * b * x * y + c * y**2, 0),),
                                            (at_least(p * c - b**2, 0),)),
    "the same, strictly": Goal((greater(p * x**2 + 2 * b * x * y + c * y**2, 0),),
                               (greater(p * c - b**2, 0), differ(y, 0))),
    "products of three bounds": Goal((at_most(n + m + p - n * m - m * p - p * n, 1),),
                                     (at_most(n, 1), at_most(m, 1), at_most(p, 1))),
    "a product below one": Goal((at_most(1 / (1 + p**2) + 1 / (1 + q**2), 2 / (1 + p * q)),), (at_most(p * q, 1),)),
    "a symbol given by others": Goal((at_least(z**2, 4 * x * y),), (equal(z, x + y),)),
    "one that is given by another": Goal((at_least(w, 0),), (equal(w, z**2 - 2 * z + u), equal(u, 1))),
    "a gain that is large enough": Goal((at_most(-p * x**2 + 2 * x * y - q * y**2 - r * z**2 + z * d, d**2 / (4 * r)),),
                                        (at_least(p * q, 1),)),
}
FUNCTIONS = {
    "exp": Goal((at_least(sp.exp(x) + sp.exp(-x), 2),)),
    "log": Goal((at_least(sp.log(p)**2 + 1, 2 * sp.log(p)),)),
    "log below its tangent": Goal((at_most(2 * sp.log(1 + p), 2 * p),)),
    "roots": Goal((at_most(sp.sqrt(p) * sp.sqrt(q), (p + q) / 2),)),
    "a root above one": Goal((at_least(sp.sqrt(1 + x**2), 1),)),
    "sizes": Goal((at_most(sp.Abs(x) * sp.Abs(y), (x**2 + y**2) / 2),)),
}
LYAPUNOV = {
    "decay of 2 states": decay([[-1, 2], [R(-1, 2), -3]], [[2, R(1, 3)], [R(1, 3), R(3, 2)]], R(1, 2)),
    "decay of 3 states": decay([[-2, 1, 0], [R(-3, 4), -1, R(1, 2)], [0, R(-2, 5), -3]], sp.diag(1, R(4, 3), 2), 1),
    "decay of 4 states": decay([[-3, 1, 0, 0], [-1, -2, 1, 0], [0, -1, R(-5, 2), R(1, 3)], [R(1, 7), 0, R(-1, 3), -4]],
                               [[1, R(1, 20), 0, 0], [R(1, 20), 1, 0, 0], [0, 0, 1, R(1, 30)], [0, 0, R(1, 30), 1]], 3),
    "decay of 5 states": decay(-3 * sp.eye(5) + sp.Matrix(5, 5, lambda i, j: R((3 * i + 7 * j) % 5 - 2, i + j + 2)),
                               sp.eye(5), 1),
}
TRUE = UNCONSTRAINED | RATIONAL | CONSTRAINED | FUNCTIONS | LYAPUNOV

FALSE = {
    "more than the means": Goal((at_least(x**2 + y**2, R(201, 100) * x * y),)),
    "strict where it touches": Goal((greater(x**4 * y**2 + x**2 * y**4 + 1, 3 * x**2 * y**2),)),
    "below a minimum": Goal((at_least(x**4 - 4 * x + R(299, 100), 0),)),
    "just below": Goal((at_least((x - y)**2, R(1, 10**8)),)),
    "outside of the interval": Goal((at_most(x**3, x),), (at_least(x, -1),)),
    "beyond the disc": Goal((at_most(3 * x + 4 * y, R(49, 10)),), (at_most(x**2 + y**2, 1),)),
    "beyond the circle": Goal((at_most(3 * x + 4 * y, R(49, 10)),), (equal(x**2 + y**2, 1),)),
    "a gain that is too small": Goal((at_most(-p * x**2 + 2 * x * y - q * y**2, 0),), (greater(p * q, R(99, 100)),)),
    "two terms below their maximum": Goal((at_most(
        -k1 * z**2 * x**2 + b * z * x - k2 * z**2 * x**4 + c * z * x**2,
        b**2 / (4 * k1) + R(99, 100) * c**2 / (4 * k2)),)),
    "a denominator of either sign": Goal((at_most(x / (1 + x), 1),), (differ(x, -1),)),
    "shares above what they reach": Goal((at_least(p / (q + r) + q / (p + r) + r / (p + q), R(151, 100)),)),
    "exp above what it reaches": Goal((at_least(sp.exp(x) + sp.exp(-x), R(201, 100)),)),
    "decay that is too fast": decay([[-1, 2], [R(-1, 2), -3]], [[2, R(1, 3)], [R(1, 3), R(3, 2)]], 3),
}


@pytest.mark.parametrize("name", TRUE)
def test_true_inequalities_are_proved(name):
    assert certificate(TRUE[name]) is not None


@pytest.mark.parametrize("name", FALSE)
def test_false_inequalities_are_not(name):
    assert certificate(FALSE[name]) is None


def test_the_engine_asks_for_squares_where_combinations_fail():
    found = prove_goal(UNCONSTRAINED["Motzkin"])
    assert found is not None
    assert method_of(found["proofs"]) == "sum of squares"


def test_a_certificate_holds_no_more_than_it_needs():
    proof, = certificate(CONSTRAINED["products of three bounds"])["proofs"]
    assert len(proof["terms"]) == 2  # n m p and (1 - n)(1 - m)(1 - p)


def test_a_larger_matrix_is_positive_by_its_minors():
    entries = sp.symbols("a11 a12 a13 a22 a23 a33", real=True)
    a11, a12, a13, a22, a23, a33 = entries
    A = sp.Matrix([[a11, a12, a13], [a12, a22, a23], [a13, a23, a33]])
    goal = Goal((at_least(quadratic(A, [x, y, z]), 0),),
                (greater(a11, 0), greater(a11 * a22 - a12**2, 0), at_least(sp.expand(A.det()), 0)))
    proof, = certificate(goal)["proofs"]
    assert len(proof["terms"]) == 3


def test_equalities_and_sums_are_left_to_others():
    j = sp.Symbol("j", integer=True)
    count, weight = sp.Symbol("count", integer=True, positive=True), sp.IndexedBase("W", real=True)
    total = at_least(sp.Sum(weight[j]**2, (j, 1, count)), 0)
    assert find_squares(Goal((total,)), total, ()) is None
    assert find_squares(Goal((equal(x, x),)), equal(x, x), ()) is None


@pytest.mark.parametrize("name", TRUE)
def test_noise_in_the_last_digits_changes_no_certificate(name, monkeypatch):
    """Solvers differ a little from machine to machine; committed certificates must not."""
    goal, answer, rng = TRUE[name], conic._answer, np.random.default_rng(7)

    def noisy(*problem):
        values = answer(*problem)
        return None if values is None else values * (1 + 1e-9 * rng.standard_normal(values.shape))

    before = [find_squares(goal, shown, assumptions(goal)) for shown in goal.show]
    monkeypatch.setattr(conic, "_answer", noisy)
    assert json.dumps(before) == json.dumps([find_squares(goal, shown, assumptions(goal)) for shown in goal.show])


numbers = st.fractions(min_value=-3, max_value=3, max_denominator=2)
monomials = st.sampled_from([x, y, x * y, x**2, y**2, p * x, p, p * y])
roots = st.lists(st.lists(st.tuples(numbers.filter(bool), monomials), min_size=1, max_size=3, unique_by=lambda t: t[1]),
                 min_size=1, max_size=3)
points = st.tuples(numbers, numbers, numbers.map(abs).filter(bool))


def squares_that_vanish(lists, point):
    """A sum of squares of polynomials, all zero at a point."""
    values = {x: R(point[0]), y: R(point[1]), p: R(point[2])}
    plain = [sp.Add(*(R(a) * t for a, t in terms)) for terms in lists]
    return sp.expand(sp.Add(*((g - g.subs(values))**2 for g in plain)))


@FEW
@given(lists=roots, point=points)
def test_sums_of_squares_that_touch_zero_are_proved_and_nothing_below(lists, point):
    total = squares_that_vanish(lists, point)
    suppose(total.free_symbols)
    assert certificate(Goal((at_least(total, 0),))) is not None
    assert certificate(Goal((greater(total, 0),))) is None
    for less_by in (R(1, 10), R(1, 10**7)):
        assert certificate(Goal((at_least(total - less_by, 0),))) is None


@FEW
@given(entries=st.lists(numbers, min_size=16, max_size=16), size=st.integers(2, 4))
def test_any_positive_definite_form_is_proved(entries, size):
    M = sp.Matrix(size, size, [R(e) for e in entries[:size**2]])
    state = [x, y, z, u][:size]
    assert certificate(Goal((at_least(quadratic(M.T * M + sp.eye(size) / 50, state), 0),))) is not None


@given(entries=st.lists(numbers, min_size=12, max_size=12), rows=st.integers(1, 4))
def test_weighted_squares_give_back_the_gram_matrix(entries, rows):
    factor = [entries[3 * i:3 * i + 3] for i in range(rows)]
    gram = [[sum((line[i] * line[j] for line in factor), Fraction(0)) for j in range(3)] for i in range(3)]
    parts = weighted_squares(gram)
    assert all(weight > 0 for weight, _ in parts)
    assert gram == [[sum((weight * root[i] * root[j] for weight, root in parts), Fraction(0)) for j in range(3)]
                    for i in range(3)]


@pytest.mark.parametrize("gram", [[[1, 2], [2, 3]], [[0, 1], [1, 0]], [[-1]], [[1, 1], [1, 1 - Fraction(1, 10**30)]]])
def test_an_indefinite_matrix_has_no_weighted_squares(gram):
    assert weighted_squares([[Fraction(entry) for entry in row] for row in gram]) is None


@given(value=st.fractions(min_value=-50, max_value=50, max_denominator=30))
def test_a_fraction_is_recognised_in_a_number_that_is_nearly_it(value):
    assert simplest(float(value) + 3e-9, 1e-3) == value


@pytest.mark.parametrize("value", [2**0.5, 3**0.5, 0.1 * 2**0.5, 5**(1 / 3), 1e9])
def test_numbers_that_are_no_simple_fraction_are_not_taken_for_one(value):
    assert simplest(value, 1e-3) is None

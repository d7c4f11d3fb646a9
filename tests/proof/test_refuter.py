"""What the search for counterexamples must find: each goal is false in one way that chance alone hardly meets."""

import copy
import functools
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from falsifier import falsified
from independent import Evaluated, model_breaks, path_obeys

from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import (
    D,
    Goal,
    Relation,
    at_least,
    at_most,
    differ,
    equal,
    greater,
    less,
    saturation,
)
from workbench.proof.decide.boundary_points import solved
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.exact_look import Exact
from workbench.proof.decide.landscape import Landscape
from workbench.proof.decide.refute import find_counterexample, find_example
from workbench.proof.decide.simple_points import simplest_point
from workbench.proof.text import goal_text

x, y, z, w, d = sp.symbols("x y z w d", real=True)
p, q, r = sp.symbols("p q r", positive=True)
j, n = sp.symbols("j n", integer=True, positive=True)
W, h = (sp.IndexedBase(name, real=True)[j] for name in ("W", "h"))
million = sp.Integer(10) ** 6

FALSE = {
    "a weak bound taken for a strict one": Goal((less(x, 2 * p + q),), (at_most(x, 2 * p + q - y), at_least(y, 0),
                                                                      at_most(y * r, p))),
    "strict only between two bounds": Goal((less(x - y, 3),), (at_most(x, p), at_least(y, p - 3))),
    "equality where a square vanishes": Goal((greater((x - 3 * y + z) ** 2 + (x - p * y) ** 2, 0),)),
    "different where they may agree": Goal((differ(3 * x * p, y + 7),)),
    "a linear equation": Goal((at_least(x, 0),), (equal(7 * x + 3 * y - z, 13), equal(x * p + q * w, 5))),
    "one branch of a product": Goal((equal(x, 2 * y),), (equal(x**2, 4 * y**2), differ(y, 0))),
    "a root": Goal((at_most(sp.sqrt(x**2 + p), x + 1),), (equal(sp.sqrt(p), q), greater(q, 1))),
    "a value beyond a million": Goal((at_most(x, million * p),), (at_most(p, 1), at_least(x, 0))),
    "a value below a millionth": Goal((at_least(x * million, 1),), (greater(x, 0), less(x, 1))),
    "a narrow place": Goal((greater((10 * x - 37) ** 2 + (10 * y - 11) ** 2, 2),)),
    "inside a thin shell": Goal((less(x, y),), (at_most(x**2 + y**2, 1), at_least(x**2 + y**2, sp.Rational(99, 100)))),
    "a logarithm at one": Goal((less(sp.log(x / y), x / y - 1),), (greater(x, 0), greater(y, 0))),
    "an exponential at zero": Goal((greater(sp.exp(x - 2 * y), 1 + x - 2 * y),)),
    "the step of a sign": Goal((equal(sp.Abs(x - y) * sp.sign(x - y) ** 2, x - y),)),
    "the end of a saturation": Goal((less(saturation(x, -p, q), q),), (greater(p, 0),)),
    "one term of a sum": Goal((at_most(sp.Sum(W * h, (j, 1, n)), sp.Sum(W**2, (j, 1, n)) / 2 + sp.Sum(
        h**2, (j, 1, n)) * sp.Rational(49, 100)),)),
    "a derivative along the flow": Goal((at_most(D(x**2 + y**2), 0),), (), {x: y, y: -x + p * y}),
    "only one of two relations": Goal((at_least(x**2, 0), at_least(x**2 + 3 * x * y + 2 * y**2, 0))),
}


@pytest.mark.parametrize("name", FALSE)
def test_false_goal_is_refuted_and_not_proved(name):
    goal = FALSE[name]
    certificate = find_counterexample(goal, "refuted")
    assert certificate is not None
    check(certificate)
    assert Evaluated(goal, neurons=1).holds_at(certificate["point"]) == (True, False)
    assert prove_goal(goal) is None


@pytest.mark.parametrize(("goal", "found", "simple"), [
    # Any p above y^2 / x will do, and so will the simplest.
    (Goal((at_most(p * x, y**2),)), {"p": "7/3", "x": "59/4000", "y": "0"}, {"p": "1", "x": "1", "y": "0"}),
    # What is assumed holds at the simpler point too: x must stay below a thousandth.
    (Goal((at_least(x * million, 1),), (greater(x, 0), less(1000 * x, 1))), {"x": "1/1234567"}, {"x": "1/1234567"}),
    # Two that only move together.
    (Goal((differ(x, y),), (greater(x, 1),)), {"x": "17/5", "y": "17/5"}, {"x": "2", "y": "2"}),
])
def test_the_simplest_counterexample_is_shown_and_lies_in_the_domain(goal, found, simple):
    exact, point = Exact(goal_text(goal)), {name: Fraction(value) for name, value in found.items()}
    assert exact.breaks(point)
    shown = simplest_point(exact, point)
    assert exact.breaks(shown) and {name: str(value) for name, value in shown.items()} == simple


t, V, V_0, rate = sp.symbols("t V V_0 rate", real=True)
mu, bound = sp.symbols("mu bound", positive=True)
flow, start = {t: sp.Integer(1), V: rate}, {t: sp.Integer(0), V: V_0}
decaying = (at_most(rate, -mu * V + bound), at_least(t, 0))
a, b = sp.symbols("a b", real=True)
NAMED = sp.Add(*sp.symbols("duration duration_ duration__ time time_ time__", real=True))
LATER = {
    "along a curve": Goal((at_most(b, 2 * V),), (), {a: -p * a + x, b: a**2, V: x**2}, (), {
        a: sp.Integer(0), b: sp.Integer(0), V: sp.Integer(0)}, inputs=(x,)),
    "decays too fast": Goal((at_most(V, bound / mu + (V_0 - bound / mu) * sp.exp(-2 * mu * t)),), (), flow, decaying,
                            start, inputs=(rate,)),
    "grows, though it starts well": Goal((at_most(V, V_0),), (), flow, (at_most(rate, bound), at_least(t, 0)), start,
                                          inputs=(rate,)),
    "an integral of a square": Goal((at_most(V, V_0),), (), {V: x**2}, (at_most(x, 1),), {V: V_0}, inputs=(x,)),
    "with letters that are called as the search calls its own": Goal(
        (at_most(V, V_0 + NAMED),), (equal(NAMED, 0),), {V: x**2}, (at_most(x, 1),), {V: V_0}, inputs=(x,)),
    "with a constant of the flow": Goal((at_least(V, V_0 - p * t),), (greater(p, 0),), {**flow, p: sp.Integer(0)},
                                        (at_least(rate, -2 * p), at_least(t, 0)), {**start, p: p}, inputs=(rate,)),
}


@pytest.mark.parametrize("name", LATER)
def test_what_fails_only_later_is_refuted_by_a_path(name):
    goal = LATER[name]
    certificate = find_counterexample(goal, "gap")
    assert certificate is not None
    assert path_obeys(goal, certificate)
    check(certificate)
    assert Evaluated(goal, neurons=1).holds_at(certificate["point"]) == (True, False)
    assert falsified(goal, None, 1) is not None


@functools.cache
def found_path():
    return find_counterexample(LATER["grows, though it starts well"], "gap")


def corrupted_path(**changes):
    certificate = copy.deepcopy(found_path())
    certificate["point"] |= changes.pop("point", {})
    goal = changes.pop("goal", {})
    return certificate | changes | {"goal": certificate["goal"] | goal}


@pytest.mark.parametrize("changes", [
    {"duration": "-1"}, {"duration": "1000"}, {"time": "V"}, {"time": "rate"}, {"always": []}, {"path": {}},
    {"path": {"t": "time", "V": "V_0"}}, {"path": {"t": "time", "V": "time + 1"}},
    {"path": {"t": "time", "V": "time**2"}}, {"path": {"t": "time", "V": "1/(1 - time)"}},
    {"path": {"t": "time", "V": "time", "mu": "time"}},
    {"point": {"V": "12345"}}, {"point": {"t": "12345"}}, {"point": {"rate": "12345"}},
    {"goal": {"flow": {"t": "1", "V": "rate*V"}}}, {"goal": {"flow": {"t": "1", "V": "rate*t"}}},
    {"goal": {"initial": {"t": "1", "V": "V_0"}}},
    {"goal": {"always": ["rate <= bound", "t >= 0", "V <= V_0 + 1000000"]}},
    {"goal": {"always": ["rate <= 0", "t >= 0"]}}, {"goal": {"indexed": ["V"]}}], ids=str)
def test_a_path_that_the_flow_does_not_take_is_refused(changes):
    check(corrupted_path())
    with pytest.raises(CertificateError):
        check(corrupted_path(**changes))


EVENTUALLY = {
    "a proposed model": Goal((at_most(V, bound / mu),), (), flow, decaying, start, eventually=t, model={
        V: 1 + sp.exp(-t), mu: sp.Integer(1), bound: sp.Integer(1), V_0: sp.Integer(2)}, inputs=(rate,)),
    "a model near the proposed one": Goal((at_least(V, bound / mu),), (), flow, decaying, start, eventually=t, model={
        V: 1 + sp.exp(-t), mu: sp.Integer(1), bound: sp.Integer(1), V_0: sp.Integer(2)}, inputs=(rate,)),
    "a state of rest": Goal((greater(x, 3),), (), {t: sp.Integer(1), x: w}, (
        equal(w, d - p * x), at_least(t, 0)), eventually=t, inputs=(w,)),
    "nothing proposed": Goal((at_most(V, bound / mu),), (), flow, decaying, start, eventually=t,
                             inputs=(rate,)),
}


@pytest.mark.parametrize("name", EVENTUALLY)
def test_a_claim_of_some_later_time_is_broken_by_functions_of_time(name):
    goal = EVENTUALLY[name]
    certificate = find_counterexample(goal, "gap")
    assert certificate is not None
    check(certificate)
    assert model_breaks(goal, certificate["functions"], certificate["point"])


TRUE = {
    "a square": Goal((at_least((x - y) ** 2, 0),)),
    "a bound of a later instant": Goal((at_most(V, bound / mu + (V_0 - bound / mu) * sp.exp(-mu * t)),), (), flow,
                                       decaying, start),
    "defined nowhere": Goal((at_most(sp.log(x * y - x**2 - y**2 - 1), 0),)),
    "undefined where it would fail": Goal((at_least(sp.log(x), -million**3),), (greater(x, 0), less(x, 1))),
    "no assumption ever holds": Goal((greater(x, x),), (greater(x, 0), less(x, 0))),
}


@pytest.mark.parametrize("name", TRUE)
def test_nothing_is_found_against_what_is_not_false(name):
    assert find_counterexample(TRUE[name], "refuted", quick=name != "a square") is None


def test_a_goal_that_cannot_be_read_is_not_decided():
    unknown_sign = Goal((at_least(x, 0),), (at_least(1 / y, x),))
    assert find_counterexample(unknown_sign, "refuted") is None
    edge = Goal((at_least(D(sp.Abs(x)), 0),), (), {x: y})
    assert find_counterexample(edge, "refuted") is None
    assert find_example(edge) is None


@pytest.mark.parametrize("name", [name for name in FALSE if FALSE[name].assume])
def test_an_example_is_found_where_assumptions_leave_little_room(name):
    point = find_example(FALSE[name])
    assert point is not None
    assert Evaluated(FALSE[name], neurons=1).holds_at(point)[0]


def test_quick_finds_what_is_plainly_false():
    assert find_counterexample(Goal((at_least(x, y),)), "refuted", quick=True) is not None
    assert find_counterexample(FALSE["a root"], "refuted", quick=True) is None


def test_the_same_search_finds_the_same_point():
    goal = FALSE["inside a thin shell"]
    assert find_counterexample(goal, "refuted") == find_counterexample(goal, "refuted")


def test_equations_are_solved_for_symbols_in_which_a_factor_is_linear():
    assert {str(value) for symbol, value in solved(x**2 - 4 * y**2, [x]) if symbol == x} == {"2*y", "-2*y"}
    assert solved(sp.exp(x) - y, [x]) == []
    assert solved(sp.Integer(0), [x]) == []


def test_excess_tells_failure_from_rounding():
    def excess(operator, value):
        landscape = Landscape(Goal((Relation(x, operator, sp.Integer(1)),)))
        return landscape.look([np.array([value])])[1][0] > 0

    assert [excess(o, 1.0) for o in ("<", "<=", "==", ">=", ">", "!=")] == [True, False, False, False, True, True]
    assert [excess(o, 2.0) for o in ("<", "<=", "==", ">=", ">", "!=")] == [True, True, True, False, False, False]
    assert not excess("<=", 1 + 1e-15)

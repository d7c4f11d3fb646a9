"""What a goal says in sympy is what its certificate says in text, or it is refused."""

from fractions import Fraction

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Claim, D, Goal, at_least, at_most, equal, greater
from workbench.proof.decide.engine import decide, decide_all, prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.pinned import pinned
from workbench.proof.text import goal_text

x, y, w, x_0, t = sp.symbols("x y w x_0 t", real=True)
i, j, n, m = sp.symbols("i j n m", integer=True, positive=True)
W, H = sp.IndexedBase("W", real=True), sp.IndexedBase("H", real=True)
positive_x = sp.Symbol("x", positive=True)
one_index = sp.Sum(W[j] ** 2, (j, 1, n))


def goal_of(build):
    with pytest.raises(ClaimError) as caught:
        build()
    return str(caught.value)


REFUSED = {
    "two symbols of one name": lambda: Goal((greater(x, 0),), (at_least(positive_x, 0),)),
    "two symbols of one name, in the flow": lambda: Goal((equal(D(positive_x), 1),), flow={x: sp.Integer(1)}),
    "a symbol named as an indexed one": lambda: Goal((at_least(one_index + sp.Symbol("W", real=True), 0),)),
    "two dummies of one name": lambda: Goal((equal(sp.Dummy("a"), sp.Dummy("a")),)),
    "a name that is an expression": lambda: Goal((equal(sp.Symbol("x + y"), x + y),)),
    "a name that is a number": lambda: Goal((equal(sp.Symbol("1"), 1),)),
    "a word of Python": lambda: Goal((at_least(sp.Symbol("lambda"), 0),)),
    "a word of the language": lambda: Goal((at_least(sp.Symbol("Sum"), 0),)),
    "a float": lambda: Goal((at_least(x, 0.1),)),
    "a float in the flow": lambda: Goal((at_least(D(x), 0),), flow={x: sp.Float("0.5")}),
    "a float assumed": lambda: Goal((at_least(x, 0),), (at_least(x, 0.5),)),
    "a derivative of the time that does not run": lambda: Goal(
        (at_most(D(x**2 * sp.exp(t)), -2 * x**2 * sp.exp(t)),), flow={x: -x}),
    "a rate by the time that does not run": lambda: Goal((at_most(D(x**2), 0),), flow={x: -x / (1 + t**2)}),
    "a motion by the time that does not run": lambda: Goal(
        (at_most(x**2, x_0**2),), (at_least(t, 1),), flow={x: x - t * x}, initial={x: x_0}, decreasing=x**2),
    "a bound of a motion by the time that does not run": lambda: Goal(
        (at_most(x, x_0 + t),), flow={x: sp.Integer(1)}, initial={x: x_0}),
    "what always holds of the time that does not run": lambda: Goal(
        (at_most(x, x_0),), flow={x: w}, inputs=(w,), initial={x: x_0}, always=(at_most(w, 1 - t),)),
    "a sign that a motion need not keep": lambda: Goal(
        (greater(positive_x, 0),), flow={positive_x: sp.Integer(-1)}, initial={positive_x: x_0}),
    "a sign that a motion keeps by what it is": lambda: Goal(
        (at_most(positive_x, x_0),), flow={positive_x: -positive_x}, initial={positive_x: x_0}, decreasing=positive_x),
    "infinity": lambda: Goal((at_most(x, sp.oo),)),
    "not a number": lambda: Goal((at_most(x, sp.nan),)),
    "an imaginary number": lambda: Goal((equal(sp.I * x, 0),)),
    "a third root": lambda: Goal((at_least(sp.cbrt(positive_x), 0),)),
    "a root of a negative number": lambda: Goal((at_least(sp.sqrt(-2), 0),)),
    "a whole part": lambda: Goal((at_least(x, sp.floor(x)),)),
    **{f"a symbol known to be {known}": lambda known=known: Goal((at_least(sp.Symbol("x", **{known: True}), 0),))
       for known in ("negative", "nonpositive", "integer", "nonzero", "zero", "extended_positive", "imaginary")},
    "indexed symbols known to be positive": lambda: Goal((at_least(sp.Sum(
        sp.IndexedBase("W", positive=True)[j], (j, 1, n)), 0),)),
    "the number of members as a number": lambda: Goal((equal(sp.Sum(W[j] - W[j] + 1, (j, 1, n)), n),)),
    "a function's name": lambda: Goal((at_least(sp.Symbol("sqrt"), 0),)),
    "a power of unknown exponent": lambda: Goal((at_least(positive_x**y, 0),)),
    "a cotangent": lambda: Goal((at_least(sp.cot(x)**2, 0),)),
    "a comparison inside": lambda: Goal((at_least(sp.Piecewise((x, x > 0), (0, True)), 0),)),
    "an index that no sum binds": lambda: Goal((at_least(W[j], 0),)),
    "an index that another sum binds": lambda: Goal((equal(sp.Sum(W[i], (j, 1, n)), sp.Sum(W[j], (j, 1, n))),)),
    "a neighbour": lambda: Goal((equal(sp.Sum(W[j + 1] - W[j], (j, 1, n)), 0),)),
    "one member": lambda: Goal((equal(sp.Sum(W[1] - W[j], (j, 1, n)), 0),)),
    "two indices": lambda: Goal((equal(sp.Sum(W[i, j], (j, 1, n)), sp.Sum(W[j, i], (j, 1, n))),)),
    "an index as a number": lambda: Goal((equal(sp.Sum(j * W[j], (j, 1, n)), j * sp.Sum(W[j], (j, 1, n))),)),
    "two ranges": lambda: Goal((equal(sp.Sum(W[j], (j, 1, n)), sp.Sum(W[j], (j, 1, m))),)),
    "a sum in a sum": lambda: Goal((equal(sp.Sum(W[j] * sp.Sum(H[i], (i, 1, n)), (j, 1, n)), 0),)),
    "two sums at once": lambda: Goal((equal(sp.Sum(W[j] * H[i], (i, 1, n), (j, 1, n)), 0),)),
    "no relation": lambda: Goal(()),
}


def test_a_clock_is_declared_as_it_runs_and_a_sign_at_one_instant_as_it_is_there():
    time = sp.Symbol("t", nonnegative=True)
    motion = Goal((at_most(x, x_0 + time),), flow={x: 1, time: 1}, initial={x: x_0, time: 0})
    assert motion.signs() == (at_least(time, 0),)
    assert Goal((at_most(D(positive_x), 0),), flow={positive_x: -1}).signs() == (greater(positive_x, 0),)


@pytest.mark.parametrize("name", REFUSED)
def test_what_certificates_cannot_say_is_refused_in_one_line(name):
    message = goal_of(REFUSED[name])
    assert "\n" not in message
    assert len(message) < 300


def test_text_is_never_parsed():
    with pytest.raises(sp.SympifyError):
        at_least("x", 0)


def claim_of(build, identifier="a:1", **more):
    return Claim(id=identifier, title="", kind=more.pop("kind", "condition"), printed="", recorded="proved",
                 build=build, **more)


def test_a_repair_does_not_freeze_what_moves():
    """D(x) at x = 0 is the rate there, not the derivative of the number 0."""
    goal = Goal((equal(D(x), 0),), flow={x: x + 1})
    assert prove_goal(pinned(goal, {x: Fraction(0)})) is None
    assert prove_goal(pinned(goal, {x: Fraction(-1)})) is not None
    with pytest.raises(ClaimError, match="repair"):
        decide(claim_of(lambda: goal, at={x: Fraction(0)}, repair={x: Fraction(1)}))


def test_values_against_the_sign_of_their_symbol_are_refused():
    goal = Goal((at_most(positive_x, 1),))
    with pytest.raises(ClaimError, match="contradicts"):
        pinned(goal, {positive_x: Fraction(-1)})
    with pytest.raises(ClaimError, match="do not fit"):
        decide(claim_of(lambda: goal, at={positive_x: Fraction(-1)}))


def test_stated_values_must_name_every_symbol_and_meet_every_assumption():
    with pytest.raises(ClaimError, match="'y' has no value"):
        decide(claim_of(lambda: Goal((at_most(x, y),)), at={x: Fraction(1)}))
    with pytest.raises(ClaimError, match="breaks the assumption"):
        decide(claim_of(lambda: Goal((at_most(x, y),), (greater(y, 0),)), at={x: Fraction(1), y: Fraction(0)}))


def test_a_false_repair_and_a_false_correction_are_refused():
    with pytest.raises(ClaimError, match="repair could not be proved"):
        decide(claim_of(lambda: Goal((at_most(x, 1),)), at={x: Fraction(2)}, repair={x: Fraction(3)}))
    with pytest.raises(ClaimError, match="correction could not be proved"):
        decide(claim_of(lambda: Goal((at_most(x, 1),)), kind="inequality",
                        correction=lambda: Goal((at_most(x, 2),))))


def test_contradictory_assumptions_prove_nothing():
    goal = Goal((at_least(x, 5),), (greater(x, 0), greater(-x, 0)))
    assert prove_goal(goal) is None


def test_no_point_refutes_a_true_statement_about_a_flow():
    """The final rate says nothing of the earlier ones; a point that the flow never reaches refutes nothing."""
    along = {"flow": {x: w}, "initial": {x: x_0}, "decreasing": x, "inputs": (w,)}
    true = Goal((at_most(x, x_0),), always=(at_most(w, 0),), **along)
    false = Goal((at_most(x, x_0),), (at_most(w, 0),), **along)
    assert prove_goal(true) is not None
    assert find_counterexample(true, "refuted") is None
    assert prove_goal(false) is None


def test_a_start_refutes_a_false_statement_about_a_flow():
    goal = Goal((at_most(x, x_0 - 1),), flow={x: w}, initial={x: x_0}, always=(at_most(w, 0),), inputs=(w,))
    assert find_counterexample(goal, "refuted") is not None


def test_premises_must_exist_and_not_run_in_a_circle():
    goal = Goal((equal(x, x),))
    with pytest.raises(ClaimError, match="is no claim"):
        decide_all([claim_of(lambda: goal, premises=("a:2",))])
    with pytest.raises(ClaimError, match="rests on itself"):
        decide_all([claim_of(lambda: goal, premises=("a:2",)), claim_of(lambda: goal, "a:2", premises=("a:1",))])
    with pytest.raises(ClaimError, match="used twice"):
        decide_all([claim_of(lambda: goal), claim_of(lambda: goal)])


def test_every_part_of_a_goal_is_in_its_text():
    goal = Goal((at_least(one_index, sp.Rational(-1, 2)),), (greater(x, 0),), {x: w, W[j]: x * W[j]}, (at_most(w, 1),),
                {x: x_0})
    assert goal_text(goal) == {
        "assume": ["x > 0"], "show": ["Sum(W**2) >= -1/2"], "indexed": ["W"], "flow": {"x": "w", "W": "x*W"},
        "always": ["w <= 1"], "initial": {"x": "x_0"}}


def test_a_rate_that_a_goal_does_not_need_may_be_beyond_certificates_and_one_that_it_needs_not():
    """Leaving a rate out would make a constant of its symbol: it is left out only where nothing depends on it."""
    a, b, c, angle = sp.symbols("a b c angle", real=True)
    flow = {a: -a, b: a, c: sp.asin(b), angle: sp.atan2(a, b) + c}
    needs_none = Goal((equal(D(a * b), a**2 - a * b),), flow=flow)
    assert list(needs_none.flow) == [a, b] and prove_goal(needs_none) is not None
    for goal in (lambda: Goal((equal(D(c), 0),), flow=flow), lambda: Goal((at_least(c, 0),), flow=flow),
                 lambda: Goal((equal(D(a), 0),), flow={a: c, c: sp.asin(c)}),
                 lambda: Goal((equal(D(a), -a),), assume=(at_least(angle, 0),), flow=flow)):
        with pytest.raises(ClaimError, match="no meaning in certificates"):
            goal()


def test_a_function_of_time_changes_by_itself_too():
    """Without the rate of t its own part was left out: V' <= -2 V was proved of V = x^2 exp(t), whose rate is -V."""
    value = x**2 * sp.exp(t)
    flow = {x: -x, t: sp.Integer(1)}
    assert prove_goal(Goal((equal(D(value), -value),), flow=flow)) is not None
    assert find_counterexample(Goal((at_most(D(value), -2 * value),), flow=flow), "refuted") is not None


def test_a_motion_by_the_time_that_runs_is_followed():
    """With t held constant from 1 on, x^2 <= x_0^2 was proved of x' = (1 - t) x, which rises until t = 1."""
    start = {x: x_0, t: sp.Integer(0)}
    rises = Goal((at_most(x**2, x_0**2),), (at_least(t, 1),), flow={x: x - t * x, t: sp.Integer(1)}, initial=start,
                 decreasing=x**2)
    falls = Goal((at_most(x**2, x_0**2),), flow={x: -t * x, t: sp.Integer(1)}, initial=start, decreasing=x**2,
                 always=(at_least(t, 0),))
    assert prove_goal(rises) is None
    assert prove_goal(falls) is not None

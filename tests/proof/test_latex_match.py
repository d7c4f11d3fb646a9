"""A printed line matches the goal that states it, and no other."""

import pytest
import sympy as sp
from latex_trees import W, h, over

from workbench.proof.claim import Claim, D, Goal, Relation, at_least, at_most, differ, equal, greater, less
from workbench.proof.decide.engine import decide
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.match import match
from workbench.proof.latex.notation import Notation

z_1, z_2, a, e, eps = sp.symbols("z_1 z_2 a e epsilon", real=True)
r_1, k = sp.symbols("r_1 k", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
V_0 = sp.Symbol("V_0", real=True)
NOTATION = {"z_1": z_1, "z_2": z_2, "r_1": r_1, "k": k, "a": a, "e_1": e, r"\varepsilon": eps, "V_1": z_1**2 / 2,
            "V_1(0)": V_0, r"\tilde W": W, "h": h, "h_j": h, r"\tilde W_j": W, "n": n, r"\|e_1\|": sp.Abs(e),
            "(t)": sp.Integer(1)}
RATE = Goal((equal(D(z_1**2 / 2), -r_1 * z_1**2 + z_1 * z_2),), flow={z_1: z_2 - r_1 * z_1})
VECTORS = Goal((at_most(-over(W * h) * e, over(W**2) / 2 + e**2 * over(h**2) / 2),))
BAND = Goal((less(sp.log(k**2 / (k**2 - e**2)), e**2 / (k**2 - e**2)),), (less(sp.Abs(e), k),))


def goal(*show, given=(), flow=None):
    return Goal(tuple(show), tuple(given), flow or {})


MATCHING = [
    (r"\dot V_1 = -r_1z_1^2 + z_1z_2", RATE),
    (r"-r_1z_1^2 + z_1z_2 = \dot V_1", RATE),
    (r"\dot{V}_{1} = z_1(z_2 - r_1 z_1)", RATE),
    (r"\dot V_1 = z_1\dot z_1 = -r_1z_1^2 + z_1z_2", RATE),
    (r"\frac{d}{dt}\left[\tfrac12z_1^2\right] = -r_1z_1^2 + z_1z_2", RATE),
    (r"\dot z_1 = z_2 - r_1z_1 \Rightarrow \dot V_1 = -r_1z_1^2 + z_1z_2", RATE),
    (r"-\tilde W^The_1 \le \tfrac12\|\tilde W\|^2 + \frac{e_1^2}{2}h^\top h", VECTORS),
    (r"-e_1\sum_{j=1}^n\tilde W_jh_j \le \tfrac12\tilde W^T\tilde W + \tfrac12e_1^2\sum_jh_j^2", VECTORS),
    (r"|e_1| < k \Rightarrow \ln\frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2}", BAND),
    (r"\log\frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2} \text{ for } |e_1| < k", BAND),
    (r"\|e_1\| < k:\quad \frac{e_1^2}{k^2 - e_1^2} > \log\frac{k^2}{k^2 - e_1^2}", BAND),
    (r"z_1^2 \le a = e_1 \le k", goal(at_most(z_1**2, a), equal(a, e), at_most(e, k))),
    (r"z_1^2 \le a = e_1 \le k", goal(at_most(z_1**2, e), equal(a, e), at_most(a, k))),
    (r"z_1, z_2 > 0", goal(greater(z_1, 0), less(0, z_2))),
    (r"z_1 \in [0, k)", goal(at_least(z_1, 0), less(z_1, k))),
    (r"z_1 \ne 0, z_1 \in (-\infty, k]", goal(differ(z_1, 0), at_most(z_1, k))),
    (r"a = \min(z_1, z_2)", goal(equal(a, sp.Min(z_1, z_2)))),
    (r"a = \mathrm{sat}(z_1, 0, k)", goal(equal(a, sp.Min(sp.Max(z_1, 0), k)))),
    (r"z_1\,\mathrm{sgn}(z_1) = |z_1|", goal(equal(sp.Abs(z_1), sp.Abs(z_1)))),
    (r"V_1(0) \le e^{-kz_1}\tanh\frac{z_2}{k}", goal(at_most(V_0, sp.exp(-k * z_1) * sp.tanh(z_2 / k)))),
    (r"\sum_{j=1}^{3} j z_1 \ge 0", goal(at_least(6 * z_1, 0))),
    (r"z_1^2(t) \le e_1(t)\,a", goal(at_most(z_1**2, e * a))),
    (r"\begin{aligned} z_1^2 &\le a \\ &\le k\end{aligned}", goal(at_most(z_1**2, a), at_most(a, k))),
    (r"\ddot z_1 = -\dot z_2", goal(equal(D(D(z_1)), -D(z_2)), flow={z_1: z_2, z_2: -z_1})),
]


def test_sides_that_are_one_by_the_letters_keep_their_relation():
    same = goal(at_most(z_1 * z_1, z_1**2))
    assert match(r"2V_1 \le z_1^2", NOTATION, same).parsed and match(r"z_1^2 \le 2V_1", NOTATION, same).parsed
    assert not match(r"2V_1 \ge z_1^2", NOTATION, same).parsed


@pytest.mark.parametrize(("printed", "stated"), MATCHING)
def test_the_line_that_a_goal_states_is_parsed(printed, stated):
    found = match(printed, NOTATION, stated)
    assert found.parsed, found.why


def mutants(line):
    """The line with one sign, relation, number, power, index or letter changed; what only looks different left out."""
    for old, new in (("+", "-"), ("-", "+"), ("=", r"\le "), (r"\le", "<"), (r"\le", r"\ge"), ("<", r"\le "),
                     ("<", ">"), ("_1", "_2"), ("_2", "_1"), ("^2", "^3"), ("^2", ""), ("^T", ""), (r"^\top", ""),
                     ("2", "3"), (r"\dot", ""), (r"\dot", r"\ddot"), (r"\tilde", ""), (r"\tilde", r"\hat"),
                     ("z_1z_2", "z_1"), (r"\ln", r"\tanh"),
                     (r"\log", ""), ("h", r"\tilde W"), ("k", "r_1"), (">", r"\ge "), ("[", "("),
                     (")", "]"), (r"\ne", "="), (r"\min", r"\max"), ("|e_1|", "e_1"), (r"\|e_1\|", "e_1")):
        start = line.find(old)
        while start >= 0:
            yield line[:start] + new + line[start + len(old):]
            start = line.find(old, start + 1)


# What a mutation may leave true of the goal: a sign before a square, a condition that says the same.
ALIKE = {(r"z_1, z_2 > 0", r"z_2, z_2 > 0"), (r"z_1, z_2 > 0", r"z_1, z_1 > 0")}


@pytest.mark.parametrize(("printed", "stated"), MATCHING)
def test_no_mutant_of_the_line_is_parsed(printed, stated):
    tried = 0
    for mutant in mutants(printed):
        tried += 1
        found = match(mutant, NOTATION, stated)
        assert not found.parsed, mutant
        assert found.why and "\n" not in found.why
    assert tried > 1


def test_no_mutant_of_the_goal_is_matched():
    shown = at_most(-over(W * h) * e, over(W**2) / 2 + e**2 * over(h**2) / 2)
    line = r"-\tilde W^The_1 \le \tfrac12\|\tilde W\|^2 + \frac{e_1^2}{2}h^\top h"
    others = [Relation(shown.left, operator, shown.right) for operator in ("<", ">=", "==", "!=", ">")]
    others += [Relation(shown.right, "<=", shown.left), Relation(-shown.left, "<=", shown.right),
               at_least(shown.right - shown.left, 0), Relation(2 * shown.left, "<=", 2 * shown.right),
               at_most(shown.left + a, shown.right + a), at_most(shown.left, shown.right.xreplace({W: h}))]
    for other in others:
        assert not match(line, NOTATION, Goal((other,))).parsed, other
    assert "difference of the sides" in match(line, NOTATION, Goal((others[7],))).why


@pytest.mark.parametrize(("printed", "stated", "why"), [
    (r"\dot V_1 = -r_1z_1^2 + z_1z_2, z_1 > 0", RATE, "does not show"),
    (r"\dot V_1 = -r_1z_1^2 + z_1z_2", goal(*RATE.show, greater(r_1, 0), flow=RATE.flow), "more than is printed"),
    (r"z_2 = 0 \Rightarrow \dot V_1 = -r_1z_1^2 + z_1z_2", RATE, "does not assume"),
    (r"z_1^2 \le a \le k", goal(at_most(z_1**2, a), at_most(z_1**2, k)), "does not show"),
    (r"z_1^2 \le a \le k", goal(at_most(z_1**2, k)), "does not show"),
    (r"z_1^2 \le a < k", goal(at_most(z_1**2, a), at_most(a, k)), "does not show"),
    (r"\tilde V_1 = 0", goal(equal(a, 0)), "nearest known is"),
    (r"V_1(1) = 0", goal(equal(a, 0)), "not in the notation"),
    (r"\|a\| \le k", goal(at_most(sp.Abs(a), k)), "no vector"),
    (r"a^Ta \le k", goal(at_most(a**2, k)), "no vector"),
    (r"h \le k", VECTORS, "vector stands where a number"),
    (r"h + a \le k", VECTORS, "a number is added to a vector"),
    (r"\sum_{j=2}^n h_j^2 \le k", goal(at_most(over(h**2), k)), "from 2 to n"),
    (r"\sum_i h_j^2 \le k", goal(at_most(over(h**2), k)), "the index 'j' too"),
    (r"\frac{z_1^2}{z_1} \le k", goal(at_most(z_1, k)), "cancels"),
    (r"\sqrt{z_1}^2 \le k", goal(at_most(z_1, k)), "cancels"),
    (r"\frac{k^2}{k} \le k + \dots", goal(at_most(k, k)), "dots stand for"),
    (r"\frac{1}{a - a} \le k", goal(at_most(a, k)), "division by zero"),
    (r"\sqrt{-2} \le k", goal(at_most(a, k)), "no real number"),
    (r"2^{999^{999}} \le k", goal(at_most(a, k)), "exponent"),
    (r"2^{1000^2} \le k", goal(at_most(a, k)), "exponent"),
    (r"\tanh z_1 z_2 \le k", goal(at_most(sp.tanh(z_1) * z_2, k)), "open"),
    (r"a \pm k = 0", goal(equal(a + k, 0)), "two things at once"),
    (r"a = b", Goal((equal(a, 0),), eventually=sp.Symbol("t", nonnegative=True), flow={}), "'b'"),
])
def test_what_is_not_the_same_is_refused_and_says_why(printed, stated, why):
    found = match(printed, NOTATION, stated)
    assert not found.parsed and not found.words
    assert why in found.why


@pytest.mark.parametrize("printed", [
    r"a \le k\ \forall t \ge 0", r"\exists k: a \le k", r"a \to 0", r"a \le k\ \text{on the compact set}",
    r"a \in \{1, 2\}", r"\text{the train is stable}", r"a = 0 \Leftrightarrow k = 0", r"\text{for each car}\ a \le k",
])
def test_prose_is_called_words(printed):
    found = match(printed, NOTATION, goal(at_most(a, k)))
    assert not found.parsed and found.words


def test_a_line_does_not_say_that_it_holds_from_some_time_on():
    t = sp.Symbol("t", positive=True)
    late = Goal((at_most(a, t),), eventually=t, always=(at_most(a, 0),))
    assert "some time on" in match("a \\le t", {**NOTATION, "t": t}, late).why


def test_the_longest_piece_of_a_notation_wins():
    notation = {"A": k, "s": a, "A s": e, r"\Delta u": z_1, r"\Delta": z_2, "u": k}
    assert match("A s + A = 0", notation, goal(equal(e + k, 0))).parsed
    assert match(r"\Delta u^2 = \Delta", notation, goal(equal(z_1**2, z_2))).parsed
    moving = goal(equal(D(z_1), D(z_2)), flow={z_1: z_2, z_2: z_1})
    assert match(r"\dot{\Delta u} = \dot\Delta", notation, moving).parsed


@pytest.mark.parametrize(("letters", "why"), [
    ({"a = b": a}, "without relations"), ({"a, b": a}, "without relations"), ({"a +": a}, "ends where"),
    ({"x_1": a, "x_{1}": k}, "two meanings"), ({"x": 1}, "no expression"), ({"a + k": a}, "sum outside brackets"),
])
def test_a_notation_is_of_letters_with_one_meaning(letters, why):
    with pytest.raises(LatexError, match=why):
        Notation(letters)


def test_large_sides_are_refused_in_a_moment():
    large = "(" + "+".join(["z_1", "z_2", "a", "e_1", "k"]) + ")^{60}"
    same = goal(at_most((z_1 + z_2 + a + e + k) ** 59 * (k + a + e + z_2 + z_1), 0))
    assert match(f"{large} \\le 0", NOTATION, same).parsed  # the same power of the same sum
    other = goal(at_most(sp.expand((z_1 + z_2) ** 2) * (a + e + k + 1) ** 60, 0))
    assert not match(large.replace("z_1", "1").replace("z_2", "0") + r"(z_1+z_2)^2 \le 0", NOTATION, other).parsed


def test_a_decision_says_whether_its_line_was_parsed_and_what_was_decided():
    def decided(printed, **more):
        return decide(Claim(id="lent:1", title="", kind="identity", printed=printed, recorded="proved",
                            build=lambda: RATE, notation=NOTATION, **more))

    parsed = decided(r"\dot V_1 = -r_1z_1^2 + z_1z_2")
    assert parsed.matched == "parsed" and parsed.verdict == "proved"
    assert decided(r"\dot V_1 = -r_1z_1^2 - z_1z_2", reading="as its glyph").matched == "read"
    assert decided(r"\dot V_1 = -r_1z_1^2 + z_1z_2", match="words", reading="as prose").matched == "words"
    line, _, along = parsed.goal.partition(r"\quad\text{given}\ ")
    assert match(line, {"z_1": z_1, "z_2": z_2, "r_1": r_1}, RATE).parsed
    assert along == r"r_{1} > 0\quad\text{along}\ \frac{d}{dt} z_{1} = z_{2} - r_{1} z_{1}"

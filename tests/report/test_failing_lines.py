"""A line fails by itself where its own counterexample leaves nothing wrong with the failing lines before it."""

import ast

import pytest

from workbench.proof.checker import parse
from workbench.proof.fate import judged
from workbench.proof.verdict import Decision, Stated
from workbench.report.finding import findings
from workbench.report.finding_sentences import consequence_sentence
from workbench.report.premises_at_counterexample import Other, kept_and_broken


def refuted(show, point, assume=(), flow=None, **more):
    """A certificate of a false line; nothing here asks whether it is accepted."""
    goal = {"show": [show], "assume": list(assume), **({"flow": flow} if flow else {})}
    return {"verdict": "refuted", "goal": {**goal, **more.pop("goal", {})}, "point": point, **more}


SQUARE = refuted("x**2 >= 1", {"x": "0"})


@pytest.mark.parametrize(("own", "other", "obeyed", "says"), [
    # Of x >= 2 the point 1 keeps x^2 >= 1, the point 0 does not: it alone could be the fault of the other line.
    (refuted("x >= 2", {"x": "1"}), SQUARE, False, "kept"), (refuted("x >= 2", {"x": "0"}), SQUARE, False, "broken"),
    # What the other line assumes does not hold there: it says nothing of the point.
    (refuted("x >= 2", {"x": "0"}), refuted("x**2 >= 1", {"x": "0"}, ["x >= 1/2"]), False, None),
    # Letters that are not named may be those of another system, where a line is no false calculation.
    (refuted("x >= 2", {"x": "0"}), refuted("d_now == d_later", {"d_now": "0", "d_later": "1"}), True, "kept"),
    (refuted("x >= 2", {"x": "0"}), refuted("y**2 >= 1", {"y": "0"}), False, None),
    (refuted("x >= 2", {"x": "0"}), refuted("0*y >= 1", {"y": "0"}), True, None),
    # A letter that moves may be another name of what moves there.
    (refuted("x >= 2", {"x": "0"}, flow={"x": "1"}), refuted("D(w) <= 0", {"w": "1", "r": "1"}, flow={"w": "r"}), True,
     None),
    # A rate is that of the counterexample, and of what has none there the other line's.
    (refuted("D(x) <= 0", {"x": "1"}, flow={"x": "x"}), refuted("D(x) >= 1", {"x": "0"}, flow={"x": "0*x"}), False,
     "kept"),
    (refuted("D(x) <= 0", {"x": "1"}, flow={"x": "x"}), refuted("D(x) >= 2", {"x": "0"}, flow={"x": "0*x"}), False,
     "broken"),
    # Later times are not looked at.
    (refuted("x >= 2", {"x": "1"}), refuted("x**2 >= 1", {"x": "0"}, goal={"eventually": "t"}), False, None)])
def test_what_a_point_says_of_another_line(own, other, obeyed, says):
    kept, broken = kept_and_broken(own, {"other": Other(other, obeyed)})
    assert (kept, broken) == {"kept": (["other"], []), "broken": ([], ["other"]), None: ([], [])}[says]


def test_what_is_kept_is_kept_with_one_value_of_each_letter():
    own = refuted("x >= 2", {"x": "1"})
    one, none = (Other(refuted(f"z == {n}", {"z": "2"}), True) for n in (1, 0))
    assert kept_and_broken(own, {"one": one, "none": none}) == (["one"], ["none"])


def test_a_motion_keeps_what_holds_along_it_and_nothing_that_is_read_is_changed():
    """With constant coefficients the errors move as the estimates do; trees that the checker has read stay as they are,
    or else it would read other statements from then on."""
    relation = "D(b_tilde) == D(b_tilde + b_star)"
    rates = Other(refuted(relation, {"b_rate": "1"}, flow={"b_tilde": "-b_rate", "b_star": "b_rate"}), False)
    motion = {"verdict": "refuted", "point": {"b_star": "3"}, "functions": {"b_tilde": "1 + exp(-t)"}, "goal": {
        "show": ["b_tilde <= 1"], "flow": {"b_tilde": "w", "t": "1"}, "inputs": ["w"], "eventually": "t"}}
    before = ast.unparse(parse("D(b_tilde + b_star)"))
    assert kept_and_broken(motion, {"rates": rates}) == (["rates"], [])
    assert ast.unparse(parse("D(b_tilde + b_star)")) == before
    # Of what changes in time nothing is said, of what does not it is.
    above, constant = (Other(refuted(text, {}), False) for text in ("b_tilde >= 1", "b_star >= 4"))
    assert kept_and_broken(motion, {"above": above, "constant": constant}) == ([], ["constant"])


def test_a_theorem_that_fails_by_itself_is_not_told_to_rest_on_what_it_keeps():
    def line(equation, certificate, rests_on=(), severity="step"):
        claim = Stated(id=f"doe2026:{equation}", title="t", kind="inequality", printed="x", recorded="refuted",
                       rests_on=tuple(f"doe2026:{name}" for name in rests_on), severity=severity)
        return Decision(claim, "refuted", "by hand", "exact", 0.0, {"claim": claim.id, "version": 2, **certificate})

    for point, alone, told in (("1", True, "It fails by itself: at its counterexample equation (1) holds."),
                               ("0", False, "In the text it rests on equation (1), which fails.")):
        found = {f.equation: f for f in findings(judged([
            line("1", SQUARE), line("theorem1", refuted("x >= 2", {"x": point}), ("1",), "result")]))}
        theorem = found["theorem1"]
        assert (theorem.alone, consequence_sentence(theorem)) == (alone, told)
        assert theorem.causes == (() if alone else ("1",)) and theorem.because == ("1",)
        assert found["1"].headlines == (() if alone else ("theorem1",))

"""A solver's second opinion agrees with what is so, tells of what is not, and is silent where it knows too little."""

import json
import sys
from dataclasses import replace

import pytest
from command_line import run

from workbench.proof.checker import check
from workbench.proof.oracle import asking
from workbench.proof.prove import prove
from workbench.proof.selection import targets

pytest.importorskip("z3")

CLAIMS = '''
import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.proof.paper import Paper

paper = Paper("doe2031", "nobody, nowhere")
x = sp.Symbol("x", real=True)
k = sp.Symbol("k", positive=True)


@paper.claim("1", "decay", "inequality", "x", "proved")
def decay() -> Goal:
    return Goal((at_most(D(x**2/2), -k*x**2/2),), flow={x: -k*x})


@paper.claim("2", "false", "inequality", "x", "refuted")
def false() -> Goal:
    return Goal((at_least(x**2, 1),))
'''
HALVES = {"version": 1, "verdict": "proved", "goal": {"assume": ["x > 0"], "show": ["1/(2*x) <= 1/x"]}}


def failing(*show, **goal):
    """A certificate that says so much to be false."""
    return {"verdict": "refuted", "goal": {"show": list(show), **goal}}


def proved(*show, **goal):
    return failing(*show, **goal) | {"verdict": "proved"}


@pytest.mark.parametrize(("certificate", "answer"), [
    (HALVES, "agreed"),
    (HALVES | {"verdict": "refuted"}, "contradicted"),
    (proved("x**2 > 0"), "contradicted"),
    (proved("1/x == 1/x"), "contradicted"),  # without a value at 0
    (proved("x/x == 1", assume=["1/x >= 1"]), "agreed"),  # an assumption has a value where it holds
    (failing("x**2 >= 1"), "agreed"),
    (failing("1/x == 1/x"), "contradicted"),  # what has no value at a point does not fail there
    (failing("x >= 0", assume=["x**3 >= 1"]), "contradicted"),
    (failing("x**2 <= 2", assume=["x**3 == 8"]) | {"point": {"x": "2"}}, "agreed"),
    (failing("k >= 1") | {"verdict": "violated", "point": {"k": "2"}}, "contradicted"),
    (failing("k >= 1") | {"verdict": "violated", "point": {"k": "1/2"}}, "agreed"),
    # Derivatives along a flow, in one go with its rates.
    (proved("D(x**2/y) == -3*x**2/y", assume=["y > 0"], flow={"x": "-x", "y": "y"}), "agreed"),
    (proved("D(x**2/y) == -x**2/y", assume=["y > 0"], flow={"x": "-x", "y": "y"}), "contradicted"),
    (proved("D(D(x)) == x", flow={"x": "y", "y": "x"}), "agreed"),
    (proved("D(exp(2*x)) == 2*exp(2*x)*y", flow={"x": "y"}), "agreed"),
    (proved("D(sqrt(1 + x**2)) <= abs(x)", flow={"x": "1"}), "agreed"),
    (proved("D(u) == 0", inputs=["u"]), "not asked"),
    (proved("D(abs(x)) <= 1", flow={"x": "1"}), "not asked"),
    # Functions of which little is said: nothing that is found shows that a statement fails.
    (proved("exp(x) >= 1 + x", "log(x + 1) <= x", "abs(tanh(x)) < 1", assume=["x > 0"]), "agreed"),
    (proved("exp(x) >= 1 + x + x**2/2", assume=["x > 0"]), "unknown"),
    (failing("exp(x) >= 1 + x"), "contradicted"),
    (failing("exp(x) >= 2 + x"), "unknown"),
    # Sums over one and over two terms; what an index leaves open holds for each.
    (proved("Sum(x*y)**2 <= Sum(x**2)*Sum(y**2)", indexed=["x", "y"]), "agreed"),
    (proved("Sum(x)**2 <= Sum(x**2)", indexed=["x"]), "contradicted"),
    (proved("Sum(x) >= 0", assume=["x >= 0"], indexed=["x"]), "agreed"),
    (proved("D(Sum(w**2)) <= 0", indexed=["w"], flow={"w": "-w"}), "agreed"),
    (failing("Sum(x**2) >= 0", indexed=["x"]), "unknown"),
    # Of a motion one instant says less than all.
    (proved("x <= 1", flow={"x": "-x"}, initial={"x": "1"}), "unknown"),
    (failing("x**2 >= 0", flow={"x": "-x"}, initial={"x": "1"}), "contradicted"),
    (failing("x <= 1", eventually="x"), "not asked"),
])
def test_opinion_is_what_arithmetic_says(certificate, answer):
    from workbench.proof.oracle.question import opinion_on

    found = opinion_on(certificate, 5.0)
    assert found.answer == answer, found
    assert found.reason or answer == "agreed"


@pytest.fixture
def paper(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "doe2031"
    folder.mkdir()
    (folder / "paper.py").write_text(CLAIMS)
    return folder


def test_it_changes_nothing_but_adds_its_column(paper, tmp_path):
    before = run("prove", paper, "--json", tmp_path / "before.json")
    after = run("prove", paper, "--json", tmp_path / "after.json", "--oracle", "z3")
    assert before.returncode == after.returncode == 0
    assert "z3: 2 agreed, 0 unknown, 0 not asked, 0 contradicted" in after.stdout
    plain, told = (json.loads((tmp_path / f"{name}.json").read_text()) for name in ("before", "after"))
    assert [row.pop("oracle") for row in told["claims"]] == [{"solver": "z3", "answer": "agreed", "reason": ""}] * 2
    assert plain == told


def test_a_wrong_verdict_is_named_and_ends_the_command_with_1(paper, tmp_path, monkeypatch):
    from workbench.proof import prove as deciding

    right = prove(targets([str(paper)]), jobs=1)
    first, second = right.decisions
    wrong = replace(right, decisions=[
        replace(first, verdict="refuted", claim=replace(first.claim, recorded="refuted")),
        replace(second, verdict="proved", claim=replace(second.claim, recorded="proved"))])
    monkeypatch.setattr(deciding, "prove", lambda *_, **__: wrong)
    for quiet in ((), ("--quiet",)):
        done = run("prove", paper, "--oracle", "z3", "--json", tmp_path / "told.json", *quiet)
        assert done.returncode == 1
        assert "CONTRADICTED: doe2031:1: refuted, but z3 shows that it cannot fail" in done.stderr
        assert "CONTRADICTED: doe2031:2: proved, but z3 finds that it fails at x = " in done.stderr
    assert {row["oracle"]["answer"] for row in json.loads((tmp_path / "told.json").read_text())["claims"]} == {
        "contradicted"}


def test_a_recorded_verdict_that_is_wrong_is_told_beside_what_was_decided(paper):
    (paper / "paper.py").write_text(CLAIMS.replace('"x", "refuted"', '"x", "proved"'))
    done = run("prove", paper, "--oracle", "z3")
    assert done.returncode == 1
    assert "doe2031:2: decided refuted, but recorded proved" in done.stderr
    assert "CONTRADICTED: doe2031:2: recorded proved, but z3 finds that it fails at" in done.stderr


def test_a_process_that_ends_or_hangs_costs_an_answer_and_no_more(paper, monkeypatch):
    decisions = prove(targets([str(paper)]), jobs=1).decisions
    monkeypatch.setattr(asking, "CHILD", "workbench.proof.oracle.opinion")  # which reads nothing and ends
    ended = asking.opinions_on(decisions)
    monkeypatch.undo()
    monkeypatch.setattr(asking, "PATIENCE", 0)
    late = asking.opinions_on(decisions)
    for found, reason in ((ended, "z3's process has ended"), (late, "z3 does not answer within 0 s")):
        assert [(o.answer, o.reason) for o in found.values()] == [("unknown", reason)] * 2


def test_without_z3_the_remedy_is_said_in_a_line(paper, monkeypatch):
    monkeypatch.setitem(sys.modules, "z3", None)
    monkeypatch.setattr(asking, "find_spec", lambda name: None)
    done = run("prove", paper, "--oracle", "z3")
    assert done.returncode == 2
    assert "z3 is not installed: pip install 'workbench[oracle]'" in done.stderr
    assert done.stderr.count("\n") == 1
    assert run("prove", paper, "--oracle", "cvc5").returncode == 2


def test_certificates_of_the_same_statements_are_the_checkers():
    """What z3 agrees with here the checker accepts: the two read one language."""
    term = [{"coefficient": "1/2", "factors": [{"inverse": 0}]}]
    check(HALVES | {"example": {"x": "1"}, "proofs": [{"rule": "combination", "terms": term}]})

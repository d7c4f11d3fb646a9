"""What sympy cancels in a paper's modules is not forgotten: a claim would be proved where its line has no value."""

import pytest

from workbench.errors import ClaimError, InputError
from workbench.proof.decide.engine import decide
from workbench.proof.loading import ProofFile
from workbench.proof.paper import papers_in

PAPER = """from workbench.proof.paper import Paper
paper = Paper("cancelled2026", "A. Author, The title, The journal 1 (2026) 1-2")
"""
PLANT = """import sympy as sp
from workbench.proof.typed import as_typed
x, y, u, w = sp.symbols("x y u w", real=True)
k, m = sp.symbols("k m", positive=True)
"""
CLAIM = """import sympy as sp
from workbench.proof.claim import D, Goal, at_least, at_most, equal
from ..paper import paper
from ..plant import *
@paper.claim("1", "The line", "inequality", "x", "undecided")
def line() -> Goal:
    return {goal}
"""
ALONG = "Goal((equal(D(x**2/2), -k*x**2),), flow=flow)"
# The module's line, the goal, and where the line has no value.
LOST = {
    "a law that is singular": (
        "flow = {x: (sp.cos(x)*u).xreplace({u: -k*x/sp.cos(x)})}", ALONG, "cos(x) is zero"),
    "a law of zero gain": ("flow = {x: (x**2*u).subs(u, -k/x)}", ALONG,
                           "x is zero"),
    "a term that the law cancels": ("flow = {x: (1/y + u).xreplace({u: -1/y - k*x})}", ALONG, "y is zero"),
    "a quotient": ("V = x**3/x", "Goal((at_least(V, 0),))", "x is zero"),
    "a quotient of what differs": ("V = (x - y)**3/(x - y)", "Goal((at_least(V, 0),))", "x - y is zero"),
    "a square root": ("V = sp.sqrt(x)**2", "Goal((at_least(V, x - 1),))", "x is negative"),
    "two square roots": ("V = sp.sqrt(-x*m)*sp.sqrt(-x*m)", "Goal((at_least(V, -m*x - 1),))", "-x is negative"),
    "a logarithm": ("V = sp.exp(sp.log(x))", "Goal((at_least(V, x - 1),))", "x is not positive"),
    "a quotient of a quotient": ("V = 1/(1/x)", "Goal((at_least(V**2, 0),))", "x is zero"),
    "a function of two": ("V = sp.Lambda((x, y), x*y/y**2)(x, 1/x) + x**2", "Goal((at_least(V, 0),))", "x is zero"),
    "a matrix": ("V = (sp.Matrix([[x, 1]])*u).subs(u, 1/x)[0] + x**2", "Goal((at_least(V, 1),))", "x is zero"),
    "nothing is left": ("V = x**2 + 1/y - 1/y", "Goal((at_least(V, 0),))", "y is zero"),
}
# What sympy changes without giving it a value where there was none.
KEPT = {
    "positive": "flow = {x: (u/m).xreplace({u: -m*k*x})}",
    "positive by its form": "flow = {x: ((1 + y**2)*u).xreplace({u: -k*x/(1 + y**2)})}",
    "still asked": "flow = {x: -k*x*(y/y**2) + 0/m}",
    "roots of squares": "flow = {x: -k*sp.sign(x)*sp.sqrt(x**2)}",
    "roots drawn apart": "flow = {x: -k*x*(1 + sp.sqrt(4*m*y) - 1)}",
    "a diagonal of zeros": "A = sp.Matrix([[1/y, 1], [2, 1/y]])\nA = A - A.T\nflow = {x: -k*x*A[1, 0]}",
    "not cancelled": "flow = {x: (x - y)**3/(2*y - 2*x)}",
    "turned signs": "flow = {x: -k*x*(1/(2*y - 2*w) + 1/(w - y))}",
}


def folder(path, module, goal=ALONG):
    (path / "claims").mkdir()
    (path / "paper.py").write_text(PAPER)
    (path / "plant.py").write_text(f"{PLANT}{module}\n")
    (path / "claims" / "section_1.py").write_text(CLAIM.format(goal=goal))
    return ProofFile(path)


@pytest.mark.parametrize("name", LOST)
def test_a_module_in_which_a_domain_is_lost_is_named_with_its_line(name, tmp_path):
    module, goal, without = LOST[name]
    with pytest.raises(InputError, match=r"plant\.py, line [56]: .*as_typed") as trouble:
        folder(tmp_path, module, goal).modules()
    assert without in str(trouble.value)


@pytest.mark.parametrize("name", [name for name in LOST if "subs" not in LOST[name][0]])
def test_kept_as_typed_it_is_not_proved(name, tmp_path):
    module, goal, _ = LOST[name]
    typed = "with as_typed():\n" + "".join(f"    {line}\n" for line in module.splitlines())
    (paper,) = papers_in(folder(tmp_path, typed, goal))
    assert decide(paper.claims[0]).verdict == "undecided"


@pytest.mark.parametrize("goal", [
    "Goal((at_least((k/x).subs(k, x) + y**2, 1),))", "Goal((equal(D(x**2/2), -k*x**2),), flow=flow)",
    "Goal((at_least(((x - y)*w).subs([(w, 1/u), (u, x - y)]), 0),))", "Goal((at_least(sp.sqrt(y).subs(y, x)**2, x),))",
    "Goal((at_least((sp.Matrix([[x, 1]])*u).subs(u, 1/x)[0] + x**2, 1),))",
    "Goal((at_least(sp.Lambda((x, y), x**2/y**2)(x, x) + x**2, 1),))",
    "Goal((at_least(sp.exp(y).subs(y, sp.log(x)), x),))"])
def test_what_is_put_in_by_subs_is_not_cancelled(goal, tmp_path):
    goal = goal.replace("flow=flow", "flow={x: (x**2*u).subs(u, -k/x)}")
    (paper,) = papers_in(folder(tmp_path, "V = x", goal))
    try:
        assert decide(paper.claims[0]).verdict == "undecided"
    except ClaimError as trouble:
        assert "xreplace" in str(trouble)


def test_what_subs_leaves_is_put_in(tmp_path):
    goal = "Goal((equal((x/m + 2*y/(4 + 2*w**2)).subs({x: m*k, w: u - u + w}), k + y/(2 + w**2)),))"
    (paper,) = papers_in(folder(tmp_path, "V = x", goal))
    assert decide(paper.claims[0]).verdict == "proved"


@pytest.mark.parametrize("name", KEPT)
def test_what_keeps_its_domain_is_imported(name, tmp_path):
    assert papers_in(folder(tmp_path, KEPT[name]))

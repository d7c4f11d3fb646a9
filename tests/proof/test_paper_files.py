"""A proof file with a mistake: one clear line, and exit code 2 from the command line."""

import pytest

from workbench.cli.app import main
from workbench.errors import ClaimError, InputError
from workbench.proof.decide.engine import decide_all
from workbench.proof.paper import collect_papers

HEAD = """
import sympy as sp
from workbench.proof.claim import Goal, at_least, at_most, equal
from workbench.proof.paper import Paper
paper = Paper("a2020", "nobody, nowhere")
x = sp.Symbol("x", real=True)
"""
CLAIM = """
@paper.claim("{id}", "{id}", "inequality", "x", "{recorded}", premises={premises})
def goal_{number}():
    {body}
"""


def claim(number=1, identifier="1", body="return Goal((at_least(x**2, 0),))", premises="()", recorded="proved"):
    return CLAIM.format(number=number, id=identifier, body=body, premises=premises, recorded=recorded)


MISTAKES = {
    "no Python": ("this is no Python", "SyntaxError"),
    "a missing module": ("import there_is_no_such_module", "there_is_no_such_module"),
    "an exception": ("raise RuntimeError('broken on purpose')", "broken on purpose"),
    "a message of several lines": ("raise RuntimeError('one\\ntwo')", "one two"),
    "an exit": ("import sys; sys.exit(0)", "SystemExit"),
    "no paper": ("paper = None", "states no Paper"),
    "an empty file": ("", "states no Paper"),
    "an id used twice": (HEAD + claim(1) + claim(2), "a2020:1"),
    "an unknown premise": (HEAD + claim(premises="('99',)"), "a2020:99"),
    "premises in a circle": (HEAD + claim(1, premises="('2',)") + claim(2, "2", premises="('1',)"), "rests on itself"),
    "a float": (HEAD + claim(body="return Goal((at_least(x**2, -0.1),))"), "0.1"),
    "a text": (HEAD + claim(body="return Goal((at_least('x**2', 0),))"), "a2020:1"),
    "no goal": (HEAD + claim(body="return None"), "returns no Goal"),
    "an error in the goal": (HEAD + claim(body="return 1 / 0"), "a2020:1"),
    "a goal without relations": (HEAD + claim(body="return Goal(())"), "a2020:1"),
    "an unknown verdict": (HEAD + claim(recorded="true"), "true"),
    "an unknown kind": (HEAD + claim().replace('"inequality"', '"lemma"'), "'lemma' is none of identity"),
    "an id without a number": (HEAD + claim(identifier=""), "a2020:"),
    "an undeclared symbol": (HEAD + claim(body="return Goal((at_least(y**2, 0),))"),
                             "line 10: NameError: name 'y' is not defined: declare it"),
    "an undeclared symbol outside of claims": (HEAD + "V = y**2", "line 7: NameError"),
    "an error in the correction": (HEAD + claim(body="return Goal((at_least(x, 0),))").replace(
        "premises=()", "correction=lambda: Goal((at_least(y, 0),))"), "its correction cannot be made"),
    "a function that certificates do not know": (HEAD + claim(body="return Goal((at_least(sp.asinh(x), -1),))"),
                                                 "state the claim with + - * / **"),
    "one premise as text": (HEAD + claim(premises="'12'"), "write ('12',)"),
    "a title that is none": (HEAD + claim().replace('"1", "1"', '"1", None'), "its title is no text"),
    "a relation that is no tuple": (HEAD + claim(body="return Goal(at_least(x**2, 0))"), "no tuple of relations"),
    "a relation of sympy": (HEAD + claim(body="return Goal((x >= 0,))"), "no tuple of relations"),
    "a flow in a list": (HEAD + claim(body="return Goal((equal(x, x),), flow=[(x, 0)])"), "is no table"),
    "a rate of text": (HEAD + claim(body="return Goal((equal(x, x),), flow={x: '-x'})"), "is no expression"),
    "a flow of text": (HEAD + claim(body="return Goal((equal(x, x),), flow={'x': 0})"), "names no symbols"),
    "a float among stated values": (HEAD + claim().replace("premises=()", "at={x: 0.5}"), "Fraction(1, 2)"),
    "a value too few": (HEAD + claim().replace("premises=()", "at={sp.Symbol('y'): 1}"), "a2020:1"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistake_is_said_in_one_line_and_exits_with_2(name, tmp_path, capsys):
    text, part = MISTAKES[name]
    path = tmp_path / "a2020.py"
    path.write_text(text, encoding="utf-8")
    with pytest.raises((InputError, ClaimError)) as caught:
        decide_all([c for paper in collect_papers([path]) for c in paper.claims])
    assert part in str(caught.value)
    assert "\n" not in str(caught.value)
    with pytest.raises(SystemExit) as left:
        run(["prove", str(path), "--jobs", "1"])
    assert left.value.code == 2
    shown = capsys.readouterr().err
    assert "Traceback" not in shown
    assert part in " ".join(shown.split())
    assert name == "no paper" or "a2020.py" in shown


def run(arguments):
    """The command line in this process."""
    import sys
    from unittest import mock

    with mock.patch.object(sys, "argv", ["workbench", *arguments]):
        main()


def test_a_folder_without_files_and_a_path_that_is_not_there(tmp_path):
    for path in (tmp_path, tmp_path / "missing.py", tmp_path / "missing"):
        with pytest.raises(InputError, match=r"name a paper's folder"):
            collect_papers([path])
    with pytest.raises(SystemExit) as left:
        run(["prove", str(tmp_path)])
    assert left.value.code == 2


def test_a_differing_verdict_exits_with_1_and_a_right_one_with_0(tmp_path, capsys):
    path = tmp_path / "a2020.py"
    for recorded, code in (("refuted", 1), ("proved", 0)):
        path.write_text(HEAD + claim(recorded=recorded), encoding="utf-8")
        with pytest.raises(SystemExit) as left:
            run(["prove", str(path), "--jobs", "1"])
        assert left.value.code == code
    assert "decided proved, but recorded refuted" in " ".join(capsys.readouterr().err.split())

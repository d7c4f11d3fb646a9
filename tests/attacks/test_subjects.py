"""What a formula is of is read by closed lists of things: of any other nothing is taken, proved or refuted."""

import pytest
from subjects import HELD, LAW, LOOP, OTHER, PLAIN, PLANT

from workbench.paper.source.deciding import relates_letters_alone
from workbench.paper.source.folder import write_from_source
from workbench.paper.source.markdown import with_latex_headings
from workbench.paper.source.understood import is_marked, not_understood


def verdict(folder, text):
    shown = text.replace("[[", r"\begin{equation} \tag{T} ").replace("]]", r"\end{equation}")
    (folder / "paper.tex").write_text(rf"\documentclass{{article}}\begin{{document}} {shown} \end{{document}}")
    return write_from_source("paper2030", folder, folder / "paper.tex").verdicts["T"]


@pytest.mark.parametrize("text", (*OTHER, *HELD))
def test_what_is_of_another_thing_is_neither_proved_nor_refuted(text, tmp_path):
    assert verdict(tmp_path, text) == "undecided"


@pytest.mark.parametrize("text", PLAIN)
def test_what_is_of_the_plant_is_proved(text, tmp_path):
    assert verdict(tmp_path, text) == "proved"


def test_a_false_line_of_the_plant_is_refuted(tmp_path):
    false = LOOP.replace("The closed loop is", "Substitution gives").replace("+ k", "- k")
    assert verdict(tmp_path, f"{PLANT}The control law is {LAW}{false}") == "refuted"


@pytest.mark.parametrize(("said", "odd"), [
    ("the controller of the train is", ()), ("the controller of the leader is", ("leader",)),
    ("the observer is", ("observer",)), ("in the second step we choose the control law", ()),
    ("the second control law is", ("second",)), ("on the surface the control law is", ("on",))])
def test_the_words_that_are_not_understood_are_named(said, odd):
    assert not_understood(said.split(), False, False) == odd


def test_what_moves_beside_the_plant_bears_a_mark():
    assert not not_understood(["the", "observer", "is"], False, True)
    assert [is_marked(letter) for letter in (r"\dot{\hat{x}}", "x_{m}", "r", r"\dot{x}", "x_{1}")] == [
        True, True, True, False, False]


@pytest.mark.parametrize(("line", "alone"), [
    ("x = y", True), (r"x + 2 y \ge 0", True), (r"x y \ge 0", False), (r"\dot x = -x", False), ("x^2 > 0", False)])
def test_a_relation_of_bare_letters_may_be_a_condition(line, alone):
    assert relates_letters_alone(line) is alone


def test_headings_of_markdown_are_read_and_its_title_is_not(tmp_path):
    text = "# A note on trains\n\n## Model\n\n$x$\n### Law ###\n"
    assert with_latex_headings(text).split() == [r"\section{Model}", "$x$", r"\subsection{Law}"]
    assert with_latex_headings(rf"\documentclass{{article}} {text}").count("#") == text.count("#")
    plain = (PLANT + r"\n\n%s\n\nThe control law is " + LAW + LOOP).replace(r"\n", "\n")
    plain = plain.replace(r"\begin{equation}", "$$").replace(r"\end{equation}", "$$").replace("[[", r"$$\tag{T} ")
    found = {}
    for heading in ("## Control design", "## The leader", "~~Two laws~~"):
        (tmp_path / "paper.md").write_text("# Note\n\n" + plain.replace("]]", "$$") % heading)
        (tmp_path / heading[3:]).mkdir()
        found[heading] = write_from_source("paper2030", tmp_path / heading[3:], tmp_path / "paper.md").verdicts["T"]
    assert found == {"## Control design": "proved", "## The leader": "undecided", "~~Two laws~~": "undecided"}

"""What a paper says far from a formula may change what it means: then it is left to the author, and only then."""

import pytest
from false_elsewhere import KEPT, UNPROVED, UNREFUTED
from test_false_papers import paper, verdict

from workbench.paper.source.conventions import means_otherwise, moves_otherwise, no_number
from workbench.paper.source.deciding import left_to_the_author
from workbench.paper.source.document import read_source
from workbench.paper.source.folder import rows_and_letters
from workbench.paper.source.given import Gift, given_twice


def left(text, found):
    """Why a verdict on the formula does not count: as its row is no claim, or as its letters are not known; empty where
    it counts."""
    rows, letters, standing = rows_and_letters(read_source(paper("notes", text)))
    row = next(one for one in rows if one.id == "T")
    return row.unread or row.role if row.role != "claim" else left_to_the_author(
        row, found, standing["T"], rows, letters)


def test_what_may_mean_something_else_is_not_proved(tmp_path):
    claimed = [text for text in UNPROVED if not left(text, "proved")]
    assert not [text for number, text in enumerate(claimed)
                if verdict(tmp_path / str(number), "notes", text) == "proved"]
    assert len(claimed) < 6  # of which another line says that they give a rate twice, or the plant is not understood


@pytest.mark.parametrize("text", UNREFUTED)
def test_what_may_be_said_of_some_values_is_not_refuted(text):
    assert left(text, "refuted")


def test_what_is_said_harmlessly_lets_a_formula_be_decided(tmp_path):
    assert {text: why for text in KEPT if (why := left(text, "proved"))} == {}
    assert verdict(tmp_path / "last", "notes", KEPT[5]) == "proved"


def test_the_author_is_told_which_sentence_says_what_is_not_understood():
    assert "'In the second step the function becomes $x^2 - y^2$ .'" in left(UNPROVED[2], "proved")


def test_values_are_compared_as_they_are_read():
    assert not given_twice([Gift(0, "V", r"\tfrac12 x^2", "given"), Gift(1, "V", r"\frac{1}{2} x^{2}", "inline")])
    assert given_twice([Gift(0, "V", "x^2", "given"), Gift(1, "V", "-x^2", "inline")]) == {"V"}
    assert given_twice([Gift(0, r"\dot{x}", "-x", "given"), Gift(1, r"\dot{x}", "x", "inline")]) == {"x"}
    assert not given_twice([Gift(0, r"\dot{x}", "-x", "given"), Gift(1, r"\dot{x}", "x", "given")])  # it is claimed


@pytest.mark.parametrize(("text", "printed", "said"), [
    ("the hat denotes an estimate", "x^2", False), ("the hat denotes an upper bound", r"\hat x \ge x", True),
    ("two degrees of freedom and angles", r"\sin x", False), ("angles are measured in degrees", r"\cos x", True),
    ("trains are complex systems", "x^2", False), ("inequalities are understood elementwise", r"x \le y", True)])
def test_conventions_are_of_the_signs_that_they_name(text, printed, said):
    assert means_otherwise(text.split(), printed) is said


def test_words_for_what_is_no_number_and_for_another_plant():
    assert no_number(["the", "vector"], ["x"]) and no_number([], [r"x \in \mathbb{C}"])
    assert not no_number(["the", "state"], [r"x \in \mathbb{R}", r"y \in [0, 1]"])
    assert no_number(["the", "second", "component"], ["x^2"]) and not no_number(["the", "component"], ["x_2"])
    assert moves_otherwise(["another", "plant"]) and not moves_otherwise(["another", "proof"])

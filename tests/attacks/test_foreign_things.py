"""What is given of a thing that is on no list is the author's to read: neither proved nor refuted with it."""

import pytest
from foreign_things import CONSTRAINED, FALSE, FOREIGN, PLAIN, SUBJECTS

from workbench.paper.source.document import read_source
from workbench.paper.source.folder import write_from_source

HEAD = "\\documentclass{article}\\begin{document}\n"


def verdict(folder, text):
    shown = text.replace("[[", r"\begin{equation} \tag{T} ").replace("]]", r"\end{equation}")
    (folder / "paper.tex").write_text(f"{HEAD}{shown}\n\\end{{document}}\n")
    return write_from_source("paper2030", folder, folder / "paper.tex").verdicts["T"]


@pytest.mark.parametrize("text", FOREIGN)
def test_what_is_given_of_something_else_is_not_proved(text, tmp_path):
    assert verdict(tmp_path, text) == "undecided"


@pytest.mark.parametrize("text", CONSTRAINED)
def test_what_may_hold_along_a_motion_is_not_refuted(text, tmp_path):
    assert verdict(tmp_path, text) != "refuted"


@pytest.mark.parametrize("text", PLAIN)
def test_what_is_given_of_a_plant_and_its_law_is_taken(text, tmp_path):
    assert verdict(tmp_path, text) == "proved"


@pytest.mark.parametrize("text", FALSE)
def test_what_is_false_of_the_plant_itself_is_refuted(text, tmp_path):
    assert verdict(tmp_path, text) == "refuted"


@pytest.mark.parametrize("subject", SUBJECTS[:6])
def test_the_author_is_told_which_word_is_not_understood(subject):
    said = read_source(rf"Let $u \in \mathbb{{R}}$. {subject} \[ u = 0 . \]").said
    assert {*subject.lower().split()} & {*said.readings[1].unknown} - {"the", "is", "of"}

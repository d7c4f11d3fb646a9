"""Plants of second order are read as they are printed, solved for the second rate where it stands in a sum."""

import pytest
from second_order import FALSE, NEITHER, TRUE
from test_foreign_things import verdict

from workbench.proof.latex.sides import motions_in


@pytest.mark.parametrize("text", TRUE)
def test_what_follows_from_a_motion_of_second_order_is_proved(text, tmp_path):
    assert verdict(tmp_path, text) == "proved"


@pytest.mark.parametrize("text", FALSE)
def test_what_does_not_follow_from_it_is_refuted(text, tmp_path):
    assert verdict(tmp_path, text) == "refuted"


@pytest.mark.parametrize("text", NEITHER)
def test_a_motion_that_is_not_known_is_not_taken(text, tmp_path):
    assert verdict(tmp_path, text) == "undecided"


def test_coupled_second_rates_are_not_solved_for():
    assert [*motions_in(r"\ddot x + \ddot y = u")] == []
    assert [(one.order, one.rate) for one in motions_in(r"-k x - 2 m \ddot x = u")] == [
        (2, r"-(\frac{u - (- k x)}{2 m})")]

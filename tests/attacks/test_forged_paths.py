"""A path's time is a name of its own: no constant of the goal may pass for it."""

import pytest

from workbench.proof.checker import CertificateError, check

MOVES = {"flow": {"x": "c", "y": "1", "w": "x"}, "initial": {"x": "0", "y": "0", "w": "0"}}
PATH = {"path": {"x": "c**2/2", "y": "c", "w": "c**3/6"}, "time": "c", "duration": "1", "always": []}


def test_a_constant_rate_that_passes_for_time_refutes_nothing():
    """2 w = x y holds for every constant c: x = c y, w = c y^2/2."""
    with pytest.raises(CertificateError, match="time of its own name"):
        check({"version": 1, "verdict": "refuted", "goal": {"assume": [], "show": ["2*w == x*y"], **MOVES},
               "point": {"x": "1/2", "y": "1", "w": "1/6"}, **PATH})


def test_nor_is_it_an_example_of_what_no_motion_meets():
    with pytest.raises(CertificateError, match="time of its own name"):
        check({"version": 1, "verdict": "proved", "example": {"x": "1/2", "y": "1", "w": "1/6"}, **PATH, "goal": {
            "assume": ["2*w < x*y"], "show": ["0 < x*y - 2*w"], **MOVES}, "proofs": [
                {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]}]}]})


def test_a_path_in_a_time_of_its_own_is_accepted():
    check({"version": 1, "verdict": "refuted", "goal": {"assume": [], "show": ["w == x*y"], **MOVES},
           "point": {"x": "1", "y": "1", "w": "1/2", "c": "1"},
           "path": {"x": "s", "y": "s", "w": "s**2/2"}, "time": "s", "duration": "1", "always": []})

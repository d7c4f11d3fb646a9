"""A line that may say two things is refused, a definition holds where it is a number, and time passes."""

import pytest
import sympy as sp
from false_sentences import PROVED, REFUSED, SYMBOLS, UNPROVED

from workbench.errors import InputError
from workbench.proof.decide.tangents import _least
from workbench.proof.latex.symbols import load_symbols


def test_what_may_say_two_things_is_refused_and_its_true_neighbours_are_proved(outcome):
    assert {line: outcome(line) for line in REFUSED} == dict.fromkeys(REFUSED, "refused")
    assert {line: outcome(line) for line in PROVED} == dict.fromkeys(PROVED, "proved")


def test_what_is_false_as_time_passes_or_where_it_is_not_defined_is_not_proved(outcome):
    assert not {line: found for line in UNPROVED if (found := outcome(line)) == "proved"}


@pytest.mark.parametrize(("more", "key"), [("t = '2'", "flow.t"), ("", "inputs")])
def test_time_has_the_rate_one(more, key, tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text(("" if more else "inputs = ['t']\n") + SYMBOLS + more)
    with pytest.raises(InputError, match="gives the time t another rate than 1") as refused:
        load_symbols(path)
    assert refused.value.key == key


def test_a_search_goes_on_where_its_line_is_defined_nowhere_on_a_way():
    x, y = sp.symbols("x y", real=True)
    assert [*_least(y + 1 / (x - 1), [y], ())] == [[1]] * 3  # where x is 1 nothing is, where y is 1 something

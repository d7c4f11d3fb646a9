"""No notation makes a false line of LaTeX a proved one, and no usual one keeps a true line from being proved."""

from false_notations import FALSE, SAME, SYMBOLS, TRUE

__all__ = ["SYMBOLS"]  # the letters that the fixtures read


def test_what_is_false_as_it_is_printed_is_not_proved(outcome):
    assert not [line for line in FALSE if outcome(line) == "proved"]


def test_what_is_true_beside_it_is_proved_or_the_same_text(outcome):
    meant = dict.fromkeys(TRUE, "proved") | dict.fromkeys(SAME, "same")
    assert {line: outcome(line) for line in meant} == meant

"""No formula is proved that differs from a true one in a sign, a word or a bracket; the true ones are."""

from false_formulas import REFUSED, REFUTED, SYMBOLS, TRUE  # noqa: F401 - SYMBOLS are the letters of `outcome`


def test_what_is_false_is_refuted_and_what_is_true_is_proved(outcome):
    assert {line: outcome(line) for line in REFUTED} == dict.fromkeys(REFUTED, "refuted")
    assert {line: outcome(line) for line in TRUE} == dict.fromkeys(TRUE, "proved")


def test_what_words_and_signs_make_of_it_is_not_passed_over(outcome):
    assert {line: outcome(line) for line in REFUSED} == dict.fromkeys(REFUSED, "refused")


def test_there_are_enough_of_them():
    assert len({*REFUTED, *REFUSED}) >= 90 and len({*TRUE}) >= 60

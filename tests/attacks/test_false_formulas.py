"""No formula is proved that differs from a true one in a sign, a word or a bracket; the true ones are."""

import pytest
from false_formulas import REFUSED, REFUTED, SYMBOLS, TRUE

from workbench.errors import WorkbenchError
from workbench.proof.latex.question import answer
from workbench.proof.latex.symbols import load_symbols


@pytest.fixture(scope="module")
def symbols(tmp_path_factory):
    path = tmp_path_factory.mktemp("formulas") / "symbols.toml"
    path.write_text(SYMBOLS)
    return load_symbols(path)


def verdicts(lines, symbols):
    return {line: answer(line, symbols).decision.verdict for line in lines}


def test_what_is_false_is_refuted_and_what_is_true_is_proved(symbols):
    assert verdicts(REFUTED, symbols) == dict.fromkeys(REFUTED, "refuted")
    assert verdicts(TRUE, symbols) == dict.fromkeys(TRUE, "proved")


def test_what_words_and_signs_make_of_it_is_not_passed_over(symbols):
    for line in REFUSED:
        with pytest.raises(WorkbenchError) as refused:
            answer(line, symbols)
        assert "\n" not in str(refused.value), line


def test_there_are_enough_of_them():
    assert len({*REFUTED, *REFUSED}) >= 90 and len({*TRUE}) >= 60

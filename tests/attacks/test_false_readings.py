"""What is false as it is printed is not proved by the way in which it is read."""

import pytest
from false_readings import FALSE, SYMBOLS, TRUE

from workbench.errors import InputError, WorkbenchError
from workbench.proof.latex.question import answer
from workbench.proof.latex.symbols import load_symbols


@pytest.fixture(scope="module")
def symbols(tmp_path_factory):
    path = tmp_path_factory.mktemp("read") / "symbols.toml"
    path.write_text(SYMBOLS)
    return load_symbols(path)


def outcome(line, symbols):
    try:
        return answer(line, symbols).decision.verdict
    except WorkbenchError as trouble:
        assert "\n" not in str(trouble)
        return "same" if "nothing is left" in str(trouble) else "refused"


@pytest.mark.parametrize("name", FALSE)
def test_what_is_false_as_it_is_printed_is_not_proved(name, symbols):
    assert outcome(FALSE[name], symbols) in ("refuted", "undecided", "refused")


@pytest.mark.parametrize("line", TRUE)
def test_what_is_true_is_not_refuted(line, symbols):
    assert outcome(line, symbols) in ("proved", "same", "undecided")


@pytest.mark.parametrize(("typed", "key"), [
    ("'q' = 'real'\n'\\dot q' = 'real'\n[flow]\n'\\dot q' = '-q'", r"symbols.\dot q"),
    ("'q' = 'real'\n'\\dot q' = 'real'\n[flow]\n'q' = '-q'", r"symbols.\dot q"),
    ("'q' = 'real'\n'\\dot q' = 'real'\n'\\ddot q' = 'real'\n[flow]\n'q' = '\\dot q'", r"symbols.\ddot q"),
    ("'q' = 'real'\n[definitions]\n'V' = 'q^2'\n'\\dot V' = '-q^2'\n[flow]\n'q' = 'q'", r"definitions.\dot V"),
])
def test_a_letter_with_a_dot_is_the_rate_of_the_letter_below_it(typed, key, tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text(f"[symbols]\n{typed}\n")
    with pytest.raises(InputError) as refused:
        load_symbols(path)
    assert refused.value.key == key


def test_a_letter_with_a_dot_may_be_a_rate_that_is_stated(tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text("[symbols]\n'q' = 'real'\n'\\dot q' = 'real'\n[definitions]\n'V' = 'q^2 + {\\dot q}^2'\n[flow]\n"
                    "'q' = '\\dot q'\n'\\dot q' = '-q'\n")
    assert answer(r"\dot V = 0", load_symbols(path)).decision.verdict == "proved"

"""What is false as it is printed is not proved by the way in which it is read."""

import pytest
from false_readings import FALSE, SYMBOLS, TRUE  # noqa: F401 - SYMBOLS are the letters of `outcome`

from workbench.errors import InputError
from workbench.proof.latex.question import answer
from workbench.proof.latex.symbols import load_symbols


@pytest.mark.parametrize("name", FALSE)
def test_what_is_false_as_it_is_printed_is_not_proved(name, outcome):
    assert outcome(FALSE[name]) in ("refuted", "undecided", "refused")


@pytest.mark.parametrize("line", TRUE)
def test_what_is_true_is_not_refuted(line, outcome):
    assert outcome(line) in ("proved", "same", "undecided")


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


# What is printed as a function of time, or of what moves, is no constant: each would hold if it were.
VARYING = {
    "printed so in a rate": ("'d' = 'real'\n[flow]\n'x' = '-x + d(t)'", r"\ddot x = x - d"),
    "printed so in the line": ("'d' = 'real'\n[flow]\n'x' = '-x + d'", r"\ddot x = x - d(t)"),
    "printed so in a definition": ("'d' = 'real'\n[definitions]\n'V' = 'x^2 + d^2(t)'\n[flow]\n'x' = '-x'",
                                   r"\dot V = -2x^2"),
    "a value at time t": ("'d(t)' = 'real'\n[flow]\n'x' = '-x + d(t)'", r"\ddot x = x - d(t)"),
    "a value at what moves": ("'f(x)' = 'real'\n[definitions]\n'V' = 'x^2 + f(x)'\n[flow]\n'x' = '-x'",
                              r"\dot V = -2x^2"),
    "a value at an input": ("'u' = 'real'\n'f(u)' = 'real'\n[flow]\n'x' = '-x + u(t)'",
                            r"\frac{d}{dt}(x f(u)) = f(u)(u - x)"),
    "a component at time t": ("'v' = 'vector'\n[flow]\n'x' = '-x'",
                              r"\frac{d}{dt}(x\sum_{i=1}^n v_i(t)) = -x\sum_{i=1}^n v_i"),
    "a product's power": ("'cx' = 'positive'\n'c' = 'real'\n[flow]\n'x' = '0'", "cx^2 > 0"),
}


@pytest.mark.parametrize("name", VARYING)
def test_what_varies_as_it_is_printed_is_no_constant(name, outcome, tmp_path):
    path = tmp_path / "symbols.toml"
    typed, line = VARYING[name]
    path.write_text(f"[symbols]\n'x' = 'real'\n{typed}\n")
    assert outcome(line, load_symbols(path)) == "refused"


# Within a sum its index is bound, whatever letter it counts by: a piece that bears it is no constant factor.
BOUND = (r"\sum_{j=1}^n q_j v_j = q_j \sum_{j=1}^n v_j", r"\sum_{l=1}^n q_l v_l = q_j \sum_{l=1}^n v_l",
         r"\sum_{j=1}^n q^{(j)} v_j = q^{(j)} \sum_{j=1}^n v_j", r"\sum_{j=1}^n f(j) v_j = f(j) \sum_{j=1}^n v_j",
         r"\sum_{i=1}^n p_{ij} v_i = p_{ij} \sum_{i=1}^n v_i", r"\sum_{j=1}^n p_{ij}^2 v_j = p_{ij}^2 \sum_{j=1}^n v_j")


def test_a_number_with_the_index_of_a_sum_is_no_constant_factor(outcome, tmp_path):
    path = tmp_path / "symbols.toml"
    numbers = ("q_j", "q^{(j)}", "f(j)", "p_{ij}")
    path.write_text("[symbols]\n'v' = 'vector'\n" + "".join(f"'{q}' = 'real'\n" for q in numbers))
    symbols = load_symbols(path)
    assert {line: outcome(line, symbols) for line in BOUND} == dict.fromkeys(BOUND, "refused")


def test_least_and_greatest_have_no_index_of_their_letters(outcome, tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text("[symbols]\n'v' = 'vector'\n'\\lambda_{\\min}' = 'real'\n")
    line = r"\sum_{i=1}^n \lambda_{\min} v_i = \lambda_{\mathrm{min}} \sum_{k=1}^n v_k"
    assert outcome(line, load_symbols(path)) == "proved"


def test_what_is_printed_with_its_time_may_have_a_rate_or_be_a_first_value(tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text("[symbols]\n'x' = 'real'\n'V(0)' = 'real'\n'k' = 'positive'\n[flow]\n'x' = '-k(t) x'\n'k' = '0'\n")
    symbols = load_symbols(path)
    assert not symbols.inputs
    assert answer(r"\ddot x(t) = k^2 x", symbols).decision.verdict == "proved"
    assert answer(r"\frac{d}{dt}(x V(0)) = -k x V(0)", symbols).decision.verdict == "proved"


def test_a_letter_with_a_dot_may_be_a_rate_that_is_stated(tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text("[symbols]\n'q' = 'real'\n'\\dot q' = 'real'\n[definitions]\n'V' = 'q^2 + {\\dot q}^2'\n[flow]\n"
                    "'q' = '\\dot q'\n'\\dot q' = '-q'\n")
    assert answer(r"\dot V = 0", load_symbols(path)).decision.verdict == "proved"

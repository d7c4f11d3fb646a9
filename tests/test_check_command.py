"""`workbench check`: a pasted line is decided, and what was decided is shown."""

import json
import re
from fractions import Fraction

import pytest
from command_line import run
from scenarios import ROOT

from workbench.errors import ClaimError, InputError, WorkbenchError
from workbench.proof.checker import check
from workbench.proof.latex.question import answer, asked
from workbench.proof.latex.read import read_line
from workbench.proof.latex.symbols import load_symbols

SYMBOLS = r"""
assumptions = ['e_1^2 < k^2']
[symbols]
'e_1' = "real"
'\hat\theta_1' = "real"
'\lambda' = "real"
'k' = "positive"
'\alpha' = "positive"
'\tilde W' = "vector"
'h' = "vector"
[definitions]
'V_1' = '\tfrac12\ln\frac{k^2}{k^2 - e_1^2}'
'V_2' = 'V_1 + \tfrac12\tilde W^T\tilde W'
[flow]
'e_1' = '-\alpha e_1'
'\tilde W' = '-\alpha\tilde W'
"""


@pytest.fixture
def symbols(tmp_path):
    path = tmp_path / "symbols.toml"
    path.write_text(SYMBOLS)
    return path


@pytest.mark.parametrize(("line", "verdict"), [
    (r"\dot V_1 = -\alpha\frac{e_1^2}{k^2 - e_1^2}", "proved"),
    (r"\dot V_2 \le -\alpha\tilde W^T\tilde W", "proved"),
    (r"\ln\frac{k^2}{k^2 - e_1^2} \le \frac{e_1^2}{k^2 - e_1^2}", "proved"),
    (r"\ln\frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2}", "refuted"),
    (r"\tilde W^Th \le \tfrac12\|\tilde W\|^2 + \tfrac12\sum_{j=1}^n h_j^2", "proved"),
    (r"\tilde W^Th \le \tfrac12\|\tilde W\|^2", "refuted"),
    (r"2\tilde W^Th = \sum_{i=1}^n 2\tilde W_ih_i", "proved"),
    (r"2\tilde W^Th \le \sum_{i=1}^n h_i^2 + \sum_{k=1}^n\tilde W_k^2", "proved"),
    (r"\lambda > 0 \Rightarrow \lambda^2 > 0", "proved"),
    (r"\lambda^2 > 0", "refuted"),
    (r"\hat{\theta}_1 \in [0, k] \Rightarrow \hat\theta_1^2 \le k^2", "proved"),
    (r"\dot\lambda = -\lambda \Rightarrow \frac{d}{dt}\lambda^2 = -2\lambda^2", "proved"),
    (r"\dot\lambda = \lambda \Rightarrow \frac{d}{dt}\lambda^2 = -2\lambda^2", "refuted"),
])
def test_a_line_is_decided_with_a_certificate_that_checks(symbols, line, verdict):
    found = answer(line, load_symbols(symbols))
    assert found.decision.verdict == verdict
    check(found.decision.certificate)
    assert (found.counterexample != {}) == (verdict == "refuted")


def test_what_is_shown_is_made_from_the_goal_and_reads_back(symbols):
    loaded = load_symbols(symbols)
    found = answer(r"e_1 = k \Rightarrow \dot V_1 \ge \hat\theta_1 - |e_1|", loaded).document()
    goal = found["goal"]
    assert goal["constant"] == [r"\alpha", "k", r"\hat\theta_1"]
    assert goal["flow"][0] == r"\frac{d}{dt} e_1 = - \alpha e_1"
    assert set(goal["assume"]) == {r"\alpha > 0", "k > 0", "e_1^{2} < k^{2}", "e_1 = k"}
    again = asked(f"{', '.join(goal['assume'])} \\Rightarrow {goal['show'][0]}", loaded)
    assert again.show == asked(r"\dot V_1 \ge \hat\theta_1 - |e_1|", loaded).show
    for text in (*goal["show"], *goal["assume"], *goal["flow"]):
        read_line(text)


def test_what_varies_without_a_rate_is_an_input_and_no_constant(tmp_path):
    path = tmp_path / "symbols.toml"
    typed = "[symbols]\n'x' = 'real'\n'w' = 'real'\n'k' = 'positive'\n[flow]\n'x' = '-kx + w'\n"
    line = r"\ddot x = k^2x - kw"
    path.write_text(typed)
    assert answer(line, load_symbols(path)).decision.verdict == "proved"
    path.write_text("inputs = ['w']\n" + typed)
    loaded = load_symbols(path)
    moved = answer(r"\dot x = w - kx", loaded).document()
    assert moved["verdict"] == "proved" and moved["certificate"]["goal"]["inputs"] == ["w"]
    assert (moved["goal"]["inputs"], moved["goal"]["constant"]) == (["w"], ["k"])
    with pytest.raises(ClaimError, match="rate of the input w"):
        answer(line, loaded)


@pytest.mark.parametrize("line", [
    r"\tilde W^Th = h^T\tilde W", r"e_1 + e_1 = 2e_1", r"\|-h\| \le \|h\|", r"10^3 = 1000"])
def test_a_line_that_is_true_as_it_is_read_says_so(symbols, line):
    with pytest.raises(WorkbenchError, match="nothing is left to decide"):
        answer(line, load_symbols(symbols))


@pytest.mark.parametrize(("inputs", "why"), [("['v']", "none of the symbols"), ("['x']", "has a rate")])
def test_an_input_is_a_symbol_without_a_rate(tmp_path, inputs, why):
    path = tmp_path / "symbols.toml"
    path.write_text(f"inputs = {inputs}\n[symbols]\n'x' = 'real'\n[flow]\n'x' = '-x'\n")
    with pytest.raises(InputError, match=why) as refused:
        load_symbols(path)
    assert refused.value.key == "inputs[0]"


def test_a_counterexample_is_named_by_the_letters_of_the_file(symbols):
    found = answer(r"\hat\theta_1^2 \ge \hat\theta_1", load_symbols(symbols))
    value = Fraction(found.counterexample[r"\hat\theta_1"])
    assert value**2 < value


@pytest.mark.parametrize(("line", "why"), [
    (r"\mu = 1", "letter '\\mu' is not in the notation"), (r"\dot\lambda = 0", "does not move"),
    (r"\frac{e_1}{e_1} = 1", "cancels"), (r"\lambda \to 0", "relations"), (r"\lambda", "no relation"), ("", "empty"),
    (r"\lambda =", "ends where"), ("x" * 100_000, "at most"), (r"\exists k: k > 0", "exists"),
    (r"\sum_{i=1}^n h_ih_j \ge 0", "the index 'j' too"), (r"\tilde W \le k", "vector"),
])
def test_a_line_that_is_no_goal_is_refused_in_one_line(symbols, line, why):
    with pytest.raises(WorkbenchError) as refused:
        answer(line, load_symbols(symbols))
    assert why in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize(("old", "new", "key"), [
    ('"positive"', '"negative"', "symbols.k"), ("'e_1' = \"real\"", "'e_1 +' = \"real\"", "symbols"),
    ("'V_1' =", "'k' =", "definitions.k"), ("\\frac{k^2}", "\\frac{q^2}", "definitions.V_1"),
    ("'e_1' = '-", "'e_2' = '-", "flow.e_2"), ("e_1^2 < k^2", "e_1^2 < ", "assumptions[0]"),
    ("[symbols]", "[letters]", "letters"), ("e_1^2 < k^2", "e_1 = 0 \\Rightarrow k > 0", "assumptions[0]"),
    ("'\\lambda' =", "'n' =", "symbols"), ("'-\\alpha e_1'", "'\\tilde W'", "flow.e_1"),
])
def test_a_mistake_in_the_file_is_named_with_its_key(symbols, old, new, key):
    assert old in SYMBOLS
    symbols.write_text(SYMBOLS.replace(old, new, 1))
    with pytest.raises(InputError) as refused:
        load_symbols(symbols)
    assert refused.value.where == str(symbols)
    assert refused.value.key == key
    assert "\n" not in str(refused.value)


def test_words_of_python_and_of_certificates_may_be_letters(tmp_path):
    path = tmp_path / "symbols.toml"
    letters = (r"\lambda", "D", r"\lambda_1", "x_1", "x^1")
    path.write_text("[symbols]\n" + "".join(f"'{typed}' = 'real'\n" for typed in letters))
    loaded = load_symbols(path)
    names = [str(symbol) for symbol in loaded.notation.values() if symbol.is_Symbol]
    assert len(set(names)) == 5
    assert answer(r"\lambda^2 + D^2 + \lambda_1^2 \ge 0", loaded).decision.verdict == "proved"


def test_what_takes_longer_than_its_limit_stays_undecided(symbols):
    found = answer(r"\tilde W^Th \le \tfrac12\|\tilde W\|^2 + \tfrac12\sum_{j=1}^n h_j^2", load_symbols(symbols), 1e-3)
    assert found.decision.verdict == "undecided" and "--limit" in found.decision.method
    assert found.shown  # how it was read is shown all the same


def test_the_command_says_its_verdict_by_its_exit_code(symbols, tmp_path):
    def asked_for(line, *more):
        return run("check", line, "--symbols", symbols, *more)

    proved = asked_for(r"\lambda^2 \ge 0", "--json", str(tmp_path / "answer.json"))
    assert proved.returncode == 0 and "proved" in proved.stdout and "λ² ≥ 0" in proved.stdout
    document = json.loads((tmp_path / "answer.json").read_text())
    assert document["verdict"] == "proved" and document["goal"]["show"] == [r"\lambda^{2} \ge 0"]
    check(document["certificate"])
    assert asked_for(r"-\lambda^2 \le 0").returncode == 0
    refuted = asked_for(r"\lambda^2 > 0")
    assert refuted.returncode == 1 and "λ = 0" in refuted.stdout
    refused = asked_for(r"\mu > 0")
    assert refused.returncode == 2 and refused.stderr.count("\n") == 1 and refused.stdout == ""


PAPER = """
import sympy as sp
from workbench.proof.claim import Goal, at_least
from workbench.proof.paper import Paper

e = sp.Symbol("e_hat_1", real=True)
k = sp.Symbol("k", positive=True)
{paper}
"""
STATED = r"paper = Paper('lent', 'nobody', notation={r'\hat e_1': e, 'k': k, 'V': e**2 / k})"


def test_a_paper_lends_its_letters(tmp_path):
    path = tmp_path / "lent.py"
    path.write_text(PAPER.replace("{paper}", STATED))
    found = answer(r"V \ge \hat e_1", load_symbols(path))
    assert found.decision.verdict == "refuted" and set(found.counterexample) == {r"\hat{e}_{1}", "k"}
    for text, why in ((STATED.partition(", notation")[0] + ")", "no meaning"), (STATED + "\nother = " + STATED[8:],
                                                                               "states 2 papers")):
        path.write_text(PAPER.replace("{paper}", text))
        with pytest.raises(InputError, match=why):
            load_symbols(path)


def test_the_example_of_the_readme_is_proved(tmp_path):
    section = (ROOT / "README.md").read_text(encoding="utf-8").partition("## Check a line")[2].partition("\n## ")[0]
    (table,) = re.findall(r"```toml\n(.*?)```", section, re.DOTALL)
    (line,) = re.findall(r"workbench check '(.*?)'", section)
    path = tmp_path / "symbols.toml"
    path.write_text(table, encoding="utf-8")
    assert answer(line, load_symbols(path)).decision.verdict == "proved"

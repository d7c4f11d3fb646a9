"""A paper's LaTeX source as rows: numbers as LaTeX prints them, letters, references, what is decided and what waits."""

import re
import shutil
from pathlib import Path

import pytest
from test_cli import one_line, run

from workbench.errors import InputError
from workbench.paper.source import document, folder
from workbench.paper.source.document import read_source
from workbench.paper.source.folder import write_from_source
from workbench.paper.source.letters import assumed_formulas, defined_in_text, values_and_rates
from workbench.paper.source.lines import chained, system_lines, without_end
from workbench.paper.source.macros import SourceError, expanded
from workbench.proof.latex.rows import ROWS, SYMBOLS, LettersFile, RowsFile, load_record
from workbench.proof.latex.symbols import SymbolsFile, symbols_in
from workbench.proof.prove import prove
from workbench.proof.selection import targets

SOURCES = Path(__file__).parent / "sources"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    return write_from_source("doe2029", tmp_path_factory.mktemp("from"), SOURCES / "backstepping.tex")


def rows_of(folder):
    return {row.id: row for row in load_record(folder / ROWS, RowsFile).rows}


def verdicts_of(folder):
    return {one.claim.equation: one.verdict for one in prove(targets([str(folder)]), 1).decisions}


def test_every_numbered_piece_is_a_row_with_latex_s_number_in_the_paper_s_order(written):
    assert [*rows_of(written.folder)] == [
        "1.1a", "1.1b", "assumption1", "1.2", "2.1", "2.2", "2.3", "A1", "2.4", "2.5.case1", "2.5.case2", "2.6",
        "theorem1", "lemma2", "remark", "display1"]
    titles = [row.title for row in rows_of(written.folder).values() if row.role == "words"]
    assert titles == ["Assumption 1: bounded disturbance", "Theorem 1", "Lemma 2", "Remark"]


def test_macros_are_put_in_and_layout_is_taken_out(written):
    rows = rows_of(written.folder)
    assert rows["1.1b"].printed == r"\dot{\hat\theta} = \gamma x^2"
    assert rows["2.2"].printed == r"V = \tfrac{1}{2} x^2 + \tfrac{1}{2}\frac{(\theta - \hat\theta)^2}{\gamma}"
    assert rows["2.3"].printed == r"\dot V = \theta x^2 + x u - (\theta - \hat\theta) x^2 = -k x^2"
    assert rows["2.5.case2"].line == r"|x| = -x \text{if} x < 0"


def test_references_become_what_a_row_rests_on(written):
    rows = rows_of(written.folder)
    assert rows["2.3"].rests_on == ("1.1a", "1.1b", "2.1")
    assert rows["theorem1"].rests_on == ("1.1a", "1.1b", "2.1", "2.3", "lemma2")
    assert rows["lemma2"].rests_on == ("2.2",)


def test_roles_and_letters_come_from_the_text_and_what_is_not_said_is_left_empty(written):
    rows = rows_of(written.folder)
    assert {row.id for row in rows.values() if row.role == "definition"} == {"2.1", "2.2"}
    assert {row.id for row in rows.values() if row.role == "dynamics"} == {"1.1a", "1.1b"}
    letters = load_record(written.folder / SYMBOLS, LettersFile).letters
    found = {letter: (entry.kind, entry.role) for letter, entry in letters.items()}
    assert found == {"x": ("real", "state"), r"\hat{\theta}": ("real", "state"), r"\theta": ("real", "constant"),
                     "k": ("positive", "constant"), r"\gamma": ("positive", "constant"), "d": ("real", "input"),
                     "D": ("positive", "constant"), "z": ("", "")}


def test_what_has_its_letters_is_decided_at_once_and_the_rest_says_what_is_missing(written):
    assert {row: verdict for row, verdict in written.verdicts.items() if verdict != "undecided"} == {
        "1.1a": "assumed", "1.1b": "assumed", "1.2": "assumed", "2.1": "assumed", "2.2": "assumed", "2.3": "proved",
        "A1": "proved", "2.4": "refuted", "2.5.case1": "proved", "2.5.case2": "proved"}
    assert "z is: fill in kind" in written.missing["2.6"]
    assert "words" in written.missing["theorem1"]
    assert {row.id: row.recorded for row in rows_of(written.folder).values() if row.role == "claim"} == {
        row: written.verdicts[row] for row in ("2.3", "A1", "2.4", "2.5.case1", "2.5.case2", "2.6", "display1")}


def test_a_letter_filled_in_lets_its_row_be_decided_and_an_assumption_counts_where_it_is_named(written, tmp_path):
    folder = tmp_path / "doe2029"
    shutil.copytree(written.folder, folder)
    table = (folder / SYMBOLS).read_text()
    assert "'z'" in table
    lines = [line.replace("kind = ''", "kind = 'real'") if line.startswith("'z'") else
             line.replace("'real'", "'nonnegative'") if line.startswith("'x'") else line for line in table.splitlines()]
    (folder / SYMBOLS).write_text("\n".join(lines) + "\n")
    text = (folder / ROWS).read_text()
    (folder / ROWS).write_text(text.replace(r"printed = 'x d \le x D'", "printed = 'x d \\le x D'\nrests_on = ['1.2']"))
    found = verdicts_of(folder)
    assert found["2.6"] == "proved" and found["2.4"] == "proved"


def test_a_letter_that_may_move_is_no_constant_of_a_rate(written, tmp_path):
    """Nobody says whether theta moves: V's rate may then not be taken as if it stood still."""
    folder = tmp_path / "doe2029"
    shutil.copytree(written.folder, folder)
    table = (folder / SYMBOLS).read_text()
    lines = [line.replace("'constant'", "''") if line.startswith(r"'\theta'") else line for line in table.splitlines()]
    (folder / SYMBOLS).write_text("\n".join(lines) + "\n")
    assert verdicts_of(folder)["2.3"] == "undecided"


def test_a_second_paper_with_other_layouts(tmp_path):
    found = write_from_source("roe2029", tmp_path, SOURCES / "twisting.tex")
    assert dict(found.verdicts) == {"1": "assumed", "2": "assumed", "3": "proved", "4": "proved",
                                    "theorem1": "undecided", "5": "refuted"}
    assert rows_of(found.folder)["theorem1"].rests_on == ("3", "4")


def test_the_command_says_what_was_found(tmp_path):
    shutil.copy(SOURCES / "twisting.tex", tmp_path)
    answer = run("new-paper", "roe2029", "--from", "twisting.tex", folder=tmp_path)
    assert answer.returncode == 0, answer.stderr
    assert "roe2029:4  proved" in answer.stdout and "roe2029:theorem1  not decided: " in answer.stdout
    assert "exists already" in one_line(run("new-paper", "roe2029", "--from", "twisting.tex", folder=tmp_path))
    (tmp_path / "empty.tex").write_text("nothing")
    assert "no displayed formula" in one_line(run("new-paper", "poe2029", "--from", "empty.tex", folder=tmp_path))
    assert not (tmp_path / "poe2029").exists()


@pytest.mark.parametrize(("text", "plain"), [
    (r"\newcommand{\al}{\alpha}\al x", r"\alpha x"), (r"\newcommand\f[2][a]{#1+#2}\f{b} \f[c]{d}", "a+b c+d"),
    (r"\def\g#1{\hat{#1}}\g x", r"\hat{x}"), (r"\newcommand{\a}{\b}\newcommand{\b}{1}\a", "1"),
    (r"\providecommand{\a}{2}\a \% % gone", r"2 \% % gone"), (r"\let\e=\varepsilon\e x", r"\varepsilon x"),
    (r"\DeclarePairedDelimiter\n{\lVert}{\rVert}\n{x} \n*{y} \n[\big]{z}",
     r"\lVert x\rVert \lVert y\rVert \lVert z\rVert"),
    (r"\newenvironment{e}{\begin{equation}}{\end{equation}}\begin{e}x\end{e}", r"\begin{equation}x\end{equation}")])
def test_macros(text, plain):
    assert expanded(text) == plain


@pytest.mark.parametrize(("text", "words"), [
    (r"\newcommand{\a}{\a}\a", "stands for itself"), (r"\newcommand{\a}{b", "not closed"),
    (r"\begin{equation} x = 1", "no end")])
def test_a_source_that_cannot_be_read_is_one_line(text, words):
    with pytest.raises(SourceError, match=words):
        read_source(text)


def test_a_source_whose_tables_would_be_too_large_to_read_is_named_and_nothing_is_written(tmp_path, monkeypatch):
    with monkeypatch.context() as small:
        small.setattr(folder, "MOST_SHOWN", 2000)
        with pytest.raises(InputError, match=r"backstepping.tex: becomes tables of more than"):
            write_from_source("grown2030", tmp_path, SOURCES / "backstepping.tex")
    # What macros make of a few lines is refused before its formulas are read.
    monkeypatch.setattr(document, "cleaned", pytest.fail)
    many = r"\newcommand{\a}{" + "x" * 40_000 + r"}\newcommand{\b}{\a\a\a\a\a\a}" + "\n"
    with pytest.raises(SourceError, match="becomes tables of more than 2 MiB"):
        read_source(many + r"\begin{equation} V = \b\b\b\b\b\b\b\b\b \end{equation}")
    assert not list(tmp_path.iterdir())


PARTS = r"""\documentclass{article}\newtheorem{assumption}{Assumption}
\begin{document}
\input{body}
% \input{gone}
\begin{align}
x d &\le \tfrac12 x^2 + \tfrac12 d^2, \\
|x| &= x \operatorname{sgn}(x) \notag \\
x^2 &\ge 0 , \\
a &\le b \notag \\
  &\le c
\end{align}
\end{document}
"""
BODY = r"""\begin{assumption} The gain satisfies $k > 0$. \end{assumption}
\begin{subequations} \begin{align} \dot x &= -k x \\ \dot y &= x \end{align} \end{subequations}
"""


def test_what_is_put_into_other_files_is_read_and_a_line_without_a_number_stands_alone(tmp_path):
    (tmp_path / "body.tex").write_text(BODY)
    (tmp_path / "main.tex").write_text(PARTS)
    rows = rows_of(write_from_source("noe2029", tmp_path, tmp_path / "main.tex").folder)
    assert list(rows) == ["assumption1", "1a", "1b", "2", "display1", "3", "4"]
    assert (rows["3"].printed, rows["4"].printed) == (r"x^2 \ge 0", r"a \le b \le c")


@pytest.mark.parametrize(("named", "why"), [("gone", "no file of its folder"), ("../body", "no file of its folder"),
                                            ("main", "inputs itself")])
def test_a_file_that_is_not_there_is_named(tmp_path, named, why):
    (tmp_path / "body.tex").write_text(BODY)
    (tmp_path / "sub").mkdir()
    source = tmp_path / "sub" / "main.tex"
    source.write_text(PARTS.replace("{body}", f"{{{named}}}"))
    with pytest.raises(InputError, match=why):
        write_from_source("noe2029", tmp_path, source)
    assert not (tmp_path / "noe2029").exists()


def test_what_is_told_missing_is_what_the_author_can_fill_in(tmp_path):
    """V is defined by a row: what its definition lacks is told instead of it. Signs may stand behind the letters."""
    source = tmp_path / "paper.tex"
    source.write_text(r"""\documentclass{article}\begin{document}
Let the gains $c, \gamma$ be positive constants; $b$ is not positive, and $M$ is positive definite.
\begin{equation} \dot x = -c x + b \end{equation} \begin{equation} V = z^2 + \gamma M \end{equation}
\begin{equation} V \ge 0 \end{equation}\end{document}""")
    written = write_from_source("mine2026", tmp_path, source)
    assert "does not say what M, z are: fill in kind, or add a row of role 'definition'" in written.missing["3"]
    table = (written.folder / "symbols.toml").read_text()
    kinds = dict(re.findall(r"'(\S+)' *= \{ kind = '(\w*)'", table))
    assert kinds == {"c": "positive", r"\gamma": "positive", "x": "", "b": "", "M": "", "z": ""}


@pytest.fixture(scope="module")
def sliding(tmp_path_factory):
    return write_from_source("sliding2029", tmp_path_factory.mktemp("sliding"), SOURCES / "sliding_mode.tex")


def test_a_paper_with_a_reference_and_a_bounded_disturbance_is_decided_as_a_reader_would(sliding):
    """The plant is M dv/dt = ..., the law needs the reference's rate, which nothing is known of; steps are chains."""
    assert dict(sliding.missing) == dict.fromkeys(("assumption1", "assumption2"),
                                                  "a statement in words: state its goal by hand")
    assert {row: sliding.verdicts[row] for row in ("8", "10", "11", "12", "13")} == {
        "8": "proved", "10": "proved", "11": "proved", "12": "refuted", "13": "proved"}


def test_a_line_that_goes_on_is_read_from_the_last_side_before_it(sliding):
    rows = rows_of(sliding.folder)
    assert rows["11"].printed.startswith(r"\le -k s^2") and rows["12"].printed == r"\le -2 k s^2"
    assert rows["12"].line == r"-k s^2 \le -2 k s^2"
    assert chained("a &= (b = c)", r"\le d") == r"(b = c) \le d"
    assert chained(r"a = b, \quad c = d", r"\le e") == chained("a", r"\le e") == chained("a = b", "c = d") == ""


def test_the_formula_of_an_assumption_holds_from_there_on_and_one_on_a_condition_does_not(sliding):
    rows = rows_of(sliding.folder)
    assert rows["assumption1.formula1"].printed == r"|d(t)| \le D"
    assert not [row for row in rows if row.startswith("assumption2.")]
    letters = load_record(sliding.folder / SYMBOLS, LettersFile).letters
    assert letters["v"].kind == "real" and letters["r"].role == "input"
    premises = {one.claim.equation: one.claim.premises for one in prove(targets([str(sliding.folder)]), 1).decisions}
    assert premises["13"] == ("sliding2029:assumption1.formula1",) and not premises["1"]


@pytest.mark.parametrize(("printed", "lines"), [
    (r"\left\{ \begin{array}{l} \dot x = v \\ \dot v(t) = u \end{array} \right.", [r"\dot x = v", r"\dot v(t) = u"]),
    (r"\begin{cases} \dot x &= v, \\[2pt] \dot v &= u \end{cases}", [r"\dot x = v", r"\dot v = u"]),
    (r"\{\begin{aligned} a &= b \\ c \end{aligned}", []),
    (r"|x| = \begin{cases} x & x > 0 \\ -x & x < 0 \end{cases}", [])])
def test_a_system_behind_a_brace_is_a_line_for_each_of_its_equations(printed, lines):
    assert system_lines(printed) == lines
    assert without_end(rf"{printed} , ") == printed


@pytest.mark.parametrize(("line", "values", "rates"), [
    (r"e(t) = x(t) - r(t), \quad k > 0", {"e": "x(t) - r(t)"}, {}), (r"M \dot v(t) = u", {}, {"v": r"\frac{u}{M}"}),
    (r"a = b \text{ if } c > 0", {}, {}), ("a = b, c < d", {}, {}), (r"\dot M \dot v = u", {}, {})])
def test_what_a_line_gives_a_value_or_a_rate(line, values, rates):
    assert values_and_rates(line) == (values, rates)


@pytest.mark.parametrize("text", [r"$|d(t)| \le D$, $\forall t \geq 0$.", r"$|d(t)| \le D$ for all $t \ge 0$",
                                  r"at all times, for all times, $|d(t)| \le D$ with $D > 0$",
                                  r"There exists a constant $D > 0$ such that $|d(t)| \le D$."])
def test_what_holds_at_all_times_is_no_condition(text):
    assert [*assumed_formulas(text)] == [r"|d(t)| \le D"]


@pytest.mark.parametrize("text", [
    "If $x > 0$ then $y > x$.", "For every $x$ there exists $y$ such that $y > x$.", "Either $x = y$ or $x = z$.",
    "For all $x > y$ it is smooth.", r"$x \ge y \Rightarrow z = y$", "The gain $k > 0$ is large.", r"$x \in X$",
    r"It holds that $f \ge x$ for $x > 0$.", r"$f \ge x$ on $x \in [0, 1]$.", "We have $y = x$ for each $x > 1$."])
def test_no_formula_is_assumed_that_a_text_ties_to_a_condition_or_that_says_a_sign_alone(text):
    assert not [*assumed_formulas(text)]


def test_a_letter_that_the_text_alone_defines_is_a_row(tmp_path):
    text = r"""Let the error be $e = x - r$ of $x, q \in \mathbb{R}$, where $r = 2 q$. Define $z = q$.
    \begin{equation} e^2 = x^2 - 4 q x + r^2 \end{equation} \begin{equation} e^2 \ge r^2 \end{equation}"""
    (tmp_path / "s.tex").write_text(text)
    found = write_from_source("p2029", tmp_path, tmp_path / "s.tex")
    assert {row.id: row.printed for row in rows_of(found.folder).values() if row.role == "definition"} == {
        "text1": "e = x - r", "text2": "r = 2 q"}
    assert (found.verdicts["1"], found.verdicts["2"]) == ("proved", "refuted")


@pytest.mark.parametrize("text", [
    "If $x = 3 q$", "with $c = q$", "Let $k = 3$", r"Let $x \ge q$", "where $w = q$, where $w = 2 q$",
    "Let $x = x + q$", r"\begin{proof} Let $m = q$. \end{proof}", "Let it run. Then $x = q$"])
def test_what_the_text_does_not_define_for_the_whole_paper_is_no_definition(text):
    assert not defined_in_text(text)


def with_rates(flow, **more):
    record = SymbolsFile(symbols=dict.fromkeys(("x", "y", "c", "r"), "real"), definitions={"e": "x - c r"}, flow=flow,
                         **more)
    return {str(moving): str(rate) for moving, rate in symbols_in(record, Path("letters.toml")).flow.items()}


@pytest.mark.parametrize(("text", "role"), [("The gain obeys", "assumption"), ("If the train stands,", "words")])
def test_a_display_within_an_assumption_on_a_condition_is_left_to_the_author(text, role, tmp_path):
    display = r"\begin{equation} k \ge c \end{equation}"
    (tmp_path / "s.tex").write_text(rf"\begin{{assumption}} {text} {display} \end{{assumption}}")
    assert rows_of(write_from_source("p2029", tmp_path, tmp_path / "s.tex").folder)["1"].role == role


def test_rates_of_other_letters_within_a_rate_are_put_in():
    assert with_rates({"y": r"\dot e + x", "x": "2 c"}) == {"y": "2*c + x", "x": "2*c"}
    assert with_rates({"y": r"\dot e", "x": "y", "r": "x"}) == {"y": "-c*x + y", "x": "y", "r": "x"}


@pytest.mark.parametrize(("flow", "inputs", "words"), [
    ({"y": r"\dot x", "x": r"\dot y"}, (), "needs itself"),
    ({"x": r"\dot x"}, (), "the rate is the rate"),
    ({"y": r"\dot e", "x": "1"}, ("r",), "rate of r, which has none"),
    ({"y": r"\frac{d}{dt} |x|", "x": "1"}, (), "may have none")])
def test_a_rate_that_is_not_known_within_another_is_named(flow, inputs, words):
    with pytest.raises(InputError, match=words):
        with_rates(flow, inputs=inputs)


@pytest.fixture(scope="module")
def observer(tmp_path_factory):
    return write_from_source("observer2029", tmp_path_factory.mktemp("observer"), SOURCES / "observer.tex")


def test_no_displayed_formula_is_lost_whether_it_has_a_number_or_not(observer):
    r"""IEEEeqnarray, dmath, \[, $$, starred environments, an author's own ones; not what \iffalse leaves out."""
    rows = rows_of(observer.folder)
    one, two, *shown = [f"display{number}" for number in range(1, 16)]
    assert list(rows) == ["1", one, "2", "standing-assumption1", "3", two, "4", *shown[:5], "5", *shown[5:9],
                          "example1", shown[9], "theorem1", *shown[10:12], "remark1", shown[12]]
    assert rows["display3"].printed.count(r"\le") == 2 and rows["display1"].role == rows["2"].role == "dynamics"
    assert rows["theorem1"].rests_on == ("standing-assumption1", "4", "display13")
    assert {row for row, verdict in observer.verdicts.items() if verdict == "proved"} == {
        "display3", "display4", "display8", "display9"}
    assert {row for row, verdict in observer.verdicts.items() if verdict == "refuted"} == {"display6", "display10"}
    assert "a matrix is not read" in observer.missing["5"]
    assert "an integral is not read" in observer.missing["display11"]


def test_what_a_sentence_says_on_a_condition_of_an_example_or_as_a_correction_is_left_to_the_author(observer):
    rows = rows_of(observer.folder)
    assert {row for row in rows if rows[row].role == "words"} == {
        "standing-assumption1", "display5", "display7", "example1", "display12", "theorem1", "remark1", "display15",
        "display14"}  # the last rests on V, which the remark corrects
    assert "In an earlier version" in observer.missing["display14"]
    assert rows["3"].role == "assumption" and rows["4"].role == rows["display2"].role == "definition"


def test_a_formula_without_a_number_defines_only_what_nothing_else_does(tmp_path):
    (tmp_path / "s.tex").write_text(r"""Let $x, y \in \mathbb{R}$. \[ V = x^4 \] \begin{equation} V = x^2 \end{equation}
        \begin{proof} \[ W = y \] \end{proof} \begin{align*} U &= x^2 \\ & + 1, \\ U &\ge 1, \\ U &> y \end{align*}""")
    found = write_from_source("p2029", tmp_path, tmp_path / "s.tex")
    assert {row.id: (row.role, row.printed) for row in rows_of(found.folder).values()} == {
        "display1": ("words", "V = x^4"), "1": ("definition", "V = x^2"), "display2": ("claim", "W = y"),
        "display3": ("definition", "U = x^2 + 1"), "display4": ("claim", r"U \ge 1"), "display5": ("claim", "U > y")}
    assert (found.verdicts["display4"], found.verdicts["display5"]) == ("proved", "refuted")


def test_a_rate_that_a_lemma_claims_moves_nothing_and_a_display_of_tex_hides_no_text(tmp_path):
    r"""Nor are the d and t of \frac{d V}{d t} letters; $$ is no formula within the text; := defines by itself."""
    (tmp_path / "s.tex").write_text(r"""\newtheorem{lemma}{Lemma}\newtheorem{definition}{Definition}
        $$ \dot x = -a x \eqno(1) $$ with a gain $a > 0$ and $x, c \in \mathbb{R}$.
        \begin{definition} The error is $e := x - 0 c$. \end{definition} Define the energy $V = e^2$.
        \begin{lemma} \begin{equation} \dot V = -3 a e^2 \end{equation} \begin{equation} \dot W = -a e^2 \end{equation}
        \begin{equation} \frac{\mathrm{d} V}{\mathrm{d} t} = -2 a e^2 \end{equation} \end{lemma}""")
    found = write_from_source("p2029", tmp_path, tmp_path / "s.tex")
    rows = rows_of(found.folder)
    assert {name: row.role for name, row in rows.items() if row.role != "words"} == {
        "text1": "definition", "text2": "definition", "1": "dynamics", "1-2": "claim", "2": "claim", "3": "claim"}
    assert {name: found.verdicts[name] for name in ("1-2", "2", "3")} == {
        "1-2": "refuted", "2": "undecided", "3": "proved"}
    assert not {"d", "t"} & load_record(found.folder / SYMBOLS, LettersFile).letters.keys()


@pytest.mark.parametrize("text", ["where\n\n,\n\n", "## References\n\n..\n\n", ", .\n\n"])
def test_a_sentence_of_marks_alone_says_nothing(text):
    assert len(read_source(f"We have\n\n$$x^2 \\ge 0$$\n\n{text}and\n\n$$y^2 \\ge 0$$\n").rows) == 2


def test_rows_of_the_running_text_have_ids_that_no_tag_has(tmp_path):
    (tmp_path / "paper.tex").write_text(r"""\documentclass{article}\begin{document}
Let $k > 1$ be a constant and let $e = 2 x$. Consider the system $\dot x = -x$, where $x \in \mathbb{R}$ is the state.
\begin{equation} \tag{bound1} x^2 \ge 0 \end{equation} \begin{equation} \tag{text1} e^2 \ge 0 \end{equation}
\begin{equation} \tag{motion1} k e^2 \ge 0 \end{equation}\end{document}""")
    found = write_from_source("tagged2029", tmp_path, tmp_path / "paper.tex")
    printed = {row: one.printed for row, one in rows_of(found.folder).items()}
    assert printed["text1"] == r"e^2 \ge 0" and printed["text1-text"] == "e = 2 x"
    assert printed["motion1-text"] == r"\dot x = -x" and printed["bound1-text"] == "k > 1"

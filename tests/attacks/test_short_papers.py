"""Papers as authors write them are decided line by line, and what is said of something else is not taken for them."""

import pytest
from short_papers import HEAD, PAPERS
from short_papers_attacked import ATTACKS, BOUNDED

from workbench.paper.source.folder import write_from_source
from workbench.proof.latex.rows import ROWS, RowsFile, load_record

PROVED = {
    "leakage": ("5", "6", "7", "8", "9"), "model_reference": ("6", "8"), "observer": ("6", "7", "9"),
    "known_function": ("4", "6"), "integral_action": ("4", "6"), "backstepping": ("5", "6"), "input_to_state": ("2",),
    "pendulum": ("6", "7"), "sliding_mode": ("5",), "robust": ("4", "7", "8"), "disturbance_observer": ("4", "5"),
    "motor": ("4",)}
# What a paper prints wrongly instead, and the lines that are false then; a last one that is true all the same.
WRONG = (
    ("leakage", r"\frac{1}{2k} D^2", r"\frac{1}{4k} D^2", ("6",), "8"),
    ("leakage", r"\min\{k, \sigma\gamma\}", r"\min\{2k, \sigma\gamma\}", ("9",), "8"),
    ("model_reference", r"-\gamma_r r e", r"-\gamma_r x e", ("8",), "6"),
    ("observer", "= -l_1(1+l_2)", "= -l_1 l_2", ("9",), "7"),
    ("known_function", r"= \gamma e f(x), \end", r"= -\gamma e f(x), \end", ("6",), "4"),
    ("disturbance_observer", "-l z - l(l x + a x + b u)", "-l z - l(a x + b u)", ("4", "5"), ""),
    ("sliding_mode", r"-(\eta - \bar d)|s| \label", r"-(\eta + \bar d)|s| \label", ("5",), ""))


def verdicts(folder, text):
    (folder / "paper.tex").write_text(f"{HEAD}{text}\\end{{document}}\n")
    return write_from_source("paper2030", folder, folder / "paper.tex").verdicts


@pytest.mark.parametrize("name", PROVED)
def test_the_lines_of_a_paper_are_proved(name, tmp_path):
    found = verdicts(tmp_path, PAPERS[name])
    assert {row: found[row] for row in PROVED[name]} == dict.fromkeys(PROVED[name], "proved")
    assert not {"refuted", "violated", "gap"} & {*found.values()}


@pytest.mark.parametrize(("name", "printed", "wrong", "false", "true"), WRONG)
def test_a_line_that_is_printed_wrongly_is_refuted(name, printed, wrong, false, true, tmp_path):
    assert printed in PAPERS[name]
    found = verdicts(tmp_path, PAPERS[name].replace(printed, wrong))
    assert {row for row, verdict in found.items() if verdict == "refuted"} == {*false}
    assert not true or found[true] == "proved"


def test_a_bound_within_a_sentence_is_a_premise_that_the_table_shows(tmp_path):
    text = rf"{BOUNDED}Then \begin{{equation}} \dot V \le -k x^2 + D |x|. \tag{{T}} \end{{equation}}"
    assert verdicts(tmp_path, text)["T"] == "proved"
    rows = {row.id: row for row in load_record(tmp_path / "paper2030" / ROWS, RowsFile).rows}
    assert rows["bound1"].role == "assumption" and rows["bound1"].printed == r"|d(t)| \le D"


def test_a_formula_stays_as_it_is_printed_where_its_function_is_read_as_a_letter(tmp_path):
    verdicts(tmp_path, PAPERS["known_function"])
    rows = load_record(tmp_path / "paper2030" / ROWS, RowsFile).rows
    printed = next(row for row in rows if row.id == "1")
    assert printed.printed == r"\dot x = \theta f(x) + b u" and printed.line == r"\dot x = \theta f + b u"


@pytest.mark.parametrize("name", ATTACKS)
def test_what_is_said_of_something_else_decides_nothing(name, tmp_path):
    text, forbidden = ATTACKS[name]
    assert verdicts(tmp_path, text)["T"] not in forbidden

"""A study of a paper from its file to its page, on a tiny study made for this test."""

import csv
import json
import re
import sys

import numpy as np
import pytest
from command_line import one_line
from command_line import run as run_command
from refusals import refusal
from scenarios import PROOFS
from test_report import read, without_scripts
from worker_tasks import square_from

from workbench.cli import app as cli
from workbench.cli.loading import load
from workbench.paper.results import Curve, Plot, ResultTable, StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.report import build as building
from workbench.report.build import QUICK_DRAWS, Asked, build_study_report
from workbench.report.runs import run_study, study_document
from workbench.report.sources import sourced_values
from workbench.report.study_figures import lettered, study_plot

FILE = """
version = 1
kind = "study"
name = "tiny"
title = "Decay of x < y & more"
paper = "tiny"
citation = "A. Author, 2026"
[decay]
rate_per_s = 0.5
[decay.source]
rate_per_s = "assumed: any"
[[cases]]
start_m = 1.0
[cases.source]
start_m = "paper, Table 1"
"""


CODE = '''
import numpy as np

from workbench.files.toml import Positive, SourcedRecord
from workbench.paper.cells import Column
from workbench.paper.results import Curve, Plot, ResultTable, StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Study, StudyKind


class Decay(SourcedRecord):
    rate_per_s: Positive


class Case(SourcedRecord):
    start_m: Positive


class TinyStudy(Study):
    decay: Decay
    cases: tuple[Case, ...]


TIME = np.linspace(0.0, 4.0, 5000)


def decay(study, start_m):
    return start_m * np.exp(-study.decay.rate_per_s * TIME)


def run(study, workers, on_progress):
    starts = [case.start_m for case in study.cases]
    (ways,) = run_stages((Stage(decay, study, starts, lambda start, _: f"{start:g} m"),), workers, on_progress)
    curves = [Curve("desired", TIME, np.zeros_like(TIME) + 1e-3),
              *(Curve(f"from {start:g} m", TIME, way) for start, way in ways.items())]
    rows = [{"case": f"{start:g} m", "end_m": float(way[-1]), "failed": None} for start, way in ways.items()]
    rows.append({"case": "wild", "end_m": None, "failed": "diverged at t = 1.000 s"})
    table = ResultTable("Ends & <b>means</b>", "paper, Table 2", ("case", Column("printed", "mm", 1e-3),
                        Column("obtained", "mm", 1e-3)), tuple((row["case"], 0.1, row["end_m"]) for row in rows))
    plot = Plot("x over time", "paper, Figure 1", "time (s)", "x (m)", tuple(curves), "A note.", log_y=True)
    return StudyResult(tuple(rows), (table,), (plot,), ("It decays to 0.135 m.",), (("wild", "diverged at t = 1 s"),))


KIND = StudyKind(TinyStudy, run)
'''

GAINS = '''
from workbench.gains.result import Condition, GainReport, GainSet
from workbench.paper.gain_search import GainSearch, same_for_all


def report(stated):
    conditions = (Condition("k < 2 & more", "the paper's <own>", "k = 3", False, "", ""),)
    found = GainSet("found", "the least", {}, "nothing", "", {})
    return GainReport("tiny", conditions, (), (found,), (), ("A remark.",), {})


def run(loaded, task):
    return {"rms": 2.0 if task.gains == "stated" else 1.0}, None


SEARCH = GainSearch(report, lambda report: same_for_all(report, "alone"), run)
'''


def written(folder, **modules):
    """A folder with the study's file and its modules."""
    (folder / "study").mkdir(parents=True)
    (folder / "study.toml").write_text(FILE)
    (folder / "study" / "__init__.py").write_text(CODE)
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text)
    return folder


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """A paper's folder with a study and a search of gains, for tests that only read it."""
    return written(tmp_path_factory.mktemp("papers") / "tiny", gains=GAINS)


@pytest.fixture(scope="module")
def made(tiny, tmp_path_factory):
    """The study's report, and where it lies."""
    out = tmp_path_factory.mktemp("report") / "out"
    return build_study_report(Asked.of(load(tiny), [], out, workers=1)), out


def test_a_study_becomes_a_page_with_its_data_beside_it(made):
    report, out = made
    page = without_scripts(report.page.read_text(encoding="utf-8"))
    reader = read(page)
    assert len(reader.ids) == len(set(reader.ids))
    assert all(link[1:] in reader.ids if link.startswith("#") else (out / link).is_file() for link in reader.links)
    for text in ("Decay of x &lt; y &amp; more", "Ends &amp; &lt;b&gt;means&lt;/b&gt;", "It decays to 0.135 m.",
                 "wild: diverged at t = 1 s", "paper, Figure 1", "A note."):
        assert text in re.sub(r'<span class="[^"]*">([^<]*)</span>', r"\1", page)  # numbers stay with their units
    assert page.count("<svg") == 1 and "&#34;" not in re.sub(r"<svg.*?</svg>", "", page, flags=re.DOTALL)
    with (out / "curves" / "01-x-over-time.csv").open(encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0] == ["curve", "time (s)", "x (m)"] and len(rows) == 1 + 2 * 5000
    document = json.loads((out / "compare.json").read_text(encoding="utf-8"))
    assert document == study_document(report.study, report.result)
    assert (document["version"], document["scenario"]) == (1, "tiny")
    assert [row["failed"] for row in document["rows"]] == [None, "diverged at t = 1.000 s"]


def test_tables_are_told_as_text_and_as_numbers_in_their_units(made):
    (table,) = json.loads((made[1] / "compare.json").read_text(encoding="utf-8"))["tables"]
    assert table["header"] == ["case", "printed (mm)", "obtained (mm)"] and table["units"] == ["", "mm", "mm"]
    assert table["rows"] == [["1 m", "100", "135"], ["wild", "100", "—"]]
    assert table["values"][0][2] == pytest.approx(1e3 * np.exp(-2.0)) and table["values"][1][2] is None


def test_every_value_is_listed_with_its_source(tiny, made):
    values = {value.key: value for value in sourced_values(load(tiny).study)}
    assert values["decay.rate_per_s"].kind == "assumed" and values["cases[0].start_m"].words == "Table 1"
    text = made[0].page.read_text(encoding="utf-8").replace("<wbr>", "")
    for value in values.values():
        assert value.key in text and value.words in text


def test_the_command_line_knows_studies_from_scenarios(tmp_path, monkeypatch, capsys):
    own = written(tmp_path / "tiny")

    def command(*words):
        monkeypatch.setattr(sys, "argv", ["workbench", *map(str, words)])
        with pytest.raises(SystemExit) as end:
            cli.main()
        return end.value.code, re.sub(r"\s+", " ", capsys.readouterr().err)

    code, error = command("compare", own, "--json", tmp_path / "c.json", "--workers", 1)
    assert code == 0 and "wild: diverged" in error
    assert json.loads((tmp_path / "c.json").read_text())["findings"] == ["It decays to 0.135 m."]
    assert command("compare", own, "--variants") == (
        2, "workbench: --variants: is for scenarios; a study's file states its own runs: leave it out ")
    (own / "study.toml").write_text(FILE.replace("rate_per_s = 0.5", "rate = 0.5"))
    code, error = command("compare", own)
    assert code == 2 and "study.toml: decay.rate: unknown key; did you mean 'rate_per_s'" in error


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    """A folder for tests to write wrong files into."""
    return written(tmp_path_factory.mktemp("broken") / "tiny")


@pytest.mark.parametrize(("old", "new", "message"), [
    ('kind = "study"', 'kind = "stduy"', "kind: 'stduy' is not known"),
    ('paper = "tiny"', "", "paper: is missing"),
    ("start_m = 1.0", "start_m = -1.0", "cases[0].start_m"),
    ("version = 1", "version = 2", "version: 2 is not known"),
])
def test_a_file_that_is_no_study_says_why(broken, old, new, message):
    (broken / "study.toml").write_text(FILE.replace(old, new))
    assert f"study.toml: {message}" in refusal(load, broken)


def test_a_study_without_code_beside_it_says_what_is_missing(tmp_path):
    (tmp_path / "study.toml").write_text(FILE)
    assert "no study/__init__.py lies beside this file" in refusal(load, tmp_path)


def test_progress_comes_through(tiny):
    steps = []
    run_study(load(tiny), 3, lambda *step: steps.append(step))
    assert steps == [("runs", 1, 1)]


@pytest.mark.parametrize(("full", "drawn"), [(False, QUICK_DRAWS), (True, 100)])
def test_a_report_draws_few_trains_unless_it_is_to_be_full(tmp_path, full, drawn):
    asked = Asked.of(load(PROOFS / "mao2018"), [], tmp_path / "out", full=full)
    assert (asked.draws(100), asked.draws(7)) == (drawn, 7) and asked.command.endswith(" --full") == full
    assert building._as_short(asked).study.pairs.draws == drawn
    of_runs = StudyResult((), (), (), (), left_out=0 if full else 7, runs={1: None})
    assert building._shortened(asked, of_runs) == ({} if full else {
        "runs": "1 of 8", "drawn trains": f"the first {QUICK_DRAWS} of 100"})
    assert asked.loaded.study.pairs.draws == 100, "the page shows what is stated"


@pytest.mark.parametrize("workers", [1, 2])
def test_stages_run_one_after_the_other_with_one_count(workers):
    steps = []
    numbers, none, more = run_stages((
        Stage(square_from, 1, (1, 3, 2), lambda task, result: f"{task}: {result}", work=lambda task: task),
        Stage(square_from, 0, (), lambda *_: "never"), Stage(square_from, 0, (5,), lambda task, _: f"{task}")),
        workers, lambda *step: steps.append(step))
    assert (list(numbers.items()), dict(none), dict(more)) == ([(1, 2), (3, 10), (2, 5)], {}, {5: 25})
    assert [step[:2] for step in steps] == [(1, 4), (2, 4), (3, 4), (4, 4)] and steps[-1][2] == "5"
    if workers == 1:
        assert [step[2] for step in steps[:3]] == ["3: 10", "2: 5", "1: 2"], "the longest first"


@pytest.mark.parametrize("make", [
    lambda: Curve("c", np.zeros(2), np.zeros(3)),
    lambda: Curve("c", np.zeros(2), np.array([0.0, np.nan])),
    lambda: Curve("c", np.zeros(0), np.zeros(0)),
    lambda: ResultTable("t", "paper", ("a", "b"), (("1",),)),
    lambda: ResultTable("t", "paper", ("a",), (("nan",),)),
    lambda: StudyResult(({"x": float("inf")},), (), (), ()),
])
def test_results_hold_no_nan_and_nothing_ragged(make):
    with pytest.raises(ValueError, match=r"values|row"):
        make()


def test_figures_are_small_and_the_same_every_time():
    x = np.linspace(0.0, 1.0, 200_000)
    plot = Plot("noise", "paper", "x", "y", tuple(Curve(f"{i}", x, np.sin(99 * i * x)) for i in range(9)), log_y=True)
    assert study_plot(plot, "a") == study_plot(plot, "a")
    assert len(study_plot(plot, "a")) < 300_000


def test_what_is_known_of_gains_stands_on_the_page(tiny, made, tmp_path):
    with_them = build_study_report(Asked.of(load(tiny), [], tmp_path / "with", with_gains=True, workers=1))
    text = with_them.page.read_text(encoding="utf-8")
    assert 'id="gains"' in text and "k &lt; 2 &amp; more" in text and "better in rms" in text
    assert 'id="gains"' not in made[0].page.read_text(encoding="utf-8")
    assert json.loads((tmp_path / "with" / "gains.json").read_text(encoding="utf-8"))["conditions"][0]["met"] is False
    assert not (made[1] / "gains.json").exists()


def test_numbers_of_gains_may_be_of_any_kind_and_what_is_none_is_named(tmp_path):
    """A module that reckons in sympy or numpy gives their numbers, which are no floats."""
    quantity = 'Quantity("rate", "1/s", sp.Float("1.5"), np.float32(0.5), "", check=sp.Rational(1, 4))'
    text = ("import numpy as np\nimport sympy as sp\nfrom workbench.gains.result import Quantity\n" + GAINS).replace(
        "conditions, (), (found,)", f"conditions, ({quantity},), (found,)").replace(
        '"k = 3", False', '"k = 3", sp.false').replace('{"rms": 2.0', '{"rms": sp.Float(2)')
    own = written(tmp_path / "tiny", gains=text)
    assert run_command("gains", own, "--json", tmp_path / "gains.json", "--workers", 1).returncode == 0
    found = json.loads((tmp_path / "gains.json").read_text())
    assert [found["quantities"][0][key] for key in ("papers", "proved", "check")] == [1.5, 0.5, 0.25]
    assert found["conditions"][0]["met"] is False and found["effects"][0]["rms"] == 2.0
    wrong = written(tmp_path / "wrong", gains=text.replace("np.float32(0.5)", "sp.Symbol('p')"))
    assert "gains.py: rate: proved: p is no finite number: give one" in one_line(run_command("gains", wrong))
    raised = (("InputError('plant.mass', 'rate', 'is no number: give one')", "plant.mass: rate: is no number"),
              ("SolverError('no values meet the conditions: loosen one')", "no values meet the conditions"))
    for number, (error, words) in enumerate(raised):
        text = GAINS.replace("    conditions = (", f"    raise {error}\n    conditions = (").replace(
            "\nfrom", "\nfrom workbench.errors import InputError, SolverError\nfrom", 1)
        own = written(tmp_path / f"raises{number}", gains=text)
        assert f"{own / 'gains.py'}: {words}" in one_line(run_command("gains", own))


def test_letters_of_legends_have_their_indices_and_names_stay():
    assert lettered("v_d, c_1 and γ_a") == r"$\mathregular{v_{d}}$, c₁ and γₐ"
    assert lettered("mpc_linear, rbfnn_pocrac, 5 $") == r"mpc_linear, rbfnn_pocrac, 5 \$"
    x = np.arange(3.0)
    plot = Plot("Speeds", "paper, Figure 1", "t (s)", "v_d (m/s)", (Curve("v_d", x, x), Curve("mpc_linear", x, 2 * x)))
    drawn = study_plot(plot, "letters")
    assert ">d</tspan>" in drawn and "mpc_linear" in drawn and ">v_d<" not in drawn

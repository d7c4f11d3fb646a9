"""A study of a paper from its file to its page, on a tiny study made for this test."""

import csv
import json
import re
import sys
from types import ModuleType

import numpy as np
import pytest
from test_report import read
from workbench.paper.registry import is_study, load_study

from workbench.cli import app as cli
from workbench.errors import InputError
from workbench.files.toml import Positive, SourcedRecord
from workbench.paper import registry
from workbench.paper.results import Curve, Plot, ResultTable, StudyResult
from workbench.paper.study import Study, StudyKind
from workbench.report.build import build_study_report, run_study, study_document
from workbench.report.sources import sourced_values
from workbench.report.study_figures import study_plot

FILE = """
version = 1
kind = "study"
name = "tiny"
title = "Decay of x < y & more"
paper = "tiny2026"
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


class Decay(SourcedRecord):
    """How fast."""

    rate_per_s: Positive


class Case(SourcedRecord):
    """From where."""

    start_m: Positive


class TinyStudy(Study):
    """x' = -rate x from several starts."""

    decay: Decay
    cases: tuple[Case, ...]


def run(study, workers, on_progress):
    time = np.linspace(0.0, 4.0, 5000)
    curves = [Curve("desired", time, np.zeros_like(time) + 1e-3)]
    rows = []
    for case in study.cases:
        curves.append(Curve(f"from {case.start_m:g} m", time, case.start_m * np.exp(-study.decay.rate_per_s * time)))
        rows.append({"case": f"{case.start_m:g} m", "end_m": float(curves[-1].y[-1]), "failed": None})
    on_progress(1, 1, f"{workers} workers")
    rows.append({"case": "wild", "end_m": None, "failed": "diverged at t = 1.000 s"})
    table = ResultTable("Ends & <b>means</b>", "paper, Table 2", ("case", "printed", "obtained"),
                        tuple((row["case"], "0.1", "—" if row["end_m"] is None else f"{row['end_m']:.3f}")
                              for row in rows))
    plot = Plot("x over time", "paper, Figure 1", "time (s)", "x (m)", tuple(curves), "A note.", log_y=True)
    return StudyResult(tuple(rows), (table,), (plot,), ("It decays to 0.135 m.",), (("wild", "diverged at t = 1 s"),))


@pytest.fixture
def tiny(monkeypatch, tmp_path):
    module = ModuleType("tiny_study_of_the_test")
    module.KIND = StudyKind(TinyStudy, run)
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(registry.STUDIES, "tiny2026", module.__name__)
    path = tmp_path / "tiny.toml"
    path.write_text(FILE)
    return path


def test_a_study_becomes_a_page_with_its_data_beside_it(tiny, tmp_path):
    out = tmp_path / "out"
    made = build_study_report(tiny, [], out, workers=1)
    page = made.page.read_text(encoding="utf-8")
    reader = read(page)
    assert len(reader.ids) == len(set(reader.ids))
    assert all(link.startswith("#") and link[1:] in reader.ids for link in reader.links)
    for text in ("Decay of x &lt; y &amp; more", "Ends &amp; &lt;b&gt;means&lt;/b&gt;", "It decays to 0.135 m.",
                 "wild: diverged at t = 1 s", "paper, Figure 1", "A note."):
        assert text in page
    assert page.count("<svg") == 1 and "&#34;" not in re.sub(r"<svg.*?</svg>", "", page, flags=re.DOTALL)
    with (out / "curves" / "01-x-over-time.csv").open(encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0] == ["curve", "time (s)", "x (m)"] and len(rows) == 1 + 2 * 5000
    document = json.loads((out / "compare.json").read_text(encoding="utf-8"))
    assert document == study_document(made.study, made.result)
    assert (document["version"], document["scenario"]) == (1, "tiny")
    assert [row["failed"] for row in document["rows"]] == [None, "diverged at t = 1.000 s"]
    assert document["tables"][0]["rows"][0] == ["1 m", "0.1", "0.135"]


def test_every_value_is_listed_with_its_source(tiny, tmp_path):
    values = {value.key: value for value in sourced_values(load_study(tiny))}
    assert values["decay.rate_per_s"].kind == "assumed" and values["cases[0].start_m"].words == "Table 1"
    page = build_study_report(tiny, [], tmp_path / "out", workers=1).page.read_text(encoding="utf-8")
    text = page.replace("<wbr>", "")
    for value in values.values():
        assert value.key in text and value.words in text


def test_the_command_line_knows_studies_from_scenarios(tiny, tmp_path, monkeypatch, capsys):
    def command(*words):
        monkeypatch.setattr(sys, "argv", ["workbench", *map(str, words)])
        with pytest.raises(SystemExit) as end:
            cli.main()
        return end.value.code, re.sub(r"\s+", " ", capsys.readouterr().err)

    code, error = command("compare", tiny, "--json", tmp_path / "c.json", "--workers", 1)
    assert code == 0 and "wild: diverged" in error
    assert json.loads((tmp_path / "c.json").read_text())["findings"] == ["It decays to 0.135 m."]
    assert command("report", tiny, "--out", tmp_path / "r", "--workers", 1)[0] == 0
    assert command("compare", tiny, "--variants") == (
        2, "workbench: --variants: is for scenarios; a study's file states its own runs: leave it out ")
    tiny.write_text(FILE.replace("rate_per_s = 0.5", "rate = 0.5"))
    code, error = command("compare", tiny)
    assert code == 2 and "tiny.toml: decay.rate: unknown key; did you mean 'rate_per_s'" in error


@pytest.mark.parametrize(("old", "new", "message"), [
    ('kind = "study"', 'kind = "stduy"', "kind: 'stduy' is not known"),
    ('paper = "tiny2026"', 'paper = "nobody2026"', "paper: there is no study of 'nobody2026': choose one of"),
    ('paper = "tiny2026"', "", "paper: name the paper"),
    ("start_m = 1.0", "start_m = -1.0", r"cases\[0\].start_m"),
    ("version = 1", "version = 2", "version: 2 is not known"),
])
def test_a_file_that_is_no_study_says_why(tiny, old, new, message):
    tiny.write_text(FILE.replace(old, new))
    with pytest.raises(InputError, match=f"tiny.toml: {message}"):
        assert is_study(tiny)
        load_study(tiny)


def test_progress_comes_through(tiny):
    steps = []
    run_study(load_study(tiny), 3, lambda *step: steps.append(step))
    assert steps == [("runs", 1, 1)]


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


def test_what_is_known_of_gains_stands_on_the_page(tiny, tmp_path, monkeypatch):
    from workbench.gains.result import Condition, GainReport
    from workbench.paper.gain_effects import Effect
    from workbench.paper.new_paper import write_new_paper
    from workbench.report import build

    paper = tmp_path / "tiny2026"
    write_new_paper("tiny2026", tmp_path)
    found = GainReport("tiny2026", (Condition("k < 2 & more", "the paper's <own>", "k = 3", False, "", ""),), (), (),
                       (), ("A remark.",), {})
    monkeypatch.setitem(build.PAPERS, "tiny2026", "workbench.gains.tiny")
    monkeypatch.setattr(build, "checked_gains", lambda path, proofs: found)
    monkeypatch.setattr(build, "effects", lambda *_: (Effect("stated", "alone", {"rms": 2.0}, None),
                                                      Effect("found", "alone", {"rms": 1.0}, None)))
    with_them, without = (build_study_report(tiny, [paper], tmp_path / name, 1, with_gains=wanted)
                          for name, wanted in (("with", True), ("without", False)))
    text = with_them.page.read_text(encoding="utf-8")
    assert 'id="gains"' in text and "k &lt; 2 &amp; more" in text and "better in rms" in text
    assert 'id="gains"' not in without.page.read_text(encoding="utf-8")
    assert json.loads((tmp_path / "with" / "gains.json").read_text(encoding="utf-8"))["conditions"][0]["met"] is False
    assert not (tmp_path / "without" / "gains.json").exists()

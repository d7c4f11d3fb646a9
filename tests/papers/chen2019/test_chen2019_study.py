"""chen2019's study: its tables, figures and findings, what failed, and its page."""

import json

import pytest
from chen2019_studies import changed
from test_report import without_scripts

from proofs.chen2019.study import KIND
from workbench.paper.cells import numbers_in
from workbench.report.charts.chart import chart_of
from workbench.report.charts.files import write_curves
from workbench.report.runs import study_document
from workbench.report.study_page import StudyContent, build_study_page


@pytest.fixture(scope="module")
def result(short):
    return KIND.run(changed_count(short, 3), 1, lambda done, total, what: None)


def changed_count(short, count):
    trials = short.trials.model_copy(update={"count": count, "shown": (1, count)})
    return short.model_copy(update={"trials": trials})


def test_the_study_has_every_figure_and_tells_what_failed(result, short):
    sources = " ".join(plot.source for plot in result.plots)
    assert all(f"Figure {n}" in sources for n in range(1, 10))
    failed = [name for name, _ in result.failures]
    assert failed == ["50.03 to 55 t: the lower bound 30 kg above the mass"]
    assert len(result.rows) == len(short.changes) + 1
    assert [row["failed"] is not None for row in result.rows].count(True) == 1
    assert any("as stated" in row["run"] for row in result.rows)
    text = json.dumps(study_document(short, result), allow_nan=False)
    assert "NaN" not in text
    assert all(finding.endswith(".") for finding in result.findings)
    assert any("exceeds" in why for _, why in result.failures)


def test_a_stated_run_that_ends_in_its_first_trip_is_reported_and_stops_nothing(short):
    lost = changed(short, mass_bounds__low_kg=50030.0, mass_bounds__high_kg=50040.0, trials__count=2,
                   trials__shown=(1, 2))
    lost = lost.model_copy(update={"changes": tuple(c for c in short.changes if c.set == {"gains.c_3": 0.01}),
                                   "pairs": None})
    found = KIND.run(lost, 1, lambda done, total, what: None)
    assert found.rows[0]["failed"] is not None
    assert found.rows[0]["trials"] == 0
    assert found.rows[1]["failed"] is None
    assert found.rows[1]["position_error_min"] < 0
    json.dumps(study_document(lost, found), allow_nan=False)


def test_the_page_shows_every_figure_and_the_tables_hold_numbers(tmp_path, short, result):
    page = build_study_page(StudyContent(short, result, {}, {"runs": 1.0}, ("workbench compare",), None))
    assert page.count("<figure") >= len(result.plots)
    assert "http://" not in without_scripts(page).replace("http://www.w3.org", "")
    write_curves(list(map(chart_of, result.plots)), tmp_path)
    assert len(list((tmp_path / "curves").glob("*.csv"))) == len(result.plots)
    words_alone = {table.title for table in result.tables
                   if not any(True for row in table.rows for cell in row for _ in numbers_in(cell))}
    assert words_alone <= {"Law less MPC on the same drawn trains"}, "there the law may fail on every train"
    forces = next(table for table in result.tables if table.title == "What the reference asks of the train")
    assert (forces.header[4].heading, forces.rows[0][4]) == ("Available (kN)", 3 * short.train.traction_n)
    assert forces.values[0][4] == pytest.approx(3e-3 * short.train.traction_n)
    rules = next(table for table in result.tables if table.title == "How the law is sampled")
    assert [column.unit for column in rules.columns] == ["", "m", "m", "m/s", "m/s", "kN", "kN", ""]
    assert rules.headings[-2] == "|Δu| (kN), trial 3"
    assert rules.rows[0][-2] == pytest.approx(1e3 * rules.values[0][-2]) == result.rows[0]["difference_max_N"]

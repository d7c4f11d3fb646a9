"""liu2020's study: its figures, tables and findings, its laws beside MPC."""

import json
from dataclasses import replace

import numpy as np
import pytest

from proofs.liu2020 import plant as of_train
from proofs.liu2020.laws import LAWS
from proofs.liu2020.simulation.trip import davis_newton, setting_of
from proofs.liu2020.study import KIND, REPRODUCTION
from proofs.liu2020.study.comparison import DRIVERS, drawn_runs, own_cases, variants
from proofs.liu2020.study.runs import LiuResults, RunResult, run_case, run_cases, title_of
from workbench.paper.cells import numbers_in
from workbench.paper.comparison import ComparedRun, Task, comparison_tasks
from workbench.paper.mpc_comparison import known, run_mpc
from workbench.paper.results import Curve
from workbench.report.runs import study_document
from workbench.report.study_page import StudyContent, build_study_page
from workbench.trains.track import ResistanceTable


@pytest.fixture(scope="module")
def small(short):
    """The short line with the changes that tables need, two leak rates."""
    wanted = (*short.runs.inferred_changes, short.runs.divergence_change, "steps of 0.01 s, k₃s̃′")
    runs = short.runs.model_copy(update={"divergence_leak_rates_per_s": (0.0, 1.0)})
    return short.model_copy(update={"runs": runs, "changes": tuple(c for c in short.changes if c.title in wanted)})


@pytest.fixture(scope="module")
def result(small):
    steps = []
    found = KIND.run(small, 1, lambda done, total, what: steps.append((done, total, what)))
    assert [done for done, _, _ in steps] == list(range(1, len(steps) + 1)) and steps[-1][0] == steps[-1][1]
    return found


def test_the_study_runs_and_reports_those_that_fail(small, result):
    asked = run_cases(small)
    assert len(result.rows) == len(asked) == len(set(asked))
    failed = [row for row in result.rows if row["failed"]]
    assert 0 < len(failed) == len(result.failures) < len(asked)
    assert all(row["position_rms"] is None and row["end_s"] > 0 for row in failed)
    assert any("liu2020.feedback_rate, Value 10, steps of 0.01 s" in run for run, _ in result.failures)
    assert any("liu2020.printed" in run and "leak rate 1 1/s" in run for run, _ in result.failures)
    json.dumps(study_document(small, result), allow_nan=False)


def test_every_figure_and_both_tables_of_the_paper_are_there(small, result):
    sources = " ".join(plot.source for plot in result.plots)
    assert all(f"Figure {number}" in sources for number in range(3, 19))
    titles = [table.title for table in result.tables]
    assert any(title.startswith("Table 3") for title in titles) and any(title.startswith("Table 4") for title in titles)
    third = next(table for table in result.tables if table.title.startswith("Table 3, signs corrected"))
    assert [row[3] for row in third.text[:9]] == [
        "51.9592", "38.3612", "26.3685", "2.4269", "0.6257", "0.6022", "0.0299", "0.0288", "0.0108"]
    assert third.rows[9][3] == 5e-5 and third.text[9][3].endswith("10⁻⁵")
    assert third.headings[1:5] == ("energy printed (10¹¹)", "obtained (10¹¹)", "s̃ printed (m)", "obtained (m)")
    assert third.rows[0][1] == 1.8799e11 and third.values[0][1] == pytest.approx(1.8799)
    fourth = next(table for table in result.tables if table.title.startswith("Table 4"))
    assert fourth.text[0][:3] == ("no disturbance", "energy (10¹¹ J)", "1.6383") and fourth.values[0][2] == 1.6383e11
    assert all(any(True for row in table.rows for cell in row for _ in numbers_in(cell)) for table in result.tables)
    assert len(result.findings) >= 10
    page = build_study_page(StudyContent(small, result))
    assert "Value 10 under the same disturbance" in page and "nan" not in page.lower().split()


def test_laws_stand_beside_mpc_with_two_columns_of_gains_and_tuned(small, result):
    table = next(table for table in result.tables if table.title == "Beside MPC")
    law = LAWS["liu2020.corrected"]
    of_none = [row for row in table.rows if row[0] == "no disturbance"]
    assert [row[1] for row in of_none[:3]] == [f"{law.title}, Value 9", f"{law.title}, Value 10", f"{law.title}, tuned"]
    assert {row[2] for row in of_none[:3]} == {law.information} and len(of_none) == 10
    assert {of.table_4_column for of in variants(small, "corrected").values()} == {9, 10}
    runs = [ComparedRun(Task(place, name, variant), name, {}) for place in small.disturbances
            for name in ("corrected", "mpc_linear") for variant in variants(small, name)]
    assert [run.task for run in drawn_runs(small, runs)[0]] == [Task("fast", "corrected", ", Value 10"),
                                                             Task("fast", "mpc_linear")]


def test_the_plant_is_a_single_particle_of_the_mass_that_mpc_knows(study):
    setting = replace(setting_of(study, "fast"), end_s=200.0)
    chi, mass = study.train.chi, study.train.mass_kg / study.train.chi
    of = known(study.mpc, setting.curve, mass, davis_newton(study.train), setting.end_s)
    terms = setting.terms.copy()
    terms[:, 2:4] *= chi  # N per kg of M become N per kg of M/chi
    line = ResistanceTable(setting.line.position_m, setting.line.specific_force * chi)
    plain = replace(setting, mass_kg=mass, line=line, terms=terms, plant_values=())
    one = run_mpc(of, "mpc.offset_free", setting, of_train.model())
    other = run_mpc(of, "mpc.offset_free", plain)
    assert one.log[:, 1:3] == pytest.approx(other.log[:, 1:3], rel=1e-9, abs=1e-9)


def test_a_study_whose_runs_all_fail_still_reports(small, result):
    """Each with the numbers of one that did, and curves of its first instant alone."""
    row = next(run.row for run in result.runs.values() if run.failed)
    outcomes = {case: RunResult(case, row, {
        name: Curve(name, curve.x[:1], curve.y[:1]) for name, curve in result.runs[case].curves.items()})
        for case in run_cases(small)}
    shown = REPRODUCTION.shown(LiuResults(small, outcomes))
    assert list(shown.tables) and list(shown.plots)
    assert not any("None" in text for text in shown.findings)
    assert all(title_of(small, case) for case in outcomes)


def test_a_short_report_has_rows_tables_and_sentences_of_the_full_one(small, result):
    short = KIND.run(small.shortened(), 1, lambda *_: None)
    assert 0 < short.left_out == len(result.rows) - len(short.rows)
    timed = {"step_us_median": None, "step_us_p99": None, "deadline_misses": None}
    assert [row | timed for row in short.rows] == [row | timed for row in result.rows if row | timed in [
        other | timed for other in short.rows]]
    assert {row["controller"] for row in short.rows} >= {"liu2020.printed", "liu2020.corrected"}, "as printed stays"
    tables, fewer = {table.title: table for table in result.tables}, []
    for table in short.tables:
        whole = tables[table.title]
        kept = [place for place, heading in enumerate(table.headings) if "time a step" not in heading]
        places = kept if table.headings == whole.headings else [whole.headings.index(table.headings[k]) for k in kept]
        rows = [tuple(row[place] for place in places) for row in whole.rows]
        assert all(tuple(row[place] for place in kept) in rows for row in table.rows), table.title
        if (table.headings, len(table.rows)) != (whole.headings, len(whole.rows)):
            fewer.append(table.title)
            assert "Shortened: " in table.note and table.note.endswith("left out; all with --full.")
    assert {"Sensitivity to what is assumed", "RMS values of every law, Values 1 to 10", "Beside MPC"} <= set(fewer)
    clock = ("A million control steps", "A step of MPC")
    said = [finding for finding in short.findings if not finding.startswith(clock)]
    assert set(said) < set(result.findings) and any(finding.startswith("Values 4 to 9") for finding in said)
    assert {plot.title for plot in short.plots} <= {plot.title for plot in result.plots}


def test_what_the_study_has_run_itself_is_the_same_beside_mpc(small):
    own = own_cases(small)
    assert set(own) <= set(comparison_tasks(DRIVERS, small)) and len(own) == 6
    for task, case in [*own.items()][::2]:
        held, driven = run_case(small, case).compared, DRIVERS.drive(
            DRIVERS.variants(small, task.name)[task.variant], task.name, task.place)
        assert held.keys() > driven.keys()
        for key in driven.keys() - {"step_us_median", "step_us_p99", "curve"}:
            assert held[key] == driven[key], key
        assert np.array_equal(held["curve"].y, driven["curve"].y)
    fewer = own_cases(small.shortened())
    assert {task.name for task in fewer} == {"corrected"}, "laws that a short report leaves out are run beside MPC"

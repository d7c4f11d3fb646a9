"""jiao2025's laws beside MPC: trips driven once, rows as the study runs them, stated and tuned, ahead from when."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from proofs.jiao2025.simulation.mpc_trip import run_mpc
from proofs.jiao2025.simulation.plans import Case, plan, plan_on
from proofs.jiao2025.simulation.trials import run_trials
from proofs.jiao2025.study.comparison import COMPARISON, DRIVERS, own_rows, own_tasks
from proofs.jiao2025.study.runs import PRINTED_LAWS, JiaoResults, run_case
from workbench.cli.loading import load
from workbench.paper.mpc_comparison import MPC_KINDS
from workbench.paper.stages import run_stages
from workbench.paper.study import varied
from workbench.report.study_figures import study_plot
from workbench.simulate.closed_loop import NOMINAL, Factors

FOLDER = Path(__file__).parents[3] / "proofs" / "jiao2025"
SHORT = {"trials.count": 3, "trials.compared": [1], "trials.line_shown": []}


@pytest.fixture(scope="module")
def study():
    return load(FOLDER).study


@pytest.fixture(scope="module")
def short(study):
    return varied(study, SHORT, "test")


def test_mpc_drives_the_desired_trip_of_a_reading(study):
    desired = plan(study, Case("N", "jiao2025.icfdl", 0)).desired
    for kind in MPC_KINDS:
        row = run_mpc(study, "N", kind)
        assert 0 < row["speed_rms"] < 1e-2 * np.sqrt(np.mean(desired**2))
        assert row["counters"]["qp"] == len(desired) - 1 and row["counters"]["qp_failed"] == 0


def test_the_unit_of_u_is_nothing_to_mpc(study):
    """So its row in a reading is that of every other with steps of the same length."""
    ours, theirs = (run_mpc(study, reading, MPC_KINDS[0]) for reading in ("N", "kN"))
    assert ours["speed_rms"] == pytest.approx(theirs["speed_rms"], rel=1e-9)


def test_driving_is_what_the_study_runs(study):
    run = run_trials(plan_on(study, Case("N", "jiao2025.pd", study.trials.seed), NOMINAL))
    row = DRIVERS.drive(study, "pd", "N", NOMINAL)
    assert row["speed_rms"] ** 2 == pytest.approx(run.mse[-1]) and len(row["trials"]["speed_rms"]) == len(run.rows)


def test_a_heavier_train_is_the_file_with_another_mass(short):
    """The laws are told no mass, so a factor must do what the file's own value does."""
    heavy = short.model_copy(update={"train": short.train.model_copy(update={"mass_kg": 1.06 * short.train.mass_kg})})
    drawn = DRIVERS.drive(short, "icfdl", "N", Factors(mass=1.06))
    assert drawn["speed_rms"] == DRIVERS.drive(heavy, "icfdl", "N", NOMINAL)["speed_rms"]


def test_the_studys_own_runs_are_the_laws_rows(short):
    results = JiaoResults(short, {case: run_case(short, case) for case in (
        Case(reading, law, short.trials.seed) for reading in short.readings for law in PRINTED_LAWS)})
    rows = own_rows(results)
    assert list(rows) == own_tasks(short)
    driven = DRIVERS.drive(short, "icfdl", "N", NOMINAL)
    for key in ("speed_rms", "jerk_rms", "largest_mps"):
        assert rows["N", "icfdl", False][key] == driven[key]


def test_every_reading_stands_in_the_table_and_the_tunings_is_tuned_too(short):
    everything = replace(COMPARISON, own_tasks=lambda study: ())
    (rows,) = run_stages([everything.stage(short)], 1, lambda *_: None)
    assert not set(COMPARISON.stage(short).tasks) & set(own_tasks(short))
    table = next(COMPARISON.tables(short, rows))
    names = [row[1] for row in table.rows if row[0] == DRIVERS.places(short)["N"]]
    assert len(names) == 8 and all(f"{name}, tuned" in names for name in names if not name.endswith("tuned"))
    assert len(table.rows) == 4 * len(short.readings) + 4
    sentences = list(COMPARISON.findings(short, rows))
    ended = sum(rows[reading, "pd", False]["failed"] is None for reading in short.readings)
    assert len(sentences) == 4 and f"PD-type ILC finishes in {ended} of {len(short.readings)} readings" in sentences[3]
    (plot,) = COMPARISON.plots(short, rows)
    assert len(plot.curves) == 8 and "<svg" in study_plot(plot, "learning")
    assert plot.curves[0].x[0] == 0.0, "trials of jiao2025 begin with 0"


def test_a_study_without_mpc_tells_nothing_of_it_and_without_tuning_what_is_stated(study):
    bare = study.model_copy(update={"mpc": None, "tuning": None, "pairs": None})
    assert COMPARISON.tasks(bare) == [] and list(COMPARISON.tables(bare, {})) == []
    untuned = study.model_copy(update={"tuning": None, "pairs": None})
    assert {tuned for _, _, tuned in COMPARISON.tasks(untuned)} == {False}
    assert {place for place, _, _ in COMPARISON.tasks(untuned)} == set(study.readings)

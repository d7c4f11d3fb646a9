"""jiao2025's laws beside MPC: trips driven once, rows as the study runs them, stated and tuned, ahead from when."""

from pathlib import Path

import numpy as np
import pytest

from proofs.jiao2025.simulation.mpc_trip import run_mpc
from proofs.jiao2025.simulation.plans import Case, plan, plan_on
from proofs.jiao2025.simulation.trials import run_trials
from proofs.jiao2025.study.comparison import COMPARISON, DRIVERS, mpc_tasks
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


def test_every_trip_that_differs_is_driven_once(study):
    tasks = mpc_tasks(study)
    trips = {(r.step_s, r.k_per_sample) for r in study.readings.values()}
    assert len(tasks) == len(set(tasks)) == len(trips) * len(MPC_KINDS)
    assert {(study.readings[name].step_s, study.readings[name].k_per_sample) for name, _ in tasks} == trips
    trip = run_mpc(study, tasks[0])
    desired = plan(study, Case(tasks[0][0], "jiao2025.icfdl", 0)).desired
    assert 0 < trip.mse < 1e-4 * np.mean(desired**2)
    assert trip.counters["qp"] == len(desired) - 1 and trip.counters["qp_failed"] == 0


def test_driving_is_what_the_study_runs(study):
    run = run_trials(plan_on(study, Case("N", "jiao2025.pd", study.trials.seed), NOMINAL))
    row = DRIVERS.drive(study, "pd", "N", NOMINAL)
    assert row["speed_rms"] ** 2 == pytest.approx(run.mse[-1]) and len(row["trials"]["speed_rms"]) == len(run.rows)


def test_a_heavier_train_is_the_file_with_another_mass(short):
    """The laws are told no mass, so a factor must do what the file's own value does."""
    heavy = short.model_copy(update={"train": short.train.model_copy(update={"mass_kg": 1.06 * short.train.mass_kg})})
    drawn = DRIVERS.drive(short, "icfdl", "N", Factors(mass=1.06))
    assert drawn["speed_rms"] == DRIVERS.drive(heavy, "icfdl", "N", NOMINAL)["speed_rms"]


def test_stated_and_tuned_stand_side_by_side(short):
    (rows,) = run_stages([COMPARISON.stage(short)], 1, lambda *_: None)
    table = next(COMPARISON.tables(short, rows))
    names = [row[1] for row in table.rows]
    assert len(names) == 8 and all(f"{name}, tuned" in names for name in names if not name.endswith("tuned"))
    assert len(list(COMPARISON.findings(short, rows))) == 2
    plot = next(COMPARISON.plots(short, rows))
    assert len(plot.curves) == 8 and "<svg" in study_plot(plot, "learning")
    assert plot.curves[0].x[0] == 0.0, "trials of jiao2025 begin with 0"


def test_a_study_without_tuning_or_mpc_tells_nothing_of_it(study):
    for missing in ("tuning", "mpc"):
        bare = study.model_copy(update={missing: None, "pairs": None})
        assert COMPARISON.tasks(bare) == [] and list(COMPARISON.tables(bare, {})) == []
    assert mpc_tasks(study.model_copy(update={"mpc": None})) == []

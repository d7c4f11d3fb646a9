"""mao2018's study as a whole, and its laws beside MPC."""

import json
from dataclasses import replace

import numpy as np
import pytest
from mao2018_cases import CASES

from proofs.mao2018 import plant
from proofs.mao2018.simulation.trip import setting_of
from proofs.mao2018.study import KIND
from proofs.mao2018.study.comparison import DRIVE, DRIVERS
from proofs.mao2018.study.runs import RunCase, run_case, run_cases
from workbench.paper.cells import numbers_in
from workbench.paper.comparison import comparison_tasks
from workbench.paper.mpc_comparison import MPC_KINDS, known, run_mpc
from workbench.paper.pairs import pair_tasks
from workbench.paper.reproduced import STATED
from workbench.report.runs import study_document
from workbench.simulate.closed_loop import Factors, simulate_in


@pytest.fixture(scope="module")
def short(study):
    """The first seconds of everything, and few changes."""
    some = [change for change in study.changes if change.laws != "corrected" or len(change.cases) > 1]
    return study.model_copy(update={
        "horizon": study.horizon.model_copy(update={"end_s": 1.5, "settled_window_s": 0.5}),
        "sampling": study.sampling.model_copy(update={"end_s": 1.0}), "changes": tuple(some),
        "pairs": study.pairs.model_copy(update={"draws": 2, "set": {}})})


@pytest.fixture(scope="module")
def told(short):
    """The short study's result, and what was told of its progress."""
    steps = []
    return KIND.run(short, 1, lambda *step: steps.append(step)), steps


def test_progress_counts_all_runs(short, told):
    result, steps = told
    more = len(comparison_tasks(DRIVERS, short)) + len(pair_tasks(DRIVERS, short))
    assert len(result.rows) == len(run_cases(short)) == len(steps) - more
    assert [(done, total) for done, total, _ in steps] == [(i + 1, len(steps)) for i in range(len(steps))]
    assert steps[-1][2].startswith("drawn train ")


def test_a_study_has_every_figure_and_no_nan_and_says_what_failed(short, told):
    result, _ = told
    assert json.dumps(study_document(short, result), allow_nan=False)
    sources = [plot.source for plot in result.plots]
    assert sources[:5] == ["paper, Figure 1", *(f"paper, Figure 2 ({letter})" for letter in "abcd")]
    failed = dict(result.failures)
    assert {"case 2, as printed", "case 4, as printed", "case 5, as printed"} <= {
        ", ".join(name.split(", ")[:2]) for name in failed}
    assert all("diverged at t = " in why and "mao2018." in why for why in failed.values())
    assert sum(row["failed"] is not None for row in result.rows) == len(failed)
    text = " ".join(result.findings)
    assert "case 2 diverged at 0.301 s" in text and "nan" not in text and "None" not in text


def test_tables_hold_numbers_in_si_and_show_them_in_units_that_fit(short, told):
    tables = {table.title: table for table in told[0].tables}
    assert all(any(True for row in table.rows for cell in row for _ in numbers_in(cell)) for table in tables.values())
    printed = tables["Tracking errors, printed and obtained"]
    assert printed.text[1][3] == "diverged at 0.301 s" and printed.values[1][3] == [pytest.approx(0.301)]
    assert printed.text[0][4] == "550 mm, settles to 10 mm" or " mm, settles to " in printed.text[0][4]
    periods = tables["Which sampling the stated gains bear"]
    assert periods.headings[:2] == ("period (ms)", "r_2 (1/s)")
    assert periods.rows[0][0] == 1e-3 and (periods.text[0][0], periods.values[0][0]) == ("1", 1.0)
    beside = tables["Beside MPC"]
    titles = [(row[0], row[1]) for row in beside.rows]
    assert titles[:3] == [("1, healthy", "the law"), ("1, healthy", "linear MPC"),
                          ("1, healthy", "offset-free nonlinear MPC")]
    of_case_2 = [name for case, name in titles if case.startswith("2")]
    assert of_case_2[:2] == ["as printed", "signs corrected"] and of_case_2[4] == "signs corrected, tuned"
    assert beside.rows[of_case_2.index("as printed") + 6][2] == "fails"


def test_the_same_study_twice_is_the_same(short):
    asked = RunCase(4, "scaled", ("44", "54"))
    one, other = run_case(short, asked), run_case(short, asked)
    assert one.row | {"step_us_median": 0, "step_us_p99": 0} == other.row | {"step_us_median": 0, "step_us_p99": 0}
    assert one.curves["error"].y.tobytes() == other.curves["error"].y.tobytes()


def test_every_case_runs_printed_corrected_and_with_each_sign_alone(study):
    asked = run_cases(study)
    assert len(asked) == len(set(asked))
    for tuning in study.tunings:
        for case, ways in zip(CASES, (1, 2, 2, 4, 4), strict=True):
            runs = [one for one in asked
                    if (one.number, one.tuning, one.change, one.end_s) == (case, tuning, STATED, None)]
            assert len(runs) == ways


def test_offset_free_mpc_forgets_a_failed_motor_and_linear_mpc_does_not(study):
    tuning = next(iter(study.tunings.values()))
    setting = replace(setting_of(study, study.cases[1], tuning, 900.0), log_every_s=1.0)
    a, b, c = setting.changes[0, 1:4]
    of = known(study.mpc, setting.curve, setting.mass_kg, (a, b, c), setting.end_s)
    offset = {}
    for kind in MPC_KINDS:
        done = run_mpc(of, kind, setting, plant.train)
        time, error = done.column("t_s"), done.column("s_m") - done.column("s_desired_m")
        offset[kind] = np.abs(error[(time > 700) & (time < 790)]).max()
    # 200 kN of one motor, less its share of what the others give: 0.5 m/s^2 that the linear one must lean against.
    assert offset["mpc.offset_free"] < 0.01 * offset["mpc.linear"]


def test_mpc_drives_a_heavier_train_than_it_knows(short):
    driven = DRIVE.run(short, "mpc_linear", "2", Factors(mass=1.1))
    setting = setting_of(short, short.cases[1], next(iter(short.tunings.values())))
    a, b, c = setting.changes[0, 1:4]
    of = known(short.mpc, setting.curve, setting.mass_kg, (a, b, c), setting.end_s)
    heavy = replace(setting, mass_kg=1.1 * setting.mass_kg,
                    limits=(of.train.max_traction_n, of.train.max_braking_n, np.inf))
    assert np.array_equal(driven.log, simulate_in(of, "mpc.linear", heavy, plant.train).log)

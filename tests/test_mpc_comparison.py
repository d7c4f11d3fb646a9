"""Laws and MPC side by side: which runs there are, and what table, sentences and figure say of them."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from workbench.model.desired_curve import start_cruise_stop
from workbench.paper.comparison import (
    COLUMNS,
    ComparedRun,
    Task,
    TripComparison,
    compared_runs,
    comparison_findings,
    comparison_note,
    comparison_plot,
    comparison_stage,
    comparison_table,
    comparison_tasks,
)
from workbench.paper.dotted import value_at, with_value_at
from workbench.paper.drivers import MPC_NAMES, Drivers
from workbench.paper.mpc_comparison import MPC_KINDS, MpcData, counters_words, known, run_mpc
from workbench.paper.reproduced import Results
from workbench.paper.results import Curve
from workbench.paper.stages import run_stages
from workbench.paper.trip_run import TripRun
from workbench.simulate.closed_loop import Setting

DATA = MpcData(period_s=0.1, horizon=20, position_weight=25.0, speed_weight=15.0, command_weight=4.0,
               change_weight=0.1, band_price=1000.0, band_m=1.0, observer_gain=0.3, max_traction_mps2=1.0,
               max_braking_mps2=1.0, source=dict.fromkeys(
                   [name for name in MpcData.model_fields if name != "source"], "assumed: a test"))


def row(error, failed=None, jerk=0.5, **more):
    """A run's row as `workbench compare` has it."""
    return {"failed": failed, "position_rms": error, "speed_rms": 2 * error, "position_error_min": -3 * error,
            "position_error_max": error, "stopping_error": 0.1, "energy_J": 7.2e6, "jerk_rms": jerk,
            "saturated_fraction": 0.0, "step_us_median": 12.0,
            "curve": Curve("error", np.arange(5.0), np.full(5, -error)), **more}


def drive(study, name, place, factors):
    return row(study.errors[name] * (2 if place == "hill" else 1), counters={"qp": 3})


class Errors(BaseModel):
    """A study of which nothing is stated but the errors that its controllers make."""

    mpc: Any = DATA
    tuning: Any = None
    errors: dict[str, float]

    def leaves_out(self, part: Any) -> bool:
        return part is not None and part.only_full


def variants(study, name):
    return {"": study} if name in MPC_NAMES else {", low": study, ", high": with_value_at(study, f"errors.{name}", 0.3)}


DRIVERS = Drivers({"law": "the law", "mpc_linear": "linear MPC"},
                  lambda study: {"flat": "run flat", "hill": "run hill"},
                  lambda study, name: {"error": f"errors.{name}"}, drive, variants)


@pytest.fixture
def study():
    tuning = SimpleNamespace(found={"law": {"error": 0.05}}, runs=10, set={"end_s": 9.0}, only_full=False,
                             objective=SimpleNamespace(units={"position_rms": 0.1, "logged_jerk_rms": 0.3}))
    return Errors(tuning=tuning, errors={"law": 0.2, "mpc_linear": 0.1})


def compared(study):
    (results,) = run_stages((comparison_stage(DRIVERS, study),), 1, lambda *_: None)
    return compared_runs(DRIVERS, results)


def test_every_place_has_all_as_stated_and_what_was_tuned(study):
    flat = [Task("flat", "law", ", low"), Task("flat", "law", ", high"), Task("flat", "law", tuned=True),
            Task("flat", "mpc_linear")]
    assert comparison_tasks(DRIVERS, study)[:4] == flat and len(comparison_tasks(DRIVERS, study)) == 8
    study.tuning = None
    assert comparison_tasks(DRIVERS, study)[:3] == [flat[0], flat[1], flat[3]]
    study.mpc = None
    assert comparison_tasks(DRIVERS, study) == [] == compared(study)
    assert list(comparison_table(DRIVERS, study, [], "run", "")) == [] == list(comparison_findings(DRIVERS, study, []))
    assert list(comparison_plot([], "flat")) == []


def test_a_short_report_leaves_tuned_rows_out_where_the_file_says_so_and_no_run_is_made_twice(study):
    own = {Task("flat", "law", ", low"): "the case"}
    beside = TripComparison(DRIVERS, "run", lambda study: 0.1, lambda study, runs: ([], ""),
                            note=lambda study: "Of a test.", own_cases=lambda study: own)
    for only_full, runs in ((False, 8), (True, 6)):
        study.tuning.only_full = only_full
        stage = beside.stage(study)
        assert len(stage.tasks) == runs - 1 and not own.keys() & set(stage.tasks)
        (found,) = run_stages((stage,), 1, lambda *_: None)
        run = TripRun("the case", row(7.0), {"error": Curve("error", np.zeros(1), np.zeros(1))})
        (table,) = beside.shown(Results(study, {"the case": run}), found).tables
        assert len(table.rows) == runs and table.rows[0][2] == 7.0
        assert "Of a test." in table.note
        assert table.note.endswith(" Shortened: 2 runs left out; all with --full.") == only_full


def test_the_table_holds_numbers_and_who_is_told_what(study):
    runs = compared(study)
    assert [run.row["position_rms"] for run in runs[:4]] == [0.2, 0.3, 0.05, 0.1]
    (table,) = comparison_table(DRIVERS, study, runs, "run", "a note", {"law": "full state"})
    assert [line[:3] for line in table.rows[:4]] == [
        ("flat", "the law, low", "full state"), ("flat", "the law, high", "full state"),
        ("flat", "the law, tuned", "full state"), ("flat", "linear MPC", "full state, nominal model")]
    assert table.rows[0][3:] == (0.2, 0.4, pytest.approx(0.6), 0.1, 7.2e6, 0.5, 0.0, pytest.approx(12e-6))
    assert table.text[0][3:] == ("0.200", "0.400", "0.600", "0.100", "2.00", "0.500", "0", "12.0")
    assert [column.unit for column in table.columns[-5:]] == ["m", "kWh", "m/s³", "", "µs"]
    lost = ComparedRun(Task("flat", "law"), "the law", {"failed": "diverged", "step_us_median": 3.0})
    (table,) = comparison_table(DRIVERS, study, [lost], "run", "")
    assert table.rows[0][2:] == ("fails", *[None] * (len(COLUMNS) - 2), pytest.approx(3e-6))


def test_sentences_say_who_is_nearest_as_stated_and_as_tuned(study):
    stated, tuned, on_hill, _, steps = comparison_findings(DRIVERS, study, compared(study))
    assert stated.startswith("Beside MPC, run flat, as stated: linear MPC has the smallest position RMS, 0.100 m, then "
                             "the law, low with 0.200 m; ")
    assert tuned.startswith("Beside MPC, run flat, tuned: the law has the smallest position RMS, 0.0500 m; ")
    assert "run hill" in on_hill and steps == "A step of MPC takes 12.0 to 12.0 µs here."


def test_the_note_says_what_mpc_plans_with_and_counted(study):
    note = comparison_note(study, compared(study), 0.01, "Nobody knows.")
    assert note.startswith("MPC every 0.1 s, 20 samples ahead, limits of 1 m/s², the laws every 0.01 s, without")
    assert "Nobody knows. MPC counted quadratic programs 24. Tuned: by 'workbench tune', 10 runs" in note
    assert note.endswith("The tuning's runs are shorter than these, see the file.")
    assert counters_words([{"late": 0}]) == "nothing"


def test_the_figure_has_the_sizes_of_all_that_finish(study):
    lost = ComparedRun(Task("flat", "law"), "lost", row(9.0, failed="diverged"))
    (plot,) = comparison_plot([*compared(study)[:3], lost], "run flat")
    assert [curve.label for curve in plot.curves] == ["the law, low", "the law, high", "the law, tuned"]
    assert plot.log_y and plot.curves[0].y == pytest.approx(np.full(5, 0.2))


@pytest.mark.parametrize("kind", MPC_KINDS)
def test_mpc_follows_a_curve_within_the_limits_that_it_knows(kind):
    curve = start_cruise_stop(1000.0, 15.0, 0.5, 0.5, 4.0)
    of = known(DATA, curve, 4e5, (4000.0, 100.0, 10.0), curve.trip_time_s)
    setting = Setting(curve=curve, mass_kg=4e5, nominal_mass_kg=1.0, davis_n=(4000.0, 100.0, 10.0), plant_step_s=0.01,
                      end_s=curve.trip_time_s, log_every_s=0.1, position_band_m=1.0)
    run = run_mpc(of, kind, setting)
    assert run.failed is None and np.abs(run.column("s_m") - run.column("s_desired_m")).max() < 0.1
    assert np.abs(run.column("u_mps2")).max() <= 1.0 + 1e-9 and run.counters["qp_failed"] == 0


def test_a_value_is_read_and_replaced_where_its_key_says():
    class Gains(BaseModel):
        k: tuple[float, ...]

    class Own(BaseModel):
        gains: dict[str, Gains]

    of = Own(gains={"first": Gains(k=(1.0, 2.0, 3.0)), "second": Gains(k=(4.0,))})
    other = with_value_at(of, "gains.first.k.1", 9.0)
    assert value_at(of, "gains.first.k.1") == 2.0 and value_at(other, "gains.first.k.1") == 9.0
    assert other.gains["first"].k == (1.0, 9.0, 3.0) and other.gains["second"] is of.gains["second"]

"""What a study keeps of a run along a trip: the row of `workbench compare`, the paper's own numbers, thinned curves."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from workbench.model.desired_curve import start_cruise_stop
from workbench.model.law import ControlLaw, desired_acceleration, desired_position, desired_speed, position, speed
from workbench.paper.cells import FORCES, LENGTHS, Scaled, cell_text
from workbench.paper.reproduction import plain_row
from workbench.paper.results import Curve
from workbench.paper.trip_run import ERROR, TripRun, error_curve, signal_numbers, thinned_log, trip_numbers
from workbench.simulate.closed_loop import Run, Setting, run_law
from workbench.simulate.metrics import measure_run

CURVE = start_cruise_stop(500.0, 10.0, 0.5, 0.5, 2.0)
SPRING = ControlLaw(id="mine.spring", title="spring", source="none", information="full state",
                    command=desired_acceleration - (position - desired_position) - (speed - desired_speed))
NOTHING = (np.zeros(0), np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0)))


@pytest.fixture(scope="module")
def run() -> Run:
    setting = Setting(curve=CURVE, mass_kg=1e5, nominal_mass_kg=1e5, davis_n=(2000.0, 0.0, 0.0), plant_step_s=0.05,
                      end_s=CURVE.trip_time_s, log_every_s=0.05, position_band_m=10.0)
    return run_law(SPRING, NOTHING, setting, 0.05, "explicit")


def test_a_row_has_all_of_compare_and_the_papers_own_without_what_is_none(run):
    row = trip_numbers(run, CURVE.length_m, energy_both_J=2.0, reversals=math.nan, law="as printed")
    compared = measure_run(run, CURVE.length_m).row()
    assert {key: row[key] for key in compared} == compared and row["end_s"] == run.end_s
    assert (row["energy_both_J"], row["reversals"], row["law"]) == (2.0, None, "as printed")


def test_signals_are_measured_over_the_log_of_a_run_that_ended(run):
    wave = np.sin(np.linspace(0, 2 * np.pi, 1001)[:-1]) + 1.0
    assert signal_numbers(run, {"wave": wave}) == {
        "wave_rms": pytest.approx(math.sqrt(1.5)), "wave_min": pytest.approx(0.0), "wave_max": pytest.approx(2.0)}
    lost = SimpleNamespace(failed="lost")
    assert set(signal_numbers(lost, {"wave": np.array([1.0, np.inf])}).values()) == {None}


def test_curves_are_over_time_in_the_units_of_the_log(run):
    curves = thinned_log(run, {ERROR: run.position_error, "v": run.column("v_mps")})
    assert curves[ERROR].y.tobytes() == error_curve(run).y.tobytes() and curves["v"].label == "v"
    assert curves["v"].y.max() == run.column("v_mps").max() and curves["v"].x[-1] == run.column("t_s")[-1]


@dataclass(frozen=True)
class Case:
    column: int
    mended: tuple[str, ...]
    change: int


def test_a_study_shows_such_a_run_by_its_case_and_its_row():
    study = SimpleNamespace(change_title=lambda number: "heavier")
    run = TripRun(Case(3, ("44",), 0), {"failed": None, "position_rms": 0.5, "column": 4}, {})
    assert plain_row(study, run.case, run) == {"column": 4, "change": "heavier", "failed": None, "position_rms": 0.5}
    assert run.failed is None and TripRun(run.case, {"failed": "lost"}, {}).failed == "lost"


def test_a_run_says_when_it_diverged_and_nothing_where_it_did_not():
    for end_s, words in ((0.3012, "diverged at 0.301 s"), (101.26, "diverged at 101.3 s")):
        assert cell_text(TripRun(None, {"failed": "lost", "end_s": end_s}, {}).ended) == words
    assert TripRun(None, {"failed": None, "end_s": 9.0}, {}).ended is None


def test_a_curve_is_drawn_by_parts_in_other_units_and_by_its_size():
    curve = Curve("e", np.arange(6.0), np.array([5.0, -0.5, 0.0, 1.0, -3.0, 0.5]))
    part = curve.part(1.0, 2.0)
    assert part.x.tolist() == [1.0, 2.0, 3.0] and part.called("mm", 1e3).y.tolist() == [-500.0, 0.0, 1000.0]
    assert curve.part(6.0, 2.0) is None and curve.part(0.0, 1.0).y.tolist() == [5.0], "its first point stays"
    assert curve.size().y.tolist() == [5.0, 0.5, 1.0, 3.0, 0.5] and curve.size().x.tolist() == [0, 1, 3, 4, 5]
    flat = Curve("flat", np.arange(3.0), np.zeros(3))
    assert flat.size() is flat and curve.called("other").y is curve.y


def test_a_size_reads_in_sentences_as_in_tables():
    for value, units, words in ((0.0123, LENGTHS, "12 mm"), (2.5e5, FORCES, "250 kN"), (None, LENGTHS, "—")):
        assert f"{Scaled(value, units)}" == cell_text(Scaled(value, units)) == words

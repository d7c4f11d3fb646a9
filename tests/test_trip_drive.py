"""One declaration of how laws and MPC drive a trip: rows, drawn trains and tracking are runs of the same law."""

from types import SimpleNamespace

import numpy as np
import pytest
from test_mpc_comparison import DATA
from test_trip_run import CURVE, NOTHING, SPRING

from workbench.model.desired_curve import start_cruise_stop
from workbench.paper.mpc_comparison import known, run_mpc
from workbench.paper.trip_drive import TripDrive
from workbench.simulate.closed_loop import Factors, Setting, run_law
from workbench.trains.train import single_particle

STUDY = SimpleNamespace(paper="mine2026", mpc=DATA)
SLOWER = start_cruise_stop(500.0, 8.0, 0.5, 0.5, 2.0)


def setting(study, place):
    resistance = {"calm": 2000.0, "wind": 6000.0}[place]
    return Setting(curve=CURVE, mass_kg=1e5, nominal_mass_kg=1e5, davis_n=(resistance, 100.0, 10.0), plant_step_s=0.05,
                   end_s=CURVE.trip_time_s, log_every_s=0.05, position_band_m=10.0)


def law(study, name, place, of):
    return run_law(SPRING, NOTHING, of, 0.05, "explicit")


def calm(study, of):
    return of.mass_kg, (2000.0, 100.0, 10.0)


DRIVE = TripDrive(setting, law, calm, single_particle())


def test_a_law_and_mpc_drive_the_setting_of_a_place():
    row = DRIVE.row(STUDY, "spring", "wind")
    run = law(STUDY, "spring", "wind", setting(STUDY, "wind"))
    assert row["position_error_min"] == run.totals["position_error_min"] and row["failed"] is None
    assert row["curve"].y.min() == run.position_error.min()
    of = known(DATA, CURVE, 1e5, (2000.0, 100.0, 10.0), CURVE.trip_time_s)
    alone = run_mpc(of, "mpc.linear", setting(STUDY, "wind"), single_particle())
    assert np.array_equal(DRIVE.run(STUDY, "mpc_linear", "wind").log, alone.log)


def test_a_drawn_train_differs_from_what_is_known_by_its_factors():
    """A spring that is told no resistance leans against each further 2 kN on 100 t by the same 0.02 m."""
    errors = [run.position_error[np.searchsorted(run.column("t_s"), 30.0)] for run in (
        DRIVE.run(STUDY, "spring", "calm", Factors(davis_a=factor, davis_b=0.0, davis_c=0.0))
        for factor in (1.0, 2.0, 3.0))]
    assert np.diff(errors) == pytest.approx([-0.02, -0.02], rel=1e-3)


def test_tracking_follows_its_own_curve_or_a_given_one_to_its_end():
    track = DRIVE.tracking("spring", lambda study: "calm")
    own, given = track(STUDY, None), track(STUDY, SLOWER)
    assert (own.paper, own.controller, own.failed) == ("mine2026", "mine.spring", None)
    assert own.trip_time_s == CURVE.trip_time_s and given.trip_time_s == SLOWER.trip_time_s > CURVE.trip_time_s
    assert given.length_m == pytest.approx(500.0)
    assert given.largest_position_m < 1.0 and given.energy_j < own.energy_j

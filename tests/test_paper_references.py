"""The papers' energy-optimal references: made by their rules, the same work of less energy, and followed."""

import shutil
from dataclasses import replace

import numpy as np
import pytest
from scenarios import PROOFS, SHARED, TRAIN_PAPERS, YANG, variant_of

from proofs.chen2019.simulation import plans as chen2019_plans
from proofs.chen2019.simulation.cars_runs import run_cars
from workbench.cli.loading import load
from workbench.errors import InputError
from workbench.model.curve_table import curve_through, read_rows
from workbench.optimal.curve_request import requested_curve
from workbench.paper.tracking import track
from workbench.simulate.closed_loop import simulate
from workbench.trains.scenario import load_scenario

RULES = sorted(PROOFS.glob("*/reference.toml"))


def test_every_paper_has_one():
    assert {path.parent.name for path in RULES} >= set(TRAIN_PAPERS)


@pytest.mark.parametrize("rule", RULES, ids=lambda path: path.parent.name)
def test_the_stored_table_is_what_its_rule_gives(rule):
    made = requested_curve(rule)
    assert made.reference.optimal.gap < 1e-3 and made.reference.optimal.status == "optimal"
    assert made.reference.speed_excess_mps < 1e-6 and made.reference.force_excess == 0
    # Solvers differ in their last digits from machine to machine: the energy is the same, the run nearly.
    stored = curve_through(read_rows(rule.with_suffix(".csv")))
    time = np.linspace(0, stored.trip_time_s, 4001)
    position, speed, _ = stored.at(time)
    wanted = made.reference.run.at(time)
    assert np.abs(speed - wanted[1]).max() < 0.2
    assert np.abs(position - wanted[0]).max() < 20.0
    assert stored.length_m == pytest.approx(made.rows[-1, 1], abs=1e-3)


@pytest.mark.parametrize("paper", ["jiao2025", "liu2020", "mao2018", "yang2021"])
def test_its_main_controller_follows_the_optimal_reference_about_as_well_as_its_own(paper):
    loaded = load(PROOFS / paper)
    own, best = track(loaded), track(loaded, read_rows(PROOFS / paper / "reference.csv"))
    assert own.failed is None and best.failed is None
    assert best.length_m == pytest.approx(own.length_m, abs=1.0)
    assert best.speed_rms_mps < 2 * own.speed_rms_mps
    if own.position_rms_m is not None:
        assert best.position_rms_m < 1.5 * own.position_rms_m
    if paper != "jiao2025":  # its law drives and brakes by turns, whatever the curve asks for
        assert best.energy_j < 0.98 * own.energy_j


def test_a_variant_of_the_scenario_takes_the_table():
    path = YANG
    own = load_scenario(path)
    variant = next(v for v in own.variants if "reference" in v.set)
    changed = variant_of(path, variant)
    assert changed.desired_curve().length_m == pytest.approx(53_880.0, abs=1.0)
    energy = [simulate(scenario, "pid").totals["traction_work_j"] for scenario in (own, changed)]
    assert energy[1] < energy[0]


@pytest.mark.parametrize(("old", "new", "key"), [
    ("trip_time_s = 1785.0", "trip_time_s = -1.0", "trip_time_s"), ("window_s = 8.0", "window_s = 0.0", "window_s"),
    ('track = "line.toml"', 'track = "none.toml"', "none.toml"),
    ("every_s = 2.0", "every_s = 2.0\nforce_share = 1.5", "force_share"), ("every_s = 2.0", "", "every_s"),
])
def test_what_is_wrong_with_a_rule_is_said_in_one_line(tmp_path, old, new, key):
    text = (YANG.parent / "reference.toml").read_text(encoding="utf-8")
    text = text.replace('"../../benchmarks/', f'"{SHARED.as_posix()}/')
    shutil.copy(YANG.parent / "line.toml", tmp_path / "line.toml")
    path = tmp_path / "rule.toml"
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(InputError, match=key) as trouble:
        requested_curve(path)
    assert "\n" not in str(trouble.value)


def test_the_cars_of_chen2019_learn_the_optimal_reference():
    study = load(PROOFS / "chen2019").record
    curve = curve_through(read_rows(PROOFS / "chen2019" / "reference.csv"))
    times = np.arange(study.samples, dtype=float) * study.sampling.period_s
    plan = replace(chen2019_plans.plan(study), reference=np.stack(curve.at(times), axis=1), trials=3, kept=())
    run = run_cars(plan)
    assert run.failed is None
    errors = run.total("position_error_square_s")
    assert errors[2] < errors[1] < errors[0]
    # Less work than on the reference of the same way and time that the study assumes.
    own = run_cars(replace(chen2019_plans.plan(study), trials=3, kept=()))
    assert run.total("traction_work_j")[2] < 0.8 * own.total("traction_work_j")[2]

"""chen2019 runs: the compiled trips against plain vectors; what the paper says where it holds, and where not."""

import json
import math
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import plain_cars
import pytest
import sympy as sp
from test_report import without_scripts

from proofs.chen2019 import laws as law
from proofs.chen2019.simulation.cars_runs import LANES, run_cars, run_together
from proofs.chen2019.simulation.formulas import (
    allowed_change,
    alternating_growth,
    cef_change,
    first_cef,
    needed_force,
)
from proofs.chen2019.simulation.plans import plan
from proofs.chen2019.study import KIND
from proofs.chen2019.study.record import ChenStudy
from proofs.chen2019.study.runs import (
    STATED,
    RunCase,
    groups,
    grows_from,
    outcome,
    run_cases,
    run_cases_together,
    title,
)
from workbench.cli import app as cli
from workbench.cli.loading import load
from workbench.compile.kernel import cars_source
from workbench.errors import CompileError, InputError
from workbench.files.toml import validate_record
from workbench.paper.cells import numbers_in
from workbench.paper.learning_comparison import rises
from workbench.paper.study import with_values
from workbench.report.charts.chart import chart_of
from workbench.report.charts.files import write_curves
from workbench.report.runs import study_document
from workbench.report.sources import sourced_values
from workbench.report.study_page import StudyContent, build_study_page
from workbench.trains import multi_particle as of_train

FOLDER = Path(__file__).parents[3] / "proofs" / "chen2019"
# A stronger train that is at its cruise speed soon, and fewer trips.
SHORT = {"train.traction_n": 2e5, "train.braking_n": 2e5, "reference.acceleration_mps2": 1.0,
         "reference.braking_mps2": 1.0, "reference.trip_time_s": 200.0, "trials.count": 8, "trials.shown": (1, 8),
         "cost.end_s": 2.0}


@pytest.fixture(scope="module")
def study():
    return load(FOLDER).study


def changed(study, **values):
    """The study without its changes, with values set; dots as double underscores."""
    return with_values(study.model_copy(update={"changes": ()}),
                       {key.replace("__", "."): value for key, value in values.items()}, "test")


@pytest.fixture(scope="module")
def short(study):
    """The stated study on a short trip, with the changes that the tests look at."""
    wanted = ("c_1 = 1, acceleration of the sample before", "c_3 = 1/100, room of 100 kg for the estimate of the mass",
              "(17)-(22) with the errors of the same sample", "slopes as a function of time", "slopes where the car is",
              "50.03 to 55 t: the lower bound 30 kg above the mass", "acceleration filtered with 0.1 s")
    base = changed(study, **{key.replace(".", "__"): value for key, value in SHORT.items()})
    return base.model_copy(update={"changes": tuple(c for c in study.changes if c.title in wanted),
                                   "pairs": study.pairs.model_copy(update={"draws": 2, "set": {
                                       "reference.cruise_mps": 30.0, "reference.trip_time_s": 80.0}})})


@pytest.fixture(scope="module")
def runs(short):
    """Of every change by its title, and the stated one."""
    return {title(short, case): run for among in groups(short, run_cases(short))
            for case, run in zip(among, run_cases_together(short, among), strict=True)}


# --- the compiled trips ---------------------------------------------------------------------------------------------


def fast_plan(study, **values):
    """Two trips of a quarter of a second at some 80 m/s, four cars, with limits that bind."""
    made = plan(changed(study, train__cars=4, trials__count=2, trials__shown=(1, 2), sampling__log_every_s=0.001,
                        **values))
    t = np.arange(250) * 1e-3
    wave = np.stack([80 * t + 0.3 * (1 - np.cos(3 * t)), 80 + 0.9 * np.sin(3 * t), 2.7 * np.cos(3 * t)], axis=1)
    cars = made.cars.copy()
    cars[0] *= (1.0, 0.9, 1.1, 1.05)
    cars[4], cars[5] = cars[0] * 0.97, cars[0] * 1.02
    return replace(made, reference=wave, cars=cars, values=dict(made.values) | {"m_total": float(cars[0].sum())})


@pytest.mark.parametrize("values", [
    {},
    {"sampling__memory": "same_sample", "line__seen_by": "train", "line__slope_permille": 30.0},
    {"sampling__acceleration": "sampled", "sampling__memory": "same_sample", "variation__swing": 0.3,
     "variation__beat_s": 2.0},
    {"sampling__acceleration": "filtered", "sampling__filter_s": 0.02, "line__seen_by": "reference",
     "trials__lambda_1_m": 0.5, "trials__lambda_2_mps": -0.1},
], ids=["as stated", "same sample, slopes", "sampled, varied", "filtered, other start"])
def test_compiled_trips_are_those_of_plain_vectors(study, values):
    made = fast_plan(study, **values)
    done = run_cars(made)
    s, v, u, delta, before, estimates = plain_cars.run(made)
    assert done.failed is None
    assert np.ptp(u, axis=0).min() > 1e2
    assert (u == made.cars[3]).any()
    assert (np.abs(estimates[2] - made.cars[4]) > 0).any()
    assert done.log(2, "s_m") == pytest.approx(s, rel=1e-9, abs=1e-7)
    assert done.log(2, "v_mps") == pytest.approx(v, rel=1e-7, abs=1e-6)
    assert done.log(2, "u_n") == pytest.approx(u, rel=1e-4, abs=5)
    assert done.log(2, "difference_n") == pytest.approx(delta, rel=1e-4, abs=5)
    assert done.difference[-1] == pytest.approx(np.abs(delta).max(), rel=1e-4)
    errors = s - made.reference[:, :1]
    assert done.position_error[-1] == pytest.approx(np.abs(errors).max(), rel=1e-6)
    assert done.total("position_error_square_s")[-1] == pytest.approx(np.sum(errors**2) * 1e-3, rel=1e-6)
    if not values:
        energies = [plain_cars.energy(made, x) for x in (before, estimates)]
        assert done.total("cef_change")[-1] == pytest.approx(energies[1] - energies[0], rel=1e-4)


def same_run(one, other):
    """Whether two runs left the same bits."""
    return (np.array_equal(one.totals, other.totals) and np.array_equal(one.by_car, other.by_car)
            and one.failed == other.failed and len(one.step_us) == len(other.step_us)
            and one.logs.keys() == other.logs.keys()
            and all(np.array_equal(log, other.logs[trial]) for trial, log in one.logs.items()))


def test_runs_side_by_side_have_the_bits_of_each_alone(study):
    """One fails, one goes on from another, one waits for a lane, and one cannot share the others' loop."""
    made = fast_plan(study)
    heavy = made.cars.copy()
    heavy[4], heavy[5] = heavy[0] + 10.0, heavy[0] + 80.0
    plans = [made, replace(made, cars=heavy, trials=9), replace(made, trials=4, kept=(4,)),
             *(replace(made, start=(0.1 * i, 0.0)) for i in range(1, LANES)), replace(made, memory="same_sample")]
    alone = [run_cars(plan) for plan in plans]
    assert [run.failed is None for run in alone] == [True, False, *([True] * (len(plans) - 2))]
    assert all(map(same_run, run_together(plans), alone))
    assert len({run.totals[-1].tobytes() for run in alone}) == len(plans)


def test_every_case_is_in_one_group_and_what_is_one_run_in_the_same(study):
    found = groups(study, run_cases(study))
    assert sorted(case.change for among in found for case in among) == list(range(STATED, len(study.changes)))
    longer = next(n for n, change in enumerate(study.changes) if set(change.set) == {"trials.count"})
    assert any({RunCase(), RunCase(longer)} <= set(among) for among in found)


def test_a_step_of_half_the_length_gives_the_same_trip(short):
    one = run_cars(plan(changed(short, trials__count=2, trials__shown=(1, 2))))
    other = run_cars(plan(changed(short, trials__count=2, trials__shown=(1, 2), sampling__period_s=0.0005)))
    assert one.position_error == pytest.approx(other.position_error, rel=1e-2)
    assert one.speed_error == pytest.approx(other.speed_error, rel=1e-2)


def test_the_forces_that_run_are_those_of_a_train_that_is_written_out():
    """Three cars by (1)-(3), car by car."""
    s, v = sp.symbols("s_1:4"), sp.symbols("v_1:4")
    masses = sp.symbols("m_1:4")
    c_0, c_v, c_a, c_k, c_d = of_train.coefficients
    pull = [c_k * (s[i] - s[i + 1]) + c_d * (v[i] - v[i + 1]) for i in range(2)]
    basic = [-masses[i] * (c_0 + c_v * v[i]) for i in range(3)]
    written = [basic[0] - sum(masses) * c_a * v[0] ** 2 - pull[0], basic[1] + pull[0] - pull[1], basic[2] + pull[1]]
    for i in range(3):
        ends = (max(i - 1, 0), i, min(i + 1, 2))
        values = {of_train.m: masses[i], of_train.first: int(i == 0), of_train.m_total: sum(masses), of_train.f_a: 0}
        for symbol, names in ((of_train.s, s), (of_train.v, v)):
            places = (of_train.ahead(symbol), symbol, of_train.behind(symbol))
            values |= {place: names[j] for place, j in zip(places, ends, strict=True)}
        assert sp.expand(of_train.rest_force.xreplace(values) - written[i]) == 0


def test_an_index_that_is_no_neighbour_is_refused():
    far = of_train.s.base[of_train.car + 2]
    with pytest.raises(CompileError, match="an index is j, j - 1 or j \\+ 1"):
        cars_source("f", (), (), ((of_train.s,),), ((far,),))


# --- what the paper says --------------------------------------------------------------------------------------------


def test_errors_fall_from_trip_to_trip_and_so_does_the_difference(runs):
    stated = runs["as stated"]
    assert stated.failed is None
    assert rises(stated.position_error) == 0
    assert rises(stated.speed_error) == 0
    assert stated.position_error[-1] < 0.5 * stated.position_error[0]
    assert stated.difference[-1] < stated.difference[0]
    assert stated.speed_error[-1] > 0.01
    assert outcome(stated) == "falls"


def test_traction_comes_from_motor_cars_alone_and_all_cars_brake(runs):
    stated = runs["as stated"]
    assert stated.of_cars("force_max")[:, 1::2].max() == 0
    assert stated.of_cars("force_max")[:, ::2].min() > 0
    assert stated.of_cars("force_min").max() < 0


def test_the_energy_function_falls_as_the_proof_says(runs, short):
    stated = runs["as stated"]
    assert (cef_change(stated) <= allowed_change(short, stated)).all()
    assert first_cef(short) + cef_change(stated).sum() > 0


def test_the_auxiliary_state_is_bounded_by_the_saturation_as_the_corrected_claim_says(runs, short):
    bound = float(law.any_gains.subs({g: getattr(short.gains, str(g)) for g in law.gains}))
    for name in ("as stated", "slopes where the car is"):
        ratio = runs[name].total("lambda_square_s") / runs[name].total("difference_square_s")
        assert (ratio > 0).all()
        assert (ratio <= bound).all()


def test_the_repaired_c_1_starts_with_far_smaller_position_errors(runs):
    repaired = runs["c_1 = 1, acceleration of the sample before"]
    assert repaired.failed is None
    assert repaired.position_error[0] < 0.2 * runs["as stated"].position_error[0]


def test_a_smaller_c_3_starts_better_and_learns_less(runs):
    smaller, stated = runs["c_3 = 1/100, room of 100 kg for the estimate of the mass"], runs["as stated"]
    assert smaller.position_error[0] < stated.position_error[0]
    left = [run.position_error[-1] / run.position_error[0] for run in (smaller, stated)]
    assert left[0] > left[1]


def test_slopes_that_are_met_where_the_train_is_are_learned_too(runs):
    for name in ("slopes as a function of time", "slopes where the car is"):
        assert runs[name].failed is None
        assert runs[name].position_error[-1] < runs[name].position_error[0]


# --- what it depends on ---------------------------------------------------------------------------------------------


def alternating(study, speed_mps, answered):
    """How an error that alternates grows in a trip, by (9) and (18) of one saturated car alone, sample by sample."""
    g, T = study.gains, study.sampling.period_s
    q = math.exp(-g.c_2 * T)
    held = (1 - q) / g.c_2 * g.c_3
    answer = g.c_3 * (g.gamma_v * speed_mps**2 + g.gamma_a * speed_mps**4 + g.gamma_eta)
    samples = 4000
    learned = np.array([(-1.0) ** k for k in range(samples)])
    sizes = []
    for _ in range(2):
        z, following = 0.0, learned.copy()
        trace = []
        for k in range(samples):
            row = k - 1 if answered else k
            if row >= 0:
                following[row] += answer * z
            trace.append(z)
            z = q * z - held * (learned[k] + answer * z)  # z_2 = -lambda_2 but for what does not alternate
        sizes.append(abs(trace[samples // 2]))
        learned = following
    return sizes[1] / sizes[0]


@pytest.mark.parametrize("speed_mps", [40.0, 70.0, 83.5])
def test_errors_that_alternate_grow_as_the_study_says(study, speed_mps):
    same, following = alternating_growth(study, speed_mps)
    assert alternating(study, speed_mps, answered=False) == pytest.approx(same, rel=1e-6)
    assert alternating(study, speed_mps, answered=True) == pytest.approx(following, rel=1e-6)


def test_sampled_errors_of_the_same_sample_break_the_energy_function_that_those_of_the_next_keep(short):
    """At half the speed of sampling the printed rules learn; at a quarter they do not."""
    coarse = changed(short, trials__count=7, trials__shown=(1, 7), sampling__acceleration="sampled",
                     gains__gamma_a=0.03)
    same = run_cars(plan(changed(coarse, sampling__memory="same_sample")))
    fine = run_cars(plan(changed(coarse, sampling__memory="same_sample", sampling__period_s=0.00025)))
    assert same.failed is not None or grows_from(same.difference) is not None
    assert grows_from(fine.difference) is None
    assert fine.failed is None


def test_an_estimate_above_the_singular_one_ends_the_run_and_says_where(runs):
    failed = runs["50.03 to 55 t: the lower bound 30 kg above the mass"].failed
    assert failed is not None
    assert "trial 1, t = 0.000 s, car 1: the acceleration is not unique" in failed
    assert "exceeds the mass by 30 kg, 1/c_3 is 25 kg" in failed


def test_a_command_that_runs_away_ends_the_run_and_says_where(study):
    made = plan(changed(study, trials__count=3, reference__trip_time_s=700.0, trials__shown=(1,)))
    wild = replace(made, reference=made.reference[:4000], values=dict(made.values) | {"gamma_eta": 1e12})
    done = run_cars(wild)
    assert done.failed is not None
    assert "the command diverged: mu = " in done.failed
    assert "trial 1, t = " in done.failed
    assert np.isfinite(done.totals).all()


def test_the_reference_asks_for_what_the_motors_can_give(study):
    ref, train = study.reference, study.train
    # By hand: 300 t with 0.2 m/s^2, rolling and air at 83.5 m/s.
    need = 3e5 * 0.2 + 3e5 * (0.00775 + 0.000228 * 83.5) + 3e5 * 1.66e-5 * 83.5**2
    assert needed_force(study, ref.cruise_mps, ref.acceleration_mps2) == pytest.approx(need, rel=1e-12)
    assert need < 3 * train.traction_n
    assert needed_force(study, 0.0, -ref.braking_mps2) > -6 * train.braking_n


def test_memory_grows_as_the_number_of_cars(study):
    sizes = [run_cars(plan(changed(study, train__cars=n, reference__trip_time_s=700.0, trials__count=1,
                                   trials__shown=(1,), sampling__period_s=0.01))).memory_bytes for n in (6, 32)]
    assert sizes == [8 * 70_000 * (3 * n + 3) for n in (6, 32)]


# --- the study ------------------------------------------------------------------------------------------------------


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


def test_every_value_says_where_it_comes_from_and_what_is_assumed(study):
    kinds = {value.key: value.kind for value in sourced_values(study)}
    assert kinds["gains.c_1"] == kinds["train.car_mass_kg"] == "paper"
    assert kinds["reference.acceleration_mps2"] == kinds["mass_bounds.low_kg"] == "assumed"
    assert kinds["sampling.acceleration"] == kinds["trials.lambda_1_m"] == "assumed"


MISTAKES = [
    ("train.car_mass_kg", 50.0, "train.car_mass_kg"),
    ("train.traction_n", 40.0, "train.traction_n"),
    ("train.motor_pattern", "1x0", "train.motor_pattern"),
    ("train.cars", 1, "train.cars"),
    ("mass_bounds.low_kg", 60000.0, "low_kg = 60000 is above high_kg = 50000: swap them"),
    ("reference.acceleration_mps2", 0.05, "allow more trip_time_s"),
    ("reference.trip_time_s", 1000.0004, "not a whole number of samples"),
    ("sampling.log_every_s", 0.0015, "sampling.log_every_s = 0.0015 is not a whole number of samples"),
    ("sampling.period_s", 0.00001, "GB: sample more coarsely or shorten the trip"),
    ("sampling.acceleration", "guessed", "sampling.acceleration"),
    ("trials.shown", [31], "shown names trial 31, but the last one is 30"),
    ("line.slope_permille", 500.0, "line.slope_permille"),
    ("gains.c_3", 0.0, "gains.c_3"),
    ("cost.end_s", 5000.0, "cost.end_s is beyond reference.trip_time_s"),
]


@pytest.mark.parametrize(("key", "value", "message"), MISTAKES, ids=[key for key, _, _ in MISTAKES])
def test_a_mistake_names_file_key_and_remedy(study, key, value, message):
    data = study.model_dump(exclude_unset=True)
    table, name = key.split(".")
    data[table] = {**data[table], name: value}
    with pytest.raises(InputError) as caught:
        validate_record(data, ChenStudy, "chen2019.toml")
    assert message in str(caught.value)
    assert str(caught.value).startswith("chen2019.toml: ")


def test_a_change_of_what_is_not_stated_ends_with_exit_code_2(tmp_path, capsys, monkeypatch):
    path = tmp_path / "chen2019" / "study.toml"
    shutil.copytree(FOLDER, path.parent, ignore=shutil.ignore_patterns("certificates", "__pycache__"))
    path.write_text(path.read_text(encoding="utf-8").replace('set = { "gains.gamma_a" = 0.005 }',
                                                             'set = { "gains.gamma_b" = 0.005 }'), encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["workbench", "compare", str(path)])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "changes: 'gamma_a a quarter': gains.gamma_b: no such key" in said


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

"""chen2019's compiled trips against plain vectors, side by side, sampled finer, and where they end."""

from dataclasses import replace

import numpy as np
import plain_cars
import pytest
import sympy as sp
from chen2019_studies import changed

from proofs.chen2019.simulation import cars_runs
from proofs.chen2019.simulation.cars_runs import LANES, run_cars, run_together
from proofs.chen2019.simulation.plans import plan
from proofs.chen2019.study.runs import groups
from workbench.compile.kernel import cars_source
from workbench.errors import CompileError
from workbench.paper.reproduced import STATED, RunCase, stated_and_changed
from workbench.trains import multi_particle as of_train


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


@pytest.mark.parametrize("worth", [cars_runs.WORTH_ALONE, 0])
def test_runs_side_by_side_have_the_bits_of_each_alone(study, worth, monkeypatch):
    """One fails, one goes on from another, one waits for a lane, one cannot share the others' loop, and one is left."""
    monkeypatch.setattr(cars_runs, "WORTH_ALONE", worth)
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
    found = groups(study, stated_and_changed(study))
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


def test_a_command_that_runs_away_ends_the_run_and_says_where(study):
    made = plan(changed(study, trials__count=3, reference__trip_time_s=700.0, trials__shown=(1,)))
    wild = replace(made, reference=made.reference[:4000], values=dict(made.values) | {"gamma_eta": 1e12})
    done = run_cars(wild)
    assert done.failed is not None
    assert "the command diverged: mu = " in done.failed
    assert "trial 1, t = " in done.failed
    assert np.isfinite(done.totals).all()


def test_memory_grows_as_the_number_of_cars(study):
    sizes = [run_cars(plan(changed(study, train__cars=n, reference__trip_time_s=700.0, trials__count=1,
                                   trials__shown=(1,), sampling__period_s=0.01))).memory_bytes for n in (6, 32)]
    assert sizes == [8 * 70_000 * (3 * n + 3) for n in (6, 32)]

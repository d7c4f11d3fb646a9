"""Pareto fronts: of runs whose costs are known the known front; no point beaten, evaluations shared, all kept."""

import math
from dataclasses import replace

import numpy as np
import pytest
from contests import few, only
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.contest import pareto as module
from workbench.contest.pareto import Point, all_fronts, efficient, front_plots, front_tables, fronts_of, who
from workbench.contest.record import Contest, Pareto
from workbench.contest.tune import DRAWS_FROM
from workbench.errors import InputError
from workbench.trains.scenario import Scenario


@pytest.fixture
def small(contest: Contest) -> Contest:
    of = few(contest, "ten")
    ranges = {**of.tuning.ranges, "pid": {"K_p": (0.075, 7.5), "K_i": (0.0125, 1.25), "K_d": (0.15, 15.0)}}
    return of.model_copy(update={"pareto": Pareto(condition="ten", weights=12, evaluations=10),
                                 "tuning": of.tuning.model_copy(update={"ranges": ranges})})


@pytest.fixture
def scenario(contest: Contest) -> Scenario:
    return only(contest.world, "pid")


@pytest.fixture
def known(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Runs in which a gain K trades the error 1/K against energy and comfort of K; who is too fast comes late."""
    draws: list[int] = []

    def run(changed: Scenario, name: str, condition: object, draw: int, seed: int) -> dict[str, float]:
        draws.append(draw)
        return changed.controllers[name].parameters

    def values(gains: dict[str, float], changed: Scenario) -> dict[str, float]:
        k, off = gains["K_p"], abs(math.log(gains["K_d"]))
        return {"position_rms": 1 / k + off, "energy_J": 100 + k + off, "comfort_rms": k**2 + off,
                "late_s": 0.0 if k < 6 else 5.0, "stopping_error": 0.0}

    monkeypatch.setattr(module, "run_match", run)
    monkeypatch.setattr(module, "match_values", values)
    return draws


def test_the_front_of_a_known_trade_is_found_and_driven_again_on_the_contests_draws(
        small: Contest, scenario: Scenario, known: list[int]) -> None:
    energy, comfort = fronts_of(small, scenario, "pid")
    assert (energy.against, comfort.against) == ("energy_J", "comfort_rms")
    for front in (energy, comfort):
        gains = [1 / point.position_rms for point in front.points]
        assert len(gains) >= 6
        assert 4.5 < max(gains) < 6.0, "the end that tracks best, short of coming late"
        assert min(gains) < 1.0
        for point in front.points:  # near the known front, on which K_d is one
            assert abs(math.log(point.parameters["K_d"])) < 0.4
    tuning, again = ([draw for draw in known if (draw >= DRAWS_FROM) == of] for of in (True, False))
    assert len(tuning) == energy.evaluations <= 2 * 16 * 10, "evaluations are not shared"
    assert set(again) == {0} and len(again) <= 2 * 12
    assert fronts_of(small, scenario, "pid") == (energy, comfort)
    tables, plots = list(front_tables(small, [energy, comfort])), list(front_plots(small, [energy, comfort]))
    assert [len(table.rows) for table in tables] == [len(front.points) for front in (energy, comfort)]
    assert plots[0].curves[0].y.tolist() == pytest.approx([point.energy_J / 3.6e6 for point in energy.points])


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 8), st.integers(0, 8)), min_size=1, max_size=25))
def test_no_point_of_a_front_is_beaten_and_every_other_is(pairs: list[tuple[int, int]]) -> None:
    points = [Point({"k": float(i)}, float(x), float(y), 0.0, 0.0) for i, (x, y) in enumerate(pairs)]
    front = efficient(points, "energy_J")

    def beats(a: Point, b: Point) -> bool:
        return (a.position_rms <= b.position_rms and a.energy_J <= b.energy_J and
                (a.position_rms, a.energy_J) != (b.position_rms, b.energy_J))

    assert not any(beats(a, b) for a in points for b in front)
    assert all(any(beats(a, b) or (a.position_rms, a.energy_J) == (b.position_rms, b.energy_J) for a in front)
               for b in points)


def test_fronts_are_kept_and_the_same_with_another_number_of_processes(
        small: Contest, scenario: Scenario, known: list[int], tmp_path) -> None:
    first = all_fronts(small, scenario, 1, lambda *_: None, tmp_path, False, "digest")
    count = len(known)
    counted: list[tuple[int, int]] = []
    assert all_fronts(small, scenario, 1, lambda done, total, _: counted.append((done, total)), tmp_path, True,
                      "digest") == first
    assert counted == [(1, 1)], "what an earlier run has finished counts as done, when it begins"
    assert len(known) == count, "what is kept is searched again"
    with pytest.raises(InputError, match="digest of values"):
        all_fronts(small, scenario, 1, lambda *_: None, tmp_path, True, "another")
    assert all_fronts(small.model_copy(update={"pareto": None}), scenario, 1, lambda *_: None) == ()


def test_who_has_no_ranges_or_no_curve_has_no_front(contest: Contest, small: Contest) -> None:
    for name, words in (("nobody", "no controller with ranges"), ("mpc_economic", "follows no curve")):
        asked = small.model_copy(update={"pareto": Pareto(condition="ten", controllers=(name,))})
        with pytest.raises(InputError, match=words):
            who(asked, contest.world)
    assert "mpc_economic" not in who(small, contest.world)


def test_a_real_run_is_a_point(small: Contest, scenario: Scenario) -> None:
    few_ = small.model_copy(update={"pareto": Pareto(condition="ten", weights=2, evaluations=2)})
    for front in fronts_of(few_, scenario, "pid"):
        assert front.points and all(0 < one.position_rms < 1 and one.late_s < 1 for one in front.points)
        assert np.isfinite([one.energy_J for one in front.points]).all() and replace(front) == front

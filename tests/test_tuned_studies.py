"""Law and MPC tuned alike in the papers' own scenarios, and paired on the same drawn trains."""

from __future__ import annotations

import math
import re
import shutil
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import changed, refusal
from scenarios import PAPERS, PROOFS, SHARED

from workbench.cli.loading import load
from workbench.contest.record import Contest
from workbench.errors import InputError
from workbench.files.folders import held_in
from workbench.files.modules import module_in
from workbench.paper.drivers import Drivers, entries, tune_with
from workbench.paper.mpc_comparison import FOLLOWS_MPS, best_words
from workbench.paper.pairs import compared_pairs, factors_of, pair_findings, pair_stage, pair_table, pairs_of
from workbench.paper.parameter_search import Finished, binding, score, search
from workbench.paper.results import ResultTable
from workbench.paper.stages import run_stages
from workbench.paper.study import StudyKind, varied
from workbench.paper.tune import BEGIN, tune_run
from workbench.paper.winners import winners_table
from workbench.simulate.closed_loop import NOMINAL, Factors

# Short enough for a test: each paper's train over the first part of what its file states.
SHORT: dict[str, dict[str, Any]] = {
    "chen2019": {"train.cars": 2, "reference.cruise_mps": 5.0, "reference.acceleration_mps2": 0.15,
                 "reference.trip_time_s": 60.0, "trials.count": 3, "trials.shown": [3]},
    "jiao2025": {"trials.count": 3, "trials.compared": [1], "trials.line_shown": []},
    "liu2020": {"line.length_m": 12000.0, "line.sections": [], "reference.cruise_mps": 30.0},
    "mao2018": {"horizon.end_s": 30.0, "sampling.end_s": 30.0},
}
STUDIES = [paper for paper in PAPERS if held_in(PROOFS / paper, "study", StudyKind)]
DRIVERS: dict[str, Drivers] = {paper: module_in(PROOFS / paper, "study.comparison").DRIVERS for paper in STUDIES}


@cache
def study(name: str) -> Any:
    return load(PROOFS / name).study


def short(name: str) -> Any:
    return varied(study(name), SHORT[name], "test")


def place_of(name: str) -> str:
    return str(study(name).tuning.places[0])


def test_every_paper_that_has_a_study_is_tuned_here() -> None:
    assert sorted(DRIVERS) == STUDIES == sorted(SHORT)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.floats(0.02, 50.0), min_size=1, max_size=3), st.integers(1, 60), st.integers(0, 5))
def test_the_search_keeps_budget_and_ranges_and_never_makes_worse(best: list[float], runs: int, seed: int) -> None:
    ranges = {f"p{i}": (0.01, 100.0) for i in range(len(best))}
    stated = {**dict.fromkeys(ranges, 1.0), "p0": 0.0}  # a stated zero is taken as the lower end
    tried: list[dict[str, float]] = []

    def cost(values: dict[str, float]) -> float:
        tried.append(values)
        return sum((math.log(values[f"p{i}"]) - math.log(target)) ** 2 for i, target in enumerate(best))

    found = search(cost, stated, ranges, runs, seed)
    assert len(tried) == runs == found.evaluations and tried[0]["p0"] == 0.01
    assert all(0.01 <= value <= 100.0 for values in tried for value in values.values())
    assert found.cost == min(map(cost, list(tried))) == cost(found.values) <= found.stated
    numbers, costs = zip(*found.improvements, strict=True)
    assert numbers[0] == 1 and costs[0] == found.stated and costs[-1] == found.cost
    assert list(numbers) == sorted(set(numbers)) and list(costs) == sorted(set(costs), reverse=True)
    assert search(cost, stated, ranges, runs, seed) == found


def test_the_search_finds_a_known_minimum() -> None:
    found = search(lambda v: math.log(v["a"] / 3) ** 2 + math.log(v["b"] / 0.2) ** 2, {"a": 1.0, "b": 1.0},
                   {"a": (0.1, 10.0), "b": (0.1, 10.0)}, 200, 1)
    assert found.cost < 1e-5 and found.values == pytest.approx({"a": 3.0, "b": 0.2}, rel=0.01)


def test_a_range_of_whole_numbers_holds_whole_numbers_alone_and_one_parameter_will_do() -> None:
    tried: list[dict[str, float]] = []

    def cost(values: dict[str, float]) -> float:
        tried.append(values)
        return math.log(values["n"] / 17) ** 2 + math.log(values.get("a", 3.0) / 3) ** 2

    assert search(cost, {"n": 4.0, "a": 1.0}, {"n": (2, 64), "a": (0.1, 10.0)}, 100, 1).values["n"] == 17
    assert all(values["n"] == int(values["n"]) for values in tried)
    assert search(cost, {"n": 4.0}, {"n": (2.0, 64.0)}, 60, 1).values["n"] == pytest.approx(17, rel=0.05)


def test_restarts_differ_the_best_counts_and_workers_change_nothing() -> None:
    of: Any = study("jiao2025")
    budget = of.tuning.model_copy(update={"runs": 36, "restarts": 3, "set": SHORT["jiao2025"]})
    short_of = of.model_copy(update={"tuning": budget})
    tune = tune_with(DRIVERS["jiao2025"])
    kept: dict[Any, Any] = {}
    alone = tune(short_of, ["pd"], 1, lambda *_: None, Finished({}, kept.__setitem__))
    assert alone == tune(short_of, ["pd"], 2, lambda *_: None)
    assert len(kept) == 3 and alone["pd"].cost == min(one.cost for one in kept.values())
    assert len({one.improvements for one in kept.values()}) > 1, "restarts are the same search"
    assert {one.stated for one in kept.values()} == {alone["pd"].stated}, "each begins with what is stated"
    seen: list[str] = []
    two = {task: kept[task] for task in [("pd", 0), ("pd", 2)]}
    assert tune(short_of, ["pd"], 1, lambda *_: None, Finished(two, lambda task, _: seen.append(task))) == alone
    assert seen == [("pd", 1)]


@pytest.mark.parametrize(("value", "end"), [(0.1, "low"), (0.104, "low"), (0.11, ""), (1.0, ""), (9.6, "high"),
                                            (10.0, "high")])
def test_an_end_binds_within_a_hundredth_of_the_range(value: float, end: str) -> None:
    assert binding(value, (0.1, 10.0)) == end


def test_a_score_is_the_sum_over_the_units_and_a_failure_costs_each_of_them() -> None:
    units = {"position_rms": 0.1, "jerk_rms": 0.5}
    assert score({"position_rms": 0.2, "jerk_rms": 1.0}, units, 100.0) == pytest.approx(4.0)
    assert score({"position_rms": None, "jerk_rms": 1e9}, units, 100.0) == 200.0


@pytest.mark.parametrize("name", STUDIES)
def test_law_and_mpc_have_one_budget_ranges_around_what_is_stated_and_something_found(name: str) -> None:
    of, drivers = study(name), DRIVERS[name]
    tuning = of.tuning
    assert set(tuning.ranges) == set(drivers.titles) == set(tuning.found), "somebody who drives is not tuned"
    for controller, ranges in tuning.ranges.items():
        stated = drivers.parameters(of, controller)
        for key, (low, high) in ranges.items():
            assert low <= stated[key] <= high or stated[key] == 0.0, f"{controller}.{key}"
            assert low * 0.999 <= tuning.found[controller][key] <= high * 1.001
        # No dead key: what was found arrives where the controller's parameters are read.
        assert drivers.parameters(drivers.tuned(of, controller), controller).items() >= tuning.found[controller].items()
    assert load(PROOFS / name).kind.tune is not None
    assert of.pairs.draws >= 10 and not isinstance(of, Contest)
    common = load(SHARED / "common.toml").study
    assert isinstance(common, Contest)
    for unit, value in tuning.objective.units.items():  # the same unit of jerk, there of every plant step
        assert value == {"position_rms": common.tuning.objective.position_m,
                         "speed_rms": common.tuning.objective.speed_mps,
                         "logged_jerk_rms": common.tuning.objective.ride_jerk_mps3}[unit], "not the common objective"


@pytest.mark.parametrize("name", STUDIES)
def test_what_was_found_is_no_worse_than_what_is_stated_in_the_tunings_own_runs(name: str) -> None:
    drivers, tuning = DRIVERS[name], study(name).tuning
    of, goal = varied(study(name), tuning.set, "tuning.set"), tuning.objective
    for controller in drivers.titles:
        costs = [0.0, 0.0]
        for state, driven in enumerate((of, drivers.tuned(of, controller))):
            for place in tuning.places:
                row = drivers.drive(driven, controller, place, NOMINAL)
                assert row["failed"] is None, f"{controller}: {row['failed']}"
                costs[state] += score(row, goal.units, goal.failed)
        assert costs[1] <= costs[0], f"{controller}: {costs}"


@pytest.mark.parametrize("name", STUDIES)
def test_a_drawn_train_changes_the_run_and_the_nominal_one_does_not(name: str) -> None:
    of, drivers, place = short(name), DRIVERS[name], place_of(name)
    for controller in drivers.titles:
        plain, same, other = (drivers.drive(of, controller, place, factors)["speed_rms"] for factors in (
            NOMINAL, Factors(), Factors(1.08, 1.1, 1.1, 1.1)))
        assert plain == same != other


def rows_of(position: Any, speed: Any, jerk: Any, failed: int = 0, trials: Any = None) -> list[dict[str, Any]]:
    rows = [{"failed": None, "position_rms": float(p), "speed_rms": float(v), "jerk_rms": float(j)}
            for p, v, j in zip(position, speed, jerk, strict=True)]
    for i, row in enumerate(rows):
        if trials is not None:
            row["trials"] = {"speed_rms": trials[i]}
        if i < failed:
            rows[i] = {"failed": "diverged"}
    return rows


def liu_pairs(law: list[dict[str, Any]], rival: list[dict[str, Any]]) -> Any:
    of = study("liu2020")
    few = of.model_copy(update={"pairs": of.pairs.model_copy(update={"draws": len(law)})})
    return few, pairs_of(few, {("fast", "corrected", False): law, ("fast", "mpc_linear", False): rival})[0]


def test_a_difference_inside_its_interval_is_no_win() -> None:
    draw = np.random.default_rng(3)
    common, n = draw.uniform(0.1, 0.5, 40), 40
    _, pair = liu_pairs(rows_of(common + 0.01, common + draw.normal(0, 1e-3, n), common),
                        rows_of(common, common, common + 0.01))
    assert [pair.winner(metric) for metric in pair.differences] == ["mpc_linear", None, "corrected"]
    position = pair.differences["position_rms"]
    assert position.low == pytest.approx(0.01) == position.high, "paired: what both share has no width"
    speed = pair.differences["speed_rms"]
    half = 1.96 * 1e-3 / math.sqrt(n)
    assert speed.high - speed.low == pytest.approx(2 * half, rel=0.35)


def test_who_fails_or_stands_still_wins_nothing() -> None:
    fine, lost = np.full(12, 0.2), np.full(12, FOLLOWS_MPS * 20)
    few, pair = liu_pairs(rows_of(fine, fine, fine, failed=3), rows_of(fine + 1, fine, fine + 1))
    assert {pair.winner(metric) for metric in pair.differences} == {"mpc_linear"} and pair.failed == (3, 0)
    table = next(pair_table(few, DRIVERS["liu2020"], [pair]))
    assert "−1.00 [−1.00, −1.00]; " in table.text[0][4], "over the nine trains on which both arrive"
    assert table.values[0][4][2:] == pytest.approx([-1.0, -1.0, -1.0]) and table.columns[4].unit == "m"
    assert table.text[0][4].endswith("fails in 3 of 12: linear MPC")
    few, none = liu_pairs(rows_of(fine, fine, fine, failed=11), rows_of(fine + 1, fine, fine + 1))
    assert set(none.differences.values()) == {None} and none.winner("jerk_rms") == "mpc_linear"
    assert next(pair_table(few, DRIVERS["liu2020"], [none])).text[0][4].endswith(
        "fails in 11 of 12: linear MPC")
    _, both = liu_pairs(rows_of(fine, fine, fine, failed=3), rows_of(fine, fine, fine, failed=1))
    assert {both.winner(metric) for metric in both.differences} == {None}
    few, still = liu_pairs(rows_of(lost, lost, 0 * fine), rows_of(fine, fine, fine))
    assert still.winner("jerk_rms") == "mpc_linear"
    assert "does not follow" in next(pair_table(few, DRIVERS["liu2020"], [still])).text[0][-1]
    assert "beats" not in next(pair_findings(few, DRIVERS["liu2020"], [still]))
    rows: list[tuple[str, Mapping[str, Any]]] = [
        ("still", {"failed": None, "speed_rms": 20.0, "jerk_rms": 0.0, "position_rms": 9.0}),
        ("good", {"failed": None, "speed_rms": 0.1, "jerk_rms": 0.2, "position_rms": 0.1})]
    assert best_words(rows, "jerk_rms", "jerk", "m/s³").startswith("good")


def test_the_winner_of_the_drawn_trains_has_the_least_error_and_its_price_is_told() -> None:
    of, drivers = study("liu2020"), DRIVERS["liu2020"]
    few = of.model_copy(update={"pairs": of.pairs.model_copy(update={"draws": 12})})
    draw, results = np.random.default_rng(5), {}
    near, share = draw.normal(0, 1e-3, 12), draw.uniform(0.1, 0.5, 12)
    errors = {"corrected": share + 0.2, "position_only": share + 0.1, "mpc_linear": share + 0.1 + near,
              "mpc_offset_free": share + 0.4}
    for name, tuned in entries(few, drivers):
        rows = rows_of(errors[name], share, share, failed=1 if tuned or name == "corrected" else 0)
        results |= {(i, "fast", name, tuned): row | {"step_us_median": 2.0 + i, "energy_J": 3.6e6 * (4 + i)}
                    for i, row in enumerate(rows)}
    table = winners_table(few, drivers, compared_pairs(drivers, few, results), results)
    assert table is not None
    (condition, winner, mean, _, step_s, energy), nobody = table.rows
    assert condition.endswith("as stated")
    best = "position_only" if errors["position_only"].mean() < errors["mpc_linear"].mean() else "mpc_linear"
    assert (winner, mean) == (f"{drivers.titles[best]}, not alone", pytest.approx(errors[best].mean()))
    assert (step_s, energy) == (pytest.approx(7.5e-6), pytest.approx(3.6e6 * 9.5))
    second, third, last = table.text[0][3].split("; ")
    assert second.endswith(" (not told apart)")
    assert third.startswith(drivers.titles["mpc_offset_free"])
    assert last == f"{drivers.titles['corrected']} fails in 1 of 12"
    assert nobody[1] == "nobody" and table.text[1][3].count("fails in 1 of 12") == 4
    assert winners_table(few, drivers, (), {}) is None


def test_draws_depend_on_seed_and_number_alone() -> None:
    pairs = study("mao2018").pairs
    fewer = pairs.model_copy(update={"draws": 2})
    drawn = [factors_of(pairs, i) for i in range(200)]
    assert [factors_of(fewer, i) for i in range(2)] == drawn[:2] and len(set(drawn)) == 200
    for key in ("mass", "davis_a", "davis_b", "davis_c"):
        values = np.array([getattr(one, key) for one in drawn])
        assert 0.9 <= values.min() < 0.92 and 1.08 < values.max() <= 1.1 and abs(values.mean() - 1) < 0.02


def test_pairs_are_the_same_with_any_number_of_processes_and_become_a_table() -> None:
    of = study("jiao2025")
    few = of.model_copy(update={"pairs": of.pairs.model_copy(update={"draws": 2, "set": SHORT["jiao2025"]})})
    drivers = DRIVERS["jiao2025"]
    (one,), (two,) = (run_stages((pair_stage(drivers, few),), workers, lambda *_: None) for workers in (1, 2))
    assert list(one) == [(draw, "N", *entry) for draw in range(2) for entry in entries(few, drivers)] == list(two)
    plain = [[row[m] for m in ("speed_rms", "jerk_rms")] for row in one.values()]
    assert plain == [[row[m] for m in ("speed_rms", "jerk_rms")] for row in two.values()]
    pairs = compared_pairs(drivers, few, one)
    assert len(pairs) == 2 * 2 * 2  # laws, kinds of MPC, stated and tuned
    table = next(pair_table(few, drivers, pairs))
    assert isinstance(table, ResultTable) and {row[3] for row in table.rows} == {"as stated", "tuned"}
    assert len(list(pair_findings(few, drivers, pairs))) == 2


def test_learners_are_ahead_from_the_trial_after_which_none_is_worse() -> None:
    fine = np.full(20, 0.2)
    errors = np.linspace(1.0, 0.0, 11)[None, :] + np.random.default_rng(1).normal(0, 1e-3, (20, 11))
    of = study("jiao2025")
    few = of.model_copy(update={"pairs": of.pairs.model_copy(update={"draws": 20})})
    pair = pairs_of(few, {("N", "pd", True): rows_of(fine, errors[:, -1], fine, trials=errors),
                          ("N", "mpc_linear", True): rows_of(fine, np.full(20, 0.55), fine)})[0]
    assert pair.overtakes == {"speed_rms": 6}  # 0.5 is the sixth, the first below
    (counted,) = pairs_of(few, {("N", "pd", True): rows_of(fine, errors[:, -1], fine, trials=errors),
                                ("N", "mpc_linear", True): rows_of(fine, np.full(20, 0.55), fine)}, first_trial=0)
    assert counted.overtakes == {"speed_rms": 5} and DRIVERS["jiao2025"].first_trial == 0


def test_studies_without_tuning_or_mpc_tell_nothing_of_it() -> None:
    for name, drivers in DRIVERS.items():
        for missing in ("tuning", "mpc"):
            bare = study(name).model_copy(update={missing: None, "pairs": None})
            assert entries(bare, drivers) == () and not pair_stage(drivers, bare).tasks
            assert compared_pairs(drivers, bare, {}) == ()


TEXT = (PROOFS / "jiao2025" / "study.toml").read_text(encoding="utf-8").partition(BEGIN)[0]


@pytest.fixture(scope="module")
def copied(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of jiao2025's folder, for tests to write other files into."""
    folder = tmp_path_factory.mktemp("copied") / "jiao2025"
    shutil.copytree(PROOFS / "jiao2025", folder, ignore=shutil.ignore_patterns("certificates", "__pycache__", "claims"))
    return folder


def test_tuning_a_study_repeats_itself_and_is_written(copied: Path) -> None:
    path = copied / "study.toml"
    path.write_text(TEXT.replace("runs = 300", "runs = 8"), encoding="utf-8")
    of: Any = load(copied).study
    names = ["pd", "icfdl"]
    tune = tune_with(DRIVERS["jiao2025"])
    alone, apart = (tune(of, names, workers, lambda *_: None) for workers in (1, 2))
    assert alone == apart and list(alone) == names
    assert all(found.cost <= found.stated for found in alone.values())
    lines = list(tune_run(load(copied), names, True, 1, lambda *_: None))
    assert lines[-1] == f"written: {path}" and len(lines) == 3
    again: Any = load(copied).study
    assert {name: found.values for name, found in alone.items()} == again.tuning.found
    for name, result in again.tuning.results.items():
        assert (result.cost, result.stated_cost) == (alone[name].cost, alone[name].stated)
        assert result.improvements == alone[name].improvements
    assert [entry for entry in entries(again, DRIVERS["jiao2025"]) if entry[1]] == [("icfdl", True), ("pd", True)]


@pytest.mark.parametrize(("before", "after", "message"), [
    ("[tuning.ranges.pd]", "[tuning.ranges.pid]", "tuning.ranges.pid: is no controller of the study"),
    ("K_p = [0.0446, 446000.0]", "K_q = [0.0446, 446000.0]", "K_q: is no parameter"),
    ("K_p = [0.0446, 446000.0]", "K_p = [2.0, 1.0]", "is no range"),
    ('places = ["N"]', 'places = ["M"]', "tuning.places: 'M' is none"),
    ("set = {}", 'set = { "trials.counts" = 3 }', "tuning.set: trials.counts: no such key"),
    ("set = {}", 'set = { "trials.count" = 0 }', "tuning.set: trials.count"),
    ("draws = 100", "draws = 1", "pairs.draws"),
    ("spread = 0.1", "spread = 1.5", "pairs.spread"),
    ("speed_mps = 0.1", "speed_mps = -0.1", "tuning.objective.speed_mps")])
def test_mistakes_are_one_line(copied: Path, before: str, after: str, message: str) -> None:
    path = copied / "study.toml"
    path.write_text(changed(TEXT, before, after), encoding="utf-8")
    said = refusal(load, copied)
    assert message in said and str(path) in said


def test_pairs_need_tuning_and_tuning_its_table(copied: Path) -> None:
    path, without = copied / "study.toml", TEXT[: TEXT.index("[tuning]")]
    path.write_text(without + TEXT[TEXT.index("[pairs]"):], encoding="utf-8")
    assert "pairs: needs the tables [mpc] and [tuning]" in refusal(load, copied)
    path.write_text(without, encoding="utf-8")
    for folder, names, message in ((copied, [], "tuning: is missing"),
                                   (PROOFS / "jiao2025", ["nobody"], "tuning.ranges.nobody: is missing")):
        with pytest.raises(InputError, match=re.escape(message)):
            list(tune_run(load(folder), names, False, 1, lambda *_: None))

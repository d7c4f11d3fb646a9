"""Fair fights: the same draws for all, honest winners, one budget for tuning, the same bytes for the same seed."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contests import COMMON, few, only, without_actuator
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import SHARED

from workbench.cli.loading import load
from workbench.contest.energy import best_run
from workbench.contest.matches import METRICS, Entry, Match, all_matches, entries, looks, match_values, run_match
from workbench.contest.record import Contest, Racing
from workbench.contest.study import KIND, undecided
from workbench.contest.tables import condition_table
from workbench.contest.told import Told, look
from workbench.contest.tune import DRAWS_FROM, tune_all
from workbench.errors import InputError, WorkbenchError
from workbench.files.numbers import length, number
from workbench.paper.cells import Phrase, numbers_in
from workbench.paper.statistics import Bootstrap, rankings
from workbench.paper.tune import BEGIN, tune_run
from workbench.trains.scenario import Scenario

QUICK = ("pid", "pocrac", "mpc_linear")


@pytest.fixture(scope="module")
def scenario(contest: Contest) -> Scenario:
    return only(contest.world, *QUICK)


def test_every_controller_meets_the_same_train_and_noise(contest: Contest, scenario: Scenario) -> None:
    condition = contest.conditions["thirty"].model_copy(update={"position_noise_m": 0.01})
    level = condition.model_copy(update={"level": True})
    one, same = (run_match(scenario, "pid", condition, 3, contest.seed) for _ in range(2))
    assert one.log.tobytes() == same.log.tobytes()
    other = run_match(scenario, "pid", condition, 4, contest.seed)
    assert not np.array_equal(one.log, other.log)
    # The same train, whoever commands it: on the level its mass can be told from force, speed and its change.
    masses = []
    for name in ("pid", "mpc_linear"):
        run = run_match(scenario, name, level, 3, contest.seed)
        t, v, u = (run.column(key)[20:3800] for key in ("t_s", "v_mps", "u_applied_mps2"))
        known = np.column_stack((np.gradient(v, t), np.ones_like(v), v, v**2, np.sin(2 * np.pi * t / 40.0)))
        masses.append(float(np.linalg.lstsq(known[5:-5], u[5:-5], rcond=None)[0][0]))
    assert masses[0] == pytest.approx(masses[1], rel=0.02)
    assert abs(masses[0] - 1) > 0.05, "draw 3 is expected to be a train of another mass"


def test_conditions_do_what_they_say(contest: Contest, scenario: Scenario) -> None:
    weak = run_match(scenario, "pid", contest.conditions["weak"], 0, contest.seed)
    share = contest.conditions["weak"].force_share
    assert weak.column("u_applied_mps2").max() <= share * scenario.train.max_traction_n / scenario.train.mass_kg + 1e-12
    assert weak.totals["saturated_samples"] > 0
    failure = contest.conditions["failure"].model_copy(update={"direct": True})  # so that force is command
    failed = run_match(scenario, "pid", failure, 0, contest.seed)
    t, asked, given_ = (failed.column(name) for name in ("t_s", "u_mps2", "u_applied_mps2"))
    after = t >= failure.failure_from_s - 1e-9
    mass = scenario.train.mass_kg
    wanted = (1 - failure.failed_share) * asked + failure.failure_n / mass
    assert given_[after] == pytest.approx(wanted[after], abs=1e-9)
    assert given_[~after] == pytest.approx(asked[~after], abs=1e-9)
    nominal, level = (match_values(run_match(scenario, "pid", contest.conditions[name], 0, contest.seed), scenario)
                      for name in ("nominal", "level"))
    assert level["position_rms"] < nominal["position_rms"]  # type: ignore[operator]


@settings(max_examples=60, deadline=None)
@given(st.integers(6, 40), st.integers(0, 10), st.floats(0.05, 5.0))
def test_a_shift_within_the_noise_is_no_win_and_a_clear_one_is(draws: int, seed: int, gap: float) -> None:
    generator = np.random.default_rng(seed)
    common = generator.normal(0.0, 10.0, draws)  # what is shared by pairing must not hide a difference
    how = Bootstrap(500, seed, 0.95)

    def won(*values: object) -> tuple[int, ...]:
        return rankings({"": values}, how)[""].winners  # type: ignore[dict-item]

    assert won(common, common + gap) == (0,)
    jitter = generator.permutation(np.linspace(-1.0, 1.0, draws))
    assert set(won(common, common + jitter)) == {0, 1}
    assert won(common, None) == (0,)


def played(name: str, draw: int, entry: str, value: float) -> Match:
    return Match(name, draw, entry, dict.fromkeys(METRICS, value) | {"stopping_error": 0.0}, None, 1.0, 1.0, {})


def test_a_race_ends_where_everyone_is_told_apart_and_all_have_the_same_draws(
        contest: Contest, scenario: Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    """One condition in which a law is plainly better, one in which two are level: it has the most draws."""
    from workbench.contest import matches as module

    def known(shared: object, task: tuple[str, int, Entry]) -> Match:
        name, draw, entry = task
        noise = np.random.default_rng([draw, len(entry.name)]).normal()
        worse = {"pid": 0.0, "pocrac": 5.0 if name == "ten" else 0.0, "mpc_linear": 9.0}[entry.name]
        return played(name, draw, entry.name, 20.0 + worse + 0.3 * noise)

    monkeypatch.setattr(module, "one_match", known)
    race = Racing(first=16, step=8, metrics=("position_rms",))
    small = few(contest, "ten", "noise", seeds=28).model_copy(update={"racing": race})

    def decided(now: object) -> list[str]:
        return undecided(Told(small, scenario, tuple(now), None))  # type: ignore[arg-type]

    kept: list[Match] = []
    found = all_matches(small, scenario, 1, lambda *_: None, (), kept.append, decided)
    runs = {(name, entry): sum(m.condition == name and m.entry == entry for m in found)
            for name in ("ten", "noise") for entry in QUICK}
    assert runs == {(name, entry): 16 if name == "ten" else 28 for name in ("ten", "noise") for entry in QUICK}
    told = Told(small, scenario, found, None)
    assert told.winners("ten", "position_rms") == ["pid"] and told.runs("ten") == 16
    assert set(told.winners("noise", "position_rms")) == {"pid", "pocrac"}
    assert all_matches(small, scenario, 1, lambda *_: None, kept[:7], lambda match: None, decided) == found
    assert look(small).confidence == pytest.approx(1 - 0.05 / 3) and looks(small) == 3


def test_a_race_is_decided_among_those_who_sample_alike(contest: Contest, scenario: Scenario) -> None:
    """Nobody is held apart from who commands at another period."""
    race = Racing(first=16, step=8, metrics=("position_rms",))
    small = few(contest, "noise", seeds=28).model_copy(update={"racing": race})

    def asked(**levels: float) -> list[str]:
        return undecided(Told(small, scenario, tuple(
            played("noise", draw, entry, level + np.random.default_rng([draw, len(entry)]).normal())
            for draw in range(16) for entry, level in levels.items()), None))

    assert asked(pid=20.0, pocrac=25.0, mpc_linear=20.0) == []
    assert asked(pid=20.0, pocrac=20.0, mpc_linear=25.0) == ["noise"]


def test_entries_whose_runs_agree_are_one_row(contest: Contest, scenario: Scenario) -> None:
    small = few(contest, "ten", seeds=16)
    matches = tuple(played("ten", draw, entry, value + draw) for draw in range(16) for entry, value in (
        ("pid", 9.0), ("pocrac", 5.0), ("mpc_linear", 5.001)))
    told = Told(small, scenario, matches, None)
    assert [[entry.name for entry in group] for group in told.alike] == [["pid"], ["pocrac", "mpc_linear"]]
    assert [row[0] for row in condition_table(told, "ten").rows] == ["pid", "pocrac = mpc_linear"]
    assert told.best("ten", "position_rms") == ["pocrac = mpc_linear"]
    assert undecided(told.__class__(small.model_copy(update={"racing": Racing(
        first=16, step=8, metrics=("position_rms",))}), scenario, matches, None)) == []


def test_results_are_the_same_bytes_with_any_number_of_processes(contest: Contest, scenario: Scenario) -> None:
    small = few(contest, "ten", "noise")
    runs = [all_matches(small, scenario, workers, lambda *_: None) for workers in (1, 2)]
    plain = [json.dumps([(m.condition, m.draw, m.entry, m.values, m.failed) for m in run]) for run in runs]
    assert plain[0] == plain[1]
    assert len(runs[0]) == 2 * 2 * len(QUICK)


def test_tuning_never_makes_worse_keeps_its_budget_and_repeats_itself(
        contest: Contest, scenario: Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    from workbench.contest import tune as module

    tuning = contest.tuning.model_copy(update={"runs": 24, "draws": 2, "restarts": 2})
    cheap = contest.model_copy(update={"tuning": tuning})
    drawn = []

    def counted(*arguments: object) -> object:
        drawn.append(arguments[3])
        return run_match(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "run_match", counted)
    found = tune_all(cheap, scenario, ["pid"], 1, lambda *_: None)["pid"]
    assert len(drawn) == tuning.runs and found.evaluations == 12 and len(found.improvements) == 2
    assert tune_all(cheap, scenario, ["pid"], 1, lambda *_: None)["pid"] == found
    assert found.cost <= found.stated
    assert min(drawn) >= DRAWS_FROM > 10_000 >= contest.seeds, "tuned on draws of the contest"
    for key, (low, high) in tuning.ranges["pid"].items():
        assert low <= found.values[key] <= high


def test_without_a_stated_budget_a_controller_gets_400_evaluations_in_three_restarts(contest: Contest) -> None:
    stated = contest.tuning.model_dump(exclude={"runs", "restarts", "source"}, exclude_none=True, mode="json")
    plain = contest.model_copy(update={"tuning": type(contest.tuning).model_validate(stated)})
    assert plain.evaluations("ten") == 400 and plain.tuning.restarts == 3
    worst = plain.tuning.model_copy(update={"mode": "minimax", "runs": (1 + plain.tuning.draws) * 30, "conditions": (
        "nominal", "ten")})
    few_ = plain.model_copy(update={"tuning": worst})
    assert few_.runs_an_evaluation("ten") == 1 + worst.draws and few_.evaluations("ten") == 30


def test_minimax_takes_the_worst_condition_and_each_condition_may_have_its_own(
        contest: Contest, scenario: Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs whose error is known: a distance, on a logarithmic scale, from another best gain in each condition."""
    from workbench.contest import tune as module

    best = {"ten": 0.3, "noise": 3.0}

    def known(changed: Scenario, name: str, condition: object, draw: int, seed: int) -> tuple[float, str]:
        title = next(key for key, value in contest.conditions.items() if value is condition)
        return changed.controllers[name].parameters["K_p"], title

    def values(run: tuple[float, str], changed: Scenario) -> dict[str, float]:
        error = abs(np.log(run[0] / best[run[1]]))
        return {"position_rms": float(error), "speed_rms": 0.0, "logged_jerk_rms": 0.0, "jerk_rms": 0.0}

    monkeypatch.setattr(module, "run_match", known)
    monkeypatch.setattr(module, "match_values", values)
    base = few(contest, "ten", "noise")
    small = base.tuning.model_copy(update={"runs": 0, "draws": 1, "ranges": {"pid": {"K_p": (0.075, 7.5)}}})
    found = {}
    for mode in ("condition", "minimax", "per condition"):
        of = base.model_copy(update={"tuning": small.model_copy(update={"mode": mode})})
        found[mode] = tune_all(of, scenario, ["pid"], 1, lambda *_: None)
    assert found["condition"]["pid"].values["K_p"] == pytest.approx(0.3, rel=0.02)
    assert found["minimax"]["pid"].values["K_p"] == pytest.approx(np.sqrt(0.3 * 3.0), rel=0.02)
    assert found["minimax"]["pid"].cost == pytest.approx(np.log(10) / 2 / contest.tuning.objective.position_m, rel=0.01)
    for name, gain in best.items():
        assert found["per condition"][name, "pid"].values["K_p"] == pytest.approx(gain, rel=0.02)


def test_a_small_contest_is_told_whole(contest: Contest, scenario: Scenario) -> None:
    small = few(contest, "nominal", "late_command").with_world(scenario)
    result = KIND.run(small, 1, lambda *_: None)
    assert {row["controller"] for row in result.rows} == set(QUICK)
    assert {row["condition"] for row in result.rows} == {"nominal", "late_command"}
    for row in result.rows:
        assert (row["failed"] is None) == (row["position_rms"] is not None)
        assert row.keys() >= set(METRICS)
    titles = [table.title for table in result.tables]
    assert titles[:2] == ["Who wins where; commands every 5 to 100 ms", "The contestants"]
    # POCRAC's barrier is left when commands are late: told as failed, ranked nowhere.
    late = [row for row in result.rows if row["condition"] == "late_command" and row["controller"] == "pocrac"]
    assert late[0]["failed"] is not None and late[0]["position_rms"] is None
    assert any("Runs that fail" in finding for finding in result.findings)
    assert result.plots and result.first_plot == 0
    for (name, stated), sentence in zip(small.conditions.items(), result.standings, strict=True):
        pid = next(row for row in result.rows if (row["condition"], row["controller"]) == (name, "pid"))
        assert sentence.startswith(f"{stated.title}: every 5 ms pid wins with a position RMS of "
                                   f"{length(pid['position_rms'])} (")
        assert f" µs a step, {number(pid['energy_J'] / 3.6e6)} kWh)" in sentence
    # The page begins with who tracks best at each period, and what that comes to.
    assert result.winners is not None
    assert result.winners.headings == ("condition", "a command every 5 ms", "draws")
    for (name, stated), row in zip(small.conditions.items(), result.winners.rows, strict=True):
        pid = next(row for row in result.rows if (row["condition"], row["controller"]) == (name, "pid"))
        assert (row[0], row[-1]) == (stated.title, pid["runs"])
        assert isinstance(row[1], Phrase) and row[1].words == "pid: {}"
        assert list(numbers_in(row[1])) == [pytest.approx(pid["position_rms"])]


def test_no_run_takes_less_than_the_bound(contest: Contest, scenario: Scenario) -> None:
    scenario = without_actuator(scenario)
    best = best_run(scenario)
    assert best is not None and best.gap < 1e-2
    for name in QUICK:
        energy = match_values(run_match(scenario, name, contest.conditions["nominal"], 0, contest.seed),
                              scenario)["energy_J"]
        assert energy is not None and energy > best.lower_bound_j


def test_mistakes_in_a_contest_are_one_line(contest: Contest, tmp_path: Path) -> None:
    text = COMMON.read_text(encoding="utf-8").replace("common_run.toml", str(SHARED / "common_run.toml"))
    text = text.partition(BEGIN)[0]
    for before, after, message in (
            ("[tuning.ranges.pid]", "[tuning.ranges.nobody]", "is no controller of the scenario"),
            ("K_p = [0.075, 50.0]", "K_q = [0.075, 50.0]", "is no parameter of this controller"),
            ("K_p = [0.075, 50.0]", "K_p = [50.0, 0.075]", "is no range"),
            ('condition = "ten"', 'condition = "calm"', "is no condition"),
            ("spread = 0.1", "spread = 1.5", "less than 1"),
            ("rho = 0.245", "rho = -0.245", "must be positive"),
            ("trials = 20.0", "trials = 2.5", "is no whole number"),
            ("neurons = 15.0", "neurones = 15.0", "'neurons' is missing"),
            ('law = "chen2019.one_car"', 'law = "chen2019.cars"', "unknown 'chen2019.cars'"),
            ("entrants.liu2020", "entrants.pid", "is a controller of the scenario already"),
            ("period_s = 0.1", "period_s = 0.007", "is not a whole number of plant steps"),
            ("failed_share = 0.0625", "failed_share = -1.0", "greater than or equal to 0")):
        assert before in text
        path = tmp_path / "broken.toml"
        path.write_text(text.replace(before, after, 2 if before.startswith("entrants") else 1), encoding="utf-8")
        with pytest.raises(WorkbenchError, match=message) as trouble:
            load(path)
        assert "\n" not in str(trouble.value)
    with pytest.raises(InputError, match="tuning: is missing: state budget"):
        list(tune_run(load(SHARED / "common_run.toml"), [], False, 1, lambda *_: None))


def test_found_parameters_are_written_and_take_part(contest: Contest, scenario: Scenario, tmp_path: Path) -> None:
    text = COMMON.read_text(encoding="utf-8").replace("common_run.toml", str(SHARED / "common_run.toml"))
    path = tmp_path / "own.toml"
    path.write_text(text.partition(BEGIN)[0].replace("runs = 804", "runs = 6"), encoding="utf-8")
    lines = list(tune_run(load(path), ["pid"], True, 1, lambda *_: None))
    assert lines[-1] == f"written: {path}"
    again = load(path).record
    assert isinstance(again, Contest)
    assert again.tuning.found.keys() == {"pid"}
    assert [entry.name for entry in entries(again, scenario)] == ["pid+", "pocrac", "mpc_linear"]
    list(tune_run(load(path), ["pocrac"], True, 1, lambda *_: None))
    assert load(path).record.tuning.found.keys() == {"pid", "pocrac"}
    assert path.read_text(encoding="utf-8").count(BEGIN) == 1
    text = path.read_text(encoding="utf-8").replace("runs = 6", 'runs = 6\nmode = "per condition"')
    text = text.replace("restarts = 3", "restarts = 1")
    path.write_text(text, encoding="utf-8")
    loaded = load(path)
    few_conditions = few(loaded.record, "ten", "nominal").with_world(loaded.record.world)
    each = tune_run(replace(loaded, record=few_conditions), ["pid"], True, 1, lambda *_: None)
    assert [line.partition(":")[0] for line in each] == ["pid in ten", "pid in nominal", "written"]
    last = load(path).record
    assert last.tuning.found_in.keys() == {"ten", "nominal"} and last.tuning.results_in["ten"]["pid"].evaluations == 3
    assert last.found_for("pid", "ten") == last.tuning.found_in["ten"]["pid"]

"""Laws that need runs of their own in a contest: they know what they are said to know, and trips count."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contests import few, only
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import PAPERS, PROOFS

from workbench.cli.loading import load
from workbench.contest.entrant import Entrant
from workbench.contest.entrants import check_entrants, learns, play
from workbench.contest.learning import learners, learning_tables
from workbench.contest.matches import all_matches, draws_of, play_match, with_parameters
from workbench.contest.record import Condition, Contest
from workbench.contest.study import KIND
from workbench.contest.tables import energy_table
from workbench.contest.told import ARRIVED_M, Told
from workbench.files.folders import held_in
from workbench.model.sensing import Sensing
from workbench.paper.statistics import Bootstrap, overtakes, rankings
from workbench.report.build import Asked
from workbench.report.study_page import StudyContent, build_study_page
from workbench.simulate.closed_loop import Setting, setting_of
from workbench.trains.scenario import Scenario, load_scenario

SHORT_S = 40.0
ENTRANTS = {law: entrant for paper in PAPERS for law, entrant in held_in(PROOFS / paper, "contest", Entrant).items()}


@pytest.fixture(scope="module")
def scenario(contest: Contest) -> Scenario:
    """With few trips a run."""
    whole = contest.world
    for name, spec in contest.entrants.items():
        if "trials" in spec.parameters:
            whole = with_parameters(whole, name, {"trials": 3.0})
    return whole


def short(scenario: Scenario, **sensing: float) -> Setting:
    return replace(setting_of(scenario), end_s=SHORT_S, sensing=Sensing(**sensing, seed=3))  # type: ignore[arg-type]


def test_the_common_line_is_driven_by_every_paper(scenario: Scenario) -> None:
    laws = {spec.law.partition(".")[0] for spec in scenario.controllers.values()}
    assert laws >= {"yang2021", "mao2018", "liu2020", "jiao2025", "chen2019", "pid", "mpc"}


# A law that is told the position alone does not change with the noise of the speed, and so on.
@pytest.mark.parametrize("law", sorted(ENTRANTS))
def test_an_entrant_uses_no_more_than_it_is_said_to_be_told(law: str, contest: Contest, scenario: Scenario) -> None:
    name = next(n for n, spec in contest.entrants.items() if spec.law.partition(".")[0] == law.partition(".")[0])
    given_ = scenario.controllers[name].parameters
    wanted = {key: given_.get(key, 1.0) for key in ENTRANTS[law].parameters}
    spec = scenario.controllers[name].model_copy(update={"law": law, "parameters": wanted})
    of = scenario.model_copy(update={"controllers": {name: spec}})
    plain, at_speed, at_place = (play(of, name, short(of, **noise)).run.log[:, :8] for noise in (
        {}, {"speed_noise_mps": 0.02}, {"position_noise_m": 0.02}))
    told = ENTRANTS[law].information
    uses_speed, uses_place = not np.array_equal(plain, at_speed), not np.array_equal(plain, at_place)
    assert (uses_speed, uses_place) == ("position only" not in told, "speed only" not in told)


def test_trips_are_learned_from(contest: Contest, scenario: Scenario) -> None:
    found = play_match(scenario, "chen2019", contest.conditions["nominal"], 0, contest.seed)
    errors = [position for position, _ in found.trials]
    assert len(errors) == 3 and errors[2] < errors[1] < errors[0]
    assert learns(scenario, "chen2019") and not learns(scenario, "liu2020")


def test_results_with_learners_are_the_same_bytes(contest: Contest, scenario: Scenario) -> None:
    small, of = few(contest, "noise", with_entrants=True), only(scenario, "liu2020", "jiao2025", "chen2019")
    runs = [all_matches(small, of, workers, lambda *_: None) for workers in (1, 2)]
    plain = [json.dumps([(m.draw, m.entry, m.values, m.failed, m.trials) for m in run]) for run in runs]
    assert plain[0] == plain[1]
    assert [m.entry for m in runs[0]] == 2 * ["liu2020", "jiao2025", "chen2019"]  # learners drive all draws too
    assert draws_of(small, "noise") == 2 and draws_of(small.model_copy(update={
        "conditions": {"noise": Condition(title="none", source={"title": "convention: a test"})}}), "noise") == 1


@settings(max_examples=60, deadline=None)
@given(st.integers(6, 30), st.integers(1, 12), st.integers(0, 5), st.floats(0.5, 2.0))
def test_the_trip_of_overtaking_is_the_first_that_stays_ahead(draws: int, trips: int, seed: int, rival: float) -> None:
    generator = np.random.default_rng(seed)
    common = generator.normal(0.0, 5.0, draws)  # paired draws share what makes runs hard
    falling = np.linspace(3.0, 0.01, trips)
    trials = common[:, None] + falling
    ahead = [i + 1 for i, error in enumerate(falling) if error < rival]
    assert overtakes(trials, common + rival, 200, seed, 0.95) == (ahead[0] if ahead else None)
    back = np.column_stack((trials, common + 10.0))  # worse again in the last trip
    assert overtakes(back, common + rival, 200, seed, 0.95) is None


def test_unlike_numbers_of_draws_are_compared_over_the_common_ones() -> None:
    hard = np.arange(40.0)

    def won(*values: object) -> set[int]:
        return set(rankings({"": values}, Bootstrap(300, 1, 0.95))[""].winners)  # type: ignore[dict-item]

    # Ahead by 1 in each of the first draws; the longer array's mean, of harder draws, says nothing about it.
    assert won(hard, hard[:10] - 1.0) == {1}
    assert won(hard, hard[:10]) == {0, 1}


def test_who_misses_the_end_of_the_line_is_not_ranked_and_all_of_it_is_told(
        contest: Contest, scenario: Scenario) -> None:
    of = only(scenario, "pid", "mpc_offset_free", "liu2020", "jiao2025", "chen2019")
    small = few(contest, "nominal", seeds=1, with_entrants=True).with_world(of)
    result = KIND.run(small, 1, lambda *_: None)
    rows = {row["controller"]: row for row in result.rows}
    assert rows["jiao2025"]["stopping_error"] > ARRIVED_M
    tables = {table.title.partition(";")[0]: table for table in result.tables}  # after it how often all sample
    assert "jiao2025" not in "".join(tables["Who wins where"].text[0])
    assert {row[0] for row in tables["Who does not take part"].rows} == set(contest.absent)
    energy = {row[0]: row for row in tables["Energy against the certified lower bound"].text}
    assert energy["jiao2025"][3] == "—" and float(energy["mpc_offset_free"][3]) > 0
    learned = tables["When learning overtakes MPC: position RMS"]
    assert [row[0] for row in learned.rows] == ["jiao2025", "chen2019"]
    for row in learned.text:
        assert row[3].startswith(("no, ", "trip "))
    assert sum("MPC" in finding for finding in result.findings) == 4
    page = build_study_page(StudyContent(small, result))
    assert "Learning from trip to trip" in page and "position only, model unknown" in page


def test_a_learner_that_fails_is_told_with_its_trip(contest: Contest, scenario: Scenario) -> None:
    wild = with_parameters(scenario, "jiao2025", {"unit_mps2": 5e4, "lamda": 1e-9, "trials": 4.0})
    unlimited = replace(setting_of(wild), limits=(math.inf, math.inf, math.inf))
    found = play(wild, "jiao2025", unlimited)
    assert found.run.failed is not None and found.run.failed.startswith(f"trial {len(found.trials)}: ")
    condition = Condition(title="none", source={"title": "convention: a test"})
    values = play_match(scenario, "chen2019", condition, 0, 1)
    assert len(values.trials) == 3


def test_the_contest_of_yang2021_reads_and_its_entrants_fit() -> None:
    path = PROOFS / "yang2021" / "contest.toml"
    found = load(path).record
    assert isinstance(found, Contest)
    stated = path.parent / found.scenario
    check_entrants(found, load_scenario(stated), path, stated)
    of = found.world
    assert {"mpc", "mpc_offset_free", "mpc_tube", "rbfnn_pocrac"} <= set(of.controllers)
    told = Told(found, of, (), None)
    assert not list(learning_tables(told)) and not learners(told) and not list(energy_table(told))


def test_a_report_on_a_contest_asks_for_no_gains(tmp_path: Path) -> None:
    """These are stated in the scenario that it drives: its own file has none of their numbers."""
    asked = Asked.of(load(PROOFS / "yang2021" / "contest.toml"), (), tmp_path / "out", with_gains=True)
    assert asked.gains is None

"""What a referee would take a contest apart for: late savings, bounds of another train, few draws, unlike periods."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest
from contests import few, only

from workbench.contest.by_period import period_findings
from workbench.contest.entrant import Entrant, Played
from workbench.contest.entrants import ENTRANTS
from workbench.contest.learning import _pairings
from workbench.contest.matches import METRICS, Entry, Match, one_match
from workbench.contest.objective_table import objective_of, objective_table
from workbench.contest.pareto import Front, Point, front_plots, front_tables
from workbench.contest.record import Contest, Pareto
from workbench.contest.study import _findings, located
from workbench.contest.tables import condition_table, energy_table, winners_table
from workbench.contest.told import Told
from workbench.contest.tuning_table import tuning_table
from workbench.errors import InputError
from workbench.paper.statistics import overtakes
from workbench.simulate.closed_loop import simulate_in

QUICK = ("pid", "pocrac", "mpc_linear")


def played(name: str, draw: int, entry: str, **values: float | None) -> Match:
    failed = "it failed" if None in values.values() else None
    return Match(name, draw, entry, dict.fromkeys((*METRICS, "logged_jerk_rms"), 0.0) | values, failed, 1.0, 1.0, {})


@pytest.fixture
def world(contest: Contest):
    return only(contest.world, *QUICK)


def told_of(contest: Contest, world, draws: int, *conditions: str, bound: float | None = None, **of: dict[str, float]
            ) -> Told:
    """Each entry's metrics, the same in all conditions, with draws that differ."""
    small = few(contest, *conditions, seeds=draws)
    return Told(small, world, tuple(
        played(name, draw, entry, **{key: value + 0.01 * draw for key, value in values.items()})
        for name in conditions for draw in range(draws) for entry, values in of.items()), bound)


def test_energy_is_saved_by_nobody_who_comes_late(contest: Contest, world) -> None:
    told = told_of(contest, world, 16, "ten", pid={"energy_J": 100.0, "position_rms": 2.0},
                   pocrac={"energy_J": 90.0, "position_rms": 1.0, "late_s": 3.0},
                   mpc_linear={"energy_J": 110.0, "position_rms": 3.0})
    assert told.winners("ten", "energy_J") == ["pid"]
    assert told.winners("ten", "position_rms") == ["pocrac"]


def test_the_bound_is_told_of_its_own_train_and_line_alone(contest: Contest, world) -> None:
    entries = {name: {"energy_J": 100.0 + i} for i, name in enumerate(QUICK)}
    told = told_of(contest, world, 1, "ten", "level", "failure", "nominal", "late_command", bound=50.0, **entries)
    assert told.bounded == ("nominal",)
    table, = energy_table(told)
    assert contest.conditions["nominal"].title in table.source
    assert not list(energy_table(told_of(contest, world, 1, "ten", "level", bound=50.0, **entries)))


def test_too_few_draws_have_no_interval(contest: Contest, world) -> None:
    entries = {name: {"position_rms": 1.0 + i} for i, name in enumerate(QUICK)}
    for draws, shown in ((3, False), (16, True)):
        table = condition_table(told_of(contest, world, draws, "ten", **entries), "ten")
        assert ("[" in "".join(map(str, table.text[0]))) is shown
        assert ("the mean alone" in table.note) is not shown


def test_jerk_without_an_actuator_is_said_to_be_of_a_plant_step(contest: Contest, world) -> None:
    entries = {name: {"position_rms": 1.0 + i} for i, name in enumerate(QUICK)}
    told = told_of(contest, world, 2, "ten", "direct", **entries)
    assert ["jump of the force" in condition_table(told, name).note for name in ("ten", "direct")] == [False, True]


def test_fronts_say_how_often_each_commands_and_on_how_many_draws(contest: Contest, world) -> None:
    small = few(contest, "ten").model_copy(update={"pareto": Pareto(condition="ten", draws=1)})
    point = Point({"k": 1.0}, 1.0, 2.0, 3.0, 0.0)
    fronts = [Front(name, "energy_J", (point,), 10) for name in ("pid", "mpc_told")]
    table, = front_tables(small, fronts)
    assert table.title.endswith("commands every 5 to 100 ms") and [row[1] for row in table.text] == ["5", "100"]
    assert "on the first of the contest's own draws, without intervals" in table.note
    assert [curve.label for curve in next(front_plots(small, fronts)).curves] == ["pid, 5 ms", "mpc_told, 100 ms"]


def test_wins_are_counted_among_those_who_sample_alike(contest: Contest, world) -> None:
    told = told_of(contest, world, 16, "ten", pid={"position_rms": 5.0}, pocrac={"position_rms": 9.0},
                   mpc_linear={"position_rms": 1.0})
    slow = replace(told, scenario=only(contest.world, *QUICK, "mpc_told"), matches=(*told.matches, *(
        played("ten", draw, "mpc_told", position_rms=2.0 + 0.01 * draw) for draw in range(16))))
    words = next(words for words in _findings(slow) if words.startswith("position RMS"))
    assert "every 5 ms pid in 1" in words and "every 100 ms mpc_linear in 1" in words


def test_the_objective_of_the_runs_that_count_and_its_worst(contest: Contest, world) -> None:
    """By hand: 0.2 m in units of 0.1 m is 2; a failed run costs the price of each of three parts."""
    of = only(contest.world, "pid")
    matches = (*(played(name, draw, "pid+", position_rms=error) for name, error in (("ten", 0.2), ("noise", 0.4))
                 for draw in range(2)), played("weak", 0, "pid+", **dict.fromkeys(METRICS)),
               played("weak", 1, "pid+", position_rms=0.1))
    conditions = {name: contest.conditions[name] for name in ("ten", "noise", "weak")}
    tuning = contest.tuning.model_copy(update={"mode": "minimax", "conditions": ("ten", "noise")})
    told = Told(contest.model_copy(update={"conditions": conditions, "tuning": tuning, "as_stated": ()}), of, matches,
                None)
    entry, = told.entries
    assert [objective_of(told, entry, name) for name in conditions] == pytest.approx([2.0, 4.0, (300 + 1) / 2])
    table, = objective_table(told)
    assert table.text[0][0] == "pid+" and [float(cell) for cell in table.text[0][2:]] == pytest.approx(
        [2.0, 4.0, 150.5, 4.0], rel=0.01)
    assert "weak" not in table.note and contest.conditions["noise"].title in table.note
    note = next(tuning_table(told)).note
    assert "Nothing is drawn" not in note and "line, curve and gusts are the same" in note


def test_tuning_on_a_run_without_chance_is_said_to_be_on_the_run_that_counts(contest: Contest) -> None:
    tuning = contest.tuning.model_copy(update={"mode": "minimax", "conditions": ("nominal", "ten")})
    told = Told(contest.model_copy(update={"tuning": tuning}), only(contest.world, "pid"), (), None)
    assert "Nothing is drawn in nominal, so that" in next(tuning_table(told)).note


def test_many_pairings_of_a_learner_share_their_level(contest: Contest, world) -> None:
    """Of 100 pairings of equals some five would call the learner ahead one by one, and together hardly ever one."""
    generator, alone, together = np.random.default_rng(3), 0, 0
    for _ in range(100):
        trials, rival = generator.normal(0, 1, (20, 2)), generator.normal(0, 1, 20)
        alone += overtakes(trials, rival, 500, 1, 0.95) is not None
        together += overtakes(trials, rival, 500, 1, 0.95, comparisons=100) is not None
    assert alone >= 1 and together == 0
    assert overtakes(trials - 9.0, rival, 500, 1, 0.95, comparisons=100) == 1
    assert _pairings(told_of(contest, world, 2, "ten", "noise")) == 1 * 2 * 2


def test_a_contest_may_name_who_of_a_scenario_takes_part(contest: Contest, tmp_path) -> None:
    from contests import COMMON

    few_of = contest.model_copy(update={"controllers": ("pid", "mpc_linear"), "entrants": {}, "periods_s": {},
                                        "as_stated": None, "pareto": None, "tuning": contest.tuning.model_copy(update={
                                            "ranges": {}, "found": {}, "results": {}, "evaluations_of": {}})})
    assert list(located(few_of, COMMON).world.controllers) == ["pid", "mpc_linear"]
    with pytest.raises(InputError, match="controllers: 'pidd' is no controller of the scenario"):
        located(few_of.model_copy(update={"controllers": ("pidd",)}), COMMON)


def test_what_tune_writes_of_a_scenarios_periods_can_be_read_again(contest: Contest) -> None:
    """Ranges are stated of `pid`, found is `pid_20ms`: the scenario has it at several periods."""
    stated = contest.model_dump(exclude_none=True, mode="json", exclude={"periods_s", "tuning"})
    tuning = contest.tuning.model_dump(exclude_none=True, mode="json", exclude={
        "found", "results", "ranges", "evaluations_of", "source"})
    ranges = {"pid": {"K_p": [0.1, 10.0]}}
    found = Contest.model_validate(stated | {"as_stated": [], "tuning": tuning | {
        "ranges": ranges, "found": {"pid_20ms": {"K_p": 1.0}, "pid": {"K_p": 2.0}}}})
    assert found.tuning.ranges["pid_20ms"] == found.tuning.ranges["pid"]


def test_too_few_draws_for_so_many_comparisons_are_said_to_be(contest: Contest, world) -> None:
    entries = {name: {"position_rms": 1.0 + i} for i, name in enumerate(QUICK)}
    for draws in (8, 16):
        told = told_of(contest, world, draws, "ten", **entries)
        metrics = len(told.metrics)
        assert 2.0 ** (1 - told.fewest) * metrics <= 0.05 < 2.0 ** (2 - told.fewest) * metrics
        assert (len(told.winners("ten", "position_rms")) == 1) is (draws >= told.fewest)
        assert ("With fewer than" in winners_table(told).note) is (draws < told.fewest)


class Answering:
    """A controller in Python that answers every sample alike."""

    title, information = "own", "nothing"

    def __init__(self, answer: float) -> None:
        self.counters, self.answer = {}, answer

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        return self.answer


def test_an_entrant_of_ones_own_that_answers_no_number_fails_and_one_that_raises_is_named(
        contest: Contest, world, monkeypatch) -> None:
    def match(play) -> Match:
        monkeypatch.setitem(ENTRANTS, "own.law", Entrant("own", "nothing", (), play))
        spec = world.controllers["mpc_linear"].model_copy(update={"law": "own.law"})
        return one_match((contest, world.model_copy(update={"controllers": {"own": spec}})),
                         ("nominal", 0, Entry("own", tuned=False)))

    def driven(answer: float, **totals: float):
        def play(scenario, spec, setting) -> Played:
            of = scenario.model_copy(update={"controllers": {"own": world.controllers["mpc_linear"]}})
            run = simulate_in(of, "own", setting, sampled=Answering(answer))
            return Played(replace(run, totals=run.totals | totals))
        return play

    assert match(driven(0.1)).failed is None
    for cheat in (driven(np.nan), driven(np.inf), driven(1e300), driven(-1e13), driven(0.1, traction_work_j=np.inf),
                  driven(0.1, force_switchings=np.nan)):
        found = match(cheat)
        assert found.failed and set(found.values.values()) == {None}
        json.dumps(asdict(found), allow_nan=False)  # as its journal keeps it

    def breaks(scenario, spec, setting) -> Played:
        raise ValueError("no more")

    with pytest.raises(InputError, match=r"own: own.law: play\(\) raised ValueError: no more"):
        match(breaks)


def test_the_next_is_told_apart_from_the_first_alone(contest: Contest, world) -> None:
    """Who is tied with the first is not compared with the next, so that nothing is said of the two."""
    whole = few(contest, "ten", seeds=16)
    rng = np.random.default_rng(1)
    base = rng.normal(0.0, 0.1, 16)
    values = {"pid": 1.0 + base, "pocrac": 1.05 + rng.normal(0.0, 0.4, 16), "mpc_linear": 2.0 + base}
    at_two = world.model_copy(update={"controllers": world.controllers | {
        name: world.controllers[name].model_copy(update={"period_s": 0.1}) for name in ("pid", "pocrac")}
        | {"late": world.controllers["pid"]}})
    matches = tuple(played("ten", draw, entry, position_rms=float(of[draw]))
                    for draw in range(16) for entry, of in (*values.items(), ("late", base + 3)))
    words = next(words for words in period_findings(Told(whole, at_two, matches, None)) if "100 ms" in words)
    assert words.index("pocrac, 0.9") < words.index("pid, 1.0")
    assert "; the next that is told apart from the first is mpc_linear, 2.0" in words

"""Sampling as an axis: a controller at several periods is as many, said by name and in every table."""

import pytest
from contests import COMMON, common, only
from scenarios import YANG, short_scenario

from workbench.contest.entrant import Entrant
from workbench.contest.entrants import entered, information
from workbench.contest.matches import entries, world_of
from workbench.contest.record import Condition, Contest
from workbench.contest.sampling import period_of, with_periods
from workbench.contest.study import located
from workbench.errors import InputError
from workbench.files.toml import read_toml, validate_record
from workbench.model.tuning import at_the_rail
from workbench.mpc.controller import MpcController
from workbench.paper.parameter_search import score
from workbench.paper.results import ResultTable
from workbench.report.tables import nominal_table
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.trains.actuator import Actuator
from workbench.trains.periods import at_periods, for_all_periods
from workbench.trains.scenario import build_scenario

PERIODS = [0.005, 0.02, 0.1]
NAMES = ["pid_5ms", "pid_20ms", "pid_100ms"]


def many(**changes):
    """yang2021's scenario, its PID at PERIODS."""
    data = read_toml(YANG) | {"reproduction": False, "printed_values": []}
    pid = {key: value for key, value in data["controllers"]["pid"].items() if key not in ("period_s", "source")}
    data["controllers"] = {"pid": pid | {"periods_s": PERIODS} | changes}
    data["tuning"] = {"runs": 10, "seed": 1, "objective": {"speed_mps": 1.0, "jerk_mps3": 1.0, "failed": 10.0},
                      "ranges": {"pid": {"K_p": [0.1, 1.0]}, "pid_20ms": {"K_d": [0.2, 2.0]}}}
    return build_scenario(YANG, {key: value for key, value in data.items()
                                 if key not in ("printed_table", "variants")})


def test_a_controller_at_several_periods_is_as_many_of_their_own():
    scenario = many()
    assert list(scenario.controllers) == NAMES
    assert [spec.period_s for spec in scenario.controllers.values()] == PERIODS
    assert len({spec.law for spec in scenario.controllers.values()}) == 1
    ranges = scenario.tuning.ranges
    assert ranges == {"pid_5ms": {"K_p": (0.1, 1.0)}, "pid_100ms": {"K_p": (0.1, 1.0)}, "pid_20ms": {"K_d": (0.2, 2.0)}}


@pytest.mark.parametrize(("changes", "words"), [
    ({"period_s": 0.1}, "period_s and periods_s are both stated"),
    ({"periods_s": [0.1, 0.1]}, "is no list of different positive seconds"),
    ({"periods_s": 0.1}, "is no list of different positive seconds"),
    ({"periods_s": []}, "is no list of different positive seconds"),
    ({"periods_s": ["fast"]}, "is no list of different positive seconds"),
    ({"periods_s": [0.1, float("nan")]}, "is no list of different positive seconds"),
    ({"periods_s": [-0.1]}, "is no list of different positive seconds"),
    ({"periods_s": [0.0123]}, "controllers.pid_12.3ms.period_s = 0.0123 is not a whole number of plant steps"),
    ({"periods_s": [0.1], "law": 3}, "controllers.pid_100ms.law: input should be"),
])
def test_periods_that_are_none_are_refused_in_a_line(changes, words):
    with pytest.raises(InputError) as refused:
        many(**changes)
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_a_name_that_is_taken_is_refused():
    with pytest.raises(ValueError, match=r"controllers\.a_10ms: is stated"):
        at_periods({"a": {"periods_s": [0.01]}, "a_10ms": {"period_s": 0.01}}, "controllers")


def test_ranges_of_a_name_hold_for_all_its_periods_and_no_other():
    found = for_all_periods({"a": 1, "ab": 2, "c": 3}, ["a_5ms", "a_2.5ms", "ab", "a_slow"])
    assert found == {"a_5ms": 1, "a_2.5ms": 1, "ab": 2, "c": 3}


def test_entrants_of_a_contest_too():
    data = read_toml(COMMON)
    entrant = data["entrants"]["liu2020"]
    data["entrants"]["liu2020"] = {key: entrant[key] for key in ("law", "parameters")} | {"periods_s": [0.005, 0.02]}
    data["tuning"].pop("found")
    contest = validate_record(data, Contest, COMMON).in_folder(COMMON.parent)
    contest = contest.with_world(entered(contest, only(common().world, "pid")))
    assert {"liu2020_5ms", "liu2020_20ms"} <= contest.world.controllers.keys()
    assert contest.tuning.ranges["liu2020_20ms"] == contest.tuning.ranges["liu2020_5ms"]


def test_every_row_says_its_period_and_the_title_says_from_where_to_where():
    table = ResultTable("nominal", "runs", ("controller", "x"), (("pid", 1.0), ("mpc_linear+", 2.0),
                                                                 ("mpc_economic = pid", 3.0)))
    found = with_periods(table, common().world)
    assert found.title == "nominal; commands every 5 to 1000 ms"
    assert [row[1] for row in found.text] == ["5", "100", "1000 = 5"]
    alike = with_periods(table, common().world, Condition(title="all", period_s=0.1))
    assert [row[1] for row in alike.text] == ["100", "100", "1000 = 100"]
    assert period_of(common().world, "pid") == 0.005


def test_a_comparison_says_each_period():
    scenario = short_scenario()
    metrics = [measure(simulate(scenario, name), scenario) for name in ("pid", "mpc")]
    row = next(row for row in nominal_table(metrics) if row.label == "Sampling period")
    assert row.cells == ("10.0", "100") and row.unit == "ms" and not row.best


def test_a_horizon_in_seconds_is_as_many_samples_at_every_period():
    parameters = {"horizon_s": 1.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 4.34,
                  "change_weight": 0.1, "band_price": 1e3}
    scenario = short_scenario(controllers__mpc__law="mpc.linear", controllers__mpc__parameters=parameters)
    for period, horizon in ((0.1, 10), (0.02, 50)):
        spec = scenario.controllers["mpc"].model_copy(update={"period_s": period})
        assert MpcController(scenario, spec, "mpc").problem.horizon == horizon
    both = spec.model_copy(update={"parameters": parameters | {"horizon": 10.0}})
    with pytest.raises(InputError, match="horizon and horizon_s are both stated"):
        MpcController(scenario, both, "mpc")


def test_a_condition_has_the_scenarios_actuator_its_own_or_none():
    scenario = short_scenario(reproduction=False, actuator={"lag_s": 0.3})
    own = Actuator(delay_s=0.1)
    assert world_of(scenario, Condition(title="a")).actuator == scenario.actuator
    assert world_of(scenario, Condition(title="a", actuator=own)).actuator == own
    assert world_of(scenario, Condition(title="a", direct=True)).actuator is None
    with pytest.raises(ValueError, match="direct = true has no actuator"):
        Condition(title="a", actuator=own, direct=True)


def test_a_delay_between_plant_steps_is_refused_of_a_condition():
    conditions = {"late": Condition(title="late", actuator=Actuator(delay_s=0.0033))}
    tuning = common().tuning.model_copy(update={"condition": "late"})
    with pytest.raises(InputError, match=r"conditions.late.actuator: delay_s = 0.0033 is not a whole number"):
        located(common().model_copy(update={"conditions": conditions, "tuning": tuning}), COMMON)


def test_behind_an_actuator_the_jerk_that_counts_is_that_of_every_step():
    values = {"position_rms": 0.0, "speed_rms": 0.0, "jerk_rms": 3.0, "logged_jerk_rms": 0.3}
    units = {"position_rms": 0.1, "logged_jerk_rms": 0.2}
    for actuator, jerk in ((False, 0.3), (True, 3.0)):
        assert score(values, at_the_rail(units, actuator), 100.0) == pytest.approx(jerk / 0.2)


def test_a_law_that_runs_by_itself_has_no_predictor():
    entrant = Entrant("a law", "all", (), lambda *_: pytest.fail("is not played"))
    spec = next(iter(short_scenario().controllers.values())).model_copy(update={
        "parameters": {}, "initial": {}, "neurons": None, "predictor": True})
    with pytest.raises(InputError, match=r"entrants\.a\.predictor"):
        entrant.check(spec, "entrants.a")
    entrant.check(spec.model_copy(update={"predictor": False}), "entrants.a")


def test_who_is_told_of_the_actuator_is_said_so():
    world = common().world
    assert information(world, "mpc_told").endswith("the actuator's delay and lag")
    assert "actuator" not in information(world, "mpc_linear")
    predicting = world.controllers["pid"].model_copy(update={"predictor": True})
    changed = world.model_copy(update={"controllers": {"pid": predicting}})
    assert information(changed, "pid").endswith("the nominal train over the actuator's delay")


def test_a_contest_names_who_takes_part_at_other_periods_too():
    contest = common()
    copy, own = contest.world.controllers["pid_100ms"], contest.world.controllers["pid"]
    assert (copy.period_s, own.period_s) == (0.1, 0.005) and copy.parameters == own.parameters
    assert contest.tuning.ranges["pid_100ms"] == contest.tuning.ranges["pid"]
    assert {contest.evaluations("ten", name) for name in contest.tuning.found} == {402}
    tuning = contest.tuning.model_copy(update={"evaluations_of": {"mpc_linear": 9}})
    fewer = contest.model_copy(update={"tuning": tuning})
    assert (fewer.evaluations("ten", "mpc_linear"), fewer.evaluations("ten", "pid_100ms")) == (9, 402)


def test_who_was_tuned_takes_part_as_stated_only_where_that_is_asked_for():
    contest = common()
    tuned = contest.model_copy(update={"as_stated": ("pocrac",), "tuning": contest.tuning.model_copy(
        update={"found": {"pid": {"K_p": 1.0}, "pocrac": {"k": 1.0}}})})
    world = only(contest.world, "pid", "pocrac", "mpc_linear")
    assert [entry.name for entry in entries(tuned, world)] == ["pid+", "pocrac", "pocrac+", "mpc_linear"]
    everyone = tuned.model_copy(update={"as_stated": None})
    assert [entry.name for entry in entries(everyone, world)] == ["pid", "pid+", "pocrac", "pocrac+", "mpc_linear"]


@pytest.mark.parametrize(("key", "value", "words"), [
    ("periods_s", {"nobody": (0.1,)}, "'nobody' does not take part"),
    ("periods_s", {"pid": (0.0033,)}, "0.0033 is not a whole number of plant steps"),
    ("periods_s", {"pid": (0.1, 0.1)}, "'pid_100ms' takes part already"),
    ("as_stated", ("nobody",), "'nobody' does not take part")])
def test_names_and_periods_that_are_none_are_refused(key: str, value: object, words: str):
    contest = common()
    tuning = contest.tuning.model_copy(update={"evaluations_of": {}})  # which names those at other periods too
    with pytest.raises(InputError, match=words):
        located(contest.model_copy(update={"tuning": tuning, key: value}), COMMON)

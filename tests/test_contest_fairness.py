"""A contest's own word: delays that hit all alike, differences too small to see, and where a tube's promise holds."""

import numpy as np
import pytest
from contests import COMMON

from workbench.contest.matches import Match, all_matches, draws_of, entries, run_match, world_of
from workbench.contest.premises import premises_findings, premises_table, words_of
from workbench.contest.record import Condition, Contest
from workbench.contest.study import located
from workbench.contest.told import Told
from workbench.errors import InputError
from workbench.paper.statistics import Bootstrap, rankings


@pytest.mark.parametrize("key", ["measurement_delay_s", "command_delay_s"])
def test_a_delay_that_would_not_hit_all_alike_is_refused(contest: Contest, key: str) -> None:
    """40 ms are 8 samples of the laws at 5 ms and none of MPC's at 100 ms: it would see the train at once."""
    late = contest.conditions["ten"].model_copy(update={key: 0.04})
    changed = contest.model_copy(update={"conditions": contest.conditions | {"ten": late}})
    words = rf"conditions\.ten\.{key}: 0\.04 s is no whole number of the 0\.1 s"
    with pytest.raises(InputError, match=words) as trouble:
        located(changed, COMMON)
    assert "\n" not in str(trouble.value)


def test_all_sample_alike_where_a_condition_says_so(contest: Contest) -> None:
    """Every contestant's command then changes at the stated period's multiples alone."""
    stated, scenario = Condition(title="all at MPC's period", spread=0.1, period_s=0.1), contest.world
    world = world_of(scenario, stated)
    assert {spec.period_s for spec in world.controllers.values()} == {stated.period_s}
    assert len({spec.period_s for spec in world_of(scenario, contest.conditions["ten"]).controllers.values()}) > 1
    fine = scenario.model_copy(update={"simulation": scenario.simulation.model_copy(update={"log_every_s": 0.005})})
    for name in ("pid", "mpc_linear"):
        run = run_match(fine, name, stated, 0, contest.seed)
        changed = np.flatnonzero(np.diff(run.column("u_mps2"))) + 1
        assert len(changed) > 100
        assert set((changed % 20).tolist()) == {0}
    odd = contest.model_copy(update={"conditions": contest.conditions | {
        "sampled": stated.model_copy(update={"period_s": 0.0125})}})
    with pytest.raises(InputError, match=r"conditions\.sampled\.period_s: 0\.0125 is not a whole number"):
        located(odd, COMMON)


def test_a_difference_that_no_table_shows_is_no_win() -> None:
    def won(*values: float | None, alike: float = 0.0) -> tuple[int, ...]:
        rows = [None if value is None else np.array([value]) for value in values]
        return rankings({"": rows}, Bootstrap(200, 1, 0.95), alike)[""].winners

    assert won(1000.0, 1000.4, 1003.0, alike=1e-3) == (0, 1)
    assert won(1000.0, 1000.4, 1003.0) == (0,)
    assert set(won(1000.4, 1000.0, None, alike=1e-3)) == {0, 1}
    assert won(0.0, 1e-9, alike=1e-3) == (0,)


def test_a_tubes_promise_is_told_by_condition_and_kept(contest: Contest) -> None:
    """On the level a bound of the gusts alone; with the line's grades no bound leaves room within the power limit."""
    whole = contest.world
    spec = whole.controllers["mpc_tube"]
    gusts = spec.model_copy(update={"parameters": spec.parameters | {"disturbance_mps2": 0.021}})
    scenario = whole.model_copy(update={"controllers": {"mpc_tube": gusts}})
    names = ("nominal", "level", "late_measurement")
    direct = {name: contest.conditions[name].model_copy(update={"direct": True}) for name in names}
    direct["acting"] = contest.conditions["level"]
    small = contest.model_copy(update={
        "seeds": 1, "resamples": 50, "entrants": {}, "absent": {},
        "conditions": direct,
        "tuning": contest.tuning.model_copy(update={"found": {}})})
    matches: tuple[Match, ...] = all_matches(small, scenario, 1, lambda *_: None)
    assert len(matches) == sum(draws_of(small, name) for name in direct) * len(entries(small, scenario))
    told = Told(small, scenario, matches, None)
    nominal, level, late, acting = words = tuple(words_of(told))
    assert acting.why == "an actuator is no part of it"
    assert level.why == ""
    assert level.needed <= 0.021 < level.largest
    assert level.beyond == 0
    assert level.largest_error_m is not None
    assert level.largest_error_m < level.around.position_m + 1e-3
    assert "the bound is too small" in nominal.why
    assert nominal.needed > nominal.largest
    assert nominal.beyond > 0
    assert "delays are no part of it" in late.why
    table, = premises_table(told, words)
    assert [row[-1] for row in table.rows] == [word.why or "holds" for word in words]
    sentence, = premises_findings(told, words)
    assert small.conditions["level"].title in sentence
    assert "alone of 4 conditions" in sentence

"""The contest the tests play: the shipped one, with fewer draws, conditions and contestants."""

from functools import cache

from scenarios import SHARED

from workbench.cli.loading import load
from workbench.contest.record import Contest
from workbench.trains.scenario import Scenario

COMMON = SHARED / "common.toml"


@cache
def common() -> Contest:
    found = load(COMMON).record
    assert isinstance(found, Contest)
    return found


def few(contest: Contest, *conditions: str, seeds: int = 2, with_entrants: bool = False) -> Contest:
    """Few draws of these conditions, nothing tuned, the contest's own entrants only where they are wanted."""
    tuning = contest.tuning.model_copy(update={"found": {}, "condition": "ten"})
    changes = {"seeds": seeds, "tuning": tuning, "resamples": 100, "pareto": None,
               "conditions": {name: contest.conditions[name] for name in conditions}}
    return contest.model_copy(update=changes if with_entrants else changes | {"entrants": {}, "absent": {}})


def only(scenario: Scenario, *names: str) -> Scenario:
    return scenario.model_copy(update={"controllers": {name: scenario.controllers[name] for name in names}})


def without_actuator(scenario: Scenario) -> Scenario:
    """The same train with its force at once, as the references and their bounds have it."""
    return scenario.model_copy(update={"actuator": None})

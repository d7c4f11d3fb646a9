"""Where a tube's word holds: the bound it is given, the bound that a condition's trains need, and what its runs did."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from workbench.contest.matches import Entry, world_of
from workbench.contest.record import Condition
from workbench.contest.told import Told
from workbench.files.numbers import counted
from workbench.mpc.controller import MpcController
from workbench.mpc.disturbance import Unknown, largest_bound, needed_bound
from workbench.mpc.tube import Tube, TubeMpc
from workbench.paper.cells import Column, Phrase
from workbench.paper.results import ResultTable
from workbench.trains.scenario import Scenario, with_parameters
from workbench.trains.track import resistance_table

LAW = "mpc.tube"


@dataclass(frozen=True)
class Word:
    """What a tube promises under a condition; bounds in m/s^2.

    needed: of every train of the condition; largest: with which all premises hold; why: what the promise lacks, empty
    where it holds; largest_error_m: of all runs, None where one failed; beyond: samples pushed by more than the bound,
    of `samples`.
    """

    entry: str
    condition: str
    around: Tube
    needed: float
    largest: float
    why: str
    largest_error_m: float | None
    beyond: int
    samples: int


def unknown_of(world: Scenario, condition: Condition) -> Unknown:
    """What a tube is not told of a condition's trains."""
    fastest = float(world.desired_curve().at(np.linspace(0.0, world.desired_curve().trip_time_s, 1001))[1].max()) + 1.0
    gust = sum((abs(row[2]) + abs(row[3])) * fastest ** row[6] for row in world.disturbance.rows())
    line = resistance_table(world.track, world.train.length_m)
    return Unknown(line, condition.spread, float(gust), condition.failed_share,
                   condition.failure_n / world.train.mass_kg if condition.failed_share else 0.0)


def lacks(scenario: Scenario, condition: Condition, around: Tube, needed: float) -> str:
    """What keeps a tube's promise from holding under a condition, empty where nothing does."""
    reasons = []
    if scenario.modes or scenario.failures:
        reasons.append("changes of the train are not bounded")
    if around.disturbance_mps2 < needed:
        reasons.append("the bound is too small")
    failing = [premise.name for premise in around.premises if not premise.holds]
    if failing:
        reasons.append(f"there is no {', no '.join(failing)}".replace("no a ", "no "))
    if condition.position_noise_m or condition.speed_noise_mps:
        reasons.append("noise is no part of it")
    if condition.measurement_delay_s or condition.command_delay_s:
        reasons.append("delays are no part of it")
    if condition.position_quantum_m or condition.odometer_spread:
        reasons.append("an odometer is no part of it")
    if condition.acting(scenario) is not None:
        reasons.append("an actuator is no part of it")
    return "; ".join(reasons)


def words_of(told: Told) -> Iterator[Word]:
    """A word per tube and condition."""
    for i, entry in enumerate(told.entries):
        if told.scenario.controllers[entry.controller].law == LAW:
            for name in told.contest.conditions:
                yield _word(told, i, entry, name)


def _word(told: Told, place: int, entry: Entry, name: str) -> Word:
    condition, scenario = told.contest.conditions[name], told.scenario
    if entry.tuned:
        scenario = with_parameters(scenario, entry.controller, told.contest.found_for(entry.controller, name) or {})
    world = world_of(scenario, condition)
    made = MpcController(world, world.controllers[entry.controller], entry.controller)
    assert isinstance(made.tracker, TubeMpc)
    around, problem = made.tracker.around, made.problem
    needed = needed_bound(problem, made.ahead, unknown_of(world, condition))
    start = world.simulation.initial_position_m - float(made.ahead[0, 0])
    errors = told.values(name, "largest_position_error")[place]
    counters = [match.counters for match in told.of(name, entry.name)]
    return Word(entry.name, name, around, needed, largest_bound(problem, made.ahead, start),
                lacks(scenario, condition, around, needed), None if errors is None else float(errors.max()),
                sum(each.get("beyond_bound", 0) for each in counters), sum(each.get("qp", 0) for each in counters))


def premises_table(told: Told, found: Sequence[Word]) -> Iterator[ResultTable]:
    """A row per tube and condition; none without a tube."""
    rows = [(word.entry, told.contest.conditions[word.condition].title, word.around.disturbance_mps2,
             *(bound if math.isfinite(bound) else None for bound in (word.needed, word.largest)),
             word.around.position_m, word.largest_error_m, Phrase("{} of {}", (word.beyond, word.samples)),
             word.why or "holds") for word in found]
    if rows:
        yield ResultTable(
            "Where the tube's word holds", "computed from line, train and conditions; errors and samples of all runs", (
                "controller", "condition", Column("stated bound", "m/s²"),
                Column("bound that covers all trains", "m/s²"), Column("largest bound with all premises", "m/s²"),
                Column("tube: largest |position error|", "m"), Column("runs: largest |position error|", "m"),
                "samples pushed by more than stated", "the promise"), tuple(rows),
            f"The promise: whatever is within the stated bound, the position error stays below "
            f"{told.scenario.simulation.position_band_m:g} m. It needs a bound that covers grades, curves, gusts and "
            "every drawn train at once (— : none below 5 m/s² does, since the feedback itself disturbs a train of "
            "another mass), and room for the feedback within limits of force and power. Where it does not hold, the "
            "runs tell what happened, and nothing is promised.")


def premises_findings(told: Told, found: Sequence[Word]) -> Iterator[str]:
    """In which conditions every tube keeps its band by its premises."""
    for name in dict.fromkeys(word.entry for word in found):
        own = [word for word in found if word.entry == name]
        sure = [told.contest.conditions[word.condition].title for word in own if not word.why]
        band = told.scenario.simulation.position_band_m
        every = "the only condition" if len(own) == 1 else f"all {len(own)} conditions"
        words = (f"certain in {every}" if len(sure) == len(own) else
                 f"certain in {', '.join(sure)} alone of {counted(len(own), 'condition')}" if sure else
                 f"certain in none of {counted(len(own), 'condition')}: its premises, or its bound, do not hold")
        yield f"{name}: |position error| below {band:g} m is {words}."

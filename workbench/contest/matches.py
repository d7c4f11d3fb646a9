"""The runs of a contest: every controller, as stated and as tuned, under every condition, with paired seeds."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.contest.entrant import Played
from workbench.contest.entrants import held_samples, play
from workbench.contest.record import Condition, Contest
from workbench.model.events import Failure
from workbench.simulate.closed_loop import Factors, Run, setting_of
from workbench.simulate.metrics import measure
from workbench.tasks.handing_out import run_tasks
from workbench.trains.scenario import Scenario, with_parameters
from workbench.trains.track import Track

Array = NDArray[np.float64]

TUNED = "+"
# What is compared, in SI units, the less the better; each a number of a whole run.
METRICS = ("position_rms", "speed_rms", "largest_position_error", "stopping_error", "energy_J", "jerk_rms",
           "jerk_p95", "jerk_max", "comfort_rms", "command_variation", "saturated_fraction", "band_share",
           "switchings_per_s", "late_s", "overspeed_mps")
# What tuning looks at besides: the jerk of the log's rows.
LOGGED_JERK = "logged_jerk_rms"
# What is an error from the desired curve: says nothing about who follows none.
OF_CURVE = ("position_rms", "speed_rms", "largest_position_error", "band_share")
STANDING_MPS = 0.1
# What a condition states of `model.sensing`.
SENSED = ("position_noise_m", "speed_noise_mps", "measurement_delay_s", "command_delay_s", "position_quantum_m",
          "balise_spacing_m", "speed_from")


@dataclass(frozen=True)
class Entry:
    """A controller of the scenario, as stated or as tuned: then its name ends in TUNED."""

    controller: str
    tuned: bool

    @property
    def name(self) -> str:
        """As in tables."""
        return f"{self.controller}{TUNED}" if self.tuned else self.controller


@dataclass(frozen=True)
class Match:
    """One run: condition, number of its seed, entry -> METRICS (None where the run failed), and why it failed.

    step_us, step_p99_us: median and 99th percentile of the time of a control step; counters: of the controller; trials:
    of `Played`, of a law that learns.
    """

    condition: str
    draw: int
    entry: str
    values: dict[str, float | None]
    failed: str | None
    step_us: float
    step_p99_us: float
    counters: dict[str, int]
    trials: tuple[tuple[float, float], ...] = ()


Task = tuple[str, int, Entry]


def entries(contest: Contest, scenario: Scenario) -> tuple[Entry, ...]:
    """Every controller as stated, and again with the parameters that tuning found, where there are any."""
    return tuple(Entry(name, tuned) for name in scenario.controllers for tuned in (False, True)
                 if (contest.is_tuned(name) if tuned else _takes_part_as_stated(contest, name)))


def _takes_part_as_stated(contest: Contest, name: str) -> bool:
    return contest.as_stated is None or name in contest.as_stated or not contest.is_tuned(name)


def draws_of(contest: Contest, condition: str) -> int:
    """How many runs every entry has under a condition: one where nothing is drawn."""
    return contest.seeds if contest.conditions[condition].random else 1


def run_match(scenario: Scenario, name: str, condition: Condition, draw: int, seed: int) -> Run:
    """The run of `play_match`, without what came before it."""
    return play_match(scenario, name, condition, draw, seed).run


def play_match(scenario: Scenario, name: str, condition: Condition, draw: int, seed: int) -> Played:
    """One run; factors and noise depend on seed and draw alone, so that they are the same for every controller."""
    sequence = np.random.SeedSequence(seed, spawn_key=(draw,))
    generator = np.random.default_rng(sequence)
    factors = 1 + condition.spread * generator.uniform(-1.0, 1.0, 5)
    noise_seed = int(generator.integers(2**31))
    world = world_of(scenario, condition)
    setting = setting_of(world, Factors(*(float(factor) for factor in factors)))
    scale = 1 + condition.odometer_spread * float(generator.uniform(-1.0, 1.0))
    stated = {key: getattr(condition, key) for key in SENSED if key in condition.model_fields_set}
    sensing = replace(setting.sensing, **stated, seed=noise_seed,
                      odometer_scale=setting.sensing.odometer_scale * scale)
    return play(world, name, replace(setting, sensing=sensing))


def world_of(scenario: Scenario, condition: Condition) -> Scenario:
    """What all draws of a condition share, and controllers know but for failures: limits, actuator, level, sampling."""
    train = scenario.train
    limited = train.model_copy(update={"max_traction_n": train.max_traction_n * condition.force_share,
                                       "max_braking_n": train.max_braking_n * condition.force_share})
    failures = scenario.failures
    if condition.failed_share:
        failures += (Failure.model_construct(
            from_s=condition.failure_from_s, to_s=None, omega_rad_s=0.0, phase_rad=0.0,
            failed_share=condition.failed_share, offset_n=condition.failure_n, amplitude_n=0.0),)
    world = scenario.model_copy(update={"train": limited, "failures": failures,
                                        "actuator": condition.acting(scenario)})
    if condition.level:
        world = world.model_copy(update={"track": _levelled(world)})
    if condition.period_s is not None:
        sampled = {name: spec.model_copy(update={"period_s": condition.period_s})
                   for name, spec in world.controllers.items()}
        world = world.model_copy(update={"controllers": sampled})
    return world


def _levelled(scenario: Scenario) -> Track:
    track = scenario.track
    flat = tuple(section.model_copy(update={"grade_permille": 0.0}) for section in track.grade)
    straight = tuple(section.model_copy(update={"radius_m": math.inf}) for section in track.curve)
    return track.model_copy(update={"grade": flat, "curve": straight, "tunnel": ()})


def match_values(run: Run, scenario: Scenario) -> dict[str, float | None]:
    """METRICS of a run; None each where it failed, or one of them is no number, as of an entrant of one's own."""
    nothing: dict[str, float | None] = dict.fromkeys((*METRICS, LOGGED_JERK))
    if run.failed is not None:
        return nothing
    found = measure(run, scenario)
    values = {
        "position_rms": found.position_rms, "speed_rms": found.speed_rms,
        "largest_position_error": found.largest_position_error, "stopping_error": abs(found.stopping_error),
        "energy_J": found.energy_J, "jerk_rms": found.jerk_rms, "jerk_p95": found.jerk_p95,
        "jerk_max": found.jerk_max, LOGGED_JERK: found.logged_jerk_rms,
        "comfort_rms": found.comfort_rms, "command_variation": found.command_variation,
        "saturated_fraction": found.saturated_fraction,
        "band_share": found.limit_violations / max(1.0, run.totals["samples"]),
        "switchings_per_s": found.switchings,
        "late_s": _late(run, scenario),
        "overspeed_mps": found.overspeed_max}
    return {key: float(value) for key, value in values.items()} if all(map(math.isfinite, values.values())) else nothing


def _late(run: Run, scenario: Scenario) -> float:
    """How long after the desired arrival the train still moves, as far as the run goes; 0 where it stands by then."""
    moving = np.abs(run.column("v_mps")) > STANDING_MPS
    last = float(run.column("t_s")[moving][-1]) if moving.any() else 0.0
    return max(0.0, last - scenario.desired_curve().trip_time_s)


def overspeed(position: Array, speed: Array, track: Track) -> float:
    """The largest excess over the line's speed limits, m/s; 0 without any."""
    allowed = np.full(len(position), np.inf)
    for section in track.speed_limit:
        here = (position >= section.start_m) & (position < section.end_m)
        allowed[here] = section.speed_mps
    return float(max(0.0, np.max(speed - allowed)))


def one_match(shared: tuple[Contest, Scenario], task: Task) -> Match:
    """The match of one task."""
    (contest, scenario), (condition, draw, entry) = shared, task
    if entry.tuned:
        scenario = with_parameters(scenario, entry.controller, contest.found_for(entry.controller, condition) or {})
    played = play_match(scenario, entry.controller, contest.conditions[condition], draw, contest.seed)
    run = played.run
    steps = run.step_us[:: held_samples(scenario, entry.controller)]
    middle, slow = np.percentile(steps, (50, 99)).tolist() if len(steps) else (0.0, 0.0)
    values = match_values(run, scenario)
    failed = run.failed or ("a metric of its run is no number" if values["position_rms"] is None else None)
    return Match(condition, draw, entry.name, values, failed, middle, slow, run.counters, played.trials)


Undecided = Callable[[Sequence[Match]], Sequence[str]]


def rounds(contest: Contest, condition: str) -> tuple[int, ...]:
    """After how many draws of a condition a race asks whether it is decided, the last of them all draws there are."""
    race, most = contest.racing, draws_of(contest, condition)
    return (*range(race.first, most, race.step), most) if race else (most,)


def looks(contest: Contest) -> int:
    """How often a contest may ask whether it is decided; once without a race."""
    return max(len(rounds(contest, name)) for name in contest.conditions)


def all_matches(contest: Contest, scenario: Scenario, workers: int, on_progress: Callable[[int, int, str], None],
                played: Sequence[Match] = (), keep: Callable[[Match], None] = lambda match: None,
                undecided: Undecided = lambda matches: ()) -> tuple[Match, ...]:
    """Every match, ordered by condition, draw and entry; a condition without chance is run once.

    Those already `played` are taken as they are; keep(match) is called with every other as it is finished. In a race
    the draws grow round by round in the conditions that `undecided` names, for all who take part alike, so that what is
    played depends on the matches alone and neither on workers nor on interruptions.
    """
    ahead = {name: list(rounds(contest, name)) for name in contest.conditions}
    draws = {name: coming.pop(0) for name, coming in ahead.items()}
    before = {(match.condition, match.draw, match.entry): match for match in played}
    found: dict[tuple[str, int, str], Match] = {}
    while True:
        tasks: list[Task] = [(name, draw, entry) for name, count in draws.items() for draw in range(count)
                             for entry in entries(contest, scenario)]
        places = [(condition, draw, entry.name) for condition, draw, entry in tasks]
        found.update((place, before[place]) for place in places if place in before)

        def record(match: Match, total: int = len(tasks)) -> None:
            keep(match)
            found[match.condition, match.draw, match.entry] = match
            on_progress(len(found), total, f"{match.entry}: {contest.conditions[match.condition].title}")

        run_tasks(one_match, (contest, scenario), [task for task, place in zip(tasks, places, strict=True)
                                                   if place not in found], workers, record)
        matches = tuple(found[place] for place in places)
        more = {name: ahead[name].pop(0) for name in undecided(matches) if ahead[name]}
        if not more:
            return matches
        draws |= more

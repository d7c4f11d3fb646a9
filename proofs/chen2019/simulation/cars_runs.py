"""Runs of chen2019's train as planned: those whose loops are alike are made side by side, with the bits of each alone."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Self

import numpy as np

from workbench.trains.multi_particle import coefficients

from .. import laws as law
from . import cars_loop
from .cars_loop import CAR_COLUMNS, COMPUTED, LOG_COLUMNS, TRIAL_COLUMNS
from .cars_trials import MEMORY_RULES, SLOPE_SEEN, SLOPE_VALUES, Array, CarsPlan, CarsRun, kernel

# A command beyond it is no longer one: the limits of a car are some 10^4 N.
MOST_COMMAND_N = 1e9
# Runs side by side: as many floats as the vectors of most processors have.
LANES = 4
# From how many trials on a run that is left alone is worth a loop of one lane, which may have to be compiled.
WORTH_ALONE = 10
# So many learned numbers may all runs side by side have: a gigabyte.
MOST_TOGETHER = 125_000_000


def run_cars(plan: CarsPlan) -> CarsRun:
    """Run all trials of a plan; one that diverges, or whose loop has no solution, ends the run, which then says where.

    Raises KeyError for an unknown rule of the acceleration or a missing value, ValueError for another unknown rule.
    """
    return run_together((plan,))[0]


def run_together(plans: Sequence[CarsPlan]) -> list[CarsRun]:
    """The runs of some plans, in their order, as `run_cars` makes each of them.

    What is one run but for its number of trials is made once. Raises as `run_cars`.
    """
    longest: list[CarsPlan] = []
    of: dict[int, int] = {}
    for number in sorted(range(len(plans)), key=lambda number: -plans[number].trials):
        plan = plans[number]
        found = next((i for i, other in enumerate(longest) if _one_run(plan, other)), len(longest))
        if found == len(longest):
            longest.append(plan)
        longest[found] = replace(longest[found], kept=tuple(sorted({*longest[found].kept, *plan.kept})))
        of[number] = found
    groups: dict[Hashable, list[int]] = {}
    for i, plan in enumerate(longest):
        groups.setdefault(_loop_of(plan), []).append(i)
    # A loop is compiled for each number of lanes: one that others run through fills up with nothing.
    lanes = LANES if len(longest) > 1 else 1
    runs = {i: run for among in groups.values()
            for i, run in zip(among, _run_alike([longest[i] for i in among], lanes), strict=True)}
    return [runs[of[number]].first(plan) for number, plan in enumerate(plans)]


def _one_run(a: CarsPlan, b: CarsPlan) -> bool:
    """Whether two plans differ in the number of their trials and in what is kept of them at the most."""
    return all(np.array_equal(getattr(a, one.name), getattr(b, one.name)) if one.type == "Array" else
               getattr(a, one.name) == getattr(b, one.name) for one in fields(a) if one.name not in ("trials", "kept"))


def _loop_of(plan: CarsPlan) -> Hashable:
    """What plans must share to run side by side."""
    return (plan.acceleration, plan.memory, plan.slope == "nowhere", plan.period_s, plan.log_every,
            len(plan.reference), plan.cars.shape[1])


@dataclass
class _Lane:
    """A run under way: which it is, and what its finished trials left."""

    number: int
    plan: CarsPlan
    totals: list[Array] = field(default_factory=list)
    by_car: list[Array] = field(default_factory=list)
    logs: dict[int, Array] = field(default_factory=dict)
    step_us: list[float] = field(default_factory=list)
    failed: str | None = None

    @property
    def trial(self) -> int:
        """The trial that is next, from 1."""
        return len(self.totals) + 1

    @property
    def ended(self) -> bool:
        """Whether nothing is left to run."""
        return self.failed is not None or len(self.totals) == self.plan.trials

    def run(self) -> CarsRun:
        """What the run left."""
        samples, count = len(self.plan.reference), self.plan.cars.shape[1]
        return CarsRun(
            np.array(self.totals).reshape(-1, len(TRIAL_COLUMNS)),
            np.array(self.by_car).reshape(-1, len(CAR_COLUMNS), count), self.logs, self.failed, np.array(self.step_us),
            8 * samples * (3 * count + 3))


@dataclass(frozen=True)
class _Arrays:
    """What the loop reads and learns, one run a lane: the last axis."""

    reference: Array
    start: Array
    values: Array
    cars: Array
    slope: Array
    variation: Array
    memory: Array
    shared: Array

    @classmethod
    def of(cls, plan: CarsPlan) -> Self:
        """A plan's own arrays, before its first trial."""
        for rule, known in ((plan.memory, MEMORY_RULES), (plan.slope, SLOPE_SEEN)):
            if rule not in known:
                raise ValueError(f"there is no rule '{rule}': choose one of {', '.join(known)}")
        samples, count = len(plan.reference), plan.cars.shape[1]
        memory, shared = np.zeros((samples, 3, count)), np.zeros((samples, 3))
        memory[:, 2] = plan.cars[law.CAR_DATA.index(law.m_low)]  # (22): M_hat_0
        start = np.zeros((len(law.CAR_STATE), count))
        start[:2] = plan.reference[0, :2, None]  # Assumption 3
        start[2:] = np.array(plan.start)[:, None]
        values = np.array([plan.values[str(x)] for x in law.VALUES])
        slope = np.array([*(plan.slope_values[str(x)] for x in SLOPE_VALUES[:-1]), float(plan.slope == "train")])
        variation = np.array([*values[: len(coefficients)], plan.variation["swing"], plan.variation["beat"]])
        return cls(plan.reference, start, values, plan.cars, slope, variation, memory, shared)

    def spread(self, lanes: int) -> Self:
        """The same in so many lanes; in one, what is learned stays where it is: a long run has little room for two."""
        learned = (id(self.memory), id(self.shared)) if lanes == 1 else ()
        return type(self)(*(x[..., None] if id(x) in learned else np.repeat(x[..., None], lanes, axis=-1)
                            for x in self.every()))

    def put(self, lane: int, other: Self) -> None:
        """Another plan's own arrays into a lane."""
        for mine, theirs in zip(self.every(), other.every(), strict=True):
            mine[..., lane] = theirs

    def only(self, lane: int) -> Self:
        """What one lane has, alone."""
        return type(self)(*(np.ascontiguousarray(x[..., lane : lane + 1]) for x in self.every()))

    def every(self) -> tuple[Array, ...]:
        """All arrays, in their order."""
        return tuple(getattr(self, one.name) for one in fields(self))


def _run_alike(plans: Sequence[CarsPlan], lanes_at_most: int) -> list[CarsRun]:
    """The runs of plans of one `_loop_of`; where one ends, the next takes its lane."""
    first, found = plans[0], dict[int, CarsRun]()
    waiting = deque(enumerate(plans))
    learned = len(first.reference) * (3 * first.cars.shape[1] + 3)
    width = lanes_at_most if lanes_at_most * learned <= MOST_TOGETHER else 1
    lanes: list[_Lane | None] = [None] * width
    arrays: _Arrays | None = None
    while True:
        for place, lane in enumerate(lanes):
            if lane is None and waiting:
                number, plan = waiting.popleft()
                lanes[place], own = _Lane(number, plan), _Arrays.of(plan)
                if arrays is None:
                    arrays = own.spread(width)
                else:
                    arrays.put(place, own)
                del own  # as large as what is learned
        if arrays is None or not any(lanes):
            return [found[number] for number in range(len(plans))]
        here = [place for place, lane in enumerate(lanes) if lane is not None]
        if len(lanes) > 1 and len(here) == 1 and _left(lanes[here[0]]) > WORTH_ALONE:
            lanes, arrays = [lanes[here[0]]], arrays.only(here[0])  # empty lanes cost time, too
        _trial(lanes, arrays)
        for place, lane in enumerate(lanes):
            if lane is not None and lane.ended:
                found[lane.number], lanes[place] = lane.run(), None


def _left(lane: _Lane | None) -> int:
    """How many trials a lane has before it."""
    return lane.plan.trials - len(lane.totals) if lane is not None else 0


def _trial(lanes: Sequence[_Lane | None], arrays: _Arrays) -> None:
    """The next trial of every lane."""
    here = [(place, lane) for place, lane in enumerate(lanes) if lane is not None]
    width, plan, (samples, _, count, _) = len(lanes), here[0][1].plan, arrays.memory.shape
    keeps = any(lane.trial in lane.plan.kept for _, lane in here)
    totals, by_car = np.zeros((len(TRIAL_COLUMNS), width)), np.zeros((len(CAR_COLUMNS), count, width))
    log = np.zeros((-(-samples // plan.log_every) if keeps else 0, len(LOG_COLUMNS), count, width))
    held, met = np.zeros((len(COMPUTED), count, width)), np.zeros((len(COMPUTED), width))
    room, few, ended = np.zeros((8, 4, count, width)), np.zeros((2, 4, width)), np.zeros((3, width))
    ended[0, [lane is None for lane in lanes]] = cars_loop.DIVERGED
    trial = kernel(plan.acceleration, width).trial

    def run(reference: Array) -> None:
        trial(reference, plan.period_s, plan.memory == "next_sample", arrays.start, arrays.values, arrays.cars,
              plan.slope != "nowhere", arrays.slope, arrays.variation, arrays.memory, arrays.shared, held, room, few,
              totals, by_car, log, plan.log_every, MOST_COMMAND_N, ended, met)

    run(arrays.reference[:0])  # no sample at all, so that compiling and loading are not timed
    started = time.perf_counter()
    run(arrays.reference)
    seconds = time.perf_counter() - started
    reached = samples if (ended[0] == cars_loop.RUNNING).any() else int(ended[1].max())
    for place, lane in here:
        lane.step_us.append(seconds * 1e6 / max(reached, 1))
        if ended[0, place] != cars_loop.RUNNING:
            lane.failed = _why(lane.plan, lane.trial, ended[:, place], met[:, place])
            continue
        if lane.trial in lane.plan.kept:
            lane.logs[lane.trial] = log[..., place].copy()
        lane.totals.append(totals[:, place])
        lane.by_car.append(by_car[..., place])


def _why(plan: CarsPlan, trial: int, ended: Array, met: Array) -> str:
    """Where and how a run ended early; ended: how, at which sample and car; met: what was computed there."""
    status, sample, car = map(int, ended)
    where = f"chen2019 (16), trial {trial}, t = {sample * plan.period_s:.3f} s, car {car + 1}"
    room, command = met[COMPUTED.index("room")], met[COMPUTED.index("mu")]
    if status == cars_loop.NO_SOLUTION:
        return (f"{where}: the acceleration is not unique: the estimate of the mass exceeds the mass by "
                f"{1 / plan.values['c_3'] - room:.3g} kg, 1/c_3 is {1 / plan.values['c_3']:.3g} kg")
    return f"{where}: the command diverged: mu = {command:.3g} N, z_2 = {met[COMPUTED.index('z_2')]:.3g} m/s"

"""One optimiser for everything that is tuned: CMA-ES of Optuna on a logarithmic scale, restarted with other seeds.

CMA-ES and not TPE: on six coupled parameters its best of 400 evaluations costs a tenth to two fifths of TPE's, in a
tenth of the time; gains of controllers are few, continuous and coupled. Optuna is imported where it searches, since it
takes a second.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from workbench.model.tuning import Range, is_whole
from workbench.tasks.handing_out import run_tasks

# Of a parameter that was found: within this share of its range (logarithmic) from an end, the end binds.
BINDING_SHARE = 0.01
DIGITS = 4

Cost = Callable[[dict[str, float]], float]


@dataclass(frozen=True)
class Restart:
    """What one seed found. values: the best parameters; cost: theirs; stated: the cost of the stated ones.

    improvements: (evaluation, counted from 1; the best cost so far), a row for each that is better than all before.
    """

    values: dict[str, float]
    cost: float
    stated: float
    improvements: tuple[tuple[int, float], ...]
    evaluations: int


@dataclass(frozen=True)
class Tuned:
    """The best of all restarts, the cost of it and of the stated parameters, and how each restart got there."""

    values: dict[str, float]
    cost: float
    stated: float
    improvements: tuple[tuple[tuple[int, float], ...], ...]
    evaluations: int

    @classmethod
    def of(cls, restarts: Iterable[Restart]) -> Tuned:
        """The first of the best restarts."""
        all_of = tuple(restarts)
        best = min(all_of, key=lambda one: one.cost)
        return cls(best.values, best.cost, best.stated, tuple(one.improvements for one in all_of),
                   sum(one.evaluations for one in all_of))


def score(values: Mapping[str, float | None], units: Mapping[str, float], failed: float) -> float:
    """The sum of each metric over its unit, each at most `failed`; what a run does not have costs as much."""
    return sum(failed if (value := values[name]) is None else min(value / unit, failed)
               for name, unit in units.items())


def search(cost: Cost, stated: Mapping[str, float], ranges: Mapping[str, Range], evaluations: int, seed: int,
           restart: int = 0) -> Restart:
    """The best parameters within their ranges; the stated ones are the first that are tried.

    stated: taken at the nearest end where they lie outside a range, so that within the ranges tuning makes nothing
    worse. A range of two whole numbers holds whole numbers alone. Every value is rounded to four digits before it is
    tried: what is found costs exactly what is told. The same numbers give the same answer, to the last bit.
    """
    import optuna  # noqa: PLC0415 - takes a second, which only a search has to spare

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    space = {key: _distribution(optuna.distributions, limits) for key, limits in ranges.items()}
    sampler = optuna.samplers.CmaEsSampler(seed=_seed_of(seed, restart))
    study = optuna.create_study(sampler=sampler)
    study.enqueue_trial({key: _within(stated[key], limits) for key, limits in ranges.items()})
    best, found, first = math.inf, dict[str, float](), math.inf
    improvements: list[tuple[int, float]] = []
    for number in range(1, max(1, evaluations) + 1):
        trial = study.ask(space)
        values = {key: _within(float(trial.params[key]), limits) for key, limits in ranges.items()}
        now = cost(values)
        study.tell(trial, now)
        first = now if number == 1 else first
        if now < best:
            best, found = now, values
            improvements.append((number, now))
    return Restart(found, best, first, tuple(improvements), max(1, evaluations))


def _seed_of(seed: int, restart: int) -> int:
    """A seed of its own for each restart, as far from each other as numpy makes them."""
    return int(np.random.SeedSequence(seed, spawn_key=(restart,)).generate_state(1)[0])


def _distribution(of: Any, limits: Range) -> Any:
    low, high = limits
    return (of.IntDistribution(int(low), int(high), log=True) if is_whole(limits) else
            of.FloatDistribution(low, high, log=True))


def _within(value: float, limits: Range) -> float:
    """The nearest value of the range, with as many digits as are written."""
    low, high = limits
    if is_whole(limits):
        return float(min(max(round(value), low), high))
    return min(max(float(f"{value:.{DIGITS}g}"), low), high)


def binding(value: float, limits: Range) -> str:
    """Which end of its range a parameter has run into: "low", "high" or nothing."""
    low, high = limits
    place = math.log(value / low) / math.log(high / low)
    return "low" if place <= BINDING_SHARE else "high" if place >= 1 - BINDING_SHARE else ""


# What is searched for: a controller, or a condition and a controller.
Name = str | tuple[str, str]
Task = tuple[Name, int]
# (shared, name, restart) -> what the restart found.
OneRestart = Callable[[Any, Any, int], Restart]


def _nowhere(task: Task, restart: Restart) -> None:
    """Keep nothing."""


@dataclass(frozen=True)
class Finished:
    """Restarts that need not be searched again, and what is called with every other as it ends."""

    restarts: Mapping[Task, Restart] = field(default_factory=dict)
    keep: Callable[[Task, Restart], None] = _nowhere


NONE_YET = Finished()


def words_of(name: Name) -> str:
    """As people read it."""
    return name if isinstance(name, str) else f"{name[1]} in {name[0]}"


def search_all(function: OneRestart, shared: Any, names: Sequence[Any], restarts: int, workers: int,
               on_progress: Callable[[int, int, str], None], finished: Finished = NONE_YET
               ) -> dict[Any, Tuned]:
    """Every restart of every name as a task of its own; name -> the best, the same whatever the number of workers."""
    tasks: list[Task] = [(name, restart) for name in names for restart in range(restarts)]
    done = {task: finished.restarts[task] for task in tasks if task in finished.restarts}

    def record(result: tuple[Task, Restart]) -> None:
        task, found = result
        finished.keep(task, found)
        done[task] = found
        on_progress(len(done), len(tasks), words_of(task[0]))

    run_tasks(_one, (function, shared), [task for task in tasks if task not in done], workers, record)
    return {name: Tuned.of(done[name, restart] for restart in range(restarts)) for name in names}


def _one(given: tuple[OneRestart, Any], task: Task) -> tuple[Task, Restart]:
    function, shared = given
    return task, function(shared, *task)

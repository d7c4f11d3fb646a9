"""How probable an event of a drawn run is, however rare: a metric beyond a value, or a run that fails before."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from workbench.errors import InputError
from workbench.files.writing import write_text
from workbench.simulate.closed_loop import prepared
from workbench.simulate.controllers import compiled
from workbench.simulate.draws import spreads
from workbench.simulate.law_values import check_controllers
from workbench.simulate.metric_option import metric_and_number
from workbench.simulate.metrics import measure
from workbench.simulate.setting import Factors, setting_of
from workbench.simulate.splitting import LEAST, Array, Estimate, Probability, splitting
from workbench.simulate.sweep import chosen
from workbench.simulate.sweep_rows import NUMBERS
from workbench.tasks.handing_out import places, results_of
from workbench.trains.scenario import Scenario

CSV_NAME = "rare.csv"
# Independent estimates, of which the interval is made, and the points of each.
ESTIMATES, SAMPLES = 10, 200
# A search of so few points looks first whether the event is met at all: where it is not, the estimates draw and count
# their points, and search no deeper.
SCOUTS = 40
LARGEST = "largest_position_error"

Task = tuple[str, int]  # controller, number of the estimate


@dataclass(frozen=True)
class Event:
    """A metric of a run above a value, in the metric's unit; a run that fails counts as beyond every value."""

    metric: str
    value: float

    @classmethod
    def parse(cls, text: str) -> Self:
        """METRIC>VALUE as it is typed; InputError for a metric that is none, and what is no finite number."""
        metric, number = metric_and_number("--rare", text, ">", (LARGEST, *NUMBERS), "'METRIC>VALUE', in quotes,")
        if not math.isfinite(number):
            raise InputError("", "--rare", f"'{text.partition('>')[2][:60]}' is no finite number: give 'METRIC>VALUE', "
                             "in quotes")
        return cls(metric, number)


@dataclass(frozen=True)
class Rare:
    """The probability of the event under a controller, and the runs of all its estimates and of the search before."""

    controller: str
    probability: Probability
    runs: int

    def line(self, event: Event) -> str:
        """As people read it; of an event that no run has met what its independent draws say, and they alone."""
        p, what = self.probability, f"{self.controller}: {event.metric} > {event.value:g}, or a run that fails, "
        if p.mean == 0.0:
            return (f"{what}was met by none of {self.runs} runs, though a search went to the worst {LEAST:g} of all; "
                    f"after {ESTIMATES * SAMPLES} independent draws the probability is below {p.high:.2g} at 95 %")
        return (f"{what}with probability {p.mean:.3g}, 95 % interval {p.low:.3g} to {p.high:.3g} ({ESTIMATES} "
                f"estimates, {self.runs} runs)")


def probabilities(scenario: Scenario, scenario_path: Path, event: Event, seed: int | None = None,
                  controllers: Sequence[str] | None = None, workers: int | None = None, out: Path | None = None,
                  on_progress: Callable[[int, int], None] = lambda done, total: None) -> list[Rare]:
    """The probability of an event under each controller, over the scenario's uncertainty; the same for the same seed.

    Where no run has met it, 0 and what is known from the independent draws alone: below `high` at 95 %.
    out: a CSV file for the estimates. Raises InputError for unusable options and where nothing is drawn.
    """
    check_controllers(scenario, scenario_path)
    names = chosen(scenario, scenario_path, controllers)
    if not spreads(scenario):
        raise InputError(scenario_path, "uncertainty", "nothing is drawn, so nothing is rare: name factors and a "
                         "spread")
    seed = scenario.uncertainty.seed if seed is None else seed
    shared = compiled(scenario.model_copy(update={"controllers": {n: scenario.controllers[n] for n in names}}))
    total, ended = len(names) * (1 + ESTIMATES), 0

    def made(names: Sequence[str], numbers: Sequence[int], samples: int, least: float) -> dict[Task, Estimate]:
        nonlocal ended
        tasks = [(name, number) for name in names for number in numbers]
        found = results_of(estimate, (shared, event, seed, samples, least), tasks, places(workers),
                           lambda done, *_: on_progress(ended + done, total))
        ended += len(found)
        return found

    scouts = made(names, [ESTIMATES], SCOUTS, LEAST)
    unmet = [name for name in names if not scouts[name, ESTIMATES].probability]
    found = made(unmet, range(ESTIMATES), SAMPLES, 1.0)
    unmet = [name for name in unmet if not any(found[name, number].probability for number in range(ESTIMATES))]
    ended = len(names) + len(unmet) * ESTIMATES
    found |= made([name for name in names if name not in unmet], range(ESTIMATES), SAMPLES, LEAST)
    if out is not None:
        _write(out, {(name, number): found[name, number] for name in names for number in range(ESTIMATES)})
    rows = [[found[name, number] for number in range(ESTIMATES)] for name in names]
    return [Rare(name, Probability.of(row, SAMPLES), sum(one.runs for one in (*row, scouts[name, ESTIMATES])))
            for name, row in zip(names, rows, strict=True)]


def estimate(shared: tuple[Scenario, Event, int, int, float], task: Task) -> Estimate:
    """One estimate under one controller; every controller's estimates begin with the same draws."""
    (scenario, event, seed, samples, least), (name, number) = shared, task
    drive, nominal, spread = prepared(scenario, name), setting_of(scenario), spreads(scenario)

    def of_run(point: Sequence[float]) -> float:
        factors = Factors(**{key: 1.0 + spread[key] * x for key, x in zip(spread, point, strict=True)})
        found = measure(drive(setting_of(scenario, factors, nominal)), scenario)
        return math.inf if found.failed is not None else float(getattr(found, event.metric))

    def performance(points: Array) -> Array:
        return np.array([of_run(point) for point in points.tolist()])

    generator = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    return splitting(performance, len(spread), event.value, samples, generator, least, near=number == ESTIMATES)


def _write(path: Path, found: dict[Task, Estimate]) -> None:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("controller", "estimate", "probability", "runs"))
    writer.writerows((*task, repr(one.probability), one.runs) for task, one in found.items())
    write_text(path, text.getvalue())

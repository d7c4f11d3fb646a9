"""What MPC takes and needs: time a step against its period, and how often something else had to answer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from workbench.contest.entrants import held_samples
from workbench.contest.matches import Entry, Match
from workbench.paper.cells import Cell, Column
from workbench.paper.results import ResultTable
from workbench.simulate.controllers import SAMPLED
from workbench.trains.scenario import Scenario

# Of `mpc.fallback`: what is shown of its counters, in the order of a sample's fate.
SHOWN = {"qp_failed": "no plan", "late": "too late", "shifted_plan": "last plan, shifted", "lqr": "LQR",
         "feedforward": "feedforward"}
MICRO = 1e-6


def mpc_table(scenario: Scenario, taking_part: Sequence[Entry], matches: Sequence[Match]) -> Iterator[ResultTable]:
    """A row per MPC over all its runs; none without MPC."""
    rows: list[tuple[Cell, ...]] = []
    for entry in taking_part:
        spec = scenario.controllers[entry.controller]
        if spec.law not in SAMPLED:
            continue
        own = [match for match in matches if match.entry == entry.name]
        if not own:
            continue
        counters = Counter[str]()
        for match in own:
            counters.update(match.counters)
        middle, slow = (float(np.median([getattr(match, name) for match in own]))
                        for name in ("step_us", "step_p99_us"))
        period_s = spec.period_s * held_samples(scenario, entry.controller)
        rows.append((entry.name, period_s, middle * MICRO, slow * MICRO, slow * MICRO / period_s, counters["qp"],
                     *(counters[key] for key in SHOWN)))
    if rows:
        yield ResultTable(
            "What MPC takes, and who answered instead", "samples of all runs", (
                "controller", Column("period", "ms", 1e-3, None), Column("median step", "µs", MICRO),
                Column("99th percentile", "µs", MICRO), Column("99th percentile / period", "%", 0.01),
                "samples asked", *SHOWN.values()), tuple(rows),
            "Times: the medians over the runs of each run's median and 99th percentile, call by call; they differ from "
            "run to run and are no part of what repeats. No deadline is set unless a controller's parameters do.")

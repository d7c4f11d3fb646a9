"""Who wins under which condition and at what price: law and MPC on the same drawn trains, for a page's first screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.files.units import KWH_J
from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.comparison import STEP
from workbench.paper.drivers import Drivers, entries
from workbench.paper.pairs import METRIC_NAMES, STATES, Pair, Task
from workbench.paper.results import ResultTable


@dataclass(frozen=True)
class _Entrant:
    """A controller on drawn trains of a place: on how many it failed, the mean of its errors on the others."""

    name: str
    failed: int
    mean: float
    step_s: float
    energy_J: float | None

    @property
    def rank(self) -> tuple[int, float]:
        """The less the better: first who arrives, then who errs least."""
        return self.failed, self.mean


def winners_table(study: Any, drivers: Drivers, pairs: Sequence[Pair], results: Mapping[Task, Mapping[str, Any]]
                  ) -> ResultTable | None:
    """A row per place and state of tuning, by the first metric of the pairs; None without pairs.

    results: of `pair_stage`. Who fails on any of the trains is no winner. Laws and MPC are held against each other by
    the pairs' own verdicts; two laws, or two kinds of MPC, are not told apart by any test, and their means stand as
    they are.
    """
    if not pairs:
        return None
    metric, draws = next(iter(pairs[0].differences)), study.pairs.draws
    name, unit = METRIC_NAMES[metric]
    rows: list[tuple[Cell, ...]] = []
    for place, where in drivers.places(study).items():
        for tuned in (False, True):
            of = [_entrant(who, [results[draw, place, who, tuned] for draw in range(draws)], metric)
                  for who, state in entries(study, drivers) if state == tuned and (0, place, who, tuned) in results]
            if not of:
                continue
            best = min(of, key=lambda one: one.rank)
            condition = f"{where}, {STATES[tuned]}"
            if best.failed:
                rows.append((condition, "nobody", None, _others(drivers, of, {}, draws), None, None))
                continue
            told = {other: pair.winner(metric) == best.name for pair in pairs
                    if (pair.place, pair.tuned) == (place, tuned)
                    for mine, other in ((pair.law, pair.rival), (pair.rival, pair.law)) if mine == best.name}
            rest = [one for one in of if one is not best]
            alone = "" if all(told.values()) else ", not alone"
            rows.append((condition, drivers.titles[best.name] + alone, best.mean, _others(drivers, rest, told, draws),
                         best.step_s, best.energy_J))
    energy = any(row[-1] is not None for row in rows)
    header = ("condition", "winner", Column(f"its {name}", unit), Column("the others", unit), STEP,
              Column("energy", "kWh", KWH_J))
    kept = len(header) if energy else -1
    return ResultTable(
        "Who wins, and at what price", "comparison", header[:kept], tuple(row[:kept] for row in rows),
        f"By the mean {name} over {draws} drawn trains, the least wins; not alone where another is not told apart from "
        "it by more than chance. Two laws, and two kinds of MPC, are ordered by their means without a test. Time of a "
        "control step and energy at the wheel are the winner's.", letters=True) if rows else None


def _entrant(name: str, rows: Sequence[Mapping[str, Any]], metric: str) -> _Entrant:
    ended = [row for row in rows if row["failed"] is None]
    steps = [row["step_s"] if "step_s" in row else row["step_us_median"] * STEP.si for row in rows]
    energies = [row["energy_J"] for row in ended if row.get("energy_J") is not None]
    return _Entrant(name, len(rows) - len(ended), float(np.mean([row[metric] for row in ended])) if ended else np.inf,
                    float(np.median(steps)), float(np.mean(energies)) if energies else None)


def _others(drivers: Drivers, of: Sequence[_Entrant], told: Mapping[str, bool], draws: int) -> Cell:
    """Some controllers, the best first, and which of them the pairs do not tell from the winner."""
    words, numbers = list[str](), list[float]()
    for one in sorted(of, key=lambda one: one.rank):
        level = " (not told apart)" if told.get(one.name) is False else ""
        if one.failed:
            words.append(f"{drivers.titles[one.name]} fails in {one.failed} of {draws}")
        else:
            words.append(f"{drivers.titles[one.name]} {{}}{level}")
            numbers.append(one.mean)
    return Phrase("; ".join(words), tuple(numbers)) if words else None

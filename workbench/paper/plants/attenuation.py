"""The search of gains for a folder's plant: a state feedback with the least proved L2 gain from its disturbances."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from workbench.errors import InputError
from workbench.gains.exact import fraction, rational
from workbench.gains.feedback import attenuating
from workbench.gains.linearised import disturbance_matrix, linearised
from workbench.gains.point import at_point
from workbench.gains.result import GainReport, GainSet, Quantity
from workbench.gains.stated import Stated
from workbench.paper.gain_search import GainSearch, Row, Task
from workbench.paper.loading import Loaded
from workbench.paper.plants.gains import margin_sentences, measures_all, positive
from workbench.systems.plant import Plant


def attenuation_search(paper: str, plant: Plant, weights: Mapping[str, str],
                       at: Mapping[str, Any] | None = None) -> GainSearch:
    """The state feedback with the least proved L2 gain from all disturbances to z, the weighed states and inputs.

    weights: of states and inputs by name, decimals as text; every input has one. at: the point of rest, as for
    `feedback_search`. Proved for every linearisation that the parameters' known intervals allow, of the linear plant
    from rest: the root of the integral of z^T z is at most the gain times that of w^T w. The search raises InputError
    for what it cannot take.
    """
    name = f"{paper}:attenuation"

    def report(stated: Stated) -> GainReport:
        point = at_point(plant, at)
        if not plant.disturbances:
            raise InputError(plant.id, "disturbances", "there is none: the gain is from them")
        if not measures_all(plant):
            raise InputError(plant.id, "outputs", "do not hold all states, which this feedback takes: add them")
        plants = linearised(plant, point)
        C, D = _weighed(plant, weights)
        found = attenuating(name, plants, disturbance_matrix(plant, point), C, D)
        values = {f"K_{u}_{x}": fraction(found.K[i, j]) for i, u in enumerate(plants.inputs)
                  for j, x in enumerate(plants.states)}
        z = ", ".join(f"{weight} {symbol}" for symbol, weight in weights.items())
        w = ", ".join(map(str, plant.disturbances))
        return GainReport(
            paper, (), (Quantity(f"L2 gain from {w} to ({z})", "", None, found.bound, name,
                                 note=f"for {len(plants.extremes)} extreme plants, from rest"),),
            (GainSet("attenuation", "least proved L2 gain from the disturbances", values,
                     f"L2 gain {found.bound:.3g} for every linear plant", name),), (found.found.certificate,),
            ("What is proved is of the plant linearised at the point, without limits.",
             *margin_sentences(plants, found.K)), {name: found.found.seconds})

    def tasks(found: GainReport) -> list[Task]:
        return []

    def run(loaded: Loaded, task: Task) -> tuple[Row, str | None]:
        raise AssertionError("there are no tasks")

    return GainSearch(report, tasks, run)


def _weighed(plant: Plant, weights: Mapping[str, str]) -> tuple[sp.Matrix, sp.Matrix]:
    """C and D of z = C x + D u, a row a weight."""
    names = [*map(str, (*plant.states, *plant.inputs))]
    for name in weights:
        if name not in names:
            raise InputError(plant.id, f"weights.{name}", f"is no state and no input: name one of {', '.join(names)}")
    for name in map(str, plant.inputs):
        if name not in weights:
            raise InputError(plant.id, f"weights.{name}", "is missing: every input has a weight")
    rows = sp.zeros(len(weights), len(names))
    for i, (name, weight) in enumerate(weights.items()):
        rows[i, names.index(name)] = rational(positive(plant, f"weights.{name}", weight))
    return rows[:, :len(plant.states)], rows[:, len(plant.states):]

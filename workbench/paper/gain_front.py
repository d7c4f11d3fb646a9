"""Gains that are proved and better: a search over gains for what runs cost against what a certificate proves.

What is proved is a bound on the root mean square of the tracking error under disturbances of stated sizes, of the
sampled loop linearised over a box of speeds and masses, behind its delay and lag (`gains/held_loop.py`). What costs is
the simulated loop. Neither can be told from the other: of gains that track a nominal train well nothing may be proved.
The search runs only those for which the solver has a bound; what is kept has an exact certificate.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, Strict

from workbench.errors import SolverError
from workbench.files.toml import Name, Number, Record
from workbench.gains.dissipation import frozen_gain, gain_certificate, least_gain, rounded, upper_gains
from workbench.gains.held_loop import Polytope, polytope
from workbench.gains.stated import Stated
from workbench.paper.gain_search import FrontSearch, FrontSetting, Values, gain_search_of
from workbench.paper.loading import Loaded
from workbench.paper.parameter_search import search
from workbench.paper.study import Progress
from workbench.tasks.handing_out import places, results_of

STATED = "stated"
# What gains cost in the search that are not stable at a vertex, and those of which nothing is proved.
UNSTABLE, UNPROVED = 100.0, 50.0
LEAST_SHARE = 0.01  # so little of the other, that of two that are level the one that nothing beats is taken


class Found(Record):
    """Gains of a front as they stand in the file."""

    name: Name
    gains: dict[Name, Number]


class FrontRecord(Record):
    """What a search found, by setting; evaluations: of each setting."""

    version: Literal[1] = 1
    evaluations: Annotated[int, Strict(), Field(ge=0)]
    found: dict[Name, tuple[Found, ...]] = Field(default_factory=dict)


@dataclass(frozen=True)
class Tried:
    """Gains that the search ran, with the solver's bound."""

    gains: dict[str, float]
    cost: float
    bound: float


def front_search_of(loaded: Loaded) -> FrontSearch | None:
    """What a paper's gains.py searches a front for; None where it searches none."""
    found = gain_search_of(loaded)
    return found.front if found else None


def exact(gains: Values) -> dict[str, Fraction]:
    """The gains as the decimals that are written."""
    return {name: Fraction(str(value)) for name, value in gains.items()}


def not_beaten(points: Sequence[Tried]) -> list[Tried]:
    """Those that no other beats in one of cost and bound without being worse in the other, by cost."""
    found: list[Tried] = []
    for one in sorted(points, key=lambda p: (p.cost, p.bound)):
        if not found or one.bound < found[-1].bound:
            found.append(one)
    return found


@dataclass(frozen=True)
class RecordedFront:
    """What was found, and its certificates by claim, those of the stated gains too where there are any."""

    record: FrontRecord
    certificates: dict[str, dict[str, Any]]


def search_fronts(loaded: Loaded, asked: FrontSearch, workers: int | None = None,
                  on_progress: Progress = lambda done, total, what: None) -> RecordedFront:
    """What is found in every setting, each point with its certificate; the same whatever the number of workers."""
    tasks = [(s.id, number) for s in asked.settings for number in range(asked.weights)]
    done: dict[tuple[str, int], list[Tried]] = results_of(
        _search_one, loaded, tasks, places(workers),
        lambda count, task, _: on_progress(count, len(tasks), f"{task[0]}, weight {task[1] + 1}"))
    certificates: dict[str, dict[str, Any]] = {}
    found = {s.id: chosen(loaded, asked, s, [one for task in tasks if task[0] == s.id for one in done[task]],
                          certificates) for s in asked.settings}
    return RecordedFront(FrontRecord(evaluations=asked.weights * asked.evaluations, found=found), certificates)


def chosen(loaded: Loaded, asked: FrontSearch, setting: FrontSetting, tried: Sequence[Tried],
           certificates: dict[str, dict[str, Any]]) -> tuple[Found, ...]:
    """At most `points` of those that nothing beats, the ends among them; `certificates` takes theirs.

    What no rounding proves is left out.
    """
    stated = Stated(loaded.path, loaded.data)
    efficient = not_beaten(tried)
    places = sorted(set(np.linspace(0, len(efficient) - 1, asked.points).round().astype(int))) if efficient else []
    named: list[Found] = []
    start = dict(asked.stated(stated))
    for gains in [start, *(one.gains for one in (efficient[i] for i in places) if one.gains != start)]:
        name = f"found_{len(named) + 1}" if gains is not start else STATED
        try:
            certificate = certified(asked, setting, stated, name, gains)
        except SolverError:
            continue
        certificates[str(certificate["claim"])] = certificate
        if gains is not start:
            named.append(Found(name=name, gains=gains))
    return tuple(named)


def certified(asked: FrontSearch, setting: FrontSetting, stated: Stated, name: str, gains: Values) -> dict[str, Any]:
    """The certificate of gains in a setting; SolverError where none is found."""
    of = polytope(setting.loop(stated, exact(gains)))
    _, found, P = least_gain(of, interior=True)
    return gain_certificate(claim_of(asked, setting, name), of, rounded(P), upper_gains(found))


def claim_of(asked: FrontSearch, setting: FrontSetting, name: str) -> str:
    """The name of the certificate of gains in a setting."""
    return f"{asked.paper}:front.{setting.id}.{name}"


def _search_one(loaded: Loaded, task: tuple[str, int]) -> list[Tried]:
    asked = front_search_of(loaded)
    assert asked is not None
    return tried_for(loaded, asked, *task)


def tried_for(loaded: Loaded, asked: FrontSearch, setting_id: str, weight: int) -> list[Tried]:
    """All that one weight's search ran: CMA-ES on the weighted logarithms of cost and bound."""
    setting = next(s for s in asked.settings if s.id == setting_id)
    stated = Stated(loaded.path, loaded.data)
    share = min(max(weight / max(asked.weights - 1, 1), LEAST_SHARE), 1 - LEAST_SHARE)
    tried: list[Tried] = []

    def cost(gains: dict[str, float]) -> float:
        of = polytope(setting.loop(stated, exact(gains)))
        bound = _bound(of)
        if bound is None:
            least = frozen_gain(of)
            return UNPROVED + math.log(least) if math.isfinite(least) else UNSTABLE * _growth(of)
        spent = setting.run(loaded, gains).get("cost")
        if spent is None or not spent > 0:
            return UNPROVED
        tried.append(Tried(dict(gains), spent, bound))
        return (1 - share) * math.log(spent) + share * math.log(bound)

    search(cost, asked.stated(stated), asked.ranges, asked.evaluations, asked.seed, weight)
    return tried


def _bound(of: Polytope) -> float | None:
    try:
        return least_gain(of)[0]
    except SolverError:
        return None


def _growth(of: Polytope) -> float:
    n = of.states
    whole = np.array([[[float(x) for x in row[:n]] for row in vertex] for vertex in of.vertices])
    return float(min(np.abs(np.linalg.eigvals(whole)).max(), 10.0))

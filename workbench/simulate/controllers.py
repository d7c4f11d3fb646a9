"""All controllers by id: laws that are compiled whole, and controllers that are called once a sample."""

from __future__ import annotations

from collections.abc import Callable
from difflib import get_close_matches
from typing import Protocol

import numpy as np
import sympy as sp

from workbench.model.cascaded_pid import cascaded_pid
from workbench.model.law import ControlLaw
from workbench.model.laws import law_named, laws_near
from workbench.mpc.controller import KINDS
from workbench.mpc.tracking import TrackingMpc
from workbench.mpc.tracking_compiled import CompiledTrackingMpc
from workbench.trains.scenario import ControllerSpec, Scenario
from workbench.trains.track import resistance_table

MOST_NAMED = 7  # laws of one paper or family in a message

_held = sp.Symbol("u_held", real=True)
held_command = ControlLaw(
    id="held", title="held command", source="zero-order hold", information="full state, nominal model",
    command=_held, parameters=(_held,),
)


class SampledController(Protocol):
    """A controller that is called once a sample; it counts its troubles in `counters` and never raises."""

    title: str
    information: str
    counters: dict[str, int]

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """The command u = F/m in m/s^2 for the sample at time_s."""
        ...


SAMPLED: dict[str, Callable[[Scenario, ControllerSpec, str], SampledController]] = {
    "mpc.tracking": TrackingMpc,
    "mpc.tracking_compiled": CompiledTrackingMpc,
    **KINDS,
}

# Controllers that are one program solved in two ways: by the plain one, and by the compiled one for many runs.
COMPILED = {"mpc.tracking": "mpc.tracking_compiled"}


def compiled(scenario: Scenario) -> Scenario:
    """The scenario with the compiled form of every controller that has one: the same commands within a solver's
    tolerance, in a small part of the time."""
    return scenario.model_copy(update={"controllers": {
        name: spec.model_copy(update={"law": COMPILED.get(spec.law, spec.law)})
        for name, spec in scenario.controllers.items()}})


# Laws that are made for a line, of which they are told: of where its resistance changes (m) and by how much (N/kg).
TOLD_THE_LINE: dict[str, Callable[[tuple[tuple[float, float], ...]], ControlLaw]] = {
    "cascaded_pid.told": cascaded_pid,
}


def compiled_law(scenario: Scenario, spec: ControllerSpec) -> ControlLaw | None:
    """The law of a controller that is compiled whole; None for one that is called once a sample, and unknown ones."""
    if spec.law in TOLD_THE_LINE:
        line = resistance_table(scenario.track)
        changes = np.diff(line.specific_force, prepend=0.0)
        return TOLD_THE_LINE[spec.law](tuple(zip(line.position_m.tolist(), changes.tolist(), strict=True)))
    return None if spec.law in SAMPLED else law_named(spec.law, scenario.folder)


def nearest_law(scenario: Scenario, asked: str) -> str | None:
    """The law whose name is nearly the one that is asked for."""
    return next(iter(get_close_matches(asked, _names(scenario), n=1)), None)


def _names(scenario: Scenario) -> list[str]:
    return [*laws_near(scenario.folder), *TOLD_THE_LINE, *SAMPLED]


def known_laws(scenario: Scenario) -> str:
    """All laws that a scenario may name, those of a paper or family with its name once: `mpc.linear | nonlinear`.

    Of a family of many the first ones stand for all.
    """
    families: dict[str, list[str]] = {}
    for law in _names(scenario):
        family, dot, own = law.partition(".")
        families.setdefault(family + dot, []).append(own)
    return ", ".join(family + " | ".join(members if len(members) <= MOST_NAMED else [*members[:3], "..."])
                     for family, members in families.items())

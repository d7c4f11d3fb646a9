"""Source of the functions by which a plant tells where its events happen and what they reset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from workbench.compile.vector_code import into_array
from workbench.model.law import time
from workbench.systems.plant import Plant


def event_functions(plant: Plant, arrays: Mapping[str, Sequence[sp.Symbol]]) -> list[str]:
    """Python source of event_values, event_rates and event_reset; of a plant without events, which is never asked for
    them, of what costs nothing to compile.

    Raises CompileError for an expression that has no code.
    """
    if not plant.events:
        return ["event_values = event_rates = extreme_values", "def event_reset(which, t, x, u, s, p):\n    pass\n"]
    source = [into_array("event_values", [event.expression for event in plant.events], arrays),
              into_array("event_rates", [event.rate(plant.flow, time) for event in plant.events], arrays)]
    choice = ["def event_reset(which, t, x, u, s, p):"]
    for number, event in enumerate(plant.events):
        targets = [f"out[{plant.states.index(symbol)}]" for symbol in event.reset]
        source.append(into_array(f"reset_{number}", list(event.reset.values()), arrays, out=targets))
        choice += [f"    if which == {number}:", f"        reset_{number}(t, x, u, s, p, x)"]
    return [*source, "\n".join([*choice, ""])]

"""Source of the functions by which a plant's events happen in the compiled loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from workbench.compile.text import loop_text
from workbench.compile.vector_code import into_array
from workbench.model.law import time
from workbench.simulate.plants import event_loop
from workbench.systems.plant import Plant

ARGUMENTS = ("k, h, states, x, u, u_end, fade_full, table, pieces, p, extremes, values, sides, crossing, slopes, "
             "event_log, event_count, moved, inputs, signals")


def event_functions(plant: Plant, arrays: Mapping[str, Sequence[sp.Symbol]]) -> list[str]:
    """Python source of `step_with_events` and all that it calls; of a plant without events one that is never called.

    Raises CompileError for an expression that has no code.
    """
    if not plant.events:
        return [f"def step_with_events({ARGUMENTS}):\n    return 0\n"]
    source = [into_array("event_values", [event.expression for event in plant.events], arrays),
              into_array("event_rates", [event.rate(plant.flow, time) for event in plant.events], arrays)]
    choice = ["def event_reset(which, t, x, u, s, p):"]
    for number, event in enumerate(plant.events):
        targets = [f"out[{plant.states.index(symbol)}]" for symbol in event.reset]
        source.append(into_array(f"reset_{number}", list(event.reset.values()), arrays, out=targets))
        choice += [f"    if which == {number}:", f"        reset_{number}(t, x, u, s, p, x)"]
    return [*source, "\n".join([*choice, ""]), loop_text(event_loop)]

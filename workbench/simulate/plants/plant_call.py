"""A plant as the one function that the compiled loop calls by its address, so that the loop need not know it.

Generated: plant_step, rates_into, plant_outputs, plant_margin, extreme_values, and of events event_values, event_rates
and event_reset; what stands below the marker is joined to them. Arrays are bare memory here, without their sizes.
"""

# ruff: noqa: F821, ANN001, ANN201
# mypy: ignore-errors

import ctypes

ENTRIES, MAKES_NO_ARRAY = (), True
NUMBERS = ctypes.POINTER(ctypes.c_double)
# Arguments as of `answer`.
ANSWER = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * 3, *[NUMBERS] * 9)
# What can be asked, in words for loop and plant; RESET and those above it are the resets of the events. No whole
# numbers: numba would compile a function anew for each that is written where it is called.
QUESTIONS = "".join(f"{name} = {number}.0\n" for number, name in enumerate((
    "STEP", "MARGIN", "OUTPUTS", "EXTREMES", "EVENTS", "EVENT_RATES", "RATES", "RESET")))

# --- kernel ---


def answer(what, t, h, x, u, s, u_middle, s_middle, u_end, s_end, p, out):
    """Move the plant by a step, or put the values that are asked for into `out`; the margin of its domain where that or
    a step is asked for, 1 elsewhere."""
    if what == STEP:
        plant_step(t, h, x, u, s, u_middle, s_middle, u_end, s_end, p)
        return 1.0 * plant_margin(t + h, x, u_end, s, p)
    if what == MARGIN:
        return 1.0 * plant_margin(t, x, u, s, p)
    if what == OUTPUTS:
        plant_outputs(t, x, p, out)
    elif what == EXTREMES:
        extreme_values(t, x, u, s, p, out)
    elif what == EVENTS:
        event_values(t, x, u, s, p, out)
    elif what == EVENT_RATES:
        event_rates(t, x, u, s, p, out)
    elif what == RATES:
        rates_into(t, x, u, s, p, out)
    else:
        event_reset(what - RESET, t, x, u, s, p)
    return 1.0

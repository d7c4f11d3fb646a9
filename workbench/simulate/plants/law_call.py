"""A law of any plant as the one function that the compiled loop calls by its address.

Generated: law_step and law_margin; what stands below the marker is joined to them.
"""

# ruff: noqa: F821, ANN001, ANN201
# mypy: ignore-errors

import ctypes

ENTRIES, MAKES_NO_ARRAY = (), True
NUMBERS = ctypes.POINTER(ctypes.c_double)
ANSWER = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * 2, *[NUMBERS] * 5)  # arguments as of `answer`

# --- kernel ---


def answer(t, period, measured, s, states, parameters, command):
    """Move the law's states and give its command, in its domain; the margin of the domain, where nothing else is done
    unless it is positive."""
    margin = 1.0 * law_margin(t, period, measured, s, states, parameters)
    if margin > 0.0:
        law_step(t, period, measured, s, states, parameters, command)
    return margin

"""A law asked again at rows of a run's log, compiled once for all laws, so that a step can be timed without the plant.

The law is a function of `law_call.py`, called by its address as the closed loop calls it.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

ENTRIES, ONE_BODY = ("repeated_law",), True

# --- kernel ---


def repeated_law(law, log, count, period, state, parameters, scalars, neurons, neuron_data):
    """Ask the law at the first rows of a log; returns how many it answered before it left its domain."""
    for row in range(count):
        if law(log[row, 0], log[row, 1], log[row, 2], log[row, 3], log[row, 4], log[row, 5], period, state.ctypes,
               parameters.ctypes, scalars.ctypes, neurons.ctypes, neuron_data.ctypes, parameters.shape[0],
               scalars.shape[0], neurons.shape[0], neurons.shape[1], neuron_data.shape[0], neuron_data.shape[1]) == 0:
            return row
    return count

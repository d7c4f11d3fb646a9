"""What a run is measured by, from what was integrated, the extremes and the state at its end."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from workbench.compile.vector_code import numeric_vector
from workbench.simulate.plants.arrays import Arrays
from workbench.systems.setting import Setting


def _number(function: Callable[..., Any], *given: float) -> float:
    """The value of one expression; NaN where it has none."""
    try:
        return float(function(*given)[0])
    except (ValueError, ZeroDivisionError, OverflowError):
        return math.nan


def metrics_of(setting: Setting, a: Arrays, t: float, whole: bool) -> dict[str, float | None]:
    """The metrics at the end of a run; None for what has no number, and of a run that ended early for all."""
    metrics, n = setting.every_metric, len(setting.plant.states)
    if not whole:
        return dict.fromkeys((metric.id for metric in metrics), None)
    signal = {symbol: value for symbol, value in zip(setting.signal_symbols, a.s, strict=True)
              if symbol in setting.symbols}
    symbols = (*setting.plant.states, *setting.plant.inputs, *setting.plant.parameter_symbols, *signal)
    final = [_number(numeric_vector(symbols, [metric.expression]), t, *a.x[:n], *a.u, *a.p, *signal.values())
             for metric in metrics]
    found: dict[str, float | None] = {}
    integrals, extremes = iter(a.x[n:]), iter(a.extremes)
    for metric, value in zip(metrics, final, strict=True):
        match metric.measure:
            case "integral":
                found[metric.id] = float(next(integrals))
            case "mean":
                found[metric.id] = float(next(integrals)) / t
            case "root mean square":
                found[metric.id] = math.sqrt(max(0.0, float(next(integrals)) / t))
            case "largest":
                found[metric.id] = max(float(next(extremes)), float(value))
            case "smallest":
                found[metric.id] = min(-float(next(extremes)), float(value))
            case "variation":
                found[metric.id] = float(a.commanded[1, setting.plant.inputs.index(metric.expression)]) / t
            case "saturated":
                of_all, _, at_limit = a.commanded[:, setting.plant.inputs.index(metric.expression)]
                found[metric.id] = float(at_limit / of_all)
            case "last above zero":
                found[metric.id] = max(float(next(extremes)), t if value > 0 else 0.0 * abs(value))
            case _:
                found[metric.id] = float(value)
    return {name: value if value is not None and math.isfinite(value) else None for name, value in found.items()}

"""Options of the command line that name a metric of a run and a number."""

from __future__ import annotations

import math
from collections.abc import Sequence

from workbench.errors import InputError
from workbench.files.known_names import one_of


def metric_and_number(option: str, text: str, sign: str, metrics: Sequence[str], write: str) -> tuple[str, float]:
    """What stands before and behind the sign, NaN for what is no number; write: how the option is typed.

    Raises InputError for a metric that is none.
    """
    metric, stated, number = text.partition(sign)
    metric = metric.strip()
    if metric not in metrics:
        raise InputError("", option, f"'{metric[:60]}' is no metric of a run: give {write}, "
                         f"{one_of(metric, metrics)}")
    if not stated:
        raise InputError("", option, f"'{text[:60]}' says no number behind '{sign}': give {write.rstrip(',')}")
    try:
        return metric, float(number)
    except ValueError:
        return metric, math.nan

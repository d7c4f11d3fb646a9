"""What a run does from one event to the next: how far a change throws it off, and what it has settled to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from workbench.simulate.closed_loop import Run


@dataclass(frozen=True)
class Stretch:
    """From one event to the next: the largest |position error|, and the largest in the last seconds before the next."""

    start_s: float
    largest_m: float
    settled_m: float


def stretches(run: Run, times_s: Sequence[float], window_s: float) -> tuple[Stretch, ...]:
    """The stretches between times, in their order, that a run has finished, by the rows of its log.

    window_s: how long before the next event a run counts as settled. A run that fails at an event has not finished.
    """
    time, error = run.column("t_s"), np.abs(run.position_error)
    found = []
    for start, end in pairwise(times_s):
        if end > run.end_s + 1e-9 or (run.failed and end >= run.end_s):
            break
        before = time < end
        found.append(Stretch(start, float(error[(time >= start) & before].max()),
                             float(error[(time >= end - window_s) & before].max())))
    return tuple(found)

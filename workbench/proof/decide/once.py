"""What is worked out of a goal once, however many deciders ask for it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import TypeVar

from workbench.proof.claim import Goal

KEPT = 6  # goals are told apart by identity, so only those in use are worth while

T = TypeVar("T")


def once_per_goal(make: Callable[[Goal], T]) -> Callable[[Goal], T]:
    """The function, its results for the last few goals kept, in each thread its own."""
    local = threading.local()

    @wraps(make)
    def known(goal: Goal) -> T:
        recent: list[tuple[Goal, T]] = local.__dict__.setdefault("recent", [])
        for of, result in recent:
            if of is goal:
                return result
        recent.append((goal, make(goal)))
        del recent[:-KEPT]
        return recent[-1][1]

    return known

"""Goals from the functions that a proof file states; what is wrong with one is said with the claim's id."""

from __future__ import annotations

import inspect
from collections.abc import Callable

from workbench.errors import ClaimError
from workbench.files.mistakes import mistake
from workbench.proof.claim import Claim, Goal


def built(claim: Claim, build: Callable[[], Goal], what: str = "goal") -> Goal:
    """The goal that a function of the claim makes; raises ClaimError, naming the claim, when it makes none."""
    try:
        goal: object = build()
    except ClaimError as trouble:
        raise ClaimError(f"claim {claim.id}: {trouble}") from None
    except Exception as trouble:
        where = getattr(getattr(inspect.unwrap(build), "__code__", None), "co_filename", "")
        raise ClaimError(f"claim {claim.id}: its {what} cannot be made: {mistake(trouble, where)}") from trouble
    if not isinstance(goal, Goal):
        raise ClaimError(f"claim {claim.id}: the function of its {what} returns no Goal: "
                         "end it with 'return Goal(...)'")
    return goal

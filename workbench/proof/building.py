"""Goals from the functions that a proof file states; what is wrong with one is said with the claim's id."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from contextvars import ContextVar

from workbench.errors import FROM_OUTSIDE, ClaimError, InputError
from workbench.files.mistakes import mistake
from workbench.proof.claim import Claim, Goal
from workbench.proof.text import relation_text, text

REFLEXIVE = ("==", "<=", ">=")  # hold between a term and itself
_taken: ContextVar[list[str] | None] = ContextVar("taken", default=None)  # claims of whose relations a goal is made


def take(claim_id: str) -> None:
    """Keep that the goal which is being built takes what this claim shows."""
    if (taken := _taken.get()) is not None:
        taken.append(claim_id)


def built(claim: Claim, build: Callable[[], Goal], what: str = "goal") -> Goal:
    """The goal that a function of the claim makes; raises ClaimError, naming the claim, when it makes none."""
    taken: list[str] = []
    before = _taken.set(taken)
    try:
        goal: object = build()
    except (ClaimError, InputError) as trouble:
        raise ClaimError(f"claim {claim.id}: {trouble}") from None
    except FROM_OUTSIDE:
        raise
    except BaseException as trouble:  # what ends a process too
        where = getattr(getattr(inspect.unwrap(build), "__code__", None), "co_filename", "")
        raise ClaimError(f"claim {claim.id}: its {what} cannot be made: {mistake(trouble, where)}") from trouble
    finally:
        _taken.reset(before)
    if what == "goal" and (unnamed := [one for one in taken if one not in claim.premises]):
        raise ClaimError(f"claim {claim.id}: takes what claim {unnamed[0]} shows, which is none of its premises, so "
                         "that nobody would hear where that one fails: add it to premises")
    if inspect.iscoroutine(goal):
        goal.close()  # of an async function, of which Python would say that nobody awaits it
    if not isinstance(goal, Goal):
        raise ClaimError(f"claim {claim.id}: the function of its {what} returns no Goal: "
                         "end it with 'return Goal(...)'")
    if all(r.operator in REFLEXIVE and text(r.left) == text(r.right) for r in goal.show):
        raise ClaimError(f"claim {claim.id}: its {what} shows {relation_text(goal.show[0])}, the same on both sides, "
                         "which states nothing: write each side as the paper does, from its own definitions")
    return goal

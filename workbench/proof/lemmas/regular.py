"""The hypothesis that functions are defined and continuous everywhere, or Lipschitz on every bounded set."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D, Goal, Relation, at_least, differ, greater
from workbench.proof.lemmas.lemma import Hypothesis
from workbench.proof.lemmas.requirements import Flow, Inputs, jumps_of, moving_symbols, partial_of


def regular(name: str, key: str, title: str, values: Sequence[sp.Expr], flow: Flow, assume: Sequence[Relation],
            inputs: Inputs = (), lipschitz: bool = False) -> tuple[Hypothesis, ...]:
    """That no denominator of what moves is zero, no argument of log not positive and no radicand negative, whatever the
    state is; nothing where there are none. lipschitz: radicands are positive.

    Of what is assumed only what is of inputs and constants counts: an assumption of the state leaves out its border,
    to which the state may come as close as it likes. Raises ClaimError where a value jumps, or is given by a rate.
    """
    moving = moving_symbols(flow) | set(inputs)
    for value in values:
        if value.has(D):
            raise ClaimError(f"{name}: {value} is given by a rate: write it as a function of the state")
    if jumps := jumps_of(values, moving):
        raise ClaimError(f"{name}: {jumps[0]} jumps, and the theorem asks a continuous function")
    shown: dict[Relation, None] = {}
    for value in values:
        for part in sorted(partial_of(value), key=str):
            if part.free_symbols & moving:
                shown |= dict.fromkeys(_asked(part, lipschitz))
    if not shown:
        return ()
    known = tuple(r for r in assume if not (r.left.free_symbols | r.right.free_symbols) & moving_symbols(flow))
    return (Hypothesis(key, title, Goal(tuple(shown), assume=known, inputs=tuple(inputs))),)


def _asked(part: sp.Expr, lipschitz: bool) -> list[Relation]:
    inner = part.args[0]
    if isinstance(part, sp.log):
        return [greater(inner, 0)]
    if isinstance(part, sp.tan):
        return [differ(sp.cos(inner), 0)]
    whole = part.exp.is_Integer
    if not part.exp.is_number:
        return []  # no goal has such a power
    if part.exp < 0:
        return [differ(inner, 0) if whole else greater(inner, 0)]
    return [greater(inner, 0) if lipschitz else at_least(inner, 0)]

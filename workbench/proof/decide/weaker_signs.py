"""Roots of what is positive, proved as roots of what is not negative: then none of them is divided by.

Where something is known to be positive, a combination may divide by its root, and sympy takes sqrt(V)/V for
1/sqrt(V), which is another term to the checker. That V > 0 is assumed shows what V >= 0 does.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from workbench.proof.claim import Goal, Relation


def with_weaker_signs(goal: Goal) -> Goal | None:
    """The goal whose symbols below roots are not known to differ from zero; None where it is the same. Its assumptions
    stand at the same places, each weaker or equal."""
    powers = {power for r in goal.show for side in (r.left, r.right) for power in side.atoms(sp.Pow)
              if power.exp.is_Rational and not power.exp.is_Integer and power.exp > 0}
    below = {s for power in powers for s in power.base.free_symbols
             if s.is_Symbol and s.is_positive and not s.is_integer}
    if not below or goal.flow or goal.initial or goal.always or goal.facts or goal.lemmas:
        return None
    weaker = {s: sp.Symbol(s.name, nonnegative=True) for s in below}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(Relation(r.left.xreplace(weaker), r.operator, r.right.xreplace(weaker)) for r in relations)

    return replace(goal, show=put(goal.show), assume=put(goal.assume),
                   named=tuple(one.xreplace(weaker) for one in goal.named))

"""A proof in two cases, by the sign of an expression."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Relation, at_least, at_most
from workbench.proof.text import text

Proof = dict[str, Any]


def by_sign(of: sp.Expr, find: Callable[[Relation], Proof | None]) -> Proof | None:
    """The proof by the cases of >= 0 and of <= 0, each as it is found with that case given; None where one is not."""
    proof: Proof = {"rule": "cases", "of": text(of)}
    for name, case in (("nonnegative", at_least(of, 0)), ("nonpositive", at_most(of, 0))):
        found = find(case)
        if found is None:
            return None
        proof[name] = found
    return proof

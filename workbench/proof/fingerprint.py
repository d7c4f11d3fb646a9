"""What a claim is known by: a digest of everything that its decision depends on, and of nothing else."""

from __future__ import annotations

import hashlib
import json
from dataclasses import fields, is_dataclass
from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.errors import FROM_OUTSIDE
from workbench.proof.claim import Claim

# Shown beside a verdict, but never looked at to reach it; how a line matches its goal is found anew each time.
NOT_DECIDED_ON = {"title", "printed", "recorded", "premises", "rests_on", "origin", "severity", "match", "reading",
                       "glyph", "mends", "scope", "note", "notation", "letters"}


def fingerprint(claim: Claim) -> str | None:
    """The digest of a claim, goals as its functions build them; None where a part has no exact text.

    Every field counts but those named above, so that a field added to claims or goals is never forgotten.
    """
    parts = {f.name: getattr(claim, f.name) for f in fields(claim) if f.name not in NOT_DECIDED_ON}
    try:
        exact = {name: _exact(part() if callable(part) and not isinstance(part, sp.Basic) else part)
                 for name, part in parts.items()}
    except FROM_OUTSIDE:
        raise
    except BaseException:  # what is wrong with a function is for the decision to say, if it comes to need it
        return None
    return hashlib.sha256(json.dumps(exact, sort_keys=True).encode()).hexdigest()


def _exact(value: Any) -> Any:
    """A value as JSON that no other value has; the order within maps stays, as deciders may follow it."""
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, Fraction):
        return ["rational", str(value)]
    if isinstance(value, sp.Basic):
        if value.atoms(sp.Dummy):
            raise TypeError(f"{value} holds a symbol that is another one in every process")
        return ["expression", sp.srepr(value)]
    if isinstance(value, (tuple, list)):
        return ["list", *map(_exact, value)]
    if isinstance(value, dict):
        return ["map", *([_exact(k), _exact(v)] for k, v in value.items())]
    if is_dataclass(value):
        return [type(value).__name__, *([f.name, _exact(getattr(value, f.name))] for f in fields(value))]
    raise TypeError(f"{type(value).__name__} has no exact text")

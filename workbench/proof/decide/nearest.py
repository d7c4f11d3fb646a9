"""What came nearest where nothing was decided: the smallest margin that floating point found, and where."""

from __future__ import annotations

import random

import numpy as np

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, name_of
from workbench.proof.decide.boundary_points import families
from workbench.proof.decide.landscape import Landscape, Numbers, landscape_of
from workbench.proof.decide.local_search import local_search
from workbench.proof.decide.sampling import tidy_fraction, trial_columns

FAMILIES, POINTS, MOST_NAMES = 4, 600, 12


def smallest_margin(goal: Goal, seed: int = 1) -> str:
    """One sentence: the smallest margin, relative to the terms it is made of, among points that meet the assumptions.

    It says where to look, and decides nothing.
    """
    try:
        landscape = landscape_of(goal.evaluated())
    except ClaimError:
        return "no point could be tried"
    rng, best = np.random.default_rng(seed), None
    for family in families(landscape, random.Random(seed), FAMILIES):
        for chosen in (trial_columns(family.free, POINTS, rng), local_search(landscape, family, True, rng)):
            if not chosen and family.free:
                continue
            columns = family.columns(chosen)
            found = _tightest(landscape, columns)
            if found is not None and (best is None or found[0] < best[0]):
                best = found
    if best is None:
        return "no point was found that meets all assumptions"
    names = [name_of(s) for s in goal.symbols()]
    point = ", ".join(f"{name} = {_short(value)}" for name, value in zip(names[:MOST_NAMES], best[1], strict=False))
    return f"the smallest relative margin found is {best[0]:.2g}" + (f", at {point}" if point else "")


def _tightest(landscape: Landscape, columns: list[Numbers]) -> tuple[float, list[float]] | None:
    """The smallest margin, and its point, among those given that meet the assumptions."""
    violation, excess = landscape.look(columns)
    rows = np.flatnonzero((violation == 0) & np.isfinite(excess))
    if not len(rows):
        return None
    row = rows[np.argmax(excess[rows])]
    return -float(excess[row]), [float(np.broadcast_to(c, violation.shape)[row]) for c in columns]


def _short(value: float) -> str:
    exact = str(tidy_fraction(value))
    return exact if len(exact) <= 8 else f"{value:.4g}"

"""What a cone program may know of a force limit that is a table: functions of the speed that lie above it."""

from __future__ import annotations

from functools import cache

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.force_pieces import force_pieces
from workbench.optimal.profile import largest_force
from workbench.optimal.vehicle import ForceLimit

# Speeds at which functions are held above the limit, as shares of the highest one beside those where the limit
# bends.
SLOWEST, SAMPLES, EVEN_RATIOS = 5e-3, 45, 25
# So near to the best function at every speed, as a share of the force there, does the least of those taken come.
NEAR = 2e-4
# Above every force, and what is as good as none, in units of the largest.
HIGH, LOW = 2.0, 1e-2

# alpha + beta / v + gamma v + delta v^2 in N, v in m/s.
Majorant = tuple[float, float, float, float]


@cache
def majorants(limit: ForceLimit, top_mps: float) -> tuple[Majorant, ...]:
    """Functions above the limit at speeds up to top_mps, of which the least is nearly as low as any such function.

    A program that relaxes 1/v from below and v from above may use no others: beta is not negative, gamma not positive.
    Each is the least at one of the sampled speeds, by a linear program. None for a limit without a table.
    """
    if not limit.table:
        return ()
    borders = [piece.high_mps / top_mps for piece in force_pieces(limit, top_mps)]
    share = np.unique(np.clip([*np.linspace(0.0, 1.0, SAMPLES), *np.geomspace(SLOWEST, 1.0, EVEN_RATIOS), *borders],
                              SLOWEST, 1.0))
    force = largest_force(limit, share * top_mps)
    terms = np.stack([np.ones_like(share), 1 / share, share, share**2], axis=1)
    scale = float(force.max()) or 1.0
    found = np.array([_least(terms, force / scale, row) for row in terms])
    values = terms @ found.T  # of each function at each speed
    best, least = np.diag(values), np.full(len(share), HIGH)
    chosen: list[int] = []
    while np.max(apart := (least - best) / np.maximum(best, LOW)) > NEAR:
        chosen.append(int(np.argmax(apart)))
        least = np.minimum(least, values[:, chosen[-1]])
    return tuple((float(a * scale), float(b * scale * top_mps), float(c * scale / top_mps),
                  float(d * scale / top_mps**2)) for a, b, c, d in found[chosen])


def _least(terms: Array, force: Array, at: Array) -> Array:
    """Coefficients of the function above the force everywhere that is least where its terms have the values `at`."""
    from scipy.optimize import linprog  # noqa: PLC0415 - which most trains do without

    return np.asarray(linprog(at, A_ub=-terms, b_ub=-force,
                              bounds=[(None, None), (0, None), (None, 0), (None, None)]).x)

"""A finer mesh where a plan lies apart from its bound, or from the run that is driven."""

from __future__ import annotations

import numpy as np

from workbench.optimal.bound import cell_bounds
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array
from workbench.optimal.grid import Grid, grid_on, kept_borders, with_force_borders
from workbench.optimal.profile import Profile, cell_energy_j, largest_force
from workbench.optimal.socp import Plan
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# Intervals that a finer mesh has more, as a share: at least, where nothing is known of the gap, and at most.
LEAST_GROWTH, GROWTH, MOST_GROWTH = 0.3, 0.7, 3.0
# A finer mesh aims at this share of the gap wanted.
AIM = 0.8
# Where p changes by more than this share from one interval to the next, none is so many times as long as its neighbour:
# p falls by what the longer one has, and the bound loses it on the shorter one.
P_CHANGE, LONGER, GRADINGS = 0.02, 2.5, 8
# Intervals are not divided into shorter ones, or where the speed stays below this share of the fastest: the cone
# program's numbers would lie too far apart, and next to a standstill its dual gives p on an interval of any length.
SHORTEST_M, SLOW = 1e-3, 0.02
_GAUSS = (0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6)


def slack(vehicle: Vehicle, plan: Plan, certificate: Certificate) -> Array:
    """By how much each interval's part of the plan's own cost lies above its part of the bound, J, shape (n,)."""
    grid, x = plan.grid, certificate.position_m
    price = certificate.cell_prices_w(plan.timetable)
    h = np.diff(x)
    owner = np.searchsorted(grid.position_m, (x[1:] + x[:-1]) / 2) - 1
    b = np.interp(x, grid.position_m, plan.half_square)
    u = plan.force_n[owner]
    cost = _cost(vehicle, plan)[owner]
    a, b_1, c = vehicle.davis_n
    own = np.zeros(len(h))
    for share in _GAUSS:
        half_square = np.maximum(b[:-1] + share * np.diff(b), 1e-12)
        v = np.sqrt(2 * half_square)
        p = certificate.left + share * (certificate.right - certificate.left)
        resistance = davis_resistance(v, a, b_1, c + grid.drag[owner])
        own += h / 2 * (cost + price / v + p * (resistance - u)
                        - vehicle.inertia_kg * (certificate.right - certificate.left) / h * half_square)
    above = np.maximum(own - cell_bounds(vehicle, grid.course, certificate, plan.timetable), 0.0)
    return np.asarray(np.bincount(owner, weights=above, minlength=len(plan.force_n)), dtype=float)


def _cost(vehicle: Vehicle, plan: Plan) -> Array:
    """What the plan's force takes at the supply on each interval, J/m: of braking what its mean speed lets return."""
    speed, u = np.sqrt(2 * plan.half_square), plan.force_n
    electric = largest_force(vehicle.regenerative, (speed[1:] + speed[:-1]) / 2)
    return np.where(u > 0, u / vehicle.traction_efficiency,
                    vehicle.regenerative_efficiency * np.maximum(u, -electric))


def driven_apart(vehicle: Vehicle, plan: Plan, run: Profile) -> Array:
    """By how much each interval takes more or less of the run than of the plan, in energy and priced time, J."""
    s, h, u = plan.grid.position_m, plan.grid.step_m, plan.force_n
    owner = np.clip(np.searchsorted(s, (run.position_m[1:] + run.position_m[:-1]) / 2) - 1, 0, len(u) - 1)
    speed = np.sqrt(2 * plan.half_square)
    planned = h * _cost(vehicle, plan)
    price = plan.interval_prices_w
    planned += price * 2 * h / (speed[1:] + speed[:-1])
    driven = cell_energy_j(vehicle, run) + price[owner] * np.diff(run.time_s)
    return np.abs(np.bincount(owner, weights=driven, minlength=len(u)) - planned)


def growth(gap: float, wanted: float) -> float:
    """By which share more intervals lead from a gap to the one wanted.

    With even intervals a gap is about as their length squared. Where they are put by what is apart it falls faster: as
    the third power, measured on lines by chance.
    """
    if not np.isfinite(gap):
        return GROWTH
    return float(np.clip(np.cbrt(gap / (AIM * wanted)) - 1, LEAST_GROWTH, MOST_GROWTH))


def finer_grid(vehicle: Vehicle, plan: Plan, certificate: Certificate, run: Profile, more: float = GROWTH) -> Grid:
    """The plan's mesh with intervals divided in proportion to the root of what is apart, by the share `more` in all."""
    s, count = plan.grid.position_m, len(plan.force_n)
    b = plan.half_square
    divisible = np.maximum(b[1:], b[:-1]) > SLOW**2 * b.max()
    weight = np.sqrt(slack(vehicle, plan, certificate) + driven_apart(vehicle, plan, run)) * divisible
    weight /= max(float(weight.sum()), 1e-300)
    # What rounding leaves is carried on, so that slack that is spread evenly makes a finer mesh too. Halves go up, also
    # where the last digit of the sum is a little lower.
    parts = 1 + np.diff(np.floor(np.cumsum(more * count * weight) + 0.5 + 1e-9), prepend=0.0).astype(int)
    parts = np.clip(parts, 1, np.maximum(plan.grid.step_m // SHORTEST_M, 1).astype(int))
    of = np.repeat(np.arange(count), parts)
    number = np.arange(len(of)) - np.repeat(np.cumsum(parts) - parts, parts)
    nodes = np.append(s[of] + number * (plan.grid.step_m / parts)[of], s[-1])
    course = plan.grid.course
    return grid_on(course, with_force_borders(course, _graded(plan, nodes), kept_borders(course)))


def _graded(plan: Plan, nodes: Array) -> Array:
    """Nodes with more of them where p changes and a long interval meets a short one, on its side."""
    p, s = plan.adjoint, plan.grid.position_m
    turns = np.abs(np.diff(p)) > P_CHANGE * np.maximum(1.0, np.abs(p[1:]))
    changes = np.append(turns, False) | np.insert(turns, 0, False)
    for _ in range(GRADINGS):
        h = np.diff(nodes)
        owner = np.clip(np.searchsorted(s, (nodes[1:] + nodes[:-1]) / 2) - 1, 0, len(p) - 1)
        before, after = np.insert(h[:-1], 0, np.inf), np.append(h[1:], np.inf)
        short = np.minimum(before, after)
        long = (h > LONGER * short) & (h > SHORTEST_M) & changes[owner]
        if not long.any():
            break
        # The part beside the short interval is half as long again.
        between = np.where(after < before, nodes[1:] - 1.5 * short, nodes[:-1] + 1.5 * short)
        nodes = np.union1d(nodes, between[long])
    return nodes

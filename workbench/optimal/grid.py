"""The mesh of a run: fine where a train starts, stops or meets another limit, and what holds on its intervals."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array, Course

# Distances over which a stop and a change of the limit ask for shorter intervals, and how many they ask for.
STOP_REACH_M, STOP_WEIGHT = 2500.0, 0.5
CHANGE_REACH_M, CHANGE_WEIGHT = 1500.0, 0.15
# Between two borders that every mesh has.
LEAST_INTERVALS = 3
# A node of another mesh is left out where it lies nearer to a border than this share of its distance to its neighbours.
NEAR_BORDER = 0.3
# By which share a mean over an interval may differ between courses that are the same.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Grid:
    """A course on a mesh of n intervals.

    position_m: shape (n + 1,). node_limit_mps: shape (n + 1,), the lower limit of both sides, or that of a point;
    node_least_mps: shape (n + 1,), what a point asks at least. limit_mps, force_n and drag: shape (n,), of the
    intervals, the last two as means over each. stands: shape (n + 1,), true at inner stops.
    """

    course: Course
    position_m: Array
    node_limit_mps: Array
    node_least_mps: Array
    limit_mps: Array
    force_n: Array
    drag: Array
    stands: NDArray[np.bool_]

    @property
    def step_m(self) -> Array:
        """Lengths of the intervals."""
        return np.diff(self.position_m)

    def is_like(self, other: Grid) -> bool:
        """Whether plans know no difference: the same nodes, limits and stops, and forces and drag but for rounding."""
        exact = ((self.position_m, other.position_m), (self.node_limit_mps, other.node_limit_mps),
                 (self.node_least_mps, other.node_least_mps), (self.limit_mps, other.limit_mps),
                 (self.stands, other.stands))
        near = ((self.force_n, other.force_n), (self.drag, other.drag))
        return all(np.array_equal(one, two) for one, two in exact) and all(
            np.allclose(one, two, rtol=ROUNDING, atol=ROUNDING * float(np.abs(one).max())) for one, two in near)


def kept_borders(course: Course) -> Array:
    """Positions that every mesh of the course has: ends, stops, points, and where the limit or the drag changes."""
    limit_changes = np.diff(course.limit_mps) != 0
    drag_changes = np.any(np.diff(course.drag, axis=0) != 0, axis=1) | (course.drag[:-1, 1] != course.drag[1:, 0])
    inner = course.position_m[1:-1]
    points = [point.position_m for point in course.points]
    return np.unique(np.concatenate((course.position_m[[0, -1]], inner[limit_changes | drag_changes], course.stops_m,
                                     points)))


def grid_on(course: Course, position_m: Array) -> Grid:
    """The course on given positions, which must hold every one of `kept_borders`."""
    fine = course.split(position_m[1:-1])
    owner = np.searchsorted(position_m, (fine.position_m[1:] + fine.position_m[:-1]) / 2) - 1
    width, count = np.diff(fine.position_m), len(position_m) - 1

    def mean(ends: Array) -> Array:
        total = np.bincount(owner, weights=ends.mean(axis=1) * width, minlength=count)
        return np.asarray(total / np.diff(position_m))

    limit = np.full(count, np.inf)
    np.minimum.at(limit, owner, fine.limit_mps)
    node = np.minimum(np.append(limit, np.inf), np.insert(limit, 0, np.inf))
    stands = np.isin(position_m, course.stops_m)
    least, most = course.speed_windows_mps(position_m)
    return Grid(course, position_m, np.where(stands, node, np.minimum(node, most)), least, limit, mean(fine.force_n),
                mean(fine.drag), stands)


def graded_grid(course: Course, intervals: int) -> Grid:
    """About `intervals` intervals: short near stops, where 1/v is large, and near changes of the limit.

    Borders of the line's force are nodes too unless they crowd; the mean force of an interval is exact either way.
    """
    start, end = course.position_m[[0, -1]]
    kept = kept_borders(course)
    stops = np.concatenate(([start], course.stops_m, [end]))
    changes = course.position_m[1:-1][np.diff(course.limit_mps) != 0]
    reach = np.geomspace(0.01, STOP_REACH_M, 300)
    near = np.concatenate([stop + sign * reach for stop in stops for sign in (-1, 1)])
    sample = np.unique(np.concatenate((kept, np.linspace(start, end, 2001), near[(near > start) & (near < end)],
                                       _around(changes, CHANGE_REACH_M, start, end))))
    middle = (sample[1:] + sample[:-1]) / 2
    density = np.full(len(middle), 1.0 / (end - start))
    for stop in stops:
        distance = np.abs(middle - stop)
        scale = min(STOP_REACH_M, (end - start) / 2)
        density += np.where(distance < scale, STOP_WEIGHT / (2 * np.sqrt(scale * (distance + 1e-5 * scale))), 0.0)
    for change in changes:
        density += np.where(np.abs(middle - change) < CHANGE_REACH_M, CHANGE_WEIGHT / CHANGE_REACH_M, 0.0)
    share = np.insert(np.cumsum(density * np.diff(sample)), 0, 0.0)
    share *= intervals / share[-1]
    return shared_out(course, kept, sample, share)


def grid_near(course: Course, nodes: Array) -> Grid:
    """A mesh on the nodes of a mesh of nearly this course, with the borders that this one keeps."""
    kept = kept_borders(course)
    free = nodes[(nodes > kept[0]) & (nodes < kept[-1]) & ~np.isin(nodes, kept)]
    gap = np.searchsorted(kept, free) - 1
    off = np.minimum(free - kept[gap], kept[gap + 1] - free)
    step = np.diff(free, prepend=-np.inf, append=np.inf)
    well = off > NEAR_BORDER * np.minimum(step[1:], step[:-1])
    free, gap = free[well], gap[well]
    few = np.flatnonzero(np.bincount(gap, minlength=len(kept) - 1) < LEAST_INTERVALS - 1)
    evenly = np.arange(1, LEAST_INTERVALS) / LEAST_INTERVALS
    added = (kept[few, None] + np.diff(kept)[few, None] * evenly).ravel()
    return grid_on(course, np.unique(np.concatenate((kept, free[~np.isin(gap, few)], added))))


def shared_out(course: Course, kept: Array, sample: Array, share: Array) -> Grid:
    """A mesh between the borders that are kept, whose intervals begin where `share`, the count of them up to each
    place of `sample`, is a whole number from one kept border on."""
    nodes = [kept[:1]]
    for low, high in pairwise(kept):
        first, last = np.interp([low, high], sample, share)
        count = max(LEAST_INTERVALS, round(last - first))
        nodes.append(np.append(np.interp(np.linspace(first, last, count + 1)[1:-1], share, sample), high))
    return grid_on(course, with_force_borders(course, np.concatenate(nodes), kept))


def _around(centers: Array, reach: float, start: float, end: float) -> Array:
    points = np.concatenate([centers - reach, centers + reach])
    return points[(points > start) & (points < end)]


def with_force_borders(course: Course, nodes: Array, kept: Array) -> Array:
    """Move the nearest free node onto each border of the line's force that stands well apart from the others."""
    return np.asarray(_moved(nodes, ~np.isin(nodes, kept), course.position_m))


@compiled()
def _moved(nodes: Array, free: NDArray[np.bool_], borders: Array) -> Array:
    """Each move changes what lies near the next border, so that they are made one after the other."""
    moved, movable = nodes.copy(), free.copy()
    for i in range(1, len(borders) - 1):
        border, k, high = borders[i], 0, len(moved)
        while k < high:  # as np.searchsorted, which takes long to compile
            middle = (k + high) // 2
            if moved[middle] < border:
                k = middle + 1
            else:
                high = middle
        k = min(max(k, 1), len(moved) - 1)
        near = k if moved[k] - border < border - moved[k - 1] else k - 1
        if movable[near] and moved[near - 1] < border < moved[near + 1]:
            room = min(border - moved[near - 1], moved[near + 1] - border)
            if room > 0.3 * min(moved[near] - moved[near - 1], moved[near + 1] - moved[near]):
                moved[near], movable[near] = border, False
    return moved

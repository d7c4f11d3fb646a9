"""The bound of a timetable against every run that can be driven, and its certificate against tampering."""

import copy
from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from optimal_instances import courses, numbers, random_runs, vehicles
from test_optimal_bound import own_energy
from test_optimal_timetable import COURSE, END_M, MIDDLE_M, TRAIN, by, free_s

from workbench.optimal.bound import lower_bound
from workbench.optimal.bound_checker import checked_bound, proven_bound
from workbench.optimal.bound_document import bound_document
from workbench.optimal.certificate import Certificate
from workbench.optimal.grid import kept_borders
from workbench.optimal.reference import find_timed_reference
from workbench.optimal.timetable import TOUCH_S, Timetable, TimingPoint, Window


@cache
def best(shift_s, limit, speed_mps):
    """The best run in a window that moves it by shift_s, with a limit of its speed there."""
    at = free_s() + shift_s
    timetable = by(Window(latest_s=at) if shift_s < 0 else Window(at), **{limit: speed_mps})
    return find_timed_reference(TRAIN, COURSE, timetable), timetable


@pytest.mark.parametrize("asked", [(-20.0, "fastest_mps", 20.0), (20.0, "fastest_mps", 20.0),
                                   (-20.0, "slowest_mps", 27.0)], ids=str)
@pytest.mark.parametrize("size", [0.0, 1e-3, 1e-2, 0.1])
def test_certificates_near_the_best_one_prove_no_more_than_the_run_takes(asked, size):
    """There a bound is nearly sharp, so that a wrong term would show; with cells that cross the timing point too."""
    found, timetable = best(*asked)
    certified, rng = found.certificate, np.random.default_rng(7)
    assert (found.energy_j - found.lower_bound_j) < 1e-3 * found.energy_j
    for _ in range(20):
        noise = rng.normal(0.0, size, (2, len(certified.left)))
        prices = timetable.fair(certified.prices_w(timetable) * (1 + rng.normal(0.0, size / 10, 3)))
        near = replace(certified, left=certified.left + noise[0], right=certified.right + noise[1],
                       time_price_w=float(prices[-1]), window_prices_w=tuple(prices[:-1].tolist()))
        middle = int(np.searchsorted(near.position_m, MIDDLE_M))
        across = replace(near, position_m=np.delete(near.position_m, middle), left=np.delete(near.left, middle),
                         right=np.delete(near.right, middle - 1))
        own, tolerance = own_energy(TRAIN, found.profile)
        for certificate in (near, across):
            bound = lower_bound(TRAIN, timetable.on(COURSE), certificate, timetable)
            assert bound <= own + tolerance + TOUCH_S * float(np.abs(prices).sum())


@settings(max_examples=60)
@given(vehicles(), courses(4), st.data(), st.integers(0, 2**31))
def test_no_run_that_meets_the_windows_takes_less_than_any_certificate_proves(vehicle, course, data, seed):
    """Windows are put around the times of a run; prices, p and cells are arbitrary, and cells may cross the points."""
    runs = random_runs(vehicle, course, seed, 6)
    if not runs:
        return
    length = float(course.position_m[-1])
    inner = sorted({round(x, 2) for x in data.draw(st.lists(numbers(30.0, length - 30.0), min_size=1, max_size=3))})
    inner = [x for k, x in enumerate(inner) if k == 0 or x - inner[k - 1] > 1]
    positions = kept_borders(course)
    left, right = (np.array([data.draw(numbers(-0.7, 2.5)) for _ in positions[1:]]) for _ in range(2))
    for run in runs:
        rng = np.random.default_rng(seed)
        origin, wait = rng.uniform(0, 100, 2)
        def at(x, run=run):
            b = np.interp(x, run.position_m, run.half_square)
            k = np.clip(np.searchsorted(run.position_m, x) - 1, 0, len(run.time_s) - 2)
            return run.time_s[k] + 2 * (x - run.position_m[k]) / (np.sqrt(2 * b) + run.speed_mps[k]), np.sqrt(2 * b)

        points = []
        for x in inner:
            time, speed = at(x)
            early, late, low, high = rng.uniform(0, 30, 4) * rng.integers(0, 2, 4)
            points.append(TimingPoint(x, Window(origin + wait + time - early, origin + wait + time + late),
                                      slowest_mps=max(speed - low, 0.0), fastest_mps=speed + high + 1e-9))
        timetable = Timetable((TimingPoint(0.0, departure=Window(origin, origin + wait)), *points,
                               TimingPoint(length, arrival=Window(latest_s=origin + wait + run.trip_time_s))))
        levels = np.array([data.draw(st.sampled_from([0.0, 2e4, 3e5, 2e6])) for _ in timetable.events])
        *earlier, last = (-np.diff(np.append(levels, 0.0))).tolist()
        extra = np.unique(np.concatenate((positions, [p.position_m for p in points]))) if seed % 2 else positions
        owner = np.clip(np.searchsorted(positions, extra[:-1], side="right") - 1, 0, len(left) - 1)
        certificate = Certificate(extra, left[owner], right[owner], last, tuple(earlier))
        bound = lower_bound(vehicle, timetable.on(course), certificate, timetable)
        energy, tolerance = own_energy(vehicle, run)
        assert bound <= energy + tolerance + 1e-9 * float(np.abs(levels).sum()) * (200 + run.trip_time_s)


def test_waits_that_pay_prove_nothing_nor_do_prices_without_a_limit():
    """A second of waiting must not be worth less than nothing; a price needs a limit on its side."""
    def proves(departure: Window, *prices: float) -> bool:
        stop = TimingPoint(MIDDLE_M, Window(100.0, 330.0), departure, stands=True)
        timetable = Timetable((TimingPoint(0.0, departure=Window(0.0, 50.0)), stop,
                               TimingPoint(END_M, arrival=Window(600.0, 760.0))))
        course = timetable.on(COURSE)
        x = kept_borders(course)
        certificate = Certificate(x, np.zeros(len(x) - 1), np.zeros(len(x) - 1), 1e5, prices)
        return bool(np.isfinite(lower_bound(TRAIN, course, certificate, timetable)))

    both = Window(350.0, 420.0)
    assert proves(both, 0.0, 1e5, 0.0) and proves(both, 0.0, 0.0, -1e5) and proves(both, -2e5, 1e5, 0.0)
    assert not proves(both, 0.0, 3e5, -2e5), "at the stop"
    assert not proves(both, -3e5, 1e5, 0.0), "at the start"
    assert not proves(Window(latest_s=420.0), 0.0, 0.0, -1e5), "no earliest departure"


DOCUMENT: dict = {}


def document() -> dict:
    if not DOCUMENT:
        timetable = by(Window(free_s() - 30, free_s() - 20), fastest_mps=20.0)
        found = find_timed_reference(TRAIN, COURSE, timetable, intervals=30)
        DOCUMENT.update(bound_document(TRAIN, COURSE, found, 0.0, 0.0))
        assert DOCUMENT["lower_bound_J"] == pytest.approx(found.lower_bound_j, rel=1e-6)
    return copy.deepcopy(DOCUMENT)


TAMPERING = {
    "a later latest time": lambda d: d["events"][1].__setitem__("latest_s", d["events"][1]["latest_s"] + 1),
    "another arrival": lambda d: d["events"][-1].__setitem__("latest_s", d["events"][-1]["latest_s"] + 1),
    "a smaller price": lambda d: d["events"][1].__setitem__("price_w", 0.5 * d["events"][1]["price_w"]),
    "a negative level": lambda d: d["events"][-1].__setitem__("price_w", -1.0),
    "no such limit": lambda d: d["events"][1].__setitem__("latest_s", None),
    "a point elsewhere": lambda d: d["events"][1].__setitem__("position_m", 2000.0),
    "a waiting that is none": lambda d: d["events"][1].__setitem__("dwell_s", 10.0),
    "cells that end elsewhere": lambda d: d["p"]["position_m"].__setitem__(-1, d["p"]["position_m"][-1] + 1.0),
    "stated prices of cells": lambda d: d.__setitem__("cell_price_w", [1e9]),
    "a jump": lambda d: d["p"]["right"].__setitem__(0, d["p"]["right"][0] - 1.0),
}


@pytest.mark.parametrize("name", TAMPERING)
def test_a_tampered_certificate_is_refused(name):
    made = document()
    TAMPERING[name](made)
    with pytest.raises((ValueError, TypeError)):
        proven_bound(made)


def test_the_untouched_certificate_proves_its_bound_and_without_its_run_it_proves_none():
    made = document()
    assert checked_bound(made) >= Fraction(made["lower_bound_J"])
    for name in ("run", "train", "p", "events", "origin_s", "digests"):
        with pytest.raises((ValueError, KeyError)):
            checked_bound({key: value for key, value in made.items() if key != name})
    with pytest.raises(ValueError, match="version 3, not 4: write it again"):
        checked_bound(made | {"version": 3})

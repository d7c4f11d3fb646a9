"""No forged bound is accepted: more than the run, its numbers and its file can bear is refused or proves less."""

import copy
import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.optimal.bound_checker import checked_bound, main, stated_digests
from workbench.optimal.bound_document import bound_document, digests
from workbench.optimal.course import Course
from workbench.optimal.reference import find_reference, least_time
from workbench.optimal.timetable import as_timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("regenerating", 3e5, (4e3, 80.0, 9.0), ForceLimit(2e5, 2.2e6), ForceLimit(1.2e5, 2.5e6), 2e5,
                rotating_fraction=0.06, traction_efficiency=0.85, regenerative_efficiency=0.7)
FORCE = np.array([[0.0, 0.0], [1.5e4, 1.5e4], [0.0, 0.0]])
COURSE = Course(np.array([0.0, 1600.0, 2800.0, 4000.0]), np.array([30.0, 24.0, 30.0]), FORCE, np.zeros((3, 2)))
REFUSALS = (ValueError, KeyError, IndexError, TypeError, OverflowError, ZeroDivisionError, AttributeError)


@cache
def found():
    return find_reference(TRAIN, COURSE, made_for(), intervals=12)


@cache
def genuine():
    return json.dumps(bound_document(TRAIN, COURSE, found(), 0.0, 0.0))


def document():
    return json.loads(genuine())


def put(*way_and_value):
    """A change that puts a value at a place, or what a function makes of the one there."""
    *way, last, value = way_and_value

    def change(made):
        part = made
        for key in way:
            part = part[key]
        part[last] = value(part[last]) if callable(value) else value
    return change


def drop(*way):
    def change(made):
        part = made
        for key in way[:-1]:
            part = part[key]
        del part[way[-1]]
    return change


def both(*changes):
    def change(made):
        for one in changes:
            one(made)
    return change


def more(by):
    return lambda value: value + by


def claims(part, by=1e6):
    """A part of the bound raised, and the whole with it."""
    return both(put(part, more(by)), put("fixed_j", more(by)))


def added(name, value):
    """A part that no certificate has, as older ones had and took on trust."""
    return put(name, value)


def of_p(change):
    """Both sides of p, changed together: by a function of the number of a cell and of its value."""
    def changed(values):
        return [change(number, value) for number, value in enumerate(values)]
    return both(put("p", "left", changed), put("p", "right", changed))


FORGED = {
    "sides of p swapped": lambda made: made["p"].update(left=made["p"]["right"], right=made["p"]["left"]),
    "p too high": of_p(lambda _, value: value + 1.0), "p too low": of_p(lambda _, value: value - 1.0),
    "p a saw": of_p(lambda cell, value: value + 0.5 * (-1)**cell),
    "p a fine saw": of_p(lambda cell, value: value + 1e-6 * (-1)**cell), "p mirrored": of_p(lambda _, value: 1 - value),
    "p of the start everywhere": of_p(lambda *_: 1.0), "p nested": put("p", "left", 0, [1.0]),
    "p as an object": put("p", "left", {"0": 1.0}), "true as p": put("p", "left", 0, True),
    "false as p": put("p", "right", -1, False), "true as a price": put("events", -1, "price_w", True),
    "true as the origin": put("origin_s", True), "a text as a border": put("p", "position_m", 1, "100.0"),
    "a border twice": put("p", "position_m", lambda v: [v[0], v[1], v[1], *v[2:]]),
    "a part of p": put("p", "fixed_j", 1e12), "a part of p without a name": put("p", "", [1e12]),
    "all price at the departure": both(put("events", 0, "price_w", 5e4), put("events", -1, "price_w", more(-5e4))),
    "a price of nothing": put("events", -1, "price_w", 0.0), "twice the price": put(
        "events", -1, "price_w", lambda price: 2 * price),
    "the departure twice": put("events", lambda v: [v[0], *v]), "the arrival twice": put(
        "events", lambda v: [*v, v[-1]]), "events in another order": put("events", lambda v: v[::-1]),
    "an arrival without its price": drop("events", -1, "price_w"), "auxiliaries of nothing": put("auxiliary_w", None),
    "a twin of the bound": put("lower_bound_j", 1e12), "a digest in capitals": put("digests", "line", str.upper),
    "a digest more": put("digests", "more", "0" * 64), "a point of nothing": put("run", "points", [[]]),
    "nothing but a number": lambda made: made.update({"p": {key: [] for key in made["p"]}, "lower_bound_J": 1e12}),
    "no events": drop("events"), "no run": drop("run"), "no p": drop("p"), "no train": drop("train"),
    "a version of bounds without a line": put("version", 1), "the version whose terms were stated": put("version", 3),
    "a later version": put("version", 5), "no version": drop("version"), "a version as a text": put("version", "4"),
    "a fixed part": added("fixed_j", 1e12), "a line's part": added("line_j", 1e12),
    "an ends' part": added("ends_j", 1e9),
    "stated terms": added("terms", {"cell": [0], "end": [0], "low": [0.0], "high": [30.0], "value": [1e9]}),
    "stated prices of cells": added("cell_price_w", [1e9]), "stated jumps": added("jumps", {"fastest_mps": [0.0]}),
    "stated lengths": added("cell_m", [1e9]), "stated limits": added("limit_mps", [1.0]),
    "a part without a name": added("", 1.0),
    "a text that is a number of thirty million digits": put("lower_bound_J", "1e30000000"),
    "such a text in a train": put("train", "auxiliary_w", "1e30000000"), "a text in p": put("p", "left", 0, "1e5"),
    "a limit in km/h": put("run", "limit_mps", 0, 108.0 * 3.6), "a limit of zero": put("run", "limit_mps", 0, 0.0),
    "a negative limit": put("run", "limit_mps", 1, -24.0),
    "a cell before the start": put("p", "position_m", 0, -100.0),
    "a cell from behind the start": put("p", "position_m", 0, 1e-3),
    "a cell beyond the end": put("p", "position_m", -1, 5000.0),
    "a cell that ends before the end": put("p", "position_m", -1, more(-1e-3)),
    "a run that starts elsewhere": put("run", "position_m", 0, -50.0),
    "a run that ends elsewhere": put("run", "position_m", 3, 5000.0),
    "cells of no length": put("p", "position_m", lambda v: [v[0], v[0], *v[2:]]),
    "borders of p in another order": put("p", "position_m", lambda v: [v[0], *v[1:-1][::-1], v[-1]]),
    "borders of nothing": put("p", "position_m", []), "one border": put("p", "position_m", lambda v: v[:1]),
    "a border less": put("p", "position_m", lambda v: v[:-1]), "a border more": put("p", "position_m",
                                                                                  lambda v: [*v, v[-1] + 1.0]),
    "infinite borders": put("p", "position_m", -1, float("inf")), "a border that is none":
    put("p", "position_m", 1, float("nan")), "p that is none": put("p", "left", 0, float("nan")),
    "infinite p": put("p", "right", 0, float("inf")), "huge p": put("p", "right", 0, 1e300),
    "p as large as may be": put("p", "left", lambda v: [9e17] * len(v)),
    "p that rises at every border": put("p", "left", lambda v: [x - 5.0 for x in v]),
    "p that falls at every border": put("p", "left", lambda v: [x + 5.0 for x in v]),
    "p with its sign turned": both(put("p", "left", lambda v: [-x for x in v]),
                                   put("p", "right", lambda v: [-x for x in v])),
    "p of one side": put("p", "left", lambda value: value[:-1]),
    "another p": put("p", "left", lambda v: [0.0] * len(v)),
    "p as pairs": put("p", "left", lambda v: [[x, x] for x in v]), "no right side": drop("p", "right"),
    "two cells merged over a limit": both(put("p", "position_m", lambda v: [v[0], v[-1]]), put(
        "p", "left", lambda v: v[:1]), put("p", "right", lambda v: v[-1:])),
    "borders in another order": put("run", "position_m", lambda value: value[::-1]),
    "a section less": put("run", "limit_mps", lambda value: value[:-1]), "no sections": put("run", "limit_mps", []),
    "a force less": put("run", "force_n", lambda value: value[:-1]),
    "a drag less": put("run", "drag", lambda v: v[:-1]),
    "a force of one end": put("run", "force_n", 0, [0.0]), "a negative drag": put("run", "drag", 0, [-50.0, -50.0]),
    "a drag that bends along cells": put("run", "drag", 1, [0.0, 1e3]),
    "no inertia": put("run", "inertia_kg", 0.0), "negative inertia": put("run", "inertia_kg", -3e5),
    "a start in motion that is not": put("run", "start_mps", -1.0), "an end beyond speed": put("run", "end_mps", 1e5),
    "a line of another grade": put("run", "force_n", lambda v: [[-2e4, -2e4]] * len(v)),
    "a huge number": put("lower_bound_J", 10**400), "a number that a fraction takes long for":
    put("events", -1, "price_w", 1e-300), "null": put("origin_s", None), "text": put("origin_s", "1e999"),
    "a much higher price of time": put("events", -1, "price_w", lambda price: 10 * price),
    "an event before": put("events", -1, "position_m", -4000.0),
    "a last event before the end": put("events", -1, "position_m", 3000.0), "no events at all": put("events", []),
    "no arrival": put("events", lambda v: v[:1]), "no departure": put("events", lambda v: v[1:]),
    "a negative price": put("events", -1, "price_w", -1e5), "more time": put("events", -1, "latest_s", more(50.0)),
    "time without a limit": put("events", -1, "latest_s", None), "a negative wait": put("events", 0, "dwell_s", -1.0),
    "a wait where the train runs": put("events", -1, "dwell_s", 1e4), "a later origin": put("origin_s", more(1e3)),
    "auxiliaries below zero": put("auxiliary_w", -1e4),
    "a point that nobody can pass": put("run", "points", [[1600.0, 29.0, 5.0]]),
    "no digests": drop("digests"), "digests of nothing": put("digests", {}),
    "no digest of the train": drop("digests", "train"), "no resistance's part": put("train", "davis_n", [4e3, 80.0]),
    "more auxiliaries than are drawn": both(put("auxiliary_w", 1e5), put("events", -1, "price_w", more(-1e5))),
}
# The same with digests made anew: what the run, the train or the times themselves must not be.
NO_TRAIN = {
    "a negative power": put("train", "traction", "power_w", -1.0), "a negative force":
    put("train", "regenerative", "force_n", -1.0), "a table that falls below zero":
    put("train", "traction", "table", [[0.0, 1e5], [40.0, -1.0]]), "a table in another order":
    put("train", "traction", "table", [[40.0, 1e5], [0.0, 2e5]]), "a speed twice in a table":
    put("train", "traction", "table", [[10.0, 1e5], [10.0, 2e5]]), "a table of single numbers":
    put("train", "traction", "table", [1e5]), "a table of thousands of rows":
    put("train", "traction", "table", [[k / 100, 1e5 + k % 2] for k in range(2500)]),
    "an efficiency above one": put("train", "traction_efficiency", 1.1), "no efficiency":
    put("train", "traction_efficiency", 0.0), "brakes that return more than all":
    put("train", "regenerative_efficiency", 1.5), "negative friction": put("train", "friction_brake_n", -1.0),
    "resistance that drives": put("train", "davis_n", [-4e3, 80.0, 9.0]),
    "no inertia": put("run", "inertia_kg", 0.0), "a limit in km/h": put("run", "limit_mps", 0, 108.0 * 3.6),
    "a negative limit": put("run", "limit_mps", 1, -24.0), "a negative drag": put("run", "drag", 0, [-50.0, -50.0]),
    "a force less": put("run", "force_n", lambda value: value[:-1]),
    "a cell across a tunnel's portal": both(
        put("run", "drag", 1, [50.0, 50.0]), put("p", "position_m", lambda v: [v[0], v[-1]]),
        put("p", "left", lambda v: v[:1]), put("p", "right", lambda v: v[-1:])),
    "a point that nobody can pass": put("run", "points", [[1600.0, 29.0, 5.0]]),
    "a last event before the end": put("events", -1, "position_m", 3000.0),
    "a wait where the train runs": put("events", -1, "dwell_s", 1e4),
    "time without a limit": put("events", -1, "latest_s", None), "no arrival": put("events", lambda v: v[:1]),
}


@pytest.mark.parametrize("name", NO_TRAIN)
def test_what_is_no_train_line_or_timetable_is_refused_with_digests_of_its_own(name):
    made = document()
    NO_TRAIN[name](made)
    made["digests"] = stated_digests(made)
    with pytest.raises(REFUSALS) as refused:
        checked_bound(made)
    assert "digests" not in str(refused.value)


def test_the_genuine_one_holds(tmp_path):
    made = document()
    assert checked_bound(made) >= made["lower_bound_J"]
    (tmp_path / "bound.json").write_text(genuine())
    assert main([str(tmp_path / "bound.json")]) == 0


@pytest.mark.parametrize("name", FORGED)
def test_a_forged_bound_is_refused_or_proves_no_more(name):
    made = document()
    stated = made["lower_bound_J"]
    FORGED[name](made)
    assert made != document() or "none" in name
    try:
        proven = checked_bound(copy.deepcopy(made))
    except REFUSALS:
        return
    assert proven < stated, name


FILES = {
    "a key twice": lambda text: text[:-1] + ', "origin_s": 1e12}',
    "events twice": lambda text: text[:-1] + ', "events": []}',
    "NaN": lambda text: text.replace('"version": 4', '"version": 4, "x": NaN'),
    "Infinity": lambda text: text.replace('"version": 4', '"version": 4, "x": Infinity'),
    "beyond doubles": lambda text: text.replace('"version": 4', '"version": 4, "x": 1e400'),
    "digits without end": lambda text: text.replace('"version": 4', '"version": 4, "x": ' + "9" * 6000),
    "deep arrays": lambda text: text.replace('"version": 4', '"version": 4, "x": ' + "[" * 50_000 + "]" * 50_000),
    "arrays of some depth": lambda text: text.replace('"version": 4', '"version": 4, "x": ' + "[" * 20 + "]" * 20),
    "an array": lambda text: f"[{text}]", "nothing": lambda text: "", "null": lambda text: "null",
    "twice": lambda text: text + text,
    "a bound above what it proves": lambda text: text.replace('"lower_bound_J": ', '"lower_bound_J": 9'),
    "a bound of text": lambda text: text.replace('"lower_bound_J": ', '"lower_bound_J": "1e9", "y": '),
}


@pytest.mark.parametrize("name", FILES)
def test_a_forged_file_is_refused_in_one_line(name, tmp_path, capsys):
    path = tmp_path / "bound.json"
    path.write_text(FILES[name](genuine()))
    assert main([str(path)]) == 1
    assert capsys.readouterr().out.count("\n") == 1


# A train, line or time on which a bound of that size would hold: true of that one, and of no other.
OTHERS = {
    "a heavier resistance": put("train", "davis_n", [2e4, 80.0, 9.0]),
    "a worse efficiency": put("train", "traction_efficiency", 0.5), "brakes that return nothing":
    put("train", "regenerative_efficiency", 0.0), "a weaker engine": put("train", "traction", "force_n", 1e5),
    "less power": put("train", "traction", "power_w", 1e6), "an engine by a table": put(
        "train", "traction", "table", [[0.0, 1e3], [40.0, 1e3]]),
    "slow acceleration": put("train", "max_acceleration_mps2", 0.01), "more auxiliaries":
    put("train", "auxiliary_w", 1e6), "another mass": put("run", "inertia_kg", 4e5),
    "more drag": put("run", "drag", [[50.0, 50.0]] * 3), "a steeper line": put("run", "force_n", 1, [3e4, 3e4]),
    "a slower line": put("run", "limit_mps", 1, 20.0), "a stop": put("run", "stops_m", [1600.0]),
    "a point": put("run", "points", [[1600.0, 0.0, 5.0]]), "less time": put("events", -1, "latest_s", more(-20.0)),
    "a start in motion": put("run", "start_mps", 5.0), "an end in motion": put("run", "end_mps", 5.0),
}


@pytest.mark.parametrize("name", OTHERS)
def test_a_bound_of_another_train_line_or_time_bears_another_digest(name):
    made, original = document(), document()["digests"]
    OTHERS[name](made)
    with pytest.raises(REFUSALS, match="digests"):
        checked_bound(made)
    made["digests"] = stated_digests(made)
    assert sum(made["digests"][part] != original[part] for part in original) == 1
    assert original == digests(TRAIN, COURSE, as_timetable(COURSE, made_for()), 0.0, 0.0)


@cache
def made_for():
    return 1.2 * least_time(TRAIN, COURSE).trip_time_s


def test_there_are_enough_of_them():
    assert len(FORGED) + len(FILES) + len(OTHERS) + len(NO_TRAIN) >= 160


@given(st.integers(0, 2**31))
def test_prices_are_free_and_none_proves_more_than_a_run_takes(seed):
    """Whatever p and the price of time are: a run is known that takes no more than any bound may say."""
    made, rng = document(), np.random.default_rng(seed)
    made["events"][-1]["price_w"] *= rng.uniform(0.7, 1.4)
    for side in ("left", "right"):
        made["p"][side] = (np.array(made["p"][side]) * rng.uniform(0.99, 1.01) + rng.normal(
            0.0, rng.choice([0.0, 1e-3, 0.1]), len(made["p"][side]))).tolist()
    assert checked_bound(made) <= found().energy_j


def coarse(made, places):
    """The certificate with p on fewer cells, those that begin at some of its borders: a check takes milliseconds."""
    borders, left, right = (made["p"][name] for name in ("position_m", "left", "right"))
    kept = sorted({0, len(borders) - 1, *np.searchsorted(borders, places).tolist(),
                   *range(0, len(borders), len(borders) // 20)})
    made["p"] = {"position_m": [borders[k] for k in kept], "left": [left[k] for k in kept[:-1]],
                 "right": [right[k - 1] for k in kept[1:]]}


def test_no_p_proves_more_of_a_train_with_limits_of_its_acceleration():
    """Pulled up on ranges, bent at one end of a cell, cut elsewhere: what is kept is what proves most so far."""
    train = replace(TRAIN, max_acceleration_mps2=0.4, max_deceleration_mps2=0.35)
    run = find_reference(train, COURSE, 1.3 * least_time(train, COURSE).trip_time_s, intervals=8)
    best, rng = bound_document(train, COURSE, run, 0.0, 0.0), np.random.default_rng(5)
    coarse(best, COURSE.position_m)
    first = most = checked_bound(best)
    for _ in range(60):
        made = copy.deepcopy(best)
        cell, size = int(rng.integers(len(made["p"]["left"]))), 10.0**rng.uniform(-4, 0)
        last, by = cell + int(rng.integers(1, 9)), size * rng.choice([-1, 1])
        for side in ("left", "right")[:int(rng.integers(1, 3))]:
            made["p"][side][cell:last] = [float(value + by) for value in made["p"][side][cell:last]]
        made["events"][-1]["price_w"] *= rng.uniform(0.95, 1.05)
        proven = checked_bound(made)
        best, most = (made, proven) if proven > most else (best, most)
    assert first < most <= run.energy_j

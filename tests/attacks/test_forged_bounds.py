"""No forged bound is accepted: more than the run, its numbers and its file can bear is refused or proves less."""

import copy
import json
from functools import cache

import numpy as np
import pytest

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
def genuine():
    found = find_reference(TRAIN, COURSE, made_for(), intervals=12)
    return json.dumps(bound_document(TRAIN, COURSE, found, 0.0, 0.0))


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


FORGED = {
    "nothing but a number": lambda made: made.update(
        {"cell_m": [], "limit_mps": [], "fixed_j": 1e12, "terms": {key: [] for key in made["terms"]}}),
    "no events": drop("events"), "no run": drop("run"), "no p": drop("p"), "no jumps": drop("jumps"),
    "an older version": put("version", 1), "a later version": put("version", 4), "no version": drop("version"),
    "a larger fixed part": put("fixed_j", more(1e3)), "a larger line's part": claims("line_j"),
    "a larger ends' part": claims("ends_j"), "a larger line's part by little": claims("line_j", 1.0),
    "a number as a text": put("terms", "value", 0, "1"),
    "a text that is a number of thirty million digits": put("lower_bound_J", "1e30000000"),
    "such a text in a train": put("train", "auxiliary_w", "1e30000000"),
    "a limit in km/h": put("run", "limit_mps", 0, 108.0 * 3.6), "a limit of zero": put("run", "limit_mps", 0, 0.0),
    "a negative limit": put("run", "limit_mps", 1, -24.0), "a lower limit of a cell": put("limit_mps", 0, 1.0),
    "a cell before the start": both(put("p", "position_m", 0, -100.0), put("cell_m", 0, more(100.0))),
    "a run that starts elsewhere": put("run", "position_m", 0, -50.0), "a start elsewhere": put("start_m", 10.0),
    "a run that ends elsewhere": put("run", "position_m", 3, 5000.0),
    "a cell too long": put("cell_m", 0, more(10.0)), "a cell too short": put("cell_m", 0, lambda value: value / 2),
    "a gap between cells": put("p", "position_m", 1, more(25.0)), "no length": put("cell_m", 0, 0.0),
    "cells that overlap": put("p", "position_m", 1, more(-25.0)), "a negative length": put("cell_m", 1, -1.0),
    "a cell more": put("cell_m", lambda value: [*value, 100.0]), "a cell less": put("cell_m", lambda value: value[:-1]),
    "borders in another order": put("run", "position_m", lambda value: value[::-1]),
    "a section less": put("run", "limit_mps", lambda value: value[:-1]), "no sections": put("run", "limit_mps", []),
    "a force less": put("run", "force_n", lambda value: value[:-1]),
    "a force of one end": put("run", "force_n", 0, [0.0]),
    "no inertia": put("run", "inertia_kg", 0.0), "negative inertia": put("run", "inertia_kg", -3e5),
    "a heavier train's jumps": both(put("jumps", "inertia_times_fall", 0, more(1e6)), put("fixed_j", more(1e6))),
    "a start in motion that is not": put("run", "start_mps", -1.0), "an end beyond speed": put("run", "end_mps", 1e5),
    "p of one side": put("p", "left", lambda value: value[:-1]),
    "another p": put("p", "left", lambda v: [0.0] * len(v)),
    "a line of another grade": put("run", "force_n", lambda v: [[-2e4, -2e4]] * len(v)),
    "a value above": put("terms", "value", 0, more(1e5)), "infinite value": put("terms", "value", 0, float("inf")),
    "value that is none": put("terms", "value", 0, float("nan")), "huge value": put("terms", "value", 0, 1e300),
    "a huge number": put("fixed_j", 10**400), "a huge length": put("cell_m", 0, 1e300),
    "a huge negative price": put("cell_price_w", 0, -1e300), "text": put("fixed_j", "1e999"),
    "null": put("fixed_j", None),
    "speeds left out": put("terms", "high", lambda v: [x * 0.9 for x in v]),
    "a cell's number": put("terms", "cell", 0, -1),
    "a cell beyond": put("terms", "cell", 0, 10**6), "another end": put("terms", "end", 0, 2),
    "terms of no length": put("terms", "low", 0, lambda v: v + 0.5), "a column less": drop("terms", "pull"),
    "a row less": lambda made: [column.pop() for column in made["terms"].values()],
    "nothing of speeds": put("terms", {key: [] for key in ("cell", "end", "low", "high", "value", "pull", "brake",
                                                          "electric")}),
    "a price of time": put("cell_price_w", 0, more(1e5)), "an event before": put("events", -1, "position_m", -4000.0),
    "no events at all": put("events", []), "more time": put("events", -1, "latest_s", more(50.0)),
    "time without a limit": put("events", -1, "latest_s", None), "a negative wait": put("events", 0, "dwell_s", -1.0),
    "auxiliaries below zero": put("auxiliary_w", -1e4), "a slower jump": put("jumps", "slowest_mps", 0, 1e3),
    "a jump at a faster point": both(put("run", "points", [[1600.0, 20.0, 30.0]]),
                                     put("jumps", "slowest_mps", lambda v: [29.0] * len(v))),
    "jumps that nobody may pass faster": put("jumps", "fastest_mps", lambda v: [1.0] * len(v)),
    "no train": drop("train"), "no digests": drop("digests"), "digests of nothing": put("digests", {}),
    "no digest of the train": drop("digests", "train"), "no resistance's part": put("train", "davis_n", [4e3, 80.0]),
    "a limit of the force that is none": put("terms", "pull", 0, 4),
    "a limit of the force by a negative number": put("terms", "pull", 0, -1),
    "a table that is not there": put("terms", "pull", lambda v: [2] * len(v)),
    "no limit of the acceleration": put("terms", "pull", lambda v: [3] * len(v)),
    "no limit of the deceleration": put("terms", "brake", lambda v: [1] * len(v)),
    "brakes that are none": put("terms", "brake", 0, 3), "another limit at one end": put("terms", "electric", 0, 1),
    "more auxiliaries than are drawn": both(put("auxiliary_w", 1e5), put("events", -1, "price_w", more(-1e5))),
    "jumps less": put("jumps", "fastest_mps", lambda value: value[:-1]),
}


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
    assert made != document() or name == "value that is none"
    try:
        proven = checked_bound(copy.deepcopy(made))
    except REFUSALS:
        return
    assert proven < stated, name


FILES = {
    "a key twice": lambda text: text[:-1] + ', "fixed_j": 1e12}',
    "events twice": lambda text: text[:-1] + ', "events": []}',
    "NaN": lambda text: text.replace('"version": 3', '"version": 3, "x": NaN'),
    "Infinity": lambda text: text.replace('"version": 3', '"version": 3, "x": Infinity'),
    "beyond doubles": lambda text: text.replace('"version": 3', '"version": 3, "x": 1e400'),
    "digits without end": lambda text: text.replace('"version": 3', '"version": 3, "x": ' + "9" * 6000),
    "deep arrays": lambda text: text.replace('"version": 3', '"version": 3, "x": ' + "[" * 50_000 + "]" * 50_000),
    "arrays of some depth": lambda text: text.replace('"version": 3', '"version": 3, "x": ' + "[" * 20 + "]" * 20),
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
    assert len(FORGED) + len(FILES) + len(OTHERS) >= 90

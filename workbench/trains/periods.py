"""Sampling as an axis: a controller that states several periods is as many controllers, whose names say the period."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any

_NAMED = re.compile(r"_[0-9.]+ms")


def period_name(name: str, period_s: float) -> str:
    """What a controller is called at a period: `pid_5ms`."""
    return f"{name}_{1000 * period_s:g}ms"


def without_period(name: str) -> str:
    """A controller's name without the period that it is called by: `pid` of `pid_5ms`."""
    return re.sub(f"{_NAMED.pattern}$", "", name)


def at_periods(table: Any, where: str) -> Any:
    """A table of controllers as it stands in a file, each that states `periods_s` once for every one of them.

    where: what the table is called in its file. Raises ValueError for periods that are none, or stated twice.
    """
    if not isinstance(table, Mapping):
        return table
    found: dict[str, Any] = {}
    for name, spec in table.items():
        copies = _copies(name, spec, f"{where}.{name}")
        for copy in copies.keys() & (found.keys() | table.keys() - {name}):
            raise ValueError(f"{where}.{copy}: is stated, and comes of the periods of '{name}' too: name it otherwise")
        found |= copies
    return found


def _copies(name: str, spec: Any, where: str) -> dict[str, Any]:
    if not isinstance(spec, Mapping) or "periods_s" not in spec:
        return {name: spec}
    periods = spec["periods_s"]
    if "period_s" in spec:
        raise ValueError(f"{where}: period_s and periods_s are both stated: leave one of the two out")
    if not (isinstance(periods, list | tuple) and periods and len(set(map(str, periods))) == len(periods)
            and all(type(period) in (int, float) and 0 < period < math.inf for period in periods)):
        raise ValueError(f"{where}.periods_s: {periods!r} is no list of different positive seconds: correct it")
    other = {key: value for key, value in spec.items() if key != "periods_s"}
    if isinstance(spec.get("source"), Mapping) and "periods_s" in spec["source"]:
        other["source"] = {{"periods_s": "period_s"}.get(key, key): text for key, text in spec["source"].items()}
    return {period_name(name, period): other | {"period_s": period} for period in periods}


def with_periods(scenario: Any) -> Any:
    """A scenario's table with `at_periods` of its controllers, and of the ranges in which they are tuned."""
    if not isinstance(scenario, Mapping) or not isinstance(scenario.get("controllers"), Mapping):
        return scenario
    found = dict(scenario) | {"controllers": at_periods(scenario["controllers"], "controllers")}
    tuning = scenario.get("tuning")
    if isinstance(tuning, Mapping) and isinstance(tuning.get("ranges"), Mapping):
        found["tuning"] = dict(tuning) | {"ranges": for_all_periods(tuning["ranges"], found["controllers"])}
    return found


def with_periods_in_schema(schema: dict[str, Any]) -> None:
    """Say in a controller's JSON schema that `periods_s` may stand for `period_s`, as `at_periods` reads it."""
    period = schema["properties"]["period_s"]
    schema["properties"]["periods_s"] = {"type": "array", "items": period, "minItems": 1, "title": "Periods S"}
    schema["required"].remove("period_s")
    schema["oneOf"] = [{"required": ["period_s"]}, {"required": ["periods_s"]}]


def for_all_periods(ranges: Mapping[str, Any], controllers: Iterable[str]) -> dict[str, Any]:
    """Ranges by controller: those of a name that became several hold for each that has none of its own."""
    names, found = list(controllers), {}
    for name, values in ranges.items():
        copies = [other for other in names if other.startswith(name) and _NAMED.fullmatch(other[len(name):])]
        if name in names or not copies:
            found[name] = values
        else:
            found |= {other: values for other in copies if other not in ranges}
    return found

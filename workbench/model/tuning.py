"""What a file states of a search for parameters: the budget, the ranges, what is minimised, what was found."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import Count, Name, Positive, Record, SourcedRecord

Seed = Annotated[int, Strict(), Field(ge=0)]
Whole = Annotated[int, Strict(), Field(ge=1)]
# From where to where; two whole numbers mean whole numbers alone.
Range = tuple[Whole, Whole] | tuple[Positive, Positive]


def is_whole(limits: Range) -> bool:
    """Whether a range holds whole numbers alone."""
    return isinstance(limits[0], int) and isinstance(limits[1], int)


class SearchResult(Record):
    """How a search ended: the objective's value of what was found and of what is stated, and how it got there.

    improvements: per restart, (evaluation, best cost so far) of each evaluation that is better than all before;
    evaluations: of all restarts.
    """

    cost: float
    stated_cost: float
    evaluations: Count
    improvements: tuple[tuple[tuple[Count, float], ...], ...]


class Searched(SourcedRecord):
    """A budget that every controller gets: how many runs, the seed of the search, ranges, what was found.

    runs: of a controller in all; they are shared out among `restarts` searches with other seeds. ranges: per
    controller, the parameters that are searched and from where to where, logarithmically.
    found: per controller, what `workbench tune` found within this budget; the command is its source. results: per
    controller, what it costs and how it was found.
    """

    runs: Count
    seed: Seed
    restarts: Count = 1
    ranges: dict[Name, dict[str, Range]]
    found: dict[Name, dict[str, Positive]] = Field(default_factory=dict)
    results: dict[Name, SearchResult] = Field(default_factory=dict)

    @model_validator(mode="before")
    @classmethod
    def _found_has_its_source(cls, data: Any) -> Any:
        if isinstance(data, dict) and isinstance(data.get("source"), dict):
            by_tune = {key: "convention: found by workbench tune" for key in data if key in FOUND_KEYS}
            return data | {"source": by_tune | data["source"]}
        return data

    @model_validator(mode="after")
    def _ranges_go_up(self) -> Self:
        for name, ranges in self.ranges.items():
            for key, (low, high) in ranges.items():
                if not low < high:
                    raise ValueError(f"ranges.{name}.{key}: {low:g} to {high:g} is no range: let it go up")
        self.check_found(self.found, "found")
        return self

    def check_found(self, tables: dict[str, dict[str, float]], where: str) -> None:
        """ValueError where parameters that were found are not those that are searched."""
        for name, found in tables.items():
            if name not in self.ranges or found.keys() != self.ranges[name].keys():
                raise ValueError(f"{where}.{name}: its parameters are not those of ranges.{name}: run 'workbench tune'")


# What `workbench tune` writes.
BY_CONDITION = ("found_in", "results_in")
FOUND_KEYS = ("found", "results", *BY_CONDITION)


class TrackingObjective(SourcedRecord):
    """What tuning minimises: the sum of each root mean square over its unit; a failed run costs `failed` for each.

    position_m: left out where laws track speed alone.
    """

    speed_mps: Positive
    jerk_mps3: Positive
    failed: Positive
    position_m: Positive | None = None

    @property
    def units(self) -> dict[str, float]:
        """Metric -> its unit, of those that count."""
        of = {"position_rms": self.position_m, "speed_rms": self.speed_mps, "logged_jerk_rms": self.jerk_mps3}
        return {name: unit for name, unit in of.items() if unit is not None}


def at_the_rail(units: dict[str, float], actuator: bool) -> dict[str, float]:
    """What is minimised, with the jerk of every plant step instead of that between rows of the log where the plant has
    an actuator: then no command is a jump of the force, and nothing between rows is the integrator's alone."""
    return {"jerk_rms" if name == "logged_jerk_rms" and actuator else name: unit for name, unit in units.items()}

"""What a file states of a search for parameters: the budget, the ranges, what is minimised, what was found."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import Count, Name, Positive, SourcedRecord

Seed = Annotated[int, Strict(), Field(ge=0)]


class Searched(SourcedRecord):
    """A budget that every controller gets: how many runs, the seed of the search, ranges, what was found.

    ranges: per controller, the parameters that are searched and from where to where, logarithmically.
    found: per controller, what `workbench tune` found within this budget; the command is its source.
    """

    runs: Count
    seed: Seed
    ranges: dict[Name, dict[str, tuple[Positive, Positive]]]
    found: dict[Name, dict[str, Positive]] = Field(default_factory=dict)

    @model_validator(mode="before")
    @classmethod
    def _found_has_its_source(cls, data: Any) -> Any:
        if isinstance(data, dict) and "found" in data and isinstance(data.get("source"), dict):
            return data | {"source": {"found": "convention: found by workbench tune"} | data["source"]}
        return data

    @model_validator(mode="after")
    def _ranges_go_up(self) -> Self:
        for name, ranges in self.ranges.items():
            for key, (low, high) in ranges.items():
                if not low < high:
                    raise ValueError(f"ranges.{name}.{key}: {low:g} to {high:g} is no range: let it go up")
        for name, found in self.found.items():
            if name not in self.ranges or found.keys() != self.ranges[name].keys():
                raise ValueError(f"found.{name}: its parameters are not those of ranges.{name}: run 'workbench tune'")
        return self


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

"""What a file states of a joint sweep over its assumed values: which, how far each may lie, and what is looked at."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import Number, SourcedRecord, Text
from workbench.model.tuning import Seed


class Sensitivity(SourcedRecord):
    """A joint sweep: all values are drawn at once, each between its two ends, evenly or (`logarithmic`) on a log scale.

    ranges: dotted key of the file -> from where to where. metric: a number of a run's row; controller: of a scenario,
    whose run; row: of a study, key -> value by which its row is found. case: of a paper's study, field -> value of the
    one run that is made for a draw; without it the whole study is run for each. samples: a power of two; the file is
    run samples * (ranges + 2) times. set: other values of the file, to run less of it. failed: what a run that fails
    counts as; without it such a run is an error.
    """

    ranges: dict[Text, tuple[Number, Number]]
    metric: Text
    samples: Annotated[int, Strict(), Field(ge=2, le=2**20)]
    seed: Seed
    controller: Text | None = None
    row: dict[Text, Any] = Field(default_factory=dict)
    case: dict[Text, Any] = Field(default_factory=dict)
    logarithmic: tuple[Text, ...] = ()
    set: dict[Text, Any] = Field(default_factory=dict)
    failed: Number | None = None
    resamples: Annotated[int, Strict(), Field(ge=20)] = 999

    @model_validator(mode="after")
    def _can_be_drawn(self) -> Self:
        if self.samples & (self.samples - 1):
            raise ValueError(f"samples: {self.samples} is no power of two: give 64, 128, 256, ...")
        if not self.ranges:
            raise ValueError("ranges: none given: name the assumed values and from where to where each may lie")
        for key, (low, high) in self.ranges.items():
            if not low < high:
                raise ValueError(f"ranges.{key}: {low:g} to {high:g} is no range: let it go up")
        for key in self.logarithmic:
            if key not in self.ranges or not self.ranges[key][0] > 0:
                raise ValueError(f"logarithmic: '{key}' is no range of positive numbers: remove it")
        return self

"""What a study states of tuning, and of trains drawn for pairs of controllers; each value with its source."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import Field, Strict

from workbench.files.toml import Count, SourcedRecord, Text
from workbench.model.tuning import Searched, Seed, TrackingObjective
from workbench.paper.only_full import ExtraTable, OnlyFull


class StudyTuning(Searched):
    """The tuning of a study: a run is one drive in one of `places`, the file's other values changed as `set` says.

    places: what the study runs in: disturbances, cases or readings; all of them count alike. set: dotted key -> value.
    only_full: whether runs of what was found, in place of the stated values, stand beside the stated runs in a full
    report alone; on drawn trains it is run in every report.
    """

    NO_VALUES: ClassVar[frozenset[str]] = ExtraTable.NO_VALUES
    only_full: OnlyFull = False
    places: Annotated[tuple[Text, ...], Field(min_length=1)]
    set: dict[str, Any]
    objective: TrackingObjective


class Pairs(SourcedRecord):
    """Drawn trains that law and MPC both drive: mass and resistance from 1 - spread to 1 + spread.

    places, set: as in `StudyTuning`; the metrics are those of its objective.
    """

    draws: Annotated[int, Strict(), Field(ge=2, le=1000)]
    seed: Seed
    spread: Annotated[float, Strict(), Field(gt=0, lt=1, allow_inf_nan=False)]
    resamples: Count
    confidence: Annotated[float, Strict(), Field(gt=0.5, lt=1, allow_inf_nan=False)]
    places: Annotated[tuple[Text, ...], Field(min_length=1)]
    set: dict[str, Any]

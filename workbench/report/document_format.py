"""The JSON documents of runs and findings: what `compare`, `gains`, `diff`, `errata` and `reference --fleet` write.

The types hold the functions that write them; their schemas are made from them. SI units.
"""

from __future__ import annotations

from typing import Any, Literal

from typing_extensions import TypedDict

from workbench.optimal.fleet import TripRow
from workbench.report.changes import Change
from workbench.report.finding import Finding


class VariantRows(TypedDict):
    """The rows of one change of assumed values: dotted key -> value."""

    title: str
    set: dict[str, Any]
    rows: list[dict[str, object]]


class ComparisonDocument(TypedDict):
    """What `workbench compare --json` writes of a scenario: a row of metrics a controller, as stated and by variant."""

    version: Literal[1]
    scenario: str
    rows: list[dict[str, object]]
    variants: list[VariantRows]


class TableDocument(TypedDict):
    """A table of a study: rows as texts, and values as numbers in the units of their columns."""

    title: str
    source: str
    note: str
    header: list[str]
    rows: list[list[str]]
    units: list[str]
    values: list[list[Any]]


class FailureDocument(TypedDict):
    """A run that ended early, and why."""

    run: str
    why: str


class StudyDocument(TypedDict):
    """What `workbench compare --json` writes of a study or a contest.

    rows: one a run, with the keys of a scenario's where they make sense, and more; findings: a sentence each.
    """

    version: Literal[1]
    scenario: str
    rows: list[dict[str, Any]]
    tables: list[TableDocument]
    findings: list[str]
    failures: list[FailureDocument]


class ConditionDocument(TypedDict):
    """A condition at the stated gains, the values on its sides, and whether it is met."""

    name: str
    statement: str
    computed: str
    met: bool
    certificate: str | None
    note: str


class QuantityDocument(TypedDict):
    """A number that is proved: by the paper's way, by the best certificate, and a check in the frequency domain."""

    name: str
    unit: str
    papers: float | None
    proved: float
    check: float | None
    certificate: str
    note: str


class GainSetDocument(TypedDict):
    """Gains that were found, as floats and as exact fractions, and what is proved of them."""

    name: str
    objective: str
    values: dict[str, float]
    exact: dict[str, str]
    proved: str
    certificate: str
    changes: dict[str, Any]
    note: str


class FrontPointDocument(TypedDict):
    """Gains of a front: what their run costs, what is proved of them, and what no proof can go below; or null."""

    name: str
    gains: dict[str, float]
    numbers: dict[str, float | None]
    cost: float | None
    bound: float | None
    no_bound_below: float | None
    certificate: str


class FrontDocument(TypedDict):
    """What runs cost against what is proved, in one setting; the stated gains are the first point."""

    setting: str
    bounded: str
    unit: str
    evaluations: int
    points: list[FrontPointDocument]


class GainsDocument(TypedDict):
    """What `workbench gains --json` writes: conditions, proved numbers, found gains, and runs with both.

    effects: a row a run; fronts: cost against what is proved, by setting; compared: in which numbers found gains are
    better and worse, in sentences; search_s: seconds.
    """

    version: Literal[1]
    paper: str
    conditions: list[ConditionDocument]
    quantities: list[QuantityDocument]
    found: list[GainSetDocument]
    effects: list[dict[str, Any]]
    fronts: list[FrontDocument]
    compared: list[str]
    certificates: list[str]
    notes: list[str]
    search_s: dict[str, float]


class ChangesDocument(TypedDict):
    """What `workbench diff --json` writes: the claims that differ between two documents of `prove --json`."""

    version: Literal[1]
    changes: list[Change]


class FleetDocument(TypedDict):
    """What `workbench reference --fleet FILE --json` writes: a row a trip, and by its id what its answer depends on."""

    version: Literal[1]
    fleet: str
    trips: list[TripRow]
    digests: dict[str, str]


class FindingsDocument(TypedDict):
    """findings.json of `workbench errata`: a paper's lines that do not stand.

    Beside the fields below each has its `place` in the paper, the `heading` under which it is told, and `sentences`.
    """

    version: Literal[1]
    findings: list[Finding]

"""A scenario: train, line, desired curve, limits, sampling, controllers and the paper's printed values."""

from __future__ import annotations

import copy
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, Strict, WithJsonSchema, model_validator

from workbench.errors import InputError, WorkbenchError
from workbench.files.numbers import counted
from workbench.files.text import CHECK_PATH
from workbench.files.toml import (
    REPRODUCTION,
    Count,
    FileRecord,
    Name,
    NonNegative,
    Number,
    Positive,
    Record,
    SourcedRecord,
    Text,
    read_toml,
    validate_record,
)
from workbench.model.curve_table import TableCurve
from workbench.model.desired_curve import CruiseSpeed, DavisCruise, DesiredCurve, build_curve
from workbench.model.events import Disturbance, Failure, Mode
from workbench.model.sensing import Instruments
from workbench.model.sensitivity import Sensitivity
from workbench.model.tuning import Searched, TrackingObjective
from workbench.trains.actuator import Actuator
from workbench.trains.periods import with_periods, with_periods_in_schema
from workbench.trains.track import Track, load_track
from workbench.trains.train_record import Train

MOST_LOG_ROWS = 10_000_000

# Between two samples or two rows of the log; bounded so that a slip of the pen is no run of years.
Interval = Annotated[float, Strict(), Field(ge=1e-5, le=3600, allow_inf_nan=False)]


class Simulation(SourcedRecord):
    """Plant step, duration beyond the desired curve, and the position band that is watched."""

    plant_step_s: Annotated[float, Strict(), Field(ge=1e-5, le=0.1, allow_inf_nan=False)]
    dwell_s: Annotated[float, Strict(), Field(ge=0, le=3600, allow_inf_nan=False)]
    position_band_m: Positive
    log_every_s: Interval
    initial_position_m: Annotated[float, Strict(), Field(ge=-1e4, le=1e4, allow_inf_nan=False)] = 0.0


class NeuronGrid(SourcedRecord):
    """Where the hidden neurons stand: `count` centers evenly along the first input, the others fixed."""

    count: Annotated[int, Strict(), Field(ge=1, le=100_000)]
    first_center: Number
    last_center: Number
    other_centers: tuple[Number, ...] = ()
    width: Positive


class ControllerSpec(SourcedRecord, json_schema_extra=with_periods_in_schema):
    """One controller of a scenario: which law, its sampling period, its parameters and initial values.

    `periods_s` makes as many controllers, whose names say the period. predictor: told the actuator's delay, MPC the
    lag too. estimates: whether a law's states move by a sample before its command is taken (corrected) or after it.
    """

    law: Text
    title: Text | None = None
    period_s: Interval
    parameters: dict[str, Number] = Field(default_factory=dict)
    initial: dict[str, Number] = Field(default_factory=dict)
    estimates: Literal["corrected", "explicit"] = "corrected"
    neurons: NeuronGrid | None = None
    predictor: Annotated[bool, Strict()] = False


class Uncertainty(SourcedRecord):
    """Monte Carlo: every named factor is drawn uniformly from 1 - spread to 1 + spread.

    odometer_spread: likewise of the wheels that the odometer counts, which differ by less than trains do.
    """

    runs: Count
    seed: Annotated[int, Strict(), Field(ge=0)]
    spread: Annotated[float, Strict(), Field(ge=0, lt=1, allow_inf_nan=False)]
    factors: tuple[Literal["mass", "davis_a", "davis_b", "davis_c", "line_resistance"], ...]
    odometer_spread: Annotated[float, Strict(), Field(ge=0, le=0.2, allow_inf_nan=False)] = 0.0


class PrintedRow(Record):
    """A row of the paper's comparison table."""

    controller: Text
    position_error_m: tuple[Number, Number]
    speed_error_mps: tuple[Number, Number]
    stopping_accuracy_m: NonNegative


class PrintedTable(Record):
    """A table of the paper that the runs are held against, and why they differ as far as that was measured."""

    source: Text
    rows: tuple[PrintedRow, ...]
    reasons: tuple[Text, ...] = ()


class PrintedValue(Record):
    """A single number the paper prints, and the metric it is held against."""

    source: Text
    controller: Text
    metric: Text
    value: Number
    unit: Text


class Variant(Record):
    """One change of assumed values, dotted key -> value, of the controllers named or all; only_full: see `report`."""

    title: Text
    set: dict[str, Any]
    controllers: tuple[Text, ...] = ()
    only_full: Annotated[bool, Strict()] = False


class ScenarioTuning(Searched):
    """The tuning of a scenario's controllers: a run is the scenario as stated, with other parameters.

    ranges: of initial values too, as the gains of a law that adapts them.
    """

    objective: TrackingObjective


def known_version(value: Any) -> Any:
    """The version of a file's format as it is; ValueError for one that this workbench does not read."""
    if type(value) is not int or value != 1:
        raise ValueError(f"{value!r} is not known: this workbench reads version = 1")
    return value


class Scenario(FileRecord):
    """Everything a run needs, with the source of every value."""

    version: Annotated[int, BeforeValidator(known_version)]
    name: Name
    title: Text
    paper: Text
    citation: Text
    track: Annotated[Track, WithJsonSchema({"type": "string", "title": "Track"})]  # the name of its file
    train: Train
    reference: Annotated[DavisCruise | CruiseSpeed | TableCurve, Field(discriminator="kind")]
    simulation: Simulation
    disturbance: Disturbance
    modes: tuple[Mode, ...] = ()
    failures: tuple[Failure, ...] = ()
    actuator: Actuator | None = None
    sensing: Instruments | None = None
    controllers: dict[Name, ControllerSpec]
    uncertainty: Uncertainty
    printed_table: PrintedTable | None = None
    printed_values: tuple[PrintedValue, ...] = ()
    variants: tuple[Variant, ...] = ()
    tuning: ScenarioTuning | None = None
    joint_sensitivity: Sensitivity | None = None
    reproduction: Annotated[bool, Strict()] = False

    @model_validator(mode="before")
    @classmethod
    def _a_controller_at_each_of_its_periods(cls, data: Any) -> Any:
        return with_periods(data)

    @model_validator(mode="after")
    def _parts_fit_together(self) -> Self:
        if not self.controllers:
            raise ValueError("controllers: none given: add a [controllers.<name>] table")
        step = self.simulation.plant_step_s
        for name, spec in self.controllers.items():
            ratio = spec.period_s / step
            if round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
                raise ValueError(f"controllers.{name}.period_s = {spec.period_s:g} is not a whole number of "
                                 f"plant steps of {step:g} s: choose a multiple")
            for key in ("measurement_delay_s", "command_delay_s") if self.sensing else ():
                late = getattr(self.sensing, key) / spec.period_s
                if abs(late - round(late)) > 1e-6:
                    raise ValueError(f"sensing.{key} is no whole number of the {spec.period_s:g} s at which '{name}' "
                                     "samples: choose a multiple of every period")
        if self.actuator is not None:
            try:
                self.actuator.delay_steps(step)
            except ValueError as trouble:
                raise ValueError(f"actuator.{trouble}") from None
        starts = [mode.from_s for mode in self.modes]
        if starts != sorted(set(starts)):
            raise ValueError("modes: from_s does not increase from mode to mode: order them by time")
        for mode, following in pairwise(self.modes):
            if mode.from_s + mode.grade_ramp_s > following.from_s:
                raise ValueError(f"modes: the grade that grows from {mode.from_s:g} s on is not there yet when the "
                                 f"next mode begins at {following.from_s:g} s: shorten grade_ramp_s")
        rows = self.printed_table.rows if self.printed_table else ()
        printed = [("printed_table", row.controller) for row in rows]
        printed += [("printed_values", value.controller) for value in self.printed_values]
        printed += [("variants", name) for variant in self.variants for name in variant.controllers]
        for key, name in printed:
            if name not in self.controllers:
                raise ValueError(f"{key}: '{name}' is no controller of this scenario: "
                                 f"choose one of {', '.join(self.controllers)}")
        return self

    @property
    def all_variants(self) -> tuple[Variant, ...]:
        """The stated changes of assumed values, and the controllers as `workbench tune` found them, where it did."""
        found = self.tuning.found if self.tuning else {}
        started = {name: spec.initial for name, spec in self.controllers.items()}
        changed = {f"controllers.{name}.{'initial' if key in started.get(name, {}) else 'parameters'}.{key}": value
                   for name, values in found.items() for key, value in values.items()}
        tuned = Variant(title=f"tuned, {counted(self.tuning.runs, 'run')} each", set=changed, controllers=tuple(found)
                        ) if self.tuning and found else None
        return (*self.variants, tuned) if tuned else self.variants

    def desired_curve(self) -> DesiredCurve:
        """The desired curve over the whole line, for the nominal train."""
        if isinstance(self.reference, TableCurve):
            return self.reference.curve(self.track.length_m)
        train = self.train
        davis = (train.davis_a_mps2, train.davis_b_per_s, train.davis_c_per_m)
        return build_curve(self.reference, self.track.length_m, davis)


def tunable(scenario: Scenario, name: str) -> dict[str, float]:
    """What `with_parameters` can change of a controller, with its stated values."""
    spec = scenario.controllers[name]
    return spec.initial | spec.parameters


def with_parameters(scenario: Scenario, name: str, parameters: dict[str, float]) -> Scenario:
    """The scenario with other parameters, or initial values where it has such, of one controller."""
    spec = scenario.controllers[name]
    started = {key: value for key, value in parameters.items() if key in spec.initial}
    others = {key: value for key, value in parameters.items() if key not in started}
    changed = spec.model_copy(update={"parameters": spec.parameters | others, "initial": spec.initial | started})
    return scenario.model_copy(update={"controllers": scenario.controllers | {name: changed}})


def load_scenario(path: Path, where: str = CHECK_PATH) -> Scenario:
    """Load a scenario from TOML, its line from the file it names; where: as for `read_toml`. Raises InputError naming
    file and key."""
    return build_scenario(path, read_toml(path, where))


def build_scenario(path: Path, data: dict[str, Any], like: Scenario | None = None) -> Scenario:
    """The scenario of a file that has been read already; raises InputError naming file and key.

    like: a scenario of the same file, whose line and table are taken where they are the same.
    """
    try:
        data = with_periods(data)
    except ValueError as trouble:
        raise InputError(path, "", str(trouble)) from None
    line, reproduction = data.get("track"), data.get(REPRODUCTION) is True
    if not isinstance(line, str):
        raise InputError(path, "track", "name the line's TOML file, relative to this one")
    track = like.track if like else load_track(path.parent / line, reproduction, f"check the path, 'track' in {path}")
    scenario = validate_record(data | {"track": track}, Scenario, path).in_folder(path.parent)
    if isinstance(scenario.reference, TableCurve):
        same = like and isinstance(like.reference, TableCurve) and like.reference.file == scenario.reference.file
        reference = like.reference if like and same else scenario.reference.read(path)
        scenario = scenario.model_copy(update={"reference": reference})
    try:
        curve = scenario.desired_curve()
    except WorkbenchError as trouble:
        raise InputError(path, "reference", str(trouble)) from None
    rows = (curve.trip_time_s + scenario.simulation.dwell_s) / scenario.simulation.log_every_s
    if rows > MOST_LOG_ROWS:
        raise InputError(path, "simulation.log_every_s", f"gives {rows:.0f} rows for a run of "
                         f"{curve.trip_time_s:.0f} s, more than {MOST_LOG_ROWS}: log less often")
    return scenario


def changed_scenario(path: Path, data: dict[str, Any], variant: Variant, like: Scenario) -> Scenario:
    """The scenario of a file with one variant's values set; raises InputError when a key does not exist.

    data: the file as it was read, which is left as it is; like: its scenario.
    """
    changed = copy.deepcopy(data)
    for key, value in variant.set.items():
        *parents, last = key.split(".")
        table: Any = changed
        for parent in parents:
            table = table.get(parent) if isinstance(table, dict) else None
        if not isinstance(table, dict) or last not in table:
            raise InputError(path, f"variants: {key}", "no such key: name a value that the scenario states")
        table[last] = value
    return build_scenario(path, changed, None if "track" in variant.set else like)

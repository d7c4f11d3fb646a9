"""jiao2025's file as a record, the runs that it asks for, and each run as a plan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, Strict, ValidationError, model_validator

from workbench.compile.kernel import numeric
from workbench.files.toml import Name, Number, Positive, Record, SourcedRecord, Text
from workbench.paper.mpc_comparison import MpcData
from workbench.paper.study import Study
from workbench.paper.tuning_record import Pairs, StudyTuning

from .. import laws, plant
from ..laws import TRIAL_LAWS
from ..simulation.trials import Array, TrialPlan

GRAVITY = 9.80665
_speed_at = numeric((plant.k,), plant.desired_curve)
_additional = numeric((plant.slope_coefficient, plant.slope_angle), plant.additional_resistance)
PRINTED_LAWS = ("jiao2025.icfdl", "jiao2025.pd")

Trial = Annotated[int, Strict(), Field(ge=1, le=10_000)]
Share = Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]


def _estimate(value: Any) -> Any:
    number = isinstance(value, float) and 0 < value <= 1e6
    if not number and value != "derivative":
        raise ValueError(f"{value!r} is neither a number with a point, above 0 and up to 1e6, nor \"derivative\"")
    return value


# What (14) and (15) start from: a number in m/s per unit of u, or dv(k+1)/du(k) of the reading.
Estimate = Annotated[float | str, BeforeValidator(_estimate)]


class Train(SourcedRecord):
    """The mass, and what (17) is divided by: nothing ("newton"), or M as it is printed ("as_printed")."""

    mass_kg: Annotated[float, Strict(), Field(ge=1e3, le=1e8, allow_inf_nan=False)]
    resistance: Literal["newton", "as_printed"]


class Section(Record):
    """A section of the line up to a fraction of its length."""

    end_fraction: Share
    grade_permille: Annotated[float, Strict(), Field(ge=-100, le=100, allow_inf_nan=False)]


class Line(SourcedRecord):
    """Grades along the desired trip, and at which position they are met (`SEEN_BY` of the trial loop)."""

    seen_by: Literal["train", "desired", "stretched"]
    sections: Annotated[tuple[Section, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _sections_follow_each_other(self) -> Self:
        ends = [section.end_fraction for section in self.sections]
        if any(b <= a for a, b in pairwise(ends)) or ends[-1] != 1.0:
            raise ValueError("sections: end_fraction must increase from section to section and end at 1: correct it")
        return self


class Trials(SourcedRecord):
    """How many trials, of which lengths (in the k of (16)), and which of them the figures show."""

    count: Trial
    desired_length_k: Annotated[int, Strict(), Field(ge=1601, le=2000)]
    shortest_length_k: Annotated[int, Strict(), Field(ge=1, le=1999)]
    compared: Annotated[tuple[Trial, ...], Field(min_length=1)]
    line_shown: tuple[Trial, ...]
    seed: Annotated[int, Strict(), Field(ge=0)]
    seeds: Annotated[int, Strict(), Field(ge=2, le=1000)]

    @model_validator(mode="after")
    def _fit_together(self) -> Self:
        if self.shortest_length_k >= self.desired_length_k:
            raise ValueError(f"shortest_length_k = {self.shortest_length_k} is not below desired_length_k = "
                             f"{self.desired_length_k}: T_i is drawn from above the one up to the other")
        for key in ("compared", "line_shown"):
            if any(trial > self.count for trial in getattr(self, key)):
                raise ValueError(f"{key} names a trial beyond the last, {self.count}: correct it")
        return self


class Learning(SourcedRecord):
    """Table 1, u(k,0) and phi_hat(k,1); all in units of u of the reading."""

    rho: Share
    lamda: Positive
    mu: Positive
    eta: Share
    epsilon: Positive
    K_p: Positive
    K_d: Positive
    first_input: Number
    first_estimate: Estimate
    kept_estimate: Estimate


class Reading(SourcedRecord):
    """A unit of u (in N) and a meaning of k: how long a step of (1) is, and how much k grows in it."""

    title: Text
    unit: Text
    unit_n: Annotated[float, Strict(), Field(ge=1e-3, le=1e8, allow_inf_nan=False)]
    step_s: Annotated[float, Strict(), Field(ge=1e-3, le=10, allow_inf_nan=False)]
    k_per_sample: Annotated[float, Strict(), Field(ge=1e-2, le=1, allow_inf_nan=False)]

    @property
    def per_k(self) -> int:
        """Samples in one k."""
        return round(1 / self.k_per_sample)

    @property
    def label(self) -> str:
        """A few words for legends: the unit and the length of a step, and that there are more steps than k."""
        return f"{self.unit} at {self.step_s:g} s" + (f", {self.per_k} steps a k" if self.per_k > 1 else "")

    @model_validator(mode="after")
    def _whole_samples(self) -> Self:
        if abs(self.per_k * self.k_per_sample - 1) > 1e-9:
            raise ValueError(f"k_per_sample = {self.k_per_sample:g} is no whole part of 1: choose 1, 0.5 or "
                             "0.1, for instance")
        return self


class Shown(Record):
    """A run whose curves, seeds and sensitivity are shown."""

    reading: Name
    law: Text


class UnitSweep(SourcedRecord):
    """Units of u between two accelerations per unit, evenly on a logarithmic scale."""

    readings: tuple[Name, ...]
    lowest_mps2: Positive
    highest_mps2: Positive
    count: Annotated[int, Strict(), Field(ge=2, le=1000)]

    @property
    def units_mps2(self) -> Array:
        """m/s^2 per unit of u."""
        return np.geomspace(self.lowest_mps2, self.highest_mps2, self.count)


class Change(Record):
    """One change of an assumed value: dotted key -> value."""

    title: Text
    set: dict[str, Any]


class JiaoStudy(Study):
    """Everything that the runs of jiao2025 need, with the source of every value."""

    train: Train
    line: Line
    trials: Trials
    learning: Learning
    readings: dict[Name, Reading]
    shown: tuple[Shown, ...]
    unit_sweep: UnitSweep
    variants: tuple[Change, ...] = ()
    mpc: MpcData | None = None
    tuning: StudyTuning | None = None
    pairs: Pairs | None = None

    @model_validator(mode="after")
    def _names_are_known(self) -> Self:
        for key, name in [("shown", s.reading) for s in self.shown] + [
                ("unit_sweep.readings", name) for name in self.unit_sweep.readings]:
            if name not in self.readings:
                raise ValueError(f"{key}: '{name}' is no reading: choose one of {', '.join(self.readings)}")
        for entry in self.shown:
            if entry.law not in TRIAL_LAWS:
                raise ValueError(f"shown: there is no law '{entry.law}': choose one of {', '.join(TRIAL_LAWS)}")
        for variant in self.variants:
            try:
                changed(self, variant)
            except (ValidationError, ValueError) as trouble:
                why = str(trouble.errors()[0]["msg"]) if isinstance(trouble, ValidationError) else str(trouble)
                raise ValueError(f"variants: '{variant.title}': {why}") from None
        return self


def changed(study: JiaoStudy, variant: Change) -> JiaoStudy:
    """The study with a variant's values set; raises ValueError for a key that the study does not state."""
    data = study.model_dump(exclude_unset=True)
    for key, value in variant.set.items():
        *parents, last = key.split(".")
        table: Any = data
        for parent in parents:
            table = table.get(parent) if isinstance(table, dict) else None
        if not isinstance(table, dict) or last not in table:
            raise ValueError(f"{key}: no such key: name a value that the study states")
        table[last] = value
    return JiaoStudy.model_validate(data | {"variants": ()})


@dataclass(frozen=True)
class Case:
    """One run: reading, law, seed of the lengths, variant (-1: as stated), another unit of u in m/s^2.

    opposed: whether (3) opposes the motion backwards too, as it does not as printed.
    """

    reading: str
    law: str
    seed: int
    variant: int = -1
    unit_mps2: float | None = None
    opposed: bool = False


def cases(study: JiaoStudy) -> Iterator[Case]:
    """All runs of a study, each once: every law in every reading, variants, seeds, units."""
    seed = study.trials.seed
    for reading in study.readings:
        for law in TRIAL_LAWS:
            yield Case(reading, law, seed)
        for law in PRINTED_LAWS:
            yield Case(reading, law, seed, opposed=True)
    for entry in study.shown:
        for place, variant in enumerate(study.variants):
            if concerns(variant, entry.law):
                yield Case(entry.reading, entry.law, seed, place)
        for more in range(1, study.trials.seeds):
            yield Case(entry.reading, entry.law, seed + more)
    for reading in study.unit_sweep.readings:
        for law in PRINTED_LAWS:
            for unit in study.unit_sweep.units_mps2:
                yield Case(reading, law, seed, unit_mps2=float(unit))


def concerns(variant: Change, law_id: str) -> bool:
    """Whether a variant changes anything that a law's run depends on."""
    law = TRIAL_LAWS[law_id]
    used = {"first_input", *map(str, law.parameters)}
    used |= {"first_estimate"} if law.next_estimate != laws.phi_first else set()
    return any(not key.startswith("learning.") or key.removeprefix("learning.") in used for key in variant.set)


def plan(study: JiaoStudy, case: Case) -> TrialPlan:
    """The plan of one run."""
    if case.variant >= 0:
        study = changed(study, study.variants[case.variant])
    reading, mass = study.readings[case.reading], study.train.mass_kg
    unit_n = reading.unit_n if case.unit_mps2 is None else case.unit_mps2 * mass
    desired, positions = desired_trip(study, reading)
    law = TRIAL_LAWS[case.law]
    learning = study.learning
    estimate = learning.kept_estimate if law is laws.fixed_estimate else learning.first_estimate
    fractions = [0.0, *(section.end_fraction for section in study.line.sections)]
    return TrialPlan(
        law=case.law, parameters={str(s): getattr(learning, str(s)) for s in law.parameters},
        lengths=lengths(study.trials, case.seed) * reading.per_k if law.random_lengths
        else np.full(study.trials.count + 1, len(desired) - 1, dtype=np.int64),
        first_input=learning.first_input,
        first_estimate=reading.step_s * unit_n / mass if estimate == "derivative" else float(estimate),
        desired=desired, desired_positions=positions, edges=np.array(fractions) * positions[-1],
        additional_n=grade_newton(study), seen_by=study.line.seen_by, step_s=reading.step_s, mass_kg=mass,
        unit_n=unit_n, divisor=mass if study.train.resistance == "as_printed" else 1.0,
        opposed=case.opposed, k_per_sample=reading.k_per_sample, kept=_kept(study, case))


def _kept(study: JiaoStudy, case: Case) -> tuple[int, ...]:
    """The trials of which figures show every sample."""
    drawn = [Case(entry.reading, entry.law, study.trials.seed) for entry in study.shown]
    return tuple(sorted({*study.trials.compared, *study.trials.line_shown})) if case in drawn else ()


def lengths(trials: Trials, seed: int) -> NDArray[np.int64]:
    """T_0, T_1, ...: uniform from above the shortest length up to the desired one, in the k of (16)."""
    drawn = np.random.default_rng(seed).integers(trials.shortest_length_k, trials.desired_length_k, trials.count + 1)
    return drawn + 1


def desired_trip(study: JiaoStudy, reading: Reading) -> tuple[Array, Array]:
    """(16) at every sample in m/s, and the positions in m of a train that follows it."""
    samples = np.arange(study.trials.desired_length_k * reading.per_k + 1)
    speed = np.asarray(_speed_at(samples * reading.k_per_sample), dtype=float)
    return speed, np.concatenate(([0.0], np.cumsum(speed[:-1]))) * reading.step_s


def grade_newton(study: JiaoStudy) -> Array:
    """(2) for every section in N: the weight times the sine of the slope."""
    slope = np.arctan([section.grade_permille * 1e-3 for section in study.line.sections])
    return np.asarray(_additional(study.train.mass_kg * GRAVITY, slope), dtype=float)

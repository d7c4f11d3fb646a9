"""The file of mao2018's study: its section VIII as stated, and what had to be assumed beside it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from workbench.files.toml import Count, Name, NonNegative, Number, Positive, Record, SourcedRecord, Text, Whole
from workbench.model.desired_curve import SpeedLevels
from workbench.model.events import Term
from workbench.paper.checks import at_most, increasing, one_of
from workbench.paper.only_full import ExtraTable
from workbench.paper.reproduced import Change, ReproducedStudy
from workbench.trains.scenario import Interval

from ..laws import MODES, SLOPE_MODE

Share = Annotated[Number, Field(gt=0, le=2)]
Gain = Annotated[Number, Field(gt=0, le=1e9)]
Sampling = Annotated[Number, Field(ge=1e-5, le=0.1)]
# A rolling resistance beyond these bounds has another unit than the table's.
Resistance = Annotated[Number, Field(ge=0, le=1)]
MOST_CASES, MOST_STEPS, MOST_LOG_ROWS = 5, 1e8, 5e5
Regressors = Literal["scaled", "SI"]
Event = Literal["failure", "rest", "drag"]


class TrainData(SourcedRecord):
    """The train: its mass, and the motors that share its force."""

    mass_t: Number = Field(ge=1, le=1e5)
    motors: Whole = Field(ge=2, le=1000)
    gravity_mps2: Number = Field(ge=9, le=10)


class ModeData(SourcedRecord):
    """A mode of the train as printed: when it begins, and its parameters in the table's units."""

    start_s: NonNegative
    a_kn: Resistance
    b_kn_s_per_m: Resistance
    c_kn_s2_per_m2: Resistance
    theta_deg: Number = Field(ge=-10, le=10)
    curve_deg: Number = Field(ge=0, le=90)
    slope_ramp_per_s: Positive | None = None


class Readings(SourcedRecord):
    """How the printed units are read where they do not fit their definitions or are not printed."""

    resistance: Literal["per tonne", "whole train"]
    angle: Literal["degree", "radian"]
    disturbance_unit_n: Literal[1, 1000]


class ForceTerm(Term):
    """offset + amplitude sin(omega t + phase) while its window lasts, as printed."""

    offset: Number = 0.0
    amplitude: Number = 0.0


class DragTerm(Term):
    """An unparameterizable part of b (power 1) or c (power 2), in the unit of the mode table."""

    amplitude: Number
    speed_power: Literal[1, 2]


class Bounds(SourcedRecord):
    """Bounds of |d| in the modes, in the unit of the disturbance."""

    by_mode: tuple[NonNegative, NonNegative, NonNegative, NonNegative]


class Disturbance(Record):
    """A disturbance d(t) and, for each mode, the bound on |d| that a law may know or must find."""

    terms: tuple[ForceTerm, ...]
    bounds: Bounds


class LawData(SourcedRecord):
    """What the laws of every case share.

    gain: of (27)-(31); the other gains have its place in their laws. lower_bound_share: what share of m_i k_nu with
    one motor failed is known as its lower bound; rest_bound_n: delta_j^0 of (49); failure_start_n: what the failure
    estimates together stand for at the start; layer_mps: 0 is the printed sign, else sgn(z) becomes z/(|z| + layer).
    """

    gain: Gain
    gain_rho: Gain
    gain_rho_k: Gain
    gain_xi: Gain
    gain_lambda: Gain
    force_unit_n: Number = Field(ge=1, le=1e8)
    lower_bound_share: Share
    rest_bound_n: Positive
    k_1: Gain
    k_2: Gain
    omega_rad_s: Positive
    phase_rad: Number
    failure_start_n: Number
    layer_mps: Number = Field(ge=0, le=10)
    estimates: Literal["corrected", "explicit"]


class Tuning(SourcedRecord):
    """One choice of what decides how fast the laws adapt: the regressors' units, feedback and sampling."""

    title: Text
    regressors: Regressors
    r_1_per_s: Gain
    r_2_per_s: Gain
    period_s: Sampling


class CaseData(SourcedRecord):
    """A case of section VIII: the law of its section, what happens, from where and with which estimates it starts."""

    title: Text
    law: Literal["healthy", "failures", "unparameterized", "unknown_bound", "damped"]
    disturbance: Name
    events: tuple[Event, ...]
    initial_position_m: Number = Field(ge=-1e3, le=1e3)
    estimate_share: Share


class Horizon(SourcedRecord):
    """How long runs last and how often they are logged."""

    end_s: Number = Field(gt=0, le=1e5)
    log_every_s: Interval
    settled_window_s: Positive


class SamplingData(ExtraTable):
    """Which sampling periods and damping the laws bear with the regressors in SI units."""

    case: Count
    tuning: Name
    end_s: Positive
    periods_s: tuple[Sampling, ...]
    r_2_per_s: tuple[Gain, ...]


class SingleSigns(ExtraTable):
    """In which tunings each wrong sign of a law that has several is the only one: with `only_full` in a full report."""

    tunings: tuple[Name, ...]


class MaoChange(Change):
    """A change of assumed values in the cases named; laws: with the signs corrected, as printed, or both."""

    cases: tuple[Count, ...]
    tuning: Name
    laws: Literal["corrected", "printed", "both"] = "corrected"


class MaoStudy(ReproducedStudy):
    """Section VIII of mao2018 with every value's source."""

    train: TrainData
    modes: tuple[ModeData, ...]
    readings: Readings
    reference: SpeedLevels
    disturbances: dict[Name, Disturbance]
    failure: tuple[ForceTerm, ...]
    rest: tuple[ForceTerm, ...]
    drag: tuple[DragTerm, ...]
    law: LawData
    tunings: dict[Name, Tuning]
    cases: tuple[CaseData, ...]
    horizon: Horizon
    sampling: SamplingData
    single_signs: SingleSigns
    changes: tuple[MaoChange, ...] = ()

    def check(self) -> None:
        """Modes, cases, tunings and times are those of the laws and tables, and a run of them ends."""
        self._modes_fit()
        self._cases_fit()
        self._runs_are_finite()
        end = self.reference.end_s
        for key, value in (("horizon.end_s", self.horizon.end_s), ("sampling.end_s", self.sampling.end_s)):
            at_most(key, value, "the desired curve's end", end)
        edges = (edge for part in self.failure for edge in (part.from_s, part.to_s or end))
        increasing("failure: from_s and to_s of its parts, which are one motor,", edges, repeated=True)

    def _modes_fit(self) -> None:
        if len(self.modes) != len(MODES):
            raise ValueError(f"modes: the laws have estimates for {len(MODES)}, not for {len(self.modes)}")
        at_most("modes[0].start_s", self.modes[0].start_s, "the time at which runs begin", 0.0)
        increasing("modes: start_s", (mode.start_s for mode in self.modes))
        for number, mode in zip(MODES, self.modes, strict=True):
            if (mode.slope_ramp_per_s is not None) != (number == SLOPE_MODE):
                raise ValueError(f"modes[{number - 1}].slope_ramp_per_s: the laws know a slope that grows in mode "
                                 f"{SLOPE_MODE}, and there alone")

    def _cases_fit(self) -> None:
        """Tunings and cases are those that tables show, and what names one of them names one that there is."""
        if [tuning.regressors for tuning in self.tunings.values()] != ["scaled", "SI"]:
            raise ValueError("tunings: give two, the first with scaled regressors, the second with those in SI units")
        laws = [case.law for case in self.cases]
        if not 2 <= len(laws) <= MOST_CASES or laws[0] != "healthy" or "healthy" in laws[1:]:
            raise ValueError(f"cases: give the healthy one first, then one to {MOST_CASES - 1} with a law for failures")
        for name in self.single_signs.tunings:
            one_of("single_signs.tunings", "tuning", name, self.tunings)
        one_of("sampling.tuning", "tuning", self.sampling.tuning, self.tunings)
        one_of("sampling.case", "case", self.sampling.case, range(1, len(laws) + 1))
        for number, case in enumerate(self.cases):
            one_of(f"cases[{number}].disturbance", "disturbance", case.disturbance, self.disturbances)
        for change in self.changes:
            one_of(f"changes: '{change.title}': tuning", "tuning", change.tuning, self.tunings)
            for of in change.cases:
                one_of(f"changes: '{change.title}': cases", "case", of, range(1, len(laws) + 1))

    def _runs_are_finite(self) -> None:
        """Longer runs and logs than any train's would not end, or not fit in memory."""
        periods = [(f"tunings.{name}.period_s", tuning.period_s) for name, tuning in self.tunings.items()]
        for key, period in [*periods, *(("sampling.periods_s", period) for period in self.sampling.periods_s)]:
            if self.horizon.end_s / period > MOST_STEPS:
                raise ValueError(f"{key} = {period:g}: gives {self.horizon.end_s / period:.2g} periods in a run, more "
                                 f"than {MOST_STEPS:.0e}: lengthen it")
        if self.horizon.end_s / self.horizon.log_every_s > MOST_LOG_ROWS:
            raise ValueError(f"horizon.log_every_s = {self.horizon.log_every_s:g}: gives more than {MOST_LOG_ROWS:.0e} "
                             f"rows: log less often")

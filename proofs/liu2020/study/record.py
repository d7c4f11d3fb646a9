"""liu2020's file as a record: train, line, reference, gains, networks, disturbances, what the paper prints."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from workbench.files.toml import NonNegative, Number, Positive, SourcedRecord, Text, Whole
from workbench.model.desired_curve import RampTime
from workbench.paper.checks import increasing, one_of
from workbench.paper.only_full import ExtraTable
from workbench.paper.reproduced import Change, ColumnTable, ReproducedStudy

from ..laws import LAWS

COLUMNS = 10

Column = Annotated[Whole, Field(ge=1, le=COLUMNS)]
LeakRate = Annotated[Number, Field(ge=0, le=1e3)]
Range = tuple[Number, Number]


class Train(SourcedRecord):
    """Mass, the factor chi of (9), and the coefficients of (61) in the unit that they are read in."""

    mass_kg: Number = Field(ge=1e3, le=1e8)
    chi: Number = Field(ge=0.1, le=2)
    davis: tuple[NonNegative, NonNegative, NonNegative]
    davis_unit: Literal["N/kN, km/h", "N/kN, m/s", "N/kg, m/s"]


class Section(SourcedRecord):
    """A row of Table 1."""

    from_m: NonNegative
    to_m: Positive
    slope: Number = Field(0.0, ge=-100, le=100)
    curve_radius_m: Annotated[Number, Field(ge=50, le=1e6)] | None = None
    tunnel_length_m: NonNegative = 0.0


class Line(SourcedRecord):
    """Length of the run, the sections with additional resistance, and the unit of their slopes."""

    length_m: Number = Field(ge=1e3, le=1e7)
    slope_unit: Literal["percent", "permille"]
    sections: tuple[Section, ...]

    @model_validator(mode="after")
    def _sections_in_order(self) -> Self:
        edges = (edge for section in self.sections for edge in (section.from_m, section.to_m))
        increasing("sections: from_m and to_m, up to length_m,", (0.0, *edges, self.length_m), repeated=True)
        return self


class Reference(SourcedRecord):
    """Start, cruise, stop, with the rates that use a range of the input.

    The highest input accelerates against the resistance of the cruise speed, the lowest brakes at that of standstill.
    """

    cruise_mps: Number = Field(ge=0.1, le=150)
    highest_input_n: Positive
    lowest_input_n: Number = Field(lt=0)
    ramp_s: RampTime


class Sampling(SourcedRecord):
    """Sampling of laws and train, rows of the log, and the filter of the differenced position."""

    period_s: Number = Field(ge=1e-5, le=0.1)
    log_every_s: Number = Field(ge=1e-5, le=1)
    speed_filter_s: Number = Field(ge=1e-5, le=1)


class Gains(ColumnTable):
    """Table 2. k_1, k_3 and k_4 in 1/s, k_2 in 1/s^2, k_5 in N s/m."""

    k_1: tuple[Positive, ...]
    k_2: tuple[Positive, ...]
    k_3: tuple[Positive, ...]
    k_4: tuple[Positive, ...]
    k_5: tuple[Positive, ...]


class Networks(SourcedRecord):
    """Both networks: how many neurons along the desired curve, and their width in inputs of order one."""

    neurons: Whole = Field(ge=2, le=10_000)
    width: Positive


class Adaptation(SourcedRecord):
    """Gains and leakage of (19)-(21), (32), (34), (35).

    leak_rate_per_s is Gamma_f sigma_f = Gamma_v sigma_v = alpha_1 beta_1 = alpha_2 beta_2.
    """

    gamma_f_per_s2: Positive
    alpha_1_per_s2: Positive
    gamma_v_n_per_m: Positive
    alpha_2_n_per_m: Positive
    leak_rate_per_s: LeakRate
    kappa_1_mps: Positive
    kappa_2_mps: Positive


class Start(SourcedRecord):
    """Initial estimates and priors; the train stands at position 0."""

    s_hat_m: Number
    v_hat_mps: Number
    weights: Number
    robust: NonNegative


class Push(SourcedRecord):
    """A disturbance d = (sine_n sin(omega t) + cosine_n cos(omega t))/M from a time on."""

    title: Text
    from_s: NonNegative
    sine_n: Number = Field(ge=-1e8, le=1e8)
    cosine_n: Number = Field(ge=-1e8, le=1e8)
    omega_rad_s: Number = Field(ge=0, le=1e3)

    @property
    def largest_n(self) -> float:
        """The largest M d, N."""
        return math.hypot(self.sine_n, self.cosine_n)

    @property
    def phase_rad(self) -> float:
        """The phase with which M d = largest_n sin(omega t + phase)."""
        return math.atan2(self.cosine_n, self.sine_n)


class Printed(ColumnTable):
    """A table of results as the paper prints it, SI units."""

    energy: tuple[Number, ...]
    s_tilde_m: tuple[Number, ...]
    v_tilde_mps: tuple[Number, ...]
    position_m: tuple[Number, ...]
    speed_mps: tuple[Number, ...]


class FigureRanges(SourcedRecord):
    """Ranges that the text names for Figures 14 to 18."""

    s_tilde_m: Range
    v_tilde_mps: Range
    position_m: Range
    speed_mps: Range
    input_n: Range


class Runs(SourcedRecord):
    """Which columns and leak rates the studies of divergence and sensitivity run.

    inferred_changes: titles of the changes under which the paper's numbers seem to have been computed;
    divergence_change: title of the change under which the signs are compared.
    """

    table_3_disturbance: Text
    inferred_changes: tuple[Text, ...]
    divergence_change: Text
    divergence_columns: tuple[Column, ...]
    divergence_leak_rates_per_s: tuple[LeakRate, ...]
    sensitivity_law: Text
    sensitivity_columns: tuple[Column, ...]


class FurtherLaws(ExtraTable):
    """Laws whose runs of Tables 3 and 4 stand beside those of the printed law and the corrected one."""

    laws: tuple[Text, ...]


class LiuChange(Change):
    """One change of an assumed value; columns, law: those that it runs, unless as stated."""

    columns: tuple[Column, ...] = ()
    law: Text | None = None


class LiuStudy(ReproducedStudy):
    """Everything that the runs of liu2020 need, with the source of every value."""

    train: Train
    line: Line
    reference: Reference
    sampling: Sampling
    gains: Gains
    networks: Networks
    adaptation: Adaptation
    start: Start
    disturbances: dict[str, Push]
    table_3: Printed
    table_4: Printed
    table_4_column: Column
    figure_ranges: FigureRanges
    runs: Runs
    further_laws: FurtherLaws
    changes: tuple[LiuChange, ...] = ()

    @property
    def compared_columns(self) -> tuple[int, ...]:
        """With whose gains laws are held against MPC: Table 4's column, after the one before."""
        return tuple(dict.fromkeys((self.table_4_column - 1 or 1, self.table_4_column)))

    def check(self) -> None:
        """Tables are as long as what they list, and what names a disturbance, law or change names one that is there."""
        for key, table, wanted in (("gains", self.gains, COLUMNS), ("table_3", self.table_3, COLUMNS),
                                   ("table_4", self.table_4, len(self.disturbances))):
            if table.columns != wanted:
                raise ValueError(f"{key}: has {table.columns} columns: give {wanted}, one for each that it is of")
        one_of("runs.table_3_disturbance", "disturbance", self.runs.table_3_disturbance, self.disturbances)
        for key, law in (("runs.sensitivity_law", self.runs.sensitivity_law),
                         *(("further_laws.laws", law) for law in self.further_laws.laws),
                         *((f"changes: '{change.title}'", change.law) for change in self.changes if change.law)):
            one_of(key, "law", law, LAWS)
        titles = [change.title for change in self.changes]
        # A changed study has no changes of its own.
        for key, title in (("divergence_change", self.runs.divergence_change),
                           *(("inferred_changes", title) for title in self.runs.inferred_changes)) if titles else ():
            one_of(f"runs.{key}", "change", title, titles)

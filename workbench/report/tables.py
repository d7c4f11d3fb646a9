"""The tables of a report as rows of text: what was printed beside what was obtained."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from workbench.files.numbers import NOTHING, fixed, grouped, number
from workbench.files.units import KWH_J
from workbench.report.sources import stated
from workbench.simulate.closed_loop import Run
from workbench.simulate.controllers import COMPILED, SAMPLED, compiled_law
from workbench.simulate.metrics import Metrics
from workbench.simulate.sweep_rows import WHOLE_RUN, SweepSummary
from workbench.trains.scenario import Scenario, Variant


@dataclass(frozen=True)
class MetricRow:
    """One metric of all controllers: label, unit, a text each, and which of them are the best."""

    label: str
    unit: str
    cells: tuple[str, ...]
    best: frozenset[int]


@dataclass(frozen=True)
class ComparedRow:
    """One controller of the paper's table: (printed, obtained, difference) for each of its columns, in mm."""

    title: str
    cells: tuple[tuple[str, str, str], ...]
    failed: str
    in_paper: bool


@dataclass(frozen=True)
class SingleValueRow:
    """A single printed value beside what the nominal run gave."""

    what: str
    source: str
    printed: str
    obtained: str
    difference: str
    unit: str


@dataclass(frozen=True)
class VariantCell:
    """One controller under one change: its errors in mm; of a failed run why, and in `stop` when."""

    error: str
    stop: str
    failed: str
    differs: bool


@dataclass(frozen=True)
class VariantRow:
    """One change of the assumed data, and all controllers under it."""

    title: str
    changes: tuple[str, ...]
    cells: tuple[VariantCell | None, ...]


def _significant(scale: float = 1.0, digits: int = 3) -> Callable[[float], str]:
    return lambda value: number(value * scale, digits)


def _count(value: float) -> str:
    return grouped(str(int(value)))


# key, label, unit, how it is written, whether smaller is better (None: there is no better)
_Write = Callable[[float], str]
METRICS: tuple[tuple[str, str, str, _Write, bool], ...] = (
    ("period_s", "Sampling period", "ms", _significant(1e3), False),
    ("position_error_min", "Position error, lowest", "mm", _significant(1e3), True),
    ("position_error_max", "Position error, highest", "mm", _significant(1e3), True),
    ("speed_error_min", "Speed error, lowest", "mm/s", _significant(1e3), True),
    ("speed_error_max", "Speed error, highest", "mm/s", _significant(1e3), True),
    ("position_rms", "Position error, RMS", "mm", _significant(1e3), True),
    ("speed_rms", "Speed error, RMS", "mm/s", _significant(1e3), True),
    ("stopping_error", "Stopping error", "mm", _significant(1e3), True),
    ("energy_J", "Traction energy at the wheel", "kWh", lambda v: fixed(v / KWH_J, 1), True),
    ("jerk_rms", "Jerk over plant steps, RMS", "m/s³", _significant(), True),
    ("jerk_p95", "Jerk over plant steps, 95th percentile", "m/s³", _significant(), True),
    ("jerk_max", "Jerk over plant steps, largest", "m/s³", _significant(), True),
    ("logged_jerk_rms", "Jerk between rows of the log, RMS", "m/s³", _significant(), True),
    ("comfort_rms", "Acceleration weighted by ISO 2631-1 W_d, RMS", "m/s²", _significant(), True),
    ("command_variation", "Variation of the command each second", "m/s³", _significant(), True),
    ("switchings", "Changes between traction and braking each second", "1/s", _significant(), True),
    ("overspeed_max", "Largest excess over the speed limits", "m/s", _significant(), True),
    ("saturated_fraction", "Samples with the force at a limit", "%", _significant(100.0), True),
    ("rate_limited_fraction", "Plant steps at a limit of the force's rate", "%", _significant(100.0), True),
    ("adhesion_limited_fraction", "Plant steps at the adhesion limit", "%", _significant(100.0), True),
    ("limit_violations", "Plant steps outside the position band", "", _count, True),
    ("command_max", "Command, highest", "m/s²", _significant(), False),
    ("command_min", "Command, lowest", "m/s²", _significant(), False),
    ("speed_min", "Lowest speed (below 0: rolling back)", "mm/s", _significant(1e3), True),
    ("time_of_max_position_error", "Time of the largest |position error|", "s", lambda v: fixed(v, 1), False),
    ("step_us_median", "Time per control step, median", "µs", _significant(), True),
    ("step_us_p99", "Time per control step, 99th percentile", "µs", _significant(), True),
    ("deadline_misses", "Steps longer than the sampling period", "", _count, True),
)


def nominal_table(metrics: Sequence[Metrics]) -> list[MetricRow]:
    """All metrics as rows, controllers as columns; the smallest magnitude is best where that has a sense.

    Of a failed run only what it did until then is shown.
    """
    rows = []
    for key, label, unit, write, smaller in METRICS:
        values: list[float | None] = [
            None if m.failed is not None and key in WHOLE_RUN else m.row()[key]  # type: ignore[misc]
            for m in metrics
        ]
        texts = [NOTHING if value is None else write(value) for value in values]
        whole = {i: abs(v) for i, v in enumerate(values) if v is not None and metrics[i].failed is None}
        shown = {texts[i] for i in whole}
        first = texts[min(whole, key=whole.__getitem__)] if smaller and len(shown) > 1 else None
        rows.append(MetricRow(label, unit, tuple(texts), frozenset(i for i in whole if texts[i] == first)))
    return rows


def information(scenario: Scenario, controller: str) -> str:
    """What a controller is allowed to know, in words."""
    spec = scenario.controllers[controller]
    source = compiled_law(scenario, spec) or SAMPLED.get(spec.law)
    return str(getattr(source, "information", NOTHING))


def titles(scenario: Scenario, runs: Sequence[Run]) -> dict[str, str]:
    """The name of each controller to show."""
    names = {name: spec.title or name for name, spec in scenario.controllers.items()}
    return names | {run.controller: run.title for run in runs}


def compared_table(scenario: Scenario, summaries: Sequence[SweepSummary],
                   names: Mapping[str, str]) -> list[ComparedRow]:
    """The paper's table beside the sweep, in the paper's order; controllers it lacks follow."""
    printed = {row.controller: row for row in scenario.printed_table.rows} if scenario.printed_table else {}
    found = {summary.controller: summary for summary in summaries}
    rows = []
    for controller in [*printed, *(name for name in found if name not in printed)]:
        row, own = printed.get(controller), found.get(controller)
        cells = (
            _compare_ranges(row.position_error_m if row else None,
                            (own.position_error_min, own.position_error_max) if own else (None, None)),
            _compare_ranges(row.speed_error_mps if row else None,
                            (own.speed_error_min, own.speed_error_max) if own else (None, None)),
            _compare(row.stopping_accuracy_m if row else None,
                     own.mean_abs_stopping_error if own else None, 1e3),
        )
        failed = f"{own.failed}/{own.runs}" if own else NOTHING
        rows.append(ComparedRow(names.get(controller, controller), cells, failed, row is not None))
    return rows


_Range = tuple[float | None, float | None]


def _compare_ranges(printed: tuple[float, float] | None, obtained: _Range) -> tuple[str, str, str]:
    (low, low_obtained, low_off), (high, high_obtained, high_off) = (
        _compare(p, o, 1e3) for p, o in zip(printed or (None, None), obtained, strict=True))
    off = NOTHING if NOTHING in (low_off, high_off) else f"{low_off}; {high_off}"
    return _pair(low, high), _pair(low_obtained, high_obtained), off


def _pair(low: str, high: str) -> str:
    return NOTHING if NOTHING in (low, high) else f"[{low}, {high}]"


def _compare(printed: float | None, obtained: float | None, scale: float = 1.0) -> tuple[str, str, str]:
    """Printed (as many digits as were printed), obtained and difference, in units of 1/scale."""
    printed = None if printed is None else printed * scale
    obtained = None if obtained is None else obtained * scale
    difference = None if printed is None or obtained is None else obtained - printed
    return stated(printed), number(obtained), number(difference)


def printed_values_table(scenario: Scenario, metrics: Sequence[Metrics],
                         names: Mapping[str, str]) -> list[SingleValueRow]:
    """The single values that the paper prints beside the nominal run's."""
    found = {m.controller: m for m in metrics}
    rows = []
    for value in scenario.printed_values:
        own = found.get(value.controller)
        measured = getattr(own, value.metric, None) if own and own.failed is None else None
        obtained = float(measured) if isinstance(measured, int | float) else None
        label = next((label for key, label, *_ in METRICS if key == value.metric),
                     value.metric.replace("_", " "))
        told = label[:1].lower() + label[1:] if label[1:2].islower() else label  # RMS stays
        rows.append(SingleValueRow(f"{names.get(value.controller, value.controller)}: {told}", value.source,
                               *_compare(value.value, obtained), value.unit))
    return rows


def largest_error(metrics: Metrics) -> float | None:
    """Largest |position error| in m of a run that did not fail."""
    if metrics.failed is not None:
        return None
    return max(abs(metrics.position_error_min), abs(metrics.position_error_max))


def compiled_words(scenario: Scenario, names: Mapping[str, str]) -> str:
    """Which controllers are run in their compiled form where there are many runs; empty without one."""
    those = [names.get(name, name) for name, spec in scenario.controllers.items() if spec.law in COMPILED]
    return f" {', '.join(those)}: solved by compiled code here, by casadi in the runs as stated." if those else ""


def variants_table(nominal: Sequence[Metrics],
                   variants: Sequence[tuple[Variant, Sequence[Metrics]]]) -> list[VariantRow]:
    """Largest |position error| and stopping error by change and controller; the nominal data first."""
    base = {m.controller: largest_error(m) for m in nominal}
    rows = [VariantRow("as stated", (), tuple(_variant_cell(m, None) for m in nominal))]
    for variant, metrics in variants:
        found = {m.controller: m for m in metrics}
        rows.append(VariantRow(
            variant.title, tuple(map(_change, variant.set, variant.set.values())),
            tuple(_variant_cell(found[m.controller], base[m.controller]) if m.controller in found else None
                  for m in nominal),
        ))
    return rows


def _change(key: str, value: object) -> str:
    """A change of a stated value; of a table what is stated, not where that comes from."""
    if isinstance(value, Mapping):
        return f"{key} = ({stated({name: entry for name, entry in value.items() if name != 'source'})})"
    return f"{key} = {stated(value)}"


def _variant_cell(metrics: Metrics, base: float | None) -> VariantCell:
    error = largest_error(metrics)
    if error is None:
        reason = metrics.failed or ""
        when = re.search(r"t = ([\d.]+) s", reason)
        return VariantCell("", f"{fixed(float(when[1]), 1)} s" if when else "", reason, differs=True)
    differs = base is not None and abs(error - base) > 0.1 * base
    return VariantCell(number(error * 1e3), number(metrics.stopping_error * 1e3), "", differs)

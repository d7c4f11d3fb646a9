"""What the functions of the API return: plain records with tables and figures, for a notebook and other libraries."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.api.frames import data_frame, dataset, html_table, write_mat
from workbench.errors import of_an_extra
from workbench.files.numbers import unit_text
from workbench.simulate.plants.run import Happened, PlantRun
from workbench.systems.setting import Setting


@dataclass(frozen=True, repr=False)
class Run:
    """One run: `run["theta"]` is a column of its log; metrics by name; failed says why it ended early, or is None."""

    setting: Setting
    found: PlantRun

    @property
    def name(self) -> str:
        """The controller's."""
        return self.found.name

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """What the run is measured by; None for what a failed run does not have."""
        return self.found.metrics

    @property
    def failed(self) -> str | None:
        """Why the run ended early."""
        return self.found.failed

    @property
    def events(self) -> tuple[Happened, ...]:
        """What switched the plant, in the order in which it happened: `t_s`, `id` and the `states` just after."""
        return self.found.events

    @property
    def fallbacks(self) -> int:
        """At how many samples an MPC's solver gave nothing usable, so that its last plan went on."""
        return self.found.fallbacks

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the log's columns."""
        return self.found.columns

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        return self.found.column(column)

    def __str__(self) -> str:
        metrics = "\n".join(f"  {name} = {'none' if value is None else format(value, '.6g')}"
                            for name, value in self.metrics.items())
        told = f", {self.fallbacks} sample{'s' * (self.fallbacks > 1)} without a solution" if self.fallbacks else ""
        return (f"{self.name} on {self.setting.plant.id}, {self.failed or f'to {self.found.reached_s:g} s'}{told}\n"
                f"{metrics}")

    __repr__ = __str__

    def to_pandas(self) -> Any:
        """The log as a DataFrame with the time in seconds as its index; WorkbenchError without pandas."""
        return data_frame(self.found.data, "t_s")

    def to_mat(self, path: str | Path) -> None:
        """The log as a MAT file (version 5) that MATLAB and Simulink read: a column vector of doubles each, the time in
        seconds as `t_s`; signs that MATLAB has in no name become underscores. InputError where it cannot be written.
        """
        write_mat(self.found.data, Path(path))

    def to_xarray(self) -> Any:
        """The log as an xarray Dataset over `t_s`, its metrics as attributes; WorkbenchError without xarray."""
        units = {str(symbol): unit for symbol, unit in self.setting.plant.units.items()}
        about = {"controller": self.name, **{name: value for name, value in self.metrics.items() if value is not None}}
        return dataset(self.found.data, units, about)

    def _repr_html_(self) -> str:
        return html_table([{"controller": self.name, **self.metrics, "failed": self.failed}])

    def plot(self, *columns: str) -> Any:
        """A matplotlib Figure of the named columns, or of all states and inputs, over time."""
        return _figure(self.setting, [self.found], columns)


@dataclass(frozen=True, repr=False)
class Comparison:
    """Runs of several controllers on the same plant: `comparison["pd"]` is a Run."""

    setting: Setting
    runs: tuple[Run, ...]

    def __getitem__(self, name: str) -> Run:
        found = {run.name: run for run in self.runs}
        if name not in found:
            raise KeyError(f"no controller '{name}': name one of {', '.join(found)}")
        return found[name]

    def __iter__(self) -> Iterator[Run]:
        return iter(self.runs)

    def __str__(self) -> str:
        return "\n".join(map(str, self.runs))

    __repr__ = __str__

    @property
    def rows(self) -> list[dict[str, Any]]:
        """A row a controller: its metrics, step time, samples without an answer of MPC's solver, and failure."""
        return [{"controller": run.name, **run.metrics, "step_us": run.found.step_us, "fallbacks": run.fallbacks,
                 "failed": run.failed} for run in self.runs]

    def to_pandas(self) -> Any:
        """The rows as a DataFrame; WorkbenchError without pandas."""
        return data_frame(self.rows, "controller")

    def _repr_html_(self) -> str:
        return html_table(self.rows)

    def plot(self, *columns: str) -> Any:
        """A matplotlib Figure of the named columns, or of all states and inputs, a line a controller."""
        return _figure(self.setting, [run.found for run in self.runs], columns)


@dataclass(frozen=True, repr=False)
class Proved:
    """Claims decided: a row each, as `workbench prove --json` writes them."""

    document: Mapping[str, Any]

    @property
    def rows(self) -> list[dict[str, Any]]:
        """A row a claim."""
        return list(self.document["claims"])

    @property
    def verdicts(self) -> dict[str, str]:
        """Claim to verdict."""
        return {row["id"]: row["verdict"] for row in self.rows}

    @property
    def as_recorded(self) -> bool:
        """Whether every verdict is the one that the paper's file records."""
        return all(row["verdict"] == row["recorded"] for row in self.rows)

    def to_pandas(self) -> Any:
        """The rows as a DataFrame; WorkbenchError without pandas."""
        return data_frame(self.rows, "id")

    def __str__(self) -> str:
        return "\n".join(f"{row['verdict']}: {row['id']}: {row['title']}" for row in self.rows)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return html_table([{key: row[key] for key in ("id", "verdict", "title")} for row in self.rows])


def _figure(setting: Setting, runs: Sequence[PlantRun], columns: Sequence[str]) -> Any:
    try:
        from workbench.api.figure import drawn  # noqa: PLC0415 - for plots alone
    except ImportError as trouble:
        raise of_an_extra(trouble) or trouble from None
    plant = setting.plant
    units = {str(symbol): unit_text(unit) for symbol, unit in plant.units.items()}
    shown = columns or [*map(str, plant.states), *map(str, plant.inputs)]
    figure = drawn(figsize=(7.0, 1.8 * len(shown)))
    for axes, name in zip(np.atleast_1d(figure.subplots(len(shown), 1, sharex=True)), shown, strict=True):
        channel = setting.tracks.get(name)
        if channel:
            axes.plot(runs[0].column("t_s"), runs[0].column(channel), color="0.7", linewidth=3, label=channel)
        for run in runs:
            axes.plot(run.column("t_s"), run.column(name), label=run.name)
        axes.set_ylabel(f"{name} ({units[name]})" if units.get(name) else name)
    axes.set_xlabel("time (s)")
    figure.axes[0].legend()
    return figure

"""Margins and Bode plots of a plant's linear loops under a law, by python-control."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.api.frames import data_frame, html_table
from workbench.errors import of_an_extra
from workbench.gains.frequency import loop_margins
from workbench.systems.law import StateLaw
from workbench.systems.loop import opened_loops
from workbench.systems.plant import Plant
from workbench.systems.symbols import named_values

AT_REST = 1e-9  # 1/s: up to here a pole is one of what need not move, as an estimate


@dataclass(frozen=True, repr=False)
class Loops:
    """loops: input to the loop opened there, a `control.StateSpace` under negative feedback; rows: one an input.

    least_gain, most_gain: between which factors of its gain it stays stable; phase_deg: by how much its phase may lag
    more; delay_s: how much later its command may come; largest_pole: real part (1/s) of the closed loop's pole farthest
    to the right: where it is positive the loop is unstable, and the margins are None. moving: states that are not at
    rest at the point, with their rates per second: there the loops are those of an instant, and no run stays there.
    """

    loops: Mapping[str, Any]
    rows: list[dict[str, Any]]
    moving: Mapping[str, float]

    def __str__(self) -> str:
        told = [f"opened at {row['input']}: " + ", ".join(
            f"{key} = {'none' if value is None else format(value, '.4g')}" for key, value in row.items()
            if key != "input") for row in self.rows]
        if self.moving:
            rates = ", ".join(f"{state} by {rate:.4g} per s" for state, rate in self.moving.items())
            told.append(f"at this point the plant does not rest, it moves {rates}: give a point of rest by at={{...}}")
        return "\n".join(told)

    __repr__ = __str__

    def to_pandas(self) -> Any:
        """The rows as a DataFrame; WorkbenchError without pandas."""
        return data_frame(self.rows, "input")

    def _repr_html_(self) -> str:
        return html_table(self.rows)

    def plot(self) -> Any:
        """A Bode plot as a matplotlib Figure, a line an input: gain over phase (degrees), by frequency (rad/s)."""
        try:
            from workbench.api.figure import drawn  # noqa: PLC0415 - for plots alone
        except ImportError as trouble:
            raise of_an_extra(trouble) or trouble from None
        import control  # noqa: PLC0415 - importing it takes seconds

        figure = drawn(figsize=(7.0, 5.0))
        gain, phase = figure.subplots(2, 1, sharex=True)
        for name, loop in self.loops.items():
            found = control.frequency_response(loop)
            gain.loglog(found.omega, np.ravel(found.magnitude), label=f"opened at {name}")
            phase.semilogx(found.omega, np.degrees(np.unwrap(np.ravel(found.phase))))
        gain.axhline(1.0, color="0.7", linewidth=1)
        phase.axhline(-180.0, color="0.7", linewidth=1)
        gain.set_ylabel("gain")
        phase.set_ylabel("phase (degrees)")
        phase.set_xlabel("frequency (rad/s)")
        gain.legend()
        return figure


def margins(plant: Plant, law: StateLaw, *, at: Mapping[Any, float] | None = None,
            parameters: Mapping[Any, float] | None = None, law_parameters: Mapping[Any, float] | None = None) -> Loops:
    """Margins of gain, phase and delay of each input's loop, linear about a point, with the law at every instant.

    at: states of plant and law and symbols of references by name, zero where none is given; parameters: the plant's
    true ones instead of its own. Sampling, lags, delays and limits are left out; sampling delays by half a
    period. Raises ValueError, one line, for what does not fit, a law or plant in steps, and a point without
    derivative.
    """
    import control  # noqa: PLC0415 - importing it takes seconds

    named = [{str(name): value for name, value in named_values(given or {}, "values").items()}
             for given in (parameters, law_parameters)]
    opened = opened_loops(plant, law, at, *named)
    loops = {name: control.ss(one.A, one.B, one.C, np.zeros((1, 1)), inputs=[name], outputs=["back"])
             for name, one in opened.items()}
    rows = []
    for name, one in opened.items():
        found = loop_margins(loops[name]) if one.abscissa <= AT_REST else None
        rows.append({"input": name, "least_gain": found and found.least, "most_gain": found and found.most,
                     "phase_deg": found and found.phase_deg, "delay_s": found and found.delay_s,
                     "largest_pole": one.abscissa})
    rates = next(iter(opened.values())).rates if opened else {}
    return Loops(loops, rows, {state: rate for state, rate in rates.items() if abs(rate) > AT_REST})

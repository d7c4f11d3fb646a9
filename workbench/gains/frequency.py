"""Linear parts in the frequency domain, by python-control: a second opinion on what semidefinite programs say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp
from numpy.typing import NDArray

if TYPE_CHECKING:
    import control

Array = NDArray[np.float64]
ENDLESS = 1e9  # beyond, a gain at which the phase lags by 180 degrees is what rounding makes of none


@dataclass(frozen=True)
class Linear:
    """x' = A x + B w, y = C x + D w in floats; A of shape (states, states)."""

    A: Array
    B: Array
    C: Array
    D: Array


def linear(rates: Mapping[sp.Expr, sp.Expr], inputs: Sequence[sp.Symbol], outputs: Sequence[sp.Expr],
           values: Mapping[sp.Expr, sp.Expr]) -> Linear:
    """The matrices of linear rates and outputs with numbers put in; ValueError where they are not linear in numbers."""
    states = list(rates)
    numbers = {s: sp.sympify(v, strict=True) for s, v in values.items()}
    rows = ([sp.sympify(e, strict=True).xreplace(numbers) for e in exprs] for exprs in (rates.values(), outputs))
    parts = [sp.Matrix(len(exprs), len(by), [sp.diff(e, s) for e in exprs for s in by])
             for exprs in rows for by in (states, list(inputs))]
    if any(part.free_symbols for part in parts):
        raise ValueError("the rates are not linear in the states with numbers: give a value to every other symbol")
    A, B, C, D = (np.array(part.tolist(), dtype=float).reshape(part.shape) for part in parts)
    return Linear(A, B, C, D)


def system(of: Linear) -> control.StateSpace:
    """The system as python-control knows it."""
    import control  # noqa: PLC0415 - importing it takes seconds, and most commands need none of it

    return control.ss(of.A, of.B, of.C, of.D)


def h_infinity_norm(of: Linear) -> float:
    """The largest gain over all frequencies, which is the least L2 gain; infinite for an unstable system."""
    if abscissa(of) >= 0:
        return float("inf")
    import control  # noqa: PLC0415 - as above

    return float(control.norm(system(of), p="inf", tol=1e-8))


def abscissa(of: Linear) -> float:
    """The largest real part of a pole, 1/s: no decay rate beyond its negative can be proved."""
    return float(np.linalg.eigvals(of.A).real.max())


def margins(of: Linear) -> tuple[float, float, float]:
    """Gain margin, phase margin (degrees) and the crossover of the latter (rad/s) of a loop opened at its input."""
    import control  # noqa: PLC0415 - as above

    gain, phase, _, crossover = control.margin(system(of))
    return float(gain), float(phase), float(crossover)


@dataclass(frozen=True)
class Margins:
    """How far a loop opened at one input is from instability: its gain may be from least to most times what it is, its
    phase may lag by phase_deg more, its command may come delay_s later. Infinite where nothing is too much.
    """

    least: float
    most: float
    phase_deg: float
    delay_s: float


def feedback_margins(A: Array, B: Array, K: Array) -> list[Margins]:
    """Margins of x' = A x + B u under u = K x, stable, opened at one input after the other with the others closed."""
    import control  # noqa: PLC0415 - as above

    found = []
    for k in range(B.shape[1]):
        others = [j for j in range(B.shape[1]) if j != k]
        found.append(loop_margins(control.ss(A + B[:, others] @ K[others], B[:, [k]], -K[[k]], np.zeros((1, 1)))))
    return found


def loop_margins(opened: control.StateSpace) -> Margins:
    """Margins of a loop with one input and one output, negative feedback, in continuous time, stable when closed."""
    import control  # noqa: PLC0415 - as above

    gains, phases, _, _, crossovers, _ = control.stability_margins(opened, returnall=True)
    phases = np.mod(np.asarray(phases), 360.0)  # what a lag may be, at each frequency at which the gain is one
    crossing = np.asarray(crossovers) > 0
    delays = np.radians(phases[crossing]) / np.asarray(crossovers)[crossing]
    gains = np.asarray(gains)
    return Margins(max((g for g in gains if 1 / ENDLESS < g < 1), default=0.0),
                   min((g for g in gains if 1 < g < ENDLESS), default=np.inf),
                   min(phases, default=np.inf), min(delays, default=np.inf))

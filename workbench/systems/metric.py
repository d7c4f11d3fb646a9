"""What a run is measured by: an expression, integrated over time, taken at the end, its extreme, or when it was last
above zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import sympy as sp

from workbench.model.law import time
from workbench.systems.symbols import expression

Measure = Literal["integral", "mean", "root mean square", "terminal", "largest", "smallest", "last above zero",
                  "variation", "saturated"]
# Of the commands themselves, before delay and lag.
COMMANDED = ("variation", "saturated")
# What jumps or sits at one instant: no plan is made by it.
UNPLANNED = ("largest", "smallest", "last above zero", *COMMANDED)


@dataclass(frozen=True)
class Metric:
    """expression: over a plant's states, outputs, inputs as they act, disturbances, parameters, references and time.

    measure: its integral over time (integrated with the plant, by the same steps), its mean, the root of the mean of
    its square, its value at the end, its largest or smallest value at any plant step, or the time in s of the last
    plant step at which it is above zero, 0 where it never is: an error has settled within 0.02 at the last above zero
    of `Abs(x - x_d) - 0.02`, unless that is the end of the run. Of an input alone, as it is commanded: its variation,
    the sizes of its changes from sample to sample, summed, each second; the share of samples at which it is saturated,
    at a limit of it or asked beyond. Raises ValueError for what is none.
    """

    id: str
    measure: Measure
    expression: Any
    unit: str = ""
    title: str = ""

    def __post_init__(self) -> None:
        if self.measure not in get_args(Measure):
            raise ValueError(f"metric '{self.id}': measure {self.measure!r} is not known: it is one of "
                             f"{', '.join(get_args(Measure))}")
        object.__setattr__(self, "expression", expression(self.expression, f"metric '{self.id}'"))
        if self.measure == "last above zero" and not self.unit:
            object.__setattr__(self, "unit", "s")

    @property
    def integrand(self) -> sp.Expr | None:
        """What is integrated with the plant; None where nothing is."""
        if self.measure == "root mean square":
            return self.expression**2
        return self.expression if self.measure in ("integral", "mean") else None

    @property
    def watched(self) -> sp.Expr | None:
        """Of what the largest value at any plant step is kept; None where of nothing."""
        if self.measure == "last above zero":
            return sp.Piecewise((time, self.expression > 0), (-sp.Abs(self.expression), True))  # no number stays none
        return {"largest": self.expression, "smallest": -self.expression}.get(self.measure)

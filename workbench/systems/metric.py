"""What a run is measured by: an expression, integrated over time, taken at the end, or its extreme."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import sympy as sp

from workbench.systems.symbols import expression

Measure = Literal["integral", "mean", "root mean square", "terminal", "largest", "smallest"]


@dataclass(frozen=True)
class Metric:
    """expression: over a plant's states, outputs, inputs as they act, disturbances, parameters, references and time.

    measure: its integral over time (integrated with the plant, by the same steps), its mean, the root of the mean of
    its square, its value at the end, or its largest or smallest value at any plant step. Raises ValueError for what is
    none.
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

    @property
    def integrand(self) -> sp.Expr | None:
        """What is integrated with the plant; None where nothing is."""
        if self.measure == "root mean square":
            return self.expression**2
        return self.expression if self.measure in ("integral", "mean") else None

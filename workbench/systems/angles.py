"""Angles for the prover, which knows no sines: sine and cosine become two states on the unit circle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp


@dataclass(frozen=True)
class OnCircle:
    """An angle by its sine and cosine, real symbols of one's own.

    What is proved for all pairs on the circle (`square == 1`) holds for every angle. A counterexample is one of the
    plant where the angle itself stands nowhere else in the goal. Multiples of the angle must be expanded first.
    """

    angle: sp.Symbol
    sine: sp.Symbol
    cosine: sp.Symbol

    @property
    def square(self) -> sp.Expr:
        """sine^2 + cosine^2, which is one."""
        return self.sine**2 + self.cosine**2

    def put(self, expr: sp.Expr) -> sp.Expr:
        """The expression over the two symbols."""
        return expr.xreplace({sp.sin(self.angle): self.sine, sp.cos(self.angle): self.cosine})

    def flow(self, rates: Mapping[sp.Expr, sp.Expr]) -> dict[sp.Expr, sp.Expr]:
        """A flow with the two symbols moving as the angle does."""
        rate = rates[self.angle]
        return {state: self.put(value) for state, value in rates.items()} | {
            self.sine: self.put(self.cosine * rate), self.cosine: self.put(-self.sine * rate)}

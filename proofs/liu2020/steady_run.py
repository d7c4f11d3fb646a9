"""What the stated gains mean before anything is simulated: eigenvalues of the observer, errors of a steady run.

All from the expressions of (12), (13) and (31) without networks and robust terms.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from . import laws as paper
from .laws import FEEDBACK_GAINS
from .plant import M, chi, s, v

if TYPE_CHECKING:
    from .study.record import LiuStudy

DAMPED: dict[str, sp.Expr] = {"v_tilde": paper.v_error, "s_tilde'": paper.s_error_rate}

a = sp.Symbol("a", real=True)


def error_rates(damped: str) -> tuple[sp.Expr, sp.Expr]:
    """Rates of s_tilde and v_tilde, in s_tilde and v_tilde, at the acceleration a; `damped`: a key of DAMPED."""
    alone: dict[sp.Basic, sp.Expr] = {paper.f_hat: sp.Integer(0), paper.D_1: sp.Integer(0)}
    v_hat_rate = paper.speed_estimate_rate(DAMPED[damped]).xreplace(alone)
    in_errors = {paper.s_hat: s + paper.s_tilde, paper.v_hat: v + paper.v_tilde}
    return (sp.expand(paper.s_error_rate.xreplace(in_errors)), sp.expand((v_hat_rate - a).xreplace(in_errors)))


def steady_position_error() -> sp.Expr:
    """s_d - s over the acceleration while this is constant, no resistance and exact estimates: (31) with (22), (23)."""
    at_rest = {paper.s_hat: s, paper.v_hat: v, paper.sdot_d: v, paper.s_d: s + paper.s_tilde}
    force = (paper.k_5 * paper.e_v_stated).xreplace(at_rest)
    (found,) = sp.solve(force - M / chi * a, paper.s_tilde)
    return sp.simplify(found / a)


def eigenvalues(study: LiuStudy, column: int, damped: str) -> NDArray[np.complex128]:
    """Eigenvalues of the observer's errors for a column of Table 2, 1/s."""
    rates = sp.Matrix(error_rates(damped))
    matrix = rates.jacobian([paper.s_tilde, paper.v_tilde]).xreplace(gains(study, column))
    return np.linalg.eigvals(np.array(matrix.tolist(), dtype=float)).astype(complex)


def largest_step_s(values: NDArray[np.complex128]) -> float:
    """The step below which Euler's steps of a linear system with these eigenvalues settle, s."""
    return float(np.min(-2 * values.real / np.abs(values) ** 2))


def gains(study: LiuStudy, column: int) -> dict[sp.Basic, sp.Float]:
    """The gains of a column of Table 2, chi and M, by symbol."""
    values = {symbol: getattr(study.gains, name)[column - 1] for name, symbol in zip(
        FEEDBACK_GAINS, (paper.k_1, paper.k_2, paper.k_3, paper.k_4, paper.k_5), strict=True)}
    return {symbol: sp.Float(value) for symbol, value in (
        values | {chi: study.train.chi, M: study.train.mass_kg}).items()}


@dataclass(frozen=True)
class Implied:
    """What a printed column implies if its errors are those of a steady run by feedback alone, with k_3 v_tilde.

    by_estimates, by_position: the RMS acceleration from RMS(s_tilde) and RMS(v_tilde), and from RMS(s - s_d), m/s^2;
    step_s: the step of Euler's rule by which s_tilde exceeds v_tilde/k_1.
    """

    column: int
    by_estimates: float
    by_position: float
    step_s: float

    @property
    def ratio(self) -> float:
        """How many times the loop from the input to the position is tighter than its stated gains."""
        return self.by_estimates / self.by_position


def implied(study: LiuStudy, column: int, s_tilde_m: float, v_tilde_mps: float, position_m: float) -> Implied:
    """What a column's printed RMS values imply.

    Euler's rule advances s_hat by T s_hat', the train advances by v T + a T^2/2: in a steady run s_tilde' = a T/2.
    """
    at: dict[sp.Basic, sp.Expr] = {**gains(study, column), paper.s_tilde: sp.Float(-s_tilde_m),
                                   paper.v_tilde: sp.Float(-v_tilde_mps)}
    s_rate, v_rate = (rate.xreplace(at) for rate in error_rates("v_tilde"))
    (acceleration,) = sp.solve(v_rate, a)
    by_position = position_m / abs(float(steady_position_error().xreplace(at)))
    return Implied(column, float(acceleration), by_position, float(2 * s_rate / acceleration))

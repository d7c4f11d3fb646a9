"""A second-order-cone program built block by block and given to clarabel: minimise c x, where A x + s = b, s in cones.

cvxpy would compile the same program in several times the seconds that solving it takes; a run's has one structure.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import clarabel
import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from workbench.errors import SolverError
from workbench.optimal.course import Array

# Accuracy asked of clarabel; what it returns is checked again by everything that follows. Where it stops before, an
# answer whose cost and dual cost differ by no more than the other share is as near as careful solving comes.
TOLERANCE, NEAR = 1e-8, 1e-4


class NoPlanError(SolverError):
    """The cone program has no solution; the message names the solver's status."""


@dataclass(frozen=True)
class Linear:
    """Some rows of linear expressions of the program's variables: sums of value times variable, and a constant.

    row, variable, value: shape (entries,), in any order; entries of the same row and variable add up. constant: shape
    (rows,). As a sparse matrix each step of building a program would cost more than its arithmetic.
    """

    row: NDArray[np.intp]
    variable: NDArray[np.intp]
    value: Array
    constant: Array

    def __add__(self, other: Linear | Array | float) -> Linear:
        if isinstance(other, Linear):
            return Linear(np.concatenate((self.row, other.row)), np.concatenate((self.variable, other.variable)),
                          np.concatenate((self.value, other.value)), self.constant + other.constant)
        return Linear(self.row, self.variable, self.value, self.constant + other)

    def __sub__(self, other: Linear | Array | float) -> Linear:
        return self + (-1.0 * other)

    def __rmul__(self, factor: Array | float) -> Linear:
        rows = np.broadcast_to(np.asarray(factor, dtype=float), self.constant.shape)
        return Linear(self.row, self.variable, rows[self.row] * self.value, rows * self.constant)

    __array_ufunc__ = None  # so that numpy leaves `array * Linear` to this class

    def __getitem__(self, rows: slice | NDArray[np.bool_] | NDArray[np.intp]) -> Linear:
        chosen = np.arange(len(self.constant))[rows]
        place = np.full(len(self.constant), -1)
        place[chosen] = np.arange(len(chosen))
        kept = place[self.row] >= 0
        return Linear(place[self.row[kept]], self.variable[kept], self.value[kept], self.constant[rows])


@dataclass(frozen=True)
class Rule:
    """Rows of the program: where they begin, and how many."""

    start: int
    count: int


@dataclass(frozen=True)
class Solution:
    """Values of all variables and multipliers of all rows, the least cost, clarabel's word and its seconds."""

    x: Array
    multipliers: Array
    cost: float
    status: str
    solve_s: float

    def of(self, expression: Linear) -> Array:
        """The expression's value."""
        terms = expression.value * self.x[expression.variable]
        return np.asarray(np.bincount(expression.row, terms, len(expression.constant)) + expression.constant)

    def price(self, rule: Rule) -> Array:
        """The multipliers of a rule's rows."""
        return self.multipliers[rule.start:rule.start + rule.count]


@dataclass
class ConeProgram:
    """Variables are numbered as they are made; rules are added in the order of their cones: zero, linear, cones."""

    size: int
    _blocks: list[tuple[str, Linear]] = field(default_factory=list)
    _rows: int = 0

    def variables(self, start: int, count: int) -> Linear:
        """Some of the variables themselves."""
        return Linear(np.arange(count), start + np.arange(count), np.ones(count), np.zeros(count))

    def nothing(self, count: int) -> Linear:
        """Rows of zeros."""
        none = np.zeros(0, dtype=np.intp)
        return Linear(none, none, np.zeros(0), np.zeros(count))

    def factors(self, expression: Linear, weight: Array) -> Array:
        """What each variable is multiplied by in the sum of the rows times their weights, shape (size,)."""
        return np.asarray(np.bincount(expression.variable, expression.value * weight[expression.row], self.size),
                          dtype=float)

    def require_zero(self, expression: Linear) -> Rule:
        """expression = 0."""
        return self._add("zero", expression)

    def require_at_most(self, expression: Linear) -> Rule:
        """expression <= 0."""
        return self._add("linear", expression)

    def require_cones(self, length: Linear, one: Linear, two: Linear) -> Rule:
        """The norm of (one, two) is at most length, row by row."""
        three = (length, one, two)
        stacked = Linear(np.concatenate([3 * of.row + k for k, of in enumerate(three)]),
                         np.concatenate([of.variable for of in three]), np.concatenate([of.value for of in three]),
                         np.stack([of.constant for of in three], axis=1).ravel())
        return self._add("cone", -1.0 * stacked)

    def _add(self, kind: str, expression: Linear) -> Rule:
        rule = Rule(self._rows, len(expression.constant))
        self._blocks.append((kind, expression))
        self._rows += rule.count
        return rule

    def solve(self, cost: Array, what: str, unit: float = 1.0) -> Solution:
        """Quickly first, then carefully; raises NoPlanError where neither way gives a solution.

        unit: of the cost that clarabel is given; how many iterations it takes hangs on it, the solution does not.
        """
        blocks = [block for _, block in self._blocks]
        starts = np.insert(np.cumsum([len(block.constant) for block in blocks]), 0, 0)
        row = np.concatenate([block.row + start for block, start in zip(blocks, starts, strict=False)])
        matrix = sparse.csc_matrix((np.concatenate([block.value for block in blocks]),
                                    (row, np.concatenate([block.variable for block in blocks]))),
                                   shape=(self._rows, self.size))
        right = -np.concatenate([block.constant for block in blocks])
        cones: list[object] = []
        for kind, block in self._blocks:
            count = len(block.constant)
            if kind == "cone":
                cones += [clarabel.SecondOrderConeT(3)] * (count // 3)
            elif count:
                cones.append(clarabel.ZeroConeT(count) if kind == "zero" else clarabel.NonnegativeConeT(count))
        spent, trouble, almost = 0.0, "", None
        # Without refining each step's linear equations a program takes half the time; some then end inaccurately.
        for is_quick in (True, False):
            started = time.perf_counter()
            answer = clarabel.DefaultSolver(sparse.csc_matrix((self.size, self.size)), cost / unit,
                                            matrix, right, cones, _settings(is_quick, unit)).solve()
            spent += time.perf_counter() - started
            status = str(answer.status)
            found = Solution(np.asarray(answer.x), unit * np.asarray(answer.z), unit * answer.obj_val, status, spent)
            apart = abs(answer.obj_val - answer.obj_val_dual)
            if status == "Solved" or (status == "AlmostSolved" and apart <= NEAR * abs(answer.obj_val)):
                return found
            almost = found if status == "AlmostSolved" else almost
            trouble = f"clarabel says '{status}' of {what}: allow more time or other intervals"
            if status == "PrimalInfeasible":  # shown by multipliers that clarabel has checked; more care shows the same
                break
        # An inaccurate solution may serve: nothing that follows takes the solver's word for it.
        if almost is None:
            raise NoPlanError(trouble)
        return almost


def _settings(is_quick: bool, unit: float) -> clarabel.DefaultSettings:
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs, settings.tol_gap_rel, settings.tol_feas = TOLERANCE / unit, TOLERANCE, TOLERANCE
    settings.iterative_refinement_enable = not is_quick
    return settings

"""Derivatives along a flow, of syntax trees: written anew, to share nothing with what they are held against."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass

ZERO, ONE = ast.Constant(0), ast.Constant(1)


class NotStatedError(Exception):
    """What cannot be put to the solver; says which and why."""


def call(name: str, *parts: ast.expr) -> ast.Call:
    """A function of expressions."""
    return ast.Call(ast.Name(name, ast.Load()), list(parts), [])


def times(left: ast.expr, right: ast.expr) -> ast.expr:
    """A product, of which nothing is left where a factor is the number 0."""
    if ZERO in (left, right):
        return ZERO
    return right if left is ONE else left if right is ONE else ast.BinOp(left, ast.Mult(), right)


def plus(left: ast.expr, right: ast.expr) -> ast.expr:
    """A sum, without the number 0."""
    return right if left is ZERO else left if right is ZERO else ast.BinOp(left, ast.Add(), right)


def minus(part: ast.expr) -> ast.expr:
    """The opposite."""
    return part if part is ZERO else ast.UnaryOp(ast.USub(), part)


def over(above: ast.expr, below: ast.expr) -> ast.expr:
    """A fraction."""
    return above if above is ZERO else ast.BinOp(above, ast.Div(), below)


def _square(part: ast.expr) -> ast.expr:
    return ast.BinOp(part, ast.Pow(), ast.Constant(2))


# The derivative of each function of one argument that has one wherever it is defined.
SLOPES: dict[str, Callable[[ast.expr], ast.expr]] = {
    "exp": lambda u: call("exp", u),
    "log": lambda u: over(ONE, u),
    "sin": lambda u: call("cos", u),
    "cos": lambda u: minus(call("sin", u)),
    "tan": lambda u: over(ONE, _square(call("cos", u))),
    "tanh": lambda u: plus(ONE, minus(_square(call("tanh", u)))),
    "arctan": lambda u: over(ONE, plus(ONE, _square(u))),
    "sqrt": lambda u: over(ONE, times(ast.Constant(2), call("sqrt", u))),
}


@dataclass(frozen=True)
class Flow:
    """The rates of symbols, as syntax trees; `unknown` are those that move and whose rates nobody knows."""

    rates: Mapping[str, ast.expr]
    unknown: frozenset[str] = frozenset()

    def rate_of(self, node: ast.expr) -> ast.expr:  # noqa: PLR0911 - a case a kind
        """The derivative of an expression along the flow; NotStatedError for one that may have none."""
        match node:
            case ast.Constant():
                return ZERO
            case ast.Name(id=name):
                if name in self.unknown:
                    raise NotStatedError(f"the rate of {name} is unknown")
                return self.rates.get(name, ZERO)
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return minus(self.rate_of(inner))
            case ast.BinOp(left=base, op=ast.Pow(), right=power):
                lower = ast.BinOp(power, ast.Sub(), ONE)
                rate = self.rate_of(base)
                return times(times(power, ast.BinOp(base, ast.Pow(), lower)), rate) if rate is not ZERO else ZERO
            case ast.BinOp(left=left, op=op, right=right):
                return self._of_operation(left, op, right)
            case ast.Call(func=ast.Name(id="Sum"), args=[inner]):
                rate = self.rate_of(inner)
                return rate if rate is ZERO else call("Sum", rate)
            case ast.Call(func=ast.Name(id="D"), args=[inner]):
                return self.rate_of(self.rate_of(inner))
            case ast.Call(func=ast.Name(id=name), args=[inner]) if name in SLOPES:
                rate = self.rate_of(inner)
                return rate if rate is ZERO else times(SLOPES[name](inner), rate)
        raise NotStatedError(f"{ast.unparse(node)[:60]} has no derivative everywhere")

    def _of_operation(self, left: ast.expr, op: ast.operator, right: ast.expr) -> ast.expr:
        first, second = self.rate_of(left), self.rate_of(right)
        match op:
            case ast.Add():
                return plus(first, second)
            case ast.Sub():
                return plus(first, minus(second))
            case ast.Mult():
                return plus(times(first, right), times(left, second))
            case ast.Div():
                return plus(over(first, right), minus(over(times(left, second), _square(right))))
        raise NotStatedError(f"the operation {type(op).__name__}")

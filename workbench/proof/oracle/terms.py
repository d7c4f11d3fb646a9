"""Expressions and relations of the certificate language as terms of z3, beside what they need to be defined."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import z3

from workbench.proof.oracle.rates import Flow, NotStatedError

OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b}
RELATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "<=": lambda a, b: a <= b, ">=": lambda a, b: a >= b, "==": lambda a, b: a == b, "=": lambda a, b: a == b,
    "!=": lambda a, b: a != b, "<": lambda a, b: a < b, ">": lambda a, b: a > b}
MOST_FACTORS = 64  # of a power
_RELATION = re.compile(r" (<=|>=|==|!=|<|>) ")
UNKNOWN_FUNCTIONS = ("exp", "log", "sin", "cos", "tanh", "arctan")


@dataclass
class Terms:
    """Reads expressions of one goal; sums have `count` terms, of indexed symbols one for each.

    defined: what the expressions read so far need to have values; true: what holds of the roots and functions that
    stand in them; loose: the functions of which z3 knows only what `true` says, so that a model may be none.
    """

    flow: Flow = field(default_factory=lambda: Flow({}))
    indexed: frozenset[str] = frozenset()
    count: int = 1
    defined: list[Any] = field(default_factory=list)
    true: list[Any] = field(default_factory=list)
    loose: set[str] = field(default_factory=set)

    def relation(self, text: str) -> Any:
        """A relation, for every index that it leaves open. NotStatedError where z3 has no words for it."""
        parts = _RELATION.split(text)
        if len(parts) != 3:
            raise NotStatedError(f"'{text[:60]}' is no single relation")
        return self.related(parts[1], parts[0], parts[2])

    def related(self, operator: str, left: str, right: str) -> Any:
        """The same, in its parts."""
        sides = self.read(left), self.read(right)
        places = range(self.count) if any(_open(side, self.indexed) for side in sides) else (None,)
        return z3.And(*(RELATIONS[operator](self.term(sides[0], at), self.term(sides[1], at)) for at in places))

    @staticmethod
    def read(text: str) -> ast.expr:
        """The syntax tree of an expression; nothing is evaluated."""
        try:
            return ast.parse(text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise NotStatedError(f"'{text[:60]}' cannot be read") from None

    def term(self, node: ast.expr, at: int | None) -> Any:
        """An expression; at: which index is meant where one stands."""
        match node:
            case ast.Constant(value=int() | float() as value):
                return z3.RealVal(str(value))
            case ast.Name(id=name):
                return self._symbol(name, at)
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return -self.term(inner, at)
            case ast.BinOp(left=base, op=ast.Pow(), right=power):
                return self._power(self.term(base, at), _whole(power))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                below = self.term(right, at)
                if isinstance(op, ast.Div):
                    self.defined.append(below != 0)
                return OPERATORS[type(op)](self.term(left, at), below)
            case ast.Call(func=ast.Name(id=name), args=parts):
                return self._call(name, parts, at)
        raise NotStatedError(f"{ast.unparse(node)[:60]} has no words in z3")

    def _symbol(self, name: str, at: int | None) -> Any:
        if name not in self.indexed:
            return z3.Real(name)
        if at is None:
            raise NotStatedError(f"the index of {name} is open")
        return z3.Real(f"{name}[{at}]")

    def _power(self, base: Any, power: int) -> Any:
        if abs(power) > MOST_FACTORS:
            raise NotStatedError(f"the power {power} is too large")
        product = z3.RealVal(1)
        for _ in range(abs(power)):
            product = product * base
        if power >= 0:
            return product
        self.defined.append(base != 0)
        return 1 / product

    def _call(self, name: str, parts: list[ast.expr], at: int | None) -> Any:
        if name == "Sum":
            return z3.Sum([z3.RealVal(0), *(self.term(parts[0], each) for each in range(self.count))])
        if name == "D":
            # What is derived must have a value too.
            self.term(parts[0], at)
            return self.term(self.flow.rate_of(parts[0]), at)
        if name == "tan":
            sine, cosine = (self._function(circular, self.term(parts[0], at)) for circular in ("sin", "cos"))
            self.defined.append(cosine != 0)
            return sine / cosine
        return self._function(name, *(self.term(part, at) for part in parts))

    def _function(self, name: str, *values: Any) -> Any:
        first, *others = values
        match name:
            case "abs":
                return z3.If(first >= 0, first, -first)
            case "sign":
                return z3.If(first > 0, z3.RealVal(1), z3.If(first < 0, z3.RealVal(-1), z3.RealVal(0)))
            case "Max" | "Min":
                for other in others:
                    first = z3.If((first >= other) if name == "Max" else (first <= other), first, other)
                return first
            case "sqrt":
                root = z3.Function("sqrt", z3.RealSort(), z3.RealSort())(first)
                self.defined.append(first >= 0)
                self.true.append(z3.Implies(first >= 0, z3.And(root >= 0, root * root == first)))
                return root
        if name not in UNKNOWN_FUNCTIONS:
            raise NotStatedError(f"the function {name}")
        value = z3.Function(name, z3.RealSort(), z3.RealSort())(first)
        self.loose.add(name)
        self.true += self._known(name, first, value)
        return value

    def _known(self, name: str, of: Any, value: Any) -> Iterable[Any]:
        """What holds of a function's value at every argument."""
        match name:
            case "exp":
                return [value > 0, value >= 1 + of]
            case "log":
                self.defined.append(of > 0)
                return [z3.Implies(of > 0, value <= of - 1)]
            case "tanh":
                return [value < 1, value > -1, value * of >= 0, value * value <= of * of]
            case "sin" | "cos":
                turned = z3.Function("cos" if name == "sin" else "sin", z3.RealSort(), z3.RealSort())(of)
                return [value * value + turned * turned == 1]
        return [value * of >= 0, value * value <= of * of]

    def with_count(self, count: int) -> Terms:
        """For the same goal, with sums of so many terms, and nothing read yet."""
        return replace(self, count=count, defined=[], true=[], loose=set())


def _whole(node: ast.expr) -> int:
    """A whole exponent, given by a number or by one less than it."""
    match node:
        case ast.Constant(value=int(value)):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_whole(inner)
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            return _whole(left) - _whole(right)
    raise NotStatedError(f"the exponent {ast.unparse(node)[:60]} is no whole number")


def _open(node: ast.AST, indexed: frozenset[str]) -> bool:
    """Whether an indexed symbol stands outside of a sum."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return node.func.id != "Sum" and any(_open(part, indexed) for part in node.args)
    if isinstance(node, ast.Name):
        return node.id in indexed
    return any(_open(part, indexed) for part in ast.iter_child_nodes(node))

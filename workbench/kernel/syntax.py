"""Expressions of the certificate language as Coq text, letter by letter, and what is made of them."""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable
from dataclasses import dataclass, replace

from workbench.proof.checker import parse, split_relation

FUNCTIONS = {"log": "ln", "exp": "exp", "tanh": "tanh", "abs": "Rabs", "sign": "sgn", "sqrt": "sqrt",
             "sin": "sin", "cos": "cos", "arctan": "atan"}
RELATIONS = {"<=": "<=", ">=": ">=", "==": "=", "!=": "<>", "<": "<", ">": ">"}
EXTREMES = {"Max": "Rmax", "Min": "Rmin"}
NAMED = "@"  # before the name of a value that the Coq file names itself


class NotExportedError(Exception):
    """A certificate, or a rule in it, that has no Coq text; says which and why."""


@dataclass(frozen=True)
class Letters:
    """How symbols are written: those that move are functions of an instant, indexed ones of the index i."""

    moving: frozenset[str] = frozenset()
    indexed: frozenset[str] = frozenset()
    instant: str = "t"

    def at(self, instant: str) -> Letters:
        """The same letters at another instant."""
        return replace(self, instant=instant)

    def symbol(self, name: str) -> str:
        """A symbol; the prefix keeps it apart from every name of Coq's."""
        if name.startswith(NAMED):
            return name[1:]
        arguments = ["i"] * (name in self.indexed) + [self.instant] * (name in self.moving)
        return f"({' '.join([f'v_{name}', *arguments])})" if arguments else f"v_{name}"


def called(node: ast.AST, *names: str) -> bool:
    """Whether a node calls one of these functions."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in names


def names_in(node: ast.AST) -> set[str]:
    """The symbols of an expression, functions left out."""
    if isinstance(node, ast.Call):
        return set().union(*(names_in(part) for part in node.args))
    if isinstance(node, ast.Name):
        return {node.id}
    return set().union(*(names_in(part) for part in ast.iter_child_nodes(node)))


def exponent_of(node: ast.expr) -> int:
    """A whole exponent, typed as a number."""
    match node:
        case ast.Constant(value=int(value)):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int(value))):
            return -value
    raise NotExportedError(f"the exponent {ast.unparse(node)} is no number")


def text_of(node: ast.AST, letters: Letters) -> str:  # noqa: PLR0911 - a case a kind
    """An expression as Coq text, every operation in brackets of its own."""

    def text(part: ast.AST) -> str:
        return text_of(part, letters)

    match node:
        case ast.Constant(value=int(value)):
            return str(value)
        case ast.Name(id=name):
            return letters.symbol(name)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return f"(- {text(inner)})"
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            power = exponent_of(right)
            return f"({text(left)} ^ {power})" if power >= 0 else f"(1 / {text(left)} ^ {-power})"
        case ast.BinOp(left=left, op=op, right=right):
            sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(op)]
            return f"({text(left)} {sign} {text(right)})"
        case ast.Call(func=ast.Name(id="Sum"), args=[inner]):
            return f"(bigsum n (fun i => {text(inner)}))"
        case ast.Call(func=ast.Name(id="D"), args=[inner]):
            return f"(Derive (fun s => {text_of(inner, letters.at('s'))}) {letters.instant})"
        case ast.Call(func=ast.Name(id=name), args=[first, *others]) if name in EXTREMES:
            found = text(first)
            for other in others:
                found = f"({EXTREMES[name]} {found} {text(other)})"
            return found
        case ast.Call(func=ast.Name(id="tan"), args=[inner]):
            return text(tangent(inner))
        case ast.Call(func=ast.Name(id=name), args=[inner]) if name in FUNCTIONS:
            return f"({FUNCTIONS[name]} {text(inner)})"
    raise NotExportedError(f"{ast.unparse(node)[:80]} has no Coq text")


def relation_text(relation: str, letters: Letters) -> str:
    """A relation as Coq text."""
    left, operator, right = split_relation(relation)
    return f"{text_of(parse(left), letters)} {RELATIONS[operator]} {text_of(parse(right), letters)}"


def replaced(node: ast.expr, new: Callable[[ast.expr], ast.expr | None]) -> ast.expr:
    """The expression with every outermost part replaced for which there is a new one."""

    class Replacing(ast.NodeTransformer):
        def visit(self, part: ast.AST) -> ast.AST:
            other = new(part) if isinstance(part, ast.expr) else None
            return other if other is not None else self.generic_visit(part)

    found = Replacing().visit(copy.deepcopy(node))
    assert isinstance(found, ast.expr)
    return found


def operation(left: ast.expr, op: ast.operator, right: ast.expr) -> ast.expr:
    """Two expressions joined by an operation."""
    return ast.BinOp(left, op, right)


def call(name: str, *arguments: ast.expr) -> ast.expr:
    """A function of expressions."""
    return ast.Call(ast.Name(name, ast.Load()), list(arguments), [])


def tangent(angle: ast.expr) -> ast.expr:
    """tan as what it is to the checker and to Coq."""
    return operation(call("sin", angle), ast.Div(), call("cos", angle))


def plain(node: ast.expr) -> ast.expr:
    """tanh, tan, Max and Min written by exp, by sin and cos and by abs, as the library's lemmas do."""

    def new(part: ast.expr) -> ast.expr | None:
        if called(part, "tanh"):
            double = call("exp", operation(ast.Constant(2), ast.Mult(), plain(part.args[0])))  # type: ignore[attr-defined]
            return operation(operation(double, ast.Sub(), ast.Constant(1)), ast.Div(),
                             operation(double, ast.Add(), ast.Constant(1)))
        if called(part, "tan"):
            return tangent(plain(part.args[0]))  # type: ignore[attr-defined]
        if called(part, "Max", "Min"):
            first, *others = [plain(each) for each in part.args]  # type: ignore[attr-defined]
            sign = ast.Add() if part.func.id == "Max" else ast.Sub()  # type: ignore[attr-defined]
            for other in others:
                gap = call("abs", operation(first, ast.Sub(), other))
                first = operation(operation(operation(first, ast.Add(), other), sign, gap), ast.Div(), ast.Constant(2))
            return first
        return None

    return replaced(node, new)


def split_margin(relation: str) -> ast.expr:
    """The margin of a relation, an expression: what the checker compares with zero."""
    left, operator, right = split_relation(relation)
    low, high = (parse(left), parse(right)) if operator in ("<=", "<") else (parse(right), parse(left))
    return operation(high, ast.Sub(), low)

"""Obligations stated as data: lists such as ["<=", "x**2 + 1", "y"], read into a goal without evaluating anything.

A statement is a relation [operator, left, right] with = == != < <= > >= between texts of + - * / ** over numbers
and symbols, or ["and", ...], ["or", ...], ["not", one]. What an `or` assumes becomes a goal for each of its parts;
of what it shows, all parts but one are assumed not to hold. Names in `indexed` have a value in each term of Sum(...),
which runs over any number of terms.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from itertools import product
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import partial_operations
from workbench.proof.claim import Goal, Operator, Relation, cosh, sinh
from workbench.proof.text import text
from workbench.proof.typed import as_typed

OPERATORS: dict[str, Operator] = {"=": "==", "==": "==", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
ARITHMETIC: dict[type[ast.operator], Callable[[sp.Expr, sp.Expr], sp.Expr]] = {
    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b, ast.Pow: lambda a, b: a**b}
FUNCTIONS = {"abs": sp.Abs, "max": sp.Max, "min": sp.Min, "exp": sp.exp, "log": sp.log, "tanh": sp.tanh,
             "cosh": cosh, "sinh": sinh, "sqrt": sp.sqrt, "sign": sp.sign, "sin": sp.sin, "cos": sp.cos, "tan": sp.tan,
             "arctan": sp.atan}
MOST_GOALS, LONGEST = 64, 100_000
INDEX, COUNT = sp.Symbol("index_", integer=True), sp.Symbol("count_", integer=True, positive=True)

Conjunction = tuple[Relation, ...]


def goals_of(obligation: dict[str, Any]) -> list[Goal]:
    """The goals, of one relation shown each, which together say that all that is assumed implies what is shown.

    obligation: `assume`, a list of statements, `show`, one statement, and `indexed`, a list of names, where it has one.
    Raises ClaimError for what is none.
    """
    if not isinstance(obligation.get("assume"), list) or not isinstance(obligation.get("show"), list):
        raise ClaimError("an obligation is a list 'assume' of statements and a statement 'show'")
    names = obligation.get("indexed", [])
    if not isinstance(names, list) or not all(isinstance(name, str) and name.isidentifier() for name in names):
        raise ClaimError("'indexed' is a list of names: those that differ from term to term of the sums")
    indexed = frozenset(names)
    cases = _both([_either(statement, indexed) for statement in obligation["assume"]])
    return [_goal(last.negation, tuple(sorted((*case, *others), key=_may_be_undefined)))
            for *others, last in _either(obligation["show"], indexed, holds=False) for case in cases]


def _may_be_undefined(relation: Relation) -> bool:
    """Whether a relation has denominators, roots or logarithms: it is read where those without hold, in whatever order
    they are stated."""
    return bool(partial_operations(text(relation.left)) or partial_operations(text(relation.right)))


def _goal(shown: Relation, assumed: Conjunction) -> Goal:
    """The goal; of a relation between equal texts that of their difference, which holds whatever is assumed."""
    if shown.operator in ("==", "<=", ">=") and text(shown.left) == text(shown.right):
        difference = sp.Add(shown.left, sp.Mul(-1, shown.right, evaluate=False), evaluate=False)
        return Goal((Relation(difference, shown.operator, sp.S.Zero),))
    return Goal((shown,), assumed)


def _either(statement: Any, indexed: frozenset[str], holds: bool = True) -> list[Conjunction]:
    """A statement, or that it does not hold, as a disjunction of conjunctions of relations."""
    match statement:
        case ["not", part]:
            return _either(part, indexed, not holds)
        case ["and" | "or" as word, *parts] if parts:
            each = [_either(part, indexed, holds) for part in parts]
            return _both(each) if (word == "and") == holds else [case for cases in each for case in cases]
        case [str(_), str(_), str(_)]:
            relation = _relation(statement, indexed)
            return [(relation if holds else relation.negation,)]
    raise ClaimError(f"'{str(statement)[:80]}' is no statement: write [\"<=\", \"x\", \"y\"], or and, or, not of such")


def _both(parts: list[list[Conjunction]]) -> list[Conjunction]:
    cases = 1
    for part in parts:
        cases *= len(part)
    if cases > MOST_GOALS:
        raise ClaimError(f"an obligation of more than {MOST_GOALS} cases: state it in several")
    return [tuple(r for conjunction in chosen for r in conjunction) for chosen in product(*parts)]


def _relation(statement: list[str], indexed: frozenset[str]) -> Relation:
    operator, left, right = statement
    if operator not in OPERATORS:
        raise ClaimError(f"'{operator[:20]}' is no relation: write one of {' '.join(OPERATORS)}")
    return Relation(expression(left, indexed), OPERATORS[operator], expression(right, indexed))


def expression(written: str, indexed: frozenset[str] = frozenset()) -> sp.Expr:
    """An expression as it is typed: its syntax tree is walked, nothing is evaluated; symbols are real numbers.

    indexed: names of which each term of Sum(...) has its own. Raises ClaimError for anything but + - * / **, numbers,
    symbols and the functions of certificates.
    """
    if len(written) > LONGEST:
        raise ClaimError(f"an expression is longer than {LONGEST} characters: state it in parts")
    try:
        tree = ast.parse(written.strip(), mode="eval").body
        with as_typed():
            return _expression(tree, indexed)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ClaimError(f"cannot read '{written[:80]}': write + - * / ** over numbers and symbols") from None


def _expression(node: ast.expr, indexed: frozenset[str]) -> sp.Expr:
    result: sp.Expr | None = None
    match node:
        case ast.Constant(value=int(value)) if not isinstance(value, bool):
            result = sp.Integer(value)
        case ast.Name(id=name):
            result = sp.IndexedBase(name, real=True)[INDEX] if name in indexed else sp.Symbol(name, real=True)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            result = -_expression(inner, indexed)
        case ast.BinOp(left=ast.Constant(value=int(p)), op=ast.Div(), right=ast.Constant(value=int(q))) if q:
            result = sp.Rational(p, q)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
            result = ARITHMETIC[type(op)](_expression(left, indexed), _expression(right, indexed))
        case ast.Call(func=ast.Name(id="Sum"), args=[inner], keywords=[]):
            result = sp.Sum(_expression(inner, indexed), (INDEX, 1, COUNT))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name.lower() in FUNCTIONS and arguments:
            result = FUNCTIONS[name.lower()](*(_expression(argument, indexed) for argument in arguments))
    if result is None:
        raise ClaimError(f"'{ast.unparse(node)[:80]}' is no expression: write + - * / ** over symbols and whole "
                         "numbers, as in 1/10")
    return result

"""sympy expressions as casadi ones, node by node: no source text in between, and cases become `if_else`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import casadi as ca
import sympy as sp

from workbench.errors import CompileError
from workbench.model.law import time

_FUNCTIONS: dict[Any, Any] = {
    sp.exp: ca.exp, sp.log: ca.log, sp.sin: ca.sin, sp.cos: ca.cos, sp.tan: ca.tan, sp.tanh: ca.tanh, sp.sinh: ca.sinh,
    sp.cosh: ca.cosh, sp.asin: ca.asin, sp.acos: ca.acos, sp.atan: ca.atan, sp.atan2: ca.atan2, sp.Abs: ca.fabs,
    sp.sec: lambda a: 1 / ca.cos(a), sp.csc: lambda a: 1 / ca.sin(a), sp.cot: lambda a: 1 / ca.tan(a),
    sp.sech: lambda a: 1 / ca.cosh(a), sp.csch: lambda a: 1 / ca.sinh(a), sp.coth: lambda a: 1 / ca.tanh(a),
    sp.asinh: ca.asinh, sp.acosh: ca.acosh, sp.atanh: ca.atanh, sp.erf: ca.erf,
    sp.erfc: lambda a: 1 - ca.erf(a), sp.frac: lambda a: a - ca.floor(a),
    sp.sign: ca.sign, sp.floor: ca.floor, sp.ceiling: ca.ceil,
    # As sympy has it: of the divisor's sign, where casadi's is of the dividend's.
    sp.Mod: lambda a, b: a - b * ca.floor(a / b),
    sp.Heaviside: lambda a, at_zero: ca.if_else(a > 0, 1, ca.if_else(a < 0, 0, at_zero)),
}
_RELATIONS: dict[Any, Any] = {sp.StrictLessThan: ca.lt, sp.LessThan: ca.le, sp.Equality: ca.eq, sp.Unequality: ca.ne}


def casadi_of(exprs: Sequence[sp.Expr], known: Mapping[sp.Expr, Any], clock: Any = 0.0) -> list[Any]:
    """The expressions over casadi values of their symbols; clock: the value of time.

    Raises CompileError for a symbol without a value and a function that casadi does not have.
    """
    found: dict[sp.Basic, Any] = {time: clock, **known}

    def of(node: sp.Basic) -> Any:
        if node not in found:
            found[node] = _built(node, of)
        return found[node]

    return [ca.SX(of(expr)) for expr in exprs]


def _built(node: sp.Basic, of: Any) -> Any:  # noqa: PLR0911 - a case a kind of node
    match node:
        case sp.Add():
            return sum((of(one) for one in node.args[1:]), of(node.args[0]))
        case sp.Mul():
            product = of(node.args[0])
            for one in node.args[1:]:
                product = product * of(one)
            return product
        case sp.Pow(base=base, exp=power):
            return ca.sqrt(of(base)) if power == sp.S.Half else of(base) ** of(power)
        case sp.Min() | sp.Max():
            smaller = ca.fmin if isinstance(node, sp.Min) else ca.fmax
            least = of(node.args[0])
            for one in node.args[1:]:
                least = smaller(least, of(one))
            return least
        case sp.Piecewise():
            *cases, (last, _) = node.args
            value = of(last)
            for one, condition in reversed(cases):
                value = ca.if_else(_condition(condition, of), of(one), value)
            return value
        case sp.Symbol():
            raise CompileError(f"symbol '{node}' has no value there: make it a state, an input or a parameter")
        case _ if node.is_number:
            return float(sp.N(node, 20))
        case _ if node.func in _FUNCTIONS:
            return _FUNCTIONS[node.func](*map(of, node.args))
    raise CompileError(f"'{node.func.__name__}' has no casadi counterpart: state it by exp, log, roots, trigonometric "
                       "functions, abs, sign, Min, Max or Piecewise")


def _condition(node: sp.Basic, of: Any) -> Any:
    if node in (sp.true, sp.false):
        return float(node == sp.true)
    if isinstance(node, sp.And | sp.Or):
        joined = ca.logic_and if isinstance(node, sp.And) else ca.logic_or
        value = _condition(node.args[0], of)
        for one in node.args[1:]:
            value = joined(value, _condition(one, of))
        return value
    if isinstance(node, sp.Not):
        return ca.logic_not(_condition(node.args[0], of))
    relation = node.canonical if isinstance(node, sp.Rel) else node
    if isinstance(relation, sp.StrictGreaterThan | sp.GreaterThan):
        relation = relation.reversed
    if relation.func not in _RELATIONS:
        raise CompileError(f"the condition {node} has no casadi counterpart: state it by <, <=, and, or")
    return _RELATIONS[relation.func](of(relation.lhs), of(relation.rhs))

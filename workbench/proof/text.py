"""Goals as text in the certificate language, which `checker.py` reads on its own."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, name_of
from workbench.proof.typed import evaluated

NAMES = {"log": "log", "exp": "exp", "D": "D", "tanh": "tanh", "sin": "sin", "cos": "cos", "tan": "tan",
         "atan": "arctan", "Abs": "abs", "Size": "abs", "sign": "sign", "Side": "sign", "Summed": "Sum", "Max": "Max",
         "Min": "Min"}


SUM, PRODUCT, POWER, ATOM = range(4)  # how tightly a text holds together
Written = tuple[str, int]


@lru_cache(maxsize=4096)  # a goal's relations are written for each certificate that is tried
def text(expr: sp.Expr) -> str:
    """An expression in the certificate language, term by term as it stands; brackets that only group are left out.

    Raises ClaimError for what the language has no words for.
    """
    return _written(expr)[0]


def _written(expr: sp.Expr) -> Written:
    if isinstance(expr, (sp.Indexed, sp.Symbol)):
        return name_of(expr), ATOM
    if expr is sp.pi:
        return "4*arctan(1)", PRODUCT
    if isinstance(expr, sp.Add):
        return _sum_text(expr), SUM
    if isinstance(expr, (sp.Mul, sp.Rational)):
        return (str(expr), ATOM) if isinstance(expr, sp.Integer) and expr >= 0 else _product_text(expr)
    if isinstance(expr, sp.Pow) and expr.base != sp.E:
        return _power_text(expr)
    return _function_text(expr), ATOM


def _function_text(expr: sp.Expr) -> str:
    if isinstance(expr, sp.Sum):
        return f"Sum({text(expr.function)})"
    if expr == sp.E or isinstance(expr, sp.Pow):
        return f"exp({text(expr.as_base_exp()[1])})"
    name = expr.func.__name__
    if name not in NAMES:
        known = ", ".join(dict.fromkeys(NAMES.values()))
        raise ClaimError(f"'{expr}' has no meaning in certificates: state the claim with {known}")
    arguments = sorted(map(text, expr.args)) if name in ("Max", "Min") else map(text, expr.args)
    return f"{NAMES[name]}({', '.join(arguments)})"


def _held(expr: sp.Expr, least: int) -> str:
    """The text, in brackets where it holds together less tightly than that."""
    written, level = _written(expr)
    return written if level >= least else f"({written})"


def _flat(expr: sp.Expr, kind: type[sp.Expr]) -> Iterator[sp.Expr]:
    """The terms of a sum of sums, or the factors of a product of products."""
    for part in expr.args:
        yield from _flat(part, kind) if isinstance(part, kind) else (part,)


def _sum_text(expr: sp.Add) -> str:
    first, *others = (_written(term)[0] for term in _flat(expr, sp.Add))
    return first + "".join(f" - {term[1:]}" if term.startswith("-") else f" + {term}" for term in others)


def _product_text(expr: sp.Mul | sp.Rational) -> Written:
    """Factors above and below one fraction bar; a sign in front."""
    factors = list(_flat(expr, sp.Mul)) if isinstance(expr, sp.Mul) else [expr]
    above: list[str] = []
    below: list[str] = []
    sign = "-" if factors[0].is_Rational and factors[0] < 0 else ""
    for place, factor in enumerate(factors):
        if factor.is_Rational:
            size = abs(factor) if place == 0 else factor
            alone = len(factors) == 1 or (isinstance(factor, sp.Integer) and not (sign and size == 1 and place == 0))
            if size.p != 1 or alone:
                above.append(_held(sp.Integer(size.p), PRODUCT))
            if size.q != 1:
                below.append(str(size.q))
        elif isinstance(factor, sp.Pow) and factor.base != sp.E and (power := evaluated(factor.exp)) < 0:
            below.append(_held(factor.base if power == -1 else sp.Pow(factor.base, -power, evaluate=False), POWER))
        else:
            above.append(_held(factor, PRODUCT))
    top = "*".join(above) or "1"
    if not below:
        return f"{sign}{top}", SUM if sign else PRODUCT
    bottom = below[0] if len(below) == 1 else f"({'*'.join(below)})"
    return f"{sign}{top}/{bottom}", SUM if sign else PRODUCT


def _power_text(expr: sp.Pow) -> Written:
    power = evaluated(expr.exp)
    if power.is_Rational and power.q == 2:
        root = f"sqrt({text(expr.base)})"
        return ((root, ATOM) if power == sp.S.Half else (f"1/{root}", PRODUCT) if power == -sp.S.Half
                else (f"{root}**{_held(sp.Integer(power.p), ATOM)}", POWER))
    if not power.is_Integer:
        raise ClaimError(f"'{expr}' has no meaning in certificates: only whole and half powers have")
    if power == -1:
        return f"1/{_held(expr.base, POWER)}", PRODUCT
    return f"{_held(expr.base, ATOM)}**{_held(power, ATOM)}", POWER


def relation_text(relation: Relation) -> str:
    """A relation in the certificate language."""
    return f"{text(relation.left)} {relation.operator} {text(relation.right)}"


def assumptions(goal: Goal) -> tuple[Relation, ...]:
    """The goal's assumptions in the order of its certificate: signs of symbols first, then as stated."""
    return (*goal.signs(), *goal.assume)


def goal_text(goal: Goal) -> dict[str, Any]:
    """The goal as it stands in a certificate."""
    record: dict[str, Any] = {
        "assume": [relation_text(r) for r in assumptions(goal)],
        "show": [relation_text(r) for r in goal.show],
    }
    indexed = sorted({name_of(s) for s in goal.symbols() if isinstance(s, sp.Indexed)})
    if indexed:
        record["indexed"] = indexed
    if goal.flow:
        record["flow"] = {name_of(s): text(rate) for s, rate in goal.flow.items()}
    if goal.inputs:
        record["inputs"] = sorted(map(name_of, goal.inputs))
    if goal.always:
        record["always"] = [relation_text(r) for r in goal.always]
    if goal.initial:
        record["initial"] = {name_of(s): text(value) for s, value in goal.initial.items()}
    if goal.eventually is not None:
        record["eventually"] = name_of(goal.eventually)
    return record

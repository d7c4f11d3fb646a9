"""Texts of the certificate language as LaTeX that a reader would write; numbers as a reader would say them."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from fractions import Fraction

from workbench.proof.checker import RATIONAL, parse, split_relation
from workbench.proof.latex.letters import LOGARITHM, latex_name
from workbench.report.number_style import Style, style_of, value_latex
from workbench.report.sum_index import index_of

SUM, PRODUCT, POWER, ATOM = range(4)  # how tightly a text holds together
Written = tuple[str, int]
SIGNS = {"==": "=", "<=": r"\le", ">=": r"\ge", "!=": r"\ne", "<": "<", ">": ">"}
ZERO, ONE = ast.Constant(0), ast.Constant(1)
ROOT_NEAR = re.compile(r"root near (-?[0-9.]+(?:e[-+]?[0-9]+)?)")
_WORD = re.compile(r"(?<=[{,])(?<!\\mathrm\{)[A-Za-z]{2,}(?=[},])")  # an index of several letters


def relation_latex(text: str, style: Style = "exact") -> str:
    """A relation of the certificate language as LaTeX, its numbers in a style."""
    left, operator, right = split_relation(text)
    return f"{expression_latex(left, style)} {SIGNS[operator]} {expression_latex(right, style)}"


def expression_latex(text: str, style: Style = "exact") -> str:
    """An expression of the certificate language as LaTeX, its numbers in a style; factors of one and terms of zero are
    left out.

    Raises CertificateError for what is no expression.
    """
    tree = _tidied(parse(text))
    return _written(tree if style == "exact" else _Numbers({}, style).visit(tree))[0]


def factor_latex(text: str, alone: bool = False) -> str:
    """An expression as a factor, a sum in brackets; alone: so that it can be raised to a power."""
    return _held(_tidied(parse(text)), ATOM if alone else PRODUCT)


def rate_latex(name: str, rate: str, style: Style = "exact") -> str:
    """The rate of a letter along a motion, as an equation."""
    return rf"\frac{{d}}{{dt}} {name_latex(name)} = {expression_latex(rate, style)}"


def numbers_in(text: str) -> list[Fraction]:
    """The numbers in an expression that are not whole, and what letters are divided by."""
    found = []
    for node in ast.walk(parse(text)):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and _whole(node.right):
            found.append(Fraction(_whole(node.left) or 1, _whole(node.right) or 1))
        elif isinstance(node, ast.Constant) and isinstance(node.value, float):
            found.append(Fraction(str(node.value)))
    return found


def numbers_put_in(text: str, values: Mapping[str, Fraction], style: Style = "exact") -> str | None:
    """An expression with numbers in place of its letters, nothing multiplied out; None where that says nothing: where
    a letter has no number, or where rates or sums over an index stand in it."""
    tree = _tidied(parse(text))
    if any(isinstance(node, ast.Name) and node.id in ("D", "Sum") for node in ast.walk(tree)):
        return None
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} - _CALLED.keys() - {"exp"}
    if not names or not names <= values.keys() or any(
            r"\approx" in value_latex(values[name], style) for name in names):
        return None
    return _written(_Numbers(values, style).visit(tree))[0]


class _Numbers(ast.NodeTransformer):
    """Names become numbers, and all numbers are written in one style."""

    def __init__(self, values: Mapping[str, Fraction], style: Style) -> None:
        self.values, self.style = values, style

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return _number(self.values[node.id], self.style) if node.id in self.values else node

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        above, below = _whole(node.left), _whole(node.right)
        if self.style != "exact" and isinstance(node.op, ast.Div) and above is not None and below:
            value = Fraction(above, below)
            return node if r"\approx" in value_latex(value, self.style) else _number(value, self.style)
        return self.generic_visit(node)  # type: ignore[return-value]

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        return _number(Fraction(str(node.value)), self.style) if isinstance(node.value, float) else node


def _number(value: Fraction, style: Style) -> ast.expr:
    """A number as the tree that is written as a reader would write it."""
    if value < 0:
        return ast.UnaryOp(ast.USub(), _number(-value, style))
    if value.denominator == 1:
        return ast.Constant(value.numerator)
    if r"\frac" not in (written := value_latex(value, style)):
        return ast.Name(f"={written}")
    return ast.BinOp(ast.Constant(value.numerator), ast.Div(), ast.Constant(value.denominator))


def name_latex(name: str) -> str:
    """LaTeX of a symbol's name; words among its indices stand upright."""
    if name.startswith(LOGARITHM):
        return rf"\ln {name_latex(name[len(LOGARITHM):])}"
    return _WORD.sub(r"\\mathrm{\g<0>}", latex_name(name))


def letter_and_value(name: str, value: str) -> tuple[str, str]:
    """A letter and its value as LaTeX; a letter that is stated by its logarithm is told itself where that is zero."""
    if name.startswith(LOGARITHM) and value == "0":
        return name_latex(name.removeprefix(LOGARITHM)), "1"
    return name_latex(name), value


def assignments_latex(values: Mapping[str, str]) -> list[str]:
    """Each `name = value` as LaTeX, all numbers alike; values are fractions, roots told by a number near them, or
    functions of time in the certificate language.

    Raises CertificateError for what is none of them.
    """
    style = style_of(number for value in values.values() for number in numbers_of(value))
    typed = [letter_and_value(name, _value_as_latex(value, style)) for name, value in values.items()]
    return [f"{letter} = {text}".replace(r"= \approx", r"\approx") for letter, text in typed]


def numbers_of(value: str) -> list[Fraction]:
    """The number that a value is, or those in the function that it is; a root is none of them."""
    if ROOT_NEAR.fullmatch(value):
        return []
    return [Fraction(value)] if RATIONAL.fullmatch(value) else numbers_in(value)


def _value_as_latex(value: str, style: Style) -> str:
    if root := ROOT_NEAR.fullmatch(value):
        about = value_latex(Fraction(root[1]), style).removeprefix(r"\approx ")
        return rf"\approx {about}\ (\text{{a root}})"
    return value_latex(Fraction(value), style) if RATIONAL.fullmatch(value) else expression_latex(value, style)


def _tidied(node: ast.expr) -> ast.expr:
    """The same value without the ones and zeros that a goal kept as typed carries."""
    if isinstance(node, ast.BinOp):
        left, right = _tidied(node.left), _tidied(node.right)
        rule = _TIDIED.get(type(node.op))
        found = rule(left, right) if rule else None
        return found if found is not None else ast.BinOp(left, node.op, right)
    if isinstance(node, ast.UnaryOp):
        return _negative(_tidied(node.operand))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        inside = [_tidied(arg) for arg in node.args]
        if _is(inside[0], int(node.func.id == "log")) and node.func.id in ("exp", "log", "Sum", "D"):
            return ONE if node.func.id == "exp" else ZERO
        return ast.Call(node.func, inside, [])
    return node


def _negative(node: ast.expr) -> ast.expr:
    under = _negated(node)
    return under if under is not None else ZERO if _is(node, 0) else ast.UnaryOp(ast.USub(), node)


def _tidied_sum(left: ast.expr, right: ast.expr) -> ast.expr | None:
    if _is(left, 0) or _is(right, 0):
        return right if _is(left, 0) else left
    if _whole(left) is not None and _whole(right) is not None:
        return ast.Constant((_whole(left) or 0) + (_whole(right) or 0))
    under_right, under_left = _negated(right), _negated(left)
    if under_right is not None:
        return ast.BinOp(left, ast.Sub(), under_right)
    return ast.BinOp(right, ast.Sub(), under_left) if under_left is not None else None


def _tidied_difference(left: ast.expr, right: ast.expr) -> ast.expr | None:
    if _is(right, 0) or _is(left, 0):
        return left if _is(right, 0) else _negative(right)
    under = _negated(right)
    return ast.BinOp(left, ast.Add(), under) if under is not None else None


def _tidied_product(left: ast.expr, right: ast.expr) -> ast.expr | None:
    if _is(left, 0) or _is(right, 0):
        return ZERO
    if _is(left, 1) or _is(right, 1):
        return right if _is(left, 1) else left
    for one, other, swapped in ((left, right, False), (right, left, True)):
        under = _negated(one)
        if under is not None:
            factors = (other, under) if swapped else (under, other)
            return _negative(_tidied_product(*factors) or ast.BinOp(factors[0], ast.Mult(), factors[1]))
    first, second = _whole(left), _whole(right)
    if second is not None:
        return ast.Constant(first * second) if first is not None else ast.BinOp(right, ast.Mult(), left)
    return None


def _tidied_quotient(left: ast.expr, right: ast.expr) -> ast.expr | None:
    if _is(right, 1) or _is(left, 0):
        return left
    under = _negated(left)
    return _negative(ast.BinOp(under, ast.Div(), right)) if under is not None else None


def _tidied_power(left: ast.expr, right: ast.expr) -> ast.expr | None:
    return ZERO if _is(left, 0) and (_whole(right) or 0) > 0 else None


Rule = Callable[[ast.expr, ast.expr], ast.expr | None]
_TIDIED: dict[type[ast.operator], Rule] = {ast.Add: _tidied_sum, ast.Sub: _tidied_difference,
                                           ast.Mult: _tidied_product, ast.Div: _tidied_quotient,
                                           ast.Pow: _tidied_power}


def _is(node: ast.expr, value: int) -> bool:
    return _whole(node) == value


def _whole(node: ast.expr) -> int | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, int) else None


def _negated(node: ast.expr) -> ast.expr | None:
    """What stands behind a sign."""
    return node.operand if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) else None


def _written(node: ast.expr) -> Written:
    match node:
        case ast.BinOp():
            return _operation(node)
        case ast.Constant(value):
            told = value_latex(Fraction(str(value)))
            return str(value) if r"\approx" in told else told, ATOM
        case ast.Name(name):
            if name.startswith("="):  # a decimal put in
                name, written = "", name[1:]
            else:
                written = name_latex(name)
            return written, PRODUCT if name.startswith(LOGARITHM) else ATOM
        case ast.UnaryOp(ast.USub(), operand):
            held = _held(operand, PRODUCT)
            return f"-{held}", SUM
        case ast.Call(ast.Name(name), args):
            return _call(name, args)
    return rf"\text{{{ast.unparse(node)}}}", SUM


def _operation(node: ast.BinOp) -> Written:
    left, right = node.left, node.right
    match node.op:
        case ast.Add():
            written = _written(right)[0]
            return f"{_held(left, SUM)} + " + (rf"\left({written}\right)" if written.startswith("-") else written), SUM
        case ast.Sub():
            return f"{_held(left, SUM)} - {_held(right, PRODUCT)}", SUM
        case ast.Div():
            numbers = isinstance(left, ast.Constant) and isinstance(right, ast.Constant)
            return rf"\frac{{{_written(left)[0]}}}{{{_written(right)[0]}}}", POWER if numbers else PRODUCT
        case ast.Pow():
            base, power = _held(left, ATOM), _written(right)[0]
            return f"{base[:-1]}{power}}}" if base.endswith("^{*}") else f"{base}^{{{power}}}", POWER
    first, second = _held(left, PRODUCT), _held(right, PRODUCT)
    return first + (r" \cdot " if second[:1].isdigit() else " ") + second, PRODUCT


_CALLED = {"sqrt": r"\sqrt{%s}", "abs": r"\left|%s\right|", "log": r"\ln\left(%s\right)",
           "sign": r"\operatorname{sgn}\left(%s\right)", "Max": r"\max\left(%s\right)",
           "Min": r"\min\left(%s\right)", "tanh": r"\tanh\left(%s\right)", "sin": r"\sin\left(%s\right)",
           "cos": r"\cos\left(%s\right)", "tan": r"\tan\left(%s\right)", "arctan": r"\arctan\left(%s\right)"}


def _call(name: str, args: list[ast.expr]) -> Written:
    inside = ", ".join(_written(arg)[0] for arg in args)
    match name:
        case "exp":
            return _exponential_of_logarithm(args[0]) or (f"e^{{{inside}}}", POWER)
        case "Sum":
            return rf"\sum_{{{index_of(args[0])}}} {_held(args[0], PRODUCT)}", PRODUCT
        case "D":
            whole = inside if isinstance(args[0], ast.Name) else rf"\left[{inside}\right]"
            return rf"\frac{{d}}{{dt}} {whole}", PRODUCT
    return _CALLED.get(name, rf"\text{{{name}}}\left(%s\right)") % inside, ATOM


def _exponential_of_logarithm(node: ast.expr) -> Written | None:
    """exp(log_m) is m, exp(-log_m) is 1/m."""
    match node:
        case ast.Name(name) if name.startswith(LOGARITHM):
            return (name_latex(name[len(LOGARITHM):]), ATOM)
        case ast.UnaryOp(ast.USub(), ast.Name(name)) if name.startswith(LOGARITHM):
            return (rf"\frac{{1}}{{{name_latex(name[len(LOGARITHM):])}}}", PRODUCT)
    return None


def _held(node: ast.expr, least: int) -> str:
    """The text, in brackets where it holds together less tightly than that."""
    written, level = _written(node)
    return written if level >= least else rf"\left({written}\right)"

"""Texts of the certificate language as LaTeX that a reader would write; numbers as a reader would say them."""

from __future__ import annotations

import ast
import re
from fractions import Fraction

from workbench.proof.checker import parse, split_relation
from workbench.proof.latex.letters import latex_name

SUM, PRODUCT, POWER, ATOM = range(4)  # how tightly a text holds together
Written = tuple[str, int]
SIGNS = {"==": "=", "<=": r"\le", ">=": r"\ge", "!=": r"\ne", "<": "<", ">": ">"}
ZERO, ONE = ast.Constant(0), ast.Constant(1)
LONGEST_FRACTION = 6  # digits above or below a fraction bar, beyond which a reader is given a decimal
_WORD = re.compile(r"(?<=[{,])[A-Za-z]{2,}(?=[},])(?<!mathrm)")  # an index of several letters
LOGARITHM = "log_"  # a positive letter with an index is stated by its logarithm: e^log_m is m


def relation_latex(text: str) -> str:
    """A relation of the certificate language as LaTeX."""
    left, operator, right = split_relation(text)
    return f"{expression_latex(left)} {SIGNS[operator]} {expression_latex(right)}"


def expression_latex(text: str) -> str:
    """An expression of the certificate language as LaTeX; factors of one and terms of zero are left out.

    Raises CertificateError for what is no expression.
    """
    return _written(_tidied(parse(text)))[0]


def name_latex(name: str) -> str:
    """LaTeX of a symbol's name; words among its indices stand upright."""
    if name.startswith(LOGARITHM):
        return rf"\ln {name_latex(name[len(LOGARITHM):])}"
    return _WORD.sub(r"\\mathrm{\g<0>}", latex_name(name))


def value_latex(value: Fraction) -> str:
    """A number as a reader would write it: whole, decimal where that is short and exact, a fraction, or with an
    'about' in front where its digits are too many."""
    decimal = _decimal(value)
    if decimal is not None:
        return decimal
    sign = "-" if value < 0 else ""
    above, below = abs(value.numerator), value.denominator
    if max(len(str(above)), len(str(below))) <= LONGEST_FRACTION:
        return rf"{sign}\frac{{{above}}}{{{below}}}"
    return rf"\approx {_scientific(f'{float(value):.4g}')}"


def _decimal(value: Fraction) -> str | None:
    """A whole number or a decimal with few digits, exactly; else None."""
    if value.denominator == 1 and abs(value) < 10**6:
        return str(value.numerator)
    digits = f"{float(value):.6g}" if abs(value) < 10**30 else ""
    if not digits or Fraction(digits) != value:
        return None
    short = len(digits.lstrip("-").replace(".", "").lstrip("0")) <= 4 or value.denominator > 1000
    return _scientific(digits) if short else None


def _scientific(digits: str) -> str:
    mantissa, e, exponent = digits.partition("e")
    if not e:
        return digits
    power = rf"10^{{{int(exponent)}}}"
    return power if mantissa == "1" else rf"{mantissa} \times {power}"


def _tidied(node: ast.expr) -> ast.expr:
    """The same value without the ones and zeros that a goal kept as typed carries."""
    match node:
        case ast.BinOp(left, op, right):
            return _tidied_operation(_tidied(left), op, _tidied(right))
        case ast.UnaryOp(ast.USub(), operand):
            inner = _tidied(operand)
            if isinstance(inner, ast.UnaryOp) and isinstance(inner.op, ast.USub):
                return inner.operand
            return ZERO if _is(inner, 0) else ast.UnaryOp(ast.USub(), inner)
        case ast.Call(func, args):
            inside = [_tidied(arg) for arg in args]
            name = func.id if isinstance(func, ast.Name) else ""
            if name == "exp" and _is(inside[0], 0):
                return ONE
            if name in ("Sum", "D") and _is(inside[0], 0):
                return ZERO
            return ast.Call(func, inside, [])
    return node


def _tidied_operation(left: ast.expr, op: ast.operator, right: ast.expr) -> ast.expr:
    match op:
        case ast.Add() if _is(left, 0):
            return right
        case ast.Add() | ast.Sub() if _is(right, 0):
            return left
        case ast.Sub() if _is(left, 0):
            return _tidied(ast.UnaryOp(ast.USub(), right))
        case ast.Mult() if _is(left, 0) or _is(right, 0):
            return ZERO
        case ast.Mult() if _is(left, 1):
            return right
        case ast.Mult() | ast.Div() if _is(right, 1):
            return left
        case ast.Mult() | ast.Add() if isinstance(left, ast.Constant) and isinstance(right, ast.Constant):
            both = (left.value, right.value)
            return ast.Constant(both[0] * both[1] if isinstance(op, ast.Mult) else both[0] + both[1])
        case ast.Mult() if isinstance(right, ast.Constant) and not isinstance(left, ast.Constant):
            return ast.BinOp(right, op, left)
        case ast.Mult() if isinstance(right, ast.UnaryOp) and isinstance(right.op, ast.USub):
            return ast.UnaryOp(ast.USub(), _tidied_operation(left, op, right.operand))
        case ast.Add() if isinstance(right, ast.UnaryOp) and isinstance(right.op, ast.USub):
            return _tidied_operation(left, ast.Sub(), right.operand)
        case ast.Sub() if isinstance(right, ast.UnaryOp) and isinstance(right.op, ast.USub):
            return _tidied_operation(left, ast.Add(), right.operand)
        case ast.Add() if isinstance(left, ast.UnaryOp) and isinstance(left.op, ast.USub):
            return ast.BinOp(right, ast.Sub(), left.operand)
        case ast.Pow() if _is(left, 0) and isinstance(right, ast.Constant) and right.value > 0:
            return ZERO
        case ast.Mult() if isinstance(left, ast.UnaryOp) and isinstance(left.op, ast.USub):
            return ast.UnaryOp(ast.USub(), _tidied_operation(left.operand, op, right))
        case ast.Div() if _is(left, 0):
            return ZERO
        case ast.Div() if isinstance(left, ast.UnaryOp) and isinstance(left.op, ast.USub):
            return ast.UnaryOp(ast.USub(), ast.BinOp(left.operand, op, right))
    return ast.BinOp(left, op, right)


def _is(node: ast.expr, value: int) -> bool:
    return isinstance(node, ast.Constant) and node.value == value


def _written(node: ast.expr) -> Written:
    match node:
        case ast.Constant(value):
            return (value_latex(Fraction(str(value))), ATOM)
        case ast.Name(name):
            return (name_latex(name), PRODUCT if name.startswith(LOGARITHM) else ATOM)
        case ast.UnaryOp(ast.USub(), operand):
            return (f"-{_held(operand, PRODUCT)}", SUM)
        case ast.BinOp(left, ast.Add(), right):
            return (f"{_held(left, SUM)} + {_after_sign(right)}", SUM)
        case ast.BinOp(left, ast.Sub(), right):
            return (f"{_held(left, SUM)} - {_held(right, PRODUCT)}", SUM)
        case ast.BinOp(left, ast.Mult(), right):
            first, second = _held(left, PRODUCT), _held(right, PRODUCT)
            return (first + (r" \cdot " if second[:1].isdigit() else " ") + second, PRODUCT)
        case ast.BinOp(left, ast.Div(), right):
            if _short_number(left) and _short_number(right):
                return (rf"\frac{{{_written(left)[0]}}}{{{_written(right)[0]}}}", POWER)
            return (rf"\frac{{{_written(left)[0]}}}{{{_written(right)[0]}}}", PRODUCT)
        case ast.BinOp(left, ast.Pow(), right):
            return (f"{_held(left, ATOM)}^{{{_written(right)[0]}}}", POWER)
        case ast.Call(ast.Name(name), args):
            return _call(name, args)
    return (rf"\text{{{ast.unparse(node)}}}", SUM)


def _short_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant)


def _after_sign(node: ast.expr) -> str:
    written, _ = _written(node)
    return rf"\left({written}\right)" if written.startswith("-") else written


def _call(name: str, args: list[ast.expr]) -> Written:
    if name == "exp":
        letter = _exponential_of_logarithm(args[0])
        if letter is not None:
            return letter
        return (f"e^{{{_written(args[0])[0]}}}", POWER)
    inside = [_written(arg)[0] for arg in args]
    match name:
        case "Sum":
            return (rf"\sum_{{i}} {_held(args[0], PRODUCT)}", PRODUCT)
        case "D":
            if isinstance(args[0], ast.Name):
                return (rf"\frac{{d}}{{dt}} {inside[0]}", PRODUCT)
            return (rf"\frac{{d}}{{dt}}\left[{inside[0]}\right]", PRODUCT)
        case "sqrt":
            return (rf"\sqrt{{{inside[0]}}}", ATOM)
        case "abs":
            return (rf"\left|{inside[0]}\right|", ATOM)
        case "log":
            return (rf"\ln\left({inside[0]}\right)", ATOM)
    word = {"sign": r"\operatorname{sgn}", "Max": r"\max", "Min": r"\min", "tanh": r"\tanh"}.get(name, name)
    return (rf"{word}\left({', '.join(inside)}\right)", ATOM)


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

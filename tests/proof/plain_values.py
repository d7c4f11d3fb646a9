"""Expressions of the certificate language at a point, computed apart from the checker, every sum written out.

A point maps symbols to numbers, indexed symbols to a list with one number for each neuron, and COUNT to how many
neurons there are. What is undefined raises UndefinedError; what is too large to be computed, TooLargeError.
"""

import ast
import random

import mpmath

from workbench.proof.checker import SUM, TOTAL, split_relation

COUNT = "neurons"
LARGEST = 60  # powers and products of such exponentials are far from using up the digits, also where they cancel
mp = mpmath.mp.clone()
mp.dps = 300
ZERO, CLOSE = mp.mpf(10) ** -80, mp.mpf(10) ** -30  # what is below is taken for zero; what is that close, for equal


class UndefinedError(Exception):
    """The expression has no value at the point."""


class TooLargeError(Exception):
    """The expression has a value that would take long to compute."""


FAILURES = UndefinedError, TooLargeError


def _divided(a, b):
    if abs(b) < ZERO:
        raise UndefinedError
    return a / b


def _log(a):
    if a < ZERO:
        raise UndefinedError
    return mp.log(a)


def _sqrt(a):
    if a < -ZERO:
        raise UndefinedError
    return mp.sqrt(max(a, 0))


def _exp(a):
    if abs(a) > LARGEST:
        raise TooLargeError
    return mp.exp(a)


FUNCTIONS = {"log": _log, "sqrt": _sqrt, "exp": _exp, "abs": abs, "Max": max, "Min": min,
             "sign": lambda a: mp.sign(a) if abs(a) > ZERO else mp.mpf(0),
             "tanh": lambda a: _divided(1 - _exp(-2 * abs(a)), 1 + _exp(-2 * abs(a))) * mp.sign(a)}
OPERATIONS = {ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
              ast.Div: _divided, ast.Pow: lambda a, b: a ** int(b) if b >= 0 else _divided(mp.mpf(1), a ** int(-b))}


def value(text, point):
    """The value of an expression."""
    return _value(ast.parse(text, mode="eval").body, point, None)


def _value(node, point, place):
    match node:
        case ast.Constant(value=number):
            return mp.mpf(number)
        case ast.Name(id=name):
            return point[name][place] if isinstance(point[name], list) else point[name]
        case ast.UnaryOp(operand=inner):
            return -_value(inner, point, place)
        case ast.BinOp(left=left, op=op, right=right):
            return OPERATIONS[type(op)](_value(left, point, place), _value(right, point, place))
        case ast.Call(func=ast.Name(id="Sum"), args=[term]):
            return mp.fsum(_value(term, point, i) for i in range(point[COUNT]))
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return FUNCTIONS[name](*(_value(a, point, place) for a in arguments))
    raise AssertionError(ast.dump(node))


def holds(relation, point):
    """Whether a relation holds; an equality, whether it does but for rounding."""
    left, operator, right = split_relation(relation)
    a, b = value(left, point), value(right, point)
    near = abs(a - b) <= CLOSE * (1 + abs(a) + abs(b))
    return {"==": near, "!=": not near, "<=": a < b or near, "<": a < b, ">=": a > b or near, ">": a > b}[operator]


def reading(context, ratio, point, place=None):
    """The value of what the checker read, with every formal sum written out.

    The numerator's terms with a sum are summed over the neurons, each over the denominator at that neuron; what
    is left must not depend on a neuron unless `place` says which one is meant.
    """
    def atom(name, at):
        if name in context.functions:
            kind, argument = context.functions[name]
            if kind == TOTAL:
                return mp.fsum(reading(context, argument, point, i) for i in range(point[COUNT]))
            return FUNCTIONS[kind](reading(context, argument, point, at))
        if isinstance(point[name], list):
            return point[name][at] if point[name] else mp.mpf(1)
        return point[name]

    def poly(terms, at):
        return mp.fsum(mp.mpf(c.numerator) / c.denominator * mp.fprod(atom(a, at) ** n for a, n in m)
                       for m, c in terms.items())

    summed = {tuple((a, n) for a, n in m if a != SUM): c for m, c in ratio.num.items() if (SUM, 1) in m}
    plain = {m: c for m, c in ratio.num.items() if (SUM, 1) not in m}
    total = mp.fsum(_divided(poly(summed, i), poly(ratio.den, i)) for i in range(point[COUNT] if summed else 0))
    places = [place] if place is not None else range(max(point[COUNT], 1))
    rest = [_divided(poly(plain, i), poly(ratio.den, i)) for i in (places if plain else ())]
    assert all(abs(r - rest[0]) <= CLOSE * (1 + abs(r)) for r in rest), "a symbol of an index stands outside sums"
    return total + (rest[0] if rest else 0)


def points(seed, assumed=(), most=6, tries=60):
    """Random points of none to three neurons that meet the relations assumed."""
    rng, found = random.Random(seed), 0

    def drawn():
        return mp.mpf(rng.choice([0, 1, -1, 2, -2, 3])) if rng.random() < 0.5 else mp.mpf(rng.randint(-40, 40)) / 8

    for _ in range(tries):
        neurons = rng.choice([0, 1, 2, 2, 3])
        point = {name: drawn() for name in ("x", "y", "z", "c", "x0")} | {
            name: [drawn() for _ in range(neurons)] for name in ("W", "V")} | {COUNT: neurons}
        try:
            good = all(holds(relation, point) for relation in assumed)
        except (UndefinedError, TooLargeError):
            continue
        if good and found < most:
            found += 1
            yield point

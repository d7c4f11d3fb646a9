"""False statements, each false by construction, over every feature of the goal language, in families.

A family yields (name, function that makes the goal). Why its statements are false stands above it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import product

import sympy as sp

from workbench.proof.claim import (
    D,
    Goal,
    at_least,
    at_most,
    differ,
    equal,
    greater,
    less,
    saturation,
)

Statement = tuple[str, Callable[[], Goal]]
Family = Iterator[Statement]

x, y, z, u, V, V0, x0 = sp.symbols("x y z u V V0 x0", real=True)
p, q, k, c = sp.symbols("p q k c", positive=True)
t = sp.Symbol("t", nonnegative=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
W, S = sp.IndexedBase("W", real=True), sp.IndexedBase("S", real=True)
R = sp.Rational


def total(term: sp.Expr, *limits: object) -> sp.Expr:
    """The sum of a term over the index, from 1 to n where nothing else is said."""
    return sp.Sum(term, (j, *(limits or (1, n))))


def wrong_coefficients() -> Family:
    """A binomial expansion with one coefficient changed: false at x = y = 1."""
    for power, place, off in product((2, 3, 4, 5), range(6), (-1, 1)):
        if place <= power:
            terms = [(sp.binomial(power, i) + (off if i == place else 0)) * x**i * y**(power - i)
                     for i in range(power + 1)]
            yield f"binomial {power} {place} {off}", lambda e=power, s=terms: Goal((equal((x + y)**e, sum(s)),))


def wrong_signs() -> Family:
    """One sign of a square, of a product of sums or of a derivative turned: false at x = 1, y = 2, z = 3."""
    pairs = [((x - y)**2, x**2 + 2*x*y + y**2), ((x + y)**2, x**2 - 2*x*y + y**2), ((x - y)*(x + y), x**2 + y**2),
             ((x - y)**3, x**3 - y**3), ((x + y + z)**2, x**2 + y**2 + z**2), (x*(y - z), x*y + x*z),
             (-(x - y), -x - y), ((x - y)*(z - x), x*z - x**2 - y*z - x*y), (x**2 - y**2, (x - y)**2),
             ((-x)**3, x**3), (-x**2, x**2), (x - (y - z), x - y - z)]
    for number, (left, right) in enumerate(pairs):
        yield f"sign {number}", lambda a=left, b=right: Goal((equal(a, b),))
        yield f"sign {number} with more shown", lambda a=left, b=right: Goal((at_least(x**2, 0), equal(a, b)))


def young() -> Family:
    """x y <= a x^2 + b y^2 with 4 a b < 1: false at x = sqrt(b), y = sqrt(a), and near it."""
    for a, b in [(R(1, 2), R(1, 4)), (R(1, 3), R(1, 2)), (R(1, 4), R(9, 10)), (R(1, 10), R(2)), (R(1), R(1, 5)),
                 (R(49, 100), R(1, 2)), (R(1, 8), R(1, 8)), (R(3), R(1, 13))]:
        yield f"Young {a} {b}", lambda a=a, b=b: Goal((at_most(x*y, a*x**2 + b*y**2),))
        yield f"Young with a parameter {a} {b}", lambda a=a, b=b: Goal((at_most(x*y, a*k*x**2 + b*y**2/k),))
        yield f"Young of sums {a} {b}", lambda a=a, b=b: Goal(
            (at_most(total(W[j]*S[j]), a*total(W[j]**2) + b*total(S[j]**2)),))


def strictness() -> Family:
    """Equality is attained: at zero, at one, or where both sides meet."""
    for number, goal in enumerate([
            lambda: Goal((greater(x**2, 0),)), lambda: Goal((greater(x**2 + y**2, 0),)),
            lambda: Goal((less(2*x*y, x**2 + y**2),)), lambda: Goal((greater(sp.Abs(x), 0),)),
            lambda: Goal((greater(sp.Abs(x), x),)), lambda: Goal((greater(sp.exp(x), 1 + x),)),
            lambda: Goal((less(sp.log(p), p - 1),)), lambda: Goal((less(x, y),), (at_most(x, y),)),
            lambda: Goal((less(sp.Abs(x + y), sp.Abs(x) + sp.Abs(y)),)), lambda: Goal((differ(x**2, 1),)),
            lambda: Goal((less(-x**2, 0),)), lambda: Goal((greater(sp.Max(x, y), x),)),
            lambda: Goal((less(sp.Min(x, y), y),)), lambda: Goal((greater((x - y)**2 + (y - z)**2, 0),)),
            lambda: Goal((greater(p + 1/p, 2),)), lambda: Goal((less(p*(1 - p), R(1, 4)),)),
            lambda: Goal((less(sp.tanh(x)*x, sp.Abs(x)),)), lambda: Goal((greater(sp.sqrt(1 + x**2), 1),)),
            lambda: Goal((greater(sp.exp(-x**2) + x**2, 1),)), lambda: Goal((less(sp.exp(-x**2), 1),)),
            lambda: Goal((greater(total(W[j]**2), 0),)), lambda: Goal((greater(1 + total(W[j]**2), 1),)),
            lambda: Goal((greater(x, 0),), (at_least(x, 0),)), lambda: Goal((differ(x*y, 0),), (differ(x, 0),)),
    ]):
        yield f"strict {number}", goal
    for shift in (-2, 0, 1):
        yield f"strict square about {shift}", lambda s=shift: Goal((greater((x - s)**2, 0),))
        yield f"strict tangent at {shift}", lambda s=shift: Goal(
            (greater(sp.exp(x - s), 1 + x - s),))


def domains() -> Family:
    """Undefined somewhere, or cancelled: nothing of the kind may come out true for all real numbers."""
    for number, goal in enumerate([
            lambda: Goal((equal(sp.Mul(x, sp.Pow(x, -1, evaluate=False), evaluate=False), 1),)),
            lambda: Goal((equal((x**2 - 1)/(x - 1), x + 1),)), lambda: Goal((equal((x**2 - y**2)/(x - y), x + y),)),
            lambda: Goal((equal(1/x - 1/x, 0),)), lambda: Goal((equal(1/x + 1/y, (x + y)/(x*y)),)),
            lambda: Goal((at_least(1/x**2, 0),)), lambda: Goal((equal(sp.log(x**2), 2*sp.log(x)),)),
            lambda: Goal((equal(sp.exp(sp.log(x)), x),)), lambda: Goal((at_most(sp.log(x), x - 1),)),
            lambda: Goal((at_least(1/x, 0),), (at_least(x, 0),)), lambda: Goal((equal(x*(1/(x*y)), 1/y),)),
            lambda: Goal((equal(sp.sqrt(x)**2, x),)), lambda: Goal((at_least(sp.sqrt(x), 0),)),
            lambda: Goal((at_most(x/(1 + x), 1),)), lambda: Goal((equal((x**3 - 8)/(x - 2), x**2 + 2*x + 4),)),
            lambda: Goal((equal(1/(1/x), x),)), lambda: Goal((equal(sp.log(x*y), sp.log(x) + sp.log(y)),)),
            lambda: Goal((greater(sp.sqrt(x + y), -1),), (at_least(x, 0),)),
            lambda: Goal((equal(D(sp.log(x)), y/x),), flow={x: y}),
            lambda: Goal((equal(D(sp.sqrt(x)**2), y),), flow={x: y}),
    ]):
        yield f"domain {number}", goal
    for shift in range(1, 11):
        yield f"removable at {shift}", lambda s=shift: Goal((equal((x**2 - s**2)/(x - s), x + s),))


def roots() -> Family:
    """The other branch of a root, or roots drawn apart: false at -1, at 1 and 4, or of complex numbers."""
    for number, goal in enumerate([
            lambda: Goal((equal(sp.sqrt(x**2), x),)), lambda: Goal((equal(sp.sqrt(x**2), -x),)),
            lambda: Goal((equal(sp.sqrt(p + q), sp.sqrt(p) + sp.sqrt(q)),)), lambda: Goal((at_most(sp.sqrt(p), p),)),
            lambda: Goal((at_least(sp.sqrt(p), p),)), lambda: Goal((equal(sp.sqrt((x - y)**2), x - y),)),
            lambda: Goal((equal(sp.sqrt(-2)*sp.sqrt(-3), sp.sqrt(6)),)),
            lambda: Goal((at_least(sp.sqrt(x**2 + y**2), x + y),)),
            lambda: Goal((at_most(sp.sqrt(x**2 + y**2), x),)), lambda: Goal((equal(sp.sqrt(p)*sp.sqrt(p), -p),)),
            lambda: Goal((at_most(sp.sqrt(1 + x**2), 1 + x),)), lambda: Goal((equal(sp.sqrt(p**2*x**2), p*x),)),
            lambda: Goal((at_least(sp.sqrt(p*q), (p + q)/2),)), lambda: Goal((less(sp.sqrt(2), R(7, 5)),)),
            lambda: Goal((equal(sp.sqrt(2), R(141421356, 10**8)),)),
    ]):
        yield f"root {number}", goal
    for square in (2, 3, 5, 6, 7, 10, 11, 12, 13, 14):
        yield f"root of {square} rounded down", lambda s=square: Goal((at_most(sp.sqrt(s), math.isqrt(s)),))
        yield f"root as a number {square}", lambda s=square: Goal((equal(s*sp.sqrt(s) + x, s**2 + x),))


def sums() -> Family:
    """False for one neuron, for none, or a sum whose limits say something else than from 1 to n."""
    for number, goal in enumerate([
            lambda: Goal((at_least(total(W[j]), 0),)), lambda: Goal((equal(total(W[j]*S[j]), 0),)),
            lambda: Goal((at_most(total(W[j]), total(W[j]**2)),)), lambda: Goal((greater(total(W[j]**2), 0),)),
            lambda: Goal((at_least(total(W[j]*S[j]), -total(W[j]**2)),)),
            lambda: Goal((at_least(total(sp.Integer(1), 1, -5), 0),)),
            lambda: Goal((equal(total(sp.Integer(1), 1, 3), 4),)),
            lambda: Goal((equal(total(W[j]**2, 1, 2), total(W[j]**2, 1, 3)),)),
            lambda: Goal((at_least(total(W[j]**2, 1, -3), 0),)),
            lambda: Goal((at_least(total(W[j]**2, 3, n), 1),)),
            lambda: Goal((equal(x*total(W[j]), total(W[j])),)),
            lambda: Goal((equal(D(total(W[j]**2)), -2*total(W[j]**2)),), flow={W[j]: W[j]}),
            lambda: Goal((equal(D(total(W[j]**2)), 2*total(W[j]*S[j])),), flow={W[j]: -S[j]}),
    ]):
        yield f"sum {number}", goal
    for factor in (R(-2), R(-1), R(-1, 2), R(0), R(1, 8), R(1, 4), R(2, 5)):
        yield f"sum of products {factor}", lambda f=factor: Goal(
            (at_most(2*total(W[j]*S[j]), f*total(W[j]**2) + total(S[j]**2)),))
        yield f"leakage {factor}", lambda f=factor: Goal(
            (at_most(-total(W[j]**2) + total(W[j]*S[j]), -total(W[j]**2) + f*total(S[j]**2)),))


def sums_in_time() -> Family:
    """Of inputs with an index, which may be anything, and of initial values that are sums: false at ones."""
    driven = {"flow": {W[j]: -W[j] + S[j]}, "inputs": (S[j],)}
    for factor in (R(0), R(1, 4), R(1, 2), R(9, 10)):
        yield f"driven {factor}", lambda f=factor: Goal(
            (at_most(D(total(W[j]**2)), f/2*total(S[j]**2)),), (equal(total(W[j]**2), total(S[j]**2)/4),), **driven)
        yield f"started {factor}", lambda f=factor: Goal(
            (at_most(V, f*total(W[j]**2)),), flow={V: -V}, initial={V: total(W[j]**2)})
        yield f"started below {factor}", lambda f=factor: Goal(
            (at_least(V, total(W[j]**2)),), flow={V: -V}, initial={V: f*total(W[j]**2)})
    yield "decays though driven", lambda: Goal((at_most(D(total(W[j]**2)), 0),), **driven)
    yield "rate of an input", lambda: Goal((equal(D(total(S[j]**2)), 0),), **driven)


def saturations() -> Family:
    """Passed by, strict at the limit, or turned: false at x = 3, at the limits, or at a sign changed."""
    for bound in (1, 2, 5):
        sat, low, high = saturation(x, -bound, bound), -bound, bound
        for name, goal in {
            "strict": lambda s=sat, b=high: Goal((less(sp.Abs(s), b),)),
            "identity": lambda s=sat: Goal((equal(s, x),)),
            "smaller": lambda s=sat, b=high: Goal((at_most(s, b - R(1, 10)),)),
            "larger": lambda s=sat, b=low: Goal((at_least(s, b + R(1, 10)),)),
            "odd lost": lambda s=sat, b=high: Goal((equal(saturation(-x, -b, b), s),)),
            "linear": lambda s=sat, b=high: Goal((equal(saturation(2*x, -b, b), 2*s),)),
            "positive": lambda s=sat: Goal((greater(x*s, 0),)),
            "slope": lambda s=sat, b=high: Goal((at_most(sp.Abs(s - saturation(y, -b, b)), sp.Abs(x - y)/2),)),
            "rest": lambda s=sat: Goal((at_most((x - s)*(y - s), 0),)),
            "swapped": lambda s=sat, b=high: Goal((equal(s, sp.Max(sp.Min(x, -b), b)),)),
        }.items():
            yield f"saturation {bound} {name}", goal


def sizes() -> Family:
    """abs, sign, Max, Min and tanh where they are not what is said."""
    for number, goal in enumerate([
            lambda: Goal((at_most(sp.Abs(x), x),)), lambda: Goal((equal(sp.sign(x)**2, 1),)),
            lambda: Goal((equal(x*sp.sign(x), x),)), lambda: Goal((equal(sp.Abs(x*y), x*sp.Abs(y)),)),
            lambda: Goal((at_most(sp.Abs(x + y), sp.Abs(x)),)), lambda: Goal((at_least(sp.sign(x), 0),)),
            lambda: Goal((equal(sp.sign(x + y), sp.sign(x) + sp.sign(y)),)),
            lambda: Goal((at_least(sp.Max(x, y), x + y),)), lambda: Goal((equal(sp.Max(x, y), x),)),
            lambda: Goal((equal(sp.Max(x, -x), x),)), lambda: Goal((at_most(sp.Max(x, y, z), x + y + z),)),
            lambda: Goal((at_least(sp.Min(x, y), (x + y)/2),)), lambda: Goal((at_most(sp.Abs(x) - sp.Abs(y), x - y),)),
            lambda: Goal((at_most(sp.Abs(sp.tanh(x)), R(9, 10)),)), lambda: Goal((at_least(sp.tanh(x), x),)),
            lambda: Goal((equal(sp.tanh(-x), sp.tanh(x)),)), lambda: Goal((at_least(sp.tanh(x), 0),)),
            lambda: Goal((equal(sp.tanh(2*x), 2*sp.tanh(x)),)), lambda: Goal((at_most(sp.Abs(x)**3, x**2),)),
    ]):
        yield f"size {number}", goal
    for constant in (R(0), R(1, 10), R(1, 5), R(1, 4), R(27, 100)):  # the best one is 0.2784...
        yield f"smooth sign {constant}", lambda b=constant: Goal((at_most(sp.Abs(x) - x*sp.tanh(x/k), b*k),))


def angles() -> Family:
    """Trigonometry with a sign, a factor or a bound that is wrong: false at x = 1, y = 2, or where cos x is 0 or -1."""
    s, c = sp.sin, sp.cos
    for number, (left, right) in enumerate([
            (s(x)**2 - c(x)**2, 1), (s(x)**2 + c(y)**2, 1), (s(-x), s(x)), (c(-x), -c(x)), (s(2*x), 2*s(x)),
            (s(2*x), s(x)*c(x)), (c(2*x), 1 - s(x)**2), (s(x + y), s(x) + s(y)), (c(x + y), c(x)*c(y)),
            (s(x + y), s(x)*c(y) - c(x)*s(y)), (c(x + y), c(x)*c(y) + s(x)*s(y)), (s(x)/x, 1), (c(x), 1 - x**2/2),
            (s(x*y), s(x)*s(y)), (c(x)*s(y), s(x)*c(y)), (s(x)**3, s(x) - c(x)**2)]):
        yield f"angle {number}", lambda a=left, b=right: Goal((equal(a, b),))
    for number, goal in enumerate([
            lambda: Goal((at_least(s(x), 0),)), lambda: Goal((at_most(s(x), x),)), lambda: Goal((at_least(c(x), 0),)),
            lambda: Goal((less(s(x), 1),)), lambda: Goal((greater(c(x), -1),)),
            lambda: Goal((at_most(c(x), R(99, 100)),)),
            lambda: Goal((at_least(x*s(x), 0),)), lambda: Goal((at_least(s(x), x - x**2/6),), assume=(at_least(x, 0),)),
            lambda: Goal((at_least(c(x), 1 - x**2/4),)), lambda: Goal((at_most(s(x) + c(x), R(7, 5)),)),
            lambda: Goal((at_most(c(x), 1 - x**2/2 + x**4/25),)), lambda: Goal((greater(1 - c(x), 0),)),
            lambda: Goal((equal(D(s(x)), -c(x)*y),), flow={x: y}), lambda: Goal((equal(D(c(x)), s(x)*y),), flow={x: y}),
            lambda: Goal((equal(D(s(x)**2), 2*s(x)),), flow={x: y}),
            lambda: Goal((at_most(D(y**2/2 + 1 - c(x)), -y**2),), flow={x: y, y: -s(x) - y/2}),
            lambda: Goal((at_most(D(y**2/2 + c(x)), 0),), flow={x: y, y: -s(x) - y}),
            lambda: Goal((at_least(s(x)**2/c(x)**2, 0),)),
            lambda: Goal((less(s(1), R(84, 100)),)), lambda: Goal((greater(c(1), R(5404, 10000)),))]):
        yield f"angle bound {number}", goal


def sums_in_functions() -> Family:
    """exp of a sum and log of a product taken apart wrongly: false at x = 1, y = 2, p = 2, q = 3."""
    e, ln = sp.exp, sp.log
    for number, (left, right) in enumerate([
            (e(x + y), e(x) + e(y)), (e(x - y), e(x)*e(y)), (e(2*x), 2*e(x)), (e(x*y), e(x)*e(y)),
            (ln(p*q), ln(p)*ln(q)), (ln(p/q), ln(q) - ln(p)), (ln(p + q), ln(p) + ln(q)), (ln(p**2), ln(p)**2)]):
        yield f"sum in a function {number}", lambda a=left, b=right: Goal((equal(a, b),))
    # Of a negative number there is no logarithm: what is said of both sides says nothing there.
    yield "log of a square", lambda: Goal((equal(ln(x**2), 2*ln(x)),))
    yield "log of a product", lambda: Goal((equal(ln(x*y), ln(x) + ln(y)),), assume=(greater(x*y, 0),))


def wrong_facts() -> Family:
    """Tangents with another slope or turned, given as facts too: false left or right of where they touch."""
    for slope in (R(-1), R(0), R(1, 2), R(9, 10), R(11, 10), R(2), R(5)):
        yield f"exp above {slope}", lambda m=slope: Goal((at_least(sp.exp(x), 1 + m*x),), facts=(sp.exp(x), x))
        yield f"log below {slope}", lambda m=slope: Goal((at_most(sp.log(p), m*(p - 1)),), facts=(sp.log(p), p))
        yield f"exp below {slope}", lambda m=slope: Goal((at_most(sp.exp(x), 1 + m*x),), facts=(sp.exp(x),))
        yield f"log above {slope}", lambda m=slope: Goal((at_least(sp.log(p), m*(p - 1)),), facts=(sp.log(p),))
    for number in (R(27, 10), R(2), R(11, 4), R(3)):
        yield f"e is not {number}", lambda v=number: Goal((equal(sp.exp(1), v),))
        yield f"e is no more than {number}", lambda v=number: Goal((at_most(sp.exp(2), v**2 - (3 if v >= 3 else 1)),))


def wrong_lemmas() -> Family:
    """A hint that is false proves nothing: the statement fails at x = -2, y = -3, or nearby."""
    shown = [at_least(x, 0), at_least(x*y, 0), at_most(x**2, 1), equal(x, y), greater(y, x), at_least(x**3, 0),
             at_most(x + y, 0), equal(x**2, x), differ(x, 0), at_least(x - x**2, 0)]
    for number, relation in enumerate(shown):
        yield f"lemma is the statement {number}", lambda r=relation: Goal((r,), lemmas=(r,))
        yield f"lemma is contradictory {number}", lambda r=relation: Goal(
            (r,), lemmas=(at_most(1, 0), less(x**2, 0)))
        yield f"lemma of a domain {number}", lambda r=relation: Goal((r,), lemmas=(greater(x, 1), greater(y, 1)))


def contradictory_assumptions() -> Family:
    """What is assumed never holds: nothing is proved from nothing."""
    for number in range(1, 3):
        yield f"square below zero {number}", lambda s=number: Goal((at_most(1, 0),), (less(x**2, -s),))
        yield f"two values {number}", lambda s=number: Goal((equal(x, y),), (equal(x, s), equal(x, -s)))
        yield f"empty interval {number}", lambda s=number: Goal((at_least(y, 0),), (greater(x, s), less(x, s)))
        yield f"empty at the limit {number}", lambda s=number: Goal((at_least(y, 0),), (greater(s*x, s), at_most(x, 1)))
        yield f"sum below zero {number}", lambda s=number: Goal((at_most(s, 0),), (less(total(W[j]**2), 0),))


def never_reached() -> Family:
    """No motion from the initial values ever meets the assumption: of what is not, everything would follow."""
    for start, step in product((0, -3), (1, 2)):
        yield f"clock before its start {start} {step}", lambda s=start, d=step: Goal(
            (at_most(1, 0),), (at_most(x, s - d),), {x: sp.Integer(1)}, initial={x: sp.Integer(s)})
        yield f"at rest elsewhere {start} {step}", lambda s=start, d=step: Goal(
            (at_least(y, d),), (equal(x, s + d),), {x: sp.Integer(0)}, initial={x: sp.Integer(s)})
        yield f"grown by decay {start} {step}", lambda s=start, d=step: Goal(
            (at_most(x**2, 0),), (at_least(x, abs(s) + d),), {x: -x}, initial={x: sp.Integer(abs(s))},
            decreasing=x**2)
        yield f"left at once {start} {step}", lambda s=start, d=step: Goal(
            (at_most(d, 0),), flow={x: sp.Integer(d)}, always=(at_most(x, s),), initial={x: sp.Integer(s)})


def later_instants() -> Family:
    """The flow leads out of the bound that is claimed of every later instant."""
    for rate, bound in product((1, 2, R(1, 2)), (0, 1, 7)):
        yield f"ramp {rate} {bound}", lambda r=rate, b=bound: Goal(
            (at_most(x, b),), flow={x: r}, initial={x: sp.Integer(0)})
        yield f"ramp down {rate} {bound}", lambda r=rate, b=bound: Goal(
            (at_least(x, -b),), flow={x: -r}, initial={x: sp.Integer(0)})
        yield f"started above {rate} {bound}", lambda r=rate, b=bound: Goal(
            (at_most(x, b),), flow={x: -r*x}, initial={x: x0})
    for gain in (R(1, 10), R(1), R(3)):
        yield f"growth {gain}", lambda g=gain: Goal(
            (at_most(x**2, x0**2),), flow={x: g*x}, initial={x: x0}, decreasing=x**2)
        yield f"driven {gain}", lambda g=gain: Goal(
            (at_most(V, V0),), flow={V: -V + g}, initial={V: V0}, decreasing=V)
        yield f"lost constant {gain}", lambda g=gain: Goal(
            (at_most(V, 0),), (), {V: -g*V}, initial={V: V0}, decreasing=V)
        yield f"undamped {gain}", lambda g=gain: Goal(
            (less(x**2 + y**2, x0**2 + V0**2),), flow={x: y, y: -x}, initial={x: x0, y: V0}, decreasing=x**2 + y**2)


def derivatives() -> Family:
    """D with a sign, a factor or a chain rule wrong, or of what does not move: false at x = y = 1."""
    for number, goal in enumerate([
            lambda: Goal((equal(D(x**2), 2*x),), flow={x: y}),
            lambda: Goal((equal(D(x*y), x*D(y)),), flow={x: y, y: x}),
            lambda: Goal((equal(D(x**3), 3*x**2),), flow={x: -x}), lambda: Goal((at_most(D(x**2), 0),), flow={x: x}),
            lambda: Goal((at_most(D(x**2 + y**2), 0),), flow={x: y, y: x}),
            lambda: Goal((equal(D(1/p), 1/p**2),), flow={p: 1}),
            lambda: Goal((equal(D(sp.exp(x)), y*sp.exp(-x)),), flow={x: y}),
            lambda: Goal((equal(D(x), 0),)), lambda: Goal((equal(D(x*y), 0),)), lambda: Goal((at_most(D(x**2), 0),)),
            lambda: Goal((equal(D(x*u), u*D(x)),), flow={x: u}, inputs=(u,)),
            lambda: Goal((equal(D(sp.Abs(x)), y),), flow={x: y}),
            lambda: Goal((equal(D(D(x)), 1),), flow={x: y, y: x}),
            lambda: Goal((at_most(D(x**2/2), -x**2),), flow={x: -x + u}),
            lambda: Goal((equal(D(sp.log(p)), 1/p),), flow={p: p}),
    ]):
        yield f"derivative {number}", goal
    for rate in (R(1), R(-2), R(1, 3), R(5)):
        for power in (1, 2, 3):
            yield f"power rule {rate} {power}", lambda r=rate, e=power: Goal(
                (equal(D(x**e), r*x**(e - 1) * (e + 1) * x),), flow={x: r*x})


def eventually() -> Family:
    """Of some later time on, in a motion that what is assumed allows: a constant one, or one that never ends."""
    rate = sp.Symbol("w", real=True)
    for bound in (R(1), R(1, 2), R(3), R(10)):
        common = {"flow": {t: sp.Integer(1), x: rate}, "eventually": t, "inputs": (rate,)}
        yield f"vanishes {bound}", lambda b=bound, m=common: Goal(
            (at_most(x, 0),), always=(at_most(x, b),), **m)
        yield f"stays small {bound}", lambda b=bound, m=common: Goal(
            (at_most(x**2, b),), always=(at_least(x, 0),), **m)
        yield f"grows {bound}", lambda b=bound, m=common: Goal(
            (greater(x, b),), always=(at_least(x, 0), at_most(x, 2*b)), **m)


def numbers() -> Family:
    """Plain numbers: a digit, a power or a rounded constant that is wrong."""
    for base, power in product((2, 3, 5, 11, 13), (3, 20)):
        yield f"power of {base} {power}", lambda b=base, e=power: Goal((equal(sp.Integer(b)**e * x, (b**e + 1) * x),))
    for digits in range(1, 13):
        exact = sp.Integer(7)**digits
        yield f"power of seven {digits}", lambda e=exact, d=digits: Goal((equal(x + e, x + e + 10**(d - 1)),))
        yield f"a third in {digits} digits", lambda d=digits: Goal((equal(R(1, 3), R(int("3"*d), 10**d)),))
        yield f"order {digits}", lambda d=digits: Goal((less(R(1, 7), R(int("142857142857"[:d]), 10**d)),))


def functions_beside_sums() -> Family:
    """A function of one sum and another sum, as if functions went under the sum: false at n = 2, W = (1, -1), S = 1."""
    product, squares = total(W[j] * S[j]), total(W[j]**2) * total(S[j]**2)
    yield "size", lambda: Goal((equal(sp.Abs(product), total(sp.Abs(W[j] * S[j]))),))
    norms = sp.sqrt(total(W[j]**2)) * sp.sqrt(total(S[j]**2))
    yield "size against norms", lambda: Goal((equal(sp.Abs(product), norms),))
    yield "squared size", lambda: Goal((equal(sp.Abs(product)**2, squares),))
    yield "sine", lambda: Goal((equal(sp.sin(product), total(sp.sin(W[j] * S[j]))),))
    yield "squares of sums", lambda: Goal((equal(total(W[j])**2, total(W[j]**2)),))


FAMILIES = (wrong_coefficients, wrong_signs, young, strictness, domains, roots, sums, sums_in_time, saturations, sizes,
            angles, sums_in_functions, wrong_facts, wrong_lemmas, contradictory_assumptions, never_reached,
            later_instants, derivatives, eventually, numbers, functions_beside_sums)



def statements() -> Iterator[Statement]:
    """All of them."""
    for family in FAMILIES:
        for name, goal in family():
            yield f"{family.__name__}: {name}", goal

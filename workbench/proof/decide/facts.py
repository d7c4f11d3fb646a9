"""What is known without proof: the assumptions of a goal, and the facts that the checker holds about functions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement

import sympy as sp

from workbench.proof.checker import CertificateError, Context, bounds
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, Item, flatten
from workbench.proof.decide.laurent import Laurent, multiply, reduce_inverses, to_laurent
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import Size
from workbench.proof.text import text

_EXCESS: dict[str, Callable[[sp.Expr], sp.Expr]] = {
    "log_tangent": lambda x: x - 1 - sp.log(x),
    "exp_tangent": lambda x: sp.exp(x, evaluate=False) - 1 - x,
    "cosine_parabola": lambda x: sp.cos(x, evaluate=False) - 1 + x**2 / 2,
    "sine_tangent": lambda x: x - sp.sin(x, evaluate=False),
    "arctan_tangent": lambda x: x - sp.atan(x, evaluate=False),
    "arctan_sector": lambda x: sp.atan(x, evaluate=False) * (x - sp.atan(x, evaluate=False)),
    "arctan_slope": lambda x: x * (sp.atan(x, evaluate=False) * (1 + x**2) - x),
}
GRID = 10**9  # bounds of numbers such as log(2) are multiples of 1/GRID


@dataclass(frozen=True)
class Known:
    """Something of known sign: its factor items, its value, and whether it is > 0, >= 0 or == 0."""

    items: tuple[Item, ...]
    value: Laurent
    sign: str


def tangents(goal: Goal, atoms: Atoms) -> Iterator[tuple[str, sp.Expr, sp.Expr]]:
    """(fact, argument, what is at least 0) of the tangents that the checker knows of functions.

    Of those that are atoms at first: whoever flattens what is given may add others.
    """
    arguments = [(argument, "exp_tangent") for argument in goal.facts]
    for argument in list(atoms.logs):
        arguments += [(argument, "log_tangent"), (1 / argument, "log_tangent")]
    for argument in list(atoms.exps):
        arguments += [(argument, "exp_tangent"), (-argument, "exp_tangent")]
    for angle in list(atoms.circles):
        arguments += [(angle, "cosine_parabola")] + ([(angle, "sine_tangent")] if angle.is_nonnegative else [])
    for argument, _ in list(atoms.arctans.values()):
        arguments += [(argument, "arctan_sector"), (argument, "arctan_slope")]
        arguments += [(argument, "arctan_tangent")] if argument.is_nonnegative else []
    for nested, fact in arguments:
        argument = nested.xreplace(atoms.meanings())
        yield fact, argument, _EXCESS[fact](argument)


def arctans(atoms: Atoms) -> Iterator[tuple[Item, sp.Expr, str]]:
    """(fact, value, sign) of every arctan: it lies between -2 arctan 1 and 2 arctan 1; its tangent is what it is of."""
    quarter = flatten(sp.atan(1, evaluate=False), atoms, {}) if atoms.arctans else sp.S.Zero
    for angle, (argument, stated) in list(atoms.arctans.items()):
        if argument.free_symbols:
            yield {"fact": "arctan_limit", "of": text(stated)}, 2 * quarter - angle, ">"
            yield {"fact": "arctan_limit", "of": text(-stated)}, 2 * quarter + angle, ">"
        if angle in atoms.circles:
            sine, cosine = atoms.circles[angle]
            yield {"fact": "arctan_cosine", "of": text(stated)}, cosine, ">"
            yield {"fact": "arctan_sine", "of": text(stated)}, sine - argument * cosine, "=="


def circles(atoms: Atoms) -> Iterator[tuple[Item, sp.Expr]]:
    """(fact, what is 0) of every angle: its sine and cosine lie on a circle."""
    for angle, (sine, cosine) in list(atoms.circles.items()):
        yield {"fact": "circle", "of": text(angle.xreplace(atoms.meanings()))}, sine**2 + cosine**2 - 1


def additions(atoms: Atoms) -> Iterator[tuple[Item, sp.Expr]]:
    """(fact, what is 0) of the addition theorems between the arguments that stand in a goal: that of one is the sum, or
    the product, of two others or twice another."""
    names = atoms.meanings()

    def stated(fact: str, one: sp.Expr, two: sp.Expr) -> Item:
        return {"fact": fact, "of": text(one.xreplace(names)), "and": text(two.xreplace(names))}

    signed = [(t * angle, t * s, c) for angle, (s, c) in atoms.circles.items() for t in (1, -1)]
    for (a, sa, ca), (b, sb, cb) in combinations_with_replacement(signed, 2):
        for angle, (s, c) in list(atoms.circles.items()):
            if vanishes(angle - a - b):
                yield stated("sine_sum", a, b), s - sa * cb - ca * sb
                yield stated("cosine_sum", a, b), c - ca * cb + sa * sb
    powers = [(t * rest, e**t) for rest, e in atoms.exps.items() for t in (1, -1)]
    for (a, ea), (b, eb) in combinations_with_replacement(powers, 2):
        for rest, e in list(atoms.exps.items()):
            if vanishes(rest - a - b) and e not in (ea, eb):
                yield stated("exp_sum", a, b), e - ea * eb
    logs = list(atoms.logs.items())
    for (a, la), (b, lb) in combinations_with_replacement(logs, 2):
        for whole, found in logs:
            for turn in (1, -1):  # log(1/A) is -log(A)
                if found not in (la, lb) and vanishes(whole - (a * b)**turn):
                    yield stated("log_product", a, b), turn * found - la - lb


def known_facts(goal: Goal, relations: tuple[Relation, ...], atoms: Atoms) -> list[Known]:
    """Assumptions that are more than the sign of a symbol, and what the checker knows of every function."""
    known = [Known((), {(): Fraction(1)}, ">")]
    for position, relation in enumerate(relations):
        if relation.operator == "!=":
            value = to_laurent(flatten(relation.margin, atoms, goal.flow), atoms)
            known.append(Known(({"square_of": position},), reduce_inverses(multiply(value, value), atoms), ">"))
            continue
        if relation.margin.is_Symbol and relation.operator != "==":
            continue
        sign = "==" if relation.operator == "==" else ">" if relation.strict else ">="
        value = to_laurent(flatten(relation.margin, atoms, goal.flow), atoms)
        known.append(Known(({"assume": position},), value, sign))
    for fact, argument, excess in tangents(goal, atoms):
        value = to_laurent(flatten(excess, atoms, {}), atoms)
        known.append(Known(({"fact": fact, "of": text(argument)},), value, ">="))
    for root, (itself, square) in list(atoms.squares.items()):
        inner = flatten(itself.args[0], atoms, {})
        value = to_laurent(root**2 - (inner**2 if isinstance(itself, Size) else inner), atoms)
        known.append(Known((square,), value, "=="))
    known += [Known((item,), to_laurent(value, atoms), "==") for item, value in (*circles(atoms), *additions(atoms))]
    known += [Known((item,), to_laurent(value, atoms), sign) for item, value, sign in arctans(atoms)]
    return known + [bound for atom, meaning in atoms.meanings().items() if not meaning.free_symbols
                    for bound in _enclosure(atom, meaning, atoms)]


def _enclosure(atom: sp.Symbol, meaning: sp.Expr, atoms: Atoms) -> list[Known]:
    """Rational bounds of a number such as log(2), which the checker encloses on its own."""
    context = Context({}, [])
    written = text(meaning)
    try:
        low, high = bounds(context, context.read(written))
    except CertificateError:  # sqrt(1 - 2), for a sum of one term, is no number
        return []
    below, above = Fraction(math.floor(low * GRID), GRID), Fraction(math.ceil(high * GRID), GRID)
    sides = ((f"{written} - {below}", atom - sp.Rational(below)), (f"{above} - {written}", sp.Rational(above) - atom))
    return [Known(({"fact": "enclosure", "of": of},), to_laurent(value, atoms), ">=") for of, value in sides]
